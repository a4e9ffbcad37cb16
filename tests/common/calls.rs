//! Every function of the C interface that computes something, as a list: prepared first, then called as often as a test likes.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

use super::capi::{ALL, Handle, faces, message, points, zeroed};
use super::curvature::{METHODS, OUTPUTS, Out, options};
use super::mesh::Mesh;
use std::ffi::c_void;
use umbilic::capi::*;

/// What a call is to compute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    Create,
    Stats,
    Valence,
    Learn,
    Normals(umb_weight),
    OneShot(umb_weight),
    FaceNormals,
    Curvatures(umb_curvature_method),
    /// A method of regions, over balls.
    Balls(umb_curvature_method),
    EdgeSections(umb_weight),
    DirectionSections(umb_weight),
    Polyline,
    Cut,
    Corners(umb_weight),
    CornersOnce(umb_weight),
    Segments(Kind),
    Areas,
    Means,
    Shapes,
    AffectedNormals(umb_weight),
    AffectedCurvatures(umb_curvature_method),
}

/// How to segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Features,
    /// By a height that is given, and by curvedness.
    Height,
    Curvedness,
    /// By shape classes that are given, and by those of curvatures.
    Classes,
    Shapes,
}

/// All of them; weights that need no code of their own in a call are left to one.
pub fn all() -> Vec<Call> {
    let weights = || ALL.into_iter().chain([UMB_WEIGHT_ADAPTIVE_JET, UMB_WEIGHT_TILTED_SECTIONS]);
    let some = [UMB_WEIGHT_CONFORMAL, UMB_WEIGHT_JET, UMB_WEIGHT_ADAPTIVE_JET, UMB_WEIGHT_TILTED_SECTIONS];
    let creases = [Call::Cut, Call::Corners(UMB_WEIGHT_ANGLE), Call::CornersOnce(UMB_WEIGHT_CONFORMAL)];
    [Call::Create, Call::Stats, Call::Valence, Call::Learn, Call::FaceNormals, Call::Polyline]
        .into_iter()
        .chain(creases)
        .chain([Kind::Features, Kind::Height, Kind::Curvedness, Kind::Classes, Kind::Shapes].map(Call::Segments))
        .chain([Call::Areas, Call::Means, Call::Shapes, Call::AffectedNormals(UMB_WEIGHT_JET)])
        .chain([UMB_CURVATURE_JET, UMB_CURVATURE_MEYER].map(Call::AffectedCurvatures))
        .chain(weights().map(Call::Normals))
        .chain([Call::OneShot(UMB_WEIGHT_CONFORMAL), Call::OneShot(UMB_WEIGHT_ADAPTIVE_JET)])
        .chain(METHODS.map(Call::Curvatures))
        .chain([UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE].map(Call::Balls))
        .chain(some.map(Call::EdgeSections))
        .chain(some.map(Call::DirectionSections))
        .collect()
}

impl Call {
    /// Whether it takes a `umb_run`, and so threads, a list and progress.
    pub fn runs(self) -> bool {
        let none = matches!(self, Call::Create | Call::Stats | Call::Valence | Call::Cut | Call::Areas | Call::Means);
        !none && !matches!(self, Call::AffectedNormals(_) | Call::AffectedCurvatures(_))
    }

    /// Whether it takes a list of vertices.
    pub fn takes_list(self) -> bool {
        let none =
            matches!(self, Call::FaceNormals | Call::Polyline | Call::Learn | Call::Segments(_) | Call::Shapes);
        self.runs() && !none && !matches!(self, Call::Corners(_) | Call::CornersOnce(_))
    }
}

/// A mesh in both precisions, with a handle.
pub struct Fixture {
    pub mesh: Mesh,
    single: Vec<[f32; 3]>,
    handle: Handle,
    cut: Cut,
    directions: Vec<[f64; 3]>,
    /// Numbers at vertices.
    heights: Vec<f64>,
    height: umb_scalars,
    classes: Vec<u8>,
    segmentation: Segments,
    /// Curvatures of one ring.
    curvature: umb_curvature_options,
}

/// A segmentation that frees itself.
struct Segments(*mut umb_segmentation);

