//! Axes: from values to places along a panel.

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equal lengths.
    #[default]
    Linear,
    /// Equal ratios are equal lengths; values that are not positive are left out.
    Log,
    /// The same on both sides of 0, which stands on the axis itself: a value lies at the decimal
    /// logarithm of 1 more than its size.
    SignedLog,
}

/// An axis of a panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit: `crest spacing (m)`. See [`super::label`].
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
    /// First and last value; without it all values of the panel and a little more.
    pub range: Option<[f64; 2]>,
    /// Names in place of numbers: the first stands at 0, the next at 1 and so on.
    pub names: Vec<String>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    /// A logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, ..Self::default() }
    }

    /// An axis that is logarithmic on both sides of 0.
    pub fn signed_log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::SignedLog, ..Self::default() }
    }

    /// Whether a value can stand on the axis.
    pub(super) fn holds(&self, value: f64) -> bool {
        value.is_finite() && (self.scale != Scale::Log || value > 0.0)
    }

    /// The range that is drawn for these values.
    pub(super) fn span(&self, values: impl Iterator<Item = f64>) -> Span {
        let [low, high] = match self.range {
            Some([low, high]) if self.holds(low) && self.holds(high) && low < high => {
                [low, high].map(|value| self.scale.along(value))
            }
            _ => self.fitting(values),
        };
        // Beyond, differences and powers of ten would not be finite.
        let most = match self.scale {
            Scale::Linear => 1e300,
            Scale::Log | Scale::SignedLog => 300.0,
        };
        let [low, high] = [low, high].map(|along| along.clamp(-most, most));
        Span { scale: self.scale, low, high }
    }

    /// The places of all values, with a margin; something sensible for none or for equal ones.
    fn fitting(&self, values: impl Iterator<Item = f64>) -> [f64; 2] {
        /// Share of the range that is left free at either end.
        const MARGIN: f64 = 0.05;
        if !self.names.is_empty() {
            return [-0.5, self.names.len() as f64 - 0.5];
        }
        let values = values.filter(|&value| self.holds(value)).map(|value| self.scale.along(value));
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = values.fold(start, |[low, high], v| [low.min(v), high.max(v)]);
        match (low <= high, high - low) {
            (false, _) => [0.0, 1.0],
            (true, width) if width <= 1e-12 * low.abs().max(high.abs()) => match self.scale {
                Scale::Linear | Scale::SignedLog if low == 0.0 => [-1.0, 1.0],
                Scale::Linear => [low - 0.1 * low.abs(), high + 0.1 * high.abs()],
                Scale::Log | Scale::SignedLog => [low - 0.5, high + 0.5],
            },
            (true, width) => [low - MARGIN * width, high + MARGIN * width],
        }
    }
}

impl Scale {
    /// The place of a value before it is fitted into a panel.
    fn along(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => value.log10(),
            Self::SignedLog => value.signum() * (1.0 + value.abs()).log10(),
        }
    }
}

/// The range of an axis, in values or in decimal logarithms of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub scale: Scale,
    pub low: f64,
    pub high: f64,
}

impl Span {
    /// Where a value lies: 0 at the start of the axis, 1 at its end.
    pub fn share(&self, value: f64) -> f64 {
        (self.scale.along(value) - self.low) / (self.high - self.low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_where_their_scale_puts_them() {
        let linear = Axis { range: Some([2.0, 4.0]), ..Axis::linear("") }.span([].into_iter());
        assert_eq!([2.0, 3.0, 5.0].map(|value| linear.share(value)), [0.0, 0.5, 1.5]);
        let log = Axis { range: Some([1.0, 1e4]), ..Axis::log("") }.span([].into_iter());
        assert_eq!([1.0, 10.0, 1e4].map(|value| log.share(value)), [0.0, 0.25, 1.0]);
        let both = Axis { range: Some([-99.0, 99.0]), ..Axis::signed_log("") };
        let both = both.span([].into_iter());
        assert_eq!([-99.0, -9.0, 0.0, 9.0].map(|v| both.share(v)), [0.0, 0.25, 0.5, 0.75]);
    }

    #[test]
    fn ranges_fit_the_values_that_can_be_drawn() {
        let span = |axis: &Axis, values: &[f64]| axis.span(values.iter().copied());
        let linear = span(&Axis::linear(""), &[0.0, f64::NAN, 10.0, f64::INFINITY]);
        assert_eq!([linear.low, linear.high], [-0.5, 10.5]);
        let log = span(&Axis::log(""), &[-1.0, 0.0, 1.0, 100.0]);
        assert!((log.low + 0.1).abs() < 1e-12 && (log.high - 2.1).abs() < 1e-12, "{log:?}");
        for values in [&[][..], &[3.0], &[0.0, 0.0], &[-2.0]] {
            for axis in [Axis::linear(""), Axis::log("")] {
                let span = span(&axis, values);
                assert!(span.low < span.high, "{values:?} {span:?}");
            }
        }
    }
}
