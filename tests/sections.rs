//! Sections of meshes: those of an edge and those of three points, against the paper's formulas in its own words.

mod common;
use common::capi::{Handle, points};
use common::curvature::{direction_sections, edge_sections, ring_neighbours, ring_offsets};
use common::linear::{rotation, times};
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, cross, dot, length, real, scale, sub, unit};
use umbilic::capi::*;

/// The paper's formulas for three points, in its own words; `a` and `c` are as seen from the middle one.
fn three_points(section: umb_section, a: Vector, c: Vector) -> f64 {
    let (la, lc, chord) = (length(a), length(c), sub(c, a));
    let d = length(chord);
    let bisector = unit(add(unit(a), unit(c)));
    match section {
        // All points of a circle have its curvature: 4 areas over the product of the sides.
        UMB_SECTION_CIRCLE => 2.0 * length(cross(a, c)) / (la * lc * d),
        UMB_SECTION_PARABOLA => 4.0 * length(cross(add(a, c), chord)) / d.powi(3),
        UMB_SECTION_LENGTH_PARABOLA => {
            let (sum, along) = (la + lc, sub(scale(c, la / lc), scale(a, lc / la)));
            let second = scale(add(scale(a, 1.0 / la), scale(c, 1.0 / lc)), 2.0 * sum);
            length(cross(along, second)) / length(along).powi(3)
        }
        _ => {
            let [ha, hc] = [a, c].map(|x| dot(bisector, x));
            let va = length(sub(a, scale(bisector, ha)));
            let vc = length(sub(c, scale(bisector, hc)));
            let (height, width) = ((ha + hc) / 2.0, (va + vc) / 2.0);
            2.0 * height / (width * width)
        }
    }
}

const SECTIONS: [umb_section; 4] =
    [UMB_SECTION_CIRCLE, UMB_SECTION_PARABOLA, UMB_SECTION_LENGTH_PARABOLA, UMB_SECTION_SYMMETRIC_PARABOLA];

#[test]
fn sections_along_the_edges_of_a_ring_are_those_of_three_points() {
    // Every neighbour has one on the other side of the vertex, at another distance and height.
    for (valence, seed) in [(4, 1), (6, 2), (8, 3), (26, 4)] {
        let mut random = Random::new(seed);
        let turn = rotation(seed);
        let mut ring = vec![[0.0; 3]; valence];
        for i in 0..valence / 2 {
            let angle = std::f64::consts::TAU * (i as f64 + 0.2 * random.signed()) / valence as f64;
            for (place, sign) in [(i, 1.0), (i + valence / 2, -1.0)] {
                let radius = sign * (1.0 + 0.5 * random.unit());
                ring[place] = [radius * angle.cos(), radius * angle.sin(), 0.4 * random.signed()];
            }
        }
        let mut positions = vec![[0.0; 3]];
        positions.extend(ring.iter().map(|&p| times(&turn, p)));
        let next = |i: usize| (1 + (i + 1) % valence) as u32;
        let whole = (0..valence).map(|i| vec![0, 1 + i as u32, next(i)]).collect();
        // Half of it: a boundary, where the mirror image stands in.
        let half = (0..valence / 2 - 1).map(|i| vec![0, 1 + i as u32, next(i)]).collect();
        let normal = times(&turn, [0.0, 0.0, 1.0]);
        let normals = vec![normal; positions.len()];
        let directions: Vec<Vector> = positions[1..].iter().map(|&p| add(p, scale(normal, 0.3))).collect();
        for (faces, closed) in [(whole, true), (half, false)] {
            let mesh = Mesh::new("ring", positions.clone(), faces);
            let handle = Handle::new(&mesh);
            for section in SECTIONS {
                let found = direction_sections(&handle, &mesh.positions, &directions, |options| {
                    (options.section, options.normals) = (section, points(&normals));
                });
                // Inside the half only: at its ends rounding says whether the plane meets it.
                for i in if closed { 0..valence } else { 1..(valence / 2).max(2) - 1 } {
                    let ahead = positions[1 + i];
                    let mirrored = sub(scale(normal, 2.0 * dot(normal, ahead)), ahead);
                    let behind = if closed { positions[1 + (i + valence / 2) % valence] } else { mirrored };
                    let sign = -dot(add(unit(ahead), unit(behind)), normal).signum();
                    let expected = sign * three_points(section, ahead, behind);
                    assert!(
                        (found.curvature[i] - expected).abs() <= 1e-11 * expected.abs().max(1.0),
                        "{section} {i}"
                    );
                    assert_eq!(found.status[i], if closed { 0 } else { UMB_SECTION_STATUS_ONE_SIDED });
                }
            }
        }
    }
}

#[test]
fn the_circle_is_never_more_curved_than_the_parabola() {
    for mesh in real::meshes().into_iter().chain([mesh::torus(40, 24, 0.4, 0.3, 1), mesh::soup(60, 90, 5, 2)]) {
        let handle = Handle::new(&mesh);
        let [circle, parabola] = [UMB_SECTION_CIRCLE, UMB_SECTION_SYMMETRIC_PARABOLA]
            .map(|section| edge_sections(&handle, &mesh.positions, |options| options.section = section));
        for (entry, (c, sp)) in circle.curvature.iter().zip(&parabola.curvature).enumerate() {
            assert!(c.abs() <= sp.abs() * (1.0 + 4.0 * f64::EPSILON), "{}, {entry}: {c} {sp}", mesh.name);
            assert!(c * sp >= 0.0);
        }
    }
}

#[test]
fn sections_of_edges_stand_where_the_neighbours_stand() {
    let meshes = [mesh::torus(21, 13, 0.3, 0.4, 1), mesh::height_field(9, 0.5, 2), mesh::soup(40, 50, 5, 3)];
    for mesh in real::meshes().into_iter().take(6).chain(meshes) {
        let (handle, count) = (Handle::new(&mesh), mesh.positions.len());
        let (offsets, neighbours) = (ring_offsets(&handle, count), ring_neighbours(&handle, count));
        for section in SECTIONS {
            let found = edge_sections(&handle, &mesh.positions, |options| options.section = section);
            for vertex in 0..count {
                let normal = found.normal[vertex];
                let ring = offsets[vertex] as usize..offsets[vertex + 1] as usize;
                for (entry, &neighbour) in ring.clone().zip(&neighbours[ring]) {
                    let x = sub(mesh.positions[neighbour as usize], mesh.positions[vertex]);
                    let height = dot(normal, x);
                    let tangential = sub(x, scale(normal, height));
                    let divisor = if section == UMB_SECTION_CIRCLE { dot(x, x) } else { dot(tangential, tangential) };
                    let known = length(normal) > 0.0 && length(tangential) > 1e-14 * length(x);
                    assert_eq!(found.status[entry] == 0, known, "{}, {vertex}, {entry}", mesh.name);
                    let expected = if known { -2.0 * height / divisor } else { 0.0 };
                    // What rounding leaves of a height, and of a tangential part, that is a small part of the edge.
                    let rounding = 8.0 * f64::EPSILON * length(x);
                    let blur = rounding / divisor + expected.abs() * rounding / length(tangential).max(rounding);
                    assert!((found.curvature[entry] - expected).abs() <= 1e-13 * expected.abs() + blur * 2.0);
                }
            }
        }
    }
}
