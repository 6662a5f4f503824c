//! Fields and agents of coasts (thesis, section 4.2.5).

use bevy_ecs::world::World;
use landform_sim::agent::{AgentGroup, Quantity};
use landform_sim::field::{NodeField, stored_values};
use landform_sim::ledger::Budget;
use landform_sim::nodes::Space;

/// Where land is.
pub struct Land;

impl NodeField for Land {
    type Value = u8;
    const NAME: &'static str = "land";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "1 on land, 0 at sea";
    const LEAST: f64 = 0.0;
}

/// How strong the rock is; with wear, how much of it is left.
pub struct Resistance;

impl NodeField for Resistance {
    type Value = f64;
    const NAME: &'static str = "resistance";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "resistance of the rock to the force of the sea";
    const LEAST: f64 = 0.0;
}

/// A map of regions where coasts have numbers of their own.
pub struct CoastRegion;

impl NodeField for CoastRegion {
    type Value = u8;
    const NAME: &'static str = "coast_region";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "number of the region of a node; 0 where there is none";
    const LEAST: f64 = 0.0;
}

/// The level set that a node lies on or above.
pub struct LevelSetNumber;

impl NodeField for LevelSetNumber {
    type Value = u32;
    const NAME: &'static str = "level_set";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "number of the level set that a node lies on or above";
    const LEAST: f64 = 0.0;
}

/// Where level sets run.
pub struct OnLevelSet;

impl NodeField for OnLevelSet {
    type Value = u8;
    const NAME: &'static str = "on_level_set";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "1 on a level set, 0 between level sets";
    const LEAST: f64 = 0.0;
}

/// The coast mark agents: artifacts at the nodes of the present coast. Each stores the length
/// of its piece of shore in metres.
pub struct CoastMarks;

impl AgentGroup for CoastMarks {
    type State = f64;
    type Globals = ();
    const NAME: &'static str = "coast_marks";
    const QUANTITIES: &'static [Quantity<f64>] = &[Quantity::new("length", "m", |&length| length)];
}

/// The coast agents: each with a coast mark, and responsible for it. It decides whether its node
/// falls and which of the nodes behind become the coast.
pub struct CoastAgents;

impl AgentGroup for CoastAgents {
    type State = ();
    type Globals = ();
    const NAME: &'static str = "coast";
}

/// The artifacts of nodes that fell to the sea. Since when each is there tells when its node
/// fell.
pub struct Eroded;

impl AgentGroup for Eroded {
    type State = ();
    type Globals = ();
    const NAME: &'static str = "eroded";
}

/// Land as an account of the ledger.
pub(super) const LAND_BUDGET: Budget =
    Budget { account: "land", unit: "m2", tolerance: 1e-12, measure: area, magnitude: area };

/// Area of land in square metres: a whole number of nodes, so that the account closes.
fn area(world: &World) -> f64 {
    let land = land_nodes(stored_values::<Land>(world));
    land as f64 * node_area_m2(world.resource::<Space>())
}

/// Number of nodes that are land. It is asked for at every iteration: counts of one byte in blocks
/// that cannot overflow it are many times as fast as one count.
pub(super) fn land_nodes(land: &[u8]) -> usize {
    let count = |block: &[u8]| block.iter().map(|&land| u8::from(land > 0)).sum::<u8>();
    land.chunks(usize::from(u8::MAX)).map(|block| usize::from(count(block))).sum()
}

/// Area of a node in square metres.
pub(super) fn node_area_m2(space: &Space) -> f64 {
    space.spacing().powi(2)
}

/// A model of the coast to look at: land stands one spacing and a half above the sea, whose
/// ground lies as far below.
pub(super) fn coast_surface(world: &World) -> Vec<f64> {
    let height = 1.5 * world.resource::<Space>().spacing();
    let level = |&land: &u8| if land > 0 { height } else { -height };
    stored_values::<Land>(world).iter().map(level).collect()
}

#[cfg(test)]
mod tests {
    use super::land_nodes;

    #[test]
    fn land_is_counted_whatever_its_value() {
        let land: Vec<u8> = (0..2000).map(|node| (node % 3 * 100) as u8).collect();
        assert_eq!(land_nodes(&land), land.iter().filter(|&&land| land > 0).count());
        assert_eq!(land_nodes(&[255; 1000]), 1000);
        assert_eq!(land_nodes(&[]), 0);
    }
}
