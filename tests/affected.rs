//! Results that are brought up to date after vertices have moved are those of a call for all, bit for bit; and no more is computed than
//! what may have changed.

#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{ALL, Handle, message, output, points, zeroed};
use common::curvature::{Found, METHODS, Out, options};
use common::mesh::{self, Mesh};
use common::{Random, bodies};
use std::collections::BTreeSet;
use umbilic::capi::*;

fn meshes() -> Vec<Mesh> {
    vec![
        mesh::torus(16, 11, 0.4, 0.0, 1),
        mesh::torus(13, 9, 0.3, 0.6, 2),
        mesh::height_field(13, 0.0, 3),
        mesh::fan(90, true, 5),
        mesh::letter_prism(),
        bodies::cube(5, 0.2, 6).mesh,
        mesh::ring_sphere(9, 14),
        mesh::soup(40, 60, 3, 7),
        mesh::soup(40, 40, 6, 8),
    ]
}

/// What is kept up to date.
#[derive(Clone, Copy)]
enum Asked {
    Normals(umb_normal_options),
    Curvatures(umb_curvature_options),
}

impl Asked {
    fn run(&mut self) -> &mut umb_run {
        match self {
            Asked::Normals(options) => &mut options.run,
            Asked::Curvatures(options) => &mut options.run,
        }
    }

    /// The method's, or the weight's, and the rings: for messages.
    fn name(&self) -> String {
        match self {
            Asked::Normals(options) => format!("weight {}, rings {}", options.weight, options.rings),
            Asked::Curvatures(options) => {
                format!("method {}, rings {}, weight {}", options.method, options.rings, options.weight)
            }
        }
    }
}

/// All weights and methods, with several numbers of rings and weights of the normals that methods take.
fn all(model: *const umb_adaptive_model) -> Vec<Asked> {
    let mut all = vec![];
    for weight in ALL.into_iter().chain([UMB_WEIGHT_ADAPTIVE_JET, UMB_WEIGHT_TILTED_SECTIONS]) {
        let several = matches!(weight, UMB_WEIGHT_JET | UMB_WEIGHT_ADAPTIVE_JET);
        for rings in if several { vec![0, 1, 3] } else { vec![0] } {
            let mut options: umb_normal_options = zeroed();
            (options.weight, options.rings, options.model) = (weight, rings, model);
            all.push(Asked::Normals(options));
        }
    }
    for method in METHODS {
        let several = matches!(
            method,
            UMB_CURVATURE_ADAPTIVE_JET
                | UMB_CURVATURE_JET
                | UMB_CURVATURE_QUADRIC
                | UMB_CURVATURE_GOLDFEATHER
                | UMB_CURVATURE_NORMAL_CYCLE
                | UMB_CURVATURE_CORRECTED_MEASURE
        );
        for rings in if several { vec![0, 1, 2] } else { vec![0] } {
            for weight in [UMB_WEIGHT_CONFORMAL, UMB_WEIGHT_JET, UMB_WEIGHT_ADAPTIVE_JET] {
                let mut options = options(method);
                (options.rings, options.weight, options.model) = (rings, weight, model);
                all.push(Asked::Curvatures(options));
            }
        }
    }
    all
}

/// The results of a mesh, normals or curvatures.
struct State(Found);

impl State {
    fn new(asked: &Asked, count: usize) -> State {
        match asked {
            Asked::Normals(_) => State(Found::new(0, count, |output| output == Out::Normal, 7.0)),
            Asked::Curvatures(options) => {
                State(Found::new(options.method, count, |output| output.is_of(options.method), 7.0))
            }
        }
    }

    fn compute(&mut self, handle: &Handle, positions: &[[f64; 3]], asked: &Asked) {
        let mut error: umb_error = zeroed();
        let at = points(positions);
        let status = match asked {
            Asked::Normals(options) => {
                let mut outputs: umb_normal_outputs = zeroed();
                outputs.normal = output(self.0.values[Out::Normal as usize].as_chunks_mut::<3>().0);
                outputs.status = umb_status_output { data: self.0.status.as_mut_ptr(), stride: 0 };
                unsafe { umb_vertex_normals(handle.0, &at, options, &outputs, &mut error) }
            }
            Asked::Curvatures(options) => {
                let outputs = self.0.outputs();
                unsafe { umb_curvatures(handle.0, &at, options, &outputs, &mut error) }
            }
        };
        assert_eq!(status, UMB_OK, "{}: {}", asked.name(), message(&error));
    }
}

fn affected(handle: &Handle, count: usize, moved: &umb_moved, asked: &Asked) -> Result<Vec<u32>, umb_status> {
    let (mut list, mut length) = (vec![u32::MAX; count], usize::MAX);
    let (data, at) = (list.as_mut_ptr(), &raw mut length);
    let mut error: umb_error = zeroed();
    let status = match asked {
        Asked::Normals(options) => unsafe {
            umb_affected_normals(handle.0, moved, options, data, count, at, &mut error)
        },
        Asked::Curvatures(options) => unsafe {
            umb_affected_curvatures(handle.0, moved, options, data, count, at, &mut error)
        },
    };
    if status != UMB_OK {
        assert!(list.iter().all(|&vertex| vertex == u32::MAX) && length == usize::MAX);
        return Err(status);
    }
    list.truncate(length);
    Ok(list)
}

