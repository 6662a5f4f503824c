//! Mandelbrot's squig: a random curve that never meets itself, as rivers do not.

use landform_sim::random::RandomStream;

use super::check_level;
use crate::SynthError;
use crate::error::Checks;

/// ln 2.5 / ln 2, of a squig whose sides are crossed in either half alike: of the four triangles
/// that a triangle is made of, the curve passes through one in a quarter of all cases, and
/// through three in the others.
pub const SQUIG_DIMENSION: f64 = 1.321_928_094_887_362_4;

/// A side of a triangle that the curve crosses.
type Side = [[f64; 2]; 2];

/// Triangles in the strip that the curve begins with.
const STRIP: u32 = 4;

/// A squig from 0, 0 to 1, 0 (Mandelbrot 1982, "The Fractal Geometry of Nature"; on triangles as
/// Prusinkiewicz and Hammel 1993 have it).
///
/// The curve passes through a strip of triangles, from side to side. Every triangle is parted
/// into four by the middles of its sides, and chance says through which half of every side the
/// curve goes on; then there is one way through the parts. This is repeated `level` times. The
/// points are the middles of the sides that are crossed; no triangle is passed twice, so the
/// curve does not meet itself.
///
/// `shortcut` is the chance of the half that is nearer to the inside of the bend: at 0.5 the
/// dimension is [`SQUIG_DIMENSION`], at 1 the curve is straight.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 11, and shortcuts beyond 0.5 to 1.
pub fn squig(level: u32, shortcut: f64, seed: u64) -> Result<Vec<[f64; 2]>, SynthError> {
    check_level("squig", level, 11)?;
    Checks("squig").range("shortcut", shortcut, 0.5..=1.0)?;
    let stream = RandomStream::new(seed, "squig");
    let mut sides: Vec<Side> = (0..=STRIP).map(strip_side).collect();
    for depth in 0..level {
        let chance = |number: usize| stream.unit(u64::from(depth), number, 0);
        sides = refined(&sides, shortcut, chance);
    }
    Ok(laid_from_0_to_1(sides.iter().map(|&[a, b]| middle(a, b)).collect()))
}

/// A side of the strip of equilateral triangles along the x axis.
fn strip_side(number: u32) -> Side {
    let lean = if number.is_multiple_of(2) { 0.5 } else { -0.5 };
    let x = f64::from(number);
    let top = 0.75_f64.sqrt();
    [[x - lean, -top], [x + lean, top]]
}

fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// The sides that are crossed at the next level.
fn refined(sides: &[Side], shortcut: f64, chance: impl Fn(usize) -> f64) -> Vec<Side> {
    // Which end of every side the curve keeps to.
    let kept = |number: usize| -> [f64; 2] {
        let side = sides[number];
        let inside = match sides.get(number + 1) {
            Some(&next) => shared(side, next),
            None => shared(side, sides[number - 1]),
        };
        let outside = other(side, inside);
        if chance(number) < shortcut { inside } else { outside }
    };
    let mut finer = Vec::with_capacity(3 * sides.len());
    for number in 0..sides.len() {
        let [start, end] = sides[number];
        let here = kept(number);
        finer.push([here, middle(start, end)]);
        let Some(&next) = sides.get(number + 1) else { break };
        let corner = shared(sides[number], next);
        let [from, to] = [other(sides[number], corner), other(next, corner)];
        let [near, far, across] = [middle(corner, from), middle(corner, to), middle(from, to)];
        let in_middle = [[near, far], [near, across], [far, across]];
        match (here == corner, kept(number + 1) == corner) {
            (true, true) => {}
            (true, false) => finer.extend([in_middle[0], in_middle[2]]),
            (false, true) => finer.extend([in_middle[1], in_middle[0]]),
            (false, false) => finer.extend([in_middle[1], in_middle[2]]),
        }
    }
    finer
}

/// The corner that two sides of a triangle have in common.
fn shared(side: Side, next: Side) -> [f64; 2] {
    if next.contains(&side[0]) { side[0] } else { side[1] }
}

/// The other end of a side.
fn other(side: Side, end: [f64; 2]) -> [f64; 2] {
    if side[0] == end { side[1] } else { side[0] }
}

/// The curve turned and scaled so that it goes from 0, 0 to 1, 0.
fn laid_from_0_to_1(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let (Some(&[x, y]), Some(&[to_x, to_y])) = (points.first(), points.last()) else {
        return points;
    };
    let [east, north] = [to_x - x, to_y - y];
    let square = east * east + north * north;
    let laid = |[a, b]: [f64; 2]| {
        let [a, b] = [a - x, b - y];
        [(a * east + b * north) / square, (b * east - a * north) / square]
    };
    points.into_iter().map(laid).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which side of a line a point is on.
    fn side_of([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    }

    fn meet(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> bool {
        let apart = |axis: usize| {
            let [a, b] = [a, b].map(|[from, to]| [from[axis], to[axis]]);
            a[0].max(a[1]) < b[0].min(b[1]) || b[0].max(b[1]) < a[0].min(a[1])
        };
        // Pieces on one line are on neither side of each other.
        if apart(0) || apart(1) {
            return false;
        }
        side_of(a, b[0]) * side_of(a, b[1]) <= 0.0 && side_of(b, a[0]) * side_of(b, a[1]) <= 0.0
    }

    /// Every pair of pieces that do not follow one another is tried.
    #[test]
    fn squigs_are_connected_and_do_not_meet_themselves() {
        for (seed, shortcut) in [(1, 0.5), (2, 0.5), (3, 0.6), (4, 0.8), (5, 1.0)] {
            let points = squig(6, shortcut, seed).unwrap();
            let pieces: Vec<[[f64; 2]; 2]> = points.windows(2).map(|p| [p[0], p[1]]).collect();
            for first in 0..pieces.len() {
                for second in first + 2..pieces.len() {
                    assert!(!meet(pieces[first], pieces[second]), "{seed}: {first} {second}");
                }
            }
            // Pieces join the middles of two sides of a triangle: all are alike in length.
            let lengths = pieces.iter().map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]));
            let (least, most) = lengths.fold((1.0_f64, 0.0_f64), |(l, m), x| (l.min(x), m.max(x)));
            assert!(most < 1.001 * least, "{least} {most}");
            let near = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-12;
            assert!(near(points[0], [0.0; 2]) && near(points[points.len() - 1], [1.0, 0.0]));
        }
    }

    /// On average 2.5 times as many pieces a level.
    #[test]
    fn squigs_grow_as_their_dimension_says() {
        let pieces = |level| {
            let count = |seed| squig(level, 0.5, seed).unwrap().len() - 1;
            (0..40).map(count).sum::<usize>() as f64
        };
        let growth = (pieces(7) / pieces(3)).powf(0.25);
        assert!((growth - 2.5).abs() < 0.05, "{growth}");
        assert!((2.0_f64.powf(SQUIG_DIMENSION) - 2.5).abs() < 1e-12);
    }

    #[test]
    fn bad_squigs_are_refused() {
        assert!(squig(12, 0.5, 0).is_err() && squig(3, 0.4, 0).is_err());
        assert!(squig(3, f64::NAN, 0).is_err());
    }
}
