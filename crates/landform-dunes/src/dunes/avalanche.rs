//! Avalanches: sand steeper than repose slides until none is left.
//!
//! Along an edge of length `l` the stable step is `T = l tan(repose)`. A higher step of `D`
//! sends `ceil((D - T) / 2 slab)` slabs down, or all the sand of the upper node when there is
//! less. With slabs no higher than `T` the step never turns round, every slide lowers the
//! potential energy of the sand, and so the slides end.
//!
//! Edges are visited in families of edges that share no node (even and odd ones of each
//! direction): what one does cannot matter to another, so the family is swept on any number of
//! threads with the same bits. Families are swept in turn until a whole round moves nothing.
//! A family skips tiles of the lattice where nothing changed since it last looked.
//! `settle_by_sweeping` in the module `reference` visits every edge every time and gives the same bits.
//!
//! Conserves sand to rounding; exactly where thickness is a multiple of the slab. After it no
//! edge is steeper than repose (to 1e-11 in the tangent) unless its upper node is bare.

use landform_graph::{Connectivity, Lattice};
use rayon::prelude::*;

use super::AvalancheSettings;
use super::plane::Plane;

/// Nodes in a tile: the piece of a row that is looked at or skipped as a whole.
const TILE: usize = 64;

/// Nodes in rows with changes from which a family is worth several threads.
const PARALLEL_NODES: usize = 1 << 15;

/// Slope above repose (in the tangent) that counts as rounding.
const TOLERANCE: f64 = 1e-11;

/// What the avalanches of one pass did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AvalancheCounts {
    /// Rounds over all edges, the last one quiet.
    pub sweeps: u32,
    /// Slides over single edges.
    pub slides: u64,
    /// Sum of the thickness that slid over single edges, metres; times the area of a node it
    /// is a volume.
    pub moved_m: f64,
    /// Whether the sand came to rest within the allowed number of sweeps.
    pub settled: bool,
}

/// The fields that slides change together. Rows may be a part of the lattice.
pub(super) struct Layers<'a> {
    /// Height of the bed, metres.
    pub bed: &'a [f64],
    /// Thickness of sand, metres.
    pub sand: &'a mut [f64],
    /// Bed plus sand, metres; kept so.
    pub surface: &'a mut [f64],
}

/// Stable step and slab of one kind of edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct SlideRule {
    /// Highest stable step in metres.
    stable: f64,
    /// Step above which sand slides, a rounding error higher.
    trigger: f64,
    /// Height of a slab in metres.
    slab: f64,
}

impl SlideRule {
    /// The rule of edges `length` metres long.
    pub fn new(repose: f64, length: f64, slab: f64) -> Self {
        let stable = repose * length;
        Self { stable, trigger: stable + TOLERANCE * length, slab }
    }

    /// Lets sand slide between two nodes; gives the thickness that slid.
    #[inline]
    pub fn slide(&self, layers: &mut Layers<'_>, first: usize, second: usize) -> f64 {
        let step = layers.surface[first] - layers.surface[second];
        if step.abs() <= self.trigger {
            return 0.0;
        }
        let (upper, lower) = if step > 0.0 { (first, second) } else { (second, first) };
        let slabs = ((step.abs() - self.stable) / (2.0 * self.slab)).ceil();
        let amount = (slabs * self.slab).min(layers.sand[upper]);
        if amount > 0.0 {
            for (node, change) in [(upper, -amount), (lower, amount)] {
                layers.sand[node] += change;
                layers.surface[node] = layers.bed[node] + layers.sand[node];
            }
        }
        amount.max(0.0)
    }
}

/// Which edges of a direction belong to a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Those that start in even columns (along rows) or even rows.
    Even,
    /// Those that start in odd columns or odd rows.
    Odd,
    /// Those that close a periodic axis: from the last column or row to the first.
    Closing,
}

/// Edges of one direction that share no node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Family {
    /// Columns from the first to the second node of an edge: -1, 0 or 1.
    pub columns: isize,
    /// Rows from the first to the second node: 0 or 1.
    pub rows: usize,
    /// Which edges of the direction.
    pub part: Part,
    /// Whether only nodes whose column and row add to an even number have such edges.
    pub even_nodes: bool,
    /// When sand slides.
    pub rule: SlideRule,
}

