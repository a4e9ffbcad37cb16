//! Small meshes of every kind: closed, open, of several fans, with damaged faces; of triangles, polygons or both.

use crate::source::Source;
use std::f64::consts::TAU;

/// Faces as loops of vertices.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    pub vertex_count: usize,
    /// Where each face starts, and the end of the last.
    pub offsets: Vec<u32>,
    pub indices: Vec<u32>,
    /// Positions that go with the faces, as long as no fault has moved them apart.
    pub positions: Vec<[f64; 3]>,
}

impl Shape {
    /// A shape with some faults.
    pub fn new(source: &mut Source<'_>) -> Shape {
        // Room for most, so that arrays hardly ever grow.
        let (positions, indices) = (Vec::with_capacity(40), Vec::with_capacity(160));
        let mut shape = Shape { vertex_count: 0, offsets: Vec::with_capacity(64), indices, positions };
        shape.offsets.push(0);
        match source.below(12) {
            0 => shape.random_faces(source, 3..=3),
            1 => shape.random_faces(source, 0..=7),
            2 => shape.random_faces(source, 4..=4),
            3 => shape.sphere(source.below(6) + 3, source.below(3) + 1),
            4 => shape.grid(source.below(6) + 2, source.below(5) + 2, false, source.byte()),
            5 => shape.grid(source.below(6) + 3, source.below(4) + 3, true, source.byte()),
            6 => shape.fans(source.below(20) + 1, 1, source.half()),
            7 => shape.fans(source.below(7) + 2, source.below(3) + 2, source.half()),
            8 => shape.prism(source.below(9) + 3),
            9 => shape.book(source.below(6) + 3),
            10 => {
                shape.sphere(source.below(6) + 3, 1);
                shape.fans(source.below(20) + 1, 1, true);
            }
            _ => {}
        }
        let faults = if source.half() { source.below(8) } else { 0 };
        for _ in 0..faults {
            shape.fault(source);
        }
        shape
    }

    /// A sheet that may be longer than any neighbourhood is wide.
    pub fn sheet(source: &mut Source<'_>) -> Shape {
        let mut shape = Shape { offsets: vec![0], ..Shape::default() };
        shape.grid(source.below(24) + 8, source.below(3) + 2, false, source.byte());
        shape
    }

