//! One sweep over families of edges: which rows and edges to look at, serially or in parallel.

use rayon::prelude::*;

use super::avalanche::{Family, Layers, Part};
use super::plane::Plane;

/// Nodes in a tile, a piece of a row: one word of a bit set.
const TILE: usize = 64;

/// Edges that are compared at once.
const GROUP: usize = 8;

/// Edges of a tile from which it costs less to compare all of its edges than just these.
const MANY: u32 = 24;

/// Nodes in rows with changes from which a family is worth several threads.
const PARALLEL_NODES: usize = 1 << 15;

/// What slid: the sum of thickness in metres, and the number of slides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Slid {
    pub amount: f64,
    pub slides: u64,
}

/// What changed when: scratch of a pass of avalanches.
///
/// Sweeps are numbered. Every family sweeps once a round, so what it has not seen yet changed
/// in the sweeps since its last one: as many as there are families, in this round or the last.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    /// Sweep that last changed each tile.
    tiles: Vec<u32>,
    /// Sweep that last changed each row.
    rows: Vec<u32>,
    /// Nodes that changed in this round and in the last, a bit each: even rounds, odd rounds.
    nodes: Vec<[u64; 2]>,
    /// What slid in each row in the sweep under way.
    slid: Vec<Slid>,
    /// Columns of the edges of a row that are too steep.
    steep: Vec<[u32; 2]>,
}

impl Changes {
    /// Everything has changed, in a sweep just before the first, whose number this gives.
    pub fn start(&mut self, plane: &Plane, families: usize) -> u32 {
        let first = families as u32;
        let tiles = plane.width.div_ceil(TILE) * plane.height;
        renew(&mut self.tiles, tiles, first);
        renew(&mut self.rows, plane.height, first);
        renew(&mut self.slid, plane.height, Slid::default());
        renew(&mut self.nodes, tiles, [0; 2]);
        first
    }

    /// Forgets the nodes that changed in the round before the last.
    pub fn start_round(&mut self, round: u32, now: u32, families: u32) {
        let count = self.tiles.len() / self.rows.len();
        for (nodes, &changed) in self.nodes.chunks_mut(count).zip(&self.rows) {
            if changed + 2 * families >= now {
                nodes.iter_mut().for_each(|nodes| nodes[round as usize % 2] = 0);
            }
        }
    }
}

/// Makes a list of `length` equal values in place.
fn renew<T: Clone>(list: &mut Vec<T>, length: usize, value: T) {
    list.clear();
    list.resize(length, value);
}

/// One sweep over the edges of families that share rows, or pairs of rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep<'a> {
    pub plane: &'a Plane,
    pub group: &'a [Family],
    /// Number of the round; the first one looks at every edge.
    pub round: u32,
    /// Number of the first family's sweep; those of the others follow.
    pub now: u32,
    /// Number of all families.
    pub families: u32,
}

