//! Sums of surface heights over the cone upwind of every node, kept up to date.
//!
//! The sum at a node is the state of protection that the thesis' agents maintain (section
//! 4.1.2): erosion at a node lowers it, deposition raises it, everywhere in the cone downwind.
//! Heights count in whole quanta of 1/4096 of the spacing, so sums are integers: the same after
//! any order of events, on any number of threads, and equal to sums taken afresh, bit for bit.
//!
//! Three ways lead to the same sums. [`ConeSums::set_height`] is one event: it visits the cone
//! of one node, as the agents of the thesis do by breadth-first search. [`ConeSums::update`]
//! takes a whole surface and does so for each node that changed, if those are few. If they are
//! many it takes all sums afresh: a cone is a few spans of rows, and a span is a difference of
//! two running sums along its row, so a node costs two reads a row of the cone.

use landform_graph::Lattice;
use rayon::prelude::*;

use super::cone::{Cone, Span};
use super::plane::Plane;

/// Quanta of height in one node spacing.
const QUANTA: f64 = 4096.0;

/// Cone sums of the surface of a lattice.
#[derive(Clone, Debug)]
pub(super) struct ConeSums {
    cone: Cone,
    plane: Plane,
    /// Quanta in a metre.
    scale: f64,
    /// Greatest height, in quanta, that cannot overflow a sum.
    limit: f64,
    /// Height of each node in quanta.
    heights: Vec<i32>,
    /// Sum of the heights over the cone upwind of each node.
    sums: Vec<i32>,
    /// Sum of all heights.
    total: i64,
    /// Nodes that the cone upwind of each node holds, if open borders cut some cones.
    counts: Option<Vec<i32>>,
    scratch: Scratch,
}

/// Buffers of [`ConeSums::update`].
#[derive(Clone, Debug, Default)]
struct Scratch {
    /// Heights of the new surface.
    fresh: Vec<i32>,
    /// Running sums of each row, with margins.
    running: Vec<i32>,
}

impl ConeSums {
    /// Sums over a flat surface of height zero.
    pub fn new(lattice: &Lattice, cone: Cone) -> Self {
        let count = lattice.node_count();
        let mut sums = Self {
            plane: Plane::new(lattice),
            scale: QUANTA / lattice.spacing(),
            limit: f64::from(i32::MAX) / cone.nodes.max(1) as f64,
            cone,
            heights: vec![0; count],
            sums: vec![0; count],
            total: 0,
            counts: None,
            scratch: Scratch::default(),
        };
        if !(lattice.is_periodic(0) && lattice.is_periodic(1)) {
            // A cone holds as many nodes as it sums up to where every height is one.
            sums.heights.fill(1);
            sums.sum_afresh();
            sums.heights.fill(0);
            sums.counts = Some(std::mem::replace(&mut sums.sums, vec![0; count]));
        }
        sums
    }

    /// A height in quanta. Heights beyond the range of a sum count as the end of the range,
    /// heights that are not numbers as zero.
    #[inline]
    fn quanta(&self, height_m: f64) -> i32 {
        // Adding this number leaves a double no room for fractions: it rounds, and the low
        // half of its bits is the integer. `f64::round` would be a slow call here.
        const ROUNDING: f64 = 6_755_399_441_055_744.0;
        let height = height_m * self.scale;
        let height = if height < self.limit { height } else { self.limit };
        let height = if height > -self.limit { height } else { -self.limit };
        let height = if height_m.is_nan() { 0.0 } else { height };
        (height + ROUNDING).to_bits() as i32
    }

    /// Raises or lowers one node: erosion or deposition. Cost: the nodes of a cone.
    pub fn set_height(&mut self, node: usize, height_m: f64) {
        self.set_quanta(node, self.quanta(height_m));
    }

    fn set_quanta(&mut self, node: usize, quanta: i32) {
        let change = quanta - self.heights[node];
        self.heights[node] = quanta;
        self.total += i64::from(change);
        let Plane { width, .. } = self.plane;
        let [column, row] = [node % width, node / width];
        for &Span { row: rows, first, last } in &self.cone.spans {
            let Some(row) = self.plane.row(row, rows) else { continue };
            for step in first..=last {
                if let Some(column) = self.plane.column(column, step) {
                    self.sums[row * width + column] += change;
                }
            }
        }
    }

    /// Brings the sums up to date with a surface (metres, one value a node).
    pub fn update(&mut self, surface: &[f64]) {
        let mut fresh = std::mem::take(&mut self.scratch.fresh);
        fresh.resize(surface.len(), 0);
        let (changed, total) = self.quantise(surface, &mut fresh);
        // Visiting the cones of the changed nodes must cost less than two passes over all.
        if changed * self.cone.nodes < 2 * surface.len() {
            for (node, &quanta) in fresh.iter().enumerate() {
                if quanta != self.heights[node] {
                    self.set_quanta(node, quanta);
                }
            }
        } else {
            std::mem::swap(&mut self.heights, &mut fresh);
            self.total = total;
            self.sum_afresh();
        }
        self.scratch.fresh = fresh;
    }

