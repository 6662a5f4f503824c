//! Distances to a curve, and its height beside it.

/// Pieces that share a box.
const BLOCK: usize = 16;

/// Least and greatest slope of the extensions beside a curve, over the steepest along it.
const LEAST: f64 = 2.0;
const MOST: f64 = 32.0;

/// A curve of straight pieces with a height, made ready for questions about places beside it.
/// Blocks of pieces are passed over where their boxes are too far away to matter.
#[derive(Debug)]
pub(crate) struct Course {
    pieces: Vec<Piece>,
    blocks: Vec<Block>,
    /// Lowest and highest point.
    heights: [f64; 2],
    /// Slope of the extensions beside the curve.
    slope: f64,
}

/// A straight piece.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: [f64; 2],
    to: [f64; 2],
    /// Unit vector towards the end.
    along: [f64; 2],
    length: f64,
    height: f64,
    /// Rise a metre.
    rise: f64,
    /// Metres by which the extremes of the extensions lie off the nearest place, a metre aside.
    shift: f64,
}

/// The box around some pieces.
#[derive(Clone, Copy, Debug)]
struct Block {
    low: [f64; 2],
    high: [f64; 2],
    heights: [f64; 2],
}

impl Course {
    /// A curve through points `[east, north, height]`; none if it has no length.
    pub fn new(points: &[[f64; 3]]) -> Option<Self> {
        let mut pieces: Vec<Piece> =
            points.windows(2).filter_map(|pair| Piece::new(pair[0], pair[1])).collect();
        if pieces.is_empty() {
            return None;
        }
        let blocks: Vec<Block> = pieces.chunks(BLOCK).map(Block::around).collect();
        let steepest = pieces.iter().map(|piece| piece.rise.abs()).fold(0.0, f64::max);
        let slope = slope_across(&pieces, &blocks, [LEAST * steepest, MOST * steepest]);
        for piece in &mut pieces {
            // Where the derivative of rise t + slope hypot(t, 1) is 0.
            let room = (slope * slope - piece.rise * piece.rise).sqrt();
            piece.shift = if room > 0.0 { piece.rise / room } else { 0.0 };
        }
        let heights = blocks.iter().map(|block| block.heights);
        let heights = heights.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        Some(Self { pieces, blocks, heights, slope })
    }

    /// Number of pieces, which is that of the points of a ring.
    pub fn points(&self) -> usize {
        self.pieces.len()
    }

    /// Lowest and highest point.
    pub fn heights(&self) -> [f64; 2] {
        self.heights
    }

    /// Lipschitz constant of [`Course::height`].
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// South-western and north-eastern corner of the rectangle around the curve.
    pub fn extent(&self) -> [[f64; 2]; 2] {
        let pick = |of: fn(&Block) -> [f64; 2], least: fn(f64, f64) -> f64| {
            let corners = self.blocks.iter().map(of);
            corners.reduce(|a, b| [least(a[0], b[0]), least(a[1], b[1])]).unwrap_or_default()
        };
        [pick(|block| block.low, f64::min), pick(|block| block.high, f64::max)]
    }

    /// The pieces of a block.
    fn pieces(&self, block: usize) -> &[Piece] {
        let start = block * BLOCK;
        &self.pieces[start..self.pieces.len().min(start + BLOCK)]
    }

    /// Distance to the curve, if it is less than `reach`, and the block of the nearest place.
    pub fn nearest(&self, point: [f64; 2], reach: f64) -> Option<Nearest> {
        let mut squared = reach * reach;
        let mut nearest = None;
        for (number, block) in self.blocks.iter().enumerate() {
            if block.distance_squared(point) < squared {
                for piece in self.pieces(number) {
                    let distance_squared = piece.distance_squared(point);
                    if distance_squared < squared {
                        squared = distance_squared;
                        nearest = Some(number);
                    }
                }
            }
        }
        nearest.map(|block| Nearest { distance: squared.sqrt(), block })
    }

    /// How often a ray to the east from a point meets the curve.
    pub fn crossings(&self, [x, y]: [f64; 2]) -> usize {
        let meets =
            |block: &Block| (block.low[1]..=block.high[1]).contains(&y) && block.high[0] > x;
        let blocks = self.blocks.iter().enumerate().filter(|(_, block)| meets(block));
        blocks.map(|(number, _)| self.crossings_of(number, [x, y])).sum()
    }

