//! Axes of plots: linear, logarithmic, and one that shows both signs over many decades.

use crate::report::numbers::tick_label;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// How values become places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithm; values have to be positive.
    Log,
    /// By `asinh(value / linear)`: evenly near zero, by the logarithm far from it, both signs.
    Asinh {
        /// Where even spacing gives way to logarithmic.
        linear: f64,
    },
}

/// An axis with its ticks.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    ticks: Vec<f64>,
}

impl Axis {
    /// Linear axis over a range, with about `count` round ticks.
    pub fn linear(low: f64, high: f64, count: usize) -> Self {
        let (low, high) = if high > low { (low, high) } else { (low - 0.5, low + 0.5) };
        let step = round_step((high - low) / count.max(1) as f64);
        let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
        let ticks = (first..=last).map(|k| k as f64 * step).collect();
        Axis { scale: Scale::Linear, low, high, ticks }
    }

    /// Axis for errors of both signs: linear if their sizes are alike, else over decades. `sizes` are what has to fit in.
    pub fn for_errors(sizes: &[f64]) -> Self {
        let mut sorted: Vec<f64> = sizes.iter().copied().filter(|v| v.is_finite() && *v > 0.0).collect();
        sorted.sort_by(f64::total_cmp);
        let Some(&largest) = sorted.last() else { return Axis::linear(-1.0, 1.0, 4) };
        let typical = sorted[sorted.len() / 4];
        if largest < 25.0 * typical {
            return Axis::linear(-1.1 * largest, 1.1 * largest, 4);
        }
        // A quarter of the small sizes, so that the quiet end of a run keeps its shape.
        let linear = 0.25 * typical;
        let mut axis =
            Axis { scale: Scale::Asinh { linear }, low: -1.5 * largest, high: 1.5 * largest, ticks: vec![0.0] };
        axis.add_decades(typical, largest);
        axis
    }

    /// Ticks at ± powers of ten from the largest down, as long as their labels keep clear of each other and of zero.
    fn add_decades(&mut self, typical: f64, largest: f64) {
        let gap = 0.13 * 2.0 * self.place(self.high);
        let mut above = f64::INFINITY;
        for exponent in (typical.log10().floor() as i32..=largest.log10().floor() as i32).rev() {
            let decade = 10f64.powi(exponent);
            let place = self.place(decade);
            if above - place >= gap && place >= gap {
                self.ticks.extend([-decade, decade]);
                above = place;
            }
        }
    }

    /// Logarithmic axis over positive values.
    pub fn log(low: f64, high: f64) -> Self {
        let low = if low > 0.0 && low.is_finite() { low } else { 1e-3 };
        let high = if high > low { high } else { 10.0 * low };
        let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
        let step = ((last - first + 5) / 6).max(1);
        let wide = last - first > 2;
        let within = |v: &f64| *v >= 0.999 * low && *v <= 1.001 * high;
        let multiples: &[f64] = if wide { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let ticks = (first..=last)
            .step_by(step as usize)
            .flat_map(|k| multiples.iter().map(move |m| m * 10f64.powi(k)))
            .filter(within)
            .collect();
        Axis { scale: Scale::Log, low, high, ticks }
    }

    /// Whether far values are drawn by their logarithm, on both sides of zero.
    pub fn bends(&self) -> bool {
        matches!(self.scale, Scale::Asinh { .. })
    }

    fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Log => value.max(self.low).ln(),
            Scale::Asinh { linear } => (value / linear).asinh(),
        }
    }
}

/// The round number (1, 2, 2.5 or 5 times a power of ten) next above `step`.
fn round_step(step: f64) -> f64 {
    let decade = 10f64.powf(step.log10().floor());
    [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(|m| m * decade).find(|s| *s >= 0.999 * step).unwrap_or(decade)
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let (low, high) = (self.place(self.low), self.place(self.high));
        let share = ((self.place(*value) - low) / (high - low)).clamp(-0.02, 1.02);
        limit.0 + (f64::from(limit.1 - limit.0) * share).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { vec![] } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        tick_label(*value)
    }
    fn format_ext(&self, value: &f64) -> String {
        tick_label(*value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(Axis::linear(0.0, 198.0, 9).ticks, [0.0, 25.0, 50.0, 75.0, 100.0, 125.0, 150.0, 175.0]);
        assert_eq!(Axis::linear(-1.1, 1.1, 4).ticks, [-1.0, 0.0, 1.0]);
        assert_eq!(Axis::log(0.03, 40.0).ticks, [0.1, 1.0, 10.0]);
        assert_eq!(Axis::log(0.3, 2.1).ticks, [0.5, 1.0, 2.0]);
    }

    #[test]
    fn errors_over_decades_get_both_signs() {
        let sizes: Vec<f64> = (0..100).map(|k| 1000.0 * 0.9f64.powi(k)).collect();
        let axis = Axis::for_errors(&sizes);
        assert!(matches!(axis.scale, Scale::Asinh { .. }));
        assert!(axis.ticks.contains(&1000.0) && axis.ticks.contains(&-1000.0) && axis.ticks.contains(&0.0));
        assert_eq!(axis.map(&0.0, (0, 1000)), 500);
        assert!(axis.map(&1000.0, (0, 1000)) > 900);
        assert_eq!(Axis::for_errors(&[1.0, 2.0, 1.5]).scale, Scale::Linear);
        assert_eq!(Axis::for_errors(&[]).scale, Scale::Linear);
    }
}