/// All edges of a lattice, as families in the order in which they are swept.
pub(super) fn families(lattice: &Lattice, repose: f64, slab: f64) -> Vec<Family> {
    let directions: &[(isize, usize)] = match lattice.connectivity() {
        Connectivity::FourEight | Connectivity::Eight => &[(1, 0), (0, 1), (1, 1), (-1, 1)],
        _ => &[(1, 0), (0, 1)],
    };
    let mut families = Vec::new();
    for &(columns, rows) in directions {
        let diagonal = columns != 0 && rows != 0;
        let length = lattice.step_length([columns as i8, rows as i8, 0]);
        let rule = SlideRule::new(repose, length, slab);
        let even_nodes = diagonal && lattice.connectivity() == Connectivity::FourEight;
        for part in [Part::Even, Part::Odd, Part::Closing] {
            if part != Part::Closing || lattice.is_periodic(rows) {
                families.push(Family { columns, rows, part, even_nodes, rule });
            }
        }
    }
    families
}

/// Where the edges of a family lie that start in one row.
#[derive(Clone, Copy, Debug)]
struct EdgeRow<'a> {
    plane: &'a Plane,
    family: &'a Family,
    /// Row number that decides which nodes are even.
    row: usize,
    /// Index, in the layers, of the row that the edges start in.
    from: usize,
    /// Index, in the layers, of the row that they end in.
    to: usize,
}

impl EdgeRow<'_> {
    /// First column and column step of the starts of edges.
    fn start(&self) -> (usize, usize) {
        match (self.family.rows, self.family.part) {
            (0, Part::Odd) => (1, 2),
            (0, _) => (0, 2),
            _ if self.family.even_nodes => (self.row % 2, 2),
            _ => (0, 1),
        }
    }

    /// Columns of a tile whose edges end inside the same or a neighbouring column.
    fn inner(&self, tile: usize) -> std::ops::Range<usize> {
        let width = self.plane.width;
        if (self.family.rows, self.family.part) == (0, Part::Closing) {
            return 0..0;
        }
        let first = (tile * TILE).max(usize::from(self.family.columns < 0));
        let last = ((tile + 1) * TILE).min(width - usize::from(self.family.columns > 0));
        first..last.max(first)
    }

    /// Columns of the edge that closes a row on itself, if this tile has it.
    fn closing(&self, tile: usize) -> Option<(usize, usize)> {
        let last = self.plane.width - 1;
        let (from, to) = if self.family.columns > 0 { (last, 0) } else { (0, last) };
        let along = self.family.rows == 0;
        let here = self.plane.wraps_columns
            && self.family.columns != 0
            && from / TILE == tile
            && (!along || self.family.part == Part::Closing)
            && (!self.family.even_nodes || (from + self.row).is_multiple_of(2));
        here.then_some((from, to))
    }

    /// Whether some edge of a tile is too steep; edges of other parts may raise the alarm.
    fn is_steep(&self, surface: &[f64], columns: &std::ops::Range<usize>) -> bool {
        let first = &surface[self.from + columns.start..self.from + columns.end];
        let shifted = (self.to + columns.start).wrapping_add_signed(self.family.columns);
        let second = &surface[shifted..shifted + columns.len()];
        let trigger = self.family.rule.trigger;
        let steep = |(a, b): (&f64, &f64)| u64::from((a - b).abs() > trigger);
        first.iter().zip(second).map(steep).fold(0, |any, one| any | one) != 0
    }

    /// Sweeps a tile: thickness and number of slides.
    fn sweep(&self, layers: &mut Layers<'_>, tile: usize) -> (f64, u64) {
        let mut total = (0.0, 0);
        let mut slide = |layers: &mut Layers<'_>, first: usize, second: usize| {
            let amount = self.family.rule.slide(layers, self.from + first, self.to + second);
            total.0 += amount;
            total.1 += u64::from(amount > 0.0);
        };
        let inner = self.inner(tile);
        if !inner.is_empty() && self.is_steep(layers.surface, &inner) {
            let (start, step) = self.start();
            let first =
                if step == 2 { inner.start + (inner.start + start) % 2 } else { inner.start };
            for column in (first..inner.end).step_by(step) {
                slide(layers, column, column.wrapping_add_signed(self.family.columns));
            }
        }
        if let Some((first, second)) = self.closing(tile) {
            slide(layers, first, second);
        }
        total
    }
}

