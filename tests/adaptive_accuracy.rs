//! What adaptive jets come to where others fail: creases, spikes, noise in places, parts of very different sizes, edges of very
//! different lengths, meshes of a handful of vertices. Bounds have room: what was measured stands beside them.

mod common;
use common::adaptive::{Fitted, fitted, jets, of_method, topology};
use common::bodies::{self, Cube, Cylinder};
use common::mesh::{self, Mesh};
use common::{Vector, add, cross, dot, length, scale, sub};
use umbilic::*;

type Exact = (Vector, [f64; 2]);

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    values.for_each(|x| (sum, count) = (sum + x * x, count + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}

fn degrees(a: Vector, b: Vector) -> f64 {
    length(cross(a, b)).atan2(dot(a, b)).to_degrees()
}

/// The RMS errors of normals, in degrees, and of both curvatures, by the RMS curvature, where `keep` says; an error counts as at most
/// three times that.
fn errors(found: &Fitted, exact: &[Exact], keep: impl Fn(usize) -> bool) -> [f64; 2] {
    let unit = rms(exact.iter().flat_map(|(_, k)| *k));
    let kept: Vec<usize> = (0..exact.len()).filter(|&vertex| keep(vertex)).collect();
    let curvature = |&v: &usize| [found.k1[v] - exact[v].1[0], found.k2[v] - exact[v].1[1]];
    [
        rms(kept.iter().map(|&v| degrees(found.normal[v], exact[v].0))),
        rms(kept.iter().flat_map(curvature).map(|error| (error / unit).clamp(-3.0, 3.0))),
    ]
}

fn normals(exact: &[Exact]) -> Vec<Vector> {
    exact.iter().map(|(normal, _)| *normal).collect()
}

fn plain_jet(mesh: &Mesh, degree: u8, rings: usize) -> Fitted {
    let options = CurvatureOptions { method: Method::Jet, degree, rings, ..CurvatureOptions::default() };
    fitted(&topology(mesh), &Points::from(&mesh.positions), &options, Run::default(), 0.0).unwrap()
}

fn interior(mesh: &Mesh) -> Vec<bool> {
    topology(mesh).flags().iter().map(|flags| flags & status::BOUNDARY == 0).collect()
}

/// Some smooth meshes of about 1600 vertices with what is exact on them.
fn smooth(seed: u64) -> Vec<(Mesh, Vec<Exact>)> {
    let torus = mesh::torus(64, 25, 0.3, 0.0, seed);
    let field = bodies::height_grid(&(0..40).map(|i| 2.4 * i as f64 / 39.0 - 1.2).collect::<Vec<_>>(), seed);
    let axes = [1.0, 1.5, 2.2];
    let ellipsoid = bodies::random_sphere(500, seed).mapped(|p| std::array::from_fn(|k| p[k] * axes[k]));
    let exact = |mesh: &Mesh, of: &dyn Fn(Vector) -> Exact| mesh.positions.iter().map(|&p| of(p)).collect();
    let all = [exact(&torus, &bodies::exact_torus), exact(&field, &bodies::exact_height)];
    let of_ellipsoid = exact(&ellipsoid, &|p| bodies::exact_ellipsoid(axes, p));
    [torus, field, ellipsoid].into_iter().zip(all.into_iter().chain([of_ellipsoid])).collect()
}

#[test]
fn the_smallest_closed_meshes_have_the_curvature_of_their_sphere() {
    let octahedron: Vec<Vector> =
        (0..6).map(|i| std::array::from_fn(|k| if i / 2 == k { [1.0, -1.0][i % 2] } else { 0.0 })).collect();
    let octahedron = Mesh { name: "octahedron".into(), ..bodies::hull(octahedron) };
    for mesh in [mesh::tetrahedron_sphere(0), octahedron, mesh::quad_sphere(1, 0.0, 1)] {
        // Of any size and wherever it looks.
        let turn = common::linear::rotation(5);
        for (size, turned) in [(1.0, false), (1.0, true), (1e-6, true), (3e7, true)] {
            let turned_or_not = |p| if turned { common::linear::times(&turn, p) } else { p };
            let mesh = mesh.mapped(|p| scale(turned_or_not(p), size));
            let found = jets(&mesh, None, 0);
            for (v, &p) in mesh.positions.iter().enumerate() {
                let off = [found.k1[v], found.k2[v], found.mean[v]].map(|k| (k * size - 1.0).abs());
                assert!(off.iter().all(|off| *off < 1e-6), "{}, vertex {v}: {off:?}", mesh.name);
                assert!(degrees(found.normal[v], p) < 1e-5, "{}, vertex {v}", mesh.name);
            }
        }
    }
    // Random points, which make some sharp places.
    for count in [12, 20, 50] {
        for seed in 0..5 {
            let mesh = bodies::random_sphere(count, seed);
            let found = jets(&mesh, None, 0);
            let what = format!("{count} points, seed {seed}");
            let off: Vec<f64> = found.mean.iter().map(|h| 1.0 - h).collect();
            assert!(
                off.iter().all(|off| (-1e-3..0.06).contains(off)) && rms(off.iter().copied()) < 0.02,
                "{what}: {off:?}"
            );
            let turns: Vec<f64> = mesh.positions.iter().zip(&found.normal).map(|(p, n)| degrees(*p, *n)).collect();
            assert!(turns.iter().all(|turn| *turn < 3.0) && rms(turns.iter().copied()) < 0.6, "{what}: {turns:?}");
        }
    }
}

#[test]
fn creases_are_told_and_have_the_bisector_and_one_curvature_along_them() {
    for noise in [0.0, 0.02, 0.05] {
        let Cube { mesh: cube, normals: of_cube, sides } = bodies::cube(16, 0.25, 1);
        let Cylinder { mesh: cylinder, normals: of_cylinder, rim } = bodies::capped_cylinder(48, 2);
        let on_rim: [Vec<usize>; 2] =
            [(0..sides.len()).filter(|&v| sides[v] == 2).collect(), (0..rim.len()).filter(|&v| rim[v]).collect()];
        let off_rim: [Vec<usize>; 2] =
            [(0..sides.len()).filter(|&v| sides[v] == 1).collect(), (0..rim.len()).filter(|&v| !rim[v]).collect()];
        for (index, (mesh, normals)) in [(cube, of_cube), (cylinder, of_cylinder)].into_iter().enumerate() {
            let mesh = bodies::noisy(&mesh, &normals, noise, 3);
            let edge = bodies::mean_edge(&mesh);
            let found = jets(&mesh, None, 0);
            let flagged = |list: &[usize], bits: u8| list.iter().filter(|&&v| found.status[v] & bits == bits).count();
            let (on, off) = (&on_rim[index], &off_rim[index]);
            let normal = |list: &[usize]| rms(list.iter().map(|&v| degrees(found.normal[v], normals[v])));
            let mean: Vec<f64> = on.iter().map(|&v| found.mean[v] * edge).collect();
            let average = mean.iter().sum::<f64>() / mean.len() as f64;
            let near = mean.iter().filter(|&&h| (h / average - 1.0).abs() < 0.25).count();
            let creased = flagged(on, status::CREASE | status::FALLBACK);
            println!(
                "{}: rim {} of which sharp {} creased {creased} N {} H {average} sd {} near {near} range {:?}; faces {} sharp {} N {}",
                mesh.name,
                on.len(),
                flagged(on, status::CREASE),
                normal(on),
                rms(mean.iter().map(|h| h - average)) / average,
                mean.iter().fold((9.0f64, 0.0f64), |(l, m), &h| (l.min(h), m.max(h))),
                off.len(),
                flagged(off, status::CREASE),
                normal(off)
            );
            assert!(flagged(on, status::CREASE) * 100 >= on.len() * 85, "{}", mesh.name);
            assert!(creased * 100 >= on.len() * 85, "{}", mesh.name);
            assert_eq!(flagged(off, status::CREASE | status::FALLBACK), 0, "{}", mesh.name);
            // The middle of a cap has triangles that noise of the mean edge bends a lot.
            assert!(flagged(off, status::CREASE) == 0 || noise > 0.04, "{}", mesh.name);
            // Half a degree for each percent of noise, measured: 0.6 °.
            assert!(normal(on) < 2.0 + 100.0 * noise && normal(off) < 0.1 + 8.0 * noise, "{}", mesh.name);
            assert!(near * 10 >= 9 * mean.len(), "{}: {near} of {}", mesh.name, mean.len());
        }
    }
}

#[test]
fn spikes_do_not_spoil_their_surroundings() {
    for (mesh, exact) in smooth(1) {
        for noise in [0.0, 0.02] {
            let quiet = if noise > 0.0 { bodies::noisy(&mesh, &normals(&exact), noise, 2) } else { mesh.clone() };
            let spikes = bodies::some_apart(&quiet, 100, 3);
            let spiked = bodies::spiked(&quiet, &normals(&exact), &spikes, 3.0);
            assert!(spikes.len() * 120 > mesh.positions.len(), "{}", mesh.name);
            let inside = interior(&mesh);
            let good = |v: usize| inside[v] && !spikes.contains(&v);
            let before = errors(&jets(&quiet, None, 0), &exact, good);
            let after = errors(&jets(&spiked, None, 0), &exact, good);
            let plain = errors(&plain_jet(&spiked, 2, 2), &exact, good);
            assert!(
                after[0] < 2.0 * before[0] + 0.3 && after[1] < 2.0 * before[1] + 0.02,
                "{}: {after:?}",
                spiked.name
            );
            assert!(after[0] < 0.2 * plain[0] && after[1] < 0.2 * plain[1], "{}", spiked.name);
        }
    }
}

#[test]
fn noise_in_one_half_leaves_the_other_alone() {
    for (mesh, exact) in smooth(2) {
        let half: Vec<Vector> =
            exact.iter().zip(&mesh.positions).map(|((n, _), p)| scale(*n, f64::from(u8::from(p[0] > 0.0)))).collect();
        let noisy = bodies::noisy(&mesh, &half, 0.05, 4);
        let inside = interior(&mesh);
        let [loud, quiet] = [true, false].map(|loud| {
            let keep = |v: usize| inside[v] && (mesh.positions[v][0] > 0.0) == loud;
            [errors(&jets(&noisy, None, 0), &exact, keep), errors(&plain_jet(&noisy, 3, 3), &exact, keep)]
        });
        assert!(loud[0][0] < 0.6 * loud[1][0] && loud[0][1] < 0.7 * loud[1][1], "{}: {loud:?}", mesh.name);
        assert!(quiet[0][0] < quiet[1][0] && quiet[0][1] < 1.3 * quiet[1][1], "{}: {quiet:?}", mesh.name);
    }
}

#[test]
fn parts_of_very_different_sizes_are_fitted_as_if_alone() {
    let (mesh, exact) = smooth(3).pop().unwrap();
    let large = bodies::noisy(&mesh, &normals(&exact), 0.02, 5);
    let count = large.positions.len();
    let small = large.positions.iter().map(|&p| add(scale(p, 1e-3), [10.0, 0.0, 0.0]));
    let faces = large.face_vectors();
    let shifted = faces.iter().map(|face| face.iter().map(|v| v + count as u32).collect());
    let both = Mesh::new(
        "1 and 1000",
        large.positions.iter().copied().chain(small).collect(),
        faces.iter().cloned().chain(shifted).collect(),
    );
    let (alone, found) = (errors(&jets(&large, None, 0), &exact, |_| true), jets(&both, None, 0));
    let mut part = found.clone();
    let first = errors(&found, &exact, |_| true);
    part.normal.drain(..count);
    [&mut part.k1, &mut part.k2].into_iter().for_each(|k| {
        k.drain(..count);
        k.iter_mut().for_each(|k| *k *= 1e-3);
    });
    let second = errors(&part, &exact, |_| true);
    for errors in [first, second] {
        assert!(errors[0] < 1.4 * alone[0] && errors[1] < 1.4 * alone[1], "{alone:?} {first:?} {second:?}");
    }
    // They are told apart by how noise and sizes go with the edges.
    assert!((first[0] / second[0] - 1.0).abs() < 1e-3);
}

#[test]
fn graded_meshes_are_fitted_at_least_as_well_as_by_the_best_of_five_jets() {
    for ratio in [10.0, 100.0, 1000.0] {
        let clean = bodies::height_grid(&bodies::graded(50, ratio), 6);
        let exact: Vec<Exact> = clean.positions.iter().map(|&p| bodies::exact_height(p)).collect();
        let inside = interior(&clean);
        // Noise by the shortest edge at a vertex, and the same everywhere.
        let mut local = vec![f64::INFINITY; exact.len()];
        for face in clean.faces() {
            for (&a, &b) in face.iter().zip(face.iter().cycle().skip(1)) {
                let edge = length(sub(clean.positions[a as usize], clean.positions[b as usize]));
                [a, b].into_iter().for_each(|v| local[v as usize] = edge.min(local[v as usize]));
            }
        }
        let mean = bodies::mean_edge(&clean);
        let with = |size: &dyn Fn(usize) -> f64| {
            let directions: Vec<Vector> =
                exact.iter().enumerate().map(|(v, (n, _))| scale(*n, size(v) / mean)).collect();
            bodies::noisy(&clean, &directions, 0.02, 7)
        };
        let shortest = local.iter().fold(f64::INFINITY, |least, &x| least.min(x));
        for (kind, mesh) in
            [("clean", clean.clone()), ("local", with(&|v| local[v])), ("absolute", with(&|_| shortest))]
        {
            let found = jets(&mesh, None, 0);
            let others =
                [(2, 2), (3, 2), (3, 3), (4, 2), (4, 3)].map(|(degree, rings)| plain_jet(&mesh, degree, rings));
            for zone in 0..3 {
                let side = 50;
                let keep = |v: usize| inside[v] && ((v / side + v % side) * 3 / (2 * side - 1)) == zone;
                let own = errors(&found, &exact, keep);
                let best = others
                    .iter()
                    .map(|other| errors(other, &exact, keep))
                    .reduce(|a, b| if a[1] < b[1] { a } else { b });
                let best = best.unwrap();
                assert!(
                    own[1] < 1e-3 + 0.9 * best[1] && own[0] < 1e-2 + best[0],
                    "{ratio}:1, {kind}, zone {zone}: {own:?}, {best:?}"
                );
            }
        }
    }
}

#[test]
fn tilted_sections_are_better_than_max_and_circles_on_one_ring() {
    for (mesh, exact) in smooth(4) {
        let inside = interior(&mesh);
        let tilted = errors(&of_method(&mesh, Method::TiltedSections), &exact, |v| inside[v]);
        let options = CurvatureOptions {
            method: Method::LeastSquares,
            section: Section::Circle,
            normals: VertexNormals::Computed(Weight::Max),
            ..CurvatureOptions::default()
        };
        let max = fitted(&topology(&mesh), &Points::from(&mesh.positions), &options, Run::default(), 0.0).unwrap();
        let max = errors(&max, &exact, |v| inside[v]);
        assert!(tilted[0] < 0.85 * max[0] && tilted[1] < 0.85 * max[1], "{}: {tilted:?}, {max:?}", mesh.name);
    }
}
