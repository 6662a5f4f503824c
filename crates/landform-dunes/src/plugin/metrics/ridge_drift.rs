//! How fast a single ridge moves, and how high it is.

use std::f64::consts::TAU;

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{field, measured};

/// A ridge of sand from north to south on a map that is periodic from west to east: the height of its mean
/// profile and its drift to the east, the mean of all measurements so far.
///
/// Ridges drift by flux over height (Momiji and Warren 2000). The place of the ridge is the mean place of all
/// sand on the ring of columns, so no crest needs to be found; between two measurements it may move
/// by less than half of the map.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RidgeDrift {
    /// Iterations of the stage before measurements count: the wind needs some to shape the ridge.
    pub warm_up_iterations: u64,
}

/// Where the ridge is, and what it did since the first measurement.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    /// Measurements, and the ticks of the first and the last one.
    ticks: [u64; 3],
    /// Place at the last one as an angle, the angles since the first and the heights together.
    sums: [f64; 3],
}

impl Keep for Walk {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.array("ticks", &self.ticks);
        to.array("sums", &self.sums);
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let mut walk = Self::default();
        walk.ticks.copy_from_slice(from.array_of("ticks", 3)?);
        walk.sums.copy_from_slice(from.array_of("sums", 3)?);
        Ok(walk)
    }
}

impl Walk {
    fn go_on(&mut self, tick: u64, lattice: &Lattice, sand: &[f64]) {
        let angle = mean_angle(lattice, sand);
        match self.ticks[0] {
            0 => self.ticks[1] = tick,
            _ => self.sums[1] += (angle - self.sums[0] + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0,
        }
        self.ticks[0] += 1;
        self.ticks[2] = tick;
        self.sums[0] = angle;
        self.sums[2] += crest_m(lattice, sand);
    }

    /// Mean height of the crest, in metres.
    fn height_m(&self) -> Option<f64> {
        (self.ticks[0] > 0).then(|| self.sums[2] / self.ticks[0] as f64)
    }

    /// Drift, in metres an iteration.
    fn drift_m(&self, lattice: &Lattice) -> Option<f64> {
        let ticks = self.ticks[2] - self.ticks[1];
        let ring_m = lattice.width() as f64 * lattice.spacing();
        (ticks > 0).then(|| self.sums[1] / TAU * ring_m / ticks as f64)
    }
}

/// Mean column of the sand on the ring of columns, as an angle.
fn mean_angle(lattice: &Lattice, sand: &[f64]) -> f64 {
    let turn = TAU / lattice.width() as f64;
    let [x, y] = sand.iter().enumerate().fold([0.0; 2], |[x, y], (node, sand)| {
        let angle = turn * (node % lattice.width()) as f64;
        [x + sand * angle.cos(), y + sand * angle.sin()]
    });
    y.atan2(x)
}

/// Height of the profile averaged along the crest.
fn crest_m(lattice: &Lattice, sand: &[f64]) -> f64 {
    let [width, height, _] = lattice.size();
    let column = |x: usize| (0..height).map(|row| sand[x + row * width]).sum::<f64>();
    (0..width).map(column).fold(0.0, f64::max) / height as f64
}

impl Metric for RidgeDrift {
    type Memory = Walk;
    const NAME: &'static str = "RidgeDrift";

    fn fields(&self) -> Vec<String> {
        vec!["sand".to_owned()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        match lattice.is_periodic(0) {
            true => Ok(()),
            false => {
                let message = "the map has a western and an eastern end, where a ridge stops";
                Err(Problem::new("", message, "a domain that is periodic from west to east"))
            }
        }
    }

    fn measure(
        &self,
        walk: &mut Walk,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let (clock, lattice) = (snapshot.clock(), snapshot.lattice());
        if clock.iteration >= self.warm_up_iterations {
            walk.go_on(clock.tick, lattice, &field(snapshot, "sand")?);
        }
        Ok(measured([
            ("ridge_height_m", walk.height_m()),
            ("ridge_drift_m_per_iteration", walk.drift_m(lattice)),
        ]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    /// A ridge that moves by 7 nodes of 3 m in 2 iterations, over the border of the map.
    #[test]
    fn a_ridge_that_is_shifted_has_its_drift() {
        let boundary = [Boundary::Periodic; 2];
        let lattice = Lattice::plane([64, 3], 3.0, Connectivity::Four, boundary).unwrap();
        let ridge = |at: usize| -> Vec<f64> {
            let away = |node: usize| ((node % 64 + 96 - at % 64) % 64).abs_diff(32);
            (0..64 * 3).map(|node| (10.0 - away(node) as f64).max(0.0)).collect()
        };
        let mut walk = Walk::default();
        for step in 0..12 {
            walk.go_on(5 + 2 * step, &lattice, &ridge(50 + 7 * step as usize));
        }
        assert!(walk.drift_m(&lattice).is_some_and(|drift| (drift - 10.5).abs() < 1e-9));
        assert_eq!(walk.height_m(), Some(10.0));
        let mut walk = Walk::default();
        assert_eq!((walk.height_m(), walk.drift_m(&lattice)), (None, None));
        walk.go_on(1, &lattice, &ridge(0));
        assert_eq!((walk.height_m(), walk.drift_m(&lattice)), (Some(10.0), None));
    }
}
