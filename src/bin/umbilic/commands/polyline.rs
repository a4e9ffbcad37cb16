//! `umbilic polyline`: curvatures at the vertices of a polyline.

use super::Outcome;
use crate::args;
use crate::compute::{self, PolylineCurvatures, blame};
use crate::output::write_file;
use crate::read::read_polyline;
use crate::table;
use clap::Args;
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use std::path::PathBuf;
use umbilic::polyline_status as status;

/// Compute the curvatures of a polyline, by four formulas.
///
/// The file has a point on each line: two or three numbers, separated by blanks or by commas; # starts a comment. Each
/// vertex and its two neighbours give the curvature of the circle through them, of the parabola through them, of the
/// parabola with its parameter in proportion to lengths, and of a parabola symmetric about the bisector, all in
/// 1/length. In the plane they are positive where the polyline turns left. The status is the sum of: 1 an end of an
/// open polyline, with curvature 0, 2 a cusp, where an infinite curvature is written as 1.7976931348623157e308, 4 a
/// point that repeats its neighbour, which is passed over.
#[derive(Args)]
#[command(after_help = "\
Example:
  umbilic polyline outline.txt --closed -o curvatures.csv")]
pub struct Polyline {
    /// The points: a text file.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Write the curvatures to this CSV file, with all digits, instead of printing them.
    #[arg(short, long, value_name = "OUT.csv", value_parser = args::csv_file)]
    output: Option<PathBuf>,
    /// Join the last point to the first.
    #[arg(long)]
    closed: bool,
    /// Print one JSON object instead of tables.
    #[arg(long)]
    json: bool,
}

/// What is counted of the vertices' statuses: a key, words and the bit.
const COUNTS: [(&str, &str, u8); 3] = [
    ("ends", "ends", status::END),
    ("cusps", "cusps", status::CUSP),
    ("coincident", "points that repeat a neighbour", status::COINCIDENT),
];

impl Polyline {
    /// Runs the command.
    pub fn run(&self) -> Outcome {
        let points = read_polyline(&self.input)?;
        let found = compute::polyline_curvatures(&points, self.closed).map_err(blame(&self.input))?;
        if let Some(output) = &self.output {
            write_file(output, |writer| write_csv(writer, &found))?;
        }
        let print_all = self.output.is_none();
        let counts =
            COUNTS.map(|(key, words, bit)| (key, words, found.status.iter().filter(|&s| s & bit != 0).count()));
        if self.json {
            let counts: Map<_, _> =
                counts.into_iter().map(|(key, _, count)| (key.to_owned(), count.into())).collect();
            let mut object = json!({
                "points": found.status.len(),
                "dimension": found.dimension,
                "closed": self.closed,
                "status_counts": counts,
            });
            if print_all {
                let curvatures: Map<_, _> = found
                    .sections()
                    .map(|(name, values)| (name.replace('-', "_"), Value::from(values)))
                    .into_iter()
                    .collect();
                object["curvature"] = curvatures.into();
                object["status"] = found.status.into();
            }
            return Ok(format!("{object:#}\n"));
        }
        let mut rows = vec![
            ("points", found.status.len().to_string()),
            ("dimension", found.dimension.to_string()),
            ("closed", if self.closed { "yes" } else { "no" }.to_owned()),
        ];
        rows.extend(counts.map(|(_, words, count)| (words, count.to_string())));
        let mut text = table::table(&rows);
        if print_all {
            text.push('\n');
            text.push_str(&columns(&found));
        }
        Ok(text)
    }
}

/// The curvatures as a printed table.
fn columns(found: &PolylineCurvatures) -> String {
    let sections = found.sections();
    let head = sections.map(|(name, _)| name);
    let mut text =
        format!("{:>8}  {:>18}  {:>18}  {:>18}  {:>18}  status\n", "vertex", head[0], head[1], head[2], head[3]);
    for (vertex, status) in found.status.iter().enumerate() {
        let [c, p, pl, sp] = sections.map(|(_, values)| table::number(values[vertex]));
        text.push_str(&format!("{vertex:>8}  {c:>18}  {p:>18}  {pl:>18}  {sp:>18}  {status:>6}\n"));
    }
    text
}

fn write_csv(writer: &mut impl Write, found: &PolylineCurvatures) -> io::Result<()> {
    let sections = found.sections();
    let names = sections.map(|(name, _)| name.replace('-', "_")).join(",");
    writeln!(writer, "vertex,{names},status")?;
    for (vertex, status) in found.status.iter().enumerate() {
        // The shortest digits that read back as the same number.
        let values = sections.map(|(_, values)| format!("{:?}", values[vertex])).join(",");
        writeln!(writer, "{vertex},{values},{status}")?;
    }
    Ok(())
}
