//! `umbilic info`: what a mesh is made of and what is wrong with it.

use super::Outcome;
use crate::compute::{self, blame};
use crate::mesh::PolygonMesh;
use crate::read::read_mesh;
use crate::table;
use clap::Args;
use serde_json::{Value, json};
use std::path::PathBuf;
use umbilic::{Topology, TopologyStats};

/// Tell what a mesh is made of and what is wrong with it.
///
/// The genus is the number of handles of all components together. It is defined for surfaces without non-manifold
/// edges and vertices whose faces agree on the orientation.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic info cow.obj")]
pub struct Info {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Print one JSON object instead of tables.
    #[arg(long)]
    json: bool,
}

impl Info {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let mesh = read_mesh(&self.input)?;
        let topology = compute::topology(&mesh).map_err(blame(&self.input))?;
        let stats = topology.stats().map_err(blame(&self.input))?;
        let facts = Facts {
            corners: Corners::of(&mesh),
            lengths: Lengths::of(&mesh, &topology),
            bounds: mesh.bounding_box(),
            genus: genus(&stats),
            stats,
        };
        let defects = facts.defects(&mesh);
        Ok(if self.json { format!("{:#}\n", facts.json(&defects)) } else { facts.text(&defects) })
    }
}

/// What is told.
struct Facts {
    stats: TopologyStats,
    corners: Corners,
    lengths: Option<Lengths>,
    bounds: Option<([f64; 3], [f64; 3])>,
    genus: Result<i64, &'static str>,
}

/// Something wrong with a mesh.
struct Defect {
    key: &'static str,
    words: &'static str,
    count: usize,
}

impl Facts {
    fn defects(&self, mesh: &PolygonMesh) -> Vec<Defect> {
        let stats = &self.stats;
        let infinite = mesh.positions.iter().filter(|position| position.iter().any(|x| !x.is_finite())).count();
        let defect = |key, count, words| Defect { key, words, count };
        vec![
            defect("non_manifold_edges", stats.non_manifold_edges, "edges with more than two faces"),
            defect("winding_edges", stats.winding_edges, "edges whose two faces disagree on the orientation"),
            defect("non_manifold_vertices", stats.non_manifold_vertices, "vertices whose faces form no single fan"),
            defect("isolated_vertices", stats.isolated_vertices, "vertices without a face"),
            defect(
                "degenerate_faces",
                stats.degenerate_faces,
                "faces that name a vertex twice in a row or have fewer than three corners",
            ),
            defect(
                "ignored_faces",
                stats.ignored_faces,
                "of these, faces with so few corners left that they are ignored",
            ),
            defect("duplicate_faces", stats.duplicate_faces, "faces that repeat an earlier one"),
            defect(
                "zero_length_edges",
                self.lengths.as_ref().map_or(0, |lengths| lengths.zero),
                "edges whose two ends are in the same place",
            ),
            defect("non_finite_vertices", infinite, "vertices with a coordinate that is infinite or no number"),
        ]
    }

    fn text(&self, defects: &[Defect]) -> String {
        let Facts { stats, corners, lengths, bounds, genus } = self;
        let mut rows = vec![
            ("vertices", stats.vertex_count.to_string()),
            (
                "faces",
                format!(
                    "{}: {} triangles, {} quads, {} larger",
                    stats.face_count, corners.triangles, corners.quads, corners.larger
                ),
            ),
            ("edges", stats.edge_count.to_string()),
            ("components", stats.component_count.to_string()),
            (
                "boundary",
                format!(
                    "{} loops, {} edges, {} vertices",
                    stats.boundary_loops, stats.boundary_edges, stats.boundary_vertices
                ),
            ),
            ("Euler characteristic", stats.euler_characteristic.to_string()),
            ("genus", genus.map_or_else(|why| format!("not defined: {why}"), |genus| genus.to_string())),
            ("largest valence", stats.max_valence.to_string()),
        ];
        if let Some(lengths) = lengths {
            let numbers = [lengths.least, lengths.mean, lengths.most, lengths.ratio()];
            let [least, mean, most, ratio] = numbers.map(table::number);
            rows.push(("edge lengths", format!("{least} to {most}, mean {mean}, ratio {ratio}")));
        }
        if let Some((low, high)) = *bounds {
            rows.push(("bounding box", format!("{} to {}", table::point(low), table::point(high))));
        }
        rows.push(("topology memory", table::bytes(stats.bytes)));
        let mut text = table::table(&rows);
        let found: Vec<&Defect> = defects.iter().filter(|defect| defect.count > 0).collect();
        let width = found.iter().map(|defect| defect.count.to_string().len()).max().unwrap_or(0);
        text += if found.is_empty() { "\nno defects\n" } else { "\ndefects\n" };
        for Defect { words, count, .. } in found {
            text += &format!("  {count:width$}  {words}\n");
        }
        text
    }

