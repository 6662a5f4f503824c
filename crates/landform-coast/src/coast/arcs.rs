//! How much shore hangs together with a node within a radius.

use landform_graph::Lattice;

use super::Shore;
use super::compass::{STEPS, diagonal, edges, left_of};
use super::concerned::Concerned;
use super::marks::Marks;
use super::shore_lines::ShoreLines;
use super::stretch::{NOWHERE, Stretch, stretch_of};

/// A disc around a node, as a stretch of shore has its places.
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
    fn contains_all(&self, stretch: &Stretch) -> bool {
        let farthest = |axis: usize| {
            let from = self.center[axis];
            (from - stretch.low[axis]).max(stretch.high[axis] - from)
        };
        self.contains([self.center[0] + farthest(0), self.center[1] + farthest(1)])
    }

    fn moved(self, [x, y]: [i32; 2]) -> Self {
        Self { center: [self.center[0] + x, self.center[1] + y], ..self }
    }
}

/// The places from which a node's search starts, and the steps to their land nodes.
#[derive(Clone, Copy, Debug, Default)]
struct Anchors {
    count: usize,
    places: [u32; 4],
    steps: [[i32; 2]; 4],
    /// Whether what hangs together with each of them is counted.
    is_counted: [bool; 4],
}

impl Anchors {
    fn push(&mut self, place: u32, step: [isize; 2]) {
        self.places[self.count] = place;
        self.steps[self.count] = step.map(|along| along as i32);
        self.count += 1;
    }

    /// Sides `from..to` of a stretch are counted.
    #[inline]
    fn count(&mut self, number: u32, from: usize, to: usize) {
        for anchor in 0..self.count {
            let (stretch, index) = stretch_of(self.places[anchor]);
            self.is_counted[anchor] |= stretch == number && (from..to).contains(&index);
        }
    }
}

/// The length of shore that hangs together with a coast node within a radius (equation 4.2 by
/// contiguous search).
///
/// From each side of the node at sea the shore is followed both ways until it first leaves the
/// disc around the node. What is found from several sides counts once. A node that meets the sea
/// across a corner only starts from the shore at that corner.
///
/// A search passes at once over each stretch of shore that surely stays in the disc.
#[derive(Clone, Debug)]
pub(super) struct Arcs {
    lines: ShoreLines,
    squared_radius: i64,
    /// Width of the squares in which nodes that fall together are one change.
    square: usize,
    concerned: Concerned,
    /// Middles of the squares where nodes fell since the latest refresh.
    fallen: Vec<[usize; 2]>,
    /// Whether everything has changed since then.
    all: bool,
}

/// How far a node that falls changes the shore: to the nodes around it.
const AROUND: f64 = 1.5;

/// Squares that a radius has room for, in which nodes that fall together are one change.
const SQUARES: f64 = 12.0;

impl Arcs {
    /// Searches within `radius` spacings.
    pub(super) fn new(lattice: &Lattice, radius: f64) -> Self {
        let square = ((radius / SQUARES) as usize).max(1);
        // From the middle of a square to its farthest node.
        let away = (square / 2) as f64 * std::f64::consts::SQRT_2;
        Self {
            lines: ShoreLines::default(),
            squared_radius: (radius * radius) as i64,
            square,
            concerned: Concerned::new(lattice, radius + AROUND + away),
            fallen: Vec::new(),
            all: true,
        }
    }

    /// A coast node that may fall, or not, has a strength.
    pub(super) fn strength(&mut self, at: [usize; 2], may_fall: bool) {
        self.concerned.set(at, may_fall);
    }

    /// The force changes everywhere.
    pub(super) fn change_all(&mut self) {
        self.all = true;
    }

    /// A coast node falls, whose sides had these places.
    pub(super) fn fall(&mut self, at: [usize; 2], places: [u32; 4]) {
        self.lines.cut(places);
        self.concerned.set(at, false);
        let size = self.concerned.size();
        let middle = |axis: usize| at[axis] / self.square * self.square + self.square / 2;
        let middle = [0, 1].map(|axis| middle(axis).min(size[axis] - 1));
        self.fallen.push(middle);
    }

    /// What lies around a land node changes.
    pub(super) fn touch(&mut self, node: usize) {
        self.lines.loosen(node);
    }

    /// Makes the lines follow the shore, and finds out which nodes that concerns.
    pub(super) fn refresh(&mut self, shore: &Shore, marks: &mut Marks) {
        self.lines.refresh(shore, marks);
        // Only now it is known which nodes may fall.
        self.fallen.sort_unstable();
        self.fallen.dedup();
        self.fallen.drain(..).for_each(|at| self.concerned.change(at));
        if std::mem::take(&mut self.all) {
            self.concerned.change_all();
        }
    }

