//! What is refused before a sweep writes anything: counts that do not fit, vertices that are none, positions that are not finite.

use crate::error::{Error, filled};
use crate::topology::{NO_FACE, Polygons, Topology};
use crate::view::Points;

/// Refuses positions that are too few or too many, and vertices that are none.
pub(crate) fn check_counts(topology: &Topology, points: &Points<'_>, vertices: Option<&[u32]>) -> Result<(), Error> {
    let expected = topology.vertex_count() as u64;
    if points.len() as u64 != expected {
        return Err(Error::Size { what: "points.count", found: points.len() as u64, expected });
    }
    for (position, &vertex) in vertices.unwrap_or(&[]).iter().enumerate() {
        if vertex as u64 >= expected {
            let (position, index) = (position as u64, vertex as i128);
            return Err(Error::IndexOutOfRange { what: "run.vertices", position, index, vertex_count: expected });
        }
    }
    Ok(())
}

/// Refuses positions that are too few, too many or not finite, and vertices that are none. With a list of vertices, only
/// the positions that it needs may be to blame.
pub(super) fn check_points(topology: &Topology, points: &Points<'_>, vertices: Option<&[u32]>) -> Result<(), Error> {
    check_counts(topology, points, vertices)?;
    let Some(vertices) = vertices else {
        return points.check_finite();
    };
    // For a long list it is cheaper to look at all positions; only if that finds one is the list gone through, each
    // vertex and each face once.
    let long = corners_met(topology, vertices).is_none();
    if long && points.check_finite().is_ok() {
        return Ok(());
    }
    let faces = topology.polygons().map_or(0, Polygons::face_count);
    let mut seen =
        [filled(if long { points.len() } else { 0 }, false)?, filled(if long { faces } else { 0 }, false)?];
    let mut first_time = |kind: usize, index: u32| match seen[kind].get_mut(index as usize) {
        Some(seen) => !std::mem::replace(seen, true),
        None => true,
    };
    let check = |vertex: &u32| {
        let finite = points.get(*vertex as usize).is_finite();
        if finite { Ok(()) } else { Err(Error::NonFinitePosition { vertex: *vertex as u64 }) }
    };
    for vertex in vertices {
        if !first_time(0, *vertex) {
            continue;
        }
        check(vertex)?;
        let ring = topology.rings().ring_range(*vertex as usize);
        match topology.polygons() {
            None => topology.ring(*vertex as usize).iter().try_for_each(check)?,
            Some(polygons) => {
                for &face in polygons.corner_faces(ring) {
                    if face != NO_FACE && first_time(1, face) {
                        polygons.face(face as usize).iter().try_for_each(check)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// How many corners the faces at `vertices` have, a face counted as often as it is met; `None` if that is more work than
/// the whole mesh.
pub(super) fn corners_met(topology: &Topology, vertices: &[u32]) -> Option<usize> {
    let whole = topology.rings().entry_count()
        + topology.vertex_count()
        + topology.polygons().map_or(0, |polygons| polygons.face_count());
    let mut budget = whole;
    for &vertex in vertices {
        let ring = topology.rings().ring_range(vertex as usize);
        let met = match topology.polygons() {
            None => ring.len(),
            Some(polygons) => {
                let corners = |&face: &u32| match face {
                    NO_FACE => 0,
                    face => polygons.face(face as usize).len(),
                };
                polygons.corner_faces(ring).iter().map(corners).sum()
            }
        };
        budget = budget.checked_sub(met + 1)?;
    }
    Some(whole - budget)
}
