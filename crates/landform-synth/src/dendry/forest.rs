//! The tree over many cells, grown level by level and kept.

use rayon::prelude::*;

use super::cell::{Cell, Key, Point};
use super::growth::{Growth, REACH, Source};
use super::piece::{Piece, nearest};
use super::window::Window;

/// The tree near the cells of a window of the finest level.
#[derive(Debug)]
pub(super) struct Forest {
    /// All pieces: by level, by row, by column, from the upper to the lower end.
    pieces: Vec<Piece>,
    /// The pieces that can be nearest to what lies in a cell of the finest level, in this order.
    near: Vec<Vec<u32>>,
    /// Key points of these cells.
    keys: Vec<Point>,
    window: Window,
}

/// What the cells of one level have.
struct Layer {
    /// Cells with key points and branches.
    window: Window,
    keys: Vec<Key>,
    /// Where in the list of all pieces the branch of a cell starts, and where the last one ends.
    starts: Vec<u32>,
    /// Cells with lists of near pieces, and the lists.
    inner: Window,
    near: Vec<Vec<u32>>,
}

impl Forest {
    /// Grows the tree that is near the cells of `window`, which are of the finest level.
    pub fn grow(growth: &Growth, window: Window) -> Self {
        // Every level needs margins, and the cells that the next one's are parts of.
        let mut inner = vec![window];
        while let Some(finer) = inner.last().filter(|window| window.level > 0) {
            inner.push(finer.grown(REACH).parents());
        }
        let mut pieces = Vec::new();
        let mut layer = trunks(growth, inner[inner.len() - 1], &mut pieces);
        for window in inner.into_iter().rev().skip(1) {
            layer = tributaries(growth, window, &layer, &mut pieces);
        }
        let keys = window.cells().map(|cell| layer.keys[layer.window.index(cell)].point).collect();
        Self { pieces, near: layer.near, keys, window }
    }

    /// The pieces that can be nearest to what lies in a cell of the window.
    pub fn near(&self, cell: Cell) -> impl Iterator<Item = &Piece> + Clone {
        self.near[self.window.index(cell)].iter().map(|&id| &self.pieces[id as usize])
    }

    /// The key point of a cell of the window.
    pub fn key(&self, cell: Cell) -> Point {
        self.keys[self.window.index(cell)]
    }
}

/// Level 0.
fn trunks(growth: &Growth, inner: Window, pieces: &mut Vec<Piece>) -> Layer {
    let window = inner.grown(REACH);
    let known = window.grown(2);
    let keys: Vec<(Point, u32)> = known.cells().map(|cell| growth.keys.first(cell)).collect();
    let points: Vec<Point> = keys.iter().map(|key| key.0).collect();
    let sources: Vec<Source> = keys
        .iter()
        .zip(growth.control(&points))
        .map(|(&(point, tie), control)| Source { point, control, tie })
        .collect();
    let trunk = |cell: Cell| growth.trunk(cell, |cell| sources[known.index(cell)]);
    let branches = window.collect(trunk);
    let key = |cell: Cell| Key { point: sources[known.index(cell)].point, new: true };
    let keys = window.cells().map(key).collect();
    Layer::new(window, keys, branches, inner, None, pieces)
}

/// A finer level, from the one before it.
fn tributaries(growth: &Growth, inner: Window, above: &Layer, pieces: &mut Vec<Piece>) -> Layer {
    let window = inner.grown(REACH);
    let of_parent =
        |cell: Cell| above.keys[above.window.index(cell.ancestor(cell.level - 1))].point;
    let keys = window.collect(|cell| growth.keys.below(cell, of_parent(cell)));
    let points: Vec<Point> = keys.iter().map(|key| key.point).collect();
    let controls = match growth.least_slope {
        Some(_) => points.par_chunks(1024).flat_map_iter(|points| growth.control(points)).collect(),
        None => vec![0.0; points.len()],
    };
    let branch = |cell: Cell| {
        let index = window.index(cell);
        let near = &above.near[above.inner.index(cell.ancestor(cell.level - 1))];
        let near = near.iter().map(|&id| &pieces[id as usize]);
        let found = nearest(near, keys[index].point).filter(|_| keys[index].new);
        found.map_or(Vec::new(), |(_, piece, share)| {
            growth.tributary(cell, keys[index].point, controls[index], &piece.joint(share))
        })
    };
    let branches = window.collect(branch);
    Layer::new(window, keys, branches, inner, Some(above), pieces)
}

impl Layer {
    /// Adds the branches to all pieces, and finds out what is near.
    fn new(
        window: Window,
        keys: Vec<Key>,
        branches: Vec<Vec<Piece>>,
        inner: Window,
        above: Option<&Self>,
        pieces: &mut Vec<Piece>,
    ) -> Self {
        let mut starts = vec![pieces.len() as u32];
        for branch in branches {
            pieces.extend(branch);
            starts.push(pieces.len() as u32);
        }
        let mut layer = Self { window, keys, starts, inner, near: Vec::new() };
        layer.near = inner.collect(|cell| layer.near(cell, above, pieces));
        layer
    }

    /// The pieces that can be nearest to some point of a cell: no other is that near its middle.
    fn near(&self, cell: Cell, above: Option<&Self>, pieces: &[Piece]) -> Vec<u32> {
        let coarser =
            above.map(|above| &above.near[above.inner.index(cell.ancestor(cell.level - 1))]);
        let coarser = coarser.into_iter().flatten().copied();
        let own = cell.around(REACH).flat_map(|cell| {
            let index = self.window.index(cell);
            self.starts[index]..self.starts[index + 1]
        });
        let middle = cell.place([0.5; 2]);
        let squared = |id: u32| (id, pieces[id as usize].nearest(middle).0);
        let mut candidates: Vec<(u32, f64)> = coarser.chain(own).map(squared).collect();
        let least = candidates.iter().map(|candidate| candidate.1).fold(f64::INFINITY, f64::min);
        // From the middle to a corner and back, and something for rounding.
        let farthest = (least.sqrt() + 2.0_f64.sqrt() * cell.width()) * (1.0 + 1e-9);
        candidates.retain(|candidate| candidate.1 <= farthest * farthest);
        candidates.into_iter().map(|candidate| candidate.0).collect()
    }
}
