//! Regions that are too small become part of a neighbour.
//!
//! The region of the fewest faces goes first, of several the one with the smallest face. Of its neighbours it joins one that it meets
//! smoothly, if there is one; among these one of its own class, if there is one; and among these the one with which it shares most length,
//! at last the one with the smallest face. A region without neighbours stays.
//!
//! Cost: O(n log n), since a region that is looked at joins one of at least as many faces, or one that is not small and ends the matter.
//! For that, the edges around a region are a circular list, and two lists become one by an exchange.

use super::sets::Sets;
use crate::error::Error;
use crate::view::{filled, room, zeroed};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

const NONE: u32 = u32::MAX;

/// Regions, numbered in the order of their smallest face.
pub(super) struct Regions {
    pub class: Vec<u8>,
    /// How many faces.
    pub faces: Vec<u32>,
    pub area: Vec<f64>,
}

/// A region that has fewer faces or less area than this is too small.
pub(super) struct Smallest {
    pub faces: usize,
    pub area: f64,
}

/// An edge between two regions, as one of them has it.
struct Edge {
    other: u32,
    next: u32,
    /// Negative where the faces do not meet smoothly.
    length: f64,
}

/// The edges between regions.
pub(super) struct Borders {
    edges: Vec<Edge>,
    /// Any edge of each region.
    of_region: Vec<u32>,
}

impl Borders {
    pub fn new(region_count: usize, edge_count: usize) -> Result<Self, Error> {
        let edges = room(edge_count.checked_mul(2).ok_or(Error::OutOfMemory)?)?;
        Ok(Borders { edges, of_region: filled(region_count, NONE)? })
    }

    /// Adds an edge to both regions; there is room for as many as were announced.
    pub fn add(&mut self, a: u32, b: u32, length: f64, smooth: bool) {
        for (region, other) in [(a, b), (b, a)] {
            let edge = self.edges.len() as u32;
            let length = if smooth { length } else { -length };
            let mut next = edge;
            match self.of_region[region as usize] {
                NONE => self.of_region[region as usize] = edge,
                first => std::mem::swap(&mut next, &mut self.edges[first as usize].next),
            }
            self.edges.push(Edge { other, next, length });
        }
    }

    /// The edges of `b` become edges of `a` as well.
    fn join(&mut self, a: u32, b: u32) {
        let (first, second) = (self.of_region[a as usize], self.of_region[b as usize]);
        if first == NONE {
            self.of_region[a as usize] = second;
        } else if second != NONE {
            let next = self.edges[first as usize].next;
            self.edges[first as usize].next = std::mem::replace(&mut self.edges[second as usize].next, next);
        }
    }

    /// Calls `edge` for each edge of a region.
    fn for_each(&self, region: u32, mut edge: impl FnMut(&Edge)) {
        let first = self.of_region[region as usize];
        let mut place = first;
        while place != NONE {
            edge(&self.edges[place as usize]);
            place = self.edges[place as usize].next;
            if place == first {
                break;
            }
        }
    }
}

/// How much of the border of a region a neighbour has.
#[derive(Clone, Copy, Default)]
struct Shared {
    smooth: f64,
    all: f64,
}

