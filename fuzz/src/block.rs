//! Heap blocks of exactly the size that a call is told of: the address sanitizer sees the first byte beyond.

use crate::source::Source;

/// What every byte of a block is at first. Neither a status of a vertex nor, repeated, a number that a call computes.
pub const CANARY: u8 = 0xa5;

/// A heap block, filled with [`CANARY`].
pub struct Block {
    base: *mut u8,
    size: usize,
}

impl Block {
    pub fn new(size: usize) -> Block {
        // SAFETY: whatever `malloc` gives has `size` bytes.
        let base: *mut u8 = unsafe { libc::malloc(size) }.cast();
        assert!(!base.is_null(), "the harness asks for {size} bytes");
        // SAFETY: as above.
        unsafe { base.write_bytes(CANARY, size) };
        Block { base, size }
    }

    pub fn bytes(&self) -> &[u8] {
        // SAFETY: the block's own bytes, all written.
        unsafe { std::slice::from_raw_parts(self.base, self.size) }
    }

    pub fn bytes_mut(&mut self) -> &mut [u8] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts_mut(self.base, self.size) }
    }

    /// The address of a byte, or of the first one beyond.
    pub fn at(&self, offset: usize) -> *mut u8 {
        assert!(offset <= self.size);
        self.base.wrapping_add(offset)
    }

    pub fn is_untouched(&self) -> bool {
        self.bytes().iter().all(|&byte| byte == CANARY)
    }
}

impl Drop for Block {
    fn drop(&mut self) {
        // SAFETY: came from `malloc`, and nobody keeps it.
        unsafe { libc::free(self.base.cast()) };
    }
}

/// A value in a block of its own, rarely at an odd address, since the library promises to read structs anywhere.
pub struct Placed<T> {
    block: Block,
    offset: usize,
    kind: std::marker::PhantomData<T>,
}

impl<T: Copy> Placed<T> {
    pub fn new(source: &mut Source<'_>, value: &T) -> Placed<T> {
        Placed::sized(source, value, size_of::<T>())
    }

    /// The first `size` bytes of a value, zeros where it has fewer.
    pub(crate) fn sized(source: &mut Source<'_>, value: &T, size: usize) -> Placed<T> {
        let offset = if source.is_hostile() && source.rarely() { source.below(8) } else { 0 };
        let mut block = Block::new(offset + size);
        let place = &mut block.bytes_mut()[offset..];
        place.fill(0);
        let known = size.min(size_of::<T>());
        // SAFETY: `known` bytes are within both; the structs of the header have no padding.
        unsafe { std::ptr::copy_nonoverlapping((&raw const *value).cast::<u8>(), place.as_mut_ptr(), known) };
        Placed { block, offset, kind: std::marker::PhantomData }
    }

    pub fn pointer(&self) -> *mut T {
        self.block.at(self.offset).cast()
    }

    /// The bytes of the value as they are now.
    pub fn bytes(&self) -> &[u8] {
        &self.block.bytes()[self.offset..]
    }

    pub(crate) fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.block.bytes_mut()[self.offset..]
    }

    pub fn read(&self) -> T {
        assert!(self.bytes().len() >= size_of::<T>());
        // SAFETY: as many bytes as a `T` has, and only types valid for any bytes are placed.
        unsafe { self.pointer().read_unaligned() }
    }
}