/// When tiles changed and when each family last looked at them: scratch of [`settle`].
#[derive(Clone, Debug, Default)]
pub(super) struct AvalancheScratch {
    /// Sweep of a family, counted from 2 in each pass, that last changed a tile.
    changed: Vec<u32>,
    /// The same for rows.
    row_changed: Vec<u32>,
    /// Sweep in which each family last looked at a tile, and at a row.
    checked: Vec<(Vec<u32>, Vec<u32>)>,
    /// Thickness moved and number of slides of each row in one sweep of one family.
    moved: Vec<(f64, u64)>,
}

impl AvalancheScratch {
    /// Everything has changed, nothing was looked at.
    fn reset(&mut self, plane: &Plane, families: usize) {
        let tiles = plane.width.div_ceil(TILE) * plane.height;
        let refill = |list: &mut Vec<u32>, length: usize, value: u32| {
            list.clear();
            list.resize(length, value);
        };
        refill(&mut self.changed, tiles, 1);
        refill(&mut self.row_changed, plane.height, 1);
        self.checked.resize(families, Default::default());
        for (checked, row_checked) in &mut self.checked {
            refill(checked, tiles, 0);
            refill(row_checked, plane.height, 0);
        }
        self.moved.clear();
        self.moved.resize(plane.height, (0.0, 0));
    }
}

/// The tiles of the rows that one task sweeps, beside their [`Layers`].
struct Tiles<'a> {
    /// When each tile changed.
    changed: &'a mut [u32],
    /// When the family looked at each tile of the rows that its edges start in.
    checked: &'a mut [u32],
    /// Index of the first tile of the rows that edges start and end in.
    from: usize,
    to: usize,
}

/// Sweeps the edges that start in one row, except in tiles where nothing changed.
fn sweep_row(
    edges: &EdgeRow<'_>,
    layers: &mut Layers<'_>,
    tiles: &mut Tiles<'_>,
    now: u32,
) -> (f64, u64) {
    let count = edges.plane.width.div_ceil(TILE);
    let mut total = (0.0, 0);
    for tile in 0..count {
        // The tiles that edges from this tile may end in.
        let next = (tile + 1) % count;
        let before = (tile + count - 1) % count;
        let beside = match edges.family.columns {
            1 => next,
            -1 => before,
            _ => tile,
        };
        let ends = [tiles.from + tile, tiles.to + tile, tiles.to + beside];
        let checked = &mut tiles.checked[tiles.from + tile];
        if ends.iter().all(|&end| tiles.changed[end] <= *checked) {
            continue;
        }
        *checked = now;
        let (amount, slides) = edges.sweep(layers, tile);
        if slides > 0 {
            ends.iter().for_each(|&end| tiles.changed[end] = now);
            total = (total.0 + amount, total.1 + slides);
        }
    }
    total
}

/// Lets all sand that is too steep slide, and reports what slid.
///
/// `layers` hold the whole lattice. See the module for the scheme and what it guarantees.
pub(super) fn settle(
    lattice: &Lattice,
    settings: &AvalancheSettings,
    slab: f64,
    layers: &mut Layers<'_>,
    scratch: &mut AvalancheScratch,
) -> AvalancheCounts {
    let plane = Plane::new(lattice);
    let families = families(lattice, settings.repose(), slab);
    scratch.reset(&plane, families.len());
    let mut counts = AvalancheCounts::default();
    let mut now = 1;
    while !counts.settled && counts.sweeps < settings.most_sweeps {
        let before = counts.slides;
        for (number, family) in families.iter().enumerate() {
            now += 1;
            let mut sweep = FamilySweep { plane: &plane, family, number, now };
            sweep.run(layers, scratch, &mut counts);
        }
        counts.sweeps += 1;
        counts.settled = counts.slides == before;
    }
    counts
}

/// One sweep over the edges of a family.
struct FamilySweep<'a> {
    plane: &'a Plane,
    family: &'a Family,
    /// Place of the family in the order of sweeps.
    number: usize,
    /// Number of this sweep.
    now: u32,
}

