//! Lines of the sphere on a plane.

use crate::Polyline;

/// The lines on a plane, with their least coordinates at 0: x to the east and y to the north, in
/// metres.
///
/// Lines on the sphere are laid there by Lambert's azimuthal equal-area projection about their
/// middle, which keeps areas everywhere and lengths within 1 % up to 1800 km from it.
pub fn on_plane(lines: &[Polyline]) -> Vec<Vec<[f64; 2]>> {
    let middle = middle(lines);
    let flat = |line: &Polyline| -> Vec<[f64; 2]> {
        let points = line.points().iter();
        match line.is_on_sphere() {
            true => points.map(|&point| equal_area(point, middle)).collect(),
            false => points.map(|&[x, y, _]| [x, y]).collect(),
        }
    };
    let mut lines: Vec<Vec<[f64; 2]>> = lines.iter().map(flat).collect();
    let least = |axis: usize| lines.iter().flatten().map(|p| p[axis]).fold(f64::MAX, f64::min);
    let least = [least(0), least(1)];
    for point in lines.iter_mut().flatten() {
        *point = [point[0] - least[0], point[1] - least[1]];
    }
    lines
}

/// Direction from the centre of the Earth to the mean of all points, as a unit vector.
fn middle(lines: &[Polyline]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for point in lines.iter().flat_map(|line| line.points()) {
        sum = std::array::from_fn(|axis| sum[axis] + point[axis]);
    }
    let length = sum.iter().map(|value| value * value).sum::<f64>().sqrt();
    // Points all over the globe have no middle; any will do.
    if length > 0.0 { sum.map(|value| value / length) } else { [0.0, 0.0, 1.0] }
}

/// Lambert's azimuthal equal-area projection about the unit vector `middle`.
fn equal_area(point: [f64; 3], middle: [f64; 3]) -> [f64; 2] {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let flat = (middle[0] * middle[0] + middle[1] * middle[1]).sqrt();
    let east =
        if flat > 0.0 { [-middle[1] / flat, middle[0] / flat, 0.0] } else { [0.0, 1.0, 0.0] };
    let north = [
        middle[1] * east[2] - middle[2] * east[1],
        middle[2] * east[0] - middle[0] * east[2],
        middle[0] * east[1] - middle[1] * east[0],
    ];
    let cosine = dot(point, middle) / Polyline::EARTH_RADIUS_M;
    let stretch = (2.0 / (1.0 + cosine).max(1e-9)).sqrt();
    [stretch * dot(point, east), stretch * dot(point, north)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A degree at the middle is as long as on the sphere, east is to the right and north is up.
    #[test]
    fn places_lie_as_on_a_map() {
        let degree = Polyline::EARTH_RADIUS_M.to_radians();
        let cross = [[9.5, 50.0], [10.0, 50.5], [10.5, 50.0], [10.0, 49.5]];
        let line = Polyline::geographic(&cross).unwrap();
        let [west, north, east, south] = on_plane(&[line])[0][..] else { panic!("four points") };
        let across = (50.0_f64).to_radians().cos() * degree;
        assert!((east[0] - west[0] - across).abs() < 1e-4 * degree, "{west:?} {east:?}");
        assert!((north[1] - south[1] - degree).abs() < 1e-4 * degree, "{north:?} {south:?}");
        let flat = Polyline::planar(&[[3.0, 4.0], [5.0, 1.0]]).unwrap();
        assert_eq!(on_plane(&[flat])[0], [[0.0, 3.0], [2.0, 0.0]]);
        assert!(on_plane(&[]).is_empty());
    }
}
