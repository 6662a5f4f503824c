//! The curve itself.

use rayon::prelude::*;
use thiserror::Error;

/// Why heights have no hypsometric curve.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HypsometryError {
    /// Nothing but missing heights.
    #[error("no height is a finite number; a hypsometric curve needs two different ones")]
    Empty,
    /// All heights are the same.
    #[error("all heights are {0}; a hypsometric curve needs two different ones")]
    Flat(f64),
}

/// The hypsometric curve of a terrain: relative height over the share of its area that lies
/// above, after Strahler (1952).
///
/// It falls from (0, 1), the highest point, to (1, 0), the lowest one.
#[derive(Clone, Debug, PartialEq)]
pub struct HypsometricCurve {
    lowest: f64,
    highest: f64,
    integral: f64,
    heights: Vec<f64>,
}

impl HypsometricCurve {
    /// Number of places at which the curve is kept, at equal shares of area from 0 to 1.
    pub const PLACES: usize = 201;

    /// The curve of `heights`, each standing for the same area; those that are not finite are
    /// left out. Cells of geographic rasters shrink towards the poles, which is not allowed for.
    ///
    /// Cost: N log N, and a copy of the heights.
    ///
    /// # Errors
    /// See [`HypsometryError`].
    ///
    /// # Example
    /// ```
    /// use landform_analysis::{HypsometricCurve, HypsometricStage, Hypsometry};
    ///
    /// // A plateau of 9 m with a small valley.
    /// let heights: Vec<f64> = (0..1000).map(|cell| f64::min(9.0, f64::from(cell) / 20.0)).collect();
    /// let curve = HypsometricCurve::new(&heights)?;
    /// assert!(curve.integral() > 0.8);
    /// let hypsometry = Hypsometry::new(&curve);
    /// assert_eq!(hypsometry.stage, HypsometricStage::Unusual, "completely convex");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(heights: &[f64]) -> Result<Self, HypsometryError> {
        let mut sorted: Vec<f64> = heights.iter().copied().filter(|h| h.is_finite()).collect();
        sorted.par_sort_unstable_by(f64::total_cmp);
        let [Some(&lowest), Some(&highest)] = [sorted.first(), sorted.last()] else {
            return Err(HypsometryError::Empty);
        };
        if lowest == highest {
            return Err(HypsometryError::Flat(lowest));
        }
        let relative = |height: f64| (height - lowest) / (highest - lowest);
        let mean = sorted.iter().map(|&height| relative(height)).sum::<f64>() / sorted.len() as f64;
        let at = |place: usize| relative(quantile(&sorted, 1.0 - share(place)));
        let heights = (0..Self::PLACES).map(at).collect();
        Ok(Self { lowest, highest, integral: mean, heights })
    }

    /// Lowest and highest height, in the unit of the heights.
    pub fn range(&self) -> [f64; 2] {
        [self.lowest, self.highest]
    }

    /// Hypsometric integral: (mean - lowest) / (highest - lowest).
    pub fn integral(&self) -> f64 {
        self.integral
    }

    /// Points `[share of the area above, relative height]`, from the summit down.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.heights.iter().enumerate().map(|(place, &height)| [share(place), height])
    }

    /// Relative height above which `share_above` of the area lies (0 to 1, else clamped).
    pub fn height_at(&self, share_above: f64) -> f64 {
        let place = share_above.clamp(0.0, 1.0) * (Self::PLACES - 1) as f64;
        let below = (place as usize).min(Self::PLACES - 2);
        let part = place - below as f64;
        self.heights[below] * (1.0 - part) + self.heights[below + 1] * part
    }
}

fn share(place: usize) -> f64 {
    place as f64 / (HypsometricCurve::PLACES - 1) as f64
}

/// Value at a share of sorted values, between two of them by interpolation.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = (place as usize).min(sorted.len() - 1);
    let above = (below + 1).min(sorted.len() - 1);
    let part = place - below as f64;
    sorted[below] * (1.0 - part) + sorted[above] * part
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights of a cone over a disc: the share above relative height h is (1 - h)^2, so the
    /// curve is 1 - sqrt(x) and its integral 1/3.
    #[test]
    fn a_cone_has_the_curve_of_a_cone() {
        let mut heights = Vec::new();
        for cell in 0..401 * 401 {
            let [x, y] = [(cell % 401) as f64 - 200.0, (cell / 401) as f64 - 200.0];
            let distance = (x * x + y * y).sqrt();
            heights.push(if distance <= 200.0 { 700.0 - distance } else { f64::NAN });
        }
        let curve = HypsometricCurve::new(&heights).unwrap();
        assert_eq!(curve.range(), [500.0, 700.0]);
        assert!((curve.integral() - 1.0 / 3.0).abs() < 1e-3, "{}", curve.integral());
        for [share, height] in curve.points() {
            assert!((height - (1.0 - share.sqrt())).abs() < 5e-3, "{share} {height}");
        }
        assert!((curve.height_at(0.1234) - (1.0 - 0.1234_f64.sqrt())).abs() < 5e-3);
        assert_eq!([curve.height_at(-1.0), curve.height_at(2.0)], [1.0, 0.0]);
    }

    #[test]
    fn terrains_without_relief_are_refused() {
        assert_eq!(HypsometricCurve::new(&[]), Err(HypsometryError::Empty));
        assert_eq!(HypsometricCurve::new(&[f64::NAN; 3]), Err(HypsometryError::Empty));
        assert_eq!(HypsometricCurve::new(&[2.0, f64::NAN]), Err(HypsometryError::Flat(2.0)));
    }
}