impl Sweep<'_> {
    /// Sweeps and says what slid.
    pub fn run(&self, layers: &mut Layers<'_>, changes: &mut Changes) -> Slid {
        let mut total = Slid::default();
        let due = self.rows().filter(|&row| self.is_due(row, &changes.rows)).count();
        if due == 0 {
            return total;
        }
        let closing = self.group[0].rows == 1 && self.group[0].part == Part::Closing;
        if closing || due * self.plane.width < PARALLEL_NODES {
            self.run_serially(layers, changes);
        } else {
            self.run_in_parallel(layers, changes);
        }
        let last = self.now + self.group.len() as u32 - 1;
        for row in self.rows() {
            let slid = std::mem::take(&mut changes.slid[row]);
            if slid.slides > 0 {
                total.amount += slid.amount;
                total.slides += slid.slides;
                changes.rows[row] = last;
                changes.rows[self.end(row)] = last;
            }
        }
        total
    }

    /// Rows that edges start in, in order.
    fn rows(&self) -> std::iter::StepBy<std::ops::Range<usize>> {
        let height = self.plane.height;
        match (self.group[0].rows, self.group[0].part) {
            (0, _) => (0..height).step_by(1),
            (_, Part::Even) => (0..height - 1).step_by(2),
            (_, Part::Odd) => (1..(height - 1).max(1)).step_by(2),
            (_, Part::Closing) => (height - 1..height).step_by(1),
        }
    }

    /// The row that edges from `row` end in.
    fn end(&self, row: usize) -> usize {
        (row + self.group[0].rows) % self.plane.height
    }

    /// Whether something changed in a row or the row that its edges end in since the last
    /// sweep of the first family.
    fn is_due(&self, row: usize, rows: &[u32]) -> bool {
        rows[row].max(rows[self.end(row)]) > self.now - self.families
    }

    fn run_serially(&self, layers: &mut Layers<'_>, changes: &mut Changes) {
        let width = self.plane.width;
        let count = width.div_ceil(TILE);
        let Changes { tiles, rows, nodes, slid, steep } = changes;
        for row in self.rows().filter(|&row| self.is_due(row, rows)) {
            let end = self.end(row);
            let [from, to] = [row * width, end * width];
            let mut marks = Marks { tiles, nodes, from: row * count, to: end * count, steep };
            slid[row] = self.sweep_row([row, from, to], layers, &mut marks);
        }
    }

    fn run_in_parallel(&self, layers: &mut Layers<'_>, changes: &mut Changes) {
        let width = self.plane.width;
        let count = width.div_ceil(TILE);
        // Rows come singly, or in pairs from the first or the second row on.
        let taken = self.group[0].rows + 1;
        let first = usize::from(self.group[0].rows == 1 && self.group[0].part == Part::Odd);
        let Changes { tiles, rows, nodes, slid, .. } = changes;
        let fields = layers.sand[first * width..]
            .par_chunks_mut(taken * width)
            .zip(layers.surface[first * width..].par_chunks_mut(taken * width))
            .zip(layers.bed[first * width..].par_chunks(taken * width));
        let marks = tiles[first * count..]
            .par_chunks_mut(taken * count)
            .zip(nodes[first * count..].par_chunks_mut(taken * count))
            .zip(slid[first..].par_chunks_mut(taken));
        fields.zip(marks).enumerate().for_each_init(
            Vec::new,
            |steep, (number, (fields, marks))| {
                let ((sand, surface), bed) = fields;
                let ((tiles, nodes), slid) = marks;
                let row = first + number * taken;
                if slid.len() < taken || !self.is_due(row, rows) {
                    return;
                }
                let to = self.group[0].rows;
                let mut marks = Marks { tiles, nodes, from: 0, to: to * count, steep };
                let mut layers = Layers { bed, sand, surface };
                slid[0] = self.sweep_row([row, 0, to * width], &mut layers, &mut marks);
            },
        );
    }

    /// Sweeps the edges of all families that start in a row. `from` and `to` are the first
    /// nodes, in the layers at hand, of the rows that edges start and end in.
    fn sweep_row(
        &self,
        [row, from, to]: [usize; 3],
        layers: &mut Layers<'_>,
        marks: &mut Marks<'_>,
    ) -> Slid {
        let mut total = Slid::default();
        for (family, now) in self.group.iter().zip(self.now..) {
            let edges = EdgeRow { sweep: self, family, now, row, from, to };
            let slid = edges.sweep(layers, marks);
            total.amount += slid.amount;
            total.slides += slid.slides;
        }
        total
    }
}

/// The marks of the rows that one task sweeps.
struct Marks<'a> {
    /// When each tile changed.
    tiles: &'a mut [u32],
    /// Nodes that changed in this round and in the last.
    nodes: &'a mut [[u64; 2]],
    /// Index of the first tile of the row that edges start in.
    from: usize,
    /// Index of the first tile of the row that edges end in.
    to: usize,
    /// Columns of the edges of a row that are too steep: scratch.
    steep: &'a mut Vec<[u32; 2]>,
}

/// The edges of a family that start in one row.
#[derive(Clone, Copy, Debug)]
struct EdgeRow<'a> {
    sweep: &'a Sweep<'a>,
    family: &'a Family,
    /// Number of the family's sweep.
    now: u32,
    /// The row that the edges start in.
    row: usize,
    /// Index of the first node of this row, and of the row that they end in, in the layers at
    /// hand.
    from: usize,
    to: usize,
}

