//! Segmentations as they are defined, step by step, at any cost.

use super::mesh::Mesh;
use super::{Vector, add, cross, dot, length, scale, sub};
use std::collections::{BTreeSet, HashMap};

pub const NO_SEGMENT: u32 = u32::MAX;

/// The faces across the edges of a face, with the edges, in the order of its corners.
pub type Neighbours = Vec<(usize, [u32; 2])>;

/// What meets what.
pub struct Meeting {
    /// For each face that counts; `None` for others.
    pub neighbours: Vec<Option<Neighbours>>,
    /// The faces at each edge.
    pub edges: HashMap<[u32; 2], Vec<usize>>,
}

pub fn meeting(mesh: &Mesh) -> Meeting {
    let loops: Vec<Vec<u32>> = mesh
        .faces()
        .map(|face| {
            let mut corners = face.to_vec();
            corners.dedup();
            while corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            corners
        })
        .collect();
    let mut sides: HashMap<[u32; 2], Vec<(usize, bool)>> = HashMap::new();
    let steps = |corners: &[u32]| -> Vec<[u32; 2]> {
        (0..corners.len()).map(|place| [corners[place], corners[(place + 1) % corners.len()]]).collect()
    };
    for (face, corners) in loops.iter().enumerate().filter(|(_, corners)| corners.len() >= 3) {
        for [a, b] in steps(corners) {
            sides.entry([a.min(b), a.max(b)]).or_default().push((face, a < b));
        }
    }
    let across = |face: usize, [a, b]: [u32; 2]| match sides[&[a.min(b), a.max(b)]][..] {
        [(one, up), (two, down)] if up != down => Some(if one == face && up == (a < b) { two } else { one }),
        _ => None,
    };
    let neighbours = loops.iter().enumerate().map(|(face, corners)| {
        // The steps of the face as it is written, so that neighbours come in the order of corners.
        let written = steps(mesh.face(face)).into_iter().filter(|[a, b]| a != b);
        let found = written.filter_map(|[a, b]| Some((across(face, [a, b])?, [a.min(b), a.max(b)])));
        (corners.len() >= 3).then(|| found.collect())
    });
    let neighbours = neighbours.collect();
    let edges = sides.into_iter().map(|(edge, at)| (edge, at.into_iter().map(|(face, _)| face).collect())).collect();
    Meeting { neighbours, edges }
}

impl Meeting {
    /// Floods from each face in turn, over the edges that `is_open(face, other, edge)`.
    pub fn components(&self, is_open: impl Fn(usize, usize, [u32; 2]) -> bool) -> Vec<u32> {
        let mut labels = vec![NO_SEGMENT; self.neighbours.len()];
        let mut count = 0;
        for start in 0..labels.len() {
            if labels[start] != NO_SEGMENT || self.neighbours[start].is_none() {
                continue;
            }
            labels[start] = count;
            let mut front = vec![start];
            while let Some(face) = front.pop() {
                for &(other, edge) in self.neighbours[face].as_ref().unwrap() {
                    if labels[other] == NO_SEGMENT && is_open(face, other, edge) {
                        labels[other] = count;
                        front.push(other);
                    }
                }
            }
            count += 1;
        }
        labels
    }

    /// The edges whose faces have different labels.
    pub fn boundary(&self, labels: &[u32]) -> Vec<[u32; 2]> {
        let differ = |faces: &Vec<usize>| faces.iter().any(|&face| labels[face] != labels[faces[0]]);
        let edges: BTreeSet<[u32; 2]> =
            self.edges.iter().filter(|(_, faces)| differ(faces)).map(|(edge, _)| *edge).collect();
        edges.into_iter().collect()
    }

