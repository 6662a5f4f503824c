//! Power laws of drainage: exceedance of area, Hack's law, slope against area.

use serde::Serialize;

use super::FlowDirections;
use crate::line::Line;

/// A power law fitted by least squares through the logarithms of bins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PowerLaw {
    /// The exponent, positive as the law is usually written.
    pub exponent: f64,
    /// Its standard error from the scatter of the bins about the line.
    pub error: f64,
    /// Coefficient of determination of the line.
    pub r_squared: f64,
    /// Number of bins.
    pub points: usize,
    /// Contributing areas that were used, in square metres.
    pub range_m2: [f64; 2],
}

/// Slope against contributing area: `S = steepness A^-concavity` (Flint 1974).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SlopeArea {
    /// Concavity and how well it is known. 0.45 is usually assumed; for stream power at steady
    /// state it is m / n.
    pub concavity: PowerLaw,
    /// Steepness in metres to the power of twice the concavity.
    pub steepness: f64,
    /// Steepness at the concavity [`SlopeArea::REFERENCE`], in metres to the power 0.9: mean
    /// over the bins.
    pub normalized_steepness: f64,
}

impl SlopeArea {
    /// Reference concavity of the normalised steepness.
    pub const REFERENCE: f64 = 0.45;
}

/// Contributing areas, in cells, that the exponents of drainage are fitted to, in bins of half an
/// octave.
///
/// Below, the grid decides; above, the size of the terrain does. The exponents depend on the
/// range, so it is stated with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaRange {
    /// Least contributing area in cells, at least 1.
    pub lowest: f64,
    /// Largest contributing area in cells.
    pub highest: f64,
}

impl AreaRange {
    /// From 16 cells to 5 % of the largest basin.
    pub fn usual(contributing_cells: &[u32]) -> Self {
        let largest = contributing_cells.iter().copied().max().unwrap_or(0);
        Self { lowest: 16.0, highest: 0.05 * f64::from(largest) }
    }

    /// Number of bins that fit in.
    fn bins(&self) -> usize {
        let octaves = (self.highest / self.lowest).log2();
        // Negative numbers and NaN become 0.
        if self.lowest >= 1.0 && octaves.is_finite() { (2.0 * octaves) as usize } else { 0 }
    }

    /// Bin of an area in cells; those above the range have numbers from `bins()`.
    fn bin(&self, cells: u32) -> Option<usize> {
        let area = f64::from(cells);
        (area >= self.lowest).then(|| (2.0 * (area / self.lowest).log2()) as usize)
    }

    /// Fits a line through points of natural logarithms, the first of areas in cells.
    fn law(&self, cell_area: f64, points: &[[f64; 2]], sign: f64) -> Option<(PowerLaw, Line)> {
        let line = Line::through(points)?;
        let law = PowerLaw {
            exponent: sign * line.slope,
            error: line.slope_error,
            r_squared: line.r_squared,
            points: points.len(),
            range_m2: [self.lowest * cell_area, self.highest * cell_area],
        };
        Some((law, line))
    }

    /// Mean logarithms of area and of some value in each bin with at least five cells.
    fn means(&self, cells: &[u32], value: impl Fn(usize) -> Option<f64>) -> Vec<[f64; 2]> {
        let mut sums = vec![[0.0; 3]; self.bins()];
        for (cell, &area) in cells.iter().enumerate() {
            let Some(sum) = self.bin(area).and_then(|bin| sums.get_mut(bin)) else { continue };
            if let Some(value) = value(cell).filter(|value| *value > 0.0) {
                for (sum, part) in sum.iter_mut().zip([1.0, f64::from(area).ln(), value.ln()]) {
                    *sum += part;
                }
            }
        }
        let full = sums.into_iter().filter(|[count, ..]| *count >= 5.0);
        full.map(|[count, area, value]| [area / count, value / count]).collect()
    }
}