    fn crossings_of(&self, block: usize, [x, y]: [f64; 2]) -> usize {
        let crosses = |piece: &&Piece| {
            // A corner on the ray belongs to the piece above it alone.
            let [from, to] = [piece.from, piece.to];
            let climbs = (from[1] > y) != (to[1] > y);
            climbs && from[0] + (y - from[1]) / (to[1] - from[1]) * (to[0] - from[0]) > x
        };
        self.pieces(block).iter().filter(crosses).count()
    }

    /// Height of the curve at a place on it, and half-way between both extensions beside it.
    /// Looks at the block of the nearest place first, after which few others can matter.
    pub fn height(&self, point: [f64; 2], nearest: Nearest) -> f64 {
        let [lowest, highest] = self.heights;
        if self.slope == 0.0 {
            return lowest;
        }
        let mut extremes = [f64::INFINITY, f64::NEG_INFINITY];
        self.extend(point, nearest.block, &mut extremes);
        for (number, block) in self.blocks.iter().enumerate() {
            let margin = self.slope * block.distance_squared(point).sqrt();
            let matters =
                block.heights[0] + margin < extremes[0] || block.heights[1] - margin > extremes[1];
            if matters && number != nearest.block {
                self.extend(point, number, &mut extremes);
            }
        }
        (0.5 * (extremes[0] + extremes[1])).clamp(lowest, highest)
    }

    /// Takes the pieces of a block into the least and the greatest of all cones at a point.
    fn extend(&self, point: [f64; 2], block: usize, [above, below]: &mut [f64; 2]) {
        for piece in self.pieces(block) {
            let [along, aside] = piece.coordinates(point);
            *above = above.min(piece.cone(along, aside, -aside * piece.shift, self.slope));
            *below = below.max(piece.cone(along, aside, aside * piece.shift, -self.slope));
        }
    }
}

/// Where a curve is nearest to a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Distance in metres.
    pub distance: f64,
    block: usize,
}

/// The steepest slope in a straight line from the beginning of any piece to that of any other, as
/// far as it lies between two limits. With less, the extensions would miss the curve.
fn slope_across(pieces: &[Piece], blocks: &[Block], [least, most]: [f64; 2]) -> f64 {
    let mut slope = least;
    for (first, block) in blocks.iter().enumerate() {
        for (second, other) in blocks.iter().enumerate().skip(first) {
            let fall =
                (block.heights[1] - other.heights[0]).max(other.heights[1] - block.heights[0]);
            if fall <= slope * block.gap(other) {
                continue;
            }
            let within = |number: usize| pieces.iter().skip(number * BLOCK).take(BLOCK);
            for (from, to) in within(first).flat_map(|a| within(second).map(move |b| (a, b))) {
                let away = (from.from[0] - to.from[0]).hypot(from.from[1] - to.from[1]);
                let fall = (from.height - to.height).abs();
                if fall > slope * away {
                    slope = if fall < most * away { fall / away } else { most };
                }
            }
        }
    }
    slope
}

impl Piece {
    /// The piece between two points `[east, north, height]` if they are apart.
    fn new(from: [f64; 3], to: [f64; 3]) -> Option<Self> {
        let [east, north] = [to[0] - from[0], to[1] - from[1]];
        let length = east.hypot(north);
        (length > 0.0).then(|| Self {
            from: [from[0], from[1]],
            to: [to[0], to[1]],
            along: [east / length, north / length],
            length,
            height: from[2],
            rise: (to[2] - from[2]) / length,
            shift: 0.0,
        })
    }

    /// Place of a point along the piece, and its distance from the line.
    fn coordinates(&self, point: [f64; 2]) -> [f64; 2] {
        let [east, north] = [point[0] - self.from[0], point[1] - self.from[1]];
        let [x, y] = self.along;
        [east * x + north * y, (north * x - east * y).abs()]
    }

    fn distance_squared(&self, point: [f64; 2]) -> f64 {
        let [along, aside] = self.coordinates(point);
        let beyond = along - along.clamp(0.0, self.length);
        beyond * beyond + aside * aside
    }

    /// Height `along` and `aside` of the piece of the cone with the given slope that stands on
    /// the place on the piece which is `shift` from the nearest.
    fn cone(&self, along: f64, aside: f64, shift: f64, slope: f64) -> f64 {
        let foot = (along + shift).clamp(0.0, self.length);
        let beyond = along - foot;
        self.height + self.rise * foot + slope * (beyond * beyond + aside * aside).sqrt()
    }
}

impl Block {
    fn around(pieces: &[Piece]) -> Self {
        let mut block = Self {
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
            heights: [f64::INFINITY, f64::NEG_INFINITY],
        };
        for piece in pieces {
            for height in [piece.height, piece.height + piece.length * piece.rise] {
                block.heights = [block.heights[0].min(height), block.heights[1].max(height)];
            }
            for place in [piece.from, piece.to] {
                for (axis, x) in place.into_iter().enumerate() {
                    block.low[axis] = block.low[axis].min(x);
                    block.high[axis] = block.high[axis].max(x);
                }
            }
        }
        block
    }