impl FamilySweep<'_> {
    /// Rows that edges start in, in order.
    fn rows(&self) -> impl Iterator<Item = usize> + use<> {
        let height = self.plane.height;
        match (self.family.rows, self.family.part) {
            (0, _) => (0..height).step_by(1),
            (_, Part::Even) => (0..height - 1).step_by(2),
            (_, Part::Odd) => (1..(height - 1).max(1)).step_by(2),
            (_, Part::Closing) => (height - 1..height).step_by(1),
        }
    }

    /// The row that edges from `row` end in.
    fn end(&self, row: usize) -> usize {
        (row + self.family.rows) % self.plane.height
    }

    /// Whether something changed since the family last looked at a row.
    fn is_due(&self, row: usize, scratch: &AvalancheScratch) -> bool {
        let checked = scratch.checked[self.number].1[row];
        scratch.row_changed[row] > checked || scratch.row_changed[self.end(row)] > checked
    }

    /// Sweeps all rows that are due.
    fn run(
        &mut self,
        layers: &mut Layers<'_>,
        scratch: &mut AvalancheScratch,
        counts: &mut AvalancheCounts,
    ) {
        let due = self.rows().filter(|&row| self.is_due(row, scratch)).count();
        if due == 0 {
            return;
        }
        let closing = self.family.rows == 1 && self.family.part == Part::Closing;
        if closing || due * self.plane.width < PARALLEL_NODES {
            self.run_serially(layers, scratch);
        } else {
            self.run_in_parallel(layers, scratch);
        }
        for row in self.rows() {
            if !self.is_due(row, scratch) {
                continue;
            }
            scratch.checked[self.number].1[row] = self.now;
            let (amount, slides) = std::mem::take(&mut scratch.moved[row]);
            if slides > 0 {
                counts.moved_m += amount;
                counts.slides += slides;
                scratch.row_changed[row] = self.now;
                scratch.row_changed[self.end(row)] = self.now;
            }
        }
    }

    fn run_serially(&self, layers: &mut Layers<'_>, scratch: &mut AvalancheScratch) {
        let Plane { width, .. } = *self.plane;
        let count = width.div_ceil(TILE);
        for row in self.rows() {
            if !self.is_due(row, scratch) {
                continue;
            }
            let end = self.end(row);
            let Self { plane, family, .. } = *self;
            let edges = EdgeRow { plane, family, row, from: row * width, to: end * width };
            let mut tiles = Tiles {
                changed: &mut scratch.changed,
                checked: &mut scratch.checked[self.number].0,
                from: row * count,
                to: end * count,
            };
            scratch.moved[row] = sweep_row(&edges, layers, &mut tiles, self.now);
        }
    }

    fn run_in_parallel(&self, layers: &mut Layers<'_>, scratch: &mut AvalancheScratch) {
        let Self { plane, family, now, .. } = *self;
        let width = plane.width;
        let count = width.div_ceil(TILE);
        let taken = family.rows + 1;
        let skipped = usize::from(family.rows == 1 && family.part == Part::Odd);
        let to = family.rows * width;
        let (checked, row_checked) = &mut scratch.checked[self.number];
        let row_changed = &scratch.row_changed[skipped..];
        layers.sand[skipped * width..]
            .par_chunks_mut(taken * width)
            .zip(layers.surface[skipped * width..].par_chunks_mut(taken * width))
            .zip(layers.bed[skipped * width..].par_chunks(taken * width))
            .zip(scratch.changed[skipped * count..].par_chunks_mut(taken * count))
            .zip(checked[skipped * count..].par_chunks_mut(taken * count))
            .zip(scratch.moved[skipped..].par_chunks_mut(taken))
            .zip(row_checked[skipped..].par_chunks(taken).zip(row_changed.par_chunks(taken)))
            .enumerate()
            .for_each(|(number, item)| {
                let ((((((sand, surface), bed), changed), checked), moved), rows) = item;
                let (row_checked, row_changed) = rows;
                let due = row_changed.iter().any(|&changed| changed > row_checked[0]);
                if moved.len() < taken || !due {
                    return;
                }
                let row = skipped + number * taken;
                let edges = EdgeRow { plane, family, row, from: 0, to };
                let mut layers = Layers { bed, sand, surface };
                let mut tiles = Tiles { changed, checked, from: 0, to: family.rows * count };
                moved[0] = sweep_row(&edges, &mut layers, &mut tiles, now);
            });
    }
}