/// Exponent beta of `P(area >= A) ~ A^-beta`: the share of cells with at least a contributing
/// area. River basins have 0.43 +- 0.02 (Rodriguez-Iturbe et al. 1992). `None` if fewer than
/// three bins lie in the range.
///
/// # Limits
/// Finite size adds about 0.04: networks with an exact exponent of 1/3 measure 0.375 to 0.380 on
/// 512 x 512 cells.
pub fn area_exceedance(
    directions: &FlowDirections,
    cells: &[u32],
    range: AreaRange,
) -> Option<PowerLaw> {
    let bins = range.bins();
    let mut counts = vec![0_u64; bins + 1];
    for bin in cells.iter().filter_map(|&area| range.bin(area)) {
        counts[bin.min(bins)] += 1;
    }
    let total = cells.iter().filter(|&&area| area > 0).count() as f64;
    let mut above = counts[bins];
    let mut points = Vec::with_capacity(bins);
    for (bin, count) in counts[..bins].iter().enumerate().rev() {
        above += count;
        let threshold = range.lowest.ln() + 0.5 * bin as f64 * std::f64::consts::LN_2;
        if above > 0 {
            points.push([threshold, (above as f64 / total).ln()]);
        }
    }
    Some(range.law(directions.grid().cell_area(), &points, -1.0)?.0)
}

/// Hack's exponent h of `L ~ A^h`, with L the longest way upstream: mean of its logarithm in bins
/// of area. River basins have 0.5 to 0.6 (Hack 1957: 0.6). `None` if fewer than three bins lie
/// in the range.
pub fn hack_exponent(
    directions: &FlowDirections,
    cells: &[u32],
    range: AreaRange,
) -> Option<PowerLaw> {
    let lengths = longest_ways(directions);
    let points = range.means(cells, |cell| Some(lengths[cell]));
    Some(range.law(directions.grid().cell_area(), &points, 1.0)?.0)
}

/// Length in metres of the longest way by which water comes to each cell.
pub fn longest_ways(directions: &FlowDirections) -> Vec<f64> {
    let steps = directions.grid().step_lengths();
    let mut lengths = vec![0.0_f64; directions.grid().cell_count()];
    directions.visit_downstream(|cell, direction, receiver| {
        if let (Some(direction), Some(receiver)) = (direction, receiver) {
            let length = lengths[cell] + steps[usize::from(direction)];
            lengths[receiver] = lengths[receiver].max(length);
        }
    });
    lengths
}

