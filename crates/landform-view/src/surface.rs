//! The surface that is drawn: a height field resampled with smooth slopes.

use rayon::prelude::*;

use crate::smoothing::smooth;
use crate::{HeightField, ViewError};

/// Greatest ratio of the relief to the field's longer side. Beyond it rays lose their precision,
/// and a picture could show nothing but a line.
const STEEPEST: f64 = 1e4;

/// A fine grid of heights between which pictures interpolate.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    /// Number of columns.
    pub(crate) columns: usize,
    /// Number of rows.
    pub(crate) rows: usize,
    /// Distance between nodes, in metres.
    pub(crate) spacing: f64,
    /// Whether the surface continues at its other side.
    pub(crate) periodic: bool,
    /// Heights in metres above `datum`, exaggerated.
    pub(crate) heights: Vec<f32>,
    /// The height, in metres, that heights are counted from: that of the lowest node, but for water.
    pub(crate) datum: f64,
    /// Vertical exaggeration.
    pub(crate) exaggeration: f64,
    /// Height of the highest node of the surface, in exaggerated metres above `datum`.
    pub(crate) highest: f32,
}

/// Where the nodes of a surface lie on the field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampling {
    /// Number of columns and rows of the surface.
    pub(crate) size: [usize; 2],
    /// Column and row of the field at the first node of the surface.
    pub(crate) origin: f64,
    /// Nodes of the field per node of the surface.
    pub(crate) step: f64,
    /// Whether field and surface continue at their other side.
    pub(crate) periodic: bool,
    /// Standard deviation of the Gaussian that smooths the field first, in nodes of the field.
    pub(crate) smoothing: f64,
    /// Vertical exaggeration.
    pub(crate) exaggeration: f64,
}

impl Surface {
    /// Resamples a field with Catmull-Rom splines (Catmull and Rom 1974), which pass through
    /// every height and have continuous slopes. Beyond an open edge the field goes on straight.
    /// Where the surface is the coarser one, heights are averaged over its cells first.
    pub(crate) fn sample(field: &HeightField<'_>, sampling: Sampling) -> Result<Self, ViewError> {
        Self::sample_above(field, field.range()[0], sampling)
    }

    /// The same with heights above a datum of its own, below which they may lie.
    pub(crate) fn sample_above(
        field: &HeightField<'_>,
        datum: f64,
        sampling: Sampling,
    ) -> Result<Self, ViewError> {
        let [columns, rows] = sampling.size;
        ViewError::check_size("the resampled surface", sampling.size, 2)?;
        let top = field.range()[1];
        check_relief(field, top - datum, sampling.exaggeration)?;
        let block = (sampling.step.floor() as usize).max(1);
        let nodes = [field.width(), field.height()];
        let coarse = Nodes::average(field, datum, &sampling, block);
        let stops = |count: usize, nodes: usize| -> Vec<Stop> {
            (0..count).map(|index| Stop::new(&sampling, index, block, nodes)).collect()
        };
        let across = stops(columns, nodes[0].div_ceil(block));
        let down = stops(rows, nodes[1].div_ceil(block));
        let mut heights = vec![0.0; columns * rows];
        heights.par_chunks_mut(columns).zip(&down).for_each(|(line, row)| {
            for (height, column) in line.iter_mut().zip(&across) {
                *height = coarse.spline(column, row);
            }
        });
        let highest = heights.iter().copied().fold(0.0, f32::max);
        let spacing = field.spacing_m() * sampling.step;
        let Sampling { periodic, exaggeration, .. } = sampling;
        Ok(Self { columns, rows, spacing, periodic, heights, datum, exaggeration, highest })
    }

    /// Height at a node; beyond an edge that of the edge, or of the other side when periodic.
    #[inline]
    pub(crate) fn at(&self, column: isize, row: isize) -> f32 {
        let column = bound(column, self.columns, self.periodic);
        let row = bound(row, self.rows, self.periodic);
        self.heights[column + self.columns * row]
    }

