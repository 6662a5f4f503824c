//! The divider: how many steps of a ruler a line takes.

use rayon::prelude::*;

use super::{Dimension, DimensionError, Rule, ScaleRange};
use crate::Polyline;
use crate::polyline::distance;

/// Walks are averaged over this many starts along each line.
const STARTS: usize = 16;

/// Dimension of lines by dividers (Richardson's method): the number of steps of a ruler grows as
/// ruler^-D.
///
/// The walk goes from where it stands to the first place along the line that is one ruler away,
/// which may lie between two points; what is left at the end counts as a part of a step. Counts
/// are means over 16 starts (from a start on an open line both ways), and add up over `lines`.
/// On the sphere distances are chords.
///
/// # Limits
/// Within 0.025 for curves of known dimension. Islands smaller than the ruler count nothing, so
/// for an archipelago prefer [`super::box_dimension`].
///
/// # Errors
/// See [`DimensionError`]; the range must suit the lines.
///
/// # Source
/// Richardson 1961; Mandelbrot 1967; thesis, section 4.2.
pub fn divider_dimension(
    lines: &[Polyline],
    range: &ScaleRange,
) -> Result<Dimension, DimensionError> {
    range.check(lines)?;
    let count = |ruler: f64| lines.iter().map(|line| mean_steps(line, ruler)).sum::<f64>();
    let measured: Vec<[f64; 2]> =
        range.scales().into_par_iter().map(|ruler| [ruler, count(ruler)]).collect();
    Dimension::fit(&measured, Rule::COUNT)
}

/// Steps along one line, averaged over the starts.
fn mean_steps(line: &Polyline, ruler: f64) -> f64 {
    let points = line.points();
    let pieces = points.len() - 1;
    let starts = STARTS.min(pieces);
    let steps_from = |start: usize| {
        let forward = points[start..].iter().copied();
        if line.is_closed() {
            return steps(forward.chain(points[1..=start].iter().copied()), ruler);
        }
        let back = points[..=start].iter().rev().copied();
        steps(forward, ruler) + steps(back, ruler)
    };
    (0..starts).map(|start| steps_from(start * pieces / starts)).sum::<f64>() / starts as f64
}

/// Steps of `ruler` along a path, the last of them in part.
fn steps(mut path: impl Iterator<Item = [f64; 3]>, ruler: f64) -> f64 {
    let Some(mut foot) = path.next() else { return 0.0 };
    let mut here = foot;
    let mut count = 0.0;
    for next in path {
        while let Some(exit) = leave(foot, here, next, ruler) {
            count += 1.0;
            [foot, here] = [exit; 2];
        }
        here = next;
    }
    count + distance(foot, here) / ruler
}

/// Where the piece from `here`, within the ruler of `foot`, to `next` leaves the ruler's circle.
fn leave(foot: [f64; 3], here: [f64; 3], next: [f64; 3], ruler: f64) -> Option<[f64; 3]> {
    if distance(foot, next) < ruler {
        return None;
    }
    let piece: [f64; 3] = std::array::from_fn(|axis| next[axis] - here[axis]);
    let from_foot: [f64; 3] = std::array::from_fn(|axis| here[axis] - foot[axis]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [square, half] = [dot(piece, piece), dot(piece, from_foot)];
    let inside = (dot(from_foot, from_foot) - ruler * ruler).min(0.0);
    let share = ((half * half - square * inside).sqrt() - half) / square;
    Some(std::array::from_fn(|axis| here[axis] + share.clamp(0.0, 1.0) * piece[axis]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wriggling line with pieces shorter and longer than the rulers.
    fn line() -> Vec<[f64; 3]> {
        let point =
            |n: f64| [n + 3.0 * (1.7 * n).sin(), 4.0 * (0.9 * n).cos() + (5.0 * n).sin(), 0.0];
        (0..60).map(|n| point(f64::from(n) * if n % 7 == 0 { 1.0 } else { 0.5 })).collect()
    }

    /// The walk over thousands of points a piece, none of them computed: a step ends at the first
    /// that is a ruler away.
    fn steps_by_points(path: &[[f64; 3]], ruler: f64) -> f64 {
        const POINTS: usize = 20_000;
        let mut foot = path[0];
        let mut count = 0.0;
        for pair in path.windows(2) {
            for number in 1..=POINTS {
                let share = number as f64 / POINTS as f64;
                let point =
                    [0, 1, 2].map(|axis| (1.0 - share) * pair[0][axis] + share * pair[1][axis]);
                if distance(foot, point) >= ruler {
                    count += 1.0;
                    foot = point;
                }
            }
        }
        count + distance(foot, path[path.len() - 1]) / ruler
    }

    #[test]
    fn walks_are_those_over_many_points() {
        for ruler in [0.3, 1.0, 2.5, 7.0] {
            let [found, expected] =
                [steps(line().into_iter(), ruler), steps_by_points(&line(), ruler)];
            assert!((found / expected - 1.0).abs() < 5e-3, "{ruler}: {found}, {expected}");
        }
    }
}
