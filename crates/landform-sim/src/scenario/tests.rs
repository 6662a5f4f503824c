//! Scenarios with a toy process: reading, refusing, running, guarding.

use std::path::Path;
use std::sync::Arc;

use bevy_app::{App, Plugin};
use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ScenarioSource;
use crate::domain::Grid;
use crate::field::{FieldMut, Sand};
use crate::initial::{InitialCondition, InitialContext};
use crate::ledger::Budget;
use crate::metric::Metric;
use crate::parameters::{Parameters, Problem};
use crate::process::{Declaration, Iterate, Process, ProcessApp, Settings};
use crate::registry::Registry;
use crate::simulation::{Limits, Progress, Report, RunError, Simulation};
use crate::snapshot::Snapshot;
use crate::sums::sum;

/// Multiplies the sand of every node by a factor.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Scale {
    /// The factor.
    #[schemars(range(min = 0.0, max = 1e308))]
    factor: f64,
    /// Whether the process claims to conserve sand.
    conserving: bool,
    /// Whether its systems lack an order.
    ambiguous: bool,
}

impl Default for Scale {
    fn default() -> Self {
        Self { factor: 0.5, conserving: false, ambiguous: false }
    }
}

impl Plugin for Scale {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, scale);
        if self.ambiguous {
            app.add_systems(Iterate, |mut sand: FieldMut<Sand>| sand.values_mut()[0] = 1.0);
        }
    }
}

fn scale(settings: Res<Settings<Scale>>, mut sand: FieldMut<Sand>) {
    sand.values_mut().iter_mut().for_each(|value| *value *= settings.factor);
}

impl Process for Scale {
    const NAME: &'static str = "Scale";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Sand>();
        if self.conserving {
            uses.conserves(Budget::volume::<Sand>(1e-12));
        }
    }
}

/// The same value everywhere.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Uniform {
    /// The value.
    value: f64,
}

impl InitialCondition for Uniform {
    const NAME: &'static str = "Uniform";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        Ok(vec![self.value; context.domain.lattice.node_count()])
    }
}

/// Sum of the sand.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Total {}

impl Metric for Total {
    type Memory = ();
    const NAME: &'static str = "Total";

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let sand = snapshot.field("sand").map_err(|e| Problem::new("", e.to_string(), ""))?;
        Ok(vec![("total_m".to_owned(), sum(&sand))])
    }
}

fn registry() -> Arc<Registry> {
    let mut registry = Registry::new();
    registry.process::<Scale>().initial::<Uniform>().metric::<Total>();
    Arc::new(registry)
}

const GOOD: &str = r#"(
    title: "toy",
    domain: Grid(size: (8, 4), spacing_m: 2.0),
    initial: [(field: "sand", from: Uniform(value: 3.0))],
    stages: [
        (name: "first", processes: [Scale()], stop: Iterations(2)),
        (name: "second", processes: [Scale(factor: 4.0)], stop: Above(metric: "total_m", value: 1000.0)),
    ],
    metrics: [Total()],
)"#;

fn build(text: &str) -> Result<Simulation, String> {
    let source = ScenarioSource::from_text("toy.ron", text, Path::new("."));
    let scenario = source.parse(&registry())?;
    Simulation::new(scenario, Path::new("."), Limits::default())
        .map_err(|problem| source.render(&problem))
}

fn run(text: &str) -> (Result<(), RunError>, Report) {
    let mut report = Report::default();
    let mut hook = |_: &Progress<'_>| std::ops::ControlFlow::Continue(());
    let result = build(text).expect("builds").run(Path::new("."), &mut hook, &mut report);
    (result, report)
}

/// The message for `GOOD` with `from` replaced by `to`.
fn refused(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "`{from}` is not in the text");
    build(&GOOD.replace(from, to)).err().expect("refused")
}

#[test]
fn stages_share_their_state_and_stop_by_their_rules() {
    let (result, report) = run(GOOD);
    result.expect("runs");
    // 32 nodes x 3 = 96, halved twice = 24, times four until above 1000 = 1536 after three.
    assert_eq!(report.metrics["total_m"], 1536.0);
    let done: Vec<_> = report.stages.iter().map(|stage| stage.iterations).collect();
    assert_eq!(done, [2, 3]);
    assert_eq!(report.stages[0].metrics["total_m"], 24.0);
    assert!(report.stages[1].stopped.contains("rose above 1000"), "{}", report.stages[1].stopped);
}

/// The value of 96 from before the first iteration must not end the first stage at once.
#[test]
fn stop_rules_look_at_fresh_measurements_only() {
    let rule = "Any([Below(metric: \"total_m\", value: 97.0), Iterations(9)])";
    let text = GOOD.replace("Iterations(2)", rule);
    let text = text.replace("[Total()],", "[Total()], measure_every: 3,");
    let (result, report) = run(&text);
    result.expect("runs");
    assert_eq!(report.stages[0].iterations, 3, "{}", report.stages[0].stopped);
}

#[test]
fn a_leak_is_found_and_named() {
    let (result, _) = run(&GOOD.replace("Scale()", "Scale(conserving: true)"));
    let message = result.expect_err("a leak").to_string();
    assert!(message.contains("`Scale` lost or made sand in iteration 0"), "{message}");
}

