//! How much shore hangs together with a node within a radius.

use landform_graph::Lattice;

use super::Shore;
use super::compass::{SIDES, STEPS, diagonal, edges, left_of};
use super::shore_lines::{Line, ShoreLines, side_of};
use super::vicinity::Vicinity;

/// Places or boxes that a box covers.
const BRANCH: usize = 8;

/// Least and greatest column and row of a stretch of shore.
#[derive(Clone, Copy, Debug)]
struct Extent {
    low: [i32; 2],
    high: [i32; 2],
}

impl Extent {
    fn around<'a>(parts: impl Iterator<Item = (&'a [i32; 2], &'a [i32; 2])>) -> Self {
        let none = Self { low: [i32::MAX; 2], high: [i32::MIN; 2] };
        parts.fold(none, |all, (low, high)| Self {
            low: [all.low[0].min(low[0]), all.low[1].min(low[1])],
            high: [all.high[0].max(high[0]), all.high[1].max(high[1])],
        })
    }
}

/// A disc around a node.
#[derive(Clone, Copy, Debug)]
struct Disc {
    center: [i32; 2],
    squared_radius: i64,
}

impl Disc {
    #[inline]
    fn contains(&self, at: [i32; 2]) -> bool {
        let [x, y] = [0, 1].map(|axis| i64::from(at[axis] - self.center[axis]));
        x * x + y * y <= self.squared_radius
    }

    #[inline]
    fn contains_all(&self, extent: &Extent) -> bool {
        let farthest = |axis: usize| {
            let from = self.center[axis];
            (from - extent.low[axis]).max(extent.high[axis] - from)
        };
        self.contains([self.center[0] + farthest(0), self.center[1] + farthest(1)])
    }

    fn moved(self, by: [i32; 2]) -> Self {
        Self { center: [self.center[0] + by[0], self.center[1] + by[1]], ..self }
    }
}

/// A run of places of a line that hang together: up to two ranges, for runs over the seam of a
/// closed line.
#[derive(Clone, Copy, Debug, Default)]
struct Run([(usize, usize); 2]);

impl Run {
    fn contains(&self, place: usize) -> bool {
        self.0.iter().any(|&(start, end)| (start..end).contains(&place))
    }
}

/// The length of shore that hangs together with a coast node within a radius (equation 4.2 by
/// contiguous search).
///
/// From each side of the node at sea the shore is followed both ways until it first leaves the
/// disc around the node. What is found from several sides counts once. A node that meets the sea
/// across a corner only starts from the shore at that corner.
///
/// Boxes around 8, 64, 512, ... places let a search pass over all shore that surely stays in the
/// disc: the cost of a search grows with the logarithm of what it finds.
#[derive(Clone, Debug)]
pub(super) struct Arcs {
    lines: ShoreLines,
    squared_radius: i64,
    /// Where the latest refresh may have changed what is found.
    changed: Vicinity,
    /// Length in parts of the shore before each place.
    before: Vec<u64>,
    boxes: Vec<Vec<Extent>>,
}

impl Arcs {
    /// Searches within `radius` spacings.
    pub(super) fn new(lattice: &Lattice, radius: f64) -> Self {
        Self {
            lines: ShoreLines::new(lattice.node_count()),
            squared_radius: (radius * radius) as i64,
            changed: Vicinity::everywhere(lattice, radius),
            before: Vec::new(),
            boxes: Vec::new(),
        }
    }

    /// Makes the lines follow the shore; `coast` as for [`ShoreLines::trace`].
    pub(super) fn refresh(&mut self, shore: &Shore, coast: &[u32]) {
        self.changed.spread();
        self.lines.trace(shore, coast);
        let at = self.lines.at();
        self.before.clear();
        let mut sum = 0;
        for place in 0..at.len() {
            self.before.push(sum);
            let side = self.lines.side(place);
            let node = (side / 4) as usize;
            sum += u64::from(shore.side_lengths(node, shore.place(node))[(side % 4) as usize]);
        }
        self.before.push(sum);
        self.boxes.clear();
        let places = |places: &[[i32; 2]]| Extent::around(places.iter().map(|at| (at, at)));
        let mut boxes: Vec<Extent> = at.chunks_exact(BRANCH).map(places).collect();
        let all = |all: &[Extent]| Extent::around(all.iter().map(|one| (&one.low, &one.high)));
        while !boxes.is_empty() {
            let above = boxes.chunks_exact(BRANCH).map(all).collect();
            self.boxes.push(std::mem::replace(&mut boxes, above));
        }
    }

    /// Forgets where the shore changed before.
    pub(super) fn forget_changes(&mut self) {
        self.changed.clear();
    }

