//! Fractal dimensions: how a measure grows as the scale shrinks.

mod boxes;
mod divider;
mod gyration;
mod perimeter;
mod variogram;
mod window;

pub use boxes::box_dimension;
pub use divider::divider_dimension;
pub use gyration::gyration_dimension;
pub use perimeter::perimeter_dimension;
pub use variogram::variogram_dimension;
pub use window::{RangeError, ScaleRange};

use serde::Serialize;
use thiserror::Error;

use crate::line::Line;

/// Why no dimension can be measured.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DimensionError {
    /// Too few scales at which there is anything to measure.
    #[error("only {0} scales give a measure, at least 3 are needed; widen the range of scales")]
    TooFewScales(usize),
    /// The range of scales does not fit the lines.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The values do not fill the raster.
    #[error("{values} values for a raster of {} x {} cells; pass one a cell", size[0], size[1])]
    Length {
        /// Number of values passed.
        values: usize,
        /// Columns and rows.
        size: [usize; 2],
    },
    /// The size of a cell is no length.
    #[error("cells of {cell_m:?} m; sizes must be finite and above 0")]
    Cell {
        /// Size along the columns and along the rows.
        cell_m: [f64; 2],
    },
}

/// A fractal dimension and what it was read from.
///
/// It is the slope of a least squares line through the logarithms of scale and measure. No real
/// line or terrain is a fractal at all scales, so look at [`ScalePoint::local_dimension`] too.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dimension {
    /// The dimension.
    pub dimension: f64,
    /// The larger of the standard error of the slope and half the difference between the slopes
    /// of the finer and the coarser half of the scales. The bias of a method is not in it.
    pub error: f64,
    /// Smallest and largest scale that were used, in metres.
    pub range_m: [f64; 2],
    /// What was measured, by increasing scale.
    pub scales: Vec<ScalePoint>,
}

/// The measure at one scale.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ScalePoint {
    /// Ruler, box, block, lag or radius in metres.
    pub scale_m: f64,
    /// Steps of the ruler, boxes, length in metres, semivariance or particles: see the method.
    pub measure: f64,
    /// Dimension between the neighbouring scales alone.
    pub local_dimension: f64,
}

/// How a method turns a slope into a dimension: `at_zero + gain * slope`.
#[derive(Clone, Copy)]
struct Rule {
    at_zero: f64,
    gain: f64,
}

impl Rule {
    /// A number of pieces grows as scale^-D.
    const COUNT: Self = Self { at_zero: 0.0, gain: -1.0 };
    /// A mass grows as scale^D.
    const MASS: Self = Self { at_zero: 0.0, gain: 1.0 };
    /// A length grows as scale^(1 - D).
    const LENGTH: Self = Self { at_zero: 1.0, gain: -1.0 };
    /// The semivariance of a surface grows as lag^(2 (3 - D)).
    const VARIANCE: Self = Self { at_zero: 3.0, gain: -0.5 };

    fn dimension(self, slope: f64) -> f64 {
        self.at_zero + self.gain * slope
    }
}

impl Dimension {
    /// Fits pairs of scale and measure, by increasing scale; empty measures are left out.
    fn fit(measured: &[[f64; 2]], rule: Rule) -> Result<Self, DimensionError> {
        let kept: Vec<[f64; 2]> =
            measured.iter().copied().filter(|&[_, measure]| measure > 0.0).collect();
        let logarithms: Vec<[f64; 2]> = kept.iter().map(|pair| pair.map(f64::ln)).collect();
        let line = Line::through(&logarithms).ok_or(DimensionError::TooFewScales(kept.len()))?;
        let (fine, coarse) = logarithms.split_at(kept.len().div_ceil(2));
        let bend = match (Line::through(fine), Line::through(coarse)) {
            (Some(fine), Some(coarse)) => 0.5 * (fine.slope - coarse.slope).abs(),
            _ => 0.0,
        };
        let scales = kept.iter().enumerate().map(|(index, &[scale_m, measure])| {
            let local_dimension = rule.dimension(local_slope(&logarithms, index));
            ScalePoint { scale_m, measure, local_dimension }
        });
        Ok(Self {
            dimension: rule.dimension(line.slope),
            error: rule.gain.abs() * line.slope_error.max(bend),
            range_m: [kept[0][0], kept[kept.len() - 1][0]],
            scales: scales.collect(),
        })
    }
}

/// Passes when `values` fill a raster of cells with positive sizes.
fn check_raster(values: usize, size: [usize; 2], cell_m: [f64; 2]) -> Result<(), DimensionError> {
    if size[0].checked_mul(size[1]) != Some(values) {
        return Err(DimensionError::Length { values, size });
    }
    if cell_m.iter().all(|&side| side > 0.0 && side.is_finite()) {
        return Ok(());
    }
    Err(DimensionError::Cell { cell_m })
}

/// Slope from the point before `index` to the one after it.
fn local_slope(points: &[[f64; 2]], index: usize) -> f64 {
    let [before, after] =
        [points[index.saturating_sub(1)], points[(index + 1).min(points.len() - 1)]];
    (after[1] - before[1]) / (after[0] - before[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_and_a_bend_is_an_error() {
        let law: Vec<[f64; 2]> =
            (0..8).map(|k| f64::from(1 << k)).map(|s| [s, 5.0 * s.powf(-1.3)]).collect();
        let straight = Dimension::fit(&law, Rule::COUNT).unwrap();
        assert!((straight.dimension - 1.3).abs() < 1e-12 && straight.error < 1e-6);
        assert!(straight.scales.iter().all(|point| (point.local_dimension - 1.3).abs() < 1e-12));
        let bent: Vec<[f64; 2]> = law
            .iter()
            .map(|&[s, n]| [s, if s < 10.0 { n } else { n * (s / 10.0).powf(0.2) }])
            .collect();
        let bent = Dimension::fit(&bent, Rule::COUNT).unwrap();
        assert!((0.08..0.12).contains(&bent.error), "{}", bent.error);
        assert_eq!(Dimension::fit(&law[..2], Rule::COUNT), Err(DimensionError::TooFewScales(2)));
    }
}