    /// Heights of a surface in quanta, the number of nodes that changed and the sum of all.
    fn quantise(&self, surface: &[f64], fresh: &mut [i32]) -> (usize, i64) {
        const CHUNK: usize = 1 << 13;
        fresh
            .par_chunks_mut(CHUNK)
            .zip(surface.par_chunks(CHUNK))
            .zip(self.heights.par_chunks(CHUNK))
            .map(|((fresh, surface), heights)| {
                let (mut changed, mut total) = (0_u32, 0_i64);
                for ((fresh, &height_m), &height) in fresh.iter_mut().zip(surface).zip(heights) {
                    *fresh = self.quanta(height_m);
                    changed += u32::from(*fresh != height);
                    total += i64::from(*fresh);
                }
                (changed as usize, total)
            })
            .reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    }

    /// Takes all sums afresh from the heights.
    fn sum_afresh(&mut self) {
        let Plane { width, height, wraps_columns, .. } = self.plane;
        let [west, east] = self.cone.margins();
        // One place more than the row with its margins: a running sum starts from zero.
        let stride = width + west + east + 1;
        let mut running = std::mem::take(&mut self.scratch.running);
        running.resize(stride * height, 0);
        let rows = running.par_chunks_mut(stride).zip(self.heights.par_chunks(width));
        rows.for_each(|(running, heights)| accumulate(running, heights, east, wraps_columns));
        let (plane, cone) = (self.plane, &self.cone);
        self.sums.par_chunks_mut(width).enumerate().for_each(|(row, sums)| {
            sums.fill(0);
            for &Span { row: rows, first, last } in &cone.spans {
                let Some(upwind) = plane.row(row, -rows) else { continue };
                let running = &running[upwind * stride..][..stride];
                // The cone upwind of column x covers columns x - last to x - first.
                let after = &running[(east as isize - first + 1) as usize..][..width];
                let before = &running[(east as isize - last) as usize..][..width];
                for ((sum, after), before) in sums.iter_mut().zip(after).zip(before) {
                    *sum = sum.wrapping_add(after.wrapping_sub(*before));
                }
            }
        });
        self.scratch.running = running;
    }

    /// Marks the nodes where the mean height of the cone upwind is above
    /// `mean + own_weight * (own height - mean)`, with the mean height of the whole surface.
    pub fn mark(&self, own_weight: f64, sheltered: &mut [bool]) {
        const CHUNK: usize = 1 << 13;
        let mean = self.total as f64 / self.heights.len() as f64;
        // Written so that a level surface, whose mean is exact, compares as equal.
        let is_sheltered = |sum: i32, height: i32, count: f64| {
            f64::from(sum) > count * (mean + own_weight * (f64::from(height) - mean))
        };
        sheltered.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, sheltered)| {
            let nodes = chunk * CHUNK..chunk * CHUNK + sheltered.len();
            let state = self.sums[nodes.clone()].iter().zip(&self.heights[nodes.clone()]);
            match &self.counts {
                None => {
                    let count = self.cone.nodes as f64;
                    for (sheltered, (&sum, &height)) in sheltered.iter_mut().zip(state) {
                        *sheltered = is_sheltered(sum, height, count);
                    }
                }
                Some(counts) => {
                    let state = state.zip(&counts[nodes]);
                    for (sheltered, ((&sum, &height), &count)) in sheltered.iter_mut().zip(state) {
                        *sheltered = is_sheltered(sum, height, f64::from(count));
                    }
                }
            }
        });
    }

    /// The sums, in quanta.
    #[cfg(test)]
    pub fn sums(&self) -> &[i32] {
        &self.sums
    }

    /// The heights, in quanta.
    #[cfg(test)]
    pub fn heights(&self) -> &[i32] {
        &self.heights
    }
}

/// Running sums of a row of heights, with a margin of `lead` nodes before it and one behind:
/// copies of its other end if it closes on itself, else nothing. Sums that overflow wrap
/// round, and so do their differences: those are right all the same.
fn accumulate(running: &mut [i32], heights: &[i32], lead: usize, wraps: bool) {
    let width = heights.len();
    let tail = running.len() - 1 - width - lead;
    let mut sum = 0_i32;
    let mut places = running.iter_mut();
    let mut push = |heights: &[i32]| {
        for (&height, place) in heights.iter().zip(places.by_ref()) {
            *place = sum;
            sum = sum.wrapping_add(height);
        }
        sum
    };
    let nothing = vec![0; if wraps { 0 } else { lead.max(tail) }];
    let (before, after) = match wraps {
        true => (&heights[width - lead..], &heights[..tail]),
        false => (&nothing[..lead], &nothing[..tail]),
    };
    push(before);
    push(heights);
    let total = push(after);
    if let Some(last) = running.last_mut() {
        *last = total;
    }
}
