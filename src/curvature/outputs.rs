//! Where curvatures go, and how a row of lanes is written there.

use super::principal::{Frame, Operator, positive};
use crate::error::Error;
use crate::simd::{MAX_LANES, Mask, Real, Vector, Vector3, atan2_and_reciprocal};
use crate::topology::status;
use crate::view::{Output, ScalarOutput, StatusOutput};

/// Where the results of [`curvatures`](super::curvatures) go; all are optional, and each has an element for every vertex.
///
/// Signs: positive where the surface bends away from the normal, so a sphere of radius `r` with outward normals has
/// `k1 = k2 = H = 1/r`. Not every method has every output: see [`Method`](super::Method). Values beyond the scalar's range
/// become its largest.
#[derive(Debug, Default)]
pub struct CurvatureOutputs<'a> {
    /// The larger principal curvature, 1/length.
    pub k1: Option<ScalarOutput<'a>>,
    /// The smaller principal curvature, 1/length.
    pub k2: Option<ScalarOutput<'a>>,
    /// The unit tangent direction of `k1`, `#V × 3`. The first of its largest components is positive.
    pub direction1: Option<Output<'a>>,
    /// The unit tangent direction of `k2`: the normal × `direction1`.
    pub direction2: Option<Output<'a>>,
    /// Mean curvature `H`, 1/length.
    pub mean: Option<ScalarOutput<'a>>,
    /// Gaussian curvature `K`, 1/length².
    pub gaussian: Option<ScalarOutput<'a>>,
    /// The mean curvature normal `H N`, `#V × 3`, 1/length; outwards on a sphere with outward normals.
    pub mean_normal: Option<Output<'a>>,
    /// The area that the vertex stands for, length².
    pub area: Option<ScalarOutput<'a>>,
    /// Mean curvature integrated over that area, length.
    pub integrated_mean: Option<ScalarOutput<'a>>,
    /// Gaussian curvature integrated over that area, without unit.
    pub integrated_gaussian: Option<ScalarOutput<'a>>,
    /// Koenderink's shape index `(2/π) atan((k1 + k2) / (k1 − k2))`: 1 at a cap, 0.5 on a ridge, 0 at a symmetric saddle
    /// and in a plane, −0.5 in a rut, −1 in a cup.
    pub shape_index: Option<ScalarOutput<'a>>,
    /// Koenderink's curvedness `√((k1² + k2²) / 2)`, 1/length.
    pub curvedness: Option<ScalarOutput<'a>>,
    /// The root mean square of what a fit left over: 1/length where curvatures were fitted, length where heights were.
    pub residual: Option<ScalarOutput<'a>>,
    /// The condition number of a fit.
    pub condition: Option<ScalarOutput<'a>>,
    /// For adaptive jets, how many of the 15 coefficients of the polynomial the data decide, and not the prior; 0 where nothing
    /// was fitted.
    pub degrees_of_freedom: Option<ScalarOutput<'a>>,
    /// The unit normal to which all of this belongs: the one given or computed, or the fit's own.
    pub normal: Option<Output<'a>>,
    /// [`status`] bits.
    pub status: Option<StatusOutput<'a>>,
}

/// A kind of outputs that a method has or has not; normals and statuses all have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CurvatureKind {
    /// `k1`, `k2`, `shape_index` and `curvedness`.
    Principal,
    /// `direction1` and `direction2`.
    Directions,
    /// `mean` and `mean_normal`.
    Mean,
    /// `gaussian`.
    Gaussian,
    /// `area`.
    Area,
    /// `integrated_mean`.
    IntegratedMean,
    /// `integrated_gaussian`.
    IntegratedGaussian,
    /// `residual`.
    Residual,
    /// `condition`.
    Condition,
    /// `degrees_of_freedom`.
    DegreesOfFreedom,
}