impl Segments {
    fn new(mesh: &Mesh, height: &umb_scalars) -> Segments {
        let (mut found, mut error) = (std::ptr::null_mut(), zeroed());
        let mut options: umb_watershed_options = zeroed();
        options.height = height;
        let (faces, points) = (faces(mesh), points(&mesh.positions));
        let status = unsafe { umb_segment_watershed(&faces, &points, &options, &mut found, &mut error) };
        assert_eq!(status, UMB_OK, "{}", message(&error));
        Segments(found)
    }
}

impl Drop for Segments {
    fn drop(&mut self) {
        unsafe { umb_segmentation_destroy(self.0) };
    }
}

/// A mesh cut along its creases that frees itself.
struct Cut(*mut umb_cut);

impl Cut {
    fn new(mesh: &Mesh) -> Cut {
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|point| point.map(finite)).collect();
        let (mut cut, mut error) = (std::ptr::null_mut(), zeroed());
        let (faces, points, null) = (faces(mesh), points(&positions), std::ptr::null());
        let status = unsafe { umb_cut_create(&faces, &points, null, std::ptr::null(), &mut cut, &mut error) };
        assert_eq!(status, UMB_OK, "{}", message(&error));
        Cut(cut)
    }
}

impl Drop for Cut {
    fn drop(&mut self) {
        unsafe { umb_cut_destroy(self.0) };
    }
}

impl Fixture {
    pub fn new(mesh: Mesh) -> Self {
        let directions = vec![[1.0, 0.3, -0.2], [0.1, -1.0, 0.4]];
        let heights: Vec<f64> = (0..mesh.positions.len()).map(|vertex| (vertex * 7 % 11) as f64).collect();
        let classes = (0..mesh.positions.len()).map(|vertex| (vertex / 3 % 9) as u8).collect();
        let height = umb_scalars {
            data: heights.as_ptr().cast(),
            count: heights.len(),
            stride: 0,
            scalar: UMB_SCALAR_F64,
            location: UMB_AT_VERTICES,
        };
        Fixture {
            single: mesh.single(),
            handle: Handle::new(&mesh),
            cut: Cut::new(&mesh),
            segmentation: Segments::new(&mesh, &height),
            curvature: options(UMB_CURVATURE_LEAST_SQUARES),
            directions,
            heights,
            height,
            classes,
            mesh,
        }
    }
}

/// How to call.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    pub single: bool,
    pub threads: u32,
    pub simd: umb_simd,
    pub list: Option<&'a [u32]>,
    /// For adaptive jets; without, a call learns its own.
    pub model: Option<&'a umb_adaptive_model>,
    pub progress: umb_progress,
    pub user: *mut c_void,
}

impl Setting<'_> {
    pub fn threads(threads: u32) -> Self {
        Setting {
            single: false,
            threads,
            simd: UMB_SIMD_BEST,
            list: None,
            model: None,
            progress: None,
            user: std::ptr::null_mut(),
        }
    }
}

/// A call with all its arguments.
pub struct Prepared<'a> {
    pub call: Call,
    fixture: &'a Fixture,
    single: bool,
    faces: umb_faces,
    points: umb_points,
    polyline: umb_polyline,
    topology_options: umb_topology_options,
    normal_options: umb_normal_options,
    face_options: umb_face_options,
    curvature_options: umb_curvature_options,
    section_options: umb_section_options,
    polyline_options: umb_polyline_options,
    normal_outputs: umb_normal_outputs,
    face_outputs: umb_face_outputs,
    curvature_outputs: umb_curvature_outputs,
    section_outputs: umb_section_outputs,
    polyline_outputs: umb_polyline_outputs,
    corner_outputs: umb_corner_outputs,
    feature_options: umb_feature_options,
    watershed_options: umb_watershed_options,
    region_options: umb_region_options,
    shape_options: umb_shape_options,
    moved: umb_moved,
    sums: *mut f64,
    classes: umb_status_output,
    list: *mut u32,
    room: usize,
    pub model: umb_adaptive_model,
    stats: umb_topology_stats,
    valence: usize,
    handle: *mut umb_topology,
    cut: *mut umb_cut,
    segmentation: *mut umb_segmentation,
    /// Labels and boundary edges, with room for any.
    labels: Vec<u32>,
    pub error: umb_error,
    /// What the outputs point to.
    arrays: Vec<Vec<f64>>,
}

