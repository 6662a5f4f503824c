//! The perimeter of a set of cells, seen at coarser and coarser scales.

use super::{Dimension, DimensionError, Rule};

/// Largest block in cells; blocks double from 1.
const LARGEST_BLOCK: usize = 32;

/// Dimension of the boundary of land by the perimeter method: land is averaged over blocks of 1,
/// 2, 4, ... 32 cells, a block that is land by half or more is land, and the length of the
/// sides between land and sea grows as side^(1 - D).
///
/// `land` holds one value a cell of `size` (columns, rows), `cell_m` is the side of a square
/// cell in metres. Blocks of more than an eighth of the raster are left out, and so are rows and
/// columns that fill no block. Borders of the raster are no coast.
///
/// # Limits
/// High by 0.02 to 0.08 for the level sets of fractional Brownian surfaces with H of 0.3 to 0.9
/// (where D = 2 - H for all islands together).
///
/// # Errors
/// [`DimensionError::Length`], [`DimensionError::Cell`], [`DimensionError::TooFewScales`] for
/// rasters under 32 cells or without a coast.
///
/// # Source
/// Thesis, appendix B (the block-reduced perimeter) and target D = 2 - H of section 2.1.4.
pub fn perimeter_dimension(
    land: &[bool],
    size: [usize; 2],
    cell_m: f64,
) -> Result<Dimension, DimensionError> {
    super::check_raster(land.len(), size, [cell_m; 2])?;
    let mut measured = Vec::new();
    let mut block = 1;
    while block <= LARGEST_BLOCK.min(size[0].min(size[1]) / 8) {
        let sides = coast_sides(land, size, block);
        measured.push([block as f64 * cell_m, sides as f64 * block as f64 * cell_m]);
        block *= 2;
    }
    Dimension::fit(&measured, Rule::LENGTH)
}

/// Number of sides between blocks of land and blocks of sea.
fn coast_sides(land: &[bool], [width, height]: [usize; 2], block: usize) -> usize {
    let [columns, rows] = [width / block, height / block];
    let is_land = |column: usize, row: usize| {
        let cells = (0..block).flat_map(|y| {
            let start = column * block + width * (row * block + y);
            &land[start..start + block]
        });
        2 * cells.filter(|&&land| land).count() >= block * block
    };
    let mut above = vec![false; columns];
    let mut sides = 0;
    for row in 0..rows {
        let here: Vec<bool> = (0..columns).map(|column| is_land(column, row)).collect();
        sides += here.windows(2).filter(|pair| pair[0] != pair[1]).count();
        if row > 0 {
            sides += here.iter().zip(&above).filter(|(here, above)| here != above).count();
        }
        above = here;
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_coast_has_dimension_one() {
        let land: Vec<bool> = (0..256 * 256).map(|cell| cell % 256 < 128).collect();
        let coast = perimeter_dimension(&land, [256, 256], 5.0).unwrap();
        assert!((coast.dimension - 1.0).abs() < 1e-12, "{coast:?}");
        assert_eq!(coast.range_m, [5.0, 160.0]);
        assert_eq!(coast.scales[0].measure, 256.0 * 5.0);
    }

    #[test]
    fn rasters_without_a_coast_or_of_a_wrong_size_are_refused() {
        let sea = [false; 64 * 64];
        assert_eq!(perimeter_dimension(&sea, [64, 64], 1.0), Err(DimensionError::TooFewScales(0)));
        assert!(matches!(
            perimeter_dimension(&sea, [64, 65], 1.0),
            Err(DimensionError::Length { .. })
        ));
        assert!(matches!(
            perimeter_dimension(&sea, [64, 64], f64::NAN),
            Err(DimensionError::Cell { .. })
        ));
        assert_eq!(perimeter_dimension(&[], [0, 9], 1.0), Err(DimensionError::TooFewScales(0)));
    }
}
