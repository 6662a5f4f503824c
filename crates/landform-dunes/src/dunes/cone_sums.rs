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
//! two running sums along its row, so a node costs two reads a row of the cone. Memory: 8
//! bytes a node, 12 with open borders.

use std::sync::atomic::{AtomicUsize, Ordering};

use landform_graph::Lattice;
use rayon::prelude::*;

use super::cone::{Cone, Span};
use super::plane::Plane;

/// Quanta of height in one node spacing.
pub(super) const QUANTA: f64 = 4096.0;

/// Nodes that are compared, counted or marked at a time.
const CHUNK: usize = 1 << 13;

/// Places of running sums that a band of rows should not exceed, so that they stay in cache.
const BAND_PLACES: usize = 1 << 16;

/// Cone sums of the surface of a lattice.
#[derive(Clone, Debug)]
pub(super) struct ConeSums {
    cone: Cone,
    plane: Plane,
    scale: Scale,
    /// Height of each node in quanta.
    heights: Vec<i32>,
    /// Sum of the heights over the cone upwind of each node.
    sums: Vec<i32>,
    /// Sum of all heights.
    total: i64,
    /// Nodes that the cone upwind of each node holds, if open borders cut some cones.
    counts: Option<Vec<i32>>,
}

/// Metres in quanta.
#[derive(Clone, Copy, Debug)]
struct Scale {
    /// Quanta in a metre.
    per_metre: f64,
    /// Greatest height, in quanta, that cannot overflow a sum.
    limit: f64,
}

impl Scale {
    /// A height in quanta. Heights beyond the range of a sum count as the end of the range,
    /// and heights that are not numbers as its upper end.
    #[inline]
    fn quanta(&self, height_m: f64) -> i32 {
        // Adding this number leaves a double no room for fractions: it rounds, and the low
        // half of its bits is the integer. `f64::round` would be a slow call here.
        const ROUNDING: f64 = 6_755_399_441_055_744.0;
        let height = height_m * self.per_metre;
        let height = if height < self.limit { height } else { self.limit };
        let height = if height > -self.limit { height } else { -self.limit };
        (height + ROUNDING).to_bits() as i32
    }
}

impl ConeSums {
    /// Sums over a flat surface of height zero.
    pub fn new(lattice: &Lattice, cone: Cone) -> Self {
        let count = lattice.node_count();
        let limit = f64::from(i32::MAX) / cone.nodes.max(1) as f64;
        let mut sums = Self {
            plane: Plane::new(lattice),
            scale: Scale { per_metre: QUANTA / lattice.spacing(), limit },
            cone,
            heights: vec![0; count],
            sums: vec![0; count],
            total: 0,
            counts: None,
        };
        if !(lattice.is_periodic(0) && lattice.is_periodic(1)) {
            // A cone holds as many nodes as it sums up to where every height is one.
            sums.sum_afresh(|_| 1);
            sums.counts = Some(std::mem::replace(&mut sums.sums, vec![0; count]));
            sums.sum_afresh(|_| 0);
        }
        sums
    }

    /// Raises or lowers one node: erosion or deposition. Cost: the nodes of a cone.
    pub fn set_height(&mut self, node: usize, height_m: f64) {
        let quanta = self.scale.quanta(height_m);
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
        // Visiting the cones of the changed nodes must cost less than a pass over all.
        let most = surface.len() / self.cone.nodes.max(1);
        let Some(changed) = self.changed_chunks(surface, most) else {
            let scale = self.scale;
            return self.sum_afresh(|node| scale.quanta(surface[node]));
        };
        for chunk in changed {
            for (node, &height_m) in surface.iter().enumerate().skip(chunk * CHUNK).take(CHUNK) {
                if self.scale.quanta(height_m) != self.heights[node] {
                    self.set_height(node, height_m);
                }
            }
        }
    }

    /// The chunks of nodes that hold any that changed; `None` when more than `most` nodes did.
    fn changed_chunks(&self, surface: &[f64], most: usize) -> Option<Vec<usize>> {
        let found = AtomicUsize::new(0);
        let has_changed = |(chunk, (surface, heights)): (usize, (&[f64], &[i32]))| {
            if found.load(Ordering::Relaxed) > most {
                return None;
            }
            let differs = |(&height_m, &height)| u32::from(self.scale.quanta(height_m) != height);
            let changed: u32 = surface.iter().zip(heights).map(differs).sum();
            found.fetch_add(changed as usize, Ordering::Relaxed);
            (changed > 0).then_some(chunk)
        };
        let chunks = surface.par_chunks(CHUNK).zip(self.heights.par_chunks(CHUNK)).enumerate();
        let changed = chunks.filter_map(has_changed).collect();
        (found.into_inner() <= most).then_some(changed)
    }

    /// Takes all heights and sums afresh, with the heights that `quanta` gives for each node.
    ///
    /// Works on bands of rows. A band takes the running sums of its rows and of those upwind
    /// that its cones reach, so the bands need nothing of each other.
    fn sum_afresh(&mut self, quanta: impl Fn(usize) -> i32 + Sync) {
        let Self { cone, plane, heights, sums, .. } = self;
        let running = RunningRows::new(cone, plane);
        let band = running.band();
        let bands = sums.par_chunks_mut(band * plane.width);
        let bands = bands.zip(heights.par_chunks_mut(band * plane.width)).enumerate();
        let total = bands.map(|(number, (sums, heights))| {
            let rows = running.fill(number * band, heights, &quanta);
            for (row, sums) in sums.chunks_exact_mut(plane.width).enumerate() {
                running.sum_row(&rows, number * band, row, sums);
            }
            heights.iter().map(|&height| i64::from(height)).sum::<i64>()
        });
        self.total = total.sum();
    }

