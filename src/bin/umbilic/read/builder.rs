//! Collects the vertices and faces of a file into a mesh and checks them.
//!
//! A face may come before the vertices it refers to, as in some OBJ files, so the range of its indices is checked
//! when all vertices are known. Only the farthest reference is remembered for that: if it is in range, all are.

use super::Fault;
use crate::mesh::PolygonMesh;

/// A mesh that is being read.
pub(super) struct MeshBuilder {
    /// What has been read so far.
    mesh: PolygonMesh,
    /// The number that the file gives its first vertex.
    first_vertex: i64,
    /// The corner with the largest vertex index.
    farthest: Option<Corner>,
}

/// A reference from a face to a vertex.
struct Corner {
    /// The vertex, counted from zero.
    vertex: u32,
    /// The face, counted from zero.
    face: usize,
    /// The line of the face.
    line: Option<usize>,
}

impl MeshBuilder {
    /// Starts an empty mesh for a file that gives its first vertex the number `first_vertex`.
    pub(super) fn new(first_vertex: i64) -> Self {
        Self { mesh: PolygonMesh::default(), first_vertex, farthest: None }
    }

    /// The number of vertices so far.
    pub(super) fn vertex_count(&self) -> usize {
        self.mesh.positions.len()
    }

    /// The number of complete faces so far, which is also the index of the face that is being read.
    pub(super) fn face_count(&self) -> usize {
        self.mesh.face_count()
    }

    /// Adds a vertex.
    pub(super) fn add_vertex(&mut self, position: [f64; 3]) {
        self.mesh.positions.push(position);
    }

    /// Adds a corner to the face that is being read. The vertex is numbered as in the file.
    pub(super) fn add_corner(&mut self, number: i64, line: Option<usize>) -> Result<(), Fault> {
        let vertex = number
            .checked_sub(self.first_vertex)
            .and_then(|vertex| u32::try_from(vertex).ok())
            .ok_or_else(|| self.out_of_range(number, self.face_count(), line))?;
        if self.farthest.as_ref().is_none_or(|corner| vertex > corner.vertex) {
            self.farthest = Some(Corner { vertex, face: self.face_count(), line });
        }
        self.mesh.indices.push(vertex);
        Ok(())
    }

    /// Completes the face that is being read.
    pub(super) fn end_face(&mut self) -> Result<(), Fault> {
        let end = u32::try_from(self.mesh.indices.len())
            .map_err(|_| Fault::in_file("the faces have more than 4294967295 corners in total"))?;
        self.mesh.offsets.push(end);
        Ok(())
    }

    /// Checks and returns the mesh.
    pub(super) fn finish(self) -> Result<PolygonMesh, Fault> {
        if u32::try_from(self.vertex_count()).is_err() {
            return Err(Fault::in_file("there are more than 4294967295 vertices"));
        }
        match &self.farthest {
            Some(corner) if corner.vertex as usize >= self.vertex_count() => {
                let number = i64::from(corner.vertex) + self.first_vertex;
                Err(self.out_of_range(number, corner.face, corner.line))
            }
            _ => Ok(self.mesh),
        }
    }

    /// The fault of a face that refers to a vertex that cannot exist.
    fn out_of_range(&self, number: i64, face: usize, line: Option<usize>) -> Fault {
        let message = format!(
            "face {face} (counted from 0) refers to vertex {number}, but there are {} vertices, \
             counted from {}",
            self.vertex_count(),
            self.first_vertex,
        );
        Fault { line, message }
    }
}
