//! Gradient noise on squares (Perlin 1985, 2002) and on triangles (simplex noise; Perlin 2001,
//! Gustavson 2005).

use std::f64::consts::{SQRT_2, TAU};
use std::sync::LazyLock;

use super::cells::{CellNoise, Cells, wrapped};

/// Unit vectors evenly around the circle, one of which a random number picks.
#[derive(Debug)]
pub(super) struct Directions([[f64; 2]; 256]);

static SHARED: LazyLock<Directions> = LazyLock::new(|| {
    Directions(std::array::from_fn(|number| {
        let (north, east) = (TAU * number as f64 / 256.0).sin_cos();
        [east, north]
    }))
});

impl Directions {
    /// The one table of them.
    pub fn shared() -> &'static Self {
        &SHARED
    }

    #[inline]
    fn pick(&self, bits: u64) -> [f64; 2] {
        self.0[(bits >> 56) as usize]
    }
}

/// The height at `offset` from its foot of a plane that rises along `gradient`.
#[inline]
fn plane(gradient: [f64; 2], offset: [f64; 2]) -> f64 {
    gradient[0] * offset[0] + gradient[1] * offset[1]
}

/// The four corners of a unit square: south-west, south-east, north-west, north-east.
const CORNERS: [[i64; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

/// Perlin's gradient noise: a plane through 0 at every corner of a square grid, blended with
/// the quintic that has no first and second derivative at its ends.
#[derive(Debug)]
pub(super) struct GradientNoise {
    pub cells: Cells,
    pub directions: &'static Directions,
}

impl CellNoise for GradientNoise {
    type Corner = [f64; 2];
    /// Four planes as their heights at the south-western corner and slopes to the east and north:
    /// that of this corner, what it changes by to the east, to the north, and what the change to
    /// the east changes by to the north.
    type Cell = [[f64; 3]; 4];
    const CORNERS: [i64; 2] = [0, 1];

    #[inline]
    fn corner(&self, column: i64, row: i64) -> [f64; 2] {
        self.directions.pick(self.cells.bits(column, row))
    }

    #[inline]
    fn cell(&self, corner: impl Fn(i64, i64) -> [f64; 2]) -> Self::Cell {
        let [south_west, south_east, north_west, north_east] = CORNERS.map(|[x, y]| {
            // Four unit gradients that point at the middle give the largest value, 1 / sqrt 2.
            let [east, north] = corner(x, y).map(|slope| SQRT_2 * slope);
            [-east * x as f64 - north * y as f64, east, north]
        });
        let change = |from: [f64; 3], to: [f64; 3]| [0, 1, 2].map(|part| to[part] - from[part]);
        let south = change(south_west, south_east);
        let north = change(north_west, north_east);
        [south_west, south, change(south_west, north_west), change(south, north)]
    }

    #[inline(always)]
    fn value(&self, planes: &Self::Cell, [x, y]: [f64; 2]) -> f64 {
        let fade = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
        let plane = |[height, east, north]: [f64; 3]| height + east * x + north * y;
        let [across, up] = [fade(x), fade(y)];
        let south = plane(planes[0]) + across * plane(planes[1]);
        let rise = plane(planes[2]) + across * plane(planes[3]);
        south + up * rise
    }
}

/// Simplex noise on triangles with a base and a height of one wavelength, which repeat along
/// straight axes (Gustavson and McEwan 2022): rows of corners lie half a base apart.
#[derive(Debug)]
pub(super) struct SimplexNoise {
    pub cells: Cells,
    pub directions: &'static Directions,
}

/// Square of the distance at which a corner's share ends: the opposite side of its triangles
/// is no nearer.
const REACH_SQUARED: f64 = 0.8;

/// Brings simplex noise to -1..1: the largest sum is in the middle of a base, between two
/// gradients that point there.
const SIMPLEX_SCALE: f64 = 1.0 / (0.55 * 0.55 * 0.55 * 0.55);

impl CellNoise for SimplexNoise {
    type Corner = [f64; 2];
    type Cell = [[f64; 2]; 4];
    const CORNERS: [i64; 2] = [0, 1];

    #[inline]
    fn skewed(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x + 0.5 * y, y]
    }

    #[inline]
    fn corner(&self, column: i64, row: i64) -> [f64; 2] {
        let [columns, rows] = self.cells.period();
        // Twice the distance east, which is whole, and which goes round without skew.
        let half_bases = wrapped(2 * column - row, 2 * columns);
        self.directions.pick(self.cells.hash(half_bases, wrapped(row, rows)))
    }

    #[inline]
    fn cell(&self, corner: impl Fn(i64, i64) -> [f64; 2]) -> Self::Cell {
        CORNERS.map(|[east, north]| corner(east, north))
    }

    #[inline(always)]
    fn value(&self, gradients: &Self::Cell, [u, v]: [f64; 2]) -> f64 {
        let share = |corner: usize| {
            let [east, north] = CORNERS[corner].map(|number| number as f64);
            let offset = [u - east - 0.5 * (v - north), v - north];
            let near = (REACH_SQUARED - plane(offset, offset)).max(0.0);
            near * near * (near * near) * plane(gradients[corner], offset)
        };
        let middle = if u > v { share(1) } else { share(2) };
        SIMPLEX_SCALE * (share(0) + middle + share(3))
    }
}
