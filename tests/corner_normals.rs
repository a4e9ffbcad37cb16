//! Meshes cut along creases, and corner normals: against a partition of corners and an oracle of their own, and on solids whose
//! normals are known.

mod common;
use common::mesh::{self, Mesh};
use common::oracle::{Oracle, cleaned};
use common::{Random, Vector, cross, dot, largest_difference, length, sub, unit};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use umbilic::*;

const WEIGHTS: [Weight; 4] = [Weight::Conformal, Weight::Angle, Weight::Area, Weight::Uniform];

fn faces(mesh: &Mesh) -> Faces<'_> {
    Faces::polygons(&mesh.indices, &mesh.offsets).unwrap()
}

fn cut(mesh: &Mesh, creases: &Creases<'_>) -> CutMesh {
    CutMesh::new(&faces(mesh), &mesh.positions[..].into(), creases, Run::default()).unwrap()
}

fn normals(mesh: &Mesh, cut: &CutMesh, weight: Weight) -> Vec<Vector> {
    let mut corner = vec![[f64::NAN; 3]; mesh.indices.len()];
    let outputs = CornerOutputs { corner: Some(corner.as_mut_slice().into()), ..CornerOutputs::default() };
    corner_normals(cut, &mesh.positions[..].into(), weight, Run::default(), &outputs).unwrap();
    corner
}

fn vertex_normals_of(mesh: &Mesh, weight: Weight) -> Vec<Vector> {
    let topology = Topology::new(&faces(mesh), mesh.positions.len()).unwrap();
    let mut normal = vec![[0.0; 3]; mesh.positions.len()];
    let outputs = NormalOutputs { normal: Some(normal.as_mut_slice().into()), ..NormalOutputs::default() };
    vertex_normals(&topology, &mesh.positions[..].into(), weight, Run::default(), &outputs).unwrap();
    normal
}

fn face_normal(mesh: &Mesh, face: usize) -> Vector {
    let at = |vertex: u32| mesh.positions[vertex as usize];
    let corners = mesh.face(face);
    let mut sum = [0.0; 3];
    for place in 1..corners.len().saturating_sub(1) {
        let (a, b) = (sub(at(corners[place]), at(corners[0])), sub(at(corners[place + 1]), at(corners[0])));
        sum = common::add(sum, cross(a, b));
    }
    if length(sum) == 0.0 { sum } else { unit(sum) }
}

/// The cut vertex of each corner, straight from the definition: corners at a vertex are spread over from each other, across any edge of
/// exactly two faces of opposite directions that is no crease.
fn spread(mesh: &Mesh, creases: &Creases<'_>) -> Vec<u32> {
    let mut edges: HashMap<(u32, u32), Vec<(usize, bool)>> = HashMap::new();
    let cleaned: Vec<Vec<u32>> = mesh.faces().map(cleaned).collect();
    for (face, corners) in cleaned.iter().enumerate() {
        for (place, &from) in corners.iter().enumerate() {
            let to = corners[(place + 1) % corners.len()];
            edges.entry((from.min(to), from.max(to))).or_default().push((face, from < to));
        }
    }
    let is_crease = |edge: (u32, u32), one: usize, two: usize| {
        let (a, b) = (face_normal(mesh, one), face_normal(mesh, two));
        let flat = length(a) == 0.0 || length(b) == 0.0;
        let angle = length(cross(a, b)).atan2(dot(a, b));
        let groups = creases.groups.is_some_and(|groups| groups[one] != groups[two] || groups[one] == 0);
        let marked = creases.edges.iter().any(|&[a, b]| (a.min(b), a.max(b)) == edge);
        groups || marked || (!flat && angle > creases.angle + 1e-12)
    };
    // The faces at a vertex that are joined there.
    let mut numbers = vec![u32::MAX; mesh.indices.len()];
    let mut at_vertex: Vec<Vec<usize>> = vec![vec![]; mesh.positions.len()];
    for face in 0..mesh.face_count() {
        for corner in mesh.offsets[face]..mesh.offsets[face + 1] {
            at_vertex[mesh.indices[corner as usize] as usize].push(corner as usize);
        }
    }
    let face_of = |corner: usize| mesh.offsets.partition_point(|&offset| offset as usize <= corner) - 1;
    let mut next = 0;
    for (vertex, corners) in at_vertex.iter().enumerate() {
        let first = next;
        let kept = |corner: &&usize| !cleaned[face_of(**corner)].is_empty();
        for &start in corners.iter().filter(kept) {
            if numbers[start] != u32::MAX {
                continue;
            }
            numbers[start] = next;
            let mut open = vec![start];
            while let Some(corner) = open.pop() {
                for &other in corners.iter().filter(kept) {
                    if numbers[other] == u32::MAX
                        && touches(mesh, &edges, &is_crease, vertex as u32, corner, other, &face_of)
                    {
                        numbers[other] = next;
                        open.push(other);
                    }
                }
            }
            next += 1;
        }
        next = next.max(first + 1);
        for &corner in corners.iter().filter(|corner| !kept(corner)) {
            numbers[corner] = first;
        }
    }
    numbers
}

