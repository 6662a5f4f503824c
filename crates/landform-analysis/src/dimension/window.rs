//! The range of scales over which a dimension is measured.

use std::str::FromStr;

use thiserror::Error;

use crate::Polyline;

/// Why a range of scales cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RangeError {
    /// The text does not say two lengths.
    #[error("{0:?} is no range of lengths; write it as 2km..100km or 500m..20km")]
    Text(String),
    /// The lengths are not two positive ones in increasing order.
    #[error(
        "scales from {least_m} m to {most_m} m; the first must be above 0 and the second larger"
    )]
    Order {
        /// Smallest scale.
        least_m: f64,
        /// Largest scale.
        most_m: f64,
    },
    /// The lines are too coarse, or too small, for a range of their own.
    #[error(
        "no range of scales lies between four times the mean distance of points ({least_m} m) and \
         1/16 of the extent ({most_m} m); give a range of scales, or lines with more points"
    )]
    Coarse {
        /// Four times the mean distance of points.
        least_m: f64,
        /// A sixteenth of the extent.
        most_m: f64,
    },
    /// The smallest scale would take too many steps.
    #[error(
        "scales from {least_m} m are too fine for lines of {length_m} m; start at {advised_m} m or above"
    )]
    Fine {
        /// Smallest scale asked for.
        least_m: f64,
        /// Length of the lines.
        length_m: f64,
        /// Smallest scale that works.
        advised_m: f64,
    },
    /// The largest scale is larger than the lines.
    #[error(
        "scales up to {most_m} m are larger than the lines, which extend over {extent_m} m; end below that"
    )]
    Large {
        /// Largest scale asked for.
        most_m: f64,
        /// Diagonal of the box around the lines.
        extent_m: f64,
    },
}

/// Scales from a smallest to a largest one, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaleRange {
    least_m: f64,
    most_m: f64,
}

impl ScaleRange {
    /// Number of scales, at equal logarithmic distances.
    pub const SCALES: usize = 25;
    /// Largest ratio of length to scale: it bounds time and memory.
    const MOST_STEPS: f64 = 4e6;

    /// Scales from `least_m` to `most_m` metres.
    ///
    /// # Errors
    /// [`RangeError::Order`].
    pub fn new(least_m: f64, most_m: f64) -> Result<Self, RangeError> {
        if least_m > 0.0 && least_m < most_m && most_m.is_finite() {
            return Ok(Self { least_m, most_m });
        }
        Err(RangeError::Order { least_m, most_m })
    }

    /// From four times the mean distance of points to a sixteenth of the extent (the diagonal
    /// of the box around all lines). Below, the pieces between points are straight; above, the
    /// few steps or boxes depend on where they start.
    ///
    /// # Errors
    /// [`RangeError::Coarse`].
    pub fn usual(lines: &[Polyline]) -> Result<Self, RangeError> {
        let pieces: usize = lines.iter().map(|line| line.points().len() - 1).sum();
        let least_m = 4.0 * length(lines) / pieces.max(1) as f64;
        let most_m = extent(lines) / 16.0;
        Self::new(least_m, most_m).map_err(|_| RangeError::Coarse { least_m, most_m })
    }

    /// Smallest and largest scale in metres.
    pub fn ends_m(&self) -> [f64; 2] {
        [self.least_m, self.most_m]
    }

    /// The scales, by increasing size.
    pub(super) fn scales(&self) -> Vec<f64> {
        let ratio = self.most_m / self.least_m;
        let share = |index: usize| index as f64 / (Self::SCALES - 1) as f64;
        (0..Self::SCALES).map(|index| self.least_m * ratio.powf(share(index))).collect()
    }

    /// Passes when the scales suit the lines.
    pub(super) fn check(&self, lines: &[Polyline]) -> Result<(), RangeError> {
        let [length_m, extent_m] = [length(lines), extent(lines)];
        // Boxes are numbered over the whole extent, however short the lines are.
        let advised_m = length_m.max(extent_m) / Self::MOST_STEPS;
        if self.least_m < advised_m {
            return Err(RangeError::Fine { least_m: self.least_m, length_m, advised_m });
        }
        if self.most_m > extent_m {
            return Err(RangeError::Large { most_m: self.most_m, extent_m });
        }
        Ok(())
    }
}

impl FromStr for ScaleRange {
    type Err = RangeError;

    /// Reads `2km..100km`; lengths are in `m` or `km`.
    fn from_str(text: &str) -> Result<Self, RangeError> {
        let wrong = || RangeError::Text(text.into());
        let (least, most) = text.split_once("..").ok_or_else(wrong)?;
        Self::new(metres(least).ok_or_else(wrong)?, metres(most).ok_or_else(wrong)?)
    }
}

fn metres(text: &str) -> Option<f64> {
    let text = text.trim();
    let (number, unit) = match text.strip_suffix("km") {
        Some(number) => (number, 1000.0),
        None => (text.strip_suffix('m')?, 1.0),
    };
    number.trim().parse::<f64>().ok().map(|number| number * unit)
}

fn length(lines: &[Polyline]) -> f64 {
    lines.iter().map(Polyline::length_m).sum()
}

/// Diagonal of the box around all lines.
fn extent(lines: &[Polyline]) -> f64 {
    let points = || lines.iter().flat_map(|line| line.points());
    let side = |axis: usize| {
        let values = || points().map(move |point| point[axis]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    if points().next().is_none() {
        return 0.0;
    }
    [0, 1, 2].map(side).iter().map(|side| side * side).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_with_their_units() {
        let range: ScaleRange = "2km..100km".parse().unwrap();
        assert_eq!(range.ends_m(), [2000.0, 100_000.0]);
        assert_eq!("500 m .. 2.5 km".parse::<ScaleRange>().unwrap().ends_m(), [500.0, 2500.0]);
        assert_eq!(range.scales().len(), ScaleRange::SCALES);
        for text in ["", "2..3", "2km", "2km..", "km..m", "1mi..2mi", "2km..3"] {
            assert_eq!(text.parse::<ScaleRange>(), Err(RangeError::Text(text.into())), "{text}");
        }
        for text in ["3km..2km", "0m..1m", "-1m..1m", "1m..1m", "NaNm..1m", "1m..infm"] {
            assert!(matches!(text.parse::<ScaleRange>(), Err(RangeError::Order { .. })), "{text}");
        }
    }

    #[test]
    fn ranges_that_do_not_suit_the_lines_are_refused() {
        let line = [Polyline::planar(&[[0.0, 0.0], [300.0, 400.0]]).unwrap()];
        let check = |least, most| ScaleRange::new(least, most).unwrap().check(&line);
        assert!(matches!(check(1e-9, 100.0), Err(RangeError::Fine { .. })));
        assert!(matches!(check(10.0, 600.0), Err(RangeError::Large { .. })));
        assert_eq!(check(10.0, 100.0), Ok(()));
        assert!(matches!(ScaleRange::usual(&line), Err(RangeError::Coarse { .. })));
        assert!(matches!(ScaleRange::usual(&[]), Err(RangeError::Coarse { .. })));
    }
}
