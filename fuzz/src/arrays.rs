//! Arrays to read and to write: any scalar, stride and start, in a block that ends with the last element.

use crate::block::{Block, CANARY};
use crate::source::{IMPOSSIBLE_COUNTS, Source};
use umbilic::capi::*;

/// How the elements of an array lie in its block.
#[derive(Clone, Copy)]
struct Layout {
    /// Bytes before the first element.
    start: usize,
    /// As the call is told.
    stride: usize,
    /// Bytes from one element to the next.
    step: usize,
    /// Bytes of an element.
    element: usize,
    /// Bytes of the block.
    size: usize,
}

impl Layout {
    fn new(source: &mut Source<'_>, scalar: usize, components: usize, count: usize) -> Layout {
        let element = scalar * components;
        let (mut start, mut stride) = match source.byte() {
            0..128 => (0, 0),
            128..160 => (0, element),
            160..192 => (scalar, element + scalar),
            192..224 => (scalar * source.below(8), element + scalar * source.below(8)),
            _ => (scalar, 0),
        };
        if source.spoils() {
            stride = match source.below(4) {
                0 => source.below(element),
                1 => element + 1 + source.below(16),
                2 => source.pick(&IMPOSSIBLE_COUNTS),
                _ => element * 4,
            };
        }
        if source.spoils() {
            start = source.below(16);
        }
        let step = if stride == 0 { element } else { stride };
        // Where the elements do not fit into memory the call must refuse the stride, unless there is only one.
        let span = step.checked_mul(count.saturating_sub(1)).filter(|&span| span < 1 << 24).unwrap_or(0);
        let size = start + if count == 0 { 0 } else { span + element };
        Layout { start, stride, step, element, size }
    }
}

/// Positions, normals, directions or the points of a polyline, as a call reads them.
pub struct Input {
    /// Keeps the memory.
    _block: Option<Block>,
    pub data: *const libc::c_void,
    /// The number that the call is told.
    pub count: usize,
    pub stride: usize,
    pub scalar: umb_scalar,
    pub reserved: u32,
    /// Whether all numbers are finite in the array's scalar.
    pub finite: bool,
}

impl Input {
    /// `rows` with their first `components` numbers, as `f32` or `f64`.
    pub fn new(source: &mut Source<'_>, rows: &[[f64; 3]], components: usize, double: bool) -> Input {
        let mut count = rows.len();
        if source.spoils() {
            count = source.below(2 * count + 2);
        }
        let scalar = if double { 8 } else { 4 };
        let layout = Layout::new(source, scalar, components, count);
        let mut block = Block::new(layout.size);
        // No canaries where there are fewer rows than the call is told of: a result could well be one.
        block.bytes_mut().fill(0);
        let mut finite = true;
        for (index, row) in rows.iter().take(count).enumerate() {
            let place = layout.start.wrapping_add(index.wrapping_mul(layout.step));
            let Some(bytes) = block.bytes_mut().get_mut(place..place.wrapping_add(layout.element)) else { break };
            for (axis, bytes) in bytes.chunks_exact_mut(scalar).enumerate() {
                let value = row[axis];
                if double {
                    bytes.copy_from_slice(&value.to_ne_bytes());
                    finite &= value.is_finite();
                } else {
                    bytes.copy_from_slice(&(value as f32).to_ne_bytes());
                    finite &= (value as f32).is_finite();
                }
            }
        }
        let mut input = Input {
            data: block.at(layout.start).cast_const().cast(),
            count,
            stride: layout.stride,
            scalar: if double { UMB_SCALAR_F64 } else { UMB_SCALAR_F32 },
            reserved: 0,
            finite,
            _block: Some(block),
        };
        if source.spoils() {
            match source.below(4) {
                0 => input.data = std::ptr::null(),
                1 => {
                    // The other scalar only where it needs no more memory.
                    let known = if double { UMB_SCALAR_F32 } else { 2 };
                    input.scalar = if source.half() { known } else { 2 + source.any_u32() % (u32::MAX - 2) };
                    input.finite = false;
                }
                2 => input.reserved = source.any_u32(),
                _ => input.count = source.pick(&IMPOSSIBLE_COUNTS),
            }
        }
        input
    }

    pub fn points(&self) -> umb_points {
        let &Input { data, count, stride, scalar, reserved, .. } = self;
        umb_points { data, count, stride, scalar, reserved }
    }
}

/// An array that a call writes.
pub struct Target {
    block: Option<Block>,
    layout: Layout,
    components: usize,
    count: usize,
    double: bool,
    view: umb_output,
}

impl Target {
    /// Room for `count` elements of so many scalars.
    pub fn new(source: &mut Source<'_>, components: usize, count: usize, double: bool) -> Target {
        let layout = Layout::new(source, if double { 8 } else { 4 }, components, count);
        let block = Block::new(layout.size);
        let scalar = if double { UMB_SCALAR_F64 } else { UMB_SCALAR_F32 };
        let mut view = umb_output { data: block.at(layout.start).cast(), stride: layout.stride, scalar, reserved: 0 };
        let mut double = double;
        if source.spoils() {
            match source.below(3) {
                0 => view.data = std::ptr::null_mut(),
                1 if double && layout.stride == 0 && source.half() => {
                    // Twice as many elements of half the size would fit.
                    view.scalar = UMB_SCALAR_F32;
                    double = false;
                }
                1 => view.scalar = 2 + source.any_u32() % (u32::MAX - 2),
                _ => view.reserved = source.any_u32(),
            }
        }
        let scalar = if double { 8 } else { 4 };
        let step = if layout.stride == 0 { scalar * components } else { layout.step };
        let layout = Layout { step, element: scalar * components, ..layout };
        let block = (!view.data.is_null()).then_some(block);
        Target { block, layout, components, count, double, view }
    }