/// The neighbours of a corner in its face, repetitions skipped.
fn beside(mesh: &Mesh, corner: usize, face: usize) -> [(u32, bool); 2] {
    let (start, end) = (mesh.offsets[face] as usize, mesh.offsets[face + 1] as usize);
    let (vertex, count) = (mesh.indices[corner], end - start);
    let other = |step: usize| {
        let mut place = corner - start;
        loop {
            place = (place + step) % count;
            if mesh.indices[start + place] != vertex {
                return mesh.indices[start + place];
            }
        }
    };
    [(other(1), true), (other(count - 1), false)]
}

fn touches(
    mesh: &Mesh,
    edges: &HashMap<(u32, u32), Vec<(usize, bool)>>,
    is_crease: &impl Fn((u32, u32), usize, usize) -> bool,
    vertex: u32,
    corner: usize,
    other: usize,
    face_of: &impl Fn(usize) -> usize,
) -> bool {
    let (one, two) = (face_of(corner), face_of(other));
    let is_one_run = |from: usize, to: usize| {
        (from..=to).all(|place| mesh.indices[place] == vertex)
            || (to..mesh.offsets[one + 1] as usize)
                .chain(mesh.offsets[one] as usize..=from)
                .all(|place| mesh.indices[place] == vertex)
    };
    if one == two && is_one_run(corner.min(other), corner.max(other)) {
        return true;
    }
    let (mine, its) = (beside(mesh, corner, one), beside(mesh, other, two));
    mine.iter().any(|&(end, leaves)| {
        its.iter().any(|&(its_end, its_leaves)| {
            let edge = (vertex.min(end), vertex.max(end));
            its_end == end
                && leaves != its_leaves
                && edges[&edge].len() == 2
                && edges[&edge][0].1 != edges[&edge][1].1
                && !is_crease(edge, one, two)
        })
    })
}

/// Box of quads, `[-1, 1]³`.
fn cube() -> Mesh {
    let positions = (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 })).collect();
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    Mesh::new("cube", positions, faces.map(Vec::from).to_vec())
}

/// A cylinder of 24 quads with two caps of 24 corners; or, without height above it, a cone.
fn cylinder(sides: u32) -> Mesh {
    let ring =
        |z: f64| (0..sides).map(move |i| (TAU * i as f64 / sides as f64, z)).map(|(a, z)| [a.cos(), a.sin(), z]);
    let positions = ring(0.0).chain(ring(1.0)).collect();
    let mut faces: Vec<Vec<u32>> =
        (0..sides).map(|i| vec![i, (i + 1) % sides, (i + 1) % sides + sides, i + sides]).collect();
    faces.push((0..sides).rev().collect());
    faces.push((sides..2 * sides).collect());
    Mesh::new("cylinder", positions, faces)
}

