//! Records around a vertex into its ordered ring.
//!
//! Around a vertex, the record that follows `(next, prev)` counter-clockwise is the one whose `next` is `prev`. Most rings
//! close after exactly as many steps as there are corners, which proves them one closed manifold fan. That is seen for a
//! block of vertices at once, lanes being vertices: every step of the chain looks at all records, without a branch. What
//! is not closed goes through [`FanBuilder`].
//!
//! A ring starts at the vertex's first corner in face order, so it depends on the order of faces and on nothing else.

use super::corners::{Record, Spilt};
use super::fans::FanBuilder;
use super::{NO_FACE, status};
use crate::error::{Error, reserved};
use crate::simd::{Level, Task, Width, dispatch, follow_chain};
use crate::view::{BLOCK, MAX_LANE_CORNERS, RingClass, RingPart, SLOTS, SlotsPart};

/// Rings of more corners than this are always sorted.
const WIDE: usize = 16;

/// Orders the rings of all vertices of a part.
pub(super) struct Order<'a, 'b, 'p, const WORDS: usize> {
    pub slots: &'a SlotsPart<'b, WORDS>,
    /// The records without a slot, by vertex.
    pub spilt: &'a [Spilt<WORDS>],
    pub rings: &'a mut RingPart<'b>,
    /// The status of each vertex, 0 so far.
    pub flags: &'a mut [u8],
    pub builder: &'a mut FanBuilder<'p>,
}

impl<const WORDS: usize> Order<'_, '_, '_, WORDS> {
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn run(self, level: Level) -> Result<(), Error> {
        let mut result = Ok(());
        dispatch(level, OrderTask { order: self, result: &mut result });
        result
    }
}

struct OrderTask<'a, 'b, 'p, 'r, const WORDS: usize> {
    order: Order<'a, 'b, 'p, WORDS>,
    result: &'r mut Result<(), Error>,
}

impl<const WORDS: usize> Task for OrderTask<'_, '_, '_, '_, WORDS> {
    #[inline(always)]
    fn run<W: Width>(mut self) {
        *self.result = self.order.all();
    }
}

/// A block of rings: the neighbours and their faces by place in the ring and lane.
struct Chains {
    neighbours: [[u32; BLOCK]; SLOTS],
    faces: [[u32; BLOCK]; SLOTS],
    /// 0 where the ring is one closed fan.
    failed: [u32; BLOCK],
}

impl<'a, const WORDS: usize> Order<'a, '_, '_, WORDS> {
    #[inline(always)]
    fn all(&mut self) -> Result<(), Error> {
        let mut chains =
            Chains { neighbours: [[0; BLOCK]; SLOTS], faces: [[NO_FACE; BLOCK]; SLOTS], failed: [0; BLOCK] };
        let vertex_count = self.rings.len();
        for block in 0..vertex_count.div_ceil(BLOCK) {
            let counts = *self.slots.counts(block);
            match counts.iter().fold(0, |most, &count| most.max(count)) {
                0..=4 => self.follow::<4>(block, &counts, &mut chains),
                5 => self.follow::<5>(block, &counts, &mut chains),
                6 => self.follow::<6>(block, &counts, &mut chains),
                7 => self.follow::<7>(block, &counts, &mut chains),
                _ => self.follow::<SLOTS>(block, &counts, &mut chains),
            }
            #[expect(clippy::needless_range_loop, reason = "a lane is a column of every row")]
            for lane in 0..BLOCK.min(vertex_count - block * BLOCK) {
                let corners = counts[lane] as usize;
                let class = if chains.failed[lane] == 0 {
                    let (mut neighbours, mut faces) = ([0; SLOTS], [0; SLOTS]);
                    for slot in 0..SLOTS {
                        neighbours[slot] = chains.neighbours[slot][lane];
                        faces[slot] = chains.faces[slot][lane];
                    }
                    self.rings.reserve(SLOTS)?;
                    self.rings.push(&neighbours, &faces, corners);
                    RingClass::Lanes { corners, closed: true }
                } else {
                    self.one(block * BLOCK + lane, corners)?
                };
                self.rings.end_ring(class)?;
            }
        }
        Ok(())
    }

