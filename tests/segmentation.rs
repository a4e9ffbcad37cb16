//! Segmentations against their definitions, on meshes with every defect; labels, boundaries and sums.

mod common;
use common::Random;
use common::mesh::{self, Mesh};
use common::segment_oracle::{NO_SEGMENT, angle, area_vector, meeting};
use common::solids::{self, renamed};
use std::collections::HashSet;
use std::f64::consts::PI;
use umbilic::{
    Creases, Error, Faces, Points, RegionOptions, Run, ScalarField, Segmentation, ShapeClass, feature_segmentation,
    region_growing, watershed,
};

fn faces(mesh: &Mesh) -> Faces<'_> {
    Faces::polygons(&mesh.indices, &mesh.offsets).unwrap()
}

fn by_creases(mesh: &Mesh, creases: &Creases) -> Segmentation {
    feature_segmentation(&faces(mesh), &Points::from(&mesh.positions), creases, Run::default()).unwrap()
}

fn by_face_heights(mesh: &Mesh, heights: &[f64], depth: f64) -> Segmentation {
    let field = ScalarField::Faces(heights.into());
    watershed(&faces(mesh), mesh.positions.len(), &field, depth, Run::default()).unwrap()
}

fn by_classes(mesh: &Mesh, classes: &[u8], options: &RegionOptions) -> Segmentation {
    region_growing(&faces(mesh), &Points::from(&mesh.positions), &classes.into(), options, Run::default()).unwrap()
}

fn meshes() -> Vec<Mesh> {
    let mut meshes = vec![
        Mesh::new("empty", vec![], vec![]),
        Mesh::new("points", vec![[0.0; 3]; 3], vec![]),
        Mesh::new("ignored", vec![[0.0; 3]; 3], vec![vec![], vec![0], vec![1, 2], vec![1, 1, 2]]),
        mesh::torus(12, 9, 0.4, 0.5, 2),
        mesh::height_field(12, 0.4, 4),
        mesh::letter_prism(),
        solids::holed_box(2).mesh,
        open_book(),
    ];
    for seed in 0..12 {
        meshes.push(mesh::soup(20, 40, 3, seed));
        meshes.push(mesh::soup(14, 30, 7, 50 + seed));
    }
    meshes
}

/// Five pages at one spine, the last two of them bound the wrong way round.
fn open_book() -> Mesh {
    let mut positions = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mut faces = vec![];
    for page in 0..5u32 {
        let angle = page as f64;
        positions.extend([[angle.cos(), angle.sin(), 0.0], [angle.cos(), angle.sin(), 1.0]]);
        let [a, b] = [2 + 2 * page, 3 + 2 * page];
        faces.push(if page < 3 { vec![0, a, b, 1] } else { vec![1, b, a, 0] });
    }
    Mesh::new("book", positions, faces)
}

/// Whether labels are numbered by smallest face, and ignored faces have none.
fn check_labels(mesh: &Mesh, found: &Segmentation) {
    let mut next = 0;
    for &label in found.labels().iter().filter(|&&label| label != NO_SEGMENT) {
        assert!(label <= next, "{}", mesh.name);
        next = next.max(label + 1);
    }
    assert_eq!(found.count(), next as usize, "{}", mesh.name);
    assert_eq!(found.labels().len(), mesh.face_count());
    let meeting = meeting(mesh);
    for (label, neighbours) in found.labels().iter().zip(&meeting.neighbours) {
        assert_eq!(*label == NO_SEGMENT, neighbours.is_none(), "{}", mesh.name);
    }
    assert_eq!(found.boundary_edges(), meeting.boundary(found.labels()), "{}", mesh.name);
}

