//! A band of rows, whose sand comes to rest by itself: one slide after the other.

use super::avalanche::Layers;
use super::plane::Plane;
use super::stencil::{STEPS, Stencil, first_look};

/// Edges that are compared at once.
const GROUP: usize = 8;

/// Edges that are looked at before the sand below them slides: one word of bits.
const TILE: usize = 64;

/// Bits of every other edge of a tile.
const EVEN: u64 = 0x5555_5555_5555_5555;

/// Where a band lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows {
    /// Row of the lattice that the band begins with.
    pub first: usize,
    /// Number of rows, at most the height of the lattice.
    pub count: usize,
    /// Row of the layers at hand that the band begins with. It ends beyond their last row if
    /// it lies across a periodic border, and goes on with their first.
    pub offset: usize,
}

/// What slid in a band.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slid {
    /// Sum of the thickness that slid over single edges, metres.
    pub amount: f64,
    /// Slides over single edges.
    pub slides: u64,
    /// Whether the first and the last row changed.
    pub ends: [bool; 2],
}

/// A node of a band: column, and row counted from the first of the band.
pub(super) type Place = [u32; 2];

/// A band that is coming to rest.
pub(super) struct Band<'a, const N: usize> {
    pub plane: &'a Plane,
    pub stencil: &'a Stencil<N>,
    pub rows: Rows,
    pub layers: Layers<'a>,
    /// Nodes that sand may slide from, the next one last: scratch.
    pub unstable: &'a mut Vec<Place>,
    pub slid: &'a mut Slid,
    /// Number of slides after which the band gives up.
    pub most_slides: u64,
}

