//! Calls of the library on a mesh from a file.

use crate::mesh::PolygonMesh;
use crate::progress;
use std::path::Path;
use umbilic::{Error, Faces, NormalOutputs, Points, Run, Topology, Weight};

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

/// What the library says about a file, with the file's name in front.
pub fn blame(path: &Path) -> impl Fn(Error) -> String {
    move |error| format!("{}: {error}", path.display())
}
