//! Progress bars on the standard error, where that is a terminal and the work takes long enough to see them.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};

/// Smaller files are read at once.
const FROM_BYTES: u64 = 8 << 20;

/// Smaller meshes are done at once.
const FROM_VERTICES: usize = 2_000_000;

/// What stands for a whole in [`computing`]'s bar.
pub const WHOLE: f64 = 1000.0;

/// A bar that counts the bytes of a file.
pub fn reading(length: u64) -> ProgressBar {
    bar(length >= FROM_BYTES, length, "reading {bar:40} {bytes}/{total_bytes}")
}

/// A bar that counts thousandths of a computation on so many vertices, each of which takes `cost` times as long as a
/// normal by one ring.
pub fn computing(vertices: usize, cost: usize) -> ProgressBar {
    bar(vertices.saturating_mul(cost) >= FROM_VERTICES, WHOLE as u64, "computing {bar:40} {percent}%")
}

fn bar(wanted: bool, length: u64, template: &str) -> ProgressBar {
    if !wanted || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
