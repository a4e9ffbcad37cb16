//! Which number gets which color.
//!
//! A scale has the [`colormap`]'s center at 0, so that hues tell signs. By default it is symmetric and reaches to a
//! percentile of the absolute values: a few wild vertices do not fade all others.

use crate::colormap;
use crate::compute::has_result;
use crate::quantiles::Sorted;
use crate::quantity::Quantity;
use crate::table;

/// The percentile of absolute values to which a scale reaches, if nothing else is said.
pub const PERCENTILE: f64 = 95.0;

/// The numbers at the two ends of a colormap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// From here downwards all have the color of the lower end.
    pub low: f64,
    /// From here upwards all have the color of the upper end.
    pub high: f64,
}

impl Scale {
    /// The scale for values of a quantity, of which so many percent are to be within it. Smaller sizes than `rounding`
    /// are none: where there is nothing larger, the scale reaches to 1.
    pub fn of(quantity: Quantity, values: impl Iterator<Item = f64>, percentile: f64, rounding: f64) -> Self {
        if quantity == Quantity::ShapeIndex {
            return Scale { low: -1.0, high: 1.0 };
        }
        let sizes = Sorted::new(values.map(f64::abs));
        let reach = [percentile / 100.0, 1.0].into_iter().filter_map(|part| sizes.quantile(part));
        let high = reach.into_iter().find(|&size| size > rounding).unwrap_or(1.0);
        Scale { low: if quantity == Quantity::Curvedness { 0.0 } else { -high }, high }
    }

    /// The number at the colormap's center: 0, or the one nearest to it.
    pub fn center(&self) -> f64 {
        0.0_f64.clamp(self.low, self.high)
    }

    /// The color of a number.
    pub fn color(&self, value: f64) -> [u8; 3] {
        let center = self.center();
        let value = value.clamp(self.low, self.high);
        let end = if value < center { self.low } else { self.high };
        if value == center { colormap::color(0.0) } else { colormap::color((value - center) / (end - center).abs()) }
    }

    /// What the colors stand for, in words.
    pub fn describe(&self, quantity: Quantity) -> String {
        let [low, center, high] = [self.low, self.center(), self.high].map(table::number);
        let mut parts = Vec::new();
        if self.low < self.center() {
            parts.push(format!("{low} blue"));
        }
        parts.push(format!("{center} white"));
        if self.high > self.center() {
            parts.push(format!("{high} red"));
        }
        format!("{}: {}", quantity.name(), parts.join(", "))
    }

    /// The color of each vertex by its value and its status; gray where there is no result.
    pub fn colors(&self, values: &[f64], status: &[u8]) -> Vec<[u8; 3]> {
        let color = |(&value, &status)| if has_result(status) { self.color(value) } else { colormap::NOTHING };
        values.iter().zip(status).map(color).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_robust_and_symmetric() {
        let values = || (0..1000).map(|i| if i == 7 { -1e9 } else { f64::from(i % 10) });
        assert_eq!(Scale::of(Quantity::Mean, values(), PERCENTILE, 0.0), Scale { low: -9.0, high: 9.0 });
        assert_eq!(Scale::of(Quantity::Curvedness, values(), 50.0, 0.0), Scale { low: 0.0, high: 4.5 });
        assert_eq!(Scale::of(Quantity::Mean, values(), 100.0, 0.0), Scale { low: -1e9, high: 1e9 });
        assert_eq!(Scale::of(Quantity::ShapeIndex, values(), PERCENTILE, 0.0), Scale { low: -1.0, high: 1.0 });
    }

    #[test]
    fn where_most_or_all_is_flat_there_still_is_a_scale() {
        let one = Scale { low: -1.0, high: 1.0 };
        assert_eq!(Scale::of(Quantity::Mean, std::iter::empty(), PERCENTILE, 0.0), one);
        assert_eq!(Scale::of(Quantity::Mean, [0.0; 9].into_iter(), PERCENTILE, 0.0), one);
        assert_eq!(Scale::of(Quantity::Mean, [1e-17; 9].into_iter(), PERCENTILE, 1e-12), one);
        let few = (0..100).map(|i| if i == 3 { 5.0 } else { 0.0 });
        assert_eq!(Scale::of(Quantity::Mean, few, PERCENTILE, 0.0), Scale { low: -5.0, high: 5.0 });
    }

    #[test]
    fn zero_has_the_color_of_the_center() {
        let [blue, white, red] = [-1.0, 0.0, 1.0].map(colormap::color);
        for (low, high, expected) in [
            (-2.0, 2.0, [blue, white, red]),
            (-1.0, 9.0, [blue, white, red]),
            (1.0, 3.0, [white, white, red]),
            (-3.0, -1.0, [blue, white, white]),
            (0.0, 2.0, [white, white, red]),
            (-f64::MAX, f64::MAX, [blue, white, red]),
        ] {
            let scale = Scale { low, high };
            assert_eq!([low, 0.0, high].map(|value| scale.color(value)), expected, "{scale:?}");
        }
    }
}