    /// Follows the chains of a block in which no vertex with a closed ring of at most [`SLOTS`] corners has more than `M`.
    #[inline(always)]
    fn follow<const M: usize>(&self, block: usize, counts: &[u8; BLOCK], chains: &mut Chains) {
        let rows = self.slots.rows::<M>(block);
        let (nexts, prevs) = (&rows[0], &rows[1]);
        for lane in 0..BLOCK {
            let count = counts[lane] as u32;
            let first = nexts[0][lane];
            let mut wanted = prevs[0][lane];
            let mut failed = (count == 0) | (count > SLOTS as u32);
            chains.neighbours[0][lane] = first;
            if let Some(faces) = rows.get(2) {
                chains.faces[0][lane] = faces[0][lane];
            }
            for step in 1..M {
                let mut found = u32::MAX;
                let mut face = NO_FACE;
                for slot in 1..M {
                    let same = nexts[slot][lane] == wanted;
                    found = if same { prevs[slot][lane] } else { found };
                    if let Some(faces) = rows.get(2) {
                        face = if same { faces[slot][lane] } else { face };
                    }
                }
                chains.neighbours[step][lane] = wanted;
                chains.faces[step][lane] = face;
                let going = (step as u32) < count;
                failed |= going & ((found == u32::MAX) | (wanted == first));
                wanted = if going { found } else { wanted };
            }
            chains.failed[lane] = (failed | (wanted != first)) as u32;
        }
    }

    /// Adds the ring of a vertex that is not one closed fan of a few corners; answers with its class.
    #[inline(never)]
    fn one(&mut self, place: usize, corners: usize) -> Result<RingClass, Error> {
        let vertex = (self.rings.first() + place) as u32;
        if corners == 0 {
            self.flags[place] = status::ISOLATED;
            return Ok(RingClass::Isolated);
        }
        let spilt = if corners > SLOTS { self.take_spilt(vertex) } else { &[] };
        let records = self.slots.records(place).chain(spilt.iter().map(|spilt| spilt.record));
        let count = corners.min(SLOTS) + spilt.len();
        if count <= WIDE {
            let mut window = [[0; WORDS]; WIDE];
            for (slot, record) in window.iter_mut().zip(records) {
                *slot = record;
            }
            // Of fewer it is known that they do not close.
            if count > SLOTS && self.close(&window, count)? {
                return Ok(RingClass::Lanes { corners: count, closed: true });
            }
            return self.sort(vertex, place, &window[..count]);
        }
        let mut gathered = reserved(count)?;
        gathered.extend(records);
        self.sort(vertex, place, &gathered)
    }

    /// Splits off the records of `vertex` that found no slot.
    fn take_spilt(&mut self, vertex: u32) -> &'a [Spilt<WORDS>] {
        let count = self.spilt.iter().take_while(|spilt| spilt.vertex == vertex).count();
        let (taken, rest) = self.spilt.split_at(count);
        self.spilt = rest;
        taken
    }

    /// Adds the ring of the first `count` records, from the first record on, if they close to a single fan; whether they
    /// do.
    fn close(&mut self, records: &[[u32; WORDS]; WIDE], count: usize) -> Result<bool, Error> {
        let beyond = |slot: usize| if slot < count { 0 } else { u32::MAX };
        let nexts: [u32; WIDE] = std::array::from_fn(|slot| records[slot].next() | beyond(slot));
        let links: [u32; WIDE] = std::array::from_fn(|slot| records[slot].prev() + 1);
        let Some(ring) = follow_chain(&nexts, &links, count) else {
            return Ok(false);
        };
        let face_of = |neighbour: u32| {
            let record = nexts.iter().position(|&next| next == neighbour).map(|slot| records[slot]);
            record.and_then(Record::face).unwrap_or(NO_FACE)
        };
        self.rings.reserve(WIDE)?;
        self.rings.push(&ring, &ring.map(face_of), count);
        Ok(true)
    }

    /// Adds the ring of any records.
    fn sort(&mut self, vertex: u32, place: usize, records: &[[u32; WORDS]]) -> Result<RingClass, Error> {
        let (flags, lone) = self.builder.add(vertex, records, self.rings)?;
        self.flags[place] = flags;
        Ok(match lone {
            Some(fan) if fan.corners as usize <= MAX_LANE_CORNERS => {
                RingClass::Lanes { corners: fan.corners as usize, closed: fan.closed }
            }
            _ => RingClass::Alone,
        })
    }
}
