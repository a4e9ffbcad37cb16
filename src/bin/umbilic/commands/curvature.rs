//! `umbilic curvature`: curvatures at the vertices of a mesh, as a table, a PLY file and colors.

use super::Outcome;
use crate::args;
use crate::colorbar::write_colorbar;
use crate::coloring::{Coloring, Subject};
use crate::compute::{self, VertexCurvatures};
use crate::mesh::PolygonMesh;
use crate::quantity::Quantity;
use crate::read::read_mesh;
use crate::scale::Scale;
use crate::summary::Summary;
use crate::write::{Column, ColumnValues, PlyFormat, Properties, write_ply};
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use std::time::Instant;
use umbilic::Method;

/// Compute the curvatures of a mesh.
///
/// Prints the spread of the principal curvatures k1 and k2 (k1 is the larger), of mean curvature (k1 + k2) / 2, all in
/// 1/length, and of Gaussian curvature k1 k2, in 1/length², as far as the method has them. Curvatures are positive where
/// the surface bends away from its normal: with faces that turn counterclockwise seen from outside, a sphere of radius r
/// has k1 = k2 = 1/r. Vertices without a result do not count.
///
/// The PLY file has the positions and faces of the input and for each vertex: the unit normal as nx, ny and nz; colors
/// as red, green and blue; k1, k2, mean, gaussian, shape_index and curvedness; the unit directions of k1 and k2 as k1_x
/// to k2_z; and its status as the sum of: 1 boundary, 2 non-manifold, 4 faces that disagree on the orientation, 8
/// isolated, 16 something that the input leaves undetermined was filled in, 32 no result, 64 the neighbourhood was
/// widened, 128 a sharp vertex (with 16: on a crease). Adaptive jets print what they learned of the mesh: the noise of its positions
/// along the normal, the typical length of an edge, and how many rings they looked at. Numbers are zero where there is no result.
///
/// With --color shape the file has the class of each vertex as shape: 0 undefined, 1 peak, 2 ridge, 3 saddle-ridge, 4 flat, 5
/// minimal, 6 pit, 7 valley, 8 saddle-valley.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic curvature cow.obj -o cow.ply --color mean")]
pub struct Curvature {
    /// The mesh: an OBJ, PLY, STL or OFF file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The PLY file to write. Next to it OUT.colorbar.png shows its colors with their numbers, unless --colorbar names
    /// another file or there are no colors.
    #[arg(short, long, value_name = "OUT.ply", value_parser = args::ply_file)]
    output: Option<PathBuf>,
    /// What the colors show: blue is negative, red positive, nearly white 0, gray a vertex without a result
    /// [default: mean, or gaussian where the method has no mean].
    #[arg(long, value_enum, value_name = "QUANTITY")]
    color: Option<Color>,
    /// Write text instead of binary numbers.
    #[arg(long)]
    ascii: bool,
    /// The number of threads; 0 for as many as pay.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    threads: u16,
    /// Print one JSON object instead of tables.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    options: args::CurvatureEstimator,
    #[command(flatten)]
    scale: args::ColorScale,
}

/// What the colors show.
#[derive(Clone, Copy)]
enum Color {
    Subject(Subject),
    Nothing,
}

impl ValueEnum for Color {
    fn value_variants<'a>() -> &'a [Self] {
        const VARIANTS: [Color; Subject::ALL.len() + 1] = {
            let mut variants = [Color::Nothing; Subject::ALL.len() + 1];
            let mut index = 0;
            while index < Subject::ALL.len() {
                variants[index] = Color::Subject(Subject::ALL[index]);
                index += 1;
            }
            variants
        };
        &VARIANTS
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Color::Subject(subject) => subject.to_possible_value(),
            Color::Nothing => Some(PossibleValue::new("none").help("No colors")),
        }
    }
}