#[test]
fn creases_bound_what_a_flood_fills() {
    for mesh in meshes() {
        let meeting = meeting(&mesh);
        let mut random = Random::new(3);
        let drawn: Vec<[u32; 2]> = meeting.edges.keys().copied().filter(|_| random.unit() < 0.3).collect();
        let backwards: Vec<[u32; 2]> = drawn.iter().map(|&[a, b]| [b, a]).collect();
        let set: HashSet<[u32; 2]> = drawn.into_iter().collect();
        let groups: Vec<u32> = (0..mesh.face_count()).map(|_| random.below(3) as u32).collect();
        // Angles on triangles only: the normal of a polygon drawn at random may vanish.
        let angles = if mesh.name.starts_with("soup 5") || mesh.name.starts_with("soup 6") {
            vec![PI]
        } else {
            vec![0.0, 0.5, 1.0, 2.0, PI, f64::INFINITY]
        };
        for most in angles {
            for (edges, groups) in [
                (&[][..], None),
                (&backwards[..], None),
                (&[][..], Some(&groups[..])),
                (&backwards[..], Some(&groups[..])),
            ] {
                let found = by_creases(&mesh, &Creases { angle: most, edges, groups });
                let expected = meeting.components(|face, other, edge| {
                    (most >= PI || angle(&mesh, face, other) <= most)
                        && (edges.is_empty() || !set.contains(&edge))
                        && groups.is_none_or(|groups| groups[face] == groups[other] && groups[face] != 0)
                });
                assert_eq!(found.labels(), expected, "{}, {most}", mesh.name);
                check_labels(&mesh, &found);
            }
        }
    }
}

#[test]
fn a_face_without_area_joins_nothing() {
    // Two squares at a right angle, with a triangle of no area in the crease: along two edges of it on one side, one on the other.
    let positions = vec![
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, -1.0],
        [2.0, 0.0, -1.0],
    ];
    let bent = Mesh::new("bent", positions, vec![vec![0, 1, 2], vec![0, 2, 3, 4], vec![5, 6, 2, 1, 0]]);
    let triangles =
        [[0, 1, 2], [0, 2, 4], [2, 3, 4], [1, 0, 5], [2, 1, 5], [2, 5, 6]].map(|face| face.to_vec()).to_vec();
    // The sliver goes with the face at its longest edge, which its other edges part from the other square.
    for mesh in [bent.clone(), bent.with_faces(triangles)] {
        let found = by_creases(&mesh, &Creases::default());
        assert_eq!(found.count(), 2, "{:?}", found.labels());
        assert_eq!(found.labels()[0], found.labels()[1], "{:?}", found.labels());
        check_labels(&mesh, &found);
        let flat = mesh.mapped(|[x, y, z]| [x, y + z, 0.0]);
        assert_eq!(by_creases(&flat, &Creases::default()).count(), 1);
    }
    // Nothing has an area.
    let line = bent.mapped(|[x, _, _]| [x, 0.0, 0.0]);
    check_labels(&line, &by_creases(&line, &Creases::default()));
    check_labels(&line, &by_classes(&line, &[4; 7], &RegionOptions::default()));
}

#[test]
fn water_finds_the_basins() {
    for mesh in meshes() {
        let meeting = meeting(&mesh);
        for (seed, steps) in [(1, 2), (2, 4), (3, 10), (4, 1000)] {
            let mut random = Random::new(seed);
            // Few steps make plateaus, and both zeros.
            let heights: Vec<f64> =
                (0..mesh.face_count()).map(|_| random.below(steps) as f64 * [1.0, -1.0][random.below(2)]).collect();
            for depth in [0.0, 1.0, 2.0, 5.0, 300.0, f64::INFINITY] {
                let found = by_face_heights(&mesh, &heights, depth);
                assert_eq!(found.labels(), meeting.watershed(&heights, depth), "{}, {steps}, {depth}", mesh.name);
                assert_eq!(found.count(), meeting.basin_count(&heights, depth), "{}, {steps}, {depth}", mesh.name);
                check_labels(&mesh, &found);
            }
        }
    }
}

