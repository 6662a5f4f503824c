//! The function as it is defined, at one point: the tree is grown around it and thrown away.

use super::cell::{Cell, Point};
use super::growth::{Growth, REACH, Source};
use super::heights::Hillslope;
use super::piece::{Piece, nearest};

/// Cells around one, to either side, whose branches decide about the tree near it: two for what is
/// nearest, and two more so that these know what is nearest to them. At every level the same
/// number is enough, since half of it is left of the cells of the level before.
const MARGIN: i64 = 2 * REACH;

/// The tree around a cell of the finest level.
struct Around {
    cell: Cell,
    /// Pieces of the branch of each cell, row by row, of each level.
    branches: Vec<Vec<Vec<Piece>>>,
}

impl Around {
    fn new(growth: &Growth, cell: Cell) -> Self {
        let mut tree = Self { cell, branches: Vec::new() };
        for level in 0..growth.levels {
            let cells = cell.ancestor(level).around(MARGIN);
            tree.branches.push(cells.map(|cell| tree.branch(growth, cell)).collect());
        }
        tree
    }

    /// The branch of a cell, from those of the coarser levels.
    fn branch(&self, growth: &Growth, cell: Cell) -> Vec<Piece> {
        if cell.level == 0 {
            return growth.trunk(cell, |cell| growth.source(cell));
        }
        let key = growth.keys.of(cell);
        let coarser = self.near(cell.ancestor(cell.level - 1));
        let Some((_, piece, share)) = nearest(coarser, key.point).filter(|_| key.new) else {
            return Vec::new();
        };
        let control = growth.control(&[key.point])[0];
        growth.tributary(cell, key.point, control, &piece.joint(share))
    }

    /// All pieces that can be nearest to what lies in a cell, of its level and those before it.
    fn near(&self, cell: Cell) -> impl Iterator<Item = &Piece> {
        (0..=cell.level).flat_map(move |level| {
            cell.ancestor(level).around(REACH).flat_map(|cell| self.pieces(cell))
        })
    }

    fn pieces(&self, cell: Cell) -> &[Piece] {
        let middle = self.cell.ancestor(cell.level).at;
        let [column, row] = [0, 1].map(|axis| (cell.at[axis] - middle[axis] + MARGIN) as usize);
        &self.branches[cell.level as usize][row * (2 * MARGIN + 1) as usize + column]
    }
}

impl Growth {
    /// The key point of a cell of level 0.
    pub fn source(&self, cell: Cell) -> Source {
        let (point, tie) = self.keys.first(cell);
        Source { point, control: self.control(&[point])[0], tie }
    }

    /// Distance to the tree in cells of level 0, and the height of the tree there.
    pub fn nearest_by_definition(&self, point: Point) -> (f64, f64) {
        let cell = Cell::holding(self.levels - 1, point);
        let tree = Around::new(self, cell);
        match nearest(tree.near(cell), point) {
            Some((squared, piece, share)) => (squared.sqrt(), piece.height_at(share)),
            None => (0.0, 0.0),
        }
    }

    /// Height of the terrain in metres.
    pub fn height_by_definition(&self, hillslope: &Hillslope, point: Point) -> f64 {
        let level = Hillslope::level(self.levels);
        let primitives = Cell::holding(level, point).around(REACH).map(|cell| {
            let key = self.keys.of(cell).point;
            let (distance, height) = self.nearest_by_definition(key);
            (key, hillslope.height(distance * self.cell_m, height))
        });
        let [mut heights, mut weights] = [0.0; 2];
        for (key, height) in primitives {
            let weight = Hillslope::weight(level, point, key);
            heights += weight * height;
            weights += weight;
        }
        heights / weights
    }
}
