//! Lines on a plane or on the sphere.

use thiserror::Error;

/// Why points do not make a line.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PolylineError {
    /// A single point, or none, has no length.
    #[error("a line of {0} points; it takes at least 2")]
    TooShort(usize),
    /// A coordinate is infinite or not a number, or so large that its square could be.
    #[error("point {index} is at {point:?}; coordinates must be finite and below 1e100")]
    NotFinite {
        /// Index of the point.
        index: usize,
        /// The point.
        point: [f64; 2],
    },
    /// A place that is not on the globe.
    #[error(
        "point {index} is at longitude {}, latitude {}; longitudes run from -360 to 360 degrees \
         and latitudes from -90 to 90; give projected coordinates as x and y",
        point[0], point[1]
    )]
    OffGlobe {
        /// Index of the point.
        index: usize,
        /// Longitude and latitude in degrees.
        point: [f64; 2],
    },
}

/// A line of straight pieces in metres, on a plane or on the sphere.
///
/// Points on the sphere are kept in three dimensions and joined by chords, so the poles and the
/// date line need no care. A chord of 100 km is 1 m shorter than the arc above it.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    points: Vec<[f64; 3]>,
    on_sphere: bool,
}

impl Polyline {
    /// Mean radius of the Earth (IUGG), 6 371 008.8 m.
    pub const EARTH_RADIUS_M: f64 = 6_371_008.8;

    /// A line through points `[x, y]` of a plane, in metres.
    ///
    /// # Errors
    /// [`PolylineError::TooShort`], [`PolylineError::NotFinite`].
    pub fn planar(points: &[[f64; 2]]) -> Result<Self, PolylineError> {
        check(points)?;
        let points = points.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        Ok(Self { points, on_sphere: false })
    }

    /// A line through points `[longitude, latitude]` in degrees, on a sphere of
    /// [`Polyline::EARTH_RADIUS_M`].
    ///
    /// # Errors
    /// See [`PolylineError`].
    pub fn geographic(points: &[[f64; 2]]) -> Result<Self, PolylineError> {
        check(points)?;
        let off = |[lon, lat]: &[f64; 2]| lon.abs() > 360.0 || lat.abs() > 90.0;
        if let Some(index) = points.iter().position(off) {
            return Err(PolylineError::OffGlobe { index, point: points[index] });
        }
        let points = points.iter().map(|&place| on_globe(place)).collect();
        Ok(Self { points, on_sphere: true })
    }

    /// The points in metres: `[x, y, 0]` on a plane, from the centre of the Earth on the sphere.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// Whether the line ends where it starts.
    pub fn is_closed(&self) -> bool {
        self.points.first() == self.points.last()
    }

    /// Whether the points lie on the sphere.
    pub fn is_on_sphere(&self) -> bool {
        self.on_sphere
    }

    /// Length in metres.
    pub fn length_m(&self) -> f64 {
        self.points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
    }
}

/// Distance of two points.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (x * x + y * y + z * z).sqrt()
}

fn check(points: &[[f64; 2]]) -> Result<(), PolylineError> {
    if points.len() < 2 {
        return Err(PolylineError::TooShort(points.len()));
    }
    let bad =
        |point: &[f64; 2]| point.iter().any(|value| !value.is_finite() || value.abs() > 1e100);
    match points.iter().position(bad) {
        Some(index) => Err(PolylineError::NotFinite { index, point: points[index] }),
        None => Ok(()),
    }
}

fn on_globe([lon, lat]: [f64; 2]) -> [f64; 3] {
    let [lon, lat] = [lon.to_radians(), lat.to_radians()];
    let axis = Polyline::EARTH_RADIUS_M * lat.cos();
    [axis * lon.cos(), axis * lon.sin(), Polyline::EARTH_RADIUS_M * lat.sin()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A degree of a great circle is 111.195 km long, also across the date line and a pole.
    #[test]
    fn degrees_are_measured_on_the_sphere() {
        let degree = Polyline::EARTH_RADIUS_M * std::f64::consts::PI / 180.0;
        let length = |points: &[[f64; 2]]| Polyline::geographic(points).unwrap().length_m();
        for points in [
            [[0.0, 0.0], [1.0, 0.0]],
            [[179.5, 0.0], [-179.5, 0.0]],
            [[10.0, 89.5], [-170.0, 89.5]],
            [[20.0, 50.0], [20.0, 51.0]],
        ] {
            let ratio = length(&points) / degree;
            assert!((1.0 - ratio).abs() < 2e-5, "{points:?}: {ratio}");
        }
        let parallel = length(&[[0.0, 60.0], [0.01, 60.0]]);
        assert!((parallel / (0.005 * degree) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn what_is_no_line_is_refused() {
        assert_eq!(Polyline::planar(&[[1.0, 2.0]]), Err(PolylineError::TooShort(1)));
        let infinite = [[0.0, 0.0], [f64::INFINITY, 0.0]];
        assert!(matches!(
            Polyline::planar(&infinite),
            Err(PolylineError::NotFinite { index: 1, .. })
        ));
        let off = [[0.0, 0.0], [3.0, 91.0]];
        assert!(matches!(
            Polyline::geographic(&off),
            Err(PolylineError::OffGlobe { index: 1, .. })
        ));
    }
}