/// Vertices that move.
const FEW: [u32; 2] = [0, 1];

/// What arrays hold before a call: no result has these bits.
pub const UNTOUCHED: f64 = f64::from_bits(0xa5a5_a5a5_a5a5_a5a5);

impl<'a> Prepared<'a> {
    pub fn new(call: Call, fixture: &'a Fixture, setting: &Setting<'a>) -> Self {
        let mesh = &fixture.mesh;
        let mut run: umb_run = zeroed();
        (run.threads, run.simd) = (setting.threads, setting.simd);
        (run.progress, run.user) = (setting.progress, setting.user);
        if let Some(list) = setting.list.filter(|_| call.takes_list()) {
            (run.vertices, run.vertex_count) = (list.as_ptr(), list.len());
        }
        let positions = if setting.single { points(&fixture.single) } else { points(&mesh.positions) };
        let scalar = positions.scalar;
        let mut prepared = Prepared {
            call,
            fixture,
            single: setting.single,
            faces: faces(mesh),
            points: positions,
            polyline: umb_polyline {
                data: positions.data,
                count: positions.count,
                stride: 0,
                scalar,
                dimension: 3,
                closed: 1,
                reserved: 0,
            },
            topology_options: zeroed(),
            normal_options: zeroed(),
            face_options: zeroed(),
            curvature_options: zeroed(),
            section_options: zeroed(),
            polyline_options: zeroed(),
            normal_outputs: zeroed(),
            face_outputs: zeroed(),
            curvature_outputs: zeroed(),
            section_outputs: zeroed(),
            polyline_outputs: zeroed(),
            corner_outputs: zeroed(),
            feature_options: zeroed(),
            watershed_options: zeroed(),
            region_options: zeroed(),
            shape_options: zeroed(),
            moved: zeroed(),
            sums: std::ptr::null_mut(),
            classes: umb_status_output { data: std::ptr::null_mut(), stride: 0 },
            list: std::ptr::null_mut(),
            room: mesh.positions.len(),
            model: zeroed(),
            stats: zeroed(),
            valence: usize::MAX,
            handle: std::ptr::null_mut(),
            cut: std::ptr::null_mut(),
            segmentation: std::ptr::null_mut(),
            labels: Vec::with_capacity(mesh.face_count() + 2 * mesh.indices.len()),
            error: zeroed(),
            arrays: vec![],
        };
        (prepared.topology_options.threads, prepared.topology_options.simd) = (setting.threads, setting.simd);
        let model = setting.model.map_or(std::ptr::null(), std::ptr::from_ref);
        (prepared.normal_options.run, prepared.normal_options.model) = (run, model);
        prepared.face_options.run = run;
        (prepared.section_options.run, prepared.section_options.model) = (run, model);
        prepared.polyline_options.run = run;
        let (vertices, entries) = (mesh.positions.len(), unsafe {
            *umb_topology_ring_offsets(fixture.handle.0).add(mesh.positions.len()) as usize
        });
        match call {
            Call::Create | Call::Stats | Call::Valence | Call::Learn | Call::Cut => {}
            Call::Normals(weight) | Call::OneShot(weight) => {
                prepared.normal_options.weight = weight;
                prepared.normal_outputs.normal = prepared.array(3 * vertices);
                prepared.normal_outputs.sum = prepared.array(3 * vertices);
                prepared.normal_outputs.status = prepared.bytes(vertices);
            }
            Call::FaceNormals => {
                prepared.face_outputs.normal = prepared.array(3 * mesh.face_count());
                prepared.face_outputs.area_vector = prepared.array(3 * mesh.face_count());
                prepared.face_outputs.status = prepared.bytes(mesh.face_count());
            }
            Call::Curvatures(method) | Call::Balls(method) => {
                prepared.curvature_options = options(method);
                (prepared.curvature_options.run, prepared.curvature_options.model) = (run, model);
                if matches!(call, Call::Balls(_)) {
                    prepared.curvature_options.radius = 0.5;
                }
                for output in OUTPUTS.into_iter().filter(|output: &Out| output.is_of(method)) {
                    let array = prepared.array(output.components() * vertices);
                    *output.field(&mut prepared.curvature_outputs) = array;
                }
                prepared.curvature_outputs.status = prepared.bytes(vertices);
            }
            Call::EdgeSections(weight) => {
                prepared.section_options.weight = weight;
                prepared.section_outputs.curvature = prepared.array(entries);
                prepared.section_outputs.normal = prepared.array(3 * vertices);
                prepared.section_outputs.status = prepared.bytes(entries);
            }
            Call::DirectionSections(weight) => {
                prepared.section_options.weight = weight;
                prepared.section_options.shared = 1;
                prepared.section_options.directions = points(&fixture.directions);
                prepared.section_outputs.curvature = prepared.array(fixture.directions.len() * vertices);
                prepared.section_outputs.normal = prepared.array(3 * vertices);
                prepared.section_outputs.status = prepared.bytes(fixture.directions.len() * vertices);
            }
            Call::Polyline => {
                prepared.polyline_outputs.circle = prepared.array(vertices);
                prepared.polyline_outputs.parabola = prepared.array(vertices);
                prepared.polyline_outputs.length_parabola = prepared.array(vertices);
                prepared.polyline_outputs.symmetric_parabola = prepared.array(vertices);
                prepared.polyline_outputs.status = prepared.bytes(vertices);
            }
            Call::Corners(weight) => {
                let cut_vertices = unsafe { umb_cut_vertex_count(fixture.cut.0) };
                prepared.normal_options.weight = weight;
                prepared.corner_outputs.corner = prepared.array(3 * mesh.indices.len());
                prepared.corner_outputs.normal = prepared.array(3 * cut_vertices);
                prepared.corner_outputs.sum = prepared.array(3 * cut_vertices);
                prepared.corner_outputs.status = prepared.bytes(cut_vertices);
            }
            Call::CornersOnce(weight) => {
                prepared.normal_options.weight = weight;
                prepared.corner_outputs.corner = prepared.array(3 * mesh.indices.len());
                // A status that the call does not have: the last array holds bytes.
                let _ = prepared.bytes(0);
            }
            Call::Segments(kind) => {
                prepared.feature_options.run = run;
                prepared.watershed_options.run = run;
                prepared.region_options.run = run;
                prepared.watershed_options.curvature = &fixture.curvature;
                prepared.region_options.curvature = &fixture.curvature;
                if kind == Kind::Height {
                    prepared.watershed_options.height = &fixture.height;
                }
                if kind == Kind::Classes {
                    let (data, count) = (fixture.classes.as_ptr(), fixture.classes.len());
                    prepared.region_options.classes = umb_bytes { data, count, stride: 0 };
                }
            }
            Call::Areas | Call::Means => {
                let count = unsafe { umb_segmentation_count(fixture.segmentation.0) };
                prepared.arrays.push(vec![UNTOUCHED; count]);
                prepared.sums = prepared.arrays.last_mut().unwrap().as_mut_ptr();
                let _ = prepared.bytes(0);
            }
            Call::Shapes => {
                prepared.shape_options.run = run;
                prepared.classes = prepared.bytes(vertices);
            }
            Call::AffectedNormals(_) | Call::AffectedCurvatures(_) => {
                if let Call::AffectedCurvatures(method) = call {
                    prepared.curvature_options = options(method);
                }
                prepared.normal_options.weight = UMB_WEIGHT_JET;
                prepared.moved.vertices = FEW.as_ptr();
                prepared.moved.vertex_count = FEW.len().min(vertices);
                prepared.list = prepared.bytes(4 * vertices).data.cast();
            }
        }
        prepared
    }