/// Merges regions that are too small. Answers with which of them are one.
pub(super) fn merge_small(mut regions: Regions, mut borders: Borders, smallest: &Smallest) -> Result<Sets, Error> {
    let count = regions.class.len();
    let mut sets = Sets::new(count)?;
    let is_small = |regions: &Regions, region: u32| {
        (regions.faces[region as usize] as usize) < smallest.faces || regions.area[region as usize] < smallest.area
    };
    let mut waiting = BinaryHeap::new();
    waiting.try_reserve(count)?;
    for region in (0..count as u32).filter(|&region| is_small(&regions, region)) {
        waiting.push(Reverse((regions.faces[region as usize], region)));
    }
    let mut shared = filled(count, Shared::default())?;
    let mut neighbours: Vec<u32> = room(count)?;
    let mut met: Vec<u8> = zeroed(count)?;
    while let Some(Reverse((faces, region))) = waiting.pop() {
        if sets.root(region) != region || regions.faces[region as usize] != faces || !is_small(&regions, region) {
            continue;
        }
        borders.for_each(region, |edge| {
            let other = sets.root(edge.other);
            if other == region {
                return;
            }
            if met[other as usize] == 0 {
                met[other as usize] = 1;
                shared[other as usize] = Shared::default();
                neighbours.push(other);
            }
            let part = &mut shared[other as usize];
            part.smooth += edge.length.max(0.0);
            part.all += edge.length.abs();
        });
        let rank = |other: u32| {
            let Shared { smooth, all } = shared[other as usize];
            let same = regions.class[other as usize] == regions.class[region as usize];
            (smooth > 0.0, same, if smooth > 0.0 { smooth } else { all })
        };
        let mut best = NONE;
        for &other in &neighbours {
            let ((smooth, same, length), best_rank) =
                (rank(other), if best == NONE { None } else { Some(rank(best)) });
            let better = best_rank.is_none_or(|(best_smooth, best_same, best_length)| {
                let order = (smooth, same).cmp(&(best_smooth, best_same)).then(length.total_cmp(&best_length));
                order.then(best.cmp(&other)).is_gt()
            });
            if better {
                best = other;
            }
        }
        for other in neighbours.drain(..) {
            met[other as usize] = 0;
        }
        if best == NONE {
            continue;
        }
        let class = regions.class[best as usize];
        let root = sets.join(region, best);
        let gone = region.max(best);
        borders.join(root, gone);
        regions.class[root as usize] = class;
        regions.faces[root as usize] += regions.faces[gone as usize];
        regions.area[root as usize] += regions.area[gone as usize];
        if is_small(&regions, root) {
            waiting.push(Reverse((regions.faces[root as usize], root)));
        }
    }
    Ok(sets)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which regions are one after merging those of fewer than three faces, told by the smallest.
    fn merged(regions: &[(u8, u32)], edges: &[(u32, u32, f64, bool)]) -> Vec<u32> {
        let mut borders = Borders::new(regions.len(), edges.len()).unwrap();
        for &(a, b, length, smooth) in edges {
            borders.add(a, b, length, smooth);
        }
        let all = Regions {
            class: regions.iter().map(|region| region.0).collect(),
            faces: regions.iter().map(|region| region.1).collect(),
            area: vec![1.0; regions.len()],
        };
        let mut sets = merge_small(all, borders, &Smallest { faces: 3, area: 0.0 }).unwrap();
        (0..regions.len() as u32).map(|region| sets.root(region)).collect()
    }

    #[test]
    fn smooth_then_class_then_length_then_smallest_face() {
        let regions = [(1, 9), (2, 9), (1, 9), (1, 2)];
        let all = |smooth: [bool; 3], lengths: [f64; 3]| {
            let edges: Vec<_> = (0..3).map(|i| (i as u32, 3, lengths[i], smooth[i])).collect();
            merged(&regions, &edges)[3]
        };
        assert_eq!(all([false, true, false], [9.0, 1.0, 9.0]), 1);
        assert_eq!(all([true, true, true], [1.0, 9.0, 2.0]), 2);
        assert_eq!(all([true, true, false], [1.0, 9.0, 9.0]), 0);
        assert_eq!(all([false, false, false], [1.0, 9.0, 2.0]), 2);
        assert_eq!(all([true, true, true], [2.0, 9.0, 2.0]), 0);
        // Lengths add up.
        let edges = [(0, 3, 2.0, true), (2, 3, 1.5, true), (3, 2, 1.5, true)];
        assert_eq!(merged(&regions, &edges), [0, 1, 2, 2]);
    }

    #[test]
    fn the_smallest_goes_first_and_grows() {
        // Of the two, one face joins two, which are then not too small any more, and stay what they were.
        assert_eq!(merged(&[(1, 9), (2, 2), (3, 1)], &[(0, 1, 9.0, true), (1, 2, 1.0, true)]), [0, 1, 1]);
        // In a chain each ends in a region that is large enough; alone it stays.
        let chain = merged(
            &[(1, 1), (2, 1), (3, 1), (4, 1), (5, 1)],
            &[(0, 1, 1.0, true), (1, 2, 1.0, true), (3, 2, 1.0, true)],
        );
        assert_eq!(chain, [0, 0, 0, 0, 4]);
    }
}
