//! What adaptive jets know of every one-ring, and which neighbours they let count.
//!
//! A neighbour counts if its one-ring normal is within 60° of the vertex's, which keeps what lies beyond folds and creases out, and if it
//! is no spike. A vertex that may be on a crease keeps its first ring, so that the fit shows whether it is; and so does one with too few
//! neighbours otherwise.

use crate::simd::{MAX_LANES, Mask, Vector, Vector3};
use crate::sweep::Counts;
use crate::topology::{Neighbourhood, Topology};
use crate::view::{StridedPoints, gather_rows};
use glam::DVec3;

/// The cosine of the largest angle between the one-ring normals of a vertex and of a neighbour that counts.
const SAME_SIDE: f64 = 0.5;

/// A neighbourhood of fewer points, the vertex among them, keeps the first ring whatever its normals.
const LEAST_POINTS: usize = 6;

/// One-rings, as far as adaptive jets ask.
#[derive(Debug, Default)]
pub(crate) struct Surroundings {
    /// Unit one-ring normals, zero where there is none.
    pub normals: Vec<[f64; 3]>,
    /// As `normals`, and a zero; none where only some vertices are computed.
    pub singles: Vec<[f32; 4]>,
    /// The mean length of each vertex's edges, those of its faces at the vertex.
    pub edge_lengths: Vec<f64>,
    /// [`Surroundings::SHARP`], [`Surroundings::SPIKE`] and [`Surroundings::BESIDE_SPIKE`].
    pub marks: Vec<u8>,
    /// Whether any vertex is marked a spike.
    pub has_spikes: bool,
}

impl Surroundings {
    /// A face of the vertex is more than 37° from its normal.
    pub const SHARP: u8 = 1;
    /// The vertex stands out of its neighbours: it is no use to fits around others.
    pub const SPIKE: u8 = 2;
    /// A neighbour is a spike: what is sharp is so because of that.
    pub const BESIDE_SPIKE: u8 = 4;

    /// Whether a vertex may be on a crease.
    #[inline(always)]
    pub fn may_be_creased(&self, vertex: usize) -> bool {
        self.marks[vertex] == Self::SHARP
    }

    /// Fills `chosen` with the neighbours on the same side of any crease.
    #[inline(always)]
    pub fn choose<V: Vector<Scalar = f64>, Z: Vector<Scalar = f32>>(
        &self,
        vertex: u32,
        found: &Neighbourhood,
        chosen: &mut [u32],
    ) -> Counts {
        let [x, y, z] = self.normals[vertex as usize];
        let own = Vector3 { x: V::splat(x), y: V::splat(y), z: V::splat(z) };
        let rings = self.may_be_creased(vertex as usize) as usize;
        // All others are looked at one by one, in double precision.
        let ordinary = !self.has_spikes && !self.singles.is_empty();
        if ordinary && self.all_on_this_side::<Z>(vertex, found.vertices()) {
            chosen[..found.vertices().len()].copy_from_slice(found.vertices());
            return found.counts_within();
        }
        let counts = self.choose_beyond(own, found, rings, Self::SPIKE, chosen);
        if counts[3] as usize + 1 < LEAST_POINTS { self.choose_beyond(own, found, 1, 0, chosen) } else { counts }
    }

    /// Whether there is no doubt that all normals are within 60° of the vertex's.
    #[inline(always)]
    fn all_on_this_side<Z: Vector<Scalar = f32>>(&self, vertex: u32, found: &[u32]) -> bool {
        let [x, y, z, _] = self.singles[vertex as usize];
        let (x, y, z) = (Z::splat(x), Z::splat(y), Z::splat(z));
        let mut least = Z::one();
        for some in found.chunks(Z::LANES) {
            let mut row = [vertex; MAX_LANES];
            if some.len() == Z::LANES {
                row[..Z::LANES].copy_from_slice(&some[..Z::LANES]);
            } else {
                for (place, &neighbour) in row.iter_mut().zip(some) {
                    *place = neighbour;
                }
            }
            let [a, b, c, _] = gather_rows::<Z>(&self.singles, &row);
            least = (x * a + y * b + z * c).min(least);
        }
        least.lt(Z::constant(SAME_SIDE + 1e-5)).bits() == 0
    }

    /// As [`Surroundings::choose`], with all of the first `rings` rings, 0 or 1, but for vertices with one of the `unwanted`
    /// marks.
    #[inline(always)]
    fn choose_beyond<V: Vector<Scalar = f64>>(
        &self,
        own: Vector3<V>,
        found: &Neighbourhood,
        rings: usize,
        unwanted: u8,
        chosen: &mut [u32],
    ) -> Counts {
        let normals = StridedPoints::from(self.normals.as_slice());
        let all = (1u32 << V::LANES) - 1;
        let mut counts = found.counts_within();
        let mut count = 0;
        let mut first = 0;
        for (ring, ring_count) in counts.iter_mut().enumerate() {
            let last = *ring_count as usize;
            for some in found.vertices()[first..last].chunks(V::LANES) {
                let mut row = [some[0]; MAX_LANES];
                row[..some.len()].copy_from_slice(some);
                let mut wanted = all;
                if ring >= rings {
                    wanted = !own.dot(normals.lanes::<V>(&row)).lt(V::constant(SAME_SIDE)).bits() & all;
                }
                if self.has_spikes && unwanted != 0 {
                    for (lane, &neighbour) in some.iter().enumerate() {
                        wanted &= !(((self.marks[neighbour as usize] & unwanted != 0) as u32) << lane);
                    }
                }
                if wanted == all {
                    chosen[count..count + some.len()].copy_from_slice(some);
                    count += some.len();
                } else {
                    for (lane, &neighbour) in some.iter().enumerate() {
                        chosen[count] = neighbour;
                        count += (wanted >> lane & 1) as usize;
                    }
                }
            }
            *ring_count = count as u32;
            first = last;
        }
        counts
    }

    /// Whether a vertex is away from creases.
    pub fn is_clean(&self, vertex: u32, topology: &Topology, neighbourhood: &mut Neighbourhood) -> bool {
        let own = DVec3::from(self.normals[vertex as usize]);
        let near = |&neighbour: &u32| own.dot(self.normals[neighbour as usize].into()) >= SAME_SIDE;
        self.marks[vertex as usize] == 0 && neighbourhood.gather(topology, vertex, 2).iter().all(near)
    }
}