    fn array(&mut self, scalars: usize) -> umb_output {
        let words = if self.single { scalars.div_ceil(2) } else { scalars };
        self.arrays.push(vec![UNTOUCHED; words]);
        let data = self.arrays.last_mut().unwrap().as_mut_ptr().cast();
        umb_output { data, stride: 0, scalar: if self.single { UMB_SCALAR_F32 } else { UMB_SCALAR_F64 }, reserved: 0 }
    }

    fn bytes(&mut self, count: usize) -> umb_status_output {
        self.arrays.push(vec![UNTOUCHED; count.div_ceil(8)]);
        umb_status_output { data: self.arrays.last_mut().unwrap().as_mut_ptr().cast(), stride: 0 }
    }

    /// Calls. Nothing of the test's own allocates in here.
    pub fn call(&mut self) -> umb_status {
        let (topology, points, error) =
            (self.fixture.handle.0.cast_const(), &raw const self.points, &raw mut self.error);
        unsafe {
            match self.call {
                Call::Create => {
                    let count = self.fixture.mesh.positions.len();
                    umb_topology_create(&self.faces, count, &self.topology_options, &mut self.handle, error)
                }
                Call::Stats => umb_topology_get_stats(topology, &mut self.stats, error),
                Call::Valence => {
                    let mut worst = UMB_OK;
                    for vertex in 0..self.fixture.mesh.positions.len() {
                        let status = umb_topology_valence(topology, vertex, &mut self.valence, error);
                        worst = if status == UMB_OK { worst } else { status };
                    }
                    worst
                }
                Call::Learn => umb_learn_model(topology, points, &self.normal_options, &mut self.model, error),
                Call::Normals(_) => {
                    umb_vertex_normals(topology, points, &self.normal_options, &self.normal_outputs, error)
                }
                Call::OneShot(_) => {
                    let (options, outputs) = (&self.normal_options, &self.normal_outputs);
                    umb_vertex_normals_from_faces(&self.faces, points, options, outputs, error)
                }
                Call::FaceNormals => {
                    umb_face_normals(&self.faces, points, &self.face_options, &self.face_outputs, error)
                }
                Call::Curvatures(_) | Call::Balls(_) => {
                    umb_curvatures(topology, points, &self.curvature_options, &self.curvature_outputs, error)
                }
                Call::EdgeSections(_) => {
                    umb_edge_sections(topology, points, &self.section_options, &self.section_outputs, error)
                }
                Call::DirectionSections(_) => {
                    umb_direction_sections(topology, points, &self.section_options, &self.section_outputs, error)
                }
                Call::Cut => {
                    let null = std::ptr::null();
                    umb_cut_create(&self.faces, points, null, &self.topology_options, &mut self.cut, error)
                }
                Call::Corners(_) => {
                    let (options, outputs) = (&self.normal_options, &self.corner_outputs);
                    umb_corner_normals(self.fixture.cut.0, points, options, outputs, error)
                }
                Call::CornersOnce(_) => {
                    let (options, corner) = (&self.normal_options, &self.corner_outputs.corner);
                    umb_corner_normals_from_faces(&self.faces, points, std::ptr::null(), options, corner, error)
                }
                Call::Segments(kind) => {
                    let (faces, made) = (&raw const self.faces, &raw mut self.segmentation);
                    let status = match kind {
                        Kind::Features => umb_segment_features(faces, points, &self.feature_options, made, error),
                        Kind::Height | Kind::Curvedness => {
                            umb_segment_watershed(faces, points, &self.watershed_options, made, error)
                        }
                        Kind::Classes | Kind::Shapes => {
                            umb_segment_regions(faces, points, &self.region_options, made, error)
                        }
                    };
                    if status == UMB_OK {
                        let count = umb_segmentation_face_count(*made);
                        self.labels.extend_from_slice(list(umb_segmentation_labels(*made), count));
                        let count = 2 * umb_segmentation_boundary_edge_count(*made);
                        self.labels.extend_from_slice(list(umb_segmentation_boundary_edges(*made), count));
                    }
                    status
                }
                Call::Areas | Call::Means => {
                    let (made, faces) = (self.fixture.segmentation.0.cast_const(), &raw const self.faces);
                    let (count, scalars) = (umb_segmentation_count(made), &raw const self.fixture.height);
                    if self.call == Call::Areas {
                        return umb_segmentation_areas(made, faces, points, self.sums, count, error);
                    }
                    umb_segmentation_means(made, faces, points, scalars, self.sums, count, error)
                }
                Call::Shapes => {
                    self.shape_options.points = points;
                    let k = &raw const self.fixture.height;
                    umb_shape_classes(k, k, &self.shape_options, &self.classes, error)
                }
                Call::AffectedNormals(_) => {
                    let (moved, count) = (&self.moved, &raw mut self.valence);
                    umb_affected_normals(topology, moved, &self.normal_options, self.list, self.room, count, error)
                }
                Call::AffectedCurvatures(_) => {
                    let (moved, count) = (&self.moved, &raw mut self.valence);
                    umb_affected_curvatures(
                        topology,
                        moved,
                        &self.curvature_options,
                        self.list,
                        self.room,
                        count,
                        error,
                    )
                }
                Call::Polyline => {
                    umb_polyline_curvatures(&self.polyline, &self.polyline_options, &self.polyline_outputs, error)
                }
            }
        }
    }

