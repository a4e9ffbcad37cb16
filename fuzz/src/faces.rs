//! Faces as a call reads them: any type of index, uniform or by offsets.

use crate::block::Block;
use crate::shape::Shape;
use crate::source::{IMPOSSIBLE_COUNTS, Source};
use umbilic::capi::*;

/// Index arrays in memory of their own.
pub struct FaceArrays {
    /// Keep the memory.
    _indices: Block,
    _offsets: Option<Block>,
    pub view: umb_faces,
}

impl FaceArrays {
    /// `too_many`: whether more corners than a topology holds may be claimed, which are refused before any is read.
    pub fn new(source: &mut Source<'_>, shape: &Shape, too_many: bool) -> FaceArrays {
        let mut index = source.pick(&[UMB_INDEX_U32, UMB_INDEX_U32, UMB_INDEX_I32, UMB_INDEX_U64]);
        let arity = shape.arity().filter(|&arity| arity >= 3 && source.byte() < 192);
        let (mut index_count, mut face_count) = (shape.indices.len(), shape.face_count());
        if source.spoils() {
            index_count = source.below(2 * index_count + 8);
        }
        if source.spoils() {
            face_count = source.below(2 * face_count + 8);
        }
        let indices = integers(source, &shape.indices, index_count, index, shape.vertex_count as u64);
        let offsets = match arity {
            Some(_) => None,
            None => Some(integers(source, &shape.offsets, face_count + 1, index, index_count as u64)),
        };
        if arity.is_some() && source.half() {
            face_count = 0;
        }
        let mut arity = match arity {
            Some(3) if source.half() => 0,
            Some(arity) => arity as u32,
            None => 0,
        };
        let ((indices, at), offsets) = (indices, offsets);
        let offsets_at = offsets.as_ref().map_or(std::ptr::null(), |(_, at)| *at);
        if source.spoils() {
            match source.below(5) {
                // As many bytes or fewer.
                0 => {
                    index = if index == UMB_INDEX_U64 { source.below(3) as u32 } else { 3 + source.any_u32() % 1000 }
                }
                1 => arity = source.any_u32(),
                2 if offsets.is_none() => index_count = source.pick(&IMPOSSIBLE_COUNTS),
                2 => face_count = source.pick(&IMPOSSIBLE_COUNTS),
                3 if too_many && offsets.is_none() && arity < 4 => index_count = 3 << 30,
                _ => index = source.any_u32() | 4,
            }
        }
        let null = source.spoils();
        let view = umb_faces {
            indices: if null && source.half() { std::ptr::null() } else { at },
            index_count,
            offsets: if null { std::ptr::null() } else { offsets_at },
            face_count,
            index,
            arity,
        };
        FaceArrays { _indices: indices, _offsets: offsets.map(|(block, _)| block), view }
    }

    /// The number of faces that the library will take these for; at most so many that results fit into memory.
    pub fn face_count(&self) -> usize {
        let umb_faces { index_count, offsets, face_count, arity, .. } = self.view;
        let arity = if arity == 0 { 3 } else { arity as usize };
        let count = if offsets.is_null() { index_count / arity } else { face_count };
        if count < 1 << 16 { count } else { 1 }
    }

    /// As [`FaceArrays::face_count`], the number of corners.
    pub fn corner_count(&self) -> usize {
        if self.view.index_count < 1 << 16 { self.view.index_count } else { 1 }
    }

    /// Where each face starts and the end of the last, and the corners of all, as a call that succeeded has read them.
    pub fn read(&self) -> (Vec<u32>, Vec<u32>) {
        let umb_faces { indices, index_count, offsets, index, arity, .. } = self.view;
        let wide = index == UMB_INDEX_U64;
        // SAFETY: the call has read as many from there, and that they are in range.
        let at = |array: *const libc::c_void, place: usize| unsafe {
            if wide { *array.cast::<u64>().add(place) as u32 } else { *array.cast::<u32>().add(place) }
        };
        let count = self.face_count();
        let starts = match offsets.is_null() {
            true => (0..=count).map(|face| (face * if arity == 0 { 3 } else { arity as usize }) as u32).collect(),
            false => (0..=count).map(|face| at(offsets, face)).collect(),
        };
        (starts, (0..index_count).map(|corner| at(indices, corner)).collect())
    }
}

/// `count` integers, the first of them those of `values`, and where they start.
fn integers(
    source: &mut Source<'_>,
    values: &[u32],
    count: usize,
    index: umb_index,
    limit: u64,
) -> (Block, *const libc::c_void) {
    let size = if index == UMB_INDEX_U64 { 8 } else { 4 };
    let start = if source.spoils() {
        source.below(16)
    } else if source.rarely() {
        size
    } else {
        0
    };
    let mut block = Block::new(start + count * size);
    let places = block.bytes_mut()[start..].chunks_exact_mut(size);
    for (place, &value) in places.zip(values) {
        place.copy_from_slice(&(value as u64).to_ne_bytes()[..size]);
    }
    if count > 0 && source.spoils() {
        for _ in 0..=source.below(3) {
            let wrong = match source.below(4) {
                0 => limit,
                1 => source.any_u32() as u64,
                2 => u64::MAX - source.byte() as u64,
                _ => source.number(),
            };
            let place = start + source.below(count) * size;
            block.bytes_mut()[place..place + size].copy_from_slice(&wrong.to_ne_bytes()[..size]);
        }
    }
    let at = block.at(start).cast_const().cast();
    (block, at)
}
