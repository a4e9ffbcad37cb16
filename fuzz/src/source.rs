//! Choices drawn from the fuzzer's bytes. Once these are used up every choice is the first one, which is always a tame one.

use arbitrary::{Arbitrary, Unstructured};

/// The bytes that are left, and whether the input may break the rules.
pub struct Source<'a> {
    bytes: Unstructured<'a>,
    hostile: bool,
}

/// Counts that no memory holds: whatever has so many elements must be refused before it is read.
pub const IMPOSSIBLE_COUNTS: [usize; 4] = [usize::MAX, usize::MAX - 1, isize::MAX as usize, 1 << 62];

impl<'a> Source<'a> {
    /// The first byte says whether the input is hostile. One that is not must be accepted by every call.
    pub fn new(data: &'a [u8]) -> Self {
        let mut source = Source { bytes: Unstructured::new(data), hostile: false };
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