    /// Distance to another box, 0 where they meet.
    fn gap(&self, other: &Self) -> f64 {
        let [x, y] = [0, 1].map(|axis| {
            (self.low[axis] - other.high[axis]).max(other.low[axis] - self.high[axis]).max(0.0)
        });
        x.hypot(y)
    }

    /// Square of the distance to the box, 0 within.
    fn distance_squared(&self, point: [f64; 2]) -> f64 {
        let [x, y] =
            [0, 1].map(|axis| point[axis] - point[axis].clamp(self.low[axis], self.high[axis]));
        x * x + y * y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A winding curve of 200 points that falls by 30 m, not evenly.
    fn winding() -> Vec<[f64; 3]> {
        (0..200)
            .map(f64::from)
            .map(|n| {
                [5.0 * n, 80.0 * (0.11 * n).sin() + 20.0 * (0.7 * n).cos(), 30.0 - 2.1 * n.sqrt()]
            })
            .collect()
    }

    /// Distance and height from a great many places on the curve, as the definitions have it.
    fn dense(points: &[[f64; 3]], slope: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        let [mut distance, mut above, mut below] =
            [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for pair in points.windows(2) {
            for part in 0..=400 {
                let share = f64::from(part) / 400.0;
                let [east, north, height] =
                    [0, 1, 2].map(|axis| pair[0][axis] + share * (pair[1][axis] - pair[0][axis]));
                let away = (east - x).hypot(north - y);
                distance = distance.min(away);
                above = above.min(height + slope * away);
                below = below.max(height - slope * away);
            }
        }
        [distance, 0.5 * (above + below)]
    }

    #[test]
    fn distances_and_heights_are_those_of_the_definition() {
        let points = winding();
        let course = Course::new(&points).unwrap();
        for number in 0..150 {
            let n = f64::from(number);
            let place = [(n * 37.7) % 1100.0 - 50.0, (n * 13.3) % 400.0 - 200.0];
            let [distance, height] = dense(&points, course.slope(), place);
            let nearest = course.nearest(place, 1e6).unwrap();
            assert!((nearest.distance - distance).abs() < 2e-3, "{place:?} {distance}");
            let [lowest, highest] = course.heights();
            let found = course.height(place, nearest);
            assert!((found - height.clamp(lowest, highest)).abs() < 1e-3, "{found} {height}");
        }
        assert!(course.nearest([500.0, 500.0], 10.0).is_none());
    }

    #[test]
    fn slopes_across_are_those_of_all_pairs() {
        let points = winding();
        let slopes = points.iter().flat_map(|a| {
            let slope = |b: &[f64; 3]| (a[2] - b[2]).abs() / (a[0] - b[0]).hypot(a[1] - b[1]);
            points[..199].iter().filter(move |b| *b != a).map(slope)
        });
        let expected = slopes.fold(0.0, f64::max);
        let found = Course::new(&points).unwrap().slope();
        let along = points
            .windows(2)
            .map(|p| (p[1][2] - p[0][2]).abs() / (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]));
        let along = along.fold(0.0, f64::max);
        assert_eq!(found, expected.clamp(LEAST * along, MOST * along));
        // A hairpin whose arms nearly touch is bounded.
        let hairpin = [[0.0, 0.0, 10.0], [100.0, 0.0, 5.0], [0.0, 0.01, 0.0], [-9.0, 1.0, 0.0]];
        assert_eq!(Course::new(&hairpin).unwrap().slope(), MOST * 0.05);
    }

    fn height(course: &Course, point: [f64; 2]) -> f64 {
        course.height(point, course.nearest(point, 1e6).unwrap())
    }

    #[test]
    fn the_curve_keeps_its_height() {
        let points = winding();
        let course = Course::new(&points).unwrap();
        for pair in points.windows(2) {
            let middle = [0, 1, 2].map(|axis| 0.5 * (pair[0][axis] + pair[1][axis]));
            assert!((height(&course, [middle[0], middle[1]]) - middle[2]).abs() < 1e-9);
        }
        // Beside a straight piece it is the height of the nearest place.
        let straight = Course::new(&[[0.0, 0.0, 0.0], [1000.0, 0.0, 50.0]]).unwrap();
        assert!((height(&straight, [500.0, 120.0]) - 25.0).abs() < 1e-9);
    }
}