#[test]
fn infinite_values_are_found_and_named() {
    let text =
        GOOD.replace("factor: 4.0", "factor: 1e300").replace("value: 1000.0", "value: 1e308");
    let (result, report) = run(&text);
    let message = result.expect_err("overflow").to_string();
    assert!(message.contains("`sand` became inf at node 0"), "{message}");
    assert_eq!(report.stages.len(), 2, "the report says how far the run came");
}

#[test]
fn systems_without_an_order_are_refused() {
    let (result, _) = run(&GOOD.replace("Scale()", "Scale(ambiguous: true)"));
    let message = result.expect_err("ambiguous").to_string();
    assert!(message.contains("plugin of `Scale` cannot run"), "{message}");
}

#[test]
fn the_hook_can_end_the_run() {
    let mut report = Report::default();
    let mut hook = |progress: &Progress<'_>| match progress.iteration {
        1 => std::ops::ControlFlow::Break(()),
        _ => std::ops::ControlFlow::Continue(()),
    };
    let result = build(GOOD).expect("builds").run(Path::new("."), &mut hook, &mut report);
    assert_eq!(result, Err(RunError::Interrupted { iterations: 1, kept: false }));
}

#[test]
fn names_that_are_unknown_are_refused_with_the_nearest() {
    let message = refused("Scale()", "Scake()");
    assert!(message.contains("unknown process `Scake`"), "{message}");
    assert!(
        message.contains("did you mean \"Scale\"?") && message.contains("toy.ron:6"),
        "{message}"
    );
    let message = refused("Uniform(", "Unifrom(");
    assert!(
        message.contains("did you mean \"Uniform\"?") && message.contains("toy.ron:4"),
        "{message}"
    );
    let message = refused("field: \"sand\"", "field: \"sant\"");
    assert!(message.contains("no field is called `sant`"), "{message}");
    assert!(
        message.contains("did you mean \"sand\"?") && message.contains("toy.ron:4:23"),
        "{message}"
    );
    let message = refused("factor: 4.0", "fctor: 4.0");
    assert!(message.contains("fctor") && message.contains("toy.ron:7"), "{message}");
}

#[test]
fn values_out_of_range_are_refused_at_their_place() {
    let message = refused("factor: 4.0", "factor: -1.0");
    assert!(message.contains("stages[1].processes[0].factor"), "{message}");
    assert!(message.contains("at least 0") && message.contains("toy.ron:7:52"), "{message}");
    let message = refused("value: 3.0", "value: 1e999");
    assert!(message.contains("not finite"), "{message}");
    let message = refused("Iterations(2)", "Iterations(0)");
    assert!(message.contains("zero iterations"), "{message}");
    let message = refused(", stop: Iterations(2)", "");
    assert!(message.contains("never ends"), "{message}");
}

#[test]
fn fields_have_a_least_value_once_all_entries_are_combined() {
    let message = refused("value: 3.0", "value: -3.0");
    assert!(message.contains("field `sand` starts with -3 m at node 0"), "{message}");
    assert!(message.contains("at least 0 m") && message.contains("toy.ron:4"), "{message}");
    let entry = "from: Uniform(value: 3.0))";
    let two =
        "from: Uniform(value: -3.0)), (field: \"sand\", from: Uniform(value: 4.0), combine: Add)";
    let (result, report) = run(&GOOD.replace(entry, two));
    result.expect("runs");
    assert_eq!(report.stages[0].metrics["total_m"], 8.0, "32 nodes x 1, halved twice");
}

#[test]
fn a_stop_rule_on_a_metric_that_is_never_measured_is_refused() {
    let (result, report) = run(&GOOD.replace("total_m", "totel_m"));
    let message = result.expect_err("nothing measures it").to_string();
    assert!(message.contains("stages[1].stop: nothing measures `totel_m`"), "{message}");
    assert!(message.contains("did you mean \"total_m\"?"), "{message}");
    assert_eq!(report.stages[1].iterations, 1);
    let message = refused("metrics: [Total()],", "");
    assert!(message.contains("the scenario measures none"), "{message}");
    for value in ["NaN", "inf"] {
        let message = refused("value: 1000.0", &format!("value: {value}"));
        assert!(message.contains("the value is never reached"), "{message}");
    }
}

#[test]
fn sizes_that_cannot_be_are_refused_before_memory_is_taken() {
    let message = refused("(8, 4)", "(100000, 100000)");
    assert!(message.contains("10000000000 nodes need about"), "{message}");
    let message = refused("(8, 4)", "(0, 4)");
    assert!(message.contains("axis x has 0 nodes"), "{message}");
    assert!(message.contains("toy.ron:3"), "{message}");
}

#[test]
fn parameters_describe_themselves() {
    let registry = registry();
    let scale = registry.processes.get("Scale").expect("registered");
    assert_eq!(scale.description(), "Multiplies the sand of every node by a factor.");
    let factor = scale.parameters().into_iter().find(|p| p.name == "factor").expect("there");
    assert_eq!((factor.default.as_str(), factor.kind.as_str()), ("0.5", "number"));
    assert_eq!(factor.range, "at least 0, at most 1e308");
    let grid = registry.domains.get("Grid").expect("registered").parameters();
    assert_eq!(grid.iter().find(|p| p.name == "spacing_m").expect("there").unit, "m");
    fn takes<P: Parameters>() {}
    takes::<Grid>();
}
