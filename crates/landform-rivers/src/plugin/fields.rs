//! Fields of rivers.

use bevy_ecs::world::World;
use landform_sim::field::{Bed, EdgeField, NodeField, Water, stored_values};

/// Water that a node received from its neighbours.
pub struct Flow;

impl NodeField for Flow {
    type Value = f64;
    const NAME: &'static str = "flow";
    const UNIT: &'static str = "m";
    const MEANING: &'static str =
        "depth of the water that came from neighbours in the latest iteration";
    const LEAST: f64 = 0.0;
}

/// Rain beside that which falls everywhere.
pub struct Rain;

impl NodeField for Rain {
    type Value = f64;
    const NAME: &'static str = "rain";
    const UNIT: &'static str = "m";
    const MEANING: &'static str = "rain an iteration beside that which falls everywhere";
    const LEAST: f64 = 0.0;
}

/// Water in hydrostatic pipes.
pub struct PipeFlow;

impl EdgeField for PipeFlow {
    type Value = f64;
    const NAME: &'static str = "pipe_flow";
    const UNIT: &'static str = "m3/s";
    const MEANING: &'static str =
        "water that leaves the node over the edge, less than 0 if it comes in";
}

/// Level of the water, or of the ground where it is dry.
pub(super) fn water_level(world: &World) -> Vec<f64> {
    let (bed, water) = (stored_values::<Bed>(world), stored_values::<Water>(world));
    bed.iter().zip(water).map(|(bed, depth)| bed + depth).collect()
}

/// Decimal logarithm of the flow; a millionth of a metre where nothing flows.
pub(super) fn flow_log10(world: &World) -> Vec<f64> {
    stored_values::<Flow>(world).iter().map(|flow| flow.max(1e-6).log10()).collect()
}
