//! Quantiles of numbers.

/// Numbers in ascending order.
pub struct Sorted(Vec<f64>);

impl Sorted {
    /// Sorts numbers.
    pub fn new(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.collect();
        values.sort_unstable_by(f64::total_cmp);
        Sorted(values)
    }

    /// The number that this part of them, 0 to 1, does not exceed, interpolated between the two nearest; `None` where
    /// there are none.
    pub fn quantile(&self, part: f64) -> Option<f64> {
        let last = self.0.len().checked_sub(1)?;
        let place = part.clamp(0.0, 1.0) * last as f64;
        let below = (place as usize).min(last);
        let share = place - below as f64;
        let (low, high) = (self.0[below], self.0[(below + 1).min(last)]);
        // Each end is exact, and their difference may leave the range.
        Some(if share == 0.0 { low } else { low * (1.0 - share) + high * share })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_interpolated() {
        let sorted = Sorted::new([3.0, -1.0, 2.0, f64::MAX, 0.0].into_iter());
        for (part, expected) in [(0.0, -1.0), (0.25, 0.0), (0.5, 2.0), (0.625, 2.5), (1.0, f64::MAX)] {
            assert_eq!(sorted.quantile(part), Some(expected));
        }
        assert_eq!(Sorted::new([7.0].into_iter()).quantile(0.95), Some(7.0));
        assert_eq!(Sorted::new(std::iter::empty()).quantile(0.5), None);
    }
}
