//! The noises against their definitions, written a second time.

use landform_sim::random::{RandomStream, unit};

use super::cells::{CellNoise, Cells};
use super::cellular::{CellularFeature, CellularNoise};
use super::gradient::{Directions, GradientNoise, SimplexNoise};
use super::patch::Patch;

fn cells() -> Cells {
    Cells::new(&RandomStream::new(11, "test"), 2, [0, 0]).0
}

/// A row of points that leaves cells slowly and quickly, on both sides of zero.
fn points() -> Vec<[f64; 2]> {
    (0..4000).map(|n| f64::from(n) - 2000.0).map(|n| [n * 0.013, (n * 0.1).sin() * 3.0]).collect()
}

/// Points of a turned tile, on both sides of zero, with corners of cells among them.
fn tile(count: usize, step: f64) -> Vec<[f64; 2]> {
    let place = |n: usize| [n % 37, n / 37].map(|steps| steps as f64 * step - 5.0);
    let turn = |[x, y]: [f64; 2]| [x + 0.75 * y, y - 0.75 * x];
    (0..count).map(place).map(turn).collect()
}

/// Both ways to many values give the bits of the noise at single points, all between -1 and 1.
fn many_agree_with_one(noise: &impl CellNoise) {
    let patches = [tile(1036, 0.25), tile(37 * 29 + 1, 0.4), tile(64, 0.1), tile(11, 0.02)];
    for points in patches.into_iter().chain([points()]) {
        let [mut patch, mut in_turn] = [(); 2].map(|()| vec![f64::NAN; points.len()]);
        Patch::over(noise, &points).expect("points close together").fill(&points, &mut patch);
        noise.fill_in_turn(&points, &mut in_turn);
        for ((&point, patch), in_turn) in points.iter().zip(&patch).zip(&in_turn) {
            let expected = noise.at(point);
            assert_eq!(patch.to_bits(), expected.to_bits(), "{point:?}");
            assert_eq!(in_turn.to_bits(), expected.to_bits(), "{point:?}");
            assert!((-1.0..=1.0).contains(patch), "{patch} at {point:?}");
        }
        if points.len() > 1000 {
            let most = patch.iter().copied().fold(-1.0, f64::max);
            let least = patch.iter().copied().fold(1.0, f64::min);
            assert!(most - least > 0.8, "{least} to {most}");
        }
    }
}

#[test]
fn many_points_agree_with_single_ones() {
    let directions = Directions::shared();
    many_agree_with_one(&GradientNoise { cells: cells(), directions });
    many_agree_with_one(&SimplexNoise { cells: cells(), directions });
    use CellularFeature::{Difference, Nearest, Second};
    for feature in [Nearest, Second, Difference] {
        many_agree_with_one(&CellularNoise { cells: cells(), feature });
    }
}

/// Points all over make no patch; one that is no number has no value and harms no other.
#[test]
fn odd_points_are_borne() {
    let noise = GradientNoise { cells: cells(), directions: Directions::shared() };
    let far = [1e300, f64::INFINITY, 400.0].map(|place| [[0.0, 0.0], [place, 0.0]].repeat(20));
    for points in far {
        assert!(Patch::over(&noise, &points).is_none());
    }
    assert!(Patch::over(&noise, &[[0.5, 0.5]]).is_none(), "one point is not worth a patch");
    let mut points = tile(100, 0.1);
    points[50] = [f64::NAN; 2];
    let mut values = vec![0.0; 100];
    noise.fill(&points, &mut values);
    for (number, value) in values.iter().enumerate() {
        assert_eq!(value.is_nan(), number == 50);
    }
}

/// Perlin's noise as it is usually written: the heights of four planes, blended along one axis
/// and then along the other.
#[test]
fn gradient_noise_is_perlins() {
    let directions = Directions::shared();
    let noise = GradientNoise { cells: cells(), directions };
    for [x, y] in points() {
        let [column, row] = [x.floor(), y.floor()];
        let height = |east: i64, north: i64| {
            let slope = noise.corner(column as i64 + east, row as i64 + north);
            slope[0] * (x - column - east as f64) + slope[1] * (y - row - north as f64)
        };
        let fade = |t: f64| 6.0 * t.powi(5) - 15.0 * t.powi(4) + 10.0 * t.powi(3);
        let [across, up] = [fade(x - column), fade(y - row)];
        let south = (1.0 - across) * height(0, 0) + across * height(1, 0);
        let north = (1.0 - across) * height(0, 1) + across * height(1, 1);
        let expected = 2.0_f64.sqrt() * ((1.0 - up) * south + up * north);
        assert!((noise.at([x, y]) - expected).abs() < 1e-14, "{x}, {y}");
    }
}

