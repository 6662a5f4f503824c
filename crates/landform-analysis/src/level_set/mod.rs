//! Lines of equal height of a raster.

mod squares;
mod trace;

use thiserror::Error;

use crate::{Polyline, PolylineError};

/// What happens to level sets at the border of the raster and beside cells without data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelSetEdge {
    /// They end there: only what was measured is drawn. For lengths and dimensions.
    End,
    /// They go on along the outermost nodes, as if all beyond lay below the level. For areas:
    /// every line is closed.
    Close,
}

/// Why a raster has no level sets.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LevelSetError {
    /// The heights do not fill the raster.
    #[error("{values} heights for a raster of {} x {} nodes; pass one a node", size[0], size[1])]
    Length {
        /// Number of heights passed.
        values: usize,
        /// Columns and rows.
        size: [usize; 2],
    },
    /// The level is no height.
    #[error("the level is {0}; it must be a finite height")]
    Level(f64),
}

/// One line of equal height. The land, at or above the level, lies to its left on the map.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelSet {
    /// Points `[column, row]`, in nodes from the north-western one; the row runs south. The last
    /// point of a closed line is its first.
    pub points: Vec<[f64; 2]>,
    /// Whether the line ends where it starts.
    pub closed: bool,
}

impl LevelSet {
    /// Area of the cells within a closed line, in cells: above 0 for islands, below 0 for lakes
    /// and other low ground within land; 0 for open lines.
    pub fn area(&self) -> f64 {
        if !self.closed {
            return 0.0;
        }
        let twice = |pair: &[[f64; 2]]| pair[1][0] * pair[0][1] - pair[0][0] * pair[1][1];
        0.5 * self.points.windows(2).map(twice).sum::<f64>()
    }

    /// Whether this is the outline of land.
    pub fn is_island(&self) -> bool {
        self.area() > 0.0
    }

    /// The line in metres, with x to the east and y to the north.
    ///
    /// # Errors
    /// [`PolylineError::NotFinite`] when `cell_m`, the distance of nodes along both axes, is not
    /// finite.
    pub fn polyline(&self, cell_m: [f64; 2]) -> Result<Polyline, PolylineError> {
        let metres = |&[column, row]: &[f64; 2]| [column * cell_m[0], -row * cell_m[1]];
        Polyline::planar(&self.points.iter().map(metres).collect::<Vec<_>>())
    }
}

