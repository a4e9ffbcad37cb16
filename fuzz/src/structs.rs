//! Versioned structs of any size: of the first version, of this one, of a later one, and of none.

use crate::block::Placed;
use crate::source::Source;
use umbilic::capi::*;

/// A struct that starts with its size.
pub trait Versioned: Copy {
    /// The size of its first version, which never changes.
    const FIRST_SIZE: usize;
}

macro_rules! versioned {
    ($($name:ident: $size:literal;)*) => {$(
        impl Versioned for $name {
            const FIRST_SIZE: usize = $size;
        }
        const _: () = assert!(size_of::<$name>() >= $size);
    )*};
}
versioned! {
    umb_topology_options: 16;
    umb_topology_stats: 152;
    umb_adaptive_model: 88;
    umb_normal_options: 64;
    umb_face_options: 48;
    umb_normal_outputs: 72;
    umb_face_outputs: 72;
    umb_curvature_options: 120;
    umb_curvature_outputs: 408;
    umb_section_options: 136;
    umb_section_outputs: 72;
    umb_polyline_options: 48;
    umb_polyline_outputs: 120;
    umb_creases: 48;
    umb_corner_outputs: 96;
    umb_moved: 48;
    umb_shape_options: 88;
    umb_feature_options: 56;
    umb_watershed_options: 72;
    umb_region_options: 112;
    umb_error: 256;
}

/// An all-zero struct: the defaults.
pub fn zeroed<T: Copy>() -> T {
    // SAFETY: every struct of the header is valid for zeros.
    unsafe { std::mem::zeroed() }
}

/// A struct in memory of exactly the size that it claims, or null. `value` becomes what the library may see of it.
pub struct Struct<T>(Option<Placed<T>>);

impl<T: Versioned> Struct<T> {
    /// `is_default`: all zeros say what `value` says, so that null may stand for it.
    pub fn new(source: &mut Source<'_>, value: &mut T, is_default: bool) -> Struct<T> {
        let whole = size_of::<T>();
        let mut claimed = whole;
        let mut present = whole;
        let mut tail = false;
        match source.byte() {
            0..192 => {}
            192..216 => (claimed, present) = (0, T::FIRST_SIZE),
            216..240 => {
                claimed = whole + 1 + source.below(64);
                present = claimed;
            }
            _ if is_default => return Struct(None),
            _ => {}
        }
        if source.spoils() {
            match source.below(4) {
                0 => claimed = 1 + source.below(T::FIRST_SIZE - 1),
                1 => claimed = 4097 + source.below(1 << 20),
                2 => claimed = u32::MAX as usize - source.below(8),
                _ => {
                    claimed = whole + 1 + source.below(64);
                    tail = true;
                }
            }
            // What is beyond any version must be refused by its size alone.
            present = if claimed > 4096 { 4 } else { claimed.max(4) };
        }
        let seen = if claimed == 0 { T::FIRST_SIZE } else { claimed };
        if seen < whole {
            // SAFETY: within the value, and valid for zeros.
            unsafe { (&raw mut *value).cast::<u8>().add(seen).write_bytes(0, whole - seen) };
        }
        let mut placed = Placed::sized(source, value, present);
        let bytes = placed.bytes_mut();
        bytes[..4].copy_from_slice(&(claimed as u32).to_ne_bytes());
        if tail {
            let byte = whole + source.below(present - whole);
            bytes[byte] = source.byte();
        }
        Struct(Some(placed))
    }

    pub fn null() -> Struct<T> {
        Struct(None)
    }

    pub fn pointer(&self) -> *mut T {
        self.0.as_ref().map_or(std::ptr::null_mut(), Placed::pointer)
    }

    pub fn is_null(&self) -> bool {
        self.0.is_none()
    }

    /// As many bytes as are there.
    pub fn bytes(&self) -> &[u8] {
        self.0.as_ref().map_or(&[], Placed::bytes)
    }
}