    /// Nothing that is wanted.
    pub fn none(source: &mut Source<'_>) -> Target {
        let mut view = umb_output { data: std::ptr::null_mut(), stride: 0, scalar: 0, reserved: 0 };
        if source.spoils() {
            (view.stride, view.scalar) = (source.number::<usize>(), source.any_u32());
        }
        let layout = Layout { start: 0, stride: 0, step: 1, element: 0, size: 0 };
        Target { block: None, layout, components: 1, count: 0, double: false, view }
    }

    pub fn view(&self) -> umb_output {
        self.view
    }

    pub fn is_wanted(&self) -> bool {
        self.block.is_some()
    }

    pub fn is_double(&self) -> bool {
        self.double
    }

    pub fn is_untouched(&self) -> bool {
        self.block.as_ref().is_none_or(Block::is_untouched)
    }

    /// Checks that no byte was written but those of the elements that `may` names.
    pub fn check_gaps(&self, may: impl Fn(usize) -> bool, what: &str) {
        let Some(block) = &self.block else { return };
        let Layout { start, step, element, .. } = self.layout;
        for (place, &byte) in block.bytes().iter().enumerate() {
            if byte != CANARY {
                let offset = place.wrapping_sub(start);
                let inside = place >= start && offset % step < element && offset / step < self.count;
                assert!(inside, "{what}: byte {place} is no element's, but was written");
                assert!(may(offset / step), "{what}: element {} was not asked for, but was written", offset / step);
            }
        }
    }

    /// An element after a call that succeeded; the numbers it has not are zero.
    pub fn element(&self, index: usize) -> [f64; 3] {
        let mut element = [0.0; 3];
        let Some(block) = &self.block else { return element };
        let bytes = &block.bytes()[self.layout.start + index * self.layout.step..][..self.layout.element];
        let scalar = if self.double { 8 } else { 4 };
        for (axis, bytes) in bytes.chunks_exact(scalar).enumerate().take(self.components) {
            assert!(bytes.iter().any(|&byte| byte != CANARY), "element {index} was not written");
            element[axis] = match bytes.try_into() {
                Ok(bytes) => f64::from_ne_bytes(bytes),
                Err(_) => f32::from_ne_bytes(bytes.try_into().expect("four bytes")).into(),
            };
        }
        element
    }

    /// As [`Target::element`], checked to be finite.
    pub fn finite(&self, index: usize, what: &str) -> [f64; 3] {
        let element = self.element(index);
        assert!(element.iter().all(|x| x.is_finite()), "{what}, element {index}: {element:?}");
        element
    }

    /// As [`Target::element`], checked to be of length 1 or zero; whether it is not zero.
    pub fn unit(&self, index: usize, what: &str) -> bool {
        let [x, y, z] = self.finite(index, what);
        let length = (x * x + y * y + z * z).sqrt();
        let tolerance = if self.double { 1e-14 } else { 3e-7 };
        let zero = [x, y, z] == [0.0; 3];
        assert!(zero || (length - 1.0).abs() <= tolerance, "{what}, element {index}: length {length}");
        !zero
    }
}

/// An array of status bytes.
pub struct Bytes {
    block: Option<Block>,
    stride: usize,
    view: umb_status_output,
    count: usize,
}

impl Bytes {
    pub fn new(source: &mut Source<'_>, count: usize, wanted: bool) -> Bytes {
        if !wanted {
            let view = umb_status_output { data: std::ptr::null_mut(), stride: 0 };
            return Bytes { block: None, stride: 1, view, count };
        }
        let mut stride = if source.half() { 0 } else { source.below(5) };
        if source.spoils() {
            stride = source.pick(&IMPOSSIBLE_COUNTS);
        }
        let step = stride.max(1);
        let span = step.checked_mul(count.saturating_sub(1)).filter(|&span| span < 1 << 24).unwrap_or(0);
        let block = Block::new(if count == 0 { 0 } else { span + 1 });
        Bytes { view: umb_status_output { data: block.at(0), stride }, stride: step, block: Some(block), count }
    }

    pub fn view(&self) -> umb_status_output {
        self.view
    }

    pub fn is_wanted(&self) -> bool {
        self.block.is_some()
    }

    pub fn is_untouched(&self) -> bool {
        self.block.as_ref().is_none_or(Block::is_untouched)
    }

    pub fn check_gaps(&self, may: impl Fn(usize) -> bool, what: &str) {
        let Some(block) = &self.block else { return };
        for (place, &byte) in block.bytes().iter().enumerate() {
            let element = place / self.stride;
            let allowed = place % self.stride == 0 && element < self.count && may(element);
            assert!(byte == CANARY || allowed, "{what}: byte {place} was written");
        }
    }

    /// A status after a call that succeeded.
    pub fn element(&self, index: usize) -> Option<u8> {
        self.block.as_ref().map(|block| block.bytes()[index * self.stride])
    }
}