impl Curvature {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let mut options = self.options.options()?;
        let color = self.color()?;
        let blame = self.options.blame(&self.input);
        let start = Instant::now();
        let mesh = read_mesh(&self.input)?;
        let read = Instant::now();
        let topology = compute::topology(&mesh).map_err(&blame)?;
        let built = Instant::now();
        let mut rows = self.options.rows();
        if options.method == Method::AdaptiveJet {
            let model = compute::model(&mesh, &topology, self.threads.into()).map_err(&blame)?;
            rows.extend(args::model_rows(&model, options.rings));
            options.model = Some(model);
        }
        let found = compute::vertex_curvatures(&mesh, &topology, &options, self.threads.into()).map_err(&blame)?;
        let computed = Instant::now();
        let coloring = match color {
            Some(subject) => Some(self.scale.coloring(subject, &mesh, &found).map_err(&blame)?),
            None => None,
        };
        let bar = match coloring.as_ref().and_then(Coloring::scale) {
            Some(scale) => self.write_bar(scale)?,
            None => None,
        };
        if let Some(output) = &self.output {
            self.write(output, &mesh, &found, coloring.as_ref())?;
        }
        let summary = Summary {
            stats: topology.stats().map_err(&blame)?,
            options: rows,
            adds_up: self.options.adds_up(),
            found: &found,
            coloring,
            bar,
            times: [
                ("read", read - start),
                ("topology", built - read),
                ("curvatures", computed - built),
                ("write", computed.elapsed()),
            ],
        };
        Ok(if self.json { format!("{:#}\n", summary.json()) } else { summary.text() })
    }

    /// What the colors are to show.
    fn color(&self) -> Result<Option<Subject>, String> {
        let subject = match self.color {
            Some(Color::Nothing) => None,
            Some(Color::Subject(subject)) => Some(subject),
            None => {
                let has = |quantity: &Quantity| self.options.method().has(quantity.kind());
                [Quantity::Mean, Quantity::Gaussian].into_iter().find(has).map(Subject::Quantity)
            }
        };
        match subject {
            Some(subject) => {
                self.options.check(subject)?;
                self.scale.check(subject)?;
            }
            None => self.scale.refuse()?,
        }
        Ok(subject)
    }

    /// Draws the color bar where it is asked for, or else next to the mesh; tells where.
    fn write_bar(&self, scale: &Scale) -> Result<Option<PathBuf>, crate::output::WriteError> {
        // Nothing belongs next to a device or a pipe.
        let file = |path: &&PathBuf| path.metadata().map_or(true, |metadata| metadata.is_file());
        let beside = || self.output.as_ref().filter(file).map(|path| path.with_extension("colorbar.png"));
        let bar = self.scale.colorbar.clone().or_else(beside);
        if let Some(path) = &bar {
            write_colorbar(path, scale)?;
        }
        Ok(bar)
    }

    /// Writes the mesh with all that was found.
    fn write(
        &self,
        path: &Path,
        mesh: &PolygonMesh,
        found: &VertexCurvatures,
        coloring: Option<&Coloring>,
    ) -> Result<(), crate::output::WriteError> {
        let colors = coloring.map(|coloring| coloring.colors(found));
        let mut columns: Vec<Column<'_>> = Quantity::ALL
            .into_iter()
            .filter_map(|quantity| {
                let values = ColumnValues::Float(found.quantity(quantity)?);
                Some(Column { name: quantity.name(), values })
            })
            .collect();
        if let Some(directions) = &found.directions {
            let names = [["k1_x", "k1_y", "k1_z"], ["k2_x", "k2_y", "k2_z"]];
            for (vectors, names) in directions.iter().zip(names) {
                columns.extend(
                    (0..3).map(|axis| Column { name: names[axis], values: ColumnValues::Axis(vectors, axis) }),
                );
            }
        }
        if let Some(classes) = coloring.and_then(Coloring::classes) {
            columns.push(Column { name: "shape", values: ColumnValues::Byte(classes) });
        }
        columns.push(Column { name: "status", values: ColumnValues::Byte(&found.status) });
        let properties = Properties { normals: Some(&found.normals), columns, colors: colors.as_deref() };
        let format = if self.ascii { PlyFormat::Ascii } else { PlyFormat::BinaryLittleEndian };
        write_ply(path, mesh, &properties, &Properties::default(), format)
    }
}
