//! What is told of the curvatures of a mesh: spreads, totals and statuses, as tables or JSON.

use crate::coloring::Coloring;
use crate::compute::{VertexCurvatures, has_result};
use crate::quantiles::Sorted;
use crate::quantity::Quantity;
use crate::table;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::time::Duration;
use umbilic::{TopologyStats, status};

/// What is told.
pub struct Summary<'a> {
    /// Of the mesh.
    pub stats: TopologyStats,
    /// Options and their values.
    pub options: Vec<(&'static str, String)>,
    /// Whether sums over vertices are those of the mesh.
    pub adds_up: bool,
    /// What the library has found.
    pub found: &'a VertexCurvatures,
    /// What the colors show.
    pub coloring: Option<Coloring>,
    /// The picture of the colors.
    pub bar: Option<PathBuf>,
    /// What took how long.
    pub times: [(&'static str, Duration); 4],
}

/// The quantities whose spread is told.
const SPREADS: [Quantity; 4] = [Quantity::K1, Quantity::K2, Quantity::Mean, Quantity::Gaussian];

/// The numbers that make a spread: a key, words and the part of the vertices that have no larger value.
const QUANTILES: [(&str, &str, f64); 5] = [
    ("min", "minimum", 0.0),
    ("p5", "5 %", 0.05),
    ("median", "median", 0.5),
    ("p95", "95 %", 0.95),
    ("max", "maximum", 1.0),
];

/// What is counted of the vertices' statuses: a key, words and the bit.
const COUNTS: [(&str, &str, u8); 8] = [
    ("boundary", "boundary vertices", status::BOUNDARY),
    ("non_manifold", "non-manifold vertices", status::NON_MANIFOLD),
    ("winding", "vertices of faces that disagree", status::WINDING),
    ("isolated", "isolated vertices", status::ISOLATED),
    ("fallback", "results that were filled in", status::FALLBACK),
    ("degenerate", "vertices without any result", status::DEGENERATE),
    ("widened", "widened neighbourhoods", status::WIDENED),
    ("crease", "vertices on creases", status::CREASE),
];

impl Summary<'_> {
    /// As tables.
    pub fn text(&self) -> String {
        let mut rows =
            vec![("vertices", self.stats.vertex_count.to_string()), ("faces", self.stats.face_count.to_string())];
        rows.extend(self.options.iter().cloned());
        rows.extend(self.counts().map(|(_, words, count)| (words, count.to_string())));
        let [area, mean, gaussian] = self.totals();
        rows.extend(area.map(|area| ("area", table::number(area))));
        rows.extend(mean.map(|mean| ("integral of mean curvature", table::number(mean))));
        rows.extend(gaussian.map(|gaussian| {
            let exact = self.gauss_bonnet().map(|exact| format!(" (2πχ = {})", table::number(exact)));
            ("integral of Gaussian curvature", table::number(gaussian) + &exact.unwrap_or_default())
        }));
        rows.extend(self.coloring.as_ref().map(|coloring| ("colors", coloring.describe())));
        rows.extend(self.bar.as_ref().map(|bar| ("color bar", bar.display().to_string())));
        rows.push(("time", self.times.map(|(key, time)| format!("{key} {time:.1?}")).join(", ")));

        let mut text = table::table(&rows);
        let head: String = QUANTILES.map(|(_, words, _)| format!("  {words:>13}")).concat();
        text += &format!("\n{:8}{head}\n", "");
        for (quantity, spread) in self.spreads() {
            let numbers = spread.map(|number| number.map_or_else(|| "-".to_owned(), table::number));
            let numbers: String = numbers.map(|number| format!("  {number:>13}")).concat();
            text += &format!("{:8}{numbers}\n", quantity.name());
        }
        text
    }

    /// As an object.
    pub fn json(&self) -> Value {
        let options: Map<_, _> =
            self.options.iter().map(|(key, value)| ((*key).to_owned(), value.as_str().into())).collect();
        let counts: Map<_, _> =
            self.counts().into_iter().map(|(key, _, count)| (key.to_owned(), count.into())).collect();
        let spread = |(quantity, spread): (Quantity, [Option<f64>; 5])| {
            let numbers: Map<_, _> = QUANTILES
                .into_iter()
                .zip(spread)
                .map(|((key, ..), number)| (key.to_owned(), number.into()))
                .collect();
            (quantity.name().to_owned(), numbers.into())
        };
        let curvature: Map<_, _> = self.spreads().into_iter().map(spread).collect();
        let [area, mean, gaussian] = self.totals();
        let seconds: Map<_, _> =
            self.times.into_iter().map(|(key, time)| (key.to_owned(), time.as_secs_f64().into())).collect();
        json!({
            "vertices": self.stats.vertex_count,
            "faces": self.stats.face_count,
            "options": options,
            "curvature": curvature,
            "area": area,
            "integrated_mean": mean,
            "integrated_gaussian": gaussian,
            "gauss_bonnet": gaussian.and_then(|_| self.gauss_bonnet()),
            "status": counts,
            "color": self.coloring.as_ref().map(|coloring| {
                let mut object = coloring.json();
                object.insert("bar".to_owned(), self.bar.as_ref().map(|bar| bar.display().to_string()).into());
                object
            }),
            "seconds": seconds,
        })
    }

    fn counts(&self) -> [(&'static str, &'static str, usize); COUNTS.len()] {
        COUNTS.map(|(key, words, bit)| (key, words, self.found.status.iter().filter(|&s| s & bit != 0).count()))
    }

    /// The spread of each quantity that the method has; its numbers are missing where no vertex has a result.
    fn spreads(&self) -> Vec<(Quantity, [Option<f64>; 5])> {
        let spread = |quantity| {
            let sorted = Sorted::new(self.found.results(quantity)?);
            Some((quantity, QUANTILES.map(|(_, _, part)| sorted.quantile(part))))
        };
        SPREADS.into_iter().filter_map(spread).collect()
    }

    /// Area and integrals of mean and Gaussian curvature over the mesh, as far as the method has them.
    fn totals(&self) -> [Option<f64>; 3] {
        let VertexCurvatures { area, integrated_mean, integrated_gaussian, status, .. } = self.found;
        [area, integrated_mean, integrated_gaussian].map(|values| {
            let values = values.as_ref().filter(|_| self.adds_up)?.iter().zip(status);
            Some(values.filter(|&(_, &status)| has_result(status)).map(|(value, _)| value).sum())
        })
    }

    /// What Gaussian curvature adds up to by Gauss and Bonnet; `None` where the faces make no closed surface.
    fn gauss_bonnet(&self) -> Option<f64> {
        let TopologyStats { boundary_edges, non_manifold_edges, non_manifold_vertices, winding_edges, .. } =
            self.stats;
        let closed = boundary_edges + non_manifold_edges + non_manifold_vertices + winding_edges == 0;
        closed.then_some(TAU * self.stats.euler_characteristic as f64)
    }
}