    /// As [`Prepared::call`], which must succeed; frees what was created.
    pub fn succeed(&mut self) {
        let status = self.call();
        assert_eq!(status, UMB_OK, "{:?}: {}", self.call, message(&self.error));
        self.free();
    }

    pub fn free(&mut self) {
        unsafe {
            umb_topology_destroy(std::mem::replace(&mut self.handle, std::ptr::null_mut()));
            umb_cut_destroy(std::mem::replace(&mut self.cut, std::ptr::null_mut()));
            umb_segmentation_destroy(std::mem::replace(&mut self.segmentation, std::ptr::null_mut()));
        }
    }

    /// All that the call may have written, bit by bit.
    pub fn bits(&self) -> Vec<u64> {
        let model = (self.model.edge_length, self.model.noise, self.model.sizes, self.model.sample);
        let stats = (self.stats.edge_count, self.stats.euler_characteristic, self.stats.boundary_loops);
        let numbers = [model.0, model.1].into_iter().chain(model.2).map(f64::to_bits);
        let counts = [model.3 as u64, stats.0, stats.1 as u64, stats.2, self.valence as u64];
        let labels = self.labels.iter().map(|&label| label as u64);
        self.arrays.iter().flatten().map(|x| x.to_bits()).chain(numbers).chain(counts).chain(labels).collect()
    }