impl EdgeRow<'_> {
    /// Sweeps the row, except for tiles where nothing changed.
    ///
    /// Edges of a family share no node, so those that are too steep may all be listed before
    /// any sand slides. The slides then follow one another without a branch that the
    /// processor could guess wrongly, and their memory is fetched in parallel.
    fn sweep(&self, layers: &mut Layers<'_>, marks: &mut Marks<'_>) -> Slid {
        let count = self.sweep.plane.width.div_ceil(TILE);
        let closing = self.closing();
        marks.steep.clear();
        for tile in 0..count {
            let beside = self.beside(tile, count);
            let ends = [marks.from + tile, marks.to + tile, marks.to + beside];
            if !ends.iter().any(|&end| marks.tiles[end] > self.now - self.sweep.families) {
                continue;
            }
            let mut steep = match self.sweep.round {
                0 => self.steep(layers.surface, tile) & self.starts(tile),
                _ => {
                    let changed = self.changed(marks.nodes, ends) & self.starts(tile);
                    self.steep_of(layers.surface, tile, changed)
                }
            };
            while steep != 0 {
                let column = tile * TILE + steep.trailing_zeros() as usize;
                steep &= steep - 1;
                let end = column.wrapping_add_signed(self.family.columns);
                marks.steep.push([column as u32, end as u32]);
            }
            if let Some(edge) = closing.filter(|edge| edge[0] / TILE == tile) {
                marks.steep.push(edge.map(|column| column as u32));
            }
        }
        self.slide(layers, marks)
    }

    /// The other tile that edges from `tile` may end in.
    fn beside(&self, tile: usize, count: usize) -> usize {
        match self.family.columns {
            1 if tile + 1 == count => 0,
            1 => tile + 1,
            -1 if tile == 0 => count - 1,
            -1 => tile - 1,
            _ => tile,
        }
    }

    /// Bits of the columns of a tile where edges of the family start, but for an edge that
    /// closes the row.
    fn starts(&self, tile: usize) -> u64 {
        const EVEN: u64 = 0x5555_5555_5555_5555;
        let family = self.family;
        let kind = match (family.rows, family.part) {
            (0, Part::Even) => EVEN,
            (0, Part::Odd) => !EVEN,
            (0, Part::Closing) => 0,
            _ if family.even_nodes => EVEN << (self.row % 2),
            _ => u64::MAX,
        };
        let inner = self.inner(tile);
        let below = |column: usize| match column - tile * TILE {
            TILE => u64::MAX,
            bit => (1 << bit) - 1,
        };
        kind & below(inner.end) & !below(inner.start)
    }

    /// Columns of a tile from which a step stays in the row.
    fn inner(&self, tile: usize) -> std::ops::Range<usize> {
        let columns = self.family.columns;
        let first = (tile * TILE).max(usize::from(columns < 0));
        let last = ((tile + 1) * TILE).min(self.sweep.plane.width - usize::from(columns > 0));
        first..last.max(first)
    }

    /// Bits of the edges of a tile that are too steep. Edges of other parts may be among them.
    fn steep(&self, surface: &[f64], tile: usize) -> u64 {
        let trigger = self.family.rule.trigger();
        let inner = self.inner(tile);
        let first = &surface[self.from + inner.start..self.from + inner.end];
        let end = (self.to + inner.start).wrapping_add_signed(self.family.columns);
        let second = &surface[end..end + inner.len()];
        let is_steep = |a: f64, b: f64| (a - b).abs() > trigger;
        let (first_groups, first_rest) = first.as_chunks::<GROUP>();
        let (second_groups, second_rest) = second.as_chunks::<GROUP>();
        let mut bits = 0;
        let mut bit = inner.start - tile * TILE;
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

    /// Bits of the edges of a tile with an end that changed in this round or the last. `ends`
    /// are the tile, the tile that straight edges end in, and the one beside that.
    fn changed(&self, nodes: &[[u64; 2]], ends: [usize; 3]) -> u64 {
        let [start, end, beside] = ends.map(|end| nodes[end][0] | nodes[end][1]);
        start
            | match self.family.columns {
                1 => end >> 1 | beside << 63,
                -1 => end << 1 | beside >> 63,
                _ => end,
            }
    }

    /// Those of some edges of a tile that are too steep. Sorting them out first, without a
    /// branch, costs less than to guess wrongly at every edge.
    fn steep_of(&self, surface: &[f64], tile: usize, mut edges: u64) -> u64 {
        if edges.count_ones() >= MANY {
            return self.steep(surface, tile) & edges;
        }
        let trigger = self.family.rule.trigger();
        let first = &surface[self.from..];
        let second = &surface[self.to..];
        let mut steep = 0;
        while edges != 0 {
            let bit = edges.trailing_zeros();
            edges &= edges - 1;
            let column = tile * TILE + bit as usize;
            let end = column.wrapping_add_signed(self.family.columns);
            steep |= u64::from((first[column] - second[end]).abs() > trigger) << bit;
        }
        steep
    }

    /// Columns of the edge that closes the row, if the family has one.
    fn closing(&self) -> Option<[usize; 2]> {
        let Self { sweep: Sweep { plane, .. }, family, .. } = self;
        let last = plane.width - 1;
        let (from, to) = if family.columns > 0 { (last, 0) } else { (0, last) };
        let has_one = plane.wraps_columns
            && family.columns != 0
            && (family.rows == 1 || family.part == Part::Closing)
            && (!family.even_nodes || (from + self.row).is_multiple_of(2));
        has_one.then_some([from, to])
    }

    /// Lets sand slide along the edges that were listed, and marks what changed.
    fn slide(&self, layers: &mut Layers<'_>, marks: &mut Marks<'_>) -> Slid {
        let round = self.sweep.round as usize % 2;
        let mut total = Slid::default();
        for edge in &*marks.steep {
            let [first, second] = edge.map(|column| column as usize);
            let amount = self.family.rule.slide(layers, self.from + first, self.to + second);
            if amount > 0.0 {
                total.amount += amount;
                total.slides += 1;
                for (tiles, column) in [(marks.from, first), (marks.to, second)] {
                    let tile = tiles + column / TILE;
                    marks.tiles[tile] = self.now;
                    marks.nodes[tile][round] |= 1 << (column % TILE);
                }
            }
        }
        total
    }
}
