//! Geometric shadow: nodes that a higher node upwind hides from the wind (Werner 1995).
//!
//! A node lies in shadow when some node at most `reach_m` upwind on its wind line rises above
//! the ray that leaves the node against the wind at the angle of the shadow. With `k` the step
//! along the line and `d` the drop of the ray a step, node `u` shades node `v` when
//! `h(u) + k(u) d > h(v) + k(v) d`: on heights tilted by `k d`, shadow is a running maximum.
//! [`cast_shadow`] keeps the maximum of many lines at once; `shadow_by_walking` in the module
//! `reference` looks upwind from each node, and both give the same bits.
//!
//! Limits: no node shades further than the lattice is long along the wind, so a shadow on a
//! torus never reaches round it twice. Nothing shades from beyond an open border.

use landform_graph::Lattice;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DuneError, check};
use super::plane::Plane;
use super::{Axis, Exposure, Shelter, WindLine};

/// The shape of a shadow (thesis, sections 2.3.1 and 4.1.2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ShadowSettings {
    /// Angle between the lower edge of the shadow and the horizontal, degrees in (0, 90).
    /// Default 15 (Werner 1995).
    pub angle_deg: f64,
    /// How far upwind a node looks for what shades it, metres; `None` looks as far as a
    /// shadow can fall. The thesis' search radius. Default 140.
    pub reach_m: Option<f64>,
}

impl Default for ShadowSettings {
    fn default() -> Self {
        Self { angle_deg: 15.0, reach_m: Some(140.0) }
    }
}

/// Shelter by the geometric shadow.
#[derive(Clone, Debug, PartialEq)]
pub struct Shadow {
    settings: ShadowSettings,
}

impl Shadow {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`DuneError::Range`] when the angle is not inside (0, 90) or the reach is not above 0.
    pub fn new(settings: ShadowSettings) -> Result<Self, DuneError> {
        let angle = settings.angle_deg;
        check(angle > 0.0 && angle < 90.0, "angle_deg", angle, "between 0 and 90, exclusive")?;
        if let Some(reach) = settings.reach_m {
            check(reach > 0.0, "reach_m", reach, "above 0")?;
        }
        Ok(Self { settings })
    }
}

impl Shelter for Shadow {
    fn shelter(&mut self, exposure: &Exposure<'_>, sheltered: &mut [bool]) {
        let Exposure { lattice, surface, wind, relief_m, .. } = *exposure;
        Caster::new(lattice, surface, relief_m, wind, &self.settings).cast(sheltered);
    }
}

/// Marks every node of `surface` (metres, one value a node) that lies in shadow.
///
/// Cost: about 1 ns a node; nodes more than `reach_m` behind what shades them cost a walk.
pub fn cast_shadow(
    lattice: &Lattice,
    surface: &[f64],
    wind: &WindLine,
    settings: &ShadowSettings,
    shaded: &mut [bool],
) {
    let (low, high) = range(surface);
    Caster::new(lattice, surface, high - low, wind, settings).cast(shaded);
}

/// The shadow of one surface in one wind.
pub(super) struct Caster<'a> {
    plane: Plane,
    surface: &'a [f64],
    wind: &'a WindLine,
    /// Metres that the ray rises a step upwind.
    drop: f64,
    /// Steps upwind that can matter.
    reach: usize,
    /// Whether something beyond `reach` may be high enough to shade.
    cut: bool,
}

/// Rows that [`Caster::along_rows`] keeps a running maximum for at once.
const BUNDLE: usize = 32;

/// Most steps that it follows one row before it turns to the next.
const RUN: usize = 8;

impl<'a> Caster<'a> {
    /// Works out how far a shadow can matter.
    pub fn new(
        lattice: &Lattice,
        surface: &'a [f64],
        relief: f64,
        wind: &'a WindLine,
        settings: &ShadowSettings,
    ) -> Self {
        let plane = Plane::new(lattice);
        let step = wind.step_length() * lattice.spacing();
        let drop = settings.angle_deg.to_radians().tan() * step;
        let longest = match wind.axis() {
            Axis::Columns => plane.width,
            Axis::Rows => plane.height,
        };
        let allowed = match settings.reach_m {
            // The search radius includes a node that lies exactly on it.
            Some(reach) => longest.min((reach / step + 1e-9) as usize),
            None => longest,
        };
        let needed = (relief / drop) as usize + 1;
        let [reach, cut] = [needed.min(allowed), usize::from(needed > allowed)];
        Self { plane, surface, wind, drop, reach, cut: cut == 1 }
    }

