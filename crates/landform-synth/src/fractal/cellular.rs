//! Cellular noise: distances to random points (Worley 1996).

use landform_sim::random::unit;

use super::cells::{CellNoise, Cells};

/// Which distance a cellular noise shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellularFeature {
    Nearest,
    Second,
    Difference,
}

/// Distances to the nearest points, of which every square cell holds one at a random place.
#[derive(Debug)]
pub(super) struct CellularNoise {
    pub cells: Cells,
    pub feature: CellularFeature,
}

/// The largest square of the distance to the nearest point: from corner to corner of a cell.
const FARTHEST_NEAREST: f64 = 2.0;

/// The same of the second nearest: from the middle of a cell to the far corner of the next.
const FARTHEST_SECOND: f64 = 2.5;

impl CellNoise for CellularNoise {
    /// The place of the cell's point from its corner.
    type Corner = [f64; 2];
    /// The points of 5 x 5 cells, from the corner of the middle one. Others are too far away to
    /// be among the nearest two.
    type Cell = [[f64; 2]; 25];
    const CORNERS: [i64; 2] = [-2, 2];

    #[inline]
    fn corner(&self, column: i64, row: i64) -> [f64; 2] {
        let bits = self.cells.bits(column, row);
        [unit(bits as u32), unit((bits >> 32) as u32)]
    }

    #[inline]
    fn cell(&self, corner: impl Fn(i64, i64) -> [f64; 2]) -> Self::Cell {
        std::array::from_fn(|number| {
            let [east, north] = [number as i64 % 5 - 2, number as i64 / 5 - 2];
            let [x, y] = corner(east, north);
            [east as f64 + x, north as f64 + y]
        })
    }

    #[inline]
    fn value(&self, points: &Self::Cell, [x, y]: [f64; 2]) -> f64 {
        let [mut nearest, mut second] = [f64::INFINITY; 2];
        for point in points {
            let [east, north] = [point[0] - x, point[1] - y];
            let squared = east * east + north * north;
            second = lesser(second, if nearest > squared { nearest } else { squared });
            nearest = lesser(nearest, squared);
        }
        let (distance, farthest) = match self.feature {
            CellularFeature::Nearest => (nearest.sqrt(), FARTHEST_NEAREST),
            CellularFeature::Second => (second.sqrt(), FARTHEST_SECOND),
            CellularFeature::Difference => (second.sqrt() - nearest.sqrt(), FARTHEST_SECOND),
        };
        2.0 * distance / farthest.sqrt() - 1.0
    }
}

/// `f64::min` of numbers, which is an instruction; with what is no number in mind it is several.
#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
