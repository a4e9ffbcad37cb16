//! Fits of the Rust interface in a test's words: adaptive jets and tilted sections.

use super::Vector;
use super::mesh::Mesh;
use umbilic::*;

/// All that a fit has to say; nothing where an output is not of the method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fitted {
    pub normal: Vec<Vector>,
    pub direction1: Vec<Vector>,
    pub direction2: Vec<Vector>,
    pub k1: Vec<f64>,
    pub k2: Vec<f64>,
    pub mean: Vec<f64>,
    pub gaussian: Vec<f64>,
    pub residual: Vec<f64>,
    pub freedom: Vec<f64>,
    pub status: Vec<u8>,
}

pub fn topology(mesh: &Mesh) -> Topology {
    let indices = &mesh.indices[..];
    let faces =
        if mesh.is_triangles() { Faces::triangles(indices) } else { Faces::polygons(indices, &mesh.offsets[..]) };
    Topology::new(&faces.unwrap(), mesh.positions.len()).unwrap()
}

/// What a call writes over `fill`.
pub fn fitted(
    topology: &Topology,
    points: &Points<'_>,
    options: &CurvatureOptions<'_>,
    run: Run<'_>,
    fill: f64,
) -> Result<Fitted, Error> {
    let (count, jet) = (topology.vertex_count(), options.method == Method::AdaptiveJet);
    let (vectors, numbers) = (vec![[fill; 3]; count], vec![fill; count]);
    let only_jet = || vec![fill; if jet { count } else { 0 }];
    let mut found = Fitted {
        normal: vectors.clone(),
        direction1: vectors.clone(),
        direction2: vectors,
        k1: numbers.clone(),
        k2: numbers.clone(),
        mean: numbers.clone(),
        gaussian: numbers,
        residual: only_jet(),
        freedom: only_jet(),
        status: vec![0xa5; count],
    };
    let outputs = CurvatureOutputs {
        normal: Some(found.normal.as_mut_slice().into()),
        direction1: Some(found.direction1.as_mut_slice().into()),
        direction2: Some(found.direction2.as_mut_slice().into()),
        k1: Some(found.k1.as_mut_slice().into()),
        k2: Some(found.k2.as_mut_slice().into()),
        mean: Some(found.mean.as_mut_slice().into()),
        gaussian: Some(found.gaussian.as_mut_slice().into()),
        residual: jet.then(|| found.residual.as_mut_slice().into()),
        degrees_of_freedom: jet.then(|| found.freedom.as_mut_slice().into()),
        status: Some(found.status.as_mut_slice().into()),
        ..CurvatureOutputs::default()
    };
    curvatures(topology, points, options, run, &outputs)?;
    Ok(found)
}

/// Adaptive jets of a mesh, with a model or with the one that the call learns.
pub fn jets(mesh: &Mesh, model: Option<AdaptiveModel>, rings: usize) -> Fitted {
    let options = CurvatureOptions { model, rings, ..CurvatureOptions::default() };
    fitted(&topology(mesh), &Points::from(&mesh.positions), &options, Run::default(), 0.0).unwrap()
}

/// Any method with its defaults.
pub fn of_method(mesh: &Mesh, method: Method) -> Fitted {
    let options = CurvatureOptions { method, ..CurvatureOptions::default() };
    fitted(&topology(mesh), &Points::from(&mesh.positions), &options, Run::default(), 0.0).unwrap()
}

/// Normals and statuses alone.
pub fn normals(mesh: &Mesh, weight: Weight) -> (Vec<Vector>, Vec<u8>) {
    let count = mesh.positions.len();
    let (mut normal, mut status) = (vec![[0.0; 3]; count], vec![0xa5; count]);
    let outputs = NormalOutputs {
        normal: Some(normal.as_mut_slice().into()),
        status: Some(status.as_mut_slice().into()),
        ..NormalOutputs::default()
    };
    vertex_normals(&topology(mesh), &Points::from(&mesh.positions), weight, Run::default(), &outputs).unwrap();
    (normal, status)
}

/// What the mesh teaches.
pub fn learned(mesh: &Mesh) -> AdaptiveModel {
    learn_model(&topology(mesh), &Points::from(&mesh.positions), Run::default()).unwrap()
}

/// All numbers of a model but what nothing is computed from.
pub fn numbers(model: &AdaptiveModel) -> [f64; 6] {
    let [a, b, c, d] = model.sizes;
    [model.edge_length, model.noise, a, b, c, d]
}

impl Fitted {
    fn vectors(&self) -> [&Vec<Vector>; 3] {
        [&self.normal, &self.direction1, &self.direction2]
    }
    fn scalars(&self) -> [&Vec<f64>; 6] {
        [&self.k1, &self.k2, &self.mean, &self.gaussian, &self.residual, &self.freedom]
    }
    /// The numbers of a vertex.
    pub fn at(&self, vertex: usize) -> Vec<f64> {
        let scalars = self.scalars().into_iter().filter_map(|numbers| numbers.get(vertex));
        self.vectors().into_iter().flat_map(|vectors| vectors[vertex]).chain(scalars.copied()).collect()
    }
    /// Their bits, and the status.
    pub fn bits(&self, vertex: usize) -> (Vec<u64>, u8) {
        (self.at(vertex).into_iter().map(f64::to_bits).collect(), self.status[vertex])
    }
    pub fn all_bits(&self) -> Vec<(Vec<u64>, u8)> {
        (0..self.status.len()).map(|vertex| self.bits(vertex)).collect()
    }
    /// `k1 d1 d1ᵀ + k2 d2 d2ᵀ`
    pub fn tensor(&self, vertex: usize) -> [Vector; 3] {
        let (d1, d2) = (self.direction1[vertex], self.direction2[vertex]);
        let (k1, k2) = (self.k1[vertex], self.k2[vertex]);
        std::array::from_fn(|i| std::array::from_fn(|j| k1 * d1[i] * d1[j] + k2 * d2[i] * d2[j]))
    }
}