    /// Marks every node.
    pub fn cast(&self, shaded: &mut [bool]) {
        match self.wind.axis() {
            Axis::Columns => self.along_rows(shaded),
            Axis::Rows => self.across_rows(shaded),
        }
    }

    /// Height at step `step` of a line, tilted so that the edge of a shadow is level.
    #[inline]
    fn tilted(&self, height: f64, step: isize) -> f64 {
        height + step as f64 * self.drop
    }

    /// Steps from the upwind end of the lattice to a node.
    fn step_of(&self, column: usize, row: usize) -> isize {
        let (place, size) = match self.wind.axis() {
            Axis::Columns => (column, self.plane.width),
            Axis::Rows => (row, self.plane.height),
        };
        (if self.wind.is_forward() { place } else { size - 1 - place }) as isize
    }

    /// Tilted heights of the nodes upwind of a node, nearest first, as far as the reach.
    pub fn upwind(&self, column: usize, row: usize) -> impl Iterator<Item = f64> + '_ {
        let step = self.step_of(column, row);
        let here = self.wind.shift(step);
        (1..=self.reach as isize).map_while(move |back| {
            let across = self.wind.shift(step - back) - here;
            let along = if self.wind.is_forward() { -back } else { back };
            let (columns, rows) = match self.wind.axis() {
                Axis::Columns => (along, across),
                Axis::Rows => (across, along),
            };
            let column = self.plane.column(column, columns)?;
            let row = self.plane.row(row, rows)?;
            let height = self.surface[column + self.plane.width * row];
            Some(self.tilted(height, step - back))
        })
    }

    /// Highest tilted height upwind of a node within reach.
    fn peak_upwind(&self, column: usize, row: usize) -> f64 {
        self.upwind(column, row).fold(f64::NEG_INFINITY, higher)
    }

    /// Whether a node lies in shadow: the definition.
    pub fn is_shaded(&self, column: usize, row: usize) -> bool {
        let height = self.surface[column + self.plane.width * row];
        let here = self.tilted(height, self.step_of(column, row));
        self.upwind(column, row).any(|upwind| upwind > here)
    }

    /// Wind along rows: bundles of rows, each with the maxima of the lines that cross it now.
    fn along_rows(&self, shaded: &mut [bool]) {
        let width = self.plane.width;
        shaded.par_chunks_mut(BUNDLE * width).enumerate().for_each(|(bundle, shaded)| {
            let first = bundle * BUNDLE;
            let rows = shaded.len() / width;
            self.bundle(first, &self.surface[first * width..(first + rows) * width], shaded);
            if self.cut {
                self.cut_to_reach(first, shaded);
            }
        });
    }

    /// Shadow in the rows from row `first` on, [`BUNDLE`] at most. A maximum waits for the one
    /// before it, so the rows take turns: what waits in one goes on in the next.
    fn bundle(&self, first: usize, surface: &[f64], shaded: &mut [bool]) {
        let width = self.plane.width;
        let last = shaded.len() / width - 1;
        let column_at = |step: usize| if self.wind.is_forward() { step } else { width - 1 - step };
        let mut peaks = [f64::NEG_INFINITY; BUNDLE];
        for (row, peak) in peaks[..=last].iter_mut().enumerate() {
            *peak = self.peak_upwind(column_at(0), first + row);
        }
        let mut shift = self.wind.shift(0);
        let mut step = 0;
        while step < width {
            let moved = self.wind.shift(step as isize);
            if moved > shift {
                peaks.copy_within(..last, 1);
                peaks[0] = self.peak_upwind(column_at(step), first);
            } else if moved < shift {
                peaks.copy_within(1..=last, 0);
                peaks[last] = self.peak_upwind(column_at(step), first + last);
            }
            shift = moved;
            let run = (1..RUN.min(width - step))
                .find(|&on| self.wind.shift((step + on) as isize) != shift)
                .unwrap_or(RUN.min(width - step));
            let columns = match self.wind.is_forward() {
                true => step..step + run,
                false => width - step - run..width - step,
            };
            // The tilt of each node from west to east, the same in all rows.
            let mut tilts: [f64; RUN] = std::array::from_fn(|on| (step + on) as f64 * self.drop);
            if !self.wind.is_forward() {
                tilts[..run].reverse();
            }
            let rows = surface.chunks_exact(width).zip(shaded.chunks_exact_mut(width));
            for (peak, (heights, shaded)) in peaks.iter_mut().zip(rows) {
                let (heights, shaded) = (&heights[columns.clone()], &mut shaded[columns.clone()]);
                *peak = match (
                    <&[f64; RUN]>::try_from(heights),
                    <&mut [bool; RUN]>::try_from(&mut *shaded),
                ) {
                    (Ok(heights), Ok(shaded)) => self.follow(*peak, &tilts, heights, shaded),
                    _ => self.follow(*peak, &tilts[..run], heights, shaded),
                };
            }
            step += run;
        }
    }

    /// Follows a line over a few nodes of one row; gives its maximum afterwards.
    #[inline(always)]
    fn follow(&self, peak: f64, tilts: &[f64], heights: &[f64], shaded: &mut [bool]) -> f64 {
        let pass = |peak: f64, ((&tilt, &height), shaded): ((&f64, &f64), &mut bool)| {
            let height = height + tilt;
            *shaded = peak > height;
            higher(peak, height)
        };
        let nodes = tilts.iter().zip(heights).zip(shaded);
        if self.wind.is_forward() { nodes.fold(peak, pass) } else { nodes.rev().fold(peak, pass) }
    }

    /// Wind along columns: bands of rows, each with the maxima of all lines side by side.
    fn across_rows(&self, shaded: &mut [bool]) {
        let Plane { width, height, .. } = self.plane;
        // Each band first walks the reach upwind of it, so it should be longer than that.
        let band = (4 * self.reach).max(64);
        shaded.par_chunks_mut(band * width).enumerate().for_each(|(number, shaded)| {
            let rows = shaded.len() / width;
            let top = number * band;
            let first = if self.wind.is_forward() { top } else { height - top - rows };
            let mut peaks = vec![f64::NEG_INFINITY; width];
            let start = first as isize - self.reach as isize;
            let start = if self.plane.wraps_rows { start } else { start.max(0) };
            for step in start..(first + rows) as isize {
                self.renew_entering(&mut peaks, step, step == start);
                let place = step.rem_euclid(height as isize) as usize;
                let row = if self.wind.is_forward() { place } else { height - 1 - place };
                let shaded = (step >= first as isize)
                    .then(|| &mut shaded[(row - top) * width..(row - top + 1) * width]);
                self.advance(&mut peaks, step, row, shaded);
            }
            if self.cut {
                self.cut_to_reach(top, shaded);
            }
        });
    }

    /// Forgets the maximum of a line that left over an open border, for the line that enters.
    fn renew_entering(&self, peaks: &mut [f64], step: isize, first: bool) {
        let shift = self.wind.shift(step);
        let before = self.wind.shift(step - 1);
        if first || self.plane.wraps_columns || shift == before {
            return;
        }
        let column = if shift > before { 0 } else { peaks.len() as isize - 1 };
        peaks[(column - shift).rem_euclid(peaks.len() as isize) as usize] = f64::NEG_INFINITY;
    }

    /// Moves all lines one row on. Line `l` meets column `l + shift`, wrapped.
    fn advance(&self, peaks: &mut [f64], step: isize, row: usize, shaded: Option<&mut [bool]>) {
        let width = peaks.len();
        let heights = &self.surface[row * width..(row + 1) * width];
        let tilt = step as f64 * self.drop;
        let turn = self.wind.shift(step).rem_euclid(width as isize) as usize;
        let (late, early) = peaks.split_at_mut(width - turn);
        match shaded {
            Some(shaded) => {
                pass(early, &heights[..turn], tilt, &mut shaded[..turn]);
                pass(late, &heights[turn..], tilt, &mut shaded[turn..]);
            }
            None => {
                raise(early, &heights[..turn], tilt);
                raise(late, &heights[turn..], tilt);
            }
        }
    }

    /// Looks again at shaded nodes of the rows from `first` on: what shades may be too far.
    fn cut_to_reach(&self, first: usize, shaded: &mut [bool]) {
        let width = self.plane.width;
        for (node, shaded) in shaded.iter_mut().enumerate() {
            *shaded = *shaded && self.is_shaded(node % width, first + node / width);
        }
    }
}