    /// Whether nothing has been written.
    pub fn is_untouched(&self) -> bool {
        let arrays = self.arrays.iter().flatten().all(|x| x.to_bits() == UNTOUCHED.to_bits());
        arrays
            && self.model.edge_length == 0.0
            && self.stats.vertex_count == 0
            && self.handle.is_null()
            && self.cut.is_null()
            && self.segmentation.is_null()
            && self.labels.is_empty()
    }

    /// Makes all outputs as they were before the call.
    pub fn reset(&mut self) {
        self.arrays.iter_mut().for_each(|array| array.fill(UNTOUCHED));
        self.labels.clear();
        (self.model, self.stats, self.valence, self.error) = (zeroed(), zeroed(), usize::MAX, zeroed());
    }

    /// Whether every byte of the outputs is as `other` has it, or untouched.
    pub fn is_part_of(&self, other: &Prepared<'_>) -> bool {
        let bytes = |prepared: &Prepared<'_>| -> Vec<u8> {
            prepared.arrays.iter().flatten().flat_map(|x| x.to_bits().to_ne_bytes()).collect()
        };
        bytes(self).iter().zip(bytes(other)).all(|(&found, full)| found == 0xa5 || found == full)
    }

    /// Whether every number that was written is finite.
    pub fn is_finite(&self) -> bool {
        let singles = |x: &f64| [x.to_bits() as u32, (x.to_bits() >> 32) as u32];
        let single = self.single && !matches!(self.call, Call::Areas | Call::Means);
        let finite = |x: &f64| match single {
            true => singles(x).into_iter().all(|bits| f32::from_bits(bits).is_finite()),
            false => x.is_finite(),
        };
        // The last array holds the bytes of the status.
        let numbers = &self.arrays[..self.arrays.len().saturating_sub(1)];
        numbers.iter().flatten().filter(|x| x.to_bits() != UNTOUCHED.to_bits()).all(finite)
            && [self.model.edge_length, self.model.noise].into_iter().chain(self.model.sizes).all(f64::is_finite)
    }
}

/// What a handle holds; it has none where there is nothing.
///
/// # Safety
/// `data` points to `count` numbers.
unsafe fn list<'a>(data: *const u32, count: usize) -> &'a [u32] {
    if count == 0 { &[] } else { unsafe { std::slice::from_raw_parts(data, count) } }
}