fn cone(sides: u32) -> Mesh {
    let mut positions: Vec<Vector> =
        (0..sides).map(|i| TAU * i as f64 / sides as f64).map(|a| [a.cos(), a.sin(), 0.0]).collect();
    positions.push([0.0, 0.0, 1.0]);
    let mut faces: Vec<Vec<u32>> = (0..sides).map(|i| vec![i, (i + 1) % sides, sides]).collect();
    faces.push((0..sides).rev().collect());
    Mesh::new("cone", positions, faces)
}

fn compare(mesh: &Mesh, creases: &Creases<'_>) {
    let cut = cut(mesh, creases);
    let expected = spread(mesh, creases);
    assert_eq!(cut.corners(), expected, "{}", mesh.name);
    // The oracle on a mesh that is cut by the test's own partition.
    let count = cut.origins().len();
    let positions = cut.origins().iter().map(|&vertex| mesh.positions[vertex as usize]).collect();
    let parts = Mesh { name: mesh.name.clone(), positions, offsets: mesh.offsets.clone(), indices: expected };
    let oracle = Oracle::new(&parts);
    for weight in WEIGHTS {
        let found = normals(mesh, &cut, weight);
        let mut compared = 0;
        for vertex in 0..count {
            let answer = oracle.normal(vertex, weight);
            if answer.condition > 1e3 {
                continue;
            }
            for corner in (0..found.len()).filter(|&corner| parts.indices[corner] as usize == vertex) {
                let off = largest_difference(found[corner], answer.normal);
                assert!(off < 1e-12, "{} {weight:?}, corner {corner}: {off:e}", mesh.name);
                compared += 1;
            }
        }
        assert!(compared * 2 > found.len() || mesh.name.starts_with("soup"), "{}: {compared}", mesh.name);
    }
}

#[test]
fn corners_and_normals_are_those_of_the_definition() {
    let mut meshes = vec![
        cube(),
        cylinder(24),
        cone(16),
        mesh::letter_prism(),
        mesh::torus(12, 9, 0.3, 0.4, 1),
        mesh::fan(7, true, 1),
        mesh::fan(7, false, 1),
        mesh::quad_sphere(4, 0.3, 2),
    ];
    meshes.extend((0..60).map(|seed| mesh::soup(12, 25, 3, seed)));
    meshes.extend((0..60).map(|seed| mesh::soup(9, 16, 6, seed)));
    for (index, mesh) in meshes.iter().enumerate() {
        let mut random = Random::new(index as u64);
        for angle in [0.0, 0.3, 1.0, FRAC_PI_2, 4.0] {
            compare(mesh, &Creases { angle, ..Creases::default() });
        }
        let vertices = mesh.positions.len();
        let edges: Vec<[u32; 2]> =
            (0..2 * vertices).map(|_| [random.below(vertices) as u32, random.below(vertices) as u32]).collect();
        compare(mesh, &Creases { angle: PI, edges: &edges, groups: None });
        let groups: Vec<u32> = (0..mesh.face_count()).map(|_| random.below(3) as u32).collect();
        compare(mesh, &Creases { angle: PI, edges: &[], groups: Some(&groups) });
        compare(mesh, &Creases { angle: 0.8, edges: &edges[..3], groups: Some(&groups) });
    }
}

