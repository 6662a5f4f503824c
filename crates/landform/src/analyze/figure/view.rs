//! What pictures of a terrain have in common: square cells, gaps, colours, exaggeration.

use landform_view::{ColourMap, Ground, HeightField, ViewError};

use super::super::Terrain;

/// Most nodes along the longer side of a picture.
const MOST_NODES: f64 = 800.0;
/// Height of the relief of a picture over its longer side, about.
const RELIEF: f64 = 0.12;

/// A terrain on square cells, few enough for a picture.
pub(super) struct Pictured {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Side of a cell in metres.
    pub spacing_m: f64,
    /// Heights; the lowest one where there are no data.
    heights: Vec<f64>,
    /// Whether a cell has data.
    pub known: Vec<bool>,
    /// Whether there is a sea.
    pub sea: bool,
    /// Lowest and highest height.
    pub range_m: [f64; 2],
}

impl Pictured {
    /// Resamples a terrain; `None` if it has no data, or is too narrow to be drawn.
    pub fn new(terrain: &Terrain) -> Option<Self> {
        let grid = &terrain.grid;
        let (counts, cell) = ([grid.columns(), grid.rows()], grid.cell_size());
        let sides = [0, 1].map(|axis| counts[axis] as f64 * cell[axis]);
        let spacing_m = cell[0].min(cell[1]).max(sides[0].max(sides[1]) / MOST_NODES);
        let size = sides.map(|side| (side / spacing_m).round() as usize);
        let across = along(&terrain.heights, counts[1], counts[0], size[0], Order::Rows);
        let heights = along(&across, size[0], counts[1], size[1], Order::Columns);
        let known: Vec<bool> = heights.iter().map(|height| !height.is_nan()).collect();
        let all = || heights.iter().copied().filter(|height| !height.is_nan());
        let range_m = [all().fold(f64::INFINITY, f64::min), all().fold(f64::MIN, f64::max)];
        let drawable = size.iter().all(|&nodes| nodes >= 2) && range_m[0] <= range_m[1];
        let heights =
            heights.iter().map(|height| if height.is_nan() { range_m[0] } else { *height });
        let sea = range_m[0] < 0.0 && range_m[1] > 0.0;
        let heights = heights.collect();
        drawable.then_some(Self { size, spacing_m, heights, known, sea, range_m })
    }

    /// The heights, to be drawn.
    pub fn field(&self) -> Result<HeightField<'_>, ViewError> {
        HeightField::new(self.size[0], self.size[1], self.spacing_m, &self.heights)
    }

    /// The heights, NaN where there are no data.
    pub fn with_gaps(&self) -> Vec<f64> {
        let height = |(height, known): (&f64, &bool)| if *known { *height } else { f64::NAN };
        self.heights.iter().zip(&self.known).map(height).collect()
    }

    /// Colours by height, with the break at the sea if there is one.
    pub fn ground(&self) -> Result<Ground, ViewError> {
        let name = if self.sea { "oleron" } else { "batlow" };
        let middle_m = self.sea.then_some(0.0);
        let range_m = Some(self.range_m);
        Ok(Ground { range_m, middle_m, ..Ground::new(ColourMap::named(name)?) })
    }

    /// Factor of heights, 1, 2 or 5 times a power of ten, at which a flat terrain shows its relief;
    /// mountains are drawn as they are.
    pub fn exaggeration(&self) -> f64 {
        let relief = self.range_m[1] - self.range_m[0];
        let side = self.size[0].max(self.size[1]) as f64 * self.spacing_m;
        let wanted = RELIEF * side / relief;
        if wanted <= 1.0 || !wanted.is_finite() {
            return 1.0;
        }
        let power = 10.0_f64.powf(wanted.log10().floor()).min(1e5);
        let step = [5.0, 2.0, 1.0].into_iter().find(|step| step * power <= wanted);
        step.unwrap_or(1.0) * power
    }
}

/// The axis that is resampled.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    Rows,
    Columns,
}

/// Resamples `lines` lines of `from` values to `to` values each: means where there are fewer, and
/// straight lines between the values where there are more. NaN where more than half is missing.
fn along(values: &[f64], lines: usize, from: usize, to: usize, order: Order) -> Vec<f64> {
    let (source, target) = match order {
        Order::Rows => ([1, from], [1, to]),
        Order::Columns => ([lines, 1], [lines, 1]),
    };
    let shares: Vec<Vec<(usize, f64)>> = (0..to).map(|index| shares(index, from, to)).collect();
    let mut resampled = vec![f64::NAN; lines * to];
    for line in 0..lines {
        for (index, shares) in shares.iter().enumerate() {
            let [mut sum, mut weight] = [0.0; 2];
            for &(place, share) in shares {
                let value = values[place * source[0] + line * source[1]];
                if !value.is_nan() {
                    sum += share * value;
                    weight += share;
                }
            }
            if weight >= 0.5 {
                resampled[index * target[0] + line * target[1]] = sum / weight;
            }
        }
    }
    resampled
}

/// Places of a line of `from` values that make up a value of one of `to`, with their shares.
fn shares(index: usize, from: usize, to: usize) -> Vec<(usize, f64)> {
    let step = from as f64 / to as f64;
    if step <= 1.0 {
        let place = ((index as f64 + 0.5) * step - 0.5).clamp(0.0, (from - 1) as f64);
        let share = place.fract();
        let next = (place as usize + 1).min(from - 1);
        return vec![(place as usize, 1.0 - share), (next, share)];
    }
    let (start, end) = (index as f64 * step, (index as f64 + 1.0) * step);
    let covered = |place: usize| {
        let place = place as f64;
        (end.min(place + 1.0) - start.max(place)).max(0.0) / step
    };
    (start as usize..(end.ceil() as usize).min(from)).map(|place| (place, covered(place))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_and_keep_means() {
        for (from, to) in [(10, 10), (10, 4), (4, 10), (7, 3), (3, 7), (1, 5), (5, 1)] {
            let mut taken = vec![0.0; from];
            for index in 0..to {
                let shares = shares(index, from, to);
                let sum: f64 = shares.iter().map(|share| share.1).sum();
                assert!((sum - 1.0).abs() < 1e-9, "{from} {to} {index}: {sum}");
                shares.iter().for_each(|&(place, share)| taken[place] += share);
            }
            if from >= to {
                let even = to as f64 / from as f64;
                assert!(taken.iter().all(|taken| (taken - even).abs() < 1e-9), "{from} {to}");
            }
        }
    }

    #[test]
    fn both_axes_are_resampled_and_gaps_stay() {
        let values = [1.0, 3.0, 5.0, 7.0, f64::NAN, 4.0, f64::NAN, f64::NAN];
        let half = along(&values, 2, 4, 2, Order::Rows);
        assert_eq!(half[..3], [2.0, 6.0, 4.0]);
        assert!(half[3].is_nan());
        let flat = along(&[1.0, 2.0, 3.0, 6.0], 2, 2, 1, Order::Columns);
        assert_eq!(flat, [2.0, 4.0]);
    }
}
