//! Calls of the library on a mesh or a polyline from a file.

use crate::mesh::PolygonMesh;
use crate::progress;
use crate::quantity::Quantity;
use crate::read::PolylineFile;
use std::path::Path;
use umbilic::{
    AdaptiveModel, Creases, CurvatureKind, CurvatureOptions, CurvatureOutputs, Error, Faces, NormalOutputs, Points,
    PolylineOutputs, PolylinePoints, Run, Section, Topology, Weight, status,
};

/// The one-rings of a mesh.
pub fn topology(mesh: &PolygonMesh) -> Result<Topology, Error> {
    Topology::new(&Faces::polygons(&mesh.indices, &mesh.offsets)?, mesh.vertex_count())
}

/// What the library finds at each vertex.
pub struct VertexNormals {
    /// Unit normals; zero where there is none.
    pub normals: Vec<[f32; 3]>,
    /// Bits of [`umbilic::status`].
    pub status: Vec<u8>,
}

/// The vertex normals of a mesh, computed in double precision on so many threads (0: as many as pay).
pub fn vertex_normals(
    mesh: &PolygonMesh,
    topology: &Topology,
    weight: Weight,
    threads: usize,
) -> Result<VertexNormals, Error> {
    let mut found =
        VertexNormals { normals: vec![[0.0; 3]; mesh.vertex_count()], status: vec![0; mesh.vertex_count()] };
    let outputs = NormalOutputs {
        normal: Some(found.normals.as_mut_slice().into()),
        status: Some(found.status.as_mut_slice().into()),
        ..NormalOutputs::default()
    };
    with_progress(mesh, 1, threads, |run| {
        umbilic::vertex_normals(topology, &Points::from(&mesh.positions), weight, run, &outputs)
    })?;
    Ok(found)
}

/// A mesh cut along its creases.
pub struct CutMesh {
    /// How it is cut, and its one-rings.
    pub parts: umbilic::CutMesh,
    /// The faces over the cut vertices.
    pub mesh: PolygonMesh,
}

/// Cuts a mesh at edges sharper than `angle`, in radians.
pub fn cut(mesh: &PolygonMesh, angle: f64, threads: usize) -> Result<CutMesh, Error> {
    let (faces, points) = (Faces::polygons(&mesh.indices, &mesh.offsets)?, Points::from(&mesh.positions));
    let run = Run { threads, ..Run::default() };
    let parts = umbilic::CutMesh::new(&faces, &points, &Creases { angle, ..Creases::default() }, run)?;
    let cut = PolygonMesh {
        positions: parts.origins().iter().map(|&vertex| mesh.positions[vertex as usize]).collect(),
        offsets: mesh.offsets.clone(),
        indices: parts.corners().to_vec(),
    };
    Ok(CutMesh { parts, mesh: cut })
}

/// A unit normal for each corner of a mesh, split at edges sharper than `angle`, in radians; zero where there is none.
pub fn corner_normals(
    mesh: &PolygonMesh,
    angle: f64,
    weight: Weight,
    threads: usize,
) -> Result<Vec<[f32; 3]>, Error> {
    let cut = cut(mesh, angle, threads)?;
    let found = vertex_normals(&cut.mesh, cut.parts.topology(), weight, threads)?;
    Ok(cut.mesh.indices.iter().map(|&vertex| found.normals[vertex as usize]).collect())
}

