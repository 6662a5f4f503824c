//! Polygons with smooth edges.

use super::source::unusable;
use crate::SynthError;
use crate::course::Course;

/// Rings made ready: within an odd number of them is inside.
#[derive(Debug)]
pub(super) struct Outline {
    rings: Vec<Course>,
    /// Width of the border.
    edge: f64,
}

impl Outline {
    /// Rings of three points or more, scaled and moved.
    pub fn new(
        rings: &[Vec<[f64; 2]>],
        at: [f64; 2],
        scale: f64,
        edge: f64,
    ) -> Result<Self, SynthError> {
        let placed = |&[x, y]: &[f64; 2]| [at[0] + scale * x, at[1] + scale * y, 0.0];
        let ready = rings.iter().enumerate().map(|(number, ring)| {
            // A ring that is closed already gets a last piece without length, which is dropped.
            let mut points: Vec<[f64; 3]> = ring.iter().map(placed).collect();
            points.extend(points.first().copied());
            let flat = || unusable(format!("all points of ring {number} are at one place"));
            Course::new(&points).ok_or_else(flat)
        });
        Ok(Self { rings: ready.collect::<Result<_, _>>()?, edge })
    }

    /// Number of points of all rings.
    pub fn points(&self) -> usize {
        self.rings.iter().map(Course::points).sum()
    }

    /// Share that is inside: 1/2 on the rings, 0 and 1 half an edge away.
    pub fn share(&self, point: [f64; 2]) -> f64 {
        let reach = 0.5 * self.edge;
        let away = self.rings.iter().filter_map(|ring| ring.nearest(point, reach));
        let distance = away.map(|nearest| nearest.distance).fold(reach, f64::min);
        let crossings: usize = self.rings.iter().map(|ring| ring.crossings(point)).sum();
        let inside = if crossings % 2 == 1 { distance } else { -distance };
        0.5 + inside / self.edge
    }

    /// Largest change of the share a metre.
    pub fn slope(&self) -> f64 {
        1.0 / self.edge
    }

    /// Whether the rings and their edges lie between 0 and `extent` along an axis.
    pub fn is_within(&self, axis: usize, extent: f64) -> bool {
        self.rings.iter().all(|ring| {
            let [low, high] = ring.extent();
            low[axis] - 0.5 * self.edge >= 0.0 && high[axis] + 0.5 * self.edge <= extent
        })
    }
}
