//! The course of a branch: a curve from its key point to where it joins the tree, in straight
//! pieces.

use super::cell::Point;
use super::piece::{Joint, Piece};

/// Most pieces of a branch.
pub(super) const MOST_PIECES: usize = 8;

/// The shape of a branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// Number of equal parts with bends between them: 2 or 4.
    pub parts: usize,
    /// How far bends are pushed aside, as a share of the length.
    pub displacement: f64,
    /// From -1 to 1, for each bend.
    pub bends: [f64; 3],
    /// Whether it is a smooth curve; else straight from bend to bend.
    pub smooth: bool,
}

impl Course {
    /// The pieces of a branch from a key point at `height` metres down to a joint, which it reaches
    /// in the direction `arrival`; straight on, if that is 0, 0.
    pub fn pieces(
        &self,
        from: Point,
        height: f64,
        to: &Joint,
        arrival: Point,
        slope: f64,
    ) -> Vec<Piece> {
        let chord = [0, 1].map(|axis| to.point[axis] - from[axis]);
        let length = chord[0].hypot(chord[1]);
        let arrival = match arrival[0].hypot(arrival[1]) {
            speed if speed > 0.0 => arrival.map(|part| part * (length / speed)),
            _ => chord,
        };
        let count = if self.smooth { 2 * self.parts } else { self.parts };
        let mut vertices = [from; MOST_PIECES + 1];
        for (number, vertex) in vertices.iter_mut().enumerate().take(count).skip(1) {
            let share = number as f64 / count as f64;
            let aside = self.displacement * self.aside(number);
            let place = if self.smooth {
                hermite(from, chord, to.point, arrival, share)
            } else {
                [0, 1].map(|axis| from[axis] + share * chord[axis])
            };
            *vertex = [place[0] - aside * chord[1], place[1] + aside * chord[0]];
        }
        vertices[count] = to.point;
        self.fall(&vertices[..=count], height, to, slope)
    }

    /// How far, from -1 to 1, a vertex is pushed aside: bends by their number, and by
    /// Catmull-Rom's interpolation between bends.
    fn aside(&self, vertex: usize) -> f64 {
        let bend = |number: usize| match number {
            0 => 0.0,
            number if number >= self.parts => 0.0,
            number => self.bends[number - 1],
        };
        if !self.smooth {
            return bend(vertex);
        }
        let before = vertex / 2;
        if vertex.is_multiple_of(2) {
            return bend(before);
        }
        let outer = bend(before.saturating_sub(1)) + bend(before + 2);
        (9.0 * (bend(before) + bend(before + 1)) - outer) / 16.0
    }

    /// Pieces between vertices, which go down evenly.
    fn fall(&self, vertices: &[Point], height: f64, to: &Joint, slope: f64) -> Vec<Piece> {
        let step = |pair: &[Point]| [0, 1].map(|axis| pair[1][axis] - pair[0][axis]);
        let steps: Vec<Point> = vertices.windows(2).map(step).collect();
        let lengths = steps.iter().map(|[east, north]| east.hypot(*north));
        let whole: f64 = lengths.clone().sum();
        let mut above = height;
        let mut gone = 0.0;
        let falls = lengths.map(|length| {
            gone += length;
            let share = if whole > 0.0 { gone / whole } else { 1.0 };
            height + share.min(1.0) * (to.height - height)
        });
        let pieces = steps.iter().zip(falls).enumerate();
        pieces
            .map(|(number, (&along, below))| {
                let squared = along[0] * along[0] + along[1] * along[1];
                let inverse = if squared > 0.0 { 1.0 / squared } else { 0.0 };
                let onward = steps.get(number + 1).copied().unwrap_or(to.onward);
                let rise = below - above;
                let piece = Piece {
                    from: vertices[number],
                    along,
                    inverse,
                    height: above,
                    rise,
                    onward,
                    slope,
                };
                above = below;
                piece
            })
            .collect()
    }
}

/// A point of the cubic curve from `from`, where it sets out along `chord`, to `to`, where it
/// arrives along `arrival`.
fn hermite(from: Point, chord: Point, to: Point, arrival: Point, share: f64) -> Point {
    let rest = 1.0 - share;
    let start = (1.0 + 2.0 * share) * rest * rest;
    let end = share * share * (3.0 - 2.0 * share);
    let [set_out, arrive] = [share * rest * rest, -share * share * rest];
    [0, 1].map(|axis| {
        start * from[axis] + end * to[axis] + set_out * chord[axis] + arrive * arrival[axis]
    })
}
