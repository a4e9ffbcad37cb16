//! The angle defect of Gauss and Bonnet.
//!
//! The integral of Gaussian curvature over the vertex: `2π − Σθ` for a closed fan, `π − Σθ` for an open one, which is the
//! turning of the boundary there; fans add up. Divided by the mixed Voronoi area (Meyer et al. 2003; in a polygon an equal
//! share for each corner) it is the pointwise value; at a boundary that is turning by area, not a curvature of the surface.
//!
//! Summed over all vertices, the integral is `2π` times the Euler characteristic, whatever the mesh is like: angles of a
//! triangle are made to sum up to π even where edges have no length, and a polygon that is not flat has what its angles
//! lack of `(n − 2)π` shared out among its corners. (Vertices with several fans, and edges that end fans, count as if the
//! surface were cut open there.)
//!
//! Input: any ring of triangles or polygons; no normals. Reference: Meyer et al. 2003, section 4; Reshetnyak 1993 for the
//! boundary term. Does not converge pointwise on irregular meshes. Degenerate rule: where the area vanishes, the pointwise
//! value is 0 and the status says fallback; the integral stands. Cost: an angle polynomial, two roots and three divisions a
//! corner.

use super::outputs::Local;
use super::principal::Frame;
use super::ring::RingEstimator;
use crate::simd::{Mask, Real, Vector};
use crate::sweep::{Ring, RingFaces, Scratch};
use std::f64::consts::{PI, TAU};

/// Where the pointwise value would be larger than this, in the ring's units, there is none.
const LARGEST_GAUSSIAN: f64 = f64::from_bits((1023 + 400) << 52);

/// Gauss–Bonnet.
pub(crate) struct AngleDefect;

/// In single precision, where an area is not so small, in units in which the ring is about 1 across, that rounding would show.
#[inline(always)]
pub(crate) fn large_enough<V: Vector>(area: V) -> V::Mask {
    let least = if V::Scalar::SINGLE { 1.0 / 16.0 } else { f64::NEG_INFINITY };
    V::constant(least).lt(area)
}

/// Defect and area, fan by fan.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    defect: V,
    area: V,
}

/// What is left of the full turn (of the half turn in an open fan) after all corners.
#[inline(always)]
pub(crate) fn defect<V: Vector, F: RingFaces<V>>(ring: &Ring<'_, V, F>) -> V {
    let mut angles = V::zero();
    for index in 0..ring.corner_count() {
        angles = angles + ring.corner(index).flat_angle();
    }
    V::constant(if ring.closed { TAU } else { PI }) - angles
}

impl RingEstimator for AngleDefect {
    const FLAT_ANGLES: bool = true;
    const NORMAL: bool = false;
    type Sums<V: Vector> = Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Sums<V> {
        Sums { defect: V::zero(), area: V::zero() }
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        _frame: &Frame<V>,
        _scratch: &mut Scratch<'_, V>,
        sums: &mut Sums<V>,
    ) {
        sums.defect = sums.defect + defect(ring);
        for index in 0..ring.corner_count() {
            let corner = ring.corner(index);
            sums.area = sums.area + corner.mixed_area() + corner.doubt();
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Sums<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = sums.area.reciprocal_or_zero();
        let gaussian = sums.defect * inverse;
        // An area out of all proportion is none.
        let there = V::zero().lt(inverse).and(gaussian.abs().lt(V::constant(LARGEST_GAUSSIAN)));
        Local {
            gaussian: V::select(there, gaussian, V::zero()),
            area: sums.area,
            integrated_gaussian: sums.defect,
            usable: large_enough(sums.area),
            fallback: V::select(there, V::one(), V::zero()).lt(V::one()),
            ..Local::new(frame.normal)
        }
    }
}
