//! Slope, aspect and curvature from windows of 3 x 3 cells.

use rayon::prelude::*;

use crate::framed::Framed;
use crate::grid::{Grid, GridError};

/// How the three rows, or columns, of a window count in a difference across them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// 1 : 2 : 1 (Horn 1981), as most programs take slopes and shade relief.
    Horn,
    /// 0 : 1 : 0 (Zevenbergen and Thorne 1987): central differences. The sharpest, and the one
    /// that noise disturbs most.
    ZevenbergenThorne,
    /// 1 : 1 : 1 (Evans 1980): the least-squares quadric through nine heights. The calmest, and
    /// the usual one for curvature.
    Evans,
}

impl Scheme {
    /// Weights of the outer rows and of the one in the middle; they add up to 1.
    fn weights(self) -> [f64; 2] {
        match self {
            Self::Horn => [0.25, 0.5],
            Self::ZevenbergenThorne => [0.0, 1.0],
            Self::Evans => [1.0 / 3.0; 2],
        }
    }
}

/// Derivatives of a surface at one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// Rise over run of the steepest way.
    pub slope: f64,
    /// Where the steepest descent looks, in degrees clockwise from north, 0 to 360; NaN where
    /// the surface is level.
    pub aspect_deg: f64,
    /// Curvature of the vertical section along the slope, in 1/m; positive where it is convex
    /// (the slope grows downhill), NaN where the surface is level.
    pub profile_curvature: f64,
    /// Curvature of the contour line, in 1/m; positive on ridges and negative in valleys, NaN
    /// where the surface is level.
    pub plan_curvature: f64,
}

/// Derivatives at every cell; all NaN where one of the nine heights is missing, hence on the edge.
///
/// With p and q the derivatives of height to the east and north, and r, s, t the second ones:
/// slope `g = sqrt(p^2 + q^2)`, profile curvature `-(r p^2 + 2 s p q + t q^2) / (g^2 (1 + g^2)^1.5)`
/// and plan curvature `-(r q^2 - 2 s p q + t p^2) / g^3` (Evans 1980; Minar, Evans and Jenco 2020).
/// Every scheme is exact on quadratic surfaces.
///
/// # Errors
/// See [`GridError`].
///
/// # Example
/// ```
/// use landform_analysis::derivatives::{Scheme, derivatives};
/// use landform_analysis::grid::Grid;
///
/// let grid = Grid::new([3, 3], [10.0; 2])?;
/// let falls_east = [4.0, 2.0, 0.0].repeat(3);
/// let middle = derivatives(&grid, &falls_east, Scheme::Horn)?[4];
/// assert!((middle.slope - 0.2).abs() < 1e-12 && (middle.aspect_deg - 90.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn derivatives(
    grid: &Grid,
    heights: &[f64],
    scheme: Scheme,
) -> Result<Vec<Derivatives>, GridError> {
    grid.check(heights)?;
    let framed = Framed::new(grid, heights);
    let derive = |cell: usize| {
        let [column, row] = grid.position(cell);
        let window = framed.window(row).map(|row| [row[column], row[column + 1], row[column + 2]]);
        Derivatives::of(window, scheme.weights(), grid.cell_size())
    };
    Ok((0..heights.len()).into_par_iter().map(derive).collect())
}

