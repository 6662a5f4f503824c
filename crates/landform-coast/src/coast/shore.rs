//! Where land meets the sea: what surrounds a node, how exposed it is, how much shore it has.

use landform_graph::Lattice;

use super::compass::{STEPS, beside, diagonal, edges, left_of, opposite, right_of};

/// Parts into which a spacing is divided when shores are measured: lengths are whole numbers of
/// parts, so that sums are exact and free of order.
pub const PARTS: u32 = 512;

/// Half a spacing of straight shore, in parts.
const HALF_STRAIGHT: u16 = 256;

/// Half of the shore across a corner, the square root of 1/8 of a spacing, in parts.
const HALF_CORNER: u16 = 181;

/// A length in parts as a number of spacings.
pub fn spacings(parts: u64) -> f64 {
    parts as f64 / f64::from(PARTS)
}

/// What surrounds each node of a lattice, kept up to date while land falls to the sea.
///
/// The shore runs midway between land and sea. Over the four nodes of a square it is straight
/// when two of them beside each other are land, and cuts the corner otherwise (marching squares;
/// thesis, figure B.2). Each side of a land node that faces the sea has half of the shore in
/// the two squares at its ends: their sum is the length that a coast mark stores. Beyond open
/// borders lies what lies at them, so that the shore meets borders at right angles.
///
/// Memory: 4 bytes a node.
#[derive(Clone, Debug)]
pub struct Shore {
    lattice: Lattice,
    spots: Vec<Spot>,
    total: u64,
    table: [[u16; 4]; 256],
}

/// What is known of a node; together, because it is needed together.
#[derive(Clone, Copy, Debug, Default)]
struct Spot {
    /// Shore in parts; zero at sea.
    length: u16,
    /// Which of the eight nodes around are sea, one bit a direction; nodes beyond an open
    /// border count as land.
    around: u8,
    /// Whether the node need not be noted any more when something changes: it is noted, or sea.
    is_noted: bool,
}

impl Shore {
    /// The shore of `land`, one value a node of a 2-D lattice, zero at sea.
    ///
    /// # Panics
    /// If there are fewer values than nodes.
    pub fn new(lattice: &Lattice, land: &[u8]) -> Self {
        let nodes = lattice.node_count();
        let mut shore = Self {
            lattice: lattice.clone(),
            spots: vec![Spot::default(); nodes],
            total: 0,
            table: std::array::from_fn(|around| side_lengths(around as u8)),
        };
        for node in (0..nodes).filter(|&node| land[node] == 0) {
            shore.drown(node);
            shore.surround(node, |_| {});
        }
        for node in (0..nodes).filter(|&node| land[node] > 0) {
            // Most land has no shore.
            if shore.spots[node].around != 0 {
                shore.measure(node, shore.place(node));
            }
        }
        shore
    }

    /// The lattice.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Which of the eight nodes around `node` are sea.
    #[inline]
    pub(super) fn around(&self, node: usize) -> u8 {
        self.spots[node].around
    }

    /// Column and row of a node.
    #[inline]
    pub(super) fn place(&self, node: usize) -> [usize; 2] {
        let [x, y, _] = self.lattice.coordinates(node);
        [x, y]
    }

    /// Shore of a node in parts of a spacing, [`PARTS`] each; zero at sea.
    pub fn length(&self, node: usize) -> u16 {
        self.spots[node].length
    }

    /// Shore of the whole coast, islands and lakes included, in parts of a spacing.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// Number of neighbours of a land node that are sea, and of all that an inner node like it
    /// has.
    pub fn exposure(&self, node: usize) -> (u32, u32) {
        self.exposure_at(node, self.place(node))
    }

    /// [`Shore::exposure`] of the node at a place.
    #[inline]
    pub(super) fn exposure_at(&self, node: usize, at: [usize; 2]) -> (u32, u32) {
        let edges = edges(&self.lattice, at);
        ((self.spots[node].around & edges).count_ones(), edges.count_ones())
    }

    /// Tells the nodes around `node` that it is sea, and names those to `visit` that are to be
    /// measured now and were not before.
    pub(super) fn surround(&mut self, node: usize, mut visit: impl FnMut(usize)) {
        let [x, y] = self.place(node);
        let inner = self.lattice.is_interior([x, y, 0]);
        let width = self.lattice.width() as isize;
        for (direction, [east, south]) in STEPS.into_iter().enumerate() {
            let other = match inner {
                true => Some(node.wrapping_add_signed(east + south * width)),
                false => beside(&self.lattice, [x, y], direction),
            };
            if let Some(other) = other {
                self.spots[other].around |= 1 << opposite(direction);
                if self.touch(other) {
                    visit(other);
                }
            }
        }
    }

    /// Notes that a land node is to be measured: `true` when it was not noted before.
    #[inline]
    pub(super) fn touch(&mut self, node: usize) -> bool {
        !std::mem::replace(&mut self.spots[node].is_noted, true)
    }