    pub fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }

    pub fn face(&self, face: usize) -> &[u32] {
        &self.indices[self.offsets[face] as usize..self.offsets[face + 1] as usize]
    }

    /// The corners that every face has, if there are faces and all have as many.
    pub fn arity(&self) -> Option<usize> {
        let arity = if self.face_count() == 0 { 3 } else { self.face(0).len() };
        self.offsets.iter().enumerate().all(|(face, &offset)| offset as usize == face * arity).then_some(arity)
    }

    fn vertex(&mut self, position: [f64; 3]) -> u32 {
        self.positions.push(position);
        self.vertex_count += 1;
        self.vertex_count as u32 - 1
    }

    fn add(&mut self, face: &[u32]) {
        self.indices.extend_from_slice(face);
        self.offsets.push(self.indices.len() as u32);
    }

    /// Faces of any vertices: every defect there is.
    fn random_faces(&mut self, source: &mut Source<'_>, sizes: std::ops::RangeInclusive<usize>) {
        let vertices = source.below(20) + 1;
        for vertex in 0..vertices {
            let angle = vertex as f64 * 2.4;
            self.vertex([angle.cos(), angle.sin(), vertex as f64 / 8.0]);
        }
        for _ in 0..source.below(30) {
            let size = sizes.start() + source.below(sizes.end() - sizes.start() + 1);
            for _ in 0..size {
                let vertex = source.below(vertices) as u32;
                self.indices.push(vertex);
            }
            self.offsets.push(self.indices.len() as u32);
        }
    }

    /// Poles and rings of vertices.
    fn sphere(&mut self, segments: usize, rings: usize) {
        let top = self.vertex([0.0, 0.0, 1.0]);
        let first = self.vertex_count as u32;
        for ring in 1..=rings {
            let polar = TAU / 2.0 * ring as f64 / (rings + 1) as f64;
            for segment in 0..segments {
                let around = TAU * segment as f64 / segments as f64;
                self.vertex([polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()]);
            }
        }
        let bottom = self.vertex([0.0, 0.0, -1.0]);
        let at = |ring: usize, segment: usize| first + (ring * segments + segment % segments) as u32;
        for segment in 0..segments {
            self.add(&[top, at(0, segment), at(0, segment + 1)]);
            for ring in 0..rings - 1 {
                let (a, b) = (at(ring, segment), at(ring + 1, segment));
                let (c, d) = (at(ring + 1, segment + 1), at(ring, segment + 1));
                self.add(&[a, b, c]);
                self.add(&[a, c, d]);
            }
            self.add(&[bottom, at(rings - 1, segment + 1), at(rings - 1, segment)]);
        }
    }

    /// Quads over a height field, or on a torus; a bit of `cuts` says whether a quad is cut, and another which way.
    fn grid(&mut self, columns: usize, rows: usize, torus: bool, cuts: u8) {
        let first = self.vertex_count as u32;
        for column in 0..columns {
            for row in 0..rows {
                let (x, y) = (column as f64, row as f64);
                self.vertex(if torus {
                    let (u, v) = (TAU * x / columns as f64, TAU * y / rows as f64);
                    [(1.0 + 0.4 * v.cos()) * u.cos(), (1.0 + 0.4 * v.cos()) * u.sin(), 0.4 * v.sin()]
                } else {
                    [x, y, 0.1 * x * x - 0.07 * x * y]
                });
            }
        }
        let at = |column: usize, row: usize| first + (column % columns * rows + row % rows) as u32;
        let ends = if torus { (columns, rows) } else { (columns - 1, rows - 1) };
        for column in 0..ends.0 {
            for row in 0..ends.1 {
                let [a, b, c, d] =
                    [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
                match cuts.rotate_right((3 * column + 5 * row) as u32) & 3 {
                    0 if cuts != 0 => self.add(&[a, b, c, d]),
                    1 => {
                        self.add(&[a, b, d]);
                        self.add(&[b, c, d]);
                    }
                    _ => {
                        self.add(&[a, b, c]);
                        self.add(&[a, c, d]);
                    }
                }
            }
        }
    }

    /// `count` fans of `corners` triangles around one vertex.
    fn fans(&mut self, corners: usize, count: usize, closed: bool) {
        let centre = self.vertex([0.0; 3]);
        for fan in 0..count {
            let first = self.vertex_count as u32;
            for spoke in 0..=corners {
                let angle = (TAU - 0.5) * spoke as f64 / corners as f64;
                let height = fan as f64 - 0.2;
                self.vertex([angle.cos(), angle.sin(), height]);
            }
            for corner in 0..corners as u32 {
                self.add(&[centre, first + corner, first + corner + 1]);
            }
            if closed {
                self.add(&[centre, first + corners as u32, first]);
            }
        }
    }

    /// Two polygons of so many corners, and quads between them.
    fn prism(&mut self, corners: usize) {
        let first = self.vertex_count as u32;
        for height in [0.0, 0.7] {
            for corner in 0..corners {
                let angle = TAU * corner as f64 / corners as f64;
                // Every other corner further in: reflex where there are many.
                let radius = if corner % 2 == 0 { 1.0 } else { 0.6 };
                self.vertex([radius * angle.cos(), radius * angle.sin(), height]);
            }
        }
        let count = corners as u32;
        let bottom: Vec<u32> = (first..first + count).rev().collect();
        let top: Vec<u32> = (first + count..first + 2 * count).collect();
        self.add(&bottom);
        self.add(&top);
        for corner in 0..count {
            let next = (corner + 1) % count;
            self.add(&[first + corner, first + next, first + count + next, first + count + corner]);
        }
    }

    /// Triangles that share one edge.
    fn book(&mut self, pages: usize) {
        let (a, b) = (self.vertex([0.0, 0.0, -1.0]), self.vertex([0.0, 0.0, 1.0]));
        for page in 0..pages {
            let angle = TAU * page as f64 / pages as f64;
            let c = self.vertex([angle.cos(), angle.sin(), 0.1]);
            self.add(&if page % 2 == 0 { [a, b, c] } else { [b, a, c] });
        }
    }

    /// One thing that is wrong with a mesh.
    fn fault(&mut self, source: &mut Source<'_>) {
        let faces = self.face_count();
        match source.below(9) {
            _ if faces == 0 => {}
            // A corner elsewhere: open edges, third faces, folds, repeated corners.
            0 | 1 => {
                let (corner, vertex) =
                    (source.below(self.indices.len().max(1)), source.below(self.vertex_count.max(1)));
                if let Some(index) = self.indices.get_mut(corner) {
                    *index = vertex as u32;
                }
            }
            // A face the other way round.
            2 => {
                let face = source.below(faces);
                let range = self.offsets[face] as usize..self.offsets[face + 1] as usize;
                self.indices[range].reverse();
            }
            // A face once more, or its back.
            3 => {
                let mut copy = self.face(source.below(faces)).to_vec();
                if source.half() {
                    copy.reverse();
                }
                self.add(&copy);
            }
            // A hole.
            4 => {
                let face = source.below(faces);
                let range = self.offsets[face] as usize..self.offsets[face + 1] as usize;
                let removed = range.len() as u32;
                self.indices.drain(range);
                self.offsets.remove(face);
                self.offsets[face..].iter_mut().for_each(|offset| *offset -= removed);
            }
            // Vertices that no face uses.
            5 => {
                for _ in 0..=source.below(3) {
                    self.vertex([0.5, 0.25, 3.0]);
                }
            }
            // Two vertices in one place.
            6 => {
                let (a, b) = (source.below(self.vertex_count.max(1)), source.below(self.vertex_count.max(1)));
                if let Some(&position) = self.positions.get(b) {
                    self.positions[a] = position;
                }
            }
            // The mesh's last vertex on one more face, whose positions a wide load could overrun.
            7 => {
                let (a, b) =
                    (source.below(self.vertex_count.max(1)) as u32, source.below(self.vertex_count.max(1)) as u32);
                self.add(&[self.vertex_count as u32 - 1, a, b]);
            }
            // A short face.
            _ => {
                let face: Vec<u32> =
                    (0..source.below(3)).map(|_| source.below(self.vertex_count.max(1)) as u32).collect();
                self.add(&face);
            }
        }
    }
}