fn moved_of(list: &[u32], status: Option<&[u8]>) -> umb_moved {
    umb_moved {
        struct_size: size_of::<umb_moved>() as u32,
        reserved: 0,
        vertices: list.as_ptr(),
        vertex_count: list.len(),
        status: umb_bytes {
            data: status.map_or(std::ptr::null(), <[u8]>::as_ptr),
            count: status.map_or(0, <[u8]>::len),
            stride: 0,
        },
    }
}

fn learnt(handle: &Handle, positions: &[[f64; 3]]) -> umb_adaptive_model {
    let (mut model, mut error): (umb_adaptive_model, umb_error) = (zeroed(), zeroed());
    let status = unsafe { umb_learn_model(handle.0, &points(positions), std::ptr::null(), &mut model, &mut error) };
    assert_eq!(status, UMB_OK, "{}", message(&error));
    model
}

/// A few vertices, once or twice, at new places: near, far, in line with others, or on top of another.
fn moves(random: &mut Random, positions: &mut [[f64; 3]]) -> Vec<u32> {
    let count = positions.len();
    let mut list: Vec<u32> = vec![];
    for _ in 0..1 + random.below(3) {
        let vertex = random.below(count);
        let other = positions[random.below(count)];
        let point = &mut positions[vertex];
        match random.below(6) {
            0 => *point = other,
            1 => *point = std::array::from_fn(|axis| 0.5 * (point[axis] + other[axis])),
            2 => *point = point.map(|x| x + 5.0 * random.signed()),
            _ => *point = point.map(|x| x + 0.05 * random.signed()),
        }
        list.push(vertex as u32);
        if random.below(4) == 0 {
            list.push(vertex as u32);
        }
    }
    list
}

/// A thousand rounds and more, the state of each kept from round to round.
#[test]
fn lists_bring_results_up_to_date() {
    let mut random = Random::new(11);
    let (mut rounds, mut computed, mut whole) = (0, 0, 0);
    for mesh in meshes() {
        let (handle, count) = (Handle::new(&mesh), mesh.positions.len());
        let model = learnt(&handle, &mesh.positions);
        for mut asked in all(&model) {
            let mut positions = mesh.positions.clone();
            let mut state = State::new(&asked, count);
            state.compute(&handle, &positions, &asked);
            for round in 0..6 {
                let list = moves(&mut random, &mut positions);
                let status = (round % 3 > 0).then_some(&state.0.status[..]);
                let found = affected(&handle, count, &moved_of(&list, status), &asked).unwrap();
                *asked.run() = umb_run {
                    threads: 1 + round % 2,
                    vertices: found.as_ptr(),
                    vertex_count: found.len(),
                    ..zeroed()
                };
                state.compute(&handle, &positions, &asked);
                *asked.run() = zeroed();
                let mut full = State::new(&asked, count);
                full.compute(&handle, &positions, &asked);
                assert!(
                    state.0.bits() == full.0.bits(),
                    "{}, {}, round {round}: {list:?} moved, {} vertices computed",
                    mesh.name,
                    asked.name(),
                    found.len()
                );
                (rounds, computed, whole) = (rounds + 1, computed + found.len(), whole + count);
            }
        }
    }
    println!("{rounds} rounds, {:.1} % of the vertices computed", 100.0 * computed as f64 / whole as f64);
    assert!(rounds > 1000);
}

/// The vertices within so many rings of some, by the faces.
fn within(mesh: &Mesh, list: &[u32], rings: usize) -> BTreeSet<u32> {
    let mut found: BTreeSet<u32> = list.iter().copied().collect();
    for _ in 0..rings {
        let near: Vec<u32> = mesh
            .faces()
            .filter(|face| face.iter().any(|corner| found.contains(corner)))
            .flat_map(|face| face.iter().copied())
            .collect();
        found.extend(near);
    }
    found
}