#[test]
fn plateaus_are_whole_and_depth_is_exclusive() {
    let mesh = solids::cuboid(6).triangles(1).mesh;
    for value in [0.1, -3.7, f64::MAX] {
        let field = vec![value; mesh.positions.len()];
        let found =
            watershed(&faces(&mesh), field.len(), &ScalarField::Vertices((&field).into()), 0.0, Run::default());
        assert_eq!(found.unwrap().count(), 1);
    }
    // A strip of quads, with a wall of height 2 between a floor at 0 and one at 1.
    let positions = (0..10).flat_map(|x| [[x as f64, 0.0, 0.0], [x as f64, 1.0, 0.0]]).collect();
    let strip = Mesh::new("strip", positions, (0..9).map(|x| vec![2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1]).collect());
    let heights = [0.0, 0.0, 2.0, 2.0, 2.0, 2.0, 2.0, 1.0, 1.0];
    assert_eq!(by_face_heights(&strip, &heights, 1.0).labels(), [0, 0, 0, 0, 0, 1, 1, 1, 1]);
    assert_eq!(by_face_heights(&strip, &heights, 1.0 + f64::EPSILON).count(), 1);
    // The difference of heights leaves the range.
    let huge = heights.map(|height| (height - 1.0) * f64::MAX);
    assert_eq!(by_face_heights(&strip, &huge, f64::MAX).count(), 2);
    assert_eq!(by_face_heights(&strip, &huge, f64::INFINITY).count(), 1);
    // A vertex counts for its faces by their mean: here the wall is a line of vertices.
    let field: Vec<f64> = (0..20).map(|v| if v / 2 == 4 { 1.0 } else { 0.0 }).collect();
    let at_vertices = |depth| {
        let field = ScalarField::Vertices((&field).into());
        watershed(&faces(&strip), 20, &field, depth, Run::default()).unwrap().labels().to_vec()
    };
    assert_eq!(at_vertices(0.5), [0, 0, 0, 0, 1, 1, 1, 1, 1]);
    assert_eq!(at_vertices(0.51), [0; 9]);
}

#[test]
fn regions_by_class_angle_and_size() {
    // A strip of ten quads whose corners are flat, then ridges, with one peak in a corner of the flat part.
    let positions = (0..11).flat_map(|x| [[x as f64, 0.0, 0.0], [x as f64, 1.0, 0.0]]).collect();
    let strip =
        Mesh::new("strip", positions, (0..10).map(|x| vec![2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1]).collect());
    let class = |v: usize| {
        if v == 3 {
            ShapeClass::Peak
        } else if v < 12 {
            ShapeClass::Flat
        } else {
            ShapeClass::Ridge
        }
    };
    let classes: Vec<u8> = (0..22).map(|v| class(v) as u8).collect();
    let all = RegionOptions { smallest_share: 0.0, ..Default::default() };
    // The fifth face is not sure, and all normals are equal: the lower one of its edges decides.
    assert_eq!(by_classes(&strip, &classes, &all).labels(), [0, 0, 0, 0, 0, 0, 1, 1, 1, 1]);
    // With a kink on one side of it, it goes with the other.
    let kinked = strip.mapped(|[x, y, _]| [x, y, (x - 5.0).max(0.0) * 0.1]);
    assert_eq!(by_classes(&kinked, &classes, &all).labels(), [0, 0, 0, 0, 0, 1, 1, 1, 1, 1]);
    let sharp = strip.mapped(|[x, y, _]| [x, y, (x - 8.0).max(0.0)]);
    assert_eq!(by_classes(&sharp, &classes, &all).count(), 3);
    assert_eq!(
        by_classes(&sharp, &classes, &RegionOptions { creases: Creases { angle: 1.0, ..Default::default() }, ..all })
            .count(),
        2
    );
    assert_eq!(by_classes(&sharp, &classes, &RegionOptions { smallest_faces: 2, ..all }).count(), 3);
    // A smooth neighbour of another class comes before one of the same class across a crease.
    let sharp = strip.mapped(|[x, y, _]| [x, y, (x - 7.0).max(0.0)]);
    let found = by_classes(&sharp, &classes, &RegionOptions { smallest_faces: 2, ..all });
    assert_eq!(found.labels(), [0, 0, 0, 0, 0, 0, 0, 1, 1, 1]);
    let share = |smallest_share| by_classes(&strip, &classes, &RegionOptions { smallest_share, ..all }).count();
    assert_eq!((share(0.4), share(0.41), share(1.0)), (2, 1, 1));
    // What nobody knows goes with what is known.
    assert_eq!(by_classes(&strip, &[0; 22], &all).count(), 1);
    let some: Vec<u8> = classes.iter().enumerate().map(|(v, &class)| if v < 18 { 0 } else { class }).collect();
    assert_eq!(by_classes(&strip, &some, &all).count(), 1);
    for mesh in meshes() {
        let mut random = Random::new(1);
        let classes: Vec<u8> = mesh.positions.iter().map(|_| random.below(9) as u8).collect();
        for smallest_faces in [0, 2, 5, 1000] {
            let found = by_classes(
                &mesh,
                &classes,
                &RegionOptions { smallest_faces, creases: Creases { angle: 0.5, ..Default::default() }, ..all },
            );
            check_labels(&mesh, &found);
            // Whoever has a neighbour is not too small.
            let whole = by_creases(&mesh, &Creases { angle: PI, ..Default::default() });
            let mut sizes = vec![0; found.count()];
            found.labels().iter().filter(|&&l| l != NO_SEGMENT).for_each(|&l| sizes[l as usize] += 1);
            for (face, &label) in found.labels().iter().enumerate().filter(|&(_, &label)| label != NO_SEGMENT) {
                let piece = whole.labels().iter().filter(|&&other| other == whole.labels()[face]).count();
                assert!(sizes[label as usize] >= smallest_faces.min(piece), "{}", mesh.name);
            }
        }
    }
}