    /// Names the coast nodes that may fall and that the latest changes may concern.
    pub(super) fn take_concerned(&mut self, visit: impl FnMut(usize)) {
        self.concerned.take(visit);
    }

    /// Length in parts of the shore that hangs together with a coast node within the radius.
    pub(super) fn length(&self, shore: &Shore, marks: &Marks, node: usize) -> u64 {
        let mut anchors = anchors(shore, marks, node);
        let mut length = 0;
        for anchor in 0..anchors.count {
            if !anchors.is_counted[anchor] {
                length += self.run(anchor, &mut anchors);
            }
        }
        length
    }

    /// Length of the shore around an anchor until it first leaves the disc, each way.
    fn run(&self, anchor: usize, anchors: &mut Anchors) -> u64 {
        let place = anchors.places[anchor];
        let (number, index) = stretch_of(place);
        let [x, y] = self.lines.stretch(number).at[index];
        let [east, south] = anchors.steps[anchor];
        let disc = Disc { center: [x - east, y - south], squared_radius: self.squared_radius };
        anchors.count(number, index, index + 1);
        let own = self.lines.stretch(number).length(index, index + 1);
        let (forth, end) = self.forth(place, disc, anchors);
        own + forth + self.back(place, end, disc, anchors)
    }

    /// Length from the side after a place on, and the place where that ends: of the first side
    /// that is not in the disc, or of the beginning when the line comes back to it.
    fn forth(&self, place: u32, mut disc: Disc, anchors: &mut Anchors) -> (u64, (u32, usize)) {
        let (begin, index) = stretch_of(place);
        let (mut number, mut from) = (begin, index + 1);
        let mut is_back = false;
        let mut length = 0;
        loop {
            let stretch = self.lines.stretch(number);
            let to = if is_back { index } else { stretch.count };
            let end = first_outside(stretch, from, to, disc);
            length += stretch.length(from, end);
            anchors.count(number, from, end);
            if end < to || is_back || stretch.next == NOWHERE {
                return (length, (number, end));
            }
            disc = disc.moved(stretch.shift.map(|along| -along));
            (number, from) = (stretch.next, 0);
            is_back = number == begin;
        }
    }

    /// Length up to the side before a place, back to `end` at most, which was found the other way.
    fn back(&self, place: u32, end: (u32, usize), mut disc: Disc, anchors: &mut Anchors) -> u64 {
        let (mut number, mut to) = stretch_of(place);
        let mut length = 0;
        // The way forth may have ended behind the place, after all other stretches.
        let mut is_met = end.0 == number && end.1 <= to;
        loop {
            let stretch = self.lines.stretch(number);
            let from = if is_met { end.1 } else { 0 };
            let begin = after_last_outside(stretch, from, to, disc);
            length += stretch.length(begin, to);
            anchors.count(number, begin, to);
            if begin > from || is_met || stretch.previous == NOWHERE {
                return length;
            }
            number = stretch.previous;
            let stretch = self.lines.stretch(number);
            disc = disc.moved(stretch.shift);
            to = stretch.count;
            is_met = number == end.0;
        }
    }
}

/// The first side in `from..to` that is not in the disc; `to` when all are.
#[inline]
fn first_outside(stretch: &Stretch, from: usize, to: usize, disc: Disc) -> usize {
    if disc.contains_all(stretch) {
        return to;
    }
    (from..to).find(|&index| !disc.contains(stretch.at[index])).unwrap_or(to)
}

/// The side after the last one in `from..to` that is not in the disc; `from` when all are.
#[inline]
fn after_last_outside(stretch: &Stretch, from: usize, to: usize, disc: Disc) -> usize {
    if disc.contains_all(stretch) {
        return from;
    }
    let last = (from..to).rev().find(|&index| !disc.contains(stretch.at[index]));
    last.map_or(from, |index| index + 1)
}

/// Where the search of a node starts: at its own sides, or at those by its corners.
fn anchors(shore: &Shore, marks: &Marks, node: usize) -> Anchors {
    let mut anchors = Anchors::default();
    let places = |node: usize| marks.slot(node).map_or([NOWHERE; 4], |slot| marks.places[slot]);
    // Sides at sea have places.
    let own = places(node).into_iter().filter(|&place| place != NOWHERE);
    own.for_each(|place| anchors.push(place, [0, 0]));
    if anchors.count > 0 {
        return anchors;
    }
    let at = shore.place(node);
    let corners = shore.around(node) & edges(shore.lattice(), at);
    for (side, step) in STEPS.into_iter().take(4).enumerate() {
        if corners >> diagonal(side) & 1 == 1 {
            let land = shore.lattice().offset([at[0], at[1], 0], [step[0], step[1], 0]);
            if let Some(land) = land {
                anchors.push(places(land)[left_of(side)], step);
            }
        }
    }
    anchors
}
