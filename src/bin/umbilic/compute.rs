//! Calls of the library on a mesh or a polyline from a file.

use crate::mesh::PolygonMesh;
use crate::progress;
use crate::read::PolylineFile;
use std::path::Path;
use umbilic::{Error, Faces, NormalOutputs, Points, PolylineOutputs, PolylinePoints, Run, Section, Topology, Weight};

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
    let bar = progress::computing(mesh.vertex_count());
    let mut show = |done: f64| {
        bar.set_position((done * progress::WHOLE) as u64);
        true
    };
    let run = Run { threads, progress: Some(&mut show), ..Run::default() };
    let result = umbilic::vertex_normals(topology, &Points::from(&mesh.positions), weight, run, &outputs);
    bar.finish_and_clear();
    result.map(|()| found)
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
