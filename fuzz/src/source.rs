//! Choices drawn from the fuzzer's bytes. Once these are used up every choice is the first one, which is always a tame one.

use arbitrary::{Arbitrary, Unstructured};

/// The bytes that are left, and whether the input may break the rules.
pub struct Source<'a> {
    bytes: Unstructured<'a>,
    hostile: bool,
    /// Of all bytes.
    hash: u32,
}

/// Counts that no memory holds: whatever has so many elements must be refused before it is read.
pub const IMPOSSIBLE_COUNTS: [usize; 4] = [usize::MAX, usize::MAX - 1, isize::MAX as usize, 1 << 62];

impl<'a> Source<'a> {
    /// The first byte says whether the input is hostile. One that is not must be accepted by every call.
    pub fn new(data: &'a [u8]) -> Self {
        let hash = data.iter().fold(0x811c_9dc5, |hash: u32, &byte| (hash ^ byte as u32).wrapping_mul(0x0100_0193));
        let mut source = Source { bytes: Unstructured::new(data), hostile: false, hash: hash ^ hash >> 15 };
        source.hostile = source.byte() & 1 == 1;
        source
    }

    pub fn is_hostile(&self) -> bool {
        self.hostile
    }

    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    pub fn number<T: Arbitrary<'a> + Default>(&mut self) -> T {
        self.bytes.arbitrary().unwrap_or_default()
    }

    pub fn byte(&mut self) -> u8 {
        self.number()
    }

    /// A number below `limit`, which is at least 1.
    pub fn below(&mut self, limit: usize) -> usize {
        if limit <= 256 { self.byte() as usize % limit } else { self.number::<u32>() as usize % limit }
    }

    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// Whether the input may do what takes long: one in `rarity` may, and what the fuzzer makes of it by changing a byte may not,
    /// so that it cannot breed slow inputs.
    pub fn may_be_slow(&self, rarity: u32) -> bool {
        self.hash.is_multiple_of(rarity)
    }

    /// One time in sixteen.
    pub fn rarely(&mut self) -> bool {
        self.byte() >= 240
    }

    /// One time in two.
    pub fn half(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// Whether to break a rule here: now and then, if the input is hostile.
    pub fn spoils(&mut self) -> bool {
        self.hostile && self.byte() >= 248
    }

    /// Any 32 bits, small ones more often than not.
    pub fn any_u32(&mut self) -> u32 {
        match self.byte() {
            0..128 => self.byte() as u32,
            128..160 => u32::MAX - self.byte() as u32,
            _ => self.number(),
        }
    }
}
