//! `umbilic segment`: cuts a mesh into segments, as a table, a PLY file with labels and a picture.

use super::Outcome;
use crate::compute::{self, blame};
use crate::mesh::PolygonMesh;
use crate::read::read_mesh;
use crate::render::{Normals, Surface, render_png};
use crate::segments::{self, MEANS, Segments};
use crate::write::{Column, ColumnValues, PlyFormat, Properties, write_ply};
use crate::{args, colormap, palette, table};
use clap::Args;
use serde_json::{Map, Value, json};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use umbilic::{NO_SEGMENT, Weight};

/// How many segments the table has.
const LISTED: usize = 10;

/// Cut a mesh into segments: along sharp edges, by curvedness or by shape.
///
/// Prints the number of segments and of edges between them, and of the largest ones the label, the faces, the area and its share;
/// by watershed and regions also the means of k1, k2 and curvedness by area, in 1/length, and by regions the class of shape that most
/// corners have. For both, vertices between segments count only where there are no others. Faces with fewer than three distinct
/// corners are in no segment.
///
/// The PLY file has the positions and faces of the input, and for each face its label, from 0 in the order of the first faces, -1
/// where it is in no segment, and the color of the label (gray for -1) as red, green and blue. The picture has the same
/// colors, mildly shaded by normals that are split at sharp edges.
///
/// Curvatures are those of umbilic curvature, by any method with principal curvatures. On clean meshes of machine parts --method
/// least-squares with half of the tolerance does as well as the default and is faster; with more noise than 1 % of the edges take a
/// larger --smallest-share.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic segment bracket.stl -o bracket.ply --picture bracket.png
  umbilic segment bracket.stl --by regions --method least-squares")]
pub struct Segment {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The PLY file to write.
    #[arg(short, long, value_name = "OUT.ply", value_parser = args::ply_file)]
    output: Option<PathBuf>,
    #[command(flatten)]
    segmenter: args::Segmenter,
    /// Draw the mesh in the colors of its segments into a PNG file.
    #[arg(long, value_name = "OUT.png", value_parser = args::png_file)]
    picture: Option<PathBuf>,
    /// Write text instead of binary numbers.
    #[arg(long)]
    ascii: bool,
    /// The number of threads; 0 for as many as pay.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    threads: u16,
    /// Print one JSON object, with all segments in the order of their labels, instead of tables.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    curvature: args::CurvatureEstimator,
    #[command(flatten)]
    view: args::View,
}

