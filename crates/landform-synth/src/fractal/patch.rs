//! Noise at many points that are close together, such as the nodes of a tile.

use super::cells::CellNoise;

/// How many points are worked on together.
const LANES: usize = 64;

/// All cells of the rectangle that some points lie in, made before any value is computed: no
/// branch then depends on where a point lies, and the arithmetic of two points fills a vector.
pub(super) struct Patch<'a, N: CellNoise> {
    noise: &'a N,
    /// Column and row of the first cell.
    first: [f64; 2],
    columns: f64,
    cells: Vec<N::Cell>,
}

impl<'a, N: CellNoise> Patch<'a, N> {
    /// The cells of some points; `None` where these are too few for as many cells.
    pub fn over(noise: &'a N, points: &[[f64; 2]]) -> Option<Self> {
        let [low, high] = extent(points).map(|point| noise.skewed(point).map(f64::floor));
        let size = [0, 1].map(|axis| high[axis] - low[axis] + 1.0);
        let far = low.iter().chain(&high).any(|place| place.abs() > 1e9);
        let most = 3 * points.len().saturating_sub(8);
        if far || size[0] * size[1] > most as f64 {
            return None;
        }
        let [first_corner, last_corner] = N::CORNERS;
        let [columns, rows] = size.map(|count| count as i64);
        let [west, south] = low.map(|place| place as i64 + first_corner);
        let beyond = last_corner - first_corner;
        let stride = columns + beyond;
        let corners: Vec<N::Corner> = (south..south + rows + beyond)
            .flat_map(|row| (west..west + stride).map(move |column| (column, row)))
            .map(|(column, row)| noise.corner(column, row))
            .collect();
        let cell = |column: i64, row: i64| {
            let start = column - first_corner + stride * (row - first_corner);
            noise.cell(|east, north| corners[(start + east + stride * north) as usize])
        };
        let mut cells = Vec::with_capacity((columns * rows) as usize);
        for row in 0..rows {
            cells.extend((0..columns).map(|column| cell(column, row)));
        }
        Some(Self { noise, first: low, columns: size[0], cells })
    }

    /// The noise at the points that the patch was made for.
    pub fn fill(&self, points: &[[f64; 2]], values: &mut [f64]) {
        let [mut x, mut y, mut noise] = [[0.0; LANES]; 3];
        let mut cells = [0; LANES];
        let last = self.cells.len() - 1;
        for (points, values) in points.chunks(LANES).zip(values.chunks_mut(LANES)) {
            for (lane, &point) in points.iter().enumerate() {
                let [u, v] = self.noise.skewed(point);
                let corner = [floor(u), floor(v)];
                let [column, row] = [0, 1].map(|axis| corner[axis] - self.first[axis]);
                cells[lane] = whole(column + row * self.columns);
                [x[lane], y[lane]] = [u - corner[0], v - corner[1]];
            }
            for pair in 0..LANES / 2 {
                let [a, b] = [2 * pair, 2 * pair + 1];
                // A point that is no number may have any cell: its value is none in all of them.
                let cell = |lane: usize| &self.cells[last.min(cells[lane] as usize)];
                let [first, second] = [a, b].map(cell);
                noise[a] = self.noise.value(first, [x[a], y[a]]);
                noise[b] = self.noise.value(second, [x[b], y[b]]);
            }
            values.copy_from_slice(&noise[..values.len()]);
        }
    }
}

/// The least and the greatest coordinates of points.
fn extent(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    let widen = |extents: &mut [[[f64; 2]; 2]; 4], lane: usize, point: &[f64; 2]| {
        let [low, high] = &mut extents[lane];
        for axis in 0..2 {
            low[axis] = if point[axis] < low[axis] { point[axis] } else { low[axis] };
            high[axis] = if point[axis] > high[axis] { point[axis] } else { high[axis] };
        }
    };
    // Four at a time, as each comparison waits for the one before.
    let mut extents = [nothing; 4];
    let fours = points.chunks_exact(4);
    for (lane, point) in fours.remainder().iter().enumerate() {
        widen(&mut extents, lane, point);
    }
    for four in fours {
        for (lane, point) in four.iter().enumerate() {
            widen(&mut extents, lane, point);
        }
    }
    let [low, high] = [0, 1];
    [
        [0, 1].map(|axis| extents.iter().map(|e| e[low][axis]).fold(f64::INFINITY, f64::min)),
        [0, 1].map(|axis| extents.iter().map(|e| e[high][axis]).fold(f64::NEG_INFINITY, f64::max)),
    ]
}

/// Added to a number of less than 2^51, it leaves no place for a fraction.
const WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;

/// `f64::floor`, which is a call where processors have no instruction for it, of numbers of less
/// than 2^51.
#[inline(always)]
fn floor(number: f64) -> f64 {
    let nearest = (number + WHOLE) - WHOLE;
    nearest - if nearest > number { 1.0 } else { 0.0 }
}

/// A whole number from 0 to 2^32 as an integer, out of its last bits.
#[inline(always)]
fn whole(number: f64) -> u32 {
    (number + WHOLE).to_bits() as u32
}