/// Concavity and steepness from the slopes of all cells with a descent to their receiver: mean of
/// their logarithm in bins of area. `heights` are those that the directions were made of. `None`
/// if fewer than three bins lie in the range.
pub fn slope_area(
    directions: &FlowDirections,
    heights: &[f64],
    cells: &[u32],
    range: AreaRange,
) -> Option<SlopeArea> {
    let grid = directions.grid();
    let steps = grid.step_lengths();
    let slope = |cell: usize| {
        let [from, to] = [heights.get(cell)?, heights.get(directions.receiver(cell)?)?];
        Some((from - to) / steps[usize::from(directions.direction(cell)?)])
    };
    let points = range.means(cells, slope);
    let (concavity, line) = range.law(grid.cell_area(), &points, -1.0)?;
    let cell = grid.cell_area().ln();
    let normalized =
        |[area, slope]: &[f64; 2]| (slope + SlopeArea::REFERENCE * (area + cell)).exp();
    Some(SlopeArea {
        concavity,
        steepness: (line.intercept - line.slope * cell).exp(),
        normalized_steepness: points.iter().map(normalized).sum::<f64>() / points.len() as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;
    use crate::hydrology::testing::hash;

    /// Scheidegger's network (1967): every cell drains to the south-west or the south-east at
    /// random. Exactly h = 2/3 and beta = 1/3 on an endless plane.
    fn scheidegger(seed: u64) -> FlowDirections {
        let grid = Grid::new([512, 512], [1.0; 2]).unwrap();
        FlowDirections::from_steps(&grid, |cell| 6 + (hash(seed, cell as u64) & 1) as u8)
    }

    /// Published for this size (bias of finite size included): h 0.672 to 0.684, beta 0.375 to
    /// 0.380.
    #[test]
    fn scheideggers_network_has_its_exponents() {
        for seed in 0..3 {
            let directions = scheidegger(seed);
            let cells = directions.contributing_cells();
            let range = AreaRange::usual(&cells);
            let hack = hack_exponent(&directions, &cells, range).unwrap();
            assert!((hack.exponent - 2.0 / 3.0).abs() < 0.03, "{hack:?}");
            let beta = area_exceedance(&directions, &cells, range).unwrap();
            assert!((beta.exponent - 1.0 / 3.0).abs() < 0.06, "{beta:?}");
        }
    }

    /// A uniform spanning tree of the lattice with four neighbours, its root beyond the border, by
    /// Wilson's loop-erased walks (1996). Exactly h = 5/8 and beta = 3/8 on an endless plane.
    fn spanning_tree(seed: u64) -> FlowDirections {
        let grid = Grid::new([512, 512], [1.0; 2]).unwrap();
        let mut steps = vec![0_u8; grid.cell_count()];
        let mut joined = vec![false; grid.cell_count()];
        let beside = |cell: usize, step: u8| {
            grid.neighbours(cell).find(|next| next.0 == usize::from(step)).map(|next| next.1)
        };
        let mut walked = 0;
        for start in 0..steps.len() {
            let mut at = Some(start);
            while let Some(cell) = at.filter(|&cell| !joined[cell]) {
                walked += 1;
                steps[cell] = (hash(seed, walked) & 3) as u8;
                at = beside(cell, steps[cell]);
            }
            let mut at = Some(start);
            while let Some(cell) = at.filter(|&cell| !joined[cell]) {
                joined[cell] = true;
                at = beside(cell, steps[cell]);
            }
        }
        FlowDirections::from_steps(&grid, |cell| steps[cell])
    }

    /// Found elsewhere for this size (bias of finite size included): h 0.636 to 0.659, beta 0.409 to
    /// 0.430.
    #[test]
    fn uniform_spanning_trees_have_their_exponents() {
        for seed in 0..3 {
            let directions = spanning_tree(seed);
            let cells = directions.contributing_cells();
            let range = AreaRange::usual(&cells);
            let hack = hack_exponent(&directions, &cells, range).unwrap();
            assert!((hack.exponent - 5.0 / 8.0).abs() < 0.04, "{hack:?}");
            let beta = area_exceedance(&directions, &cells, range).unwrap();
            assert!((beta.exponent - 3.0 / 8.0).abs() < 0.06, "{beta:?}");
        }
    }

    /// Heights built upwards from the outlets so that the slope is 3 A^-0.4 exactly.
    #[test]
    fn a_known_slope_area_law_is_found() {
        let directions = scheidegger(7);
        let grid = *directions.grid();
        let cells = directions.contributing_cells();
        let mut order = Vec::new();
        directions.visit_downstream(|cell, _, _| order.push(cell));
        let mut heights = vec![0.0; cells.len()];
        for &cell in order.iter().rev() {
            if let Some(next) = directions.receiver(cell) {
                let length = grid.step_lengths()[6];
                heights[cell] = heights[next] + length * 3.0 * f64::from(cells[cell]).powf(-0.4);
            }
        }
        let range = AreaRange::usual(&cells);
        let fit = slope_area(&directions, &heights, &cells, range).unwrap();
        assert!((fit.concavity.exponent - 0.4).abs() < 1e-6, "{fit:?}");
        assert!((fit.steepness - 3.0).abs() < 1e-4, "{fit:?}");
        assert!(fit.normalized_steepness > 3.0, "{fit:?}");
    }

    #[test]
    fn small_terrains_have_no_laws() {
        let grid = Grid::new([3, 3], [1.0; 2]).unwrap();
        let directions = FlowDirections::over_filled(&grid, &[1.0; 9]).unwrap();
        let cells = directions.contributing_cells();
        for range in [AreaRange::usual(&cells), AreaRange { lowest: f64::NAN, highest: 1.0 }] {
            assert_eq!(area_exceedance(&directions, &cells, range), None);
            assert_eq!(hack_exponent(&directions, &cells, range), None);
            assert_eq!(slope_area(&directions, &[1.0; 9], &cells, range), None);
        }
    }
}