impl Segment {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let way = self.segmenter.way(&self.curvature)?;
        if self.picture.is_none() {
            self.view.refuse()?;
        }
        let blame = self.curvature.blame(&self.input);
        let start = Instant::now();
        let mesh = read_mesh(&self.input)?;
        let read = Instant::now();
        let curvatures = segments::curvatures(&mesh, &way, self.threads.into()).map_err(&blame)?;
        let curved = Instant::now();
        let found = segments::segment(&mesh, &way, curvatures.as_ref(), self.threads.into()).map_err(&blame)?;
        let cut = Instant::now();
        self.write(&mesh, &found)?;
        let times = [
            ("read", read - start),
            ("curvatures", curved - read),
            ("segments", cut - curved),
            ("write", cut.elapsed()),
        ];
        Ok(if self.json {
            format!("{:#}\n", self.object(&mesh, &found, times))
        } else {
            self.text(&mesh, &found, times)
        })
    }

    /// Writes the files that are asked for.
    fn write(&self, mesh: &PolygonMesh, found: &Segments) -> Result<(), Box<dyn std::error::Error>> {
        let color = |&label: &u32| if label == NO_SEGMENT { colormap::NOTHING } else { palette::color(label) };
        let colors: Vec<[u8; 3]> = found.labels.iter().map(color).collect();
        if let Some(output) = &self.output {
            let of_faces = Properties {
                columns: vec![Column { name: "label", values: ColumnValues::Label(&found.labels) }],
                colors: Some(&colors),
                ..Properties::default()
            };
            let format = if self.ascii { PlyFormat::Ascii } else { PlyFormat::BinaryLittleEndian };
            write_ply(output, mesh, &Properties::default(), &of_faces, format)?;
        }
        if let Some(picture) = &self.picture {
            let angle = self.segmenter.angle();
            let normals = compute::corner_normals(mesh, angle, Weight::Angle, self.threads.into())
                .map_err(blame(&self.input))?;
            let options = self.view.options(Surface::FaceColors(&colors));
            render_png(picture, mesh, Normals::Corners(&normals), &options)?;
        }
        Ok(())
    }

    /// The options of curvatures, where there are any.
    fn estimator_rows(&self, found: &Segments) -> Vec<(&'static str, String)> {
        if found.limit.is_some() { self.curvature.rows() } else { Vec::new() }
    }

    /// As tables.
    fn text(&self, mesh: &PolygonMesh, found: &Segments, times: [(&'static str, Duration); 4]) -> String {
        let mut rows = vec![("vertices", mesh.vertex_count().to_string()), ("faces", mesh.face_count().to_string())];
        rows.extend(self.segmenter.rows(found.limit).into_iter().map(|(_, words, text, _)| (words, text)));
        rows.extend(self.estimator_rows(found));
        rows.push(("segments", found.each.len().to_string()));
        rows.push(("edges between them", found.boundary_edges.to_string()));
        rows.push(("faces in no segment", ignored(found).to_string()));
        rows.push(("time", times.map(|(key, time)| format!("{key} {time:.1?}")).join(", ")));
        let mut text = table::table(&rows);

        let shares = found.shares();
        let mut largest: Vec<usize> = (0..found.each.len()).collect();
        // Stable, so of several as large the first comes first.
        largest.sort_by(|&a, &b| found.each[b].area.total_cmp(&found.each[a].area));
        let Some(first) = found.each.first() else {
            return text;
        };
        text += &format!("\n{:>8}  {:>9}  {:>13}  {:>7}", "label", "faces", "area", "share");
        if first.means.is_some() {
            text += &MEANS.map(|quantity| format!("  {:>13}", quantity.name())).concat();
        }
        text += if first.shape.is_some() { "  shape\n" } else { "\n" };
        for &label in largest.iter().take(LISTED) {
            let segment = &found.each[label];
            let share = 100.0 * shares[label];
            text += &format!("{label:>8}  {:>9}  {:>13}  {share:>5.1} %", segment.faces, table::number(segment.area));
            for mean in segment.means.iter().flatten() {
                text += &format!("  {:>13}", table::number(*mean));
            }
            text += &segment.shape.map_or_else(String::new, |shape| format!("  {}", shape.name()));
            text.push('\n');
        }
        if let Some(more) = largest.len().checked_sub(LISTED).filter(|&more| more > 0) {
            text += &format!("and {more} smaller\n");
        }
        text
    }

    /// As an object.
    fn object(&self, mesh: &PolygonMesh, found: &Segments, times: [(&'static str, Duration); 4]) -> Value {
        let options = self.segmenter.rows(found.limit).into_iter().map(|(key, .., value)| (key.to_owned(), value));
        let estimator = self.estimator_rows(found).into_iter().map(|(key, value)| (key.to_owned(), value.into()));
        let options: Map<_, _> = options.chain(estimator).collect();
        let seconds: Map<_, _> =
            times.into_iter().map(|(key, time)| (key.to_owned(), time.as_secs_f64().into())).collect();
        let shares = found.shares();
        let each = found.each.iter().zip(&shares).map(|(segment, &share)| {
            let mut object = Map::new();
            object.insert("faces".to_owned(), segment.faces.into());
            object.insert("area".to_owned(), segment.area.into());
            object.insert("share".to_owned(), share.into());
            for (quantity, mean) in MEANS.iter().zip(segment.means.iter().flatten()) {
                object.insert(quantity.name().to_owned(), (*mean).into());
            }
            if let Some(shape) = segment.shape {
                object.insert("shape".to_owned(), shape.name().into());
            }
            object
        });
        json!({
            "vertices": mesh.vertex_count(),
            "faces": mesh.face_count(),
            "options": options,
            "segments": found.each.len(),
            "boundary_edges": found.boundary_edges,
            "ignored_faces": ignored(found),
            "by_label": each.collect::<Vec<_>>(),
            "seconds": seconds,
        })
    }
}

/// The number of faces that are in no segment.
fn ignored(found: &Segments) -> usize {
    found.labels.iter().filter(|&&label| label == NO_SEGMENT).count()
}