/// Noise is 0 at the corners of its cells, where it has the slope of the corner's gradient.
#[test]
fn gradient_noises_have_the_gradients_of_their_corners() {
    let directions = Directions::shared();
    let square = GradientNoise { cells: cells(), directions };
    let triangle = SimplexNoise { cells: cells(), directions };
    let slope = |noise: &dyn Fn([f64; 2]) -> f64, [x, y]: [f64; 2]| {
        let step = 1e-6;
        let east = (noise([x + step, y]) - noise([x - step, y])) / (2.0 * step);
        let north = (noise([x, y + step]) - noise([x, y - step])) / (2.0 * step);
        east.hypot(north)
    };
    for column in -20..20 {
        let corner = [f64::from(column), -3.0];
        assert!(square.at(corner).abs() < 1e-12);
        let steepness = slope(&|point| square.at(point), corner);
        assert!((steepness - 2.0_f64.sqrt()).abs() < 1e-6, "{steepness}");
        // In rows of odd numbers the corners of triangles lie half a base further.
        let corner = [f64::from(column) + 0.5, -3.0];
        assert!(triangle.at(corner).abs() < 1e-12);
        let steepness = slope(&|point| triangle.at(point), corner);
        assert!((steepness - (0.8 / 0.55_f64).powi(4)).abs() < 1e-6, "{steepness}");
    }
}

/// No step where a point goes from one cell to the next.
#[test]
fn noises_are_continuous() {
    let directions = Directions::shared();
    let square = GradientNoise { cells: cells(), directions };
    let triangle = SimplexNoise { cells: cells(), directions };
    let cellular = CellularNoise { cells: cells(), feature: CellularFeature::Second };
    let step = 1e-7;
    for point in points() {
        let next = [point[0] + step, point[1] - step];
        for change in [
            square.at(next) - square.at(point),
            triangle.at(next) - triangle.at(point),
            cellular.at(next) - cellular.at(point),
        ] {
            assert!(change.abs() < 20.0 * step, "{change} at {point:?}");
        }
    }
}

/// Distances to the nearest two of all points far around, sorted.
#[test]
fn cellular_noise_is_the_distance_to_the_nearest_points() {
    let cells = cells();
    let nearest = CellularNoise { cells, feature: CellularFeature::Nearest };
    let second = CellularNoise { cells, feature: CellularFeature::Second };
    let difference = CellularNoise { cells, feature: CellularFeature::Difference };
    for [x, y] in points().into_iter().step_by(7) {
        let [column, row] = [x.floor() as i64, y.floor() as i64];
        let mut distances: Vec<f64> = (-6..=6)
            .flat_map(|north| (-6..=6).map(move |east| [column + east, row + north]))
            .map(|[column, row]| {
                let bits = cells.bits(column, row);
                let east = column as f64 + unit(bits as u32) - x;
                east.hypot(row as f64 + unit((bits >> 32) as u32) - y)
            })
            .collect();
        distances.sort_by(f64::total_cmp);
        let expected = [
            2.0 * distances[0] / 2.0_f64.sqrt() - 1.0,
            2.0 * distances[1] / 2.5_f64.sqrt() - 1.0,
            2.0 * (distances[1] - distances[0]) / 2.5_f64.sqrt() - 1.0,
        ];
        let found = [nearest.at([x, y]), second.at([x, y]), difference.at([x, y])];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found}, {expected}");
        }
    }
}

/// Cells repeat after their period, and no sooner.
#[test]
fn periodic_noise_repeats() {
    let stream = RandomStream::new(3, "test");
    let directions = Directions::shared();
    let cells = Cells::new(&stream, 0, [5, 4]).0;
    let square = GradientNoise { cells, directions };
    let triangle = SimplexNoise { cells, directions };
    let cellular = CellularNoise { cells, feature: CellularFeature::Nearest };
    let noises: [&dyn Fn([f64; 2]) -> f64; 3] =
        [&|point| square.at(point), &|point| triangle.at(point), &|point| cellular.at(point)];
    for noise in noises {
        let change = |by: [f64; 2]| {
            let differences = points()
                .into_iter()
                .step_by(11)
                .map(|[x, y]| (noise([x + by[0], y + by[1]]) - noise([x, y])).abs());
            differences.fold(0.0, f64::max)
        };
        assert!(change([5.0, 0.0]) < 1e-9 && change([0.0, 4.0]) < 1e-9);
        assert!(change([-10.0, 8.0]) < 1e-9);
        assert!(change([1.0, 0.0]) > 0.1 && change([0.0, 2.0]) > 0.1);
    }
}