/// No more than the rings that a result depends on, each vertex once, those that moved first.
#[test]
fn lists_are_as_short_as_they_may_be() {
    for mesh in [mesh::torus(16, 11, 0.4, 0.0, 1), mesh::torus(13, 12, 0.3, 0.6, 2), mesh::height_field(13, 0.0, 3)] {
        let (handle, count) = (Handle::new(&mesh), mesh.positions.len());
        let mut model = learnt(&handle, &mesh.positions);
        model.noise = 1e-9 * model.edge_length;
        let clean = vec![0; count];
        let moved = [5, 9, 5];
        for asked in all(&model) {
            let rings = match asked {
                Asked::Normals(umb_normal_options { weight: UMB_WEIGHT_JET, rings, .. }) => {
                    [2, 1, 2, 3][rings as usize]
                }
                Asked::Normals(umb_normal_options { weight: UMB_WEIGHT_ADAPTIVE_JET, rings, .. }) => {
                    [4, 2, 3, 4][rings as usize]
                }
                Asked::Normals(_) => 1,
                Asked::Curvatures(options) if options.weight != UMB_WEIGHT_CONFORMAL => continue,
                Asked::Curvatures(umb_curvature_options { method, rings, .. }) => match method {
                    UMB_CURVATURE_ADAPTIVE_JET => [4, 2, 3][rings as usize],
                    UMB_CURVATURE_JET => [2, 1, 2][rings as usize],
                    UMB_CURVATURE_QUADRIC | UMB_CURVATURE_NORMAL_CYCLE => rings.max(1),
                    UMB_CURVATURE_GOLDFEATHER | UMB_CURVATURE_CORRECTED_MEASURE => rings.max(1) + 1,
                    UMB_CURVATURE_RUSINKIEWICZ => 2,
                    _ => 1,
                },
            };
            let found = affected(&handle, count, &moved_of(&moved, Some(&clean)), &asked).unwrap();
            assert_eq!(found[..2], [5, 9]);
            let set: BTreeSet<u32> = found.iter().copied().collect();
            assert_eq!(set.len(), found.len(), "{}: repeated", asked.name());
            assert_eq!(set, within(&mesh, &moved, rings as usize), "{}, {}", mesh.name, asked.name());
            // A vertex further out counts if its neighbourhood was widened, or may have been.
            let mut widened = clean.clone();
            let next = within(&mesh, &moved, rings as usize + 1);
            let Some(&far) = next.difference(&set).next() else { continue };
            widened[far as usize] = UMB_VERTEX_WIDENED;
            let with = affected(&handle, count, &moved_of(&moved, Some(&widened)), &asked).unwrap();
            let widens = match asked {
                Asked::Normals(options) => options.weight == UMB_WEIGHT_JET,
                Asked::Curvatures(options) => {
                    [UMB_CURVATURE_JET, UMB_CURVATURE_QUADRIC, UMB_CURVATURE_GOLDFEATHER].contains(&options.method)
                }
            };
            assert_eq!(with.contains(&far), widens, "{}", asked.name());
            let without = affected(&handle, count, &moved_of(&moved, None), &asked).unwrap();
            let further = if widens { 4 } else { 0 };
            let expected = within(&mesh, &moved, rings as usize + further);
            assert_eq!(without.into_iter().collect::<BTreeSet<u32>>(), expected, "{}", asked.name());
        }
    }
}

#[test]
fn what_is_refused() {
    let mesh = mesh::torus(8, 6, 0.0, 0.0, 1);
    let (handle, count) = (Handle::new(&mesh), mesh.positions.len());
    let all = [Asked::Normals(zeroed()), Asked::Curvatures(options(UMB_CURVATURE_LEAST_SQUARES))];
    let moved = [3, 4];
    for asked in all {
        let refused = |moved: &umb_moved| affected(&handle, count, moved, &asked).unwrap_err();
        assert_eq!(refused(&moved_of(&[3, count as u32], None)), UMB_ERROR_INDEX_OUT_OF_RANGE);
        assert_eq!(refused(&moved_of(&moved, Some(&[0; 5]))), UMB_ERROR_SIZE);
        assert_eq!(refused(&umb_moved { reserved: 1, ..moved_of(&moved, None) }), UMB_ERROR_UNKNOWN_FIELD);
        assert_eq!(refused(&umb_moved { struct_size: 3, ..moved_of(&moved, None) }), UMB_ERROR_STRUCT_SIZE);
        let null = std::ptr::null::<u32>();
        assert_eq!(refused(&umb_moved { vertices: null, ..moved_of(&moved, None) }), UMB_ERROR_NULL_POINTER);
        let nowhere = umb_bytes { data: null.cast(), count: 5, stride: 0 };
        assert_eq!(refused(&umb_moved { status: nowhere, ..moved_of(&moved, None) }), UMB_ERROR_NULL_POINTER);
        assert!(affected(&handle, count, &moved_of(&[], None), &asked).unwrap().is_empty());
    }
    // Adaptive jets without a model depend on everything; balls on what is near.
    let mut weight: umb_normal_options = zeroed();
    weight.weight = UMB_WEIGHT_ADAPTIVE_JET;
    let mut ball = options(UMB_CURVATURE_NORMAL_CYCLE);
    ball.radius = 0.1;
    let mut jets = options(UMB_CURVATURE_LEAST_SQUARES);
    jets.weight = UMB_WEIGHT_ADAPTIVE_JET;
    let adaptive = options(UMB_CURVATURE_ADAPTIVE_JET);
    for asked in
        [Asked::Normals(weight), Asked::Curvatures(ball), Asked::Curvatures(jets), Asked::Curvatures(adaptive)]
    {
        assert_eq!(affected(&handle, count, &moved_of(&moved, None), &asked), Err(UMB_ERROR_NOT_APPLICABLE));
    }
    let mut rings = options(UMB_CURVATURE_JET);
    rings.rings = 9;
    assert_eq!(
        affected(&handle, count, &moved_of(&moved, None), &Asked::Curvatures(rings)),
        Err(UMB_ERROR_OPTION_OUT_OF_RANGE)
    );
}
