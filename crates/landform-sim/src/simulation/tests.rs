//! Runs that go on from checkpoints in memory, with a toy process that keeps everything there is.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::*;
use crate::checkpoint::{Checkpoint, Damage};
use crate::prelude::*;
use crate::scenario::ScenarioSource;

/// Walkers that carry sand from node to node.
struct Walkers;

impl AgentGroup for Walkers {
    type State = (u32, f64);
    type Globals = u64;
    const NAME: &'static str = "walkers";
}

/// Steps taken so far, which no field tells.
#[derive(Resource, Default, Serialize, Deserialize)]
struct Steps(u64);

/// Something that `Begin` can make anew.
#[derive(Resource)]
struct Half(usize);

/// Walkers are born, walk, carry sand and die.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Carry {
    /// Whether the process does not say what it keeps.
    forgetful: bool,
}

impl Process for Carry {
    const NAME: &'static str = "Carry";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Sand>().group::<Walkers>().rebuilds::<Half>();
        if !self.forgetful {
            uses.keeps::<Steps>();
        }
    }
}

impl Plugin for Carry {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).init_resource::<Steps>();
        app.add_systems(
            Begin,
            |mut commands: Commands,
             space: Res<Space>,
             mut notes: ResMut<Notes>,
             mut sand: FieldMut<Sand>| {
                notes.tell("walkers carry sand");
                commands.insert_resource(Half(space.node_count() / 2));
                sand.values_mut()[0] += 1.0;
            },
        );
        app.add_systems(Iterate, (carry, bear).chain());
    }
}

fn carry(
    space: Res<Space>,
    clock: Res<Clock>,
    mut steps: ResMut<Steps>,
    mut sand: FieldMut<Sand>,
    mut walkers: Agents<Walkers>,
) {
    let random = RandomStream::new(clock.seed, "walk");
    let sand = sand.values_mut();
    walkers.view().visit(|walkers, node| {
        let ways: Vec<usize> = space.neighbours(node).map(|edge| edge.node).collect();
        let way = ways[random.block(clock.tick, node, 0)[0] as usize % ways.len()];
        let Some((age, load)) = walkers.get_mut(node) else { return };
        *age += 1;
        *load += sand[node] / 8.0;
        sand[node] -= sand[node] / 8.0;
        let (age, load) = (*age, *load);
        steps.0 += 1;
        if age > 4 && walkers.deregister(node) {
            sand[node] += load;
            *walkers.globals_mut() += 1;
        } else {
            walkers.move_to(node, way);
        }
    });
}

fn bear(clock: Res<Clock>, half: Res<Half>, steps: Res<Steps>, mut walkers: Agents<Walkers>) {
    let mut walkers = walkers.view();
    for birth in 0..3 {
        let node = (clock.tick as usize * 7 + birth * 13 + steps.0 as usize) % (2 * half.0);
        walkers.register(node, (0, 0.125));
    }
}

/// How much more sand there is than at the measurement before.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Gain {}

impl Metric for Gain {
    type Memory = Option<f64>;
    const NAME: &'static str = "Gain";

    fn measure(
        &self,
        before: &mut Option<f64>,
        snapshot: &Snapshot<'_>,
    ) -> Result<Vec<(String, f64)>, Problem> {
        let now = sum(&snapshot.field("sand").unwrap_or_default());
        let gain = before.replace(now).map(|before| now - before);
        Ok(gain.map(|gain| ("gain".to_owned(), gain)).into_iter().collect())
    }
}

const SCENARIO: &str = r#"(
    title: "toy",
    domain: Grid(size: (9, 7)),
    stages: [
        (name: "first", processes: [Carry()], stop: Iterations(8)),
        (name: "second", processes: [Carry()], stop: Iterations(5)),
    ],
    metrics: [Gain()],
    measure_every: 2,
)"#;

fn simulation(text: &str) -> Simulation {
    let mut registry = Registry::new();
    registry.process::<Carry>().metric::<Gain>();
    let source = ScenarioSource::from_text("toy.ron", text, Path::new(""));
    let scenario = source.parse(&Arc::new(registry)).expect("a good scenario");
    Simulation::new(scenario, Path::new(""), Limits::default()).expect("it fits")
}

