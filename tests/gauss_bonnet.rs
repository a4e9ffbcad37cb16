//! What curvature integrates to: the angle defect's sum is `2π` times the Euler characteristic of every mesh, and the
//! integrals of mean curvature are those of the surface.

mod common;
use common::capi::Handle;
use common::curvature::*;
use common::mesh::{self, Mesh};
use common::oracle::{Oracle, cleaned};
use common::{Random, Vector, cross, dot, length, real, scale, sub, unit};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use umbilic::capi::*;

/// Closed and open, manifold and not, flat and not; with slivers, faces without area and edges without length.
fn meshes() -> Vec<Mesh> {
    let mut meshes = vec![
        mesh::ring_sphere(9, 5),
        mesh::ring_sphere(200, 3),
        mesh::tetrahedron_sphere(3),
        mesh::quad_sphere(7, 0.8, 1),
        mesh::dual_sphere(&mesh::quad_sphere(6, 0.5, 2)),
        mesh::dual_sphere(&mesh::tetrahedron_sphere(3)),
        mesh::torus(40, 24, 0.4, 0.0, 1),
        mesh::torus(30, 20, 0.4, 1.0, 2),
        mesh::torus(30, 20, 0.9, 0.5, 3),
        mesh::height_field(30, 0.0, 3),
        mesh::height_field(25, 0.5, 4),
        mesh::letter_prism(),
        mesh::fan(17, true, 6),
        mesh::fan(1000, false, 8),
    ];
    for seed in 0..40 {
        meshes.push(mesh::soup(40, 60, 3, seed));
        meshes.push(mesh::soup(30, 40, 7, 100 + seed));
    }
    let mut random = Random::new(9);
    for index in 0..meshes.len() {
        let mut crushed = match index % 4 {
            // Points that coincide, in a coarse lattice; on a line; in one point; torn to all sizes.
            0 => meshes[index].mapped(|p| p.map(|x| (2.0 * x).round() / 2.0)),
            1 => meshes[index].mapped(|[x, _, _]| [x, 0.0, 0.0]),
            2 => meshes[index].mapped(|_| [0.3; 3]),
            _ => meshes[index].clone(),
        };
        if index % 4 == 3 {
            for p in &mut crushed.positions {
                *p = scale(*p, 10f64.powf(3.0 * random.signed()));
            }
        }
        crushed.name += ", crushed";
        meshes.push(crushed);
    }
    meshes.extend(real::meshes());
    meshes
}

/// Vertices, edges and faces of the mesh cut open where its fans end: a vertex for each fan; an edge for each two faces
/// that a fan goes through, and one for each other side of a face.
fn cut_characteristic(mesh: &Mesh) -> i64 {
    let oracle = Oracle::new(mesh);
    let vertices: usize = (0..mesh.positions.len()).map(|vertex| oracle.fans(vertex).len()).sum();
    let faces: Vec<Vec<u32>> = mesh.faces().map(cleaned).filter(|face| !face.is_empty()).collect();
    let mut sides: HashMap<(u32, u32), usize> = HashMap::new();
    for face in &faces {
        for (place, &a) in face.iter().enumerate() {
            *sides.entry((a, face[(place + 1) % face.len()])).or_default() += 1;
        }
    }
    let all: usize = sides.values().sum();
    let joined = sides.iter().filter(|&(&(a, b), &n)| n == 1 && sides.get(&(b, a)) == Some(&1)).count();
    vertices as i64 - (all - joined / 2) as i64 + faces.len() as i64
}

#[test]
fn angle_defects_add_up_to_the_euler_characteristic() {
    let (mut closed, mut other) = (0, 0);
    for mesh in meshes() {
        let handle = Handle::new(&mesh);
        let found = curvatures(&handle, &mesh.positions, &options(UMB_CURVATURE_ANGLE_DEFECT));
        let sum: f64 = found.all(IntegratedGaussian).iter().sum();
        let expected = TAU * cut_characteristic(&mesh) as f64;
        assert!((sum - expected).abs() < 1e-9, "{}: {sum} for {expected}", mesh.name);
        let stats = handle.stats();
        if stats.boundary_edges + stats.non_manifold_vertices + stats.winding_edges == 0 {
            assert!((sum - TAU * stats.euler_characteristic as f64).abs() < 1e-9, "{}", mesh.name);
            closed += 1;
        } else {
            other += 1;
        }
        // Meyer's are the same, wherever there is a normal to have curvatures with.
        let meyer = curvatures(&handle, &mesh.positions, &options(UMB_CURVATURE_MEYER));
        for vertex in (0..mesh.positions.len()).filter(|&vertex| meyer.known(vertex)) {
            for output in [IntegratedGaussian, Area, Gaussian] {
                assert_eq!(meyer.at(output, vertex), found.at(output, vertex), "{}, {vertex}", mesh.name);
            }
        }
        // A mixed area is a part of each face: all together they are the mesh's.
        let faces = Oracle::new(&mesh);
        let whole: f64 = (0..mesh.face_count()).map(|face| length(faces.area_vector(face))).sum();
        let areas: f64 = found.all(Area).iter().sum();
        assert!((areas - whole).abs() <= 1e-9 * whole, "{}: {areas} for {whole}", mesh.name);
    }
    println!("{closed} closed meshes, {other} others");
    assert!(closed >= 15 && other >= 100);
}