    /// The watershed, level by level; basins are merged by going through all faces.
    pub fn watershed(&self, heights: &[f64], depth: f64) -> Vec<u32> {
        let used: Vec<usize> = (0..heights.len()).filter(|&face| self.neighbours[face].is_some()).collect();
        let around = |face: usize| self.neighbours[face].as_ref().unwrap().iter().map(|(other, _)| *other);
        let mut levels: Vec<f64> = used.iter().map(|&face| heights[face]).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        let mut basins: Vec<Option<usize>> = vec![None; heights.len()];
        let mut lowest: HashMap<usize, f64> = HashMap::new();
        for level in levels {
            let faces: Vec<usize> = used.iter().copied().filter(|&face| heights[face] == level).collect();
            let before = basins.clone();
            for &face in &faces {
                let lower = around(face).filter(|&other| heights[other] < level);
                let lower = lower.min_by(|&a, &b| heights[a].partial_cmp(&heights[b]).unwrap().then(a.cmp(&b)));
                basins[face] = lower.and_then(|lower| before[lower]);
            }
            loop {
                let now = basins.clone();
                let mut front: Vec<usize> = faces.iter().copied().filter(|&face| now[face].is_none()).collect();
                for &face in &front {
                    let near = around(face).filter(|&other| heights[other] == level && now[other].is_some());
                    basins[face] = near.min().and_then(|near| now[near]);
                }
                front.retain(|&face| basins[face].is_none());
                if basins == now {
                    // What is left has no lower neighbour anywhere: the first starts a basin.
                    let Some(&first) = front.first() else { break };
                    basins[first] = Some(first);
                    lowest.insert(first, level);
                }
            }
            for &face in &faces {
                for other in around(face) {
                    let (Some(a), Some(b)) = (basins[face], basins[other]) else { continue };
                    let (low, high) = (lowest[&a].min(lowest[&b]), lowest[&a].max(lowest[&b]));
                    if a != b && level - high < depth {
                        let (kept, gone) = (a.min(b), a.max(b));
                        lowest.insert(kept, low);
                        basins.iter_mut().filter(|basin| **basin == Some(gone)).for_each(|basin| *basin = Some(kept));
                    }
                }
            }
        }
        numbered(&basins)
    }

    /// How many basins are at least that deep, by pairing them with saddles: of two that meet, the one with the higher bottom ends.
    pub fn basin_count(&self, heights: &[f64], depth: f64) -> usize {
        let mut edges: Vec<(f64, usize, usize)> = vec![];
        for (face, others) in self.neighbours.iter().enumerate() {
            for &(other, _) in others.iter().flatten() {
                edges.push((heights[face].max(heights[other]), face, other));
            }
        }
        edges.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut set: Vec<usize> = (0..heights.len()).collect();
        let mut bottom = heights.to_vec();
        let mut count = self.neighbours.iter().flatten().count();
        for (saddle, a, b) in edges {
            let (a, b) = (set[a], set[b]);
            if a != b {
                let higher = bottom[a].max(bottom[b]);
                // A face on a slope, or in a plateau, has no depth of its own.
                count -= (saddle - higher < depth || saddle == higher) as usize;
                bottom[a] = bottom[a].min(bottom[b]);
                set.iter_mut().filter(|name| **name == b).for_each(|name| *name = a);
            }
        }
        count
    }
}

/// Numbers in the order of first occurrence.
pub fn numbered(names: &[Option<usize>]) -> Vec<u32> {
    let mut numbers = HashMap::new();
    let number = |name: &Option<usize>| match name {
        Some(name) => {
            let count = numbers.len() as u32;
            *numbers.entry(*name).or_insert(count)
        }
        None => NO_SEGMENT,
    };
    names.iter().map(number).collect()
}

/// Half the sum of the cross products around a face.
pub fn area_vector(mesh: &Mesh, face: usize) -> Vector {
    let corners: Vec<Vector> = mesh.face(face).iter().map(|&v| mesh.positions[v as usize]).collect();
    let mut sum = [0.0; 3];
    for place in 1..corners.len().max(2) - 1 {
        sum = add(sum, cross(sub(corners[place], corners[0]), sub(corners[place + 1], corners[0])));
    }
    scale(sum, 0.5)
}

/// The angle between the normals of two faces.
pub fn angle(mesh: &Mesh, a: usize, b: usize) -> f64 {
    let (a, b) = (area_vector(mesh, a), area_vector(mesh, b));
    length(cross(a, b)).atan2(dot(a, b))
}
