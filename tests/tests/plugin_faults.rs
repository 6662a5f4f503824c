//! What the author of a plugin may get wrong is refused with a name, and never a panic.

use std::path::Path;
use std::sync::Arc;

use landform::prelude::*;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Simulation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A group with the name of another one, that of the forest fire.
struct OtherTrees;

impl AgentGroup for OtherTrees {
    type State = f64;
    type Globals = ();
    const NAME: &'static str = "trees";
}

/// A process with that group.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Orchard {}

impl Process for Orchard {
    const NAME: &'static str = "Orchard";

    fn declare(&self, uses: &mut Declaration) {
        uses.group::<OtherTrees>();
    }
}

impl Plugin for Orchard {
    fn build(&self, app: &mut App) {
        app.add_systems(Iterate, |mut trees: Agents<OtherTrees>| {
            trees.view().register(0, 1.0);
        });
    }
}

fn built(processes: &str) -> Result<Simulation, String> {
    let mut registry = landform::registry();
    registry.process::<Orchard>();
    let text = format!(
        "(title: \"names\", domain: Grid(size: (8, 8)),
          stages: [(processes: [{processes}], stop: Iterations(2))])"
    );
    let source = ScenarioSource::from_text("names.ron", &text, Path::new(""));
    let scenario = source.parse(&Arc::new(registry))?;
    let run = Simulation::new(scenario, Path::new(""), Limits::default());
    run.map_err(|problem| source.render(&problem))
}

#[test]
fn two_groups_of_one_name_are_refused() {
    built("Orchard()").expect("alone it is good");
    built("ForestFire()").expect("and so is the other");
    let message = built("ForestFire(), Orchard()").err().expect("not together");
    for part in ["two groups of agents are called `trees`", "names.ron:2:", "rename the group"] {
        assert!(message.contains(part), "no `{part}` in\n{message}");
    }
}