#[test]
fn a_cube_has_the_normals_of_its_faces() {
    let mesh = cube();
    let cut = cut(&mesh, &Creases::default());
    assert_eq!(cut.origins(), (0..8).flat_map(|vertex| [vertex; 3]).collect::<Vec<u32>>());
    for weight in WEIGHTS {
        for (corner, normal) in normals(&mesh, &cut, weight).into_iter().enumerate() {
            assert_eq!(normal, face_normal(&mesh, corner / 4), "{weight:?}");
        }
    }
    // With nothing sharp they are the vertex normals, to the bit.
    let whole = self::cut(&mesh, &Creases { angle: PI, ..Creases::default() });
    assert_eq!(whole.corners(), mesh.indices);
    for weight in WEIGHTS {
        let expected = vertex_normals_of(&mesh, weight);
        let found = normals(&mesh, &whole, weight);
        assert!(found.iter().zip(&mesh.indices).all(|(normal, &vertex)| *normal == expected[vertex as usize]));
    }
}

#[test]
fn a_cylinder_is_smooth_around_and_sharp_at_its_rims() {
    let mesh = cylinder(24);
    for weight in WEIGHTS {
        let found = normals(&mesh, &cut(&mesh, &Creases::default()), weight);
        for (corner, normal) in found.into_iter().enumerate() {
            let [x, y, z] = mesh.positions[mesh.indices[corner] as usize];
            let expected = match corner {
                0..96 => [x, y, 0.0],
                96..120 => [0.0, 0.0, -1.0],
                _ => [0.0, 0.0, 1.0],
            };
            assert!(largest_difference(normal, expected) < 1e-15, "{weight:?}, corner {corner}: {normal:?}, z {z}");
        }
    }
}

/// The tip of a cone of 16 sides: no edge there is sharper than 30°, so it is one vertex, and its normal the axis. Cut along
/// all its edges, the tip has the normals of the sides.
#[test]
fn the_tip_of_a_cone() {
    let mesh = cone(16);
    let (smooth, sharp) =
        (cut(&mesh, &Creases::default()), cut(&mesh, &Creases { angle: 0.1, ..Creases::default() }));
    for weight in WEIGHTS {
        let (round, split) = (normals(&mesh, &smooth, weight), normals(&mesh, &sharp, weight));
        for side in 0..16 {
            assert!(largest_difference(round[3 * side + 2], [0.0, 0.0, 1.0]) < 1e-15);
            assert!(largest_difference(split[3 * side + 2], face_normal(&mesh, side)) < 1e-15);
        }
    }
    assert_eq!(smooth.origins().len(), 33);
    assert_eq!(sharp.origins().len(), 16 * 3 + 16);
}

/// Three triangles on one edge: nothing joins them, whatever the angles.
#[test]
fn fins_keep_their_own_normals() {
    let positions = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [-1.0, 0.2, 0.0], [0.0, 1.0, 0.5]];
    let mesh = Mesh::new("fins", positions, vec![vec![0, 1, 2], vec![1, 0, 3], vec![0, 1, 4]]);
    let whole = cut(&mesh, &Creases { angle: PI, ..Creases::default() });
    assert_eq!(whole.origins(), [0, 0, 0, 1, 1, 1, 2, 3, 4]);
    for (corner, normal) in normals(&mesh, &whole, Weight::Angle).into_iter().enumerate() {
        assert!(largest_difference(normal, face_normal(&mesh, corner / 3)) < 1e-15);
    }
}

/// A crease of one edge in a smooth part divides nothing; one of two edges divides the vertex in the middle.
#[test]
fn creases_that_end() {
    let mesh = mesh::height_field(12, 0.0, 1);
    let ring = Topology::new(&faces(&mesh), mesh.positions.len()).unwrap();
    let is_inner = |vertex: usize| ring.flags()[vertex] == 0;
    let inner = (0..mesh.positions.len())
        .find(|&vertex| {
            is_inner(vertex)
                && ring.ring(vertex).len() == 6
                && ring.ring(vertex).iter().all(|&n| is_inner(n as usize))
        })
        .unwrap();
    let neighbours = ring.ring(inner);
    let smooth = Creases { angle: PI, ..Creases::default() };
    let one = [[inner as u32, neighbours[0]]];
    assert_eq!(cut(&mesh, &Creases { edges: &one, ..smooth }).corners(), mesh.indices);
    let two = [[inner as u32, neighbours[0]], [neighbours[3], inner as u32]];
    let parts = cut(&mesh, &Creases { edges: &two, ..smooth });
    let twice: Vec<u32> = parts.origins().windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
    assert_eq!(twice, [inner as u32]);
}