/// The higher of two heights; unlike `f64::max`, one instruction.
#[inline]
fn higher(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Compares a row with the maxima so far and raises them.
fn pass(peaks: &mut [f64], heights: &[f64], tilt: f64, shaded: &mut [bool]) {
    for ((peak, &height), shaded) in peaks.iter_mut().zip(heights).zip(shaded) {
        let height = height + tilt;
        *shaded = *peak > height;
        *peak = higher(*peak, height);
    }
}

/// Raises the maxima to a row.
fn raise(peaks: &mut [f64], heights: &[f64], tilt: f64) {
    for (peak, &height) in peaks.iter_mut().zip(heights) {
        *peak = higher(*peak, height + tilt);
    }
}

/// Lowest and highest value; infinities the wrong way round where there is none.
pub(super) fn range(heights: &[f64]) -> (f64, f64) {
    // Several extremes side by side: one alone would wait for itself at every value.
    const LANES: usize = 8;
    let mut lows = [f64::INFINITY; LANES];
    let mut highs = [f64::NEG_INFINITY; LANES];
    let (groups, rest) = heights.as_chunks::<LANES>();
    for group in groups {
        for (lane, &height) in group.iter().enumerate() {
            lows[lane] = lower(lows[lane], height);
            highs[lane] = higher(highs[lane], height);
        }
    }
    let low = lows.iter().chain(rest).fold(f64::INFINITY, |low, &height| lower(low, height));
    let high =
        highs.iter().chain(rest).fold(f64::NEG_INFINITY, |high, &height| higher(high, height));
    (low, high)
}

/// The lower of two heights.
#[inline]
fn lower(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dunes::reference;
    use landform_graph::{Boundary, Connectivity};
    use landform_sim::random::{RandomStream, unit};

    /// Bumpy ground: noise on a few sharp hills.
    fn hills(lattice: &Lattice, height: f64) -> Vec<f64> {
        let random = RandomStream::new(5, "hills");
        (0..lattice.node_count())
            .map(|node| {
                let noise = unit(random.block(0, node, 0)[0]);
                let hill = unit(random.block(1, node / 37, 0)[0]).powi(8);
                height * (0.1 * noise + hill)
            })
            .collect()
    }

    #[test]
    fn running_maxima_give_the_shadow_of_looking_upwind() {
        let boundaries = [Boundary::Open, Boundary::Periodic];
        let mut shaded_ever = 0;
        for (columns, rows) in [(61, 40), (40, 133), (8, 8), (3, 5)] {
            for boundary in boundaries.iter().flat_map(|&x| boundaries.map(|y| [x, y])) {
                let size = [columns, rows];
                let lattice = Lattice::plane(size, 2.0, Connectivity::Four, boundary).unwrap();
                for (number, height) in [3.0, 30.0, 3000.0].into_iter().enumerate() {
                    let surface = hills(&lattice, height);
                    for degrees in (0..360).step_by(15).chain([7, 44, 46, 133, 291]) {
                        let phase = (degrees % 10) as f64 / 10.0;
                        let wind = WindLine::new(f64::from(degrees).to_radians(), phase);
                        let reach_m =
                            [None, Some(9.0), Some(60.0)][(degrees as usize + number) % 3];
                        let settings = ShadowSettings { angle_deg: 15.0, reach_m };
                        let [mut kernel, mut walked] = [(); 2].map(|()| vec![true; surface.len()]);
                        cast_shadow(&lattice, &surface, &wind, &settings, &mut kernel);
                        reference::shadow(&lattice, &surface, &wind, &settings, &mut walked);
                        assert_eq!(kernel, walked, "{size:?} {boundary:?} {degrees} {settings:?}");
                        shaded_ever += walked.iter().filter(|&&shaded| shaded).count();
                    }
                }
            }
        }
        assert!(shaded_ever > 100_000);
    }

    /// A wall of height H shades H / tan(15 degrees) downwind, whatever the wind.
    #[test]
    fn a_wall_casts_a_shadow_of_the_exact_length() {
        let boundary = [Boundary::Open; 2];
        let lattice = Lattice::plane([80, 80], 1.0, Connectivity::Four, boundary).unwrap();
        for (degrees, wall) in [(0.0, 20), (180.0, 20), (90.0, 20), (270.0, 20)] {
            let vertical = degrees % 180.0 == 0.0;
            let along = |node: usize| if vertical { node % 80 } else { node / 80 };
            let surface: Vec<f64> =
                (0..6400).map(|node| if along(node) == wall { 5.0 } else { 0.0 }).collect();
            let wind = WindLine::new(f64::to_radians(degrees), 0.3);
            let settings = ShadowSettings { angle_deg: 15.0, reach_m: None };
            let mut shaded = vec![false; 6400];
            cast_shadow(&lattice, &surface, &wind, &settings, &mut shaded);
            // 5 / tan 15 = 18.66: eighteen nodes lie below the edge of the shadow.
            assert_eq!(shaded.iter().filter(|&&shaded| shaded).count(), 18 * 80, "{degrees}");
        }
    }

    #[test]
    fn flat_ground_has_no_shadow() {
        let boundary = [Boundary::Periodic; 2];
        let lattice = Lattice::plane([9, 7], 1.0, Connectivity::Four, boundary).unwrap();
        let mut shaded = vec![true; 63];
        let wind = WindLine::new(0.3, 0.5);
        cast_shadow(&lattice, &[4.0; 63], &wind, &ShadowSettings::default(), &mut shaded);
        assert!(shaded.iter().all(|&shaded| !shaded));
    }
}