    /// Heights of the corners of the cell south-east of a node: north-west, north-east,
    /// south-west, south-east.
    #[inline]
    pub(crate) fn corners(&self, column: isize, row: isize) -> [f32; 4] {
        let inside = column >= 0
            && row >= 0
            && (column as usize) + 1 < self.columns
            && (row as usize) + 1 < self.rows;
        if inside {
            let node = column as usize + self.columns * row as usize;
            let south = node + self.columns;
            let heights = &self.heights;
            return [heights[node], heights[node + 1], heights[south], heights[south + 1]];
        }
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(east, south)| self.at(column + east, row + south))
    }

    /// Slope at a node towards the east and the north by central differences; one-sided at
    /// open edges.
    pub(crate) fn slope(&self, column: usize, row: usize) -> [f32; 2] {
        let along = |size: usize, index: usize| -> (isize, isize) {
            match self.periodic {
                true => (index as isize - 1, index as isize + 1),
                false => (index.saturating_sub(1) as isize, (index + 1).min(size - 1) as isize),
            }
        };
        let (west, east) = along(self.columns, column);
        let (north, south) = along(self.rows, row);
        let spacing = self.spacing as f32;
        let rise = self.at(east, row as isize) - self.at(west, row as isize);
        let climb = self.at(column as isize, north) - self.at(column as isize, south);
        [rise / ((east - west) as f32 * spacing), climb / ((south - north) as f32 * spacing)]
    }

    /// Height in metres, without exaggeration, of a height of this surface.
    pub(crate) fn metres(&self, height: f32) -> f64 {
        self.datum + f64::from(height) / self.exaggeration
    }

    /// Height of this surface of a height in metres.
    pub(crate) fn raised(&self, metres: f64) -> f32 {
        ((metres - self.datum) * self.exaggeration) as f32
    }
}

/// Refuses a height above or below the datum, in metres, that is absurd for the width of its
/// field.
pub(crate) fn check_relief(
    field: &HeightField<'_>,
    relief_m: f64,
    exaggeration: f64,
) -> Result<(), ViewError> {
    let side = field.width().max(field.height()) as f64 * field.spacing_m();
    if relief_m.abs() * exaggeration <= STEEPEST * side {
        return Ok(());
    }
    Err(ViewError::Option {
        name: "vertical_exaggeration",
        value: exaggeration,
        expected: "so small that relief, water and block are at most 10000 times as high as the \
                   field is long; check the spacing of the field too",
    })
}

/// Index of a node, kept in the grid by clamping or by wrapping.
#[inline]
pub(crate) fn bound(index: isize, size: usize, periodic: bool) -> usize {
    match periodic {
        true => index.rem_euclid(size as isize) as usize,
        false => index.clamp(0, size as isize - 1) as usize,
    }
}

/// Heights that are interpolated: those of the field, or means over blocks of them.
struct Nodes {
    columns: usize,
    heights: Vec<f32>,
}

impl Nodes {
    /// Means over blocks of `block` by `block` nodes, exaggerated and smoothed; a block of 1
    /// takes every height as it is.
    fn average(field: &HeightField<'_>, datum: f64, sampling: &Sampling, block: usize) -> Self {
        let (width, height) = (field.width(), field.height());
        let [columns, rows] = [width, height].map(|size| size.div_ceil(block));
        let mean = |column: usize, row: usize| -> f32 {
            let across = column * block..((column + 1) * block).min(width);
            let down = row * block..((row + 1) * block).min(height);
            let count = (across.len() * down.len()) as f64;
            let lines = down.map(|line| &field.heights()[line * width..][across.clone()]);
            let sum: f64 = lines.flatten().map(|height| height - datum).sum();
            (sampling.exaggeration * sum / count) as f32
        };
        let mut heights = vec![0.0; columns * rows];
        heights.par_chunks_mut(columns).enumerate().for_each(|(row, line)| {
            line.iter_mut().enumerate().for_each(|(column, height)| *height = mean(column, row));
        });
        smooth(&mut heights, columns, sampling.smoothing / block as f64, sampling.periodic);
        Self { columns, heights }
    }

    /// Height between the nodes around a column and a row.
    fn spline(&self, column: &Stop, row: &Stop) -> f32 {
        let mut sum = 0.0;
        for (&line, &share) in row.nodes.iter().zip(&row.weights) {
            let heights = &self.heights[line * self.columns..][..self.columns];
            let nodes = column.nodes.iter().zip(&column.weights);
            sum += share * nodes.map(|(&node, weight)| heights[node] * weight).sum::<f32>();
        }
        sum
    }
}

/// The four nodes beside a place on an axis and their weights.
struct Stop {
    nodes: [usize; 4],
    weights: [f32; 4],
}