impl CurvatureKind {
    /// Every kind.
    pub const ALL: [CurvatureKind; 10] = [
        CurvatureKind::Principal,
        CurvatureKind::Directions,
        CurvatureKind::Mean,
        CurvatureKind::Gaussian,
        CurvatureKind::Area,
        CurvatureKind::IntegratedMean,
        CurvatureKind::IntegratedGaussian,
        CurvatureKind::Residual,
        CurvatureKind::Condition,
        CurvatureKind::DegreesOfFreedom,
    ];
}

impl From<CurvatureKind> for Kinds {
    fn from(kind: CurvatureKind) -> Kinds {
        match kind {
            CurvatureKind::Principal => Kinds::PRINCIPAL,
            CurvatureKind::Directions => Kinds::DIRECTIONS,
            CurvatureKind::Mean => Kinds::MEAN,
            CurvatureKind::Gaussian => Kinds::GAUSSIAN,
            CurvatureKind::Area => Kinds::AREA,
            CurvatureKind::IntegratedMean => Kinds::INTEGRATED_MEAN,
            CurvatureKind::IntegratedGaussian => Kinds::INTEGRATED_GAUSSIAN,
            CurvatureKind::Residual => Kinds::RESIDUAL,
            CurvatureKind::Condition => Kinds::CONDITION,
            CurvatureKind::DegreesOfFreedom => Kinds::FREEDOM,
        }
    }
}

/// A set of [`CurvatureKind`]s.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Kinds(u16);

impl Kinds {
    pub const PRINCIPAL: Kinds = Kinds(1);
    pub const DIRECTIONS: Kinds = Kinds(2);
    pub const MEAN: Kinds = Kinds(4);
    pub const GAUSSIAN: Kinds = Kinds(8);
    pub const AREA: Kinds = Kinds(16);
    pub const INTEGRATED_MEAN: Kinds = Kinds(32);
    pub const INTEGRATED_GAUSSIAN: Kinds = Kinds(64);
    pub const RESIDUAL: Kinds = Kinds(128);
    pub const CONDITION: Kinds = Kinds(256);
    pub const FREEDOM: Kinds = Kinds(512);

    /// Those of either.
    pub const fn and(self, other: Kinds) -> Kinds {
        Kinds(self.0 | other.0)
    }

    /// Whether all of `other` are among these.
    pub fn has(self, other: Kinds) -> bool {
        self.0 & other.0 == other.0
    }
}

impl CurvatureOutputs<'_> {
    /// Refuses arrays of the wrong length, and outputs of other kinds than `provided`.
    pub(crate) fn check(&self, vertex_count: usize, provided: Kinds) -> Result<(), Error> {
        let check = |what: &'static str, found: Option<usize>, kind: Kinds| match found {
            Some(found) if found != vertex_count => {
                Err(Error::Size { what, found: found as u64, expected: vertex_count as u64 })
            }
            Some(_) if !provided.has(kind) => Err(Error::NotApplicable { what }),
            _ => Ok(()),
        };
        let scalar = |output: &Option<ScalarOutput<'_>>| output.as_ref().map(Output::len);
        let vector = |output: &Option<Output<'_>>| output.as_ref().map(Output::len);
        check("outputs.k1", scalar(&self.k1), Kinds::PRINCIPAL)?;
        check("outputs.k2", scalar(&self.k2), Kinds::PRINCIPAL)?;
        check("outputs.direction1", vector(&self.direction1), Kinds::DIRECTIONS)?;
        check("outputs.direction2", vector(&self.direction2), Kinds::DIRECTIONS)?;
        check("outputs.mean", scalar(&self.mean), Kinds::MEAN)?;
        check("outputs.gaussian", scalar(&self.gaussian), Kinds::GAUSSIAN)?;
        check("outputs.mean_normal", vector(&self.mean_normal), Kinds::MEAN)?;
        check("outputs.area", scalar(&self.area), Kinds::AREA)?;
        check("outputs.integrated_mean", scalar(&self.integrated_mean), Kinds::INTEGRATED_MEAN)?;
        check("outputs.integrated_gaussian", scalar(&self.integrated_gaussian), Kinds::INTEGRATED_GAUSSIAN)?;
        check("outputs.shape_index", scalar(&self.shape_index), Kinds::PRINCIPAL)?;
        check("outputs.curvedness", scalar(&self.curvedness), Kinds::PRINCIPAL)?;
        check("outputs.residual", scalar(&self.residual), Kinds::RESIDUAL)?;
        check("outputs.condition", scalar(&self.condition), Kinds::CONDITION)?;
        check("outputs.degrees_of_freedom", scalar(&self.degrees_of_freedom), Kinds::FREEDOM)?;
        check("outputs.normal", vector(&self.normal), Kinds(0))?;
        check("outputs.status", self.status.as_ref().map(StatusOutput::len), Kinds(0))
    }
}

