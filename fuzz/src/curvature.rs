//! Outputs of curvatures: which a method has, and what must hold of them.

#[path = "../../tests/common/outputs.rs"]
mod outputs;

use crate::arrays::{Bytes, Input, Target};
use crate::coordinates::rows;
use crate::source::Source;
use crate::structs::{Struct, zeroed};
use crate::weights::{model, small, weight};
use outputs::{OUTPUTS, Out, Out::*};
use umbilic::capi::*;

/// A method; those of one ring more often than the dear ones.
pub fn method(source: &mut Source<'_>) -> umb_curvature_method {
    if source.spoils() {
        return source.any_u32();
    }
    match source.byte() {
        byte @ 0..208 => source_method(byte),
        byte if !source.may_be_slow(4) => source_method(byte),
        208..240 => source.pick(&[UMB_CURVATURE_JET, UMB_CURVATURE_QUADRIC, UMB_CURVATURE_GOLDFEATHER]),
        byte if !source.may_be_slow(32) => source_method(byte),
        _ => UMB_CURVATURE_ADAPTIVE_JET,
    }
}

fn source_method(byte: u8) -> umb_curvature_method {
    UMB_CURVATURE_TILTED_SECTIONS + byte as u32 % 9
}

/// Vertex normals or directions of the caller's; none for `count` 0.
pub fn vectors(source: &mut Source<'_>, count: usize, double: bool) -> Input {
    let natural: Vec<[f64; 3]> = (0..count).map(|index| [0.1 * index as f64, 0.2, 1.0]).collect();
    let rows = rows(source, &natural, count, double);
    Input::new(source, &rows, 3, double)
}

/// Normals that are given a third of the time, mostly in the precision of the positions.
pub fn given(source: &mut Source<'_>, count: usize, double: bool) -> Option<Input> {
    let wanted = source.byte() % 3 == 2;
    wanted.then(|| {
        let double = if source.rarely() { !double } else { double };
        vectors(source, count, double)
    })
}

/// What curvatures are asked for, but how to run.
pub struct Asked {
    _model: Struct<umb_adaptive_model>,
    _normals: Option<Input>,
    pub view: umb_curvature_options,
}

impl Asked {
    /// For so many vertices, whose positions are in double precision or not.
    pub fn new(source: &mut Source<'_>, count: usize, double: bool) -> Asked {
        let (model, normals) = (model(source), given(source, count, double));
        let mut options: umb_curvature_options = zeroed();
        options.method = method(source);
        options.section = if source.spoils() { source.any_u32() } else { source.below(4) as u32 };
        options.weight = weight(source);
        let tame = !source.is_hostile() || source.half();
        let measure = matches!(options.method, UMB_CURVATURE_NORMAL_CYCLE | UMB_CURVATURE_CORRECTED_MEASURE);
        let fit = options.method <= UMB_CURVATURE_GOLDFEATHER;
        if options.method == UMB_CURVATURE_JET || !tame {
            options.degree = source.pick(&[0, 2, 3, 4]);
        }
        if measure && source.half() || !tame {
            options.radius = match source.byte() {
                byte @ 0..240 => byte as f64 / 32.0,
                _ if source.is_hostile() => f64::from_bits(source.number()),
                byte => 2f64.powi(byte as i32 * 8 - 1950),
            };
        }
        if measure && options.radius == 0.0 || fit || !tame {
            let most = if source.rarely() { 8 } else { 3 };
            options.rings = small(source, most);
        }
        (options.normal_degree, options.normal_rings) = (small(source, 4), small(source, 3));
        options.model = model.pointer();
        options.normals = normals.as_ref().map_or(zeroed(), Input::points);
        Asked { _model: model, _normals: normals, view: options }
    }
}

/// Few outputs more often than many.
fn is_wanted(wanted: u16, output: Out) -> bool {
    wanted.rotate_left(output as u32 * 5) & 3 == 0
}

/// Arrays for some of the outputs.
pub struct Outputs {
    targets: [Target; 16],
    status: Bytes,
}