/// A roof over a wavy floor: curvature fits on the cut mesh take nothing from beyond the ridge, which one side alone shows.
#[test]
fn fits_stop_at_creases() {
    let side = 14;
    let at = |i: u32, j: u32| i * (side + 1) + j;
    let mut positions = vec![];
    for i in 0..=side {
        for j in 0..=side {
            let (x, y) = (i as f64 - side as f64 / 2.0, j as f64);
            positions.push([x, y, 0.02 * y * y - x.abs()]);
        }
    }
    let quad = |i: u32, j: u32| {
        [vec![at(i, j), at(i + 1, j), at(i + 1, j + 1)], vec![at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    };
    let all: Vec<Vec<u32>> = (0..side).flat_map(|i| (0..side).flat_map(move |j| quad(i, j))).collect();
    let left: Vec<Vec<u32>> = (0..side / 2).flat_map(|i| (0..side).flat_map(move |j| quad(i, j))).collect();
    let (roof, half) = (Mesh::new("roof", positions.clone(), all), Mesh::new("half", positions, left));
    let parts = cut(&roof, &Creases::default());
    let curvature = |topology: &Topology, points: &[Vector]| {
        let mut k1 = vec![0.0f64; points.len()];
        let outputs = CurvatureOutputs { k1: Some(k1.as_mut_slice().into()), ..CurvatureOutputs::default() };
        let options = CurvatureOptions { method: Method::Jet, ..CurvatureOptions::default() };
        curvatures(topology, &points.into(), &options, Run::default(), &outputs).unwrap();
        k1
    };
    let mut points = vec![[0.0; 3]; parts.origins().len()];
    parts.copy(&roof.positions[..].into(), &points.as_mut_slice().into()).unwrap();
    let found = curvature(parts.topology(), &points);
    let alone = curvature(&Topology::new(&faces(&half), half.positions.len()).unwrap(), &half.positions);
    let mut compared = 0;
    for (corner, &vertex) in half.indices.iter().enumerate() {
        // Faces of the left half come first, so its corners are the first of the roof.
        assert_eq!(roof.indices[corner], vertex);
        let (found, alone) = (found[parts.corners()[corner] as usize], alone[vertex as usize]);
        assert_eq!(found.to_bits(), alone.to_bits(), "vertex {vertex}");
        compared += 1;
    }
    assert!(compared > 500);
    let whole = curvature(&Topology::new(&faces(&roof), roof.positions.len()).unwrap(), &roof.positions);
    let ridge = at(side / 2, 5) as usize;
    assert!(whole[ridge].abs() > 10.0 * alone[ridge].abs(), "{} {}", whole[ridge], alone[ridge]);
}

#[test]
fn refusals() {
    let mesh = cube();
    let points = Points::from(&mesh.positions[..]);
    let cut = |creases: &Creases<'_>| CutMesh::new(&faces(&mesh), &points, creases, Run::default()).map(|_| ());
    for angle in [-0.1, f64::NAN, f64::NEG_INFINITY] {
        let expected = Err(Error::OptionOutOfRange { what: "creases.angle" });
        assert_eq!(cut(&Creases { angle, ..Creases::default() }), expected);
    }
    assert_eq!(cut(&Creases { angle: f64::INFINITY, ..Creases::default() }), Ok(()));
    let groups = [1; 5];
    let expected = Err(Error::Size { what: "creases.group_count", found: 5, expected: 6 });
    assert_eq!(cut(&Creases { groups: Some(&groups), ..Creases::default() }), expected);
    let edges = [[0, 1], [2, 8]];
    let expected = Err(Error::IndexOutOfRange { what: "creases.edges", position: 3, index: 8, vertex_count: 8 });
    assert_eq!(cut(&Creases { edges: &edges, ..Creases::default() }), expected);
    let mut spoilt = mesh.positions.clone();
    spoilt[3][1] = f64::INFINITY;
    let found = CutMesh::new(&faces(&mesh), &spoilt[..].into(), &Creases::default(), Run::default());
    assert_eq!(found.map(|_| ()), Err(Error::NonFinitePosition { vertex: 3 }));
}

/// A triangle without area in the edge of a box is no bridge from side to side.
#[test]
fn slivers_on_creases_join_nothing() {
    // A top and a side, whose common edge has a vertex more on the side, and between them what is left of it.
    let positions = vec![
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 0.0, -2.0],
        [2.0, 0.0, -2.0],
    ];
    let faces = vec![vec![0, 1, 4, 3], vec![0, 2, 1], vec![0, 5, 6, 1, 2]];
    let mesh = Mesh::new("sliver", positions, faces);
    let parts = cut(&mesh, &Creases::default());
    for weight in WEIGHTS {
        for (corner, normal) in normals(&mesh, &parts, weight).into_iter().enumerate() {
            if !(4..7).contains(&corner) {
                let expected = if corner < 4 { [0.0, 0.0, 1.0] } else { [0.0, -1.0, 0.0] };
                assert!(largest_difference(normal, expected) < 1e-15, "{weight:?}, corner {corner}: {normal:?}");
            }
        }
    }
}

/// What moves or is computed for a list is found by where the vertices of the cut mesh start.
#[test]
fn lists_take_what_they_need() {
    let mesh = cube();
    let parts = cut(&mesh, &Creases::default());
    assert_eq!(parts.starts().len(), mesh.positions.len() + 1);
    for (vertex, ends) in parts.starts().windows(2).enumerate() {
        assert_eq!(ends[1] - ends[0], 3);
        assert!(parts.origins()[ends[0] as usize..ends[1] as usize].iter().all(|&origin| origin as usize == vertex));
    }
    let of = |positions: &[Vector], vertices: Option<&[u32]>| {
        let mut normal = vec![[7.0; 3]; parts.origins().len()];
        let outputs = CornerOutputs {
            vertex: NormalOutputs { normal: Some(normal.as_mut_slice().into()), ..NormalOutputs::default() },
            ..CornerOutputs::default()
        };
        let run = Run { vertices, ..Run::default() };
        corner_normals(&parts, &positions.into(), Weight::Angle, run, &outputs).map(|()| normal)
    };
    let whole = of(&mesh.positions, None).unwrap();
    let list = [parts.starts()[2], parts.starts()[5]];
    let some = of(&mesh.positions, Some(&list)).unwrap();
    for (vertex, (found, expected)) in some.iter().zip(&whole).enumerate() {
        assert_eq!(found, if list.contains(&(vertex as u32)) { expected } else { &[7.0; 3] });
    }
    assert!(matches!(of(&mesh.positions, Some(&[99])), Err(Error::IndexOutOfRange { .. })));
    // What is not finite is told by the original vertex, wherever a list needs it, and nowhere else.
    for spoilt in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for vertex in 0..8 {
            let mut positions = mesh.positions.clone();
            positions[vertex][1] = spoilt;
            assert_eq!(of(&positions, None), Err(Error::NonFinitePosition { vertex: vertex as u64 }));
            let near = list.map(|at| {
                mesh.faces().zip(0..).any(|(face, number)| {
                    face.contains(&(vertex as u32)) && parts.corners()[4 * number..4 * number + 4].contains(&at)
                })
            });
            let found = of(&positions, Some(&list));
            match near.contains(&true) {
                true => assert_eq!(found, Err(Error::NonFinitePosition { vertex: vertex as u64 })),
                false => assert_eq!(found.as_ref(), Ok(&some)),
            }
        }
    }
}
