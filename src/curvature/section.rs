//! Sections (to be replaced).
use crate::simd::{Mask, Vector, Vector3};
/// Section formula.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Section {
    /// C
    Circle,
    /// SP
    #[default]
    SymmetricParabola,
}
/// κ and weight.
#[inline(always)]
pub(crate) fn edge<V: Vector>(edge: Vector3<V>, squared: V, normal: Vector3<V>, section: Section) -> (V, V) {
    let height = edge.dot(normal);
    let tangent = edge - normal * height;
    let t2 = tangent.squared();
    let ok = V::constant(f64::from_bits((1023 - 400) << 52)).lt(squared).and((squared * V::constant(1e-30)).lt(t2));
    let divisor = match section {
        Section::Circle => squared,
        _ => t2,
    };
    let safe = V::select(ok, divisor, V::one());
    (V::select(ok, -(height + height) / safe, V::zero()), V::select(ok, V::one(), V::zero()))
}
