//! What cuts and segmentations take: lists of numbers, creases, scalars.

use crate::arrays::Input;
use crate::block::Block;
use crate::coordinates::rows;
use crate::scene::Scene;
use crate::shape::Shape;
use crate::source::{IMPOSSIBLE_COUNTS, Source};
use crate::structs::{Struct, zeroed};
use umbilic::capi::*;

/// Packed numbers, in a block that ends with the last.
pub struct List<T> {
    /// Keeps the memory.
    _block: Block,
    /// What there is.
    values: Vec<T>,
    pub data: *const T,
    /// The number of elements that the call is told.
    pub count: usize,
}

impl<T: Copy> List<T> {
    /// Elements of `each` numbers.
    pub fn new(source: &mut Source<'_>, mut values: Vec<T>, each: usize) -> List<T> {
        if source.spoils() {
            values.truncate(each * source.below(values.len() / each + 1));
        }
        let bytes = size_of_val(&values[..]);
        let start = if source.spoils() { source.below(8) } else { 0 };
        let block = Block::new(start + bytes);
        // SAFETY: the block has as many bytes from there.
        unsafe { block.at(start).copy_from_nonoverlapping(values.as_ptr().cast(), bytes) };
        let (mut data, mut count) = (block.at(start).cast_const().cast(), values.len() / each);
        if source.spoils() {
            match source.half() {
                true => data = std::ptr::null(),
                false => count = source.pick(&IMPOSSIBLE_COUNTS),
            }
        }
        List { _block: block, values, data, count }
    }

    /// What a call that succeeded has read.
    pub fn seen(&self) -> &[T] {
        if self.data.is_null() { &[] } else { &self.values }
    }
}

impl List<u8> {
    /// As calls take bytes.
    pub fn bytes(&self) -> umb_bytes {
        umb_bytes { data: self.data, count: self.count, stride: 0 }
    }
}

/// Marked edges and smoothing groups.
pub struct Creases {
    edges: Option<List<u32>>,
    groups: Option<List<u32>>,
    view: Struct<umb_creases>,
    /// What the library sees of it.
    pub seen: umb_creases,
}

impl Creases {
    pub fn new(source: &mut Source<'_>, scene: &Scene) -> Creases {
        let mut seen: umb_creases = zeroed();
        seen.angle = match source.byte() {
            0..64 => 0.0,
            64..128 => 4.0,
            byte @ 128..224 => (byte - 127) as f64 / 32.0,
            _ => source.pick(&[f64::INFINITY, 5e-324, 1e-9, std::f64::consts::PI, f64::MAX]),
        };
        if source.spoils() {
            seen.angle = f64::from_bits(source.number());
        }
        let edges = (source.byte() & 3 == 3).then(|| {
            let mut ends = vec![];
            for _ in 0..if scene.vertex_count == 0 { 0 } else { source.below(12) } {
                ends.extend(edge(source, &scene.shape));
            }
            spoil(source, &mut ends);
            List::new(source, ends, 2)
        });
        let groups = (source.byte() & 3 == 3).then(|| {
            let (draw, faces) = (source.number::<u32>(), scene.faces.face_count() as u32);
            let mut groups: Vec<u32> = (0..faces).map(|face| draw.rotate_left(face * 7) % 4).collect();
            if let Some(group) = groups.first_mut() {
                *group = source.any_u32();
            }
            List::new(source, groups, 1)
        });
        if let Some(edges) = &edges {
            (seen.edges, seen.edge_count) = (edges.data, edges.count);
        }
        if let Some(groups) = &groups {
            (seen.groups, seen.group_count) = (groups.data, groups.count);
        }
        if source.spoils() {
            seen.reserved = source.any_u32();
        }
        let bytes = &raw const seen;
        // SAFETY: the struct has no padding.
        let is_default = unsafe { std::slice::from_raw_parts(bytes.cast::<u8>(), size_of_val(&seen)) };
        let is_default = is_default.iter().all(|&byte| byte == 0);
        let view = Struct::new(source, &mut seen, is_default);
        Creases { edges, groups, view, seen }
    }

    /// The angle that a call goes by.
    pub fn angle(&self) -> f64 {
        let marked = self.seen.edge_count > 0 || !self.seen.groups.is_null();
        match self.seen.angle {
            0.0 if marked => std::f64::consts::PI,
            0.0 => std::f64::consts::FRAC_PI_6,
            angle => angle,
        }
    }

    pub fn pointer(&self) -> *const umb_creases {
        self.view.pointer()
    }

    /// Checks that a call could accept these.
    pub fn check_accepted(&self, vertex_count: usize, face_count: usize) {
        assert!(self.seen.reserved == 0 && self.seen.angle >= 0.0, "angle {}", self.seen.angle);
        let in_range = self.edges().iter().all(|&[_, high]| (high as usize) < vertex_count);
        assert!(in_range, "edges {:?} among {vertex_count} vertices", self.edges());
        assert!(self.groups().is_none_or(|groups| groups.len() == face_count), "{:?}", self.groups());
    }

    /// Marked edges, the lower vertex first.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let list = self.edges.as_ref().map_or(&[][..], List::seen);
        list.chunks_exact(2).map(|ends| [ends[0].min(ends[1]), ends[0].max(ends[1])]).collect()
    }

    pub fn groups(&self) -> Option<&[u32]> {
        self.groups.as_ref().filter(|groups| !groups.data.is_null()).map(List::seen)
    }
}

/// The ends of an edge of a face, or any two vertices, of which there are some.
fn edge(source: &mut Source<'_>, shape: &Shape) -> [u32; 2] {
    let face = if shape.face_count() > 0 { shape.face(source.below(shape.face_count())) } else { &[] };
    if face.is_empty() || source.rarely() {
        return [(); 2].map(|()| source.below(shape.vertex_count) as u32);
    }
    let corner = source.below(face.len());
    [face[corner], face[(corner + 1) % face.len()]]
}

/// Makes one of the vertices another.
pub fn spoil(source: &mut Source<'_>, vertices: &mut [u32]) {
    if !vertices.is_empty() && source.spoils() {
        let place = source.below(vertices.len());
        vertices[place] = source.any_u32();
    }
}

/// Numbers at vertices or faces.
pub fn scalars(source: &mut Source<'_>, count: usize) -> Input {
    let natural: Vec<[f64; 3]> = (0..count).map(|index| [(0.37 * index as f64).fract() - 0.3, 0.0, 0.0]).collect();
    let double = source.half();
    let rows = rows(source, &natural, count, double);
    Input::new(source, &rows, 1, double)
}

/// As a call reads them; what spoils a reserved field spoils the location.
pub fn located(input: &Input, location: umb_location) -> umb_scalars {
    let &Input { data, count, stride, scalar, reserved, .. } = input;
    umb_scalars { data, count, stride, scalar, location: if reserved == 0 { location } else { reserved } }
}
