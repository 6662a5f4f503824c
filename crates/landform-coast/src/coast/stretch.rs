//! Stretches of shore, linked into lines.

use super::sides::Side;

/// Most sides of a stretch.
pub(super) const MOST_SIDES: usize = 32;

/// No place in a line, and no stretch.
pub(super) const NOWHERE: u32 = u32::MAX;

/// A side's place in a line: the number of its stretch and its place there.
pub(super) fn place_of(stretch: u32, index: usize) -> u32 {
    stretch * MOST_SIDES as u32 + index as u32
}

/// The stretch of a place, and the place there.
#[inline]
pub(super) fn stretch_of(place: u32) -> (u32, usize) {
    (place / MOST_SIDES as u32, place as usize % MOST_SIDES)
}

/// A few sides that follow each other along a line of shore.
///
/// Places are columns and rows: of the first side as on the map, of the others as the line moves
/// on from there, not wrapped on periodic axes.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    /// Number of sides.
    pub(super) count: usize,
    /// The stretch before; [`NOWHERE`] at the beginning of a line that begins at a border.
    pub(super) previous: u32,
    /// The stretch after; [`NOWHERE`] at the end of a line that ends at a border.
    pub(super) next: u32,
    /// What places in the stretch after have to be moved by to be places in this one: not zero
    /// where the line crosses a periodic border.
    pub(super) shift: [i32; 2],
    /// Least column and row.
    pub(super) low: [i32; 2],
    /// Greatest column and row.
    pub(super) high: [i32; 2],
    /// Whether it is about to be taken away.
    pub(super) is_cut: bool,
    /// Length in parts of the shore before each side, and of all.
    pub(super) before: [u16; MOST_SIDES + 1],
    pub(super) sides: [Side; MOST_SIDES],
    /// Place of each side's node.
    pub(super) at: [[i32; 2]; MOST_SIDES],
}

impl Stretch {
    /// A stretch of the sides, their places and lengths; without links.
    pub(super) fn new(sides: impl Iterator<Item = (Side, [i32; 2], u16)>) -> Self {
        let mut stretch = Self {
            count: 0,
            previous: NOWHERE,
            next: NOWHERE,
            shift: [0; 2],
            low: [i32::MAX; 2],
            high: [i32::MIN; 2],
            is_cut: false,
            before: [0; MOST_SIDES + 1],
            sides: [NOWHERE; MOST_SIDES],
            at: [[0; 2]; MOST_SIDES],
        };
        for (index, (side, at, length)) in sides.take(MOST_SIDES).enumerate() {
            stretch.sides[index] = side;
            stretch.at[index] = at;
            stretch.before[index + 1] = stretch.before[index] + length;
            stretch.low = [0, 1].map(|axis| stretch.low[axis].min(at[axis]));
            stretch.high = [0, 1].map(|axis| stretch.high[axis].max(at[axis]));
            stretch.count += 1;
        }
        stretch
    }

    /// Length in parts of some of its sides.
    #[inline]
    pub(super) fn length(&self, from: usize, to: usize) -> u64 {
        u64::from(self.before[to] - self.before[from])
    }

    /// Its sides.
    pub(super) fn sides(&self) -> &[Side] {
        &self.sides[..self.count]
    }
}