#[test]
fn areas_and_means() {
    for mesh in meshes() {
        for scale in [1.0, 1e200, 1e-200] {
            let mesh = mesh.mapped(|p| p.map(|x| x * scale));
            let found = by_creases(&mesh, &Creases::default());
            let (faces, points) = (faces(&mesh), Points::from(&mesh.positions));
            let area = |face: usize| {
                let vector = area_vector(&mesh.mapped(|p| p.map(|x| x / scale)), face);
                common::length(vector)
            };
            let areas = found.areas(&faces, &points).unwrap();
            let field: Vec<f64> = mesh.positions.iter().map(|p| p[0] / scale + 2.0).collect();
            let means = found.means(&faces, &points, &ScalarField::Vertices((&field).into())).unwrap();
            let ones = vec![1.0f32; mesh.face_count()];
            let one = found.means(&faces, &points, &ScalarField::Faces((&ones).into())).unwrap();
            for label in 0..found.count() {
                let of = |face: &usize| found.labels()[*face] == label as u32;
                let all: Vec<usize> = (0..mesh.face_count()).filter(of).collect();
                let sum: f64 = all.iter().map(|&face| area(face)).sum();
                let expected = (sum * scale * scale).min(f64::MAX);
                assert!((areas[label] - expected).abs() <= 1e-12 * expected.max(scale * scale), "{}", mesh.name);
                let corner = |face: usize| {
                    let corners = mesh.face(face);
                    corners.iter().map(|&v| field[v as usize]).sum::<f64>() / corners.len() as f64
                };
                if sum > 1e-9 {
                    let mean = all.iter().map(|&face| area(face) * corner(face)).sum::<f64>() / sum;
                    assert!((means[label] - mean).abs() < 1e-9, "{}", mesh.name);
                }
                assert!((one[label] - 1.0).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn numbers_of_vertices_and_threads_change_nothing() {
    for mesh in meshes() {
        let (mut random, count) = (Random::new(9), mesh.positions.len());
        let mut places: Vec<u32> = (0..count as u32).collect();
        (1..count).for_each(|v| places.swap(v, random.below(v + 1)));
        let mut moved = mesh.clone();
        for (v, &place) in places.iter().enumerate() {
            moved.positions[place as usize] = mesh.positions[v];
        }
        moved.indices.iter_mut().for_each(|v| *v = places[*v as usize]);
        let field: Vec<f64> = (0..count).map(|_| random.unit()).collect();
        let classes: Vec<u8> = (0..count).map(|_| 1 + random.below(3) as u8).collect();
        let (mut moved_field, mut moved_classes) = (field.clone(), classes.clone());
        for (v, &place) in places.iter().enumerate() {
            (moved_field[place as usize], moved_classes[place as usize]) = (field[v], classes[v]);
        }
        let run = |threads| Run { threads, ..Run::default() };
        let all = |mesh: &Mesh, field: &[f64], classes: &[u8], threads| {
            let (faces, points) = (faces(mesh), Points::from(&mesh.positions));
            [
                feature_segmentation(&faces, &points, &Creases::default(), run(threads)),
                watershed(&faces, count, &ScalarField::Vertices(field.into()), 0.1, run(threads)),
                region_growing(&faces, &points, &classes.into(), &RegionOptions::default(), run(threads)),
            ]
            .map(|found| found.unwrap().labels().iter().map(|&label| label as usize).collect::<Vec<_>>())
        };
        let expected = all(&mesh, &field, &classes, 1);
        assert_eq!(
            all(&moved, &moved_field, &moved_classes, 1).map(|labels| renamed(&labels)),
            expected.clone().map(|labels| renamed(&labels))
        );
        for threads in [2, 3, 8, 0] {
            assert_eq!(all(&mesh, &field, &classes, threads), expected, "{}", mesh.name);
        }
    }
}

#[test]
fn what_is_refused() {
    let mesh = mesh::torus(6, 5, 0.0, 0.0, 1);
    let (all, points, count) = (faces(&mesh), Points::from(&mesh.positions), mesh.positions.len());
    let creases =
        |angle| feature_segmentation(&all, &points, &Creases { angle, ..Default::default() }, Run::default());
    for angle in [-1e-9, f64::NAN] {
        assert_eq!(creases(angle).unwrap_err(), Error::OptionOutOfRange { what: "creases.angle" });
    }
    let mut heights = vec![0.0; count];
    let flood = |heights: &[f64], depth| {
        watershed(&all, count, &ScalarField::Vertices(heights.into()), depth, Run::default())
    };
    assert_eq!(flood(&heights, -1.0).unwrap_err(), Error::OptionOutOfRange { what: "depth" });
    assert_eq!(flood(&heights, f64::NAN).unwrap_err(), Error::OptionOutOfRange { what: "depth" });
    assert!(matches!(flood(&heights[1..], 0.0).unwrap_err(), Error::Size { what: "height", .. }));
    heights[7] = f64::NAN;
    assert_eq!(flood(&heights, 0.0).unwrap_err(), Error::NonFiniteScalar { what: "height", index: 7 });
    assert!(matches!(
        watershed(&all, 3, &ScalarField::Vertices((&heights[..3]).into()), 0.0, Run::default()),
        Err(Error::IndexOutOfRange { .. })
    ));
    let grow = |classes: &[u8], options: &RegionOptions| {
        region_growing(&all, &points, &classes.into(), options, Run::default()).unwrap_err()
    };
    let plain = RegionOptions::default();
    assert_eq!(grow(&vec![9; count], &plain), Error::UnknownConstant { what: "classes", value: 9 });
    assert!(matches!(grow(&vec![1; count + 1], &plain), Error::Size { .. }));
    for share in [-0.1, 1.1, f64::NAN] {
        let options = RegionOptions { smallest_share: share, ..plain };
        assert_eq!(grow(&vec![1; count], &options), Error::OptionOutOfRange { what: "smallest_share" });
    }
    let mut broken = mesh.clone();
    broken.positions[4][1] = f64::INFINITY;
    let found = feature_segmentation(&all, &Points::from(&broken.positions), &Creases::default(), Run::default());
    assert_eq!(found.unwrap_err(), Error::NonFinitePosition { vertex: 4 });
    let found = by_creases(&mesh, &Creases::default());
    assert!(matches!(found.areas(&all, &Points::from(&mesh.positions[1..])), Err(Error::Size { .. })));
    assert!(matches!(found.areas(&faces(&mesh::torus(6, 4, 0.0, 0.0, 1)), &points), Err(Error::Size { .. })));
    assert!(matches!(found.means(&all, &points, &ScalarField::Faces((&heights).into())), Err(Error::Size { .. })));
}

#[test]
fn progress_rises_and_cancels() {
    let mesh = mesh::torus(6, 5, 0.0, 0.0, 1);
    let (all, points, count) = (faces(&mesh), Points::from(&mesh.positions), mesh.positions.len());
    let (heights, classes) = (vec![0.0; count], vec![4; count]);
    for kind in 0..3 {
        let call = |progress: &mut dyn FnMut(f64) -> bool| {
            let run = Run { progress: Some(progress), ..Run::default() };
            match kind {
                0 => feature_segmentation(&all, &points, &Creases::default(), run),
                1 => watershed(&all, count, &ScalarField::Vertices((&heights).into()), 0.0, run),
                _ => region_growing(&all, &points, &(&classes).into(), &RegionOptions::default(), run),
            }
        };
        let mut seen = vec![];
        call(&mut |fraction| {
            seen.push(fraction);
            true
        })
        .unwrap();
        assert!(seen.is_sorted() && seen.last() == Some(&1.0) && seen.len() > 2, "{seen:?}");
        for stop in 0..seen.len() {
            let mut calls = 0;
            let found = call(&mut |_| {
                calls += 1;
                calls <= stop
            });
            let last = stop == seen.len() - 1;
            assert_eq!(found.err(), if last { None } else { Some(Error::Cancelled) });
        }
    }
}