impl Derivatives {
    /// From the rows of a window, north first.
    fn of(window: [[f64; 3]; 3], [side, middle]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        let across = |line: [f64; 3]| side * line[0] + middle * line[1] + side * line[2];
        let columns = [0, 1, 2].map(|x| across(window.map(|row| row[x])));
        let rows = window.map(across);
        let [[nw, _, ne], _, [sw, _, se]] = window;
        let p = (columns[2] - columns[0]) / (2.0 * width);
        let q = (rows[0] - rows[2]) / (2.0 * height);
        let r = (columns[0] - 2.0 * columns[1] + columns[2]) / (width * width);
        let t = (rows[0] - 2.0 * rows[1] + rows[2]) / (height * height);
        let s = (ne - nw - se + sw) / (4.0 * width * height);
        let squared = p * p + q * q;
        let slope = squared.sqrt();
        // Without a slope these are 0 / 0.
        let along = (r * p * p + 2.0 * s * p * q + t * q * q) / squared;
        let contour = (r * q * q - 2.0 * s * p * q + t * p * p) / squared;
        let level = if squared > 0.0 { 0.0 } else { f64::NAN };
        Self {
            slope,
            aspect_deg: level + (-p).atan2(-q).to_degrees().rem_euclid(360.0),
            profile_curvature: -along / (1.0 + squared).powf(1.5),
            plan_curvature: -contour / slope,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCHEMES: [Scheme; 3] = [Scheme::Horn, Scheme::ZevenbergenThorne, Scheme::Evans];

    fn surface(size: usize, cell: [f64; 2], height: impl Fn(f64, f64) -> f64) -> (Grid, Vec<f64>) {
        let grid = Grid::new([size, size], cell).unwrap();
        let middle = (size / 2) as f64;
        let at = |cell_number: usize| {
            let [x, y] = grid.position(cell_number).map(|place| place as f64 - middle);
            height(x * cell[0], -y * cell[1])
        };
        (grid, (0..grid.cell_count()).map(at).collect())
    }

    /// A dome of radius R: profile curvature 1 / R everywhere, contours of radius rho.
    #[test]
    fn a_sphere_has_the_curvature_of_its_radius() {
        let radius = 1000.0_f64;
        let (grid, dome) =
            surface(101, [2.0, 3.0], |x, y| (radius * radius - x * x - y * y).sqrt());
        for scheme in SCHEMES {
            let all = derivatives(&grid, &dome, scheme).unwrap();
            for [column, row] in [[60, 50], [50, 20], [80, 30], [10, 90]] {
                let [x, y] = [2.0 * (column as f64 - 50.0), -3.0 * (row as f64 - 50.0)];
                let distance = x.hypot(y);
                let found = all[column + 101 * row];
                let slope = distance / (radius * radius - distance * distance).sqrt();
                assert!((found.slope / slope - 1.0).abs() < 1e-3, "{scheme:?} {found:?}");
                let aspect = x.atan2(y).to_degrees().rem_euclid(360.0);
                assert!((found.aspect_deg - aspect).abs() < 0.01, "{scheme:?} {found:?}");
                assert!((found.profile_curvature * radius - 1.0).abs() < 2e-3, "{found:?}");
                assert!((found.plan_curvature * distance - 1.0).abs() < 2e-3, "{found:?}");
            }
        }
    }

    #[test]
    fn quadrics_are_exact() {
        let quadric = |x: f64, y: f64| 1.0 + 0.3 * x - 0.4 * y + 0.01 * x * x + 0.02 * x * y;
        let (grid, heights) = surface(5, [3.0, 5.0], quadric);
        for scheme in SCHEMES {
            let found = derivatives(&grid, &heights, scheme).unwrap()[12];
            let [p, q, r, s] = [0.3_f64, -0.4, 0.02, 0.02];
            assert!((found.slope - 0.5).abs() < 1e-12, "{scheme:?} {found:?}");
            let along = (r * p * p + 2.0 * s * p * q) / 0.25 / 1.25_f64.powf(1.5);
            assert!((found.profile_curvature + along).abs() < 1e-12, "{scheme:?} {found:?}");
            let contour = (r * q * q - 2.0 * s * p * q) / 0.125;
            assert!((found.plan_curvature + contour).abs() < 1e-12, "{scheme:?} {found:?}");
        }
    }

    #[test]
    fn edges_gaps_and_level_ground_say_so() {
        let (grid, mut heights) = surface(5, [1.0; 2], |_, _| 7.0);
        heights[0] = f64::NAN;
        let all = derivatives(&grid, &heights, Scheme::ZevenbergenThorne).unwrap();
        assert!(all[1].slope.is_nan() && all[6].slope.is_nan(), "beside a gap");
        assert_eq!(all[12].slope, 0.0);
        assert!(all[12].aspect_deg.is_nan() && all[12].plan_curvature.is_nan());
    }
}