    /// The shore changes everywhere.
    pub(super) fn change_all(&mut self) {
        self.changed.fill();
    }

    /// The shore at a place changes, or the strength of its node.
    pub(super) fn change(&mut self, at: [usize; 2]) {
        self.changed.change(at);
    }

    /// Whether the latest changes may concern the node at a place. A node that withstood the sea
    /// before and is none of these withstands it again.
    pub(super) fn may_differ(&self, at: [usize; 2]) -> bool {
        self.changed.contains(at)
    }

    /// Length in parts of the shore that hangs together with a coast node within the radius.
    pub(super) fn length(&self, shore: &Shore, node: usize) -> u64 {
        let mut runs = [Run::default(); 4];
        let mut length = 0;
        let mut found = 0;
        self.each_anchor(shore, node, |place, step| {
            if runs[..found].iter().any(|run| run.contains(place)) {
                return;
            }
            let at = self.lines.at()[place];
            let center = [at[0] - step[0] as i32, at[1] - step[1] as i32];
            let disc = Disc { center, squared_radius: self.squared_radius };
            let run = self.run(place, disc);
            length += run.0.iter().map(|&(s, e)| self.before[e] - self.before[s]).sum::<u64>();
            runs[found] = run;
            found += 1;
        });
        length
    }

    /// Names the places from which a node's search starts, and the steps to their land nodes.
    fn each_anchor(&self, shore: &Shore, node: usize, mut visit: impl FnMut(usize, [isize; 2])) {
        let around = shore.around(node);
        let is_sea = |direction: usize| around >> direction & 1 == 1;
        if around & SIDES != 0 {
            (0..4)
                .filter(|&side| is_sea(side))
                .for_each(|side| visit(self.lines.place(side_of(node, side)), [0, 0]));
            return;
        }
        let at = shore.place(node);
        let edges = edges(shore.lattice(), at);
        for (side, step) in STEPS.into_iter().take(4).enumerate() {
            let corner = diagonal(side);
            if is_sea(corner) && edges >> corner & 1 == 1 {
                let land = shore.lattice().offset([at[0], at[1], 0], [step[0], step[1], 0]);
                if let Some(land) = land {
                    visit(self.lines.place(side_of(land, left_of(side))), step);
                }
            }
        }
    }

    /// The places around `place` until the line first leaves the disc, each way.
    fn run(&self, place: usize, disc: Disc) -> Run {
        let line = self.lines.line_of(place);
        let Line { start, end, closed, winding } = line;
        let high = self.first_outside(place + 1, end, disc);
        let mut over_end = start;
        if high == end && closed {
            over_end = self.first_outside(start, place, disc.moved(winding.map(|by| -by)));
        }
        let low = self.after_last_outside(start, place, disc);
        let mut over_start = end;
        if low == start && closed {
            over_start = self.after_last_outside(place + 1, end, disc.moved(winding));
        }
        let count = (high - low) + (over_end - start) + (end - over_start);
        if count >= end - start {
            return Run([(start, end), (0, 0)]);
        }
        // Only one of both reaches over the seam: the whole line would be found otherwise.
        let other = if over_end > start { (start, over_end) } else { (over_start, end) };
        Run([(low, high), other])
    }

    /// The first place in `from..end` that is not in the disc; `end` when all are.
    fn first_outside(&self, from: usize, end: usize, disc: Disc) -> usize {
        let at = self.lines.at();
        let mut place = from;
        while place < end {
            let mut passed = 0;
            let mut size = BRANCH;
            for boxes in &self.boxes {
                let fits = place.is_multiple_of(size) && place + size <= end;
                if !fits || !disc.contains_all(&boxes[place / size]) {
                    break;
                }
                passed = size;
                size *= BRANCH;
            }
            match passed {
                0 if !disc.contains(at[place]) => return place,
                0 => place += 1,
                passed => place += passed,
            }
        }
        end
    }

    /// The place after the last one in `start..end` that is not in the disc; `start` when all are.
    fn after_last_outside(&self, start: usize, end: usize, disc: Disc) -> usize {
        let at = self.lines.at();
        let mut place = end;
        while place > start {
            let mut passed = 0;
            let mut size = BRANCH;
            for boxes in &self.boxes {
                let fits = place.is_multiple_of(size) && place - start >= size;
                if !fits || !disc.contains_all(&boxes[place / size - 1]) {
                    break;
                }
                passed = size;
                size *= BRANCH;
            }
            match passed {
                0 if !disc.contains(at[place - 1]) => return place,
                0 => place -= 1,
                passed => place -= passed,
            }
        }
        start
    }
}
