//! The noises against their definitions, written a second time.

use landform_sim::random::{RandomStream, unit};

use super::cells::{CellNoise, Cells};
use super::cellular::{CellularFeature, CellularNoise};
use super::gradient::{Directions, GradientNoise, SimplexNoise};

fn cells() -> Cells {
    Cells::new(&RandomStream::new(11, "test"), 2, [0, 0]).0
}

/// A row of points that leaves cells slowly and quickly, on both sides of zero.
fn points() -> Vec<[f64; 2]> {
    (0..4000).map(|n| f64::from(n) - 2000.0).map(|n| [n * 0.013, (n * 0.1).sin() * 3.0]).collect()
}

/// The row gives the bits of the noise at single points, all of them between -1 and 1.
fn rows_agree_with_points(noise: &impl CellNoise) {
    let points = points();
    let mut row = vec![f64::NAN; points.len()];
    noise.row(&points, &mut row);
    for (&value, &point) in row.iter().zip(&points) {
        assert_eq!(value.to_bits(), noise.at(point).to_bits(), "{point:?}");
        assert!((-1.0..=1.0).contains(&value), "{value} at {point:?}");
    }
    let most = row.iter().copied().fold(-1.0, f64::max);
    let least = row.iter().copied().fold(1.0, f64::min);
    assert!(most - least > 0.8, "{least} to {most}");
}

#[test]
fn rows_agree_with_single_points() {
    let directions = Directions::shared();
    rows_agree_with_points(&GradientNoise { cells: cells(), directions });
    rows_agree_with_points(&SimplexNoise { cells: cells(), directions });
    use CellularFeature::{Difference, Nearest, Second};
    for feature in [Nearest, Second, Difference] {
        rows_agree_with_points(&CellularNoise { cells: cells(), feature });
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