/// What a method found at the vertices of a row of lanes, in units in which lengths are about 1.
#[derive(Clone, Copy)]
pub(crate) struct Local<V: Vector> {
    pub normal: Vector3<V>,
    pub k1: V,
    pub k2: V,
    pub direction1: Vector3<V>,
    pub mean: V,
    pub gaussian: V,
    pub mean_normal: Vector3<V>,
    pub area: V,
    pub integrated_mean: V,
    pub integrated_gaussian: V,
    pub residual: V,
    pub condition: V,
    /// How many coefficients the data decide.
    pub freedom: V,
    /// Whether there is a result at all.
    pub usable: V::Mask,
    /// Whether the input left something undetermined that had to be filled in.
    pub fallback: V::Mask,
}

/// Larger numbers would leave the range when they are squared; a result that has one is none.
const LARGEST: f64 = f64::from_bits((1023 + 500) << 52);

impl<V: Vector> Local<V> {
    /// Nothing found yet.
    #[inline(always)]
    pub fn new(normal: Vector3<V>) -> Self {
        let zero = V::zero();
        Local {
            normal,
            k1: zero,
            k2: zero,
            direction1: Vector3::zero(),
            mean: zero,
            gaussian: zero,
            mean_normal: Vector3::zero(),
            area: zero,
            integrated_mean: zero,
            integrated_gaussian: zero,
            residual: zero,
            condition: zero,
            freedom: zero,
            usable: V::zero().lt(V::one()),
            fallback: V::one().lt(V::zero()),
        }
    }

    /// All that follows from a shape operator.
    #[inline(always)]
    pub fn of_operator(frame: &Frame<V>, operator: &Operator<V>) -> Self {
        let found = operator.principal();
        let (c, s) = found.direction;
        Local {
            k1: found.k1,
            k2: found.k2,
            direction1: positive(frame.x * c + frame.y * s),
            mean: found.mean,
            gaussian: found.gaussian,
            mean_normal: frame.normal * found.mean,
            ..Local::new(frame.normal)
        }
    }

    /// All that follows from mean and Gaussian curvature; where they contradict each other (`K > H²`), both principal
    /// curvatures are `H`.
    #[inline(always)]
    pub fn of_mean_and_gaussian(normal: Vector3<V>, mean: V, gaussian: V) -> Self {
        let radius = (mean * mean - gaussian).max(V::zero()).sqrt();
        Local {
            k1: mean + radius,
            k2: mean - radius,
            mean,
            gaussian,
            mean_normal: normal * mean,
            ..Local::new(normal)
        }
    }

    /// Drops the result of lanes where a number has left the range.
    #[inline(always)]
    fn in_range(&self) -> V::Mask {
        let size = |vector: Vector3<V>| vector.x.abs() + vector.y.abs() + vector.z.abs();
        let sum = self.k1.abs()
            + self.k2.abs()
            + self.mean.abs()
            + self.gaussian.abs()
            + self.area.abs()
            + self.integrated_mean.abs()
            + self.integrated_gaussian.abs()
            + self.residual.abs()
            + self.condition.abs()
            + self.freedom.abs()
            + size(self.direction1)
            + size(self.mean_normal)
            + size(self.normal);
        // What is not a number compares as false.
        sum.lt(V::constant(LARGEST))
    }

