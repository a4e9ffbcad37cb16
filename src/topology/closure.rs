//! The vertices that a list of vertices needs around it.

use super::{NO_FACE, Topology};
use crate::error::Error;
use crate::view::zeroed;

/// Everything within so many rings of the vertices of `list`, each vertex once; vertices that share a face are
/// neighbours. Cost: the faces of what is found; a byte a vertex and a face of the mesh, untouched where nothing is.
pub(crate) fn closure(topology: &Topology, list: &[u32], rings: usize) -> Result<Vec<u32>, Error> {
    Ok(closure_by_rings(topology, list, rings, 0)?.0)
}

/// As [`closure`] of `rings + further` rings, ring after ring, and how many of these vertices are in the first `rings`.
pub(crate) fn closure_by_rings(
    topology: &Topology,
    list: &[u32],
    rings: usize,
    further: usize,
) -> Result<(Vec<u32>, usize), Error> {
    let mut seen: Vec<u8> = zeroed(topology.vertex_count())?;
    let mut seen_faces: Vec<u8> = zeroed(topology.polygons().map_or(0, |polygons| polygons.face_count()))?;
    let mut found: Vec<u32> = Vec::new();
    let mut add = |found: &mut Vec<u32>, vertex: u32| -> Result<(), Error> {
        if std::mem::replace(&mut seen[vertex as usize], 1) == 0 {
            found.try_reserve(1)?;
            found.push(vertex);
        }
        Ok(())
    };
    for &vertex in list {
        add(&mut found, vertex)?;
    }
    let (mut first, mut within) = (0, found.len());
    for ring in 0..rings + further {
        let last = found.len();
        for index in first..last {
            let vertex = found[index] as usize;
            for &neighbour in topology.ring(vertex) {
                add(&mut found, neighbour)?;
            }
            let Some(polygons) = topology.polygons() else { continue };
            for &face in polygons.corner_faces(topology.rings().ring_range(vertex)) {
                if face != NO_FACE && std::mem::replace(&mut seen_faces[face as usize], 1) == 0 {
                    for &corner in polygons.face(face as usize) {
                        add(&mut found, corner)?;
                    }
                }
            }
        }
        first = last;
        if ring < rings {
            within = found.len();
        }
    }
    Ok((found, within))
}