    /// Marks the nodes where the mean height of the cone upwind is above
    /// `mean + own_weight * (own height - mean)`, with the mean height of the whole surface.
    pub fn mark(&self, own_weight: f64, sheltered: &mut [bool]) {
        let mean = self.total as f64 / self.heights.len() as f64;
        // Written so that a level surface, whose mean is exact, compares as equal.
        let is_sheltered = |sum: i32, height: i32, count: f64| {
            f64::from(sum) > count * (mean + own_weight * (f64::from(height) - mean))
        };
        sheltered.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, sheltered)| {
            let nodes = chunk * CHUNK..chunk * CHUNK + sheltered.len();
            let state = self.sums[nodes.clone()].iter().zip(&self.heights[nodes.clone()]);
            match &self.counts {
                None if own_weight == 0.0 => {
                    // The same comparison on whole numbers, three times as fast.
                    let level = (self.cone.nodes as f64 * mean).floor() as i32;
                    for (sheltered, (&sum, _)) in sheltered.iter_mut().zip(state) {
                        *sheltered = sum > level;
                    }
                }
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

/// Running sums of rows, with margins as wide as the cone reaches: copies of the other end of
/// the row if it closes on itself, else nothing. Sums that overflow wrap round, and so do
/// their differences: those are right all the same.
struct RunningRows<'a> {
    cone: &'a Cone,
    plane: &'a Plane,
    /// Nodes in the margin before the row.
    lead: usize,
    /// Places in the running sums of a row: one more than it has nodes with its margins.
    stride: usize,
    /// Rows that the cones of a node reach up, northward and southward.
    north: usize,
    south: usize,
}

impl<'a> RunningRows<'a> {
    fn new(cone: &'a Cone, plane: &'a Plane) -> Self {
        let [west, east] = cone.margins();
        let upwind = |sign: isize| {
            cone.spans.iter().map(|span| sign * span.row).max().unwrap_or(0).max(0) as usize
        };
        let stride = plane.width + west + east + 1;
        Self { cone, plane, lead: east, stride, north: upwind(1), south: upwind(-1) }
    }

    /// Rows in a band.
    fn band(&self) -> usize {
        let reach = self.north + self.south;
        (BAND_PLACES / self.stride).saturating_sub(reach).max(2 * reach).max(16)
    }

    /// Sets the heights of a band that starts in row `top`; gives the running sums of its rows
    /// and of the rows around it that its cones reach.
    fn fill(&self, top: usize, heights: &mut [i32], quanta: impl Fn(usize) -> i32) -> Vec<i32> {
        let width = self.plane.width;
        let count = self.north + heights.len() / width + self.south;
        let mut running = vec![0; self.stride * count];
        let mut outside = vec![0; width];
        for (number, running) in running.chunks_exact_mut(self.stride).enumerate() {
            let Some(row) = self.plane.row(top, number as isize - self.north as isize) else {
                continue;
            };
            let within = number.checked_sub(self.north).map(|row| row * width);
            let within = within.and_then(|first| heights.get_mut(first..first + width));
            let here = within.unwrap_or(&mut outside);
            for (column, height) in here.iter_mut().enumerate() {
                *height = quanta(row * width + column);
            }
            self.accumulate(here, running);
        }
        running
    }

    /// Running sums of one row.
    fn accumulate(&self, heights: &[i32], running: &mut [i32]) {
        let width = heights.len();
        let tail = self.stride - 1 - width - self.lead;
        let mut sum = 0_i32;
        let (lead, rest) = running.split_at_mut(self.lead);
        let (row, margin) = rest.split_at_mut(width);
        let mut push = |places: &mut [i32], heights: &[i32]| {
            for (place, &height) in places.iter_mut().zip(heights) {
                *place = sum;
                sum = sum.wrapping_add(height);
            }
            sum
        };
        if self.plane.wraps_columns {
            push(lead, &heights[width - self.lead..]);
            push(row, heights);
            margin[tail] = push(&mut margin[..tail], &heights[..tail]);
        } else {
            let total = push(row, heights);
            margin.fill(total);
        }
    }

    /// Cone sums of row `row` of a band, whose running sums are `running`.
    fn sum_row(&self, running: &[i32], top: usize, row: usize, sums: &mut [i32]) {
        sums.fill(0);
        for span in &self.cone.spans {
            if self.plane.row(top + row, -span.row).is_none() {
                continue;
            }
            let upwind = (self.north + row).wrapping_add_signed(-span.row);
            let running = &running[upwind * self.stride..][..self.stride];
            // The cone upwind of column x covers columns x - last to x - first.
            let after = &running[(self.lead as isize - span.first + 1) as usize..][..sums.len()];
            let before = &running[(self.lead as isize - span.last) as usize..][..sums.len()];
            for ((sum, after), before) in sums.iter_mut().zip(after).zip(before) {
                *sum = sum.wrapping_add(after.wrapping_sub(*before));
            }
        }
    }
}