    /// Lanes that have a result.
    #[inline(always)]
    pub fn trusted(&self) -> u32 {
        self.usable.and(self.in_range()).bits()
    }
}

/// What every lane of a [`Local`] found, in rows of numbers: so that what writes results is compiled once and not for every
/// estimator and vector width.
pub(crate) struct Rows([[f64; MAX_LANES]; ROWS]);

const ROWS: usize = 19;

/// The [`Rows`] that outputs take something from, a bit each.
#[derive(Clone, Copy)]
pub(crate) struct Taken(u32);

impl CurvatureOutputs<'_> {
    /// The rows that are not asked for in vain.
    pub(crate) fn taken(&self) -> Taken {
        const NORMAL: u32 = 0b111 << 9;
        const DIRECTION: u32 = 0b111 << 12;
        const MEAN_NORMAL: u32 = 0b111 << 15;
        let asked = [
            (self.k1.is_some(), 1),
            (self.k2.is_some(), 1 << 1),
            (self.mean.is_some(), 1 << 2),
            (self.gaussian.is_some(), 1 << 3),
            (self.area.is_some(), 1 << 4),
            (self.integrated_mean.is_some(), 1 << 5),
            (self.integrated_gaussian.is_some(), 1 << 6),
            (self.residual.is_some(), 1 << 7),
            (self.condition.is_some(), 1 << 8),
            (self.normal.is_some(), NORMAL),
            (self.direction1.is_some(), DIRECTION),
            (self.direction2.is_some(), NORMAL | DIRECTION),
            (self.mean_normal.is_some(), MEAN_NORMAL),
            (self.degrees_of_freedom.is_some(), 1 << 18),
            (self.shape_index.is_some() || self.curvedness.is_some(), 0b11),
        ];
        Taken(asked.iter().filter(|(asked, _)| *asked).fold(0, |all, (_, rows)| all | rows))
    }

    /// The outputs of one number a vertex that are asked for.
    fn scalars(&self) -> impl Iterator<Item = &ScalarOutput<'_>> {
        let scalars = [
            &self.k1,
            &self.k2,
            &self.mean,
            &self.gaussian,
            &self.area,
            &self.integrated_mean,
            &self.integrated_gaussian,
            &self.shape_index,
            &self.curvedness,
            &self.residual,
            &self.condition,
            &self.degrees_of_freedom,
        ];
        scalars.into_iter().flatten()
    }

    /// Whether an output is in double precision.
    pub(crate) fn any_double(&self) -> bool {
        let vectors = [&self.direction1, &self.direction2, &self.mean_normal, &self.normal];
        self.scalars().any(Output::is_double) || vectors.into_iter().flatten().any(Output::is_double)
    }
}

