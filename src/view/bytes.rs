//! Bytes to read: one an element, at any byte stride.

use crate::error::Error;
use std::marker::PhantomData;

/// Borrowed bytes, at any stride: statuses and classes, as they were written.
#[derive(Clone, Copy, Debug)]
pub struct Bytes<'a> {
    base: *const u8,
    count: usize,
    stride: usize,
    memory: PhantomData<&'a [u8]>,
}

// SAFETY: a shared borrow of bytes that nobody writes.
unsafe impl Send for Bytes<'_> {}
// SAFETY: as above.
unsafe impl Sync for Bytes<'_> {}

impl<'a> Bytes<'a> {
    /// Bytes that start at `data` and lie `stride` bytes apart (0: packed). Messages say `what`.
    ///
    /// # Errors
    /// [`Error::NullPointer`] or [`Error::Size`].
    ///
    /// # Safety
    /// For the life of the view, the `count` bytes must lie in memory that may be read and that nobody writes. `data` may be null
    /// or dangling when `count` is 0.
    pub unsafe fn from_raw(data: *const u8, count: usize, stride: usize, what: &'static str) -> Result<Self, Error> {
        let stride = stride.max(1);
        if data.is_null() && count > 0 {
            return Err(Error::NullPointer { what });
        }
        // All of it fits before the end of the address space.
        let fits = count.checked_sub(1).is_none_or(|last| {
            let end = last.checked_mul(stride).filter(|&end| end < isize::MAX as usize);
            end.is_some_and(|end| (data as usize).checked_add(end).is_some())
        });
        if !fits {
            let expected = (isize::MAX as usize / stride) as u64;
            return Err(Error::Size { what, found: count as u64, expected });
        }
        Ok(Bytes { base: data, count, stride, memory: PhantomData })
    }

    /// The number of bytes.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// A byte.
    ///
    /// # Panics
    /// Where `index` is not below [`Bytes::len`].
    #[inline(always)]
    pub fn get(&self, index: usize) -> u8 {
        assert!(index < self.count);
        // SAFETY: one of the bytes that the view was made for.
        unsafe { *self.base.add(index * self.stride) }
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = u8> {
        (0..self.count).map(|index| self.get(index))
    }
}

impl<'a> From<&'a [u8]> for Bytes<'a> {
    fn from(bytes: &'a [u8]) -> Self {
        Bytes { base: bytes.as_ptr(), count: bytes.len(), stride: 1, memory: PhantomData }
    }
}

impl<'a> From<&'a Vec<u8>> for Bytes<'a> {
    fn from(bytes: &'a Vec<u8>) -> Self {
        Bytes::from(bytes.as_slice())
    }
}