impl Stop {
    /// The place of a surface node on an axis of `nodes` blocks of `block` nodes.
    fn new(sampling: &Sampling, index: usize, block: usize, nodes: usize) -> Self {
        let place = sampling.origin + sampling.step * index as f64;
        let centre = (block as f64 - 1.0) / 2.0;
        let place = (place - centre) / block as f64;
        if sampling.periodic {
            let first = place.floor();
            let weights = catmull_rom((place - first) as f32);
            return Self::around(first as isize, weights, nodes, true);
        }
        let last = (nodes - 1) as f64;
        let inside = place.clamp(0.0, last);
        let first = inside.floor().min(last - 1.0).max(0.0);
        let mut weights = catmull_rom((inside - first) as f32);
        extend_straight(&mut weights, first as usize, nodes);
        // Beyond the first and the last node the slope between the outermost two goes on.
        weights[1] -= (place - inside) as f32;
        weights[2] += (place - inside) as f32;
        Self::around(first as isize, weights, nodes, false)
    }

    fn around(first: isize, weights: [f32; 4], nodes: usize, periodic: bool) -> Self {
        let node = |offset| bound(first + offset, nodes, periodic);
        Self { nodes: [node(-1), node(0), node(1), node(2)], weights }
    }
}

/// Weights of four nodes for a place at `share` between the second and the third.
fn catmull_rom(share: f32) -> [f32; 4] {
    let (t, t2, t3) = (share, share * share, share * share * share);
    [
        0.5 * (2.0 * t2 - t - t3),
        0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
        0.5 * (4.0 * t2 - 3.0 * t3 + t),
        0.5 * (t3 - t2),
    ]
}

/// Replaces a missing outer node by the straight continuation of the two beside it.
fn extend_straight(weights: &mut [f32; 4], first: usize, nodes: usize) {
    if first == 0 {
        weights[1] += 2.0 * weights[0];
        weights[2] -= weights[0];
        weights[0] = 0.0;
    }
    if first + 2 >= nodes {
        weights[2] += 2.0 * weights[3];
        weights[1] -= weights[3];
        weights[3] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(heights: &[f64], width: usize, sampling: Sampling) -> Surface {
        let height = heights.len() / width;
        let field = HeightField::new(width, height, 1.0, heights).unwrap();
        Surface::sample(&field, sampling).unwrap()
    }

    fn sampling(size: [usize; 2], origin: f64, step: f64) -> Sampling {
        Sampling { size, origin, step, periodic: false, smoothing: 0.0, exaggeration: 2.0 }
    }

    /// Inside, between, beyond and coarser than the nodes a plane stays a plane.
    #[test]
    fn a_plane_stays_a_plane() {
        let plane = |x: f64, y: f64| 5.0 + 0.5 * x - 0.25 * y;
        let heights: Vec<f64> =
            (0..24 * 16).map(|i| plane((i % 24) as f64, (i / 24) as f64)).collect();
        for (size, origin, step) in
            [([96, 64], -0.375, 0.25), ([24, 16], 0.0, 1.0), ([8, 5], 1.0, 3.0)]
        {
            let surface = sampled(&heights, 24, sampling(size, origin, step));
            for (node, &height) in surface.heights.iter().enumerate() {
                let place = |index: usize| origin + step * index as f64;
                let expected = plane(place(node % size[0]), place(node / size[0]));
                let metres = surface.metres(height);
                assert!((metres - expected).abs() < 1e-4, "{metres} instead of {expected}");
            }
            let [east, north] = surface.slope(0, size[1] - 1);
            assert!((east - 1.0).abs() < 1e-4 && (north - 0.5).abs() < 1e-4, "{east} {north}");
        }
    }

    #[test]
    fn the_nodes_keep_their_heights() {
        let heights: Vec<f64> = (0..35).map(|i| f64::from(i * i % 11)).collect();
        let surface = sampled(&heights, 7, sampling([13, 9], 0.0, 0.5));
        for (node, &height) in heights.iter().enumerate() {
            let fine = 2 * (node % 7) + 13 * 2 * (node / 7);
            assert_eq!(surface.metres(surface.heights[fine]), height);
        }
    }

    #[test]
    fn heights_and_metres_are_inverse() {
        let surface = sampled(&[3.0, 4.0, 5.0, 9.0], 2, sampling([2, 2], 0.0, 1.0));
        assert_eq!((surface.datum, surface.highest), (3.0, 12.0));
        assert_eq!(surface.metres(surface.raised(4.5)), 4.5);
    }
}
