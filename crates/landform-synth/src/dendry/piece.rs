//! The straight pieces that branches are made of.

use super::cell::Point;

/// A piece of a branch, from its upper to its lower end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub from: Point,
    /// From the upper to the lower end.
    pub along: Point,
    /// One over the square of its length; 0 for a mere point.
    pub inverse: f64,
    /// Height of the upper end in metres.
    pub height: f64,
    /// What the lower end is higher by: nothing, or less.
    pub rise: f64,
    /// Direction in which water leaves the lower end; 0, 0 where it stays.
    pub onward: Point,
    /// Slope of the branch.
    pub slope: f64,
}

/// A place on the tree that a branch may join.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Joint {
    pub point: Point,
    pub height: f64,
    /// Direction in which water goes on; 0, 0 where it stays.
    pub onward: Point,
    pub slope: f64,
}

impl Piece {
    /// Square of the distance to a point, and how far along the piece its nearest point lies.
    #[inline(always)]
    pub fn nearest(&self, [x, y]: Point) -> (f64, f64) {
        let [east, north] = [x - self.from[0], y - self.from[1]];
        let along = (east * self.along[0] + north * self.along[1]) * self.inverse;
        let along = if along > 0.0 { along } else { 0.0 };
        let along = if along < 1.0 { along } else { 1.0 };
        let east = east - along * self.along[0];
        let north = north - along * self.along[1];
        (east * east + north * north, along)
    }

    /// Height in metres at a share of the way down.
    pub fn height_at(&self, share: f64) -> f64 {
        self.height + share * self.rise
    }

    /// The end that is nearer to a share of the way down.
    pub fn joint(&self, share: f64) -> Joint {
        let slope = self.slope;
        if share < 0.5 {
            return Joint { point: self.from, height: self.height, onward: self.along, slope };
        }
        let point = [0, 1].map(|axis| self.from[axis] + self.along[axis]);
        Joint { point, height: self.height_at(1.0), onward: self.onward, slope }
    }
}

/// The nearest of some pieces to a point: the square of its distance, the piece, and how far along
/// the nearest point lies. Of several that are equally near it is the first. None of none.
pub(super) fn nearest<'a>(
    pieces: impl Iterator<Item = &'a Piece>,
    point: Point,
) -> Option<(f64, &'a Piece, f64)> {
    let mut best: Option<(f64, &Piece, f64)> = None;
    for piece in pieces {
        let (squared, share) = piece.nearest(point);
        if best.is_none_or(|(least, ..)| squared < least) {
            best = Some((squared, piece, share));
        }
    }
    best
}
