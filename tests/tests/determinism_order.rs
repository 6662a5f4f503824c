//! Same bits whatever the order: processes that share no data may stand in any order in a stage,
//! and two systems that share data must have an order, or the run is refused.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::prelude::*;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, RunError, Simulation};
use landform_tests::{Run, bits_of};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Processes of which no two use the same field or group.
const APART: [&str; 4] = [
    "SandLike()",
    "CorrosionLike()",
    "LivingCells()",
    "ForestFire(growth: 0.01, lightning: 0.001)",
];

/// All orders of `count` things.
fn orders(count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let last = |order: Vec<usize>| {
        (0..count).map(move |place| {
            let mut order = order.clone();
            order.insert(place, count - 1);
            order
        })
    };
    orders(count - 1).into_iter().flat_map(last).collect()
}

/// Hashes of the final fields, by name.
fn fields(processes: &[&str]) -> BTreeMap<&'static str, u64> {
    let initial = |process: &&str| match *process {
        "SandLike()" => "(field: \"sand\", from: WhiteNoise(mean_m: 12.0, amplitude_m: 12.0)), ",
        "CorrosionLike()" => "(field: \"bed\", from: Cone(height_m: 90.0)), ",
        _ => "",
    };
    // The order of initial values stays, since random ones depend on it; a cone does not.
    let initial: String =
        APART.iter().filter(|each| processes.contains(each)).map(initial).collect();
    let text = format!(
        "(title: \"any order\", seed: 4, domain: Grid(size: (60, 41), connectivity: Eight),
          initial: [{initial}],
          stages: [(processes: [{}], stop: Iterations(7))])",
        processes.join(", ")
    );
    let run = Run::of(&text, landform::registry(), 2);
    let stored = run.fields.iter().filter(|(name, _)| *name != "surface");
    stored.map(|(name, values)| (*name, bits_of(values))).collect()
}

#[test]
fn processes_that_share_nothing_may_stand_in_any_order() {
    let expected = fields(&APART);
    assert!(expected.len() >= 6, "{expected:?}");
    let orders = orders(APART.len());
    assert_eq!(orders.len(), 24);
    for order in orders {
        assert_eq!(fields(&order.iter().map(|&index| APART[index]).collect::<Vec<_>>()), expected);
    }
}

#[test]
fn processes_that_share_nothing_do_as_they_do_alone() {
    let together = fields(&APART);
    let alone = APART.iter().flat_map(|&process| fields(&[process]));
    assert_eq!(alone.collect::<BTreeMap<_, _>>(), together);
}

/// Two systems that write the bed, with or without an order.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Quarrel {
    /// Whether the plugin states an order.
    ordered: bool,
    /// Whether the systems belong to the beginning of the stage.
    at_begin: bool,
}

fn raise_it(mut bed: FieldMut<Bed>) {
    bed.values_mut().iter_mut().for_each(|bed| *bed += 1.0);
}

fn double_it(mut bed: FieldMut<Bed>) {
    bed.values_mut().iter_mut().for_each(|bed| *bed *= 2.0);
}

impl Process for Quarrel {
    const NAME: &'static str = "Quarrel";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Bed>();
    }
}

impl Plugin for Quarrel {
    fn build(&self, app: &mut App) {
        match (self.ordered, self.at_begin) {
            (true, _) => app.add_systems(Iterate, (raise_it, double_it).chain()),
            (false, true) => app.add_systems(Begin, (raise_it, double_it)),
            (false, false) => app.add_systems(Iterate, (raise_it, double_it)),
        };
    }
}

fn quarrel(parameters: &str) -> Result<(), RunError> {
    let mut registry = landform::registry();
    registry.process::<Quarrel>();
    let text = format!(
        "(title: \"quarrel\", domain: Grid(size: (8, 8)),
          stages: [(processes: [Quarrel({parameters})], stop: Iterations(2))])"
    );
    let source = ScenarioSource::from_text("quarrel.ron", &text, Path::new(""));
    let scenario = source.parse(&Arc::new(registry)).expect("a scenario");
    let run = Simulation::new(scenario, Path::new(""), Limits::default());
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    run.expect("a run").run(Path::new(""), &mut hook, &mut Report::default())
}

#[test]
fn systems_that_share_data_without_an_order_are_refused_by_name() {
    quarrel("ordered: true").expect("an order is enough");
    for parameters in ["", "at_begin: true"] {
        let message = quarrel(parameters).expect_err("no order").to_string();
        for part in ["`Quarrel`", "raise_it", "double_it", "chain"] {
            assert!(message.contains(part), "no {part} in: {message}");
        }
    }
}