    /// Measures the shore of the land node at a place anew and gives the change in parts.
    pub(super) fn measure(&mut self, node: usize, at: [usize; 2]) -> i32 {
        self.spots[node].is_noted = false;
        self.set_length(node, self.side_lengths(node, at).iter().sum())
    }

    /// Gives a node to the sea, and the change of its shore in parts. It is never measured again.
    pub(super) fn drown(&mut self, node: usize) -> i32 {
        self.spots[node].is_noted = true;
        self.set_length(node, 0)
    }

    fn set_length(&mut self, node: usize, length: u16) -> i32 {
        let before = std::mem::replace(&mut self.spots[node].length, length);
        let change = i32::from(length) - i32::from(before);
        self.total = self.total.wrapping_add_signed(i64::from(change));
        change
    }

    /// Shore of each side of the land node at a place in parts: east, north, west and south.
    #[inline]
    pub(super) fn side_lengths(&self, node: usize, at: [usize; 2]) -> [u16; 4] {
        self.table[usize::from(self.mirrored(node, at))]
    }

    /// What surrounds a node, with the mirror image of the border beyond it.
    #[inline]
    fn mirrored(&self, node: usize, at: [usize; 2]) -> u8 {
        let around = self.spots[node].around;
        if self.lattice.is_interior([at[0], at[1], 0]) {
            return around;
        }
        let beyond = |side: &usize| beside(&self.lattice, at, *side).is_none();
        (0..4).filter(beyond).fold(around, mirror)
    }
}

/// Sets the diagonals beyond a border as the nodes at the border before them.
fn mirror(around: u8, side: usize) -> u8 {
    let copy =
        |around: u8, from: usize, to: usize| (around & !(1 << to)) | (around >> from & 1) << to;
    let around = copy(around, left_of(side), diagonal(side));
    copy(around, right_of(side), diagonal(right_of(side)))
}

/// Shore in parts of each side of a land node, by which of the nodes around it are sea.
fn side_lengths(around: u8) -> [u16; 4] {
    let is_sea = |direction: usize| around >> direction & 1 == 1;
    let half = |beside: usize, across: usize| match !is_sea(beside) && is_sea(across) {
        true => HALF_STRAIGHT,
        false => HALF_CORNER,
    };
    let length = |side: usize| {
        let right = right_of(side);
        half(left_of(side), diagonal(side)) + half(right, diagonal(right))
    };
    std::array::from_fn(|side| if is_sea(side) { length(side) } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn shore(rows: &[&str], boundary: Boundary) -> Shore {
        let size = [rows[0].len(), rows.len()];
        let lattice = Lattice::plane(size, 1.0, Connectivity::Four, [boundary; 2]).unwrap();
        let land: Vec<u8> =
            rows.iter().flat_map(|row| row.bytes()).map(|c| u8::from(c == b'#')).collect();
        Shore::new(&lattice, &land)
    }

    #[test]
    fn shores_have_the_lengths_of_marching_squares() {
        let corner = 0.5_f64.sqrt();
        let cases: [(&[&str], f64); 6] = [
            (&["....", ".#..", "....", "...."], 4.0 * corner),
            (&["....", ".##.", ".##.", "...."], 4.0 + 4.0 * corner),
            // Two corners that touch: each shore cuts its own corner.
            (&["....", ".#..", "..#.", "...."], 8.0 * corner),
            (&["####", "####", "....", "...."], 4.0),
            (&["#...", "....", "....", "...."], 1.0 + corner),
            (&["####", "#..#", "#..#", "####"], 4.0 + 4.0 * corner),
        ];
        for (rows, expected) in cases {
            let length = spacings(shore(rows, Boundary::Open).total());
            assert!((length / expected - 1.0).abs() < 2e-4, "{rows:?}: {length} {expected}");
        }
    }

    #[test]
    fn the_shore_goes_on_over_periodic_borders() {
        let rows = ["#..#", "....", "....", "#..#"];
        let corner = 0.5_f64.sqrt();
        let length = spacings(shore(&rows, Boundary::Periodic).total());
        assert!((length - 4.0 - 4.0 * corner).abs() < 1e-3);
    }

    #[test]
    fn exposure_counts_neighbours_of_the_lattice() {
        for (connectivity, expected) in [
            (Connectivity::Four, [(2, 4), (1, 4)]),
            (Connectivity::FourEight, [(5, 8), (1, 4)]),
            (Connectivity::Eight, [(5, 8), (3, 8)]),
        ] {
            let lattice = Lattice::plane([5, 5], 1.0, connectivity, [Boundary::Open; 2]).unwrap();
            let mut land = [0; 25];
            (1..4).for_each(|y| land[5 * y + 1..5 * y + 4].fill(1));
            let shore = Shore::new(&lattice, &land);
            assert_eq!([6, 7].map(|node| shore.exposure(node)), expected, "{connectivity:?}");
        }
    }
}