impl CurvatureOutputs<'_> {
    /// Whether [`CurvatureOutputs::write_lanes`] has all that is asked for.
    #[inline(always)]
    pub(crate) fn in_lanes(&self) -> bool {
        let others = [
            &self.area,
            &self.integrated_mean,
            &self.integrated_gaussian,
            &self.shape_index,
            &self.curvedness,
            &self.residual,
            &self.condition,
            &self.degrees_of_freedom,
        ];
        let mut none = self.mean_normal.is_none() && self.status.is_none();
        for other in others {
            none &= other.is_none();
        }
        for scalar in [&self.k1, &self.k2, &self.mean, &self.gaussian] {
            none &= !scalar.as_ref().is_some_and(Output::is_double);
        }
        for vector in [&self.direction1, &self.direction2, &self.normal] {
            none &= !vector.as_ref().is_some_and(Output::is_double);
        }
        none
    }

    /// Writes a block whose outputs all are in single precision, as its lanes are.
    #[inline(always)]
    pub(crate) fn write_lanes<V: Vector>(&self, vertices: &[u32], lanes: u32, found: &Local<V>, scale: V) {
        let most = V::constant(f32::MAX as f64);
        if let Some(output) = &self.k1 {
            output.write_lanes(vertices, lanes, &[(found.k1 * scale).min(most).max(-most)]);
        }
        if let Some(output) = &self.k2 {
            output.write_lanes(vertices, lanes, &[(found.k2 * scale).min(most).max(-most)]);
        }
        if let Some(output) = &self.mean {
            output.write_lanes(vertices, lanes, &[(found.mean * scale).min(most).max(-most)]);
        }
        if let Some(output) = &self.gaussian {
            output.write_lanes(vertices, lanes, &[(found.gaussian * scale * scale).min(most).max(-most)]);
        }
        let (n, d) = (found.normal, found.direction1);
        if let Some(output) = &self.direction1 {
            let d = d * (V::constant(1.5) - d.squared() * V::constant(0.5));
            output.write_lanes(vertices, lanes, &[d.x, d.y, d.z]);
        }
        if let Some(output) = &self.direction2 {
            let e = n.cross(d);
            let e = e * (V::constant(1.5) - e.squared() * V::constant(0.5));
            output.write_lanes(vertices, lanes, &[e.x, e.y, e.z]);
        }
        if let Some(output) = &self.normal {
            output.write_lanes(vertices, lanes, &[n.x, n.y, n.z]);
        }
    }
}

impl<V: Vector> Local<V> {
    /// The lanes of the rows that are taken as numbers, the others zero.
    #[inline(always)]
    pub fn rows(&self, taken: Taken) -> Rows {
        let (normal, direction, mean) = (self.normal, self.direction1, self.mean_normal);
        let rows: [V; ROWS] = [
            self.k1,
            self.k2,
            self.mean,
            self.gaussian,
            self.area,
            self.integrated_mean,
            self.integrated_gaussian,
            self.residual,
            self.condition,
            normal.x,
            normal.y,
            normal.z,
            direction.x,
            direction.y,
            direction.z,
            mean.x,
            mean.y,
            mean.z,
            self.freedom,
        ];
        let mut numbers = [[0.0; MAX_LANES]; ROWS];
        for index in 0..ROWS {
            if taken.0 & 1 << index != 0 {
                let lanes = rows[index].to_lanes();
                for lane in 0..V::LANES {
                    numbers[index][lane] = lanes[lane].into();
                }
            }
        }
        Rows(numbers)
    }

    /// Lanes where something had to be filled in.
    #[inline(always)]
    pub fn fallbacks(&self) -> u32 {
        self.fallback.bits()
    }
}

/// What to write of a block besides its [`Rows`].
pub(crate) struct Block<'a> {
    /// Its vertices, at most one a lane.
    pub vertices: &'a [u32],
    /// A bit for each lane to write.
    pub lanes: u32,
    /// How many of the results' units of length make one of the mesh, lane by lane.
    pub scales: [f64; MAX_LANES],
    /// The power of length in which residuals are.
    pub residual_power: i32,
    /// Status bits of all vertices of the mesh.
    pub flags: &'a [u8],
    /// Status bits for every lane.
    pub more: u8,
    /// Lanes whose status says fallback.
    pub fallbacks: u32,
}

