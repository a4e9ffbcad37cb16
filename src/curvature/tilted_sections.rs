//! Curvatures of sections along the edges of one ring, with a tilt of the normal.
//!
//! See [`TiltedSums`] for what is computed, its reference and its rules. The normal that tilts is Max's, or the caller's; the
//! one that comes out is an output as well. Exact on spheres with Max's.

use super::outputs::Local;
use super::principal::{Frame, Operator};
use super::ring::RingEstimator;
use crate::fit::TiltedSums;
use crate::simd::Vector;
use crate::sweep::{FaceNeeds, Ring, RingFaces, Scratch};

/// Tilted sections.
pub(crate) struct TiltedSections;

impl RingEstimator for TiltedSections {
    const FACES: FaceNeeds = FaceNeeds::Unused;
    const SINGLE: bool = false;
    type Sums<V: Vector> = TiltedSums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> TiltedSums<V> {
        TiltedSums::new()
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        _scratch: &mut Scratch<'_, V>,
        sums: &mut TiltedSums<V>,
    ) {
        sums.add(ring, frame.x, frame.y, frame.normal);
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &TiltedSums<V>, frame: &Frame<V>) -> Local<V> {
        let found = sums.finish(frame.x, frame.y, frame.normal);
        let surface = found.surface;
        let [a, b, d] = surface.shape;
        let frame = Frame { normal: surface.normal, x: surface.x, y: surface.y };
        Local { usable: found.trusted, ..Local::of_operator(&frame, &Operator { a, b, d }) }
    }
}