/// Lines along which `heights` (one a node of `size` columns and rows, NaN where there are no
/// data) pass through `level`, by marching squares.
///
/// Lines cross the edges between nodes where heights interpolated along them reach the level. A
/// square with land on one diagonal and sea on the other is joined as the mean of its four
/// corners says. Lines never cross, and touch only where a height is the level itself. Open lines come first, then closed
/// ones, each kind in node order of the first edge that it crosses.
///
/// Cost: one pass over the nodes; memory grows with the length of the lines.
///
/// # Errors
/// See [`LevelSetError`].
///
/// # Example
/// ```
/// use landform_analysis::{LevelSetEdge, level_sets};
///
/// let heights: Vec<f64> = (0..25).map(|node| f64::from(u8::from(node == 12))).collect();
/// let lines = level_sets(&heights, [5, 5], 0.25, LevelSetEdge::End)?;
/// assert_eq!(lines.len(), 1);
/// assert_eq!(lines[0].area(), 2.0 * 0.75 * 0.75);
/// # Ok::<(), landform_analysis::LevelSetError>(())
/// ```
///
/// # Source
/// Lorensen and Cline 1987, in two dimensions; thesis, section 4.3.4 (level sets as coasts).
pub fn level_sets(
    heights: &[f64],
    size: [usize; 2],
    level: f64,
    edge: LevelSetEdge,
) -> Result<Vec<LevelSet>, LevelSetError> {
    if size[0].checked_mul(size[1]) != Some(heights.len()) {
        return Err(LevelSetError::Length { values: heights.len(), size });
    }
    if !level.is_finite() {
        return Err(LevelSetError::Level(level));
    }
    let squares = squares::Squares { heights, size, level, edge };
    let lines = trace::lines(&squares.pieces());
    let place = |crossings: &[u64]| crossings.iter().map(|&at| squares.place(at)).collect();
    Ok(lines
        .iter()
        .map(|crossings| LevelSet {
            points: place(crossings),
            closed: crossings.first() == crossings.last(),
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights that fall with the distance from the middle of 101 x 101 nodes.
    fn cone() -> Vec<f64> {
        let offset = |index: usize| index as f64 - 50.0;
        (0..101 * 101).map(|node| -offset(node % 101).hypot(offset(node / 101))).collect()
    }

    #[test]
    fn a_circle_has_the_length_and_the_area_of_a_circle() {
        let pi = std::f64::consts::PI;
        let lines = level_sets(&cone(), [101, 101], -30.25, LevelSetEdge::End).unwrap();
        assert_eq!(lines.len(), 1);
        assert!(lines[0].closed && lines[0].is_island());
        assert!((lines[0].area() / (pi * 30.25 * 30.25) - 1.0).abs() < 1e-3);
        let length = lines[0].polyline([10.0, 10.0]).unwrap().length_m();
        assert!((length / (2.0 * pi * 302.5) - 1.0).abs() < 1e-3, "{length}");
        let hollow: Vec<f64> = cone().iter().map(|height| -height).collect();
        let lake = &level_sets(&hollow, [101, 101], 30.25, LevelSetEdge::End).unwrap()[0];
        assert!(!lake.is_island() && (lake.area() + lines[0].area()).abs() < 1e-6);
    }

    /// A circle that the border cuts: four arcs, or one outline along the border.
    #[test]
    fn lines_end_at_the_border_or_go_round() {
        let arcs = level_sets(&cone(), [101, 101], -60.0, LevelSetEdge::End).unwrap();
        assert_eq!(arcs.len(), 4);
        assert!(arcs.iter().all(|arc| !arc.closed && arc.area() == 0.0));
        let whole = level_sets(&cone(), [101, 101], -60.0, LevelSetEdge::Close).unwrap();
        assert_eq!(whole.len(), 1);
        // A square with half side 50 cut by a circle with radius 60.
        let half_angle = (50.0_f64 / 60.0).acos();
        let segment = 3600.0 * (half_angle - half_angle.sin() * half_angle.cos());
        let expected = std::f64::consts::PI * 3600.0 - 4.0 * segment;
        assert!((whole[0].area() / expected - 1.0).abs() < 1e-3, "{}", whole[0].area());
        let all = level_sets(&cone(), [101, 101], -90.0, LevelSetEdge::Close).unwrap();
        assert_eq!((all.len(), all[0].area()), (1, 10_000.0));
    }

    #[test]
    fn lines_keep_away_from_missing_heights() {
        let mut heights = cone();
        heights[50 * 101 + 80] = f64::NAN;
        let lines = level_sets(&heights, [101, 101], -30.25, LevelSetEdge::End).unwrap();
        assert_eq!(lines.len(), 1);
        assert!(!lines[0].closed);
        assert!(
            lines[0].points.iter().all(|[x, y]| (x - 80.0).abs() > 0.9 || (y - 50.0).abs() >= 1.0)
        );
        let closed = level_sets(&heights, [101, 101], -30.25, LevelSetEdge::Close).unwrap();
        assert!(closed.len() == 1 && closed[0].closed);
    }

    /// Land on one diagonal: the mean of the corners joins it or parts it.
    #[test]
    fn saddles_are_joined_by_the_mean() {
        let count = |high: f64| {
            let heights =
                [[0.0; 4], [0.0, high, 0.0, 0.0], [0.0, 0.0, high, 0.0], [0.0; 4]].concat();
            level_sets(&heights, [4, 4], 1.0, LevelSetEdge::End).unwrap().len()
        };
        assert_eq!([count(1.5), count(3.0)], [2, 1]);
    }

    /// On rough heights with gaps all outlines close, and no piece is drawn twice or left out.
    #[test]
    fn rough_heights_are_traced_whole() {
        let rough =
            |node: u64| match (node.wrapping_mul(node).wrapping_mul(2_654_435_761) >> 9) & 63 {
                0 => f64::NAN,
                value => value as f64,
            };
        let heights: Vec<f64> = (0..60 * 40).map(rough).collect();
        let closed = level_sets(&heights, [60, 40], 31.5, LevelSetEdge::Close).unwrap();
        assert!(closed.len() > 50 && closed.iter().all(|line| line.closed));
        let ended = level_sets(&heights, [60, 40], 31.5, LevelSetEdge::End).unwrap();
        let mut pieces: Vec<[u64; 4]> = ended
            .iter()
            .flat_map(|line| line.points.windows(2))
            .map(|pair| [pair[0][0], pair[0][1], pair[1][0], pair[1][1]].map(f64::to_bits))
            .collect();
        let drawn = pieces.len();
        pieces.sort_unstable();
        pieces.dedup();
        assert_eq!(pieces.len(), drawn);
        let crossed = (0..60 * 40 - 1).filter(|node| node % 60 < 59).filter(|&node| {
            let pair = [heights[node], heights[node + 1]];
            (pair[0] >= 31.5) != (pair[1] >= 31.5) && pair.iter().all(|height| !height.is_nan())
        });
        // Lines cross at least the rows' edges that have no gap beside them.
        assert!(drawn > crossed.count());
    }

    #[test]
    fn bad_input_is_refused_and_small_rasters_have_no_lines() {
        let levels = |heights: &[f64], size| level_sets(heights, size, 0.5, LevelSetEdge::End);
        assert!(matches!(levels(&[1.0], [1, 2]), Err(LevelSetError::Length { values: 1, .. })));
        assert!(matches!(
            level_sets(&[1.0], [1, 1], f64::NAN, LevelSetEdge::End),
            Err(LevelSetError::Level(_))
        ));
        assert_eq!(levels(&[], [0, 0]), Ok(vec![]));
        assert_eq!(levels(&[1.0], [1, 1]), Ok(vec![]));
        assert_eq!(levels(&[f64::NAN; 9], [3, 3]), Ok(vec![]));
    }
}
