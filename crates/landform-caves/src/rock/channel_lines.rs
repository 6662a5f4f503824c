//! Channels drawn by hand.

use glam::DVec3;
use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values_of;
use crate::CaveError;
use crate::error::check_range;

/// Channels along lines (thesis, figure 5.6: protochannels that are constructed): one value in them, 0
/// elsewhere. Laid into rock with `combine: Max`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ChannelLines {
    /// Porosity in the channels.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub porosity: f64,
    /// Each line is a list of points: shares of the way from west to east, south to north and the
    /// lowest layer to the highest.
    pub lines: Vec<Vec<[f64; 3]>>,
    /// Distance from the line within which voxels belong to the channel; at least those that the line
    /// passes.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    pub radius_m: f64,
}

impl Default for ChannelLines {
    fn default() -> Self {
        let lines = vec![vec![[0.5, 0.5, 1.0], [0.5, 0.5, 0.5]]];
        Self { porosity: 0.3, lines, radius_m: 0.0 }
    }
}

impl ChannelLines {
    /// The porosity of the channels, 0 beside them, in node order.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`]; [`CaveError::Outside`] for a point that is not in the domain.
    pub fn fill(&self, lattice: &Lattice) -> Result<Vec<f64>, CaveError> {
        check_range("porosity", self.porosity, [0.0, 1.0])?;
        check_range("radius_m", self.radius_m, [0.0, 1e9])?;
        let last = lattice.size().map(|size| (size - 1) as f64 * lattice.spacing());
        let point = |share: &[f64; 3]| match share.iter().all(|share| (0.0..=1.0).contains(share)) {
            true => Ok(DVec3::from_array(*share) * DVec3::from_array(last)),
            false => Err(CaveError::Outside { center: *share }),
        };
        let mut segments = Vec::new();
        for line in &self.lines {
            let points = line.iter().map(point).collect::<Result<Vec<DVec3>, _>>()?;
            segments.extend(points.windows(2).map(|ends| (ends[0], ends[1])));
        }
        // Just over half a diagonal of a face, so that what lies between two voxels has one of them.
        let reach = self.radius_m.max(0.51 * lattice.spacing() * 2.0_f64.sqrt());
        let value = |node: usize| {
            let at = lattice.position(node);
            let inside = segments.iter().any(|&ends| distance_to(ends, at) <= reach);
            if inside { self.porosity } else { 0.0 }
        };
        Ok((0..lattice.node_count()).into_par_iter().map(value).collect())
    }
}

/// Distance of a point from a segment.
fn distance_to((from, to): (DVec3, DVec3), at: DVec3) -> f64 {
    let way = to - from;
    let length = way.length_squared();
    let share = if length > 0.0 { ((at - from).dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
    at.distance(from + way * share)
}

impl InitialCondition for ChannelLines {
    const NAME: &'static str = "ChannelLines";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        values_of(context, |lattice, _| self.fill(lattice))
    }
}