impl Outputs {
    /// Outputs that the method has, unless the input is hostile.
    pub fn new(source: &mut Source<'_>, method: umb_curvature_method, count: usize, double: bool) -> Outputs {
        let (wanted, mixed): (u16, bool) = (source.number(), source.byte() >= 192);
        let targets = OUTPUTS.map(|output| {
            let has = output.is_of(method) || source.spoils();
            if !has || !is_wanted(wanted, output) {
                return Target::none(source);
            }
            let double = if mixed { source.half() } else { double };
            Target::new(source, output.components(), count, double)
        });
        let status = source.half();
        Outputs { targets, status: Bytes::new(source, count, status) }
    }

    /// Outputs that the method has, chosen by one source and laid out by another.
    pub fn laid_out(
        choice: &mut Source<'_>,
        layout: &mut Source<'_>,
        method: umb_curvature_method,
        count: usize,
        double: bool,
    ) -> Outputs {
        let (wanted, mixed): (u16, bool) = (choice.number(), choice.byte() >= 192);
        let targets = OUTPUTS.map(|output| {
            let double = if mixed { choice.half() } else { double };
            if !output.is_of(method) || !is_wanted(wanted, output) {
                return Target::none(layout);
            }
            Target::new(layout, output.components(), count, double)
        });
        Outputs { targets, status: Bytes::new(layout, count, true) }
    }

    pub fn targets(&self) -> impl Iterator<Item = &Target> {
        self.targets.iter()
    }

    pub fn status(&self) -> &Bytes {
        &self.status
    }

    pub fn view(&self) -> umb_curvature_outputs {
        let mut outputs = crate::structs::zeroed();
        for (output, target) in OUTPUTS.into_iter().zip(&self.targets) {
            *output.field(&mut outputs) = target.view();
        }
        outputs.status = self.status.view();
        outputs
    }

    pub fn are_untouched(&self) -> bool {
        self.targets.iter().all(Target::is_untouched) && self.status.is_untouched()
    }

    pub fn check_gaps(&self, may: impl Fn(usize) -> bool) {
        for (output, target) in OUTPUTS.into_iter().zip(&self.targets) {
            if target.is_wanted() {
                target.check_gaps(&may, &format!("{output:?}"));
            }
        }
        self.status.check_gaps(&may, "status");
    }

    fn of(&self, output: Out) -> Option<&Target> {
        Some(&self.targets[output as usize]).filter(|target| target.is_wanted())
    }

    /// Checks the results at a vertex with these flags.
    pub fn check(&self, vertex: usize, flags: u8) {
        let status = self.status.element(vertex);
        let none = status.is_some_and(|status| status & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE) != 0);
        for output in OUTPUTS {
            let Some(target) = self.of(output) else { continue };
            let value = target.finite(vertex, NAMES[output as usize]);
            match output {
                Direction1 | Direction2 | Normal => {
                    target.unit(vertex, NAMES[output as usize]);
                }
                Area | Curvedness | Residual | Condition | DegreesOfFreedom => {
                    assert!(value[0] >= 0.0, "{output:?} of vertex {vertex} is {}", value[0]);
                }
                ShapeIndex => assert!(value[0].abs() <= 1.0, "shape index {}", value[0]),
                _ => {}
            }
            let zero = value == [0.0; 3] || output == Normal;
            assert!(!none || zero, "{output:?} of vertex {vertex} with status {status:?} is {value:?}");
        }
        if let (Some(k1), Some(k2)) = (self.of(K1), self.of(K2))
            && k1.is_double() == k2.is_double()
        {
            let (larger, smaller) = (k1.element(vertex)[0], k2.element(vertex)[0]);
            assert!(larger >= smaller, "vertex {vertex}: k1 {larger} is below k2 {smaller}");
        }
        if let Some(status) = status {
            assert_eq!(status & 15, flags, "status {status} of vertex {vertex}");
        }
    }
}

const NAMES: [&str; 16] = [
    "k1",
    "k2",
    "direction1",
    "direction2",
    "mean",
    "gaussian",
    "mean_normal",
    "area",
    "integrated_mean",
    "integrated_gaussian",
    "shape_index",
    "curvedness",
    "residual",
    "condition",
    "degrees_of_freedom",
    "normal",
];