impl<const N: usize> Band<'_, N> {
    /// Lets all sand slide that is too steep along edges within rows, if `along_rows`, or
    /// between a row and the next where `is_due` says so of the row, and whatever that sets
    /// into motion.
    pub fn settle(&mut self, along_rows: bool, is_due: impl Fn(usize) -> bool) {
        for row in 0..self.rows.count {
            if along_rows {
                self.list_steep(row, 0);
            }
            if row + 1 < self.rows.count && is_due(row) {
                for k in [3, 6, 7].into_iter().filter(|&k| k < N) {
                    self.list_steep(row, k);
                }
            }
            while let Some(place) = self.unstable.pop() {
                self.follow(place);
            }
        }
    }

    /// Index of the first node of a row, in the layers at hand.
    #[inline]
    fn start(&self, row: usize) -> usize {
        let row = self.rows.offset + row;
        let rows = self.layers.surface.len() / self.plane.width;
        self.plane.width * if row < rows { row } else { row - rows }
    }

    /// Lists the upper ends of edges from a row in direction `k` that are too steep.
    fn list_steep(&mut self, row: usize, k: usize) {
        let [columns, rows] = STEPS[k];
        let width = self.plane.width;
        let [from, to] = [self.start(row), self.start(row.wrapping_add_signed(rows))];
        let inner = usize::from(columns < 0)..width - usize::from(columns > 0);
        let trigger = self.stencil.rule(k).trigger();
        let parity = (self.rows.first + row) % 2;
        let kind = if k >= 4 && self.stencil.alternate { EVEN << parity } else { u64::MAX };
        for tile in (0..width).step_by(TILE) {
            let columns_here = tile.max(inner.start)..(tile + TILE).min(inner.end);
            if columns_here.is_empty() {
                continue;
            }
            let first = &self.layers.surface[from + columns_here.start..from + columns_here.end];
            let end = (to + columns_here.start).wrapping_add_signed(columns);
            let second = &self.layers.surface[end..end + first.len()];
            let mut steep = (steep(first, second, trigger) << (columns_here.start - tile)) & kind;
            while steep != 0 {
                let column = tile + steep.trailing_zeros() as usize;
                steep &= steep - 1;
                let end = [column.wrapping_add_signed(columns), row.wrapping_add_signed(rows)];
                self.list_upper([column, row], end);
            }
        }
        let closing = if columns < 0 { 0 } else { width - 1 };
        if columns != 0 && self.plane.wraps_columns && kind >> (closing % TILE) & 1 == 1 {
            let end = width - 1 - closing;
            let step = self.layers.surface[from + closing] - self.layers.surface[to + end];
            if step.abs() > trigger {
                self.list_upper([closing, row], [end, row.wrapping_add_signed(rows)]);
            }
        }
    }

    /// Lists the higher one of two places.
    #[inline]
    fn list_upper(&mut self, first: [usize; 2], second: [usize; 2]) {
        let height = |[column, row]: [usize; 2]| self.layers.surface[self.start(row) + column];
        let upper = if height(first) > height(second) { first } else { second };
        self.unstable.push(upper.map(|index| index as u32));
    }

    /// Lets sand slide from a place, follows it down until it rests, and lists where else sand
    /// may slide now.
    #[inline]
    fn follow(&mut self, mut place: Place) {
        let last = self.rows.count as u32 - 1;
        while self.slid.slides < self.most_slides {
            let [column, row] = place.map(|index| index as usize);
            let node = self.start(row) + column;
            let nodes = self.neighbours(column, row);
            let here = self.layers.surface[node];
            let falls = nodes.map(|node| here - self.layers.surface[node]);
            let turn = first_look(column, self.rows.first + row) % N;
            let Some(k) = self.stencil.steepest(&falls, turn) else { return };
            if self.layers.sand[node] <= 0.0 {
                return;
            }
            let next = self.step(place, k);
            let lower = self.start(next[1] as usize) + next[0] as usize;
            let step = here - self.layers.surface[lower];
            let amount = self.stencil.rule(k).slide(&mut self.layers, node, lower, step);
            self.slid.amount += amount;
            self.slid.slides += 1;
            self.slid.ends[0] |= place[1].min(next[1]) == 0;
            self.slid.ends[1] |= place[1].max(next[1]) == last;
            // Missing neighbours, for which the node itself stands, stay level with it.
            let lost = |at: usize| if nodes[at] == node { 0.0 } else { amount };
            let gained = |at: usize| if at == k { amount } else { 0.0 };
            let falls = std::array::from_fn(|at| falls[at] - lost(at) - gained(at));
            if self.stencil.is_steep(&falls) {
                self.list_around(place, &falls);
            }
            place = next;
        }
    }

    /// Lists a place that sand still slides down from, and those above that it slides from now.
    fn list_around(&mut self, place: Place, falls: &[f64; N]) {
        let (down, mut up) = self.stencil.steep(falls);
        if down {
            self.unstable.push(place);
        }
        while up != 0 {
            self.unstable.push(self.step(place, up.trailing_zeros() as usize));
            up &= up - 1;
        }
    }

    /// Indices of the neighbours of a node, in the order of [`STEPS`]; its own for those
    /// that it does not have in this band.
    #[inline]
    fn neighbours(&self, column: usize, row: usize) -> [usize; N] {
        let width = self.plane.width;
        let node = self.start(row) + column;
        let nodes_here = self.layers.surface.len() - width;
        let is_inside = column.wrapping_sub(1) < width.saturating_sub(2)
            && row.wrapping_sub(1) < self.rows.count.saturating_sub(2)
            && (width..nodes_here).contains(&node);
        if !is_inside {
            return self.neighbours_at_border(column, row);
        }
        let diagonal = self.has_diagonals(column, row);
        let [north, south] = [node - width, node + width];
        let all = [node + 1, north, node - 1, south, north + 1, north - 1, south - 1, south + 1];
        std::array::from_fn(|k| if k < 4 || diagonal { all[k] } else { node })
    }

    /// The same for nodes that may lie at the border of the band or of the layers at hand.
    #[cold]
    #[inline(never)]
    fn neighbours_at_border(&self, column: usize, row: usize) -> [usize; N] {
        let width = self.plane.width;
        let node = self.start(row) + column;
        let wraps = self.plane.wraps_columns;
        let east = if column + 1 < width { Some(column + 1) } else { wraps.then_some(0) };
        let west = if column > 0 { Some(column - 1) } else { wraps.then_some(width - 1) };
        let north = (row > 0).then(|| self.start(row.wrapping_sub(1)));
        let south = (row + 1 < self.rows.count).then(|| self.start(row + 1));
        let here = Some(node - column);
        let diagonal = self.has_diagonals(column, row);
        std::array::from_fn(|k| {
            let [columns, rows] = STEPS[k];
            let column = [west, Some(column), east][(columns + 1) as usize];
            let row = [north, here, south][(rows + 1) as usize];
            match (column, row) {
                (Some(column), Some(row)) if k < 4 || diagonal => row + column,
                _ => node,
            }
        })
    }

    /// Whether a node has diagonals, if any node has.
    #[inline]
    fn has_diagonals(&self, column: usize, row: usize) -> bool {
        !self.stencil.alternate || (column + self.rows.first + row).is_multiple_of(2)
    }

    /// The neighbour in direction `k`, which must be there.
    #[inline]
    fn step(&self, [column, row]: Place, k: usize) -> Place {
        let [columns, rows] = STEPS[k];
        let width = self.plane.width as u32;
        let column = match column.wrapping_add_signed(columns as i32) {
            u32::MAX => width - 1,
            end if end == width => 0,
            column => column,
        };
        [column, row.wrapping_add_signed(rows as i32)]
    }
}

/// Bits of the pairs of heights, at most 64, that differ by more than `trigger`.
#[inline]
fn steep(first: &[f64], second: &[f64], trigger: f64) -> u64 {
    let is_steep = |a: f64, b: f64| (a - b).abs() > trigger;
    let (first_groups, first_rest) = first.as_chunks::<GROUP>();
    let (second_groups, second_rest) = second.as_chunks::<GROUP>();
    let mut bits = 0;
    let mut bit = 0;
    for (first, second) in first_groups.iter().zip(second_groups) {
        // No branch: a guess whether any is steep would be wrong too often.
        let steep: [u64; GROUP] =
            std::array::from_fn(|at| if is_steep(first[at], second[at]) { 1 << at } else { 0 });
        bits |= steep.iter().fold(0, |all, one| all | one) << bit;
        bit += GROUP;
    }
    for (at, (&first, &second)) in first_rest.iter().zip(second_rest).enumerate() {
        bits |= u64::from(is_steep(first, second)) << (bit + at);
    }
    bits
}