/// Runs a computation with a progress bar. `cost` is as in [`progress::computing`].
pub fn with_progress<T>(mesh: &PolygonMesh, cost: usize, threads: usize, compute: impl FnOnce(Run<'_>) -> T) -> T {
    let bar = progress::computing(mesh.vertex_count(), cost);
    let mut show = |done: f64| {
        bar.set_position((done * progress::WHOLE) as u64);
        true
    };
    let result = compute(Run { threads, progress: Some(&mut show), ..Run::default() });
    bar.finish_and_clear();
    result
}

/// What the library finds at each vertex of a mesh, of all that the method has.
pub struct VertexCurvatures {
    /// Unit normals; zero where there is none.
    pub normals: Vec<[f32; 3]>,
    /// Bits of [`umbilic::status`].
    pub status: Vec<u8>,
    /// By [`Quantity`].
    quantities: [Option<Vec<f64>>; Quantity::ALL.len()],
    /// The unit tangent directions of `k1` and `k2`.
    pub directions: Option<[Vec<[f32; 3]>; 2]>,
    /// The areas that the vertices stand for.
    pub area: Option<Vec<f64>>,
    /// Mean curvature integrated over them.
    pub integrated_mean: Option<Vec<f64>>,
    /// Gaussian curvature integrated over them.
    pub integrated_gaussian: Option<Vec<f64>>,
}

impl VertexCurvatures {
    /// A quantity at each vertex, 0 where there is no result; `None` where the method has it not.
    pub fn quantity(&self, quantity: Quantity) -> Option<&[f64]> {
        self.quantities[quantity as usize].as_deref()
    }

    /// A quantity at the vertices that have a result.
    pub fn results(&self, quantity: Quantity) -> Option<impl Iterator<Item = f64>> {
        let values = self.quantity(quantity)?.iter().zip(&self.status);
        Some(values.filter(|&(_, &status)| has_result(status)).map(|(&value, _)| value))
    }
}

/// Whether a status does not say that there is no result.
pub fn has_result(status: u8) -> bool {
    status & (status::ISOLATED | status::DEGENERATE) == 0
}

/// What adaptive jets learn of a mesh.
pub fn model(mesh: &PolygonMesh, topology: &Topology, threads: usize) -> Result<AdaptiveModel, Error> {
    let run = Run { threads, ..Run::default() };
    umbilic::learn_model(topology, &Points::from(&mesh.positions), run)
}

/// The curvatures of a mesh, on so many threads (0: as many as pay).
pub fn vertex_curvatures(
    mesh: &PolygonMesh,
    topology: &Topology,
    options: &CurvatureOptions<'_>,
    threads: usize,
) -> Result<VertexCurvatures, Error> {
    /// How many times as long as a normal by one ring a vertex takes, about.
    const COST: usize = 20;
    let count = mesh.vertex_count();
    let scalar = |kind| options.method.has(kind).then(|| vec![0.0; count]);
    let mut found = VertexCurvatures {
        normals: vec![[0.0; 3]; count],
        status: vec![0; count],
        quantities: Quantity::ALL.map(|quantity| scalar(quantity.kind())),
        directions: options.method.has(CurvatureKind::Directions).then(|| [0, 1].map(|_| vec![[0.0; 3]; count])),
        area: scalar(CurvatureKind::Area),
        integrated_mean: scalar(CurvatureKind::IntegratedMean),
        integrated_gaussian: scalar(CurvatureKind::IntegratedGaussian),
    };
    macro_rules! output {
        ($place:expr) => {
            $place.as_mut().map(|values| values.as_mut_slice().into())
        };
    }
    let [k1, k2, mean, gaussian, shape_index, curvedness] = &mut found.quantities;
    let [direction1, direction2] = match &mut found.directions {
        Some(directions) => directions.each_mut().map(Some),
        None => [None, None],
    };
    let outputs = CurvatureOutputs {
        k1: output!(k1),
        k2: output!(k2),
        mean: output!(mean),
        gaussian: output!(gaussian),
        shape_index: output!(shape_index),
        curvedness: output!(curvedness),
        direction1: direction1.map(|vectors| vectors.as_mut_slice().into()),
        direction2: direction2.map(|vectors| vectors.as_mut_slice().into()),
        area: output!(found.area),
        integrated_mean: output!(found.integrated_mean),
        integrated_gaussian: output!(found.integrated_gaussian),
        normal: Some(found.normals.as_mut_slice().into()),
        status: Some(found.status.as_mut_slice().into()),
        ..CurvatureOutputs::default()
    };
    with_progress(mesh, COST, threads, |run| {
        umbilic::curvatures(topology, &Points::from(&mesh.positions), options, run, &outputs)
    })?;
    Ok(found)
}

/// The number of the shape class of each vertex, from its principal curvatures.
pub fn shape_classes(mesh: &PolygonMesh, found: &VertexCurvatures, tolerance: f64) -> Result<Vec<u8>, Error> {
    let mut classes = vec![0; mesh.vertex_count()];
    let [k1, k2] = [Quantity::K1, Quantity::K2].map(|quantity| found.quantity(quantity).unwrap_or_default().into());
    let output = classes.as_mut_slice().into();
    umbilic::shape_classes(&k1, &k2, Some(&(&found.status).into()), tolerance, Run::default(), &output)?;
    Ok(classes)
}

/// What the library finds at each vertex of a polyline.
pub struct PolylineCurvatures {
    /// 2 or 3.
    pub dimension: u32,
    /// By [`Section::ALL`].
    curvatures: [Vec<f64>; 4],
    /// Bits of [`umbilic::polyline_status`].
    pub status: Vec<u8>,
}

impl PolylineCurvatures {
    /// The curvatures, with the name of each formula.
    pub fn sections(&self) -> [(&'static str, &[f64]); 4] {
        std::array::from_fn(|index| (Section::ALL[index].name(), self.curvatures[index].as_slice()))
    }
}

/// The curvatures of a polyline.
pub fn polyline_curvatures(polyline: &PolylineFile, closed: bool) -> Result<PolylineCurvatures, Error> {
    let points = match polyline {
        PolylineFile::Plane(points) => PolylinePoints::from(points.as_slice()),
        PolylineFile::Space(points) => PolylinePoints::from(points.as_slice()),
    };
    let count = points.len();
    let mut found = PolylineCurvatures {
        dimension: points.dimension(),
        curvatures: std::array::from_fn(|_| vec![0.0; count]),
        status: vec![0; count],
    };
    let [circle, parabola, length_parabola, symmetric_parabola] = &mut found.curvatures;
    let outputs = PolylineOutputs {
        circle: Some(circle.as_mut_slice().into()),
        parabola: Some(parabola.as_mut_slice().into()),
        length_parabola: Some(length_parabola.as_mut_slice().into()),
        symmetric_parabola: Some(symmetric_parabola.as_mut_slice().into()),
        status: Some(found.status.as_mut_slice().into()),
    };
    umbilic::polyline_curvatures(&points, closed, Run::default(), &outputs)?;
    Ok(found)
}

/// What the library says about a file, with the file's name in front.
pub fn blame(path: &Path) -> impl Fn(Error) -> String {
    move |error| format!("{}: {error}", path.display())
}
