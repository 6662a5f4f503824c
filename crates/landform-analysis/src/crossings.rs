//! Where a line meets itself.

/// Squares along the longest piece of a line.
const SQUARES: f64 = 16.0;

/// Number of pairs of pieces of a line that meet, without pairs of neighbours, which do at the point
/// they share; of a closed line the last and the first piece are neighbours. Pieces that touch, or
/// lie on each other, meet.
///
/// Pieces are sorted into squares, and those in a square tried against each other: fast where pieces
/// are of like length and spread.
pub fn self_crossings(points: &[[f64; 2]]) -> usize {
    let pieces: Vec<[[f64; 2]; 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let lengths = || pieces.iter().map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]));
    let longest = lengths().fold(0.0, f64::max);
    let side = (lengths().sum::<f64>() / pieces.len() as f64).max(longest / SQUARES);
    if side.is_nan() || side <= 0.0 {
        return 0;
    }
    let mut entries: Vec<([i64; 2], usize)> = Vec::with_capacity(2 * pieces.len());
    for (number, [a, b]) in pieces.iter().enumerate() {
        let range = |axis: usize| {
            let [low, high] = [a[axis].min(b[axis]), a[axis].max(b[axis])];
            (low / side).floor() as i64..=(high / side).floor() as i64
        };
        for row in range(1) {
            entries.extend(range(0).map(|column| ([column, row], number)));
        }
    }
    entries.sort_unstable();
    let is_closed = points.first() == points.last();
    let are_neighbours = |first: usize, second: usize| {
        second - first == 1 || (is_closed && first == 0 && second + 1 == pieces.len())
    };
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    for square in entries.chunk_by(|a, b| a.0 == b.0) {
        for (place, (_, first)) in square.iter().enumerate() {
            for (_, second) in &square[place + 1..] {
                if !are_neighbours(*first, *second) && meet(pieces[*first], pieces[*second]) {
                    pairs.push([*first, *second]);
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs.len()
}

/// Whether two pieces have a point in common.
fn meet(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> bool {
    let apart = |axis: usize| {
        let [a, b] = [a, b].map(|[from, to]| [from[axis], to[axis]]);
        a[0].max(a[1]) < b[0].min(b[1]) || b[0].max(b[1]) < a[0].min(a[1])
    };
    if apart(0) || apart(1) {
        return false;
    }
    let across = |line: [[f64; 2]; 2], other: [[f64; 2]; 2]| {
        side_of(line, other[0]) * side_of(line, other[1]) <= 0.0
    };
    across(a, b) && across(b, a)
}

/// On which side of a line a point is: positive on its left, 0 on it.
fn side_of([a, b]: [[f64; 2]; 2], point: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_lines_cross_as_often_as_they_do() {
        let eight = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0], [0.0, 0.0]];
        assert_eq!(self_crossings(&eight), 1);
        assert_eq!(self_crossings(&eight[..3]), 0);
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        assert_eq!(self_crossings(&square), 0, "a ring does not cross itself");
        let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0]];
        assert_eq!(self_crossings(&touching), 1, "it comes back to its first piece");
        assert_eq!(self_crossings(&[]) + self_crossings(&[[1.0, 1.0]; 3]), 0);
        // A star of five points, each side of which crosses two others.
        let corner = |number: usize| {
            let (y, x) = (number as f64 * 0.8 * std::f64::consts::PI).sin_cos();
            [x, y]
        };
        let star: Vec<[f64; 2]> = (0..6).map(|number| corner(number % 5)).collect();
        assert_eq!(self_crossings(&star), 5);
    }

    /// Every pair is tried.
    #[test]
    fn squares_find_what_all_pairs_have() {
        let mut place = [0.0_f64, 0.0];
        let points: Vec<[f64; 2]> = (0..600)
            .map(|number| {
                let (y, x) = (f64::from(number) * 1.9 + (f64::from(number) * 0.37).sin()).sin_cos();
                let length = 1.0 + 3.0 * f64::from(u8::from(number % 7 == 0));
                place = [place[0] + length * x, place[1] + length * y];
                place
            })
            .collect();
        let pieces: Vec<[[f64; 2]; 2]> = points.windows(2).map(|p| [p[0], p[1]]).collect();
        let mut expected = 0;
        for first in 0..pieces.len() {
            for second in first + 2..pieces.len() {
                expected += usize::from(meet(pieces[first], pieces[second]));
            }
        }
        assert!(expected > 100, "{expected}");
        assert_eq!(self_crossings(&points), expected);
    }
}