/// Everything that a run ends with.
fn end(simulation: &mut Simulation) -> (String, Report) {
    let mut report = Report::default();
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    simulation.run(Path::new(""), &mut hook, &mut report).expect("a run");
    let state = simulation.checkpoint(true, &Report::default()).expect("a checkpoint");
    report.seconds = 0.0;
    report.stages.iter_mut().for_each(|stage| stage.seconds = 0.0);
    (format!("{:?} {:?}", state.arrays, state.texts), report)
}

/// Keeps every checkpoint.
struct All(Rc<RefCell<Vec<Checkpoint<'static>>>>);

impl Keeper for All {
    fn is_due(&mut self, _: &Progress<'_>) -> bool {
        true
    }

    fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String> {
        self.0.borrow_mut().push(checkpoint.into_owned());
        Ok(())
    }
}

fn checkpoints() -> (Vec<Checkpoint<'static>>, (String, Report)) {
    let all = Rc::default();
    let mut simulation = simulation(SCENARIO);
    simulation.keep_checkpoints(Box::new(All(Rc::clone(&all))));
    let end = end(&mut simulation);
    let checkpoints = all.borrow().clone();
    (checkpoints, end)
}

#[test]
fn a_run_goes_on_from_every_iteration_as_if_nothing_had_happened() {
    let (checkpoints, expected) = checkpoints();
    assert_eq!(checkpoints.len(), (1 + 8) + (1 + 5), "at the beginning and after each iteration");
    assert_eq!(expected.1.notes, ["walkers carry sand"], "told in both stages, listed once");
    for (number, checkpoint) in checkpoints.into_iter().enumerate() {
        let mut resumed = simulation(SCENARIO);
        resumed.resume(checkpoint, Path::new("")).expect("it fits");
        assert_eq!(end(&mut resumed), expected, "checkpoint {number}");
    }
}

#[test]
fn notes_are_told_from_the_beginning_of_a_stage_on() {
    let mut told = Vec::new();
    let mut hook = |progress: &Progress<'_>| {
        told.push(progress.notes.len());
        ControlFlow::Continue(())
    };
    let mut report = Report::default();
    simulation(SCENARIO).run(Path::new(""), &mut hook, &mut report).expect("a run");
    assert_eq!(told, [1; (1 + 8) + (1 + 5)]);
}

#[test]
fn checkpoints_of_other_runs_are_refused() {
    let (checkpoints, _) = checkpoints();
    let refusal = |from: &str, to: &str| {
        let mut other = simulation(&SCENARIO.replacen(from, to, 1));
        other.resume(checkpoints[4].clone(), Path::new("")).expect_err("another run")
    };
    let what = |damage: Damage| match damage {
        Damage::Foreign { what, .. } => what,
        other => panic!("{other}"),
    };
    assert_eq!(what(refusal("domain:", "seed: 2, domain:")), "seed");
    assert_eq!(what(refusal("(9, 7)", "(9, 8)")), "size of the domain");
    assert_eq!(what(refusal("(9, 7)", "(9, 7), spacing_m: 2.0")), "spacing in metres");
    let one = what(refusal("(name: \"first\", processes: [Carry()], stop: Iterations(8)),", ""));
    assert_eq!(one, "list of stages");
}

#[test]
fn members_beyond_the_nodes_are_refused() {
    let (checkpoints, _) = checkpoints();
    let mut checkpoint = checkpoints[4].clone();
    let members = checkpoint.arrays.get_mut("groups/walkers/members").expect("walkers");
    let count = members.len();
    *members = crate::checkpoint::Array::U32(vec![63; count].into());
    let refused = simulation(SCENARIO).resume(checkpoint, Path::new("")).expect_err("no such node");
    assert!(refused.to_string().contains("groups/walkers/members"), "{refused}");
}

#[test]
fn a_resource_that_nobody_declares_is_refused() {
    let text = SCENARIO.replace("Carry()", "Carry(forgetful: true)");
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    let result = simulation(&text).run(Path::new(""), &mut hook, &mut Report::default());
    let message = result.expect_err("steps would be forgotten").to_string();
    assert!(message.contains("`Carry`") && message.contains("uses.keeps"), "{message}");
}