#[test]
fn a_boundary_turns_by_what_the_disc_lacks() {
    // A flat polygon of any outline: the turning of its boundary is all there is.
    let flat = mesh::height_field(12, 0.5, 1).mapped(|[x, y, _]| [x, y, 0.0]);
    let found = of_mesh(&flat, UMB_CURVATURE_ANGLE_DEFECT, None, |_| ());
    let boundary = |vertex: usize| found.status[vertex] & UMB_VERTEX_BOUNDARY != 0;
    for vertex in 0..flat.positions.len() {
        let integral = found.at(IntegratedGaussian, vertex);
        assert!(boundary(vertex) || integral.abs() < 1e-13, "{integral}");
    }
    let turning: f64 =
        (0..flat.positions.len()).filter(|&v| boundary(v)).map(|v| found.at(IntegratedGaussian, v)).sum();
    assert!((turning - TAU).abs() < 1e-12);
}

#[test]
fn integrals_of_mean_curvature() {
    // The prism's edges: two outlines of length 8 that turn by π/2, five corners of height 0.7 that do, one that turns back.
    let prism = mesh::letter_prism();
    let found = of_mesh(&prism, UMB_CURVATURE_NORMAL_CYCLE, None, |_| ());
    let sum: f64 = found.all(IntegratedMean).iter().sum();
    assert!((sum - (2.0 * 8.0 + 4.0 * 0.7) * PI / 4.0).abs() < 1e-12, "{sum}");
    let sum: f64 = found.all(Area).iter().sum();
    assert!((sum - (2.0 * 3.0 + 8.0 * 0.7)).abs() < 1e-12, "{sum}");

    // On any closed polyhedron it is half the sum of lengths times dihedral angles; here straight from the faces.
    for mesh in [mesh::torus(30, 18, 0.3, 0.4, 1), mesh::quad_sphere(8, 0.5, 2)] {
        let oracle = Oracle::new(&mesh);
        let normal = |face: usize| unit(oracle.area_vector(face));
        let mut sides = HashMap::new();
        for (index, face) in mesh.faces().enumerate() {
            for (i, &a) in face.iter().enumerate() {
                sides.insert((a, face[(i + 1) % face.len()]), index);
            }
        }
        let mut expected = 0.0;
        for (&(a, b), &left) in &sides {
            let edge = sub(mesh.positions[b as usize], mesh.positions[a as usize]);
            let turn: Vector = cross(normal(left), normal(sides[&(b, a)]));
            // About the edge: the normals of faces that are not flat need not be perpendicular to it. Each edge comes twice.
            let sine = dot(turn, edge) / length(edge);
            expected += sine.atan2(dot(normal(left), normal(sides[&(b, a)]))) * length(edge) / 4.0;
        }
        let found = of_mesh(&mesh, UMB_CURVATURE_NORMAL_CYCLE, None, |_| ());
        let sum: f64 = found.all(IntegratedMean).iter().sum();
        assert!((sum - expected).abs() < 1e-11 * expected, "{sum} for {expected}");
    }
}

#[test]
fn all_integrals_tend_to_those_of_the_surface() {
    // Of spheres 4π r and 4π; of the torus with radii 1 and 0.4, 2π² and 0.
    let round = [mesh::tetrahedron_sphere(5), mesh::quad_sphere(16, 0.3, 1), mesh::ring_sphere(60, 30)];
    let hexagons = mesh::dual_sphere(&round[0]);
    let tori = [mesh::torus(90, 45, 0.2, 0.0, 1), mesh::torus(90, 45, 0.2, 1.0, 2)];
    let sphere = |mesh: Mesh| (mesh.mapped(|p| scale(p, 3.0)), 12.0 * PI, 4.0 * PI);
    let cases = round.into_iter().chain([hexagons]).map(sphere);
    for (mesh, mean, gaussian) in cases.chain(tori.map(|mesh| (mesh, 2.0 * PI * PI, 0.0))) {
        for method in [UMB_CURVATURE_MEYER, UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE] {
            let found = of_mesh(&mesh, method, None, |options| options.weight = UMB_WEIGHT_JET);
            let sum: f64 = found.all(IntegratedMean).iter().sum();
            assert!((sum - mean).abs() < 0.02 * mean, "{}, method {method}: {sum} for {mean}", mesh.name);
            if IntegratedGaussian.is_of(method) {
                let sum: f64 = found.all(IntegratedGaussian).iter().sum();
                assert!((sum - gaussian).abs() < 0.02 * 4.0 * PI, "{}, {method}: {sum}", mesh.name);
            }
        }
    }
}
