//! Degrees on a plane of metres.

use super::{LineCoordinates, LineFile};
use crate::georeference::metres_per_degree;

/// A plane of metres that is true to the Earth along one parallel: x east of a meridian and y
/// north of a parallel, from degrees by one factor each (ellipsoid of WGS 84).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalPlane {
    /// Longitude and latitude where x and y are 0.
    pub origin: [f64; 2],
    /// Length of a degree of longitude and of latitude in metres.
    pub metres_per_degree: [f64; 2],
}

impl LocalPlane {
    /// The plane with its origin at the south-western corner of lines in degrees, true along
    /// their middle parallel.
    pub fn around(lines: &[Vec<[f64; 2]>]) -> Self {
        let [[west, south], [_, north]] = extent(lines);
        let metres_per_degree = metres_per_degree(0.5 * (south + north));
        Self { origin: [west, south], metres_per_degree }
    }

    /// Metres east and north of the origin.
    pub fn project(&self, degrees: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (degrees[axis] - self.origin[axis]) * self.metres_per_degree[axis])
    }
}

impl LineFile {
    /// The lines in metres, and the plane they lie on when the file has degrees.
    pub fn into_metres(self) -> (Vec<Vec<[f64; 2]>>, Option<LocalPlane>) {
        if self.coordinates == LineCoordinates::Planar {
            return (self.lines, None);
        }
        let plane = LocalPlane::around(&self.lines);
        let mut lines = self.lines;
        lines.iter_mut().flatten().for_each(|point| *point = plane.project(*point));
        (lines, Some(plane))
    }
}

/// Least and greatest coordinates of all points: the south-western and north-eastern corner.
pub fn extent(lines: &[Vec<[f64; 2]>]) -> [[f64; 2]; 2] {
    let none = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    lines.iter().flatten().fold(none, |[low, high], point| {
        [
            [0, 1].map(|axis| low[axis].min(point[axis])),
            [0, 1].map(|axis| high[axis].max(point[axis])),
        ]
    })
}
