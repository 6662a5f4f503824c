//! The function at all nodes of a grid: the tree is grown once for many of them.

use std::ops::Range;

use rayon::prelude::*;

use super::cell::{Cell, Point};
use super::forest::Forest;
use super::growth::{Growth, REACH};
use super::heights::Hillslope;
use super::piece::{Piece, nearest};
use super::window::Window;

/// Most cells of the finest level, along either axis, that a tree is grown for at a time.
const MOST_CELLS: usize = 64;

/// Places of the columns and rows of a grid, in cells of level 0. Columns go east.
pub(super) struct Grid {
    pub columns: Vec<f64>,
    pub rows: Vec<f64>,
}

/// Neighbouring columns or rows that lie in one column or row of cells.
struct Run {
    cell: i64,
    nodes: Range<usize>,
}

/// Divides columns or rows by the cells of a level.
fn runs(places: &[f64], level: u32) -> Vec<Run> {
    let scale = f64::from(1_u32 << level);
    let mut runs: Vec<Run> = Vec::new();
    for (node, place) in places.iter().enumerate() {
        let cell = (place * scale).floor() as i64;
        match runs.last_mut().filter(|run| run.cell == cell) {
            Some(run) => run.nodes.end = node + 1,
            None => runs.push(Run { cell, nodes: node..node + 1 }),
        }
    }
    runs
}

/// The cells of some runs.
fn window(level: u32, columns: &[Run], rows: &[Run]) -> Window {
    let ends = |runs: &[Run]| {
        let cells = || runs.iter().map(|run| run.cell);
        [cells().min().unwrap_or(0), cells().max().unwrap_or(0)]
    };
    let [[west, east], [south, north]] = [ends(columns), ends(rows)];
    Window { level, low: [west, south], high: [east, north] }
}

/// Fills a field, in rows: with the height of the terrain where there are hillslopes, else with
/// the distance to the tree, in metres.
pub(super) fn fill(growth: &Growth, hillslope: Option<&Hillslope>, grid: &Grid) -> Vec<f64> {
    let width = grid.columns.len();
    let mut field = vec![0.0; width * grid.rows.len()];
    let level = growth.levels - 1;
    let [columns, rows] = [&grid.columns, &grid.rows].map(|places| runs(places, level));
    for rows in rows.chunks(MOST_CELLS) {
        let [first, last] = [rows[0].nodes.start, rows[rows.len() - 1].nodes.end];
        for columns in columns.chunks(MOST_CELLS) {
            let window = window(level, columns, rows);
            let mut rest = &mut field[first * width..last * width];
            let mut bands = Vec::new();
            for run in rows {
                let (band, after) = rest.split_at_mut(run.nodes.len() * width);
                bands.push((run, band));
                rest = after;
            }
            match hillslope {
                Some(hillslope) => {
                    let ground = Ground::new(growth, hillslope, window);
                    let nodes = columns[0].nodes.start..columns[columns.len() - 1].nodes.end;
                    bands.into_par_iter().for_each(|(run, band)| {
                        ground.heights(grid, &run.nodes, &nodes, band);
                    });
                }
                None => {
                    let forest = Forest::grow(growth, window);
                    bands.into_par_iter().for_each(|(run, band)| {
                        distances(&forest, growth, grid, run, columns, band);
                    });
                }
            }
        }
    }
    field
}

/// Distances to the tree in a row of cells; `band` holds its rows of nodes.
fn distances(
    forest: &Forest,
    growth: &Growth,
    grid: &Grid,
    rows: &Run,
    columns: &[Run],
    band: &mut [f64],
) {
    for run in columns {
        let cell = Cell { level: growth.levels - 1, at: [run.cell, rows.cell] };
        let pieces: Vec<Piece> = forest.near(cell).copied().collect();
        let xs = &grid.columns[run.nodes.clone()];
        let lines = band.chunks_exact_mut(grid.columns.len());
        for (line, &y) in lines.zip(&grid.rows[rows.nodes.clone()]) {
            let best = &mut line[run.nodes.clone()];
            best.fill(f64::INFINITY);
            for piece in &pieces {
                for (best, &x) in best.iter_mut().zip(xs) {
                    let squared = piece.nearest([x, y]).0;
                    *best = if squared < *best { squared } else { *best };
                }
            }
            best.iter_mut().for_each(|squared| *squared = squared.sqrt() * growth.cell_m);
        }
    }
}

/// Key points with heights near the cells of a window.
struct Ground {
    /// Place and height in metres of each.
    primitives: Vec<(Point, f64)>,
    window: Window,
}

impl Ground {
    fn new(growth: &Growth, hillslope: &Hillslope, finest: Window) -> Self {
        // Two cells of the primitives are less than one of the finest level.
        let forest = Forest::grow(growth, finest.grown(1));
        let level = Hillslope::level(growth.levels);
        let parts = 1_i64 << (level - finest.level);
        let window = Window {
            level,
            low: finest.low.map(|index| index * parts),
            high: finest.high.map(|index| index * parts + parts - 1),
        };
        let window = window.grown(REACH);
        let primitives = window.collect(|cell| {
            let above = cell.ancestor(finest.level);
            let key = (finest.level + 1..=level).fold(forest.key(above), |key, level| {
                growth.keys.below(cell.ancestor(level), key).point
            });
            let near = nearest(forest.near(above), key);
            let (squared, height) = near
                .map_or((0.0, 0.0), |(squared, piece, share)| (squared, piece.height_at(share)));
            (key, hillslope.height(squared.sqrt() * growth.cell_m, height))
        });
        Self { primitives, window }
    }

    /// Heights at some rows and columns of nodes (equation 5 of the paper); `band` holds the rows.
    fn heights(&self, grid: &Grid, rows: &Range<usize>, columns: &Range<usize>, band: &mut [f64]) {
        let level = self.window.level;
        let runs = runs(&grid.columns[columns.clone()], level);
        let mut weights = vec![0.0; columns.len()];
        for (line, &y) in band.chunks_exact_mut(grid.columns.len()).zip(&grid.rows[rows.clone()]) {
            let line = &mut line[columns.clone()];
            let xs = &grid.columns[columns.clone()];
            let [.., row] = Cell::holding(level, [xs[0], y]).at;
            for run in &runs {
                let cell = Cell { level, at: [run.cell, row] };
                let nodes = run.nodes.clone();
                let [heights, weights] =
                    [&mut *line, &mut weights[..]].map(|all| &mut all[nodes.clone()]);
                self.blend(cell, &xs[nodes], y, heights, weights);
            }
        }
    }

    /// Heights at places of a row within a cell.
    fn blend(&self, cell: Cell, xs: &[f64], y: f64, heights: &mut [f64], weights: &mut [f64]) {
        heights.fill(0.0);
        weights.fill(0.0);
        for cell in cell.around(REACH) {
            let (key, height) = self.primitives[self.window.index(cell)];
            for ((sum, total), &x) in heights.iter_mut().zip(weights.iter_mut()).zip(xs) {
                let weight = Hillslope::weight(cell.level, [x, y], key);
                *sum += weight * height;
                *total += weight;
            }
        }
        heights.iter_mut().zip(weights).for_each(|(sum, total)| *sum /= *total);
    }
}
