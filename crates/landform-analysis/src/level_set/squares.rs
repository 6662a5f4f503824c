//! Marching squares: the pieces of the level sets in every square of four nodes.

use super::LevelSetEdge;

/// A raster whose squares are marched over. A frame of squares around it is marched over too,
/// so that lines can go on along the border.
pub(super) struct Squares<'a> {
    pub heights: &'a [f64],
    pub size: [usize; 2],
    pub level: f64,
    pub edge: LevelSetEdge,
}

/// Corner of a square from its north-western node, in the order of its bits in a case.
const CORNERS: [[usize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// Sides of a square, with the clock.
const NORTH: usize = 0;
const EAST: usize = 1;
const SOUTH: usize = 2;
const WEST: usize = 3;

impl Squares<'_> {
    /// Pieces from crossing to crossing, land to the left. A crossing is the number of an edge
    /// between nodes of the framed raster.
    pub fn pieces(&self) -> Vec<[u64; 2]> {
        let mut pieces = Vec::new();
        for row in 0..=self.size[1] {
            for column in 0..=self.size[0] {
                self.march([column, row], &mut pieces);
            }
        }
        pieces
    }

    /// Where an edge is crossed, in nodes from the north-western one of the raster.
    pub fn place(&self, crossing: u64) -> [f64; 2] {
        let framed = self.size[0] as u64 + 2;
        let (node, axis) = (crossing / 2, (crossing % 2) as usize);
        let from = [(node % framed) as usize, (node / framed) as usize];
        let mut to = from;
        to[axis] += 1;
        let share = match [self.height(from), self.height(to)] {
            [Some(a), Some(b)] => ((self.level - a) / (b - a)).clamp(0.0, 1.0),
            // Nothing is known beyond the last node, so the line passes through it.
            [Some(_), None] => 0.0,
            _ => 1.0,
        };
        let mut place = from.map(|index| index as f64 - 1.0);
        place[axis] += share;
        place
    }

    /// Height at a place of the framed raster; `None` beyond the raster and where it is missing.
    fn height(&self, [column, row]: [usize; 2]) -> Option<f64> {
        let inside = (1..=self.size[0]).contains(&column) && (1..=self.size[1]).contains(&row);
        let height = || self.heights[column - 1 + self.size[0] * (row - 1)];
        inside.then(height).filter(|height| height.is_finite())
    }

    fn march(&self, corner: [usize; 2], pieces: &mut Vec<[u64; 2]>) {
        let heights = CORNERS.map(|[x, y]| self.height([corner[0] + x, corner[1] + y]));
        if self.edge == LevelSetEdge::End && heights.contains(&None) {
            return;
        }
        let land = heights.map(|height| height.is_some_and(|height| height >= self.level));
        let framed = self.size[0] as u64 + 2;
        let edge = |side: usize| {
            let [x, y] = [[0, 0], [1, 0], [0, 1], [0, 0]][side];
            let node = corner[0] as u64 + x + framed * (corner[1] as u64 + y);
            2 * node + [0, 1, 0, 1][side]
        };
        let mut add = |from: usize, to: usize| pieces.push([edge(from), edge(to)]);
        match land {
            [true, true, true, true] | [false, false, false, false] => {}
            [true, false, true, false] if self.joined(heights) => {
                add(EAST, NORTH);
                add(WEST, SOUTH);
            }
            [true, false, true, false] => {
                add(WEST, NORTH);
                add(EAST, SOUTH);
            }
            [false, true, false, true] if self.joined(heights) => {
                add(NORTH, WEST);
                add(SOUTH, EAST);
            }
            [false, true, false, true] => {
                add(NORTH, EAST);
                add(SOUTH, WEST);
            }
            _ => {
                let [from, to] = ends(land);
                add(from, to);
            }
        }
    }

    /// Whether the land on the diagonal of a saddle is joined: whether its mean lies at the level
    /// or above. A corner without data counts as the level.
    fn joined(&self, heights: [Option<f64>; 4]) -> bool {
        let sum: f64 = heights.iter().map(|height| height.unwrap_or(self.level) - self.level).sum();
        sum >= 0.0
    }
}

/// Sides where the one line of a square enters and leaves, land to its left on the map.
fn ends(land: [bool; 4]) -> [usize; 2] {
    // Going round with the clock from the north-western corner, side k lies between corners k
    // and k + 1; the line enters where sea gives way to land and leaves where land does.
    let mut ends = [NORTH; 2];
    for side in [NORTH, EAST, SOUTH, WEST] {
        match [land[side], land[(side + 1) % 4]] {
            [true, false] => ends[1] = side,
            [false, true] => ends[0] = side,
            _ => {}
        }
    }
    ends
}
