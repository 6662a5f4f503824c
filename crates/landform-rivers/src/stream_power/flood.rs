//! A priority flood from chosen outlets, over borders that may close on themselves.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use landform_graph::Lattice;

/// Level of all lakes when they are full, and a way out for every node.
///
/// The algorithm is that of [`landform_analysis::hydrology::fill_depressions`], which knows gaps and
/// oblong cells where this one knows outlets, walls, periodic borders and ways: the flood enters at the
/// outlets and takes nodes from the lowest level upwards; what it climbs to is done at once, and only
/// nodes that it may spill over wait on a heap. All nodes that spill at one level do so together, so
/// that water crosses lakes and flats by the fewest steps.
#[derive(Clone, Debug)]
pub(super) struct Flood {
    /// Water level, or height of the ground where it is dry.
    pub levels: Vec<f64>,
    /// For each node the direction to the one that it was reached from, which is not higher.
    pub ways: Vec<u8>,
    /// [`REACHED`] and [`BORDER`] by node.
    marks: Vec<u8>,
    /// What each step adds to the index of an inner node.
    offsets: [usize; 8],
    /// Nodes that the flood may spill over, lowest first.
    spills: BinaryHeap<Reverse<(u64, u32)>>,
    /// Nodes at the level of the flood.
    pond: Vec<u32>,
    /// Nodes above it to go on from.
    climb: Vec<u32>,
    /// Nodes climbed to that had a dry neighbour not above them.
    rims: Vec<u32>,
}

const REACHED: u8 = 1;
const BORDER: u8 = 2;

impl Flood {
    /// Bytes a node.
    pub const BYTES: usize = 22;

    pub fn new(lattice: &Lattice) -> Self {
        let mark = |node: usize| match lattice.is_interior(lattice.coordinates(node)) {
            true => 0,
            false => BORDER,
        };
        let count = lattice.node_count();
        Self {
            levels: vec![0.0; count],
            ways: vec![0; count],
            marks: (0..count).map(mark).collect(),
            offsets: Self::offsets(lattice),
            spills: BinaryHeap::new(),
            pond: Vec::new(),
            climb: Vec::new(),
            rims: Vec::new(),
        }
    }

    /// What each of the eight steps adds to the index of an inner node, wrapping.
    pub fn offsets(lattice: &Lattice) -> [usize; 8] {
        let [east, south] = [1, lattice.width()];
        let [west, north] = [east, south].map(usize::wrapping_neg);
        let diagonals = [(north, east), (north, west), (south, west), (south, east)];
        let [north_east, north_west, south_west, south_east] =
            diagonals.map(|(along, across)| along.wrapping_add(across));
        [east, north, west, south, north_east, north_west, south_west, south_east]
    }

    /// Floods the ground from the outlets.
    pub fn run(&mut self, lattice: &Lattice, heights: &[f64], outlets: &[usize]) {
        self.levels.copy_from_slice(heights);
        self.marks.iter_mut().for_each(|mark| *mark &= !REACHED);
        for &outlet in outlets {
            self.marks[outlet] |= REACHED;
            self.wait(outlet);
        }
        while let Some(Reverse((key, node))) = self.spills.pop() {
            self.pond.push(node);
            while self.spills.peek().is_some_and(|Reverse((next, _))| *next == key) {
                self.pond.extend(self.spills.pop().map(|Reverse((_, node))| node));
            }
            self.spread(lattice);
        }
    }

    /// Puts a node on the heap.
    fn wait(&mut self, node: usize) {
        self.spills.push(Reverse((order_key(self.levels[node]), node as u32)));
    }

    /// Spreads from the pond as far as water stands, and climbs from there as far as it goes.
    fn spread(&mut self, lattice: &Lattice) {
        let mut done = 0;
        while let Some(&node) = self.pond.get(done) {
            done += 1;
            self.visit::<true>(lattice, node as usize);
            while let Some(node) = self.climb.pop() {
                if self.visit::<false>(lattice, node as usize) {
                    self.rims.push(node);
                }
            }
        }
        self.pond.clear();
        let mut rims = std::mem::take(&mut self.rims);
        for &rim in &rims {
            if self.has_dry_neighbour(lattice, rim as usize) {
                self.wait(rim as usize);
            }
        }
        rims.clear();
        self.rims = rims;
    }

    /// Reaches the dry neighbours of a node. Those not above it become part of the `POND`, or are left
    /// dry if the node lies above the flood; returns whether any were.
    #[inline]
    fn visit<const POND: bool>(&mut self, lattice: &Lattice, node: usize) -> bool {
        let mut left = false;
        if self.marks[node] & BORDER == 0 {
            for direction in 0..8 {
                let next = node.wrapping_add(self.offsets[direction]);
                left |= self.reach::<POND>(node, direction as u8, next);
            }
        } else {
            for edge in lattice.neighbours(node) {
                left |= self.reach::<POND>(node, edge.direction, edge.node);
            }
        }
        left
    }

    #[inline(always)]
    fn reach<const POND: bool>(&mut self, node: usize, direction: u8, next: usize) -> bool {
        if self.marks[next] & REACHED != 0 {
            return false;
        }
        if self.levels[next] > self.levels[node] {
            self.climb.push(next as u32);
        } else if POND {
            self.levels[next] = self.levels[node];
            self.pond.push(next as u32);
        } else {
            return true;
        }
        self.marks[next] |= REACHED;
        self.ways[next] = opposite(direction);
        false
    }

    /// Whether a node has a neighbour that was not reached.
    fn has_dry_neighbour(&self, lattice: &Lattice, node: usize) -> bool {
        let dry = |next: usize| self.marks[next] & REACHED == 0;
        match self.marks[node] & BORDER {
            0 => self.offsets.iter().any(|&offset| dry(node.wrapping_add(offset))),
            _ => lattice.neighbours(node).any(|edge| dry(edge.node)),
        }
    }
}

/// Integers in the order of the numbers that they stand for; both zeros are one number.
fn order_key(height: f64) -> u64 {
    let bits = (height + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

/// The direction back: E and W, N and S, NE and SW, NW and SE.
pub(super) fn opposite(direction: u8) -> u8 {
    direction & 4 | (direction + 2) & 3
}
