//! Disjoint sets of numbers, each set told by its smallest.
//!
//! Paths are halved, and sets joined by their smallest number instead of their size, so that the name of a set follows from what is in it:
//! O(log n) a step at worst, amortised, and next to constant where neighbours have near numbers.

use crate::error::Error;
use crate::view::room;

/// A partition of `0..count`.
pub(super) struct Sets(Vec<u32>);

impl Sets {
    /// Every number by itself.
    pub fn new(count: usize) -> Result<Self, Error> {
        let mut parents = room(count)?;
        parents.extend(0..count as u32);
        Ok(Sets(parents))
    }

    /// The smallest number of a set.
    #[inline(always)]
    pub fn root(&mut self, mut number: u32) -> u32 {
        while self.0[number as usize] != number {
            let above = self.0[self.0[number as usize] as usize];
            self.0[number as usize] = above;
            number = above;
        }
        number
    }

    /// Makes two sets one; answers with its smallest number.
    #[inline(always)]
    pub fn join(&mut self, a: u32, b: u32) -> u32 {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
        a.min(b)
    }
}
