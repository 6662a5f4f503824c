//! The shore of a raster, and how its length grows as one looks closer.

use landform_analysis::grid::Grid;
use landform_analysis::{Dimension, DimensionError, perimeter_dimension};
use serde::Serialize;

use super::Window;

/// The boundary between the ground above and below a level.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shore {
    /// The level in metres: the sea's, 0, when heights lie on both sides of it, else the median.
    pub level_m: f64,
    /// Dimension of the boundary by the perimeter of blocks: [`perimeter_dimension`].
    #[serde(flatten)]
    pub dimension: Dimension,
}

/// The level of [`Shore::level_m`]; `None` without data. `heights` are put into another order.
pub(super) fn level(heights: &mut Vec<f64>) -> Option<f64> {
    heights.retain(|height| !height.is_nan());
    let below = heights.iter().any(|&height| height < 0.0);
    let above = heights.iter().any(|&height| height > 0.0);
    if below && above {
        return Some(0.0);
    }
    let middle = heights.len() / 2;
    let last = heights.len().checked_sub(1)?;
    Some(*heights.select_nth_unstable_by(middle.min(last), f64::total_cmp).1)
}

impl Shore {
    /// Measures the boundary of `heights` (of a window without gaps) at a level. Oblong cells are
    /// taken for squares of the same area.
    pub(super) fn measure(
        cells: &Grid,
        window: Window,
        heights: &[f64],
        level_m: f64,
    ) -> Result<Self, DimensionError> {
        let land: Vec<bool> = heights.iter().map(|&height| height >= level_m).collect();
        let size = [window.columns, window.rows];
        let dimension = perimeter_dimension(&land, size, cells.cell_area().sqrt())?;
        Ok(Self { level_m, dimension })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_is_the_sea_or_the_median() {
        assert_eq!(level(&mut vec![-4.0, 9.0, 30.0, f64::NAN]), Some(0.0));
        assert_eq!(level(&mut vec![30.0, f64::NAN, 4.0, 9.0]), Some(9.0));
        assert_eq!(level(&mut vec![0.0, 0.0, 3.0, 5.0]), Some(3.0));
        assert_eq!(level(&mut vec![f64::NAN]), None);
    }
}
