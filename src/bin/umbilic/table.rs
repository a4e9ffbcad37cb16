//! Tables and numbers as they are printed.

/// Rows of a label and a text, the texts in one column.
pub fn table(rows: &[(&str, String)]) -> String {
    let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
    rows.iter().map(|(label, text)| format!("{label:width$}  {text}\n")).collect()
}

/// A number with six significant digits.
pub fn number(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs()) || !rounded.is_finite() {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// The coordinates of a point.
pub fn point(point: [f64; 3]) -> String {
    format!("({})", point.map(number).join(", "))
}

/// An amount of memory.
pub fn bytes(count: usize) -> String {
    match count {
        0..1024 => format!("{count} bytes"),
        1024..1_048_576 => format!("{:.1} KiB", count as f64 / 1024.0),
        _ => format!("{:.1} MiB", count as f64 / 1_048_576.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(1.0 / 3.0), "0.333333");
        assert_eq!(number(-2.0), "-2");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(123_456_789.0), "123457000");
        assert_eq!(number(1.5e-9), "1.5e-9");
        assert_eq!(number(f64::INFINITY), "inf");
    }

    #[test]
    fn labels_are_padded() {
        assert_eq!(table(&[("a", "1".to_owned()), ("long", "2".to_owned())]), "a     1\nlong  2\n");
    }
}