    fn json(&self, defects: &[Defect]) -> Value {
        let Facts { stats, corners, lengths, bounds, genus } = self;
        let defects: serde_json::Map<_, _> =
            defects.iter().map(|defect| (defect.key.to_owned(), defect.count.into())).collect();
        json!({
            "vertices": stats.vertex_count,
            "faces": stats.face_count,
            "triangles": corners.triangles,
            "quads": corners.quads,
            "larger_faces": corners.larger,
            "edges": stats.edge_count,
            "components": stats.component_count,
            "boundary_loops": stats.boundary_loops,
            "boundary_edges": stats.boundary_edges,
            "boundary_vertices": stats.boundary_vertices,
            "euler_characteristic": stats.euler_characteristic,
            "genus": genus.ok(),
            "genus_undefined_because": genus.err(),
            "largest_valence": stats.max_valence,
            "edge_lengths": lengths.as_ref().map(|lengths| json!({
                "min": lengths.least,
                "mean": lengths.mean,
                "max": lengths.most,
                "ratio": lengths.ratio(),
                "zero": lengths.zero,
            })),
            "bounding_box": bounds.map(|(low, high)| json!({ "min": low, "max": high })),
            "topology_bytes": stats.bytes,
            "defects": defects,
        })
    }
}

/// The number of handles, or why it is not defined.
fn genus(stats: &TopologyStats) -> Result<i64, &'static str> {
    if stats.corner_count == 0 {
        return Err("there are no faces");
    }
    if stats.non_manifold_edges > 0 {
        return Err("some edges have more than two faces");
    }
    if stats.winding_edges > 0 {
        return Err("some faces disagree on the orientation");
    }
    if stats.non_manifold_vertices > 0 {
        return Err("at some vertices the faces form no single fan");
    }
    let doubled = 2 * stats.component_count as i64 - stats.boundary_loops as i64 - stats.euler_characteristic;
    if doubled < 0 || doubled % 2 != 0 { Err("some faces meet themselves") } else { Ok(doubled / 2) }
}

/// Faces by their number of corners in the file.
#[derive(Default)]
struct Corners {
    triangles: usize,
    quads: usize,
    larger: usize,
}

impl Corners {
    fn of(mesh: &PolygonMesh) -> Self {
        let mut corners = Corners::default();
        for face in mesh.faces() {
            match face.len() {
                0..3 => {}
                3 => corners.triangles += 1,
                4 => corners.quads += 1,
                _ => corners.larger += 1,
            }
        }
        corners
    }
}

/// Lengths of edges.
struct Lengths {
    least: f64,
    mean: f64,
    most: f64,
    /// How many are zero.
    zero: usize,
}

impl Lengths {
    /// The lengths of all edges between finite vertices; `None` where there is none.
    fn of(mesh: &PolygonMesh, topology: &Topology) -> Option<Self> {
        let (mut least, mut most, mut mean) = (f64::INFINITY, 0.0_f64, 0.0);
        let (mut zero, mut count) = (0, 0.0);
        let mut ends: Vec<u32> = Vec::new();
        for vertex in 0..topology.vertex_count() {
            // Each edge is counted at its smaller end, where a ring of several fans may name it more than once.
            ends.clear();
            ends.extend(topology.ring(vertex).iter().filter(|&&end| end as usize > vertex));
            ends.sort_unstable();
            ends.dedup();
            for &end in &ends {
                let [from, to] = [vertex, end as usize].map(|vertex| mesh.positions[vertex]);
                // Neither squares of huge coordinates nor those of tiny ones leave the range.
                let length = (from[0] - to[0]).hypot(from[1] - to[1]).hypot(from[2] - to[2]);
                if !length.is_finite() {
                    continue;
                }
                count += 1.0;
                mean += (length - mean) / count;
                most = most.max(length);
                least = least.min(length);
                zero += usize::from(length == 0.0);
            }
        }
        (count > 0.0).then_some(Lengths { least, mean, most, zero })
    }

    /// The longest over the shortest.
    fn ratio(&self) -> f64 {
        if self.least > 0.0 { self.most / self.least } else { f64::INFINITY }
    }
}