impl CurvatureOutputs<'_> {
    /// Writes a block.
    #[inline(never)]
    pub(crate) fn write(&self, block: &Block<'_>, rows: &Rows) {
        let scales = &block.scales;
        let [k1, k2, mean, gaussian, area, integrated_mean, integrated_gaussian, residual, condition, ..] = &rows.0;
        macro_rules! write {
            ($($output:ident, $element:expr;)*) => {$(
                if let Some(output) = &self.$output {
                    output.write_block(block.vertices, block.lanes, &transposed(block.vertices.len(), $element));
                }
            )*};
        }
        let [n, d, m] = [9, 12, 15].map(|first| [&rows.0[first], &rows.0[first + 1], &rows.0[first + 2]]);
        write! {
            k1, |lane| [k1[lane] * scales[lane]];
            k2, |lane| [k2[lane] * scales[lane]];
            direction1, |lane| polished([d[0][lane], d[1][lane], d[2][lane]]);
            direction2, |lane| polished([
                n[1][lane] * d[2][lane] - d[1][lane] * n[2][lane],
                n[2][lane] * d[0][lane] - d[2][lane] * n[0][lane],
                n[0][lane] * d[1][lane] - d[0][lane] * n[1][lane]
            ]);
            mean, |lane| [mean[lane] * scales[lane]];
            gaussian, |lane| [gaussian[lane] * scales[lane] * scales[lane]];
            mean_normal, |lane| [m[0][lane] * scales[lane], m[1][lane] * scales[lane], m[2][lane] * scales[lane]];
            area, |lane| [area[lane] / scales[lane] / scales[lane]];
            integrated_mean, |lane| [integrated_mean[lane] / scales[lane]];
            integrated_gaussian, |lane| [integrated_gaussian[lane]];
            shape_index, |lane| [shape_index(k1[lane], k2[lane])];
            curvedness, |lane| [((k1[lane] * k1[lane] + k2[lane] * k2[lane]) * 0.5).sqrt() * scales[lane]];
            residual, |lane| [
                if block.residual_power > 0 { residual[lane] / scales[lane] } else { residual[lane] * scales[lane] }
            ];
            condition, |lane| [condition[lane]];
            degrees_of_freedom, |lane| [rows.0[18][lane]];
            normal, |lane| [n[0][lane], n[1][lane], n[2][lane]];
        }
        if let Some(output) = &self.status {
            for (lane, &vertex) in block.vertices.iter().enumerate() {
                if block.lanes & 1 << lane != 0 {
                    let fallback = if block.fallbacks & 1 << lane != 0 { status::FALLBACK } else { 0 };
                    output.write(vertex as usize, block.flags[vertex as usize] | block.more | fallback);
                }
            }
        }
    }

    /// Writes zeros (and the normal, if there is one) at a vertex without result.
    pub(crate) fn write_none(&self, vertex: usize, normal: [f64; 3], status: u8) {
        for output in self.scalars() {
            output.write(vertex, [0.0]);
        }
        for output in [&self.direction1, &self.direction2, &self.mean_normal].into_iter().flatten() {
            output.write(vertex, [0.0; 3]);
        }
        if let Some(output) = &self.normal {
            output.write(vertex, normal);
        }
        if let Some(output) = &self.status {
            output.write(vertex, status);
        }
    }
}

/// The components of the elements of all lanes, each in a row.
#[inline(always)]
fn transposed<const N: usize>(lanes: usize, element: impl Fn(usize) -> [f64; N]) -> [[f64; MAX_LANES]; N] {
    let mut rows = [[0.0; MAX_LANES]; N];
    for lane in 0..lanes.min(MAX_LANES) {
        for (row, value) in rows.iter_mut().zip(element(lane)) {
            row[lane] = value;
        }
    }
    rows
}

/// A vector that is of length 1 but for rounding in single precision, of length 1 to double precision.
#[inline(always)]
fn polished([x, y, z]: [f64; 3]) -> [f64; 3] {
    let factor = 1.5 - 0.5 * (x * x + y * y + z * z);
    [x * factor, y * factor, z * factor]
}

/// `(2/π) atan((k1 + k2) / (k1 − k2))`, 0 where both are zero.
fn shape_index(k1: f64, k2: f64) -> f64 {
    let sum = k1 + k2;
    // Of any size: only the ratio counts.
    let scale = sum.abs().max(k1 - k2).inverse_power_of_two();
    let (angle, _) = atan2_and_reciprocal(sum.abs() * scale, (k1 - k2) * scale);
    (angle * std::f64::consts::FRAC_2_PI).copysign(sum)
}
