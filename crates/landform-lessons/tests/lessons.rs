//! The lessons are right: against each other, against searches and against what they conserve.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Arc, Mutex};

use landform_graph::{BreadthFirst, Reach};
use landform_lessons::{Drifters, Walkers};
use landform_sim::agent::Group;
use landform_sim::checkpoint::Checkpoint;
use landform_sim::prelude::*;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Keeper, Limits, Progress, Report, Simulation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const COLUMNS: usize = 60;
const ROWS: usize = 40;

/// Runs `process` and returns the run as it is at the end.
fn run(process: &str, mesh: &str, iterations: u32) -> Simulation {
    run_from("", process, mesh, iterations)
}

/// Runs `process` from initial conditions and returns the run as it is at the end.
fn run_from(initial: &str, process: &str, mesh: &str, iterations: u32) -> Simulation {
    finish(start(initial, process, mesh, iterations))
}

/// A run of `process` before its first iteration.
fn start(initial: &str, process: &str, mesh: &str, iterations: u32) -> Simulation {
    let mut registry = Registry::new();
    landform_lessons::register(&mut registry);
    landform_synth::register(&mut registry);
    registry.initial::<Seiche>();
    let text = format!(
        "(title: \"Lesson\", seed: 5, domain: Grid(size: ({COLUMNS}, {ROWS}), {mesh}),
        initial: [{initial}],
        stages: [(processes: [{process}], stop: Iterations({iterations}))])"
    );
    let source = ScenarioSource::from_text("lesson.ron", &text, Path::new("."));
    let scenario = source.parse(&Arc::new(registry)).unwrap_or_else(|error| panic!("{error}"));
    Simulation::new(scenario, Path::new("."), Limits::default())
        .unwrap_or_else(|problem| panic!("{problem}"))
}

/// Runs a run to its end.
fn finish(mut run: Simulation) -> Simulation {
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    run.run(Path::new("."), &mut hook, &mut Report::default()).expect("a run to its end");
    run
}

/// Still water 10 m deep with a standing wave along the rows.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
struct Seiche {}

/// Shape of the wave at a node.
fn wave(node: usize) -> f64 {
    (2.0 * PI * ((node % COLUMNS) as f64 + 0.5) / COLUMNS as f64).cos()
}

impl InitialCondition for Seiche {
    const NAME: &'static str = "Seiche";

    fn values(&self, _: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        Ok((0..COLUMNS * ROWS).map(|node| 10.0 + 0.1 * wave(node)).collect())
    }
}

fn field(run: &Simulation, name: &str) -> Vec<f64> {
    run.snapshot().field(name).expect("a field")
}

const TORUS: &str = "connectivity: Eight, boundary: (Periodic, Periodic)";

#[test]
fn life_on_a_field_and_with_agents_is_the_same_life() {
    for iterations in [1, 2, 50] {
        let cells = field(&run("Life()", TORUS, iterations), "alive");
        assert!(cells.iter().sum::<f64>() > 50.0, "there is life");
        assert_eq!(field(&run("LivingCells()", TORUS, iterations), "cells"), cells);
    }
}

/// The fire of an iteration stands where a search over trees from the west edge finds a node
/// over as many edges, and has burnt all that is nearer.
#[test]
fn fire_runs_one_edge_an_iteration_through_connected_trees() {
    for (name, connectivity) in [("Eight", Connectivity::Eight), ("Four", Connectivity::Four)] {
        let mesh = format!("connectivity: {name}");
        let process = |west: bool| format!("ForestFire(tree_share: 0.7, west_edge_burns: {west})");
        let trees = field(&run(&process(false), &mesh, 1), "forest");
        let lattice =
            Lattice::plane([COLUMNS, ROWS], 10.0, connectivity, [Boundary::Open; 2]).unwrap();
        let west: Vec<usize> =
            (0..ROWS).map(|row| row * COLUMNS).filter(|&node| trees[node] == 1.0).collect();
        let mut search = BreadthFirst::new();
        for iterations in [1, 7, 400] {
            let mut expected = trees.clone();
            let through_trees = |_: usize, edge: &Edge| trees[edge.node] == 1.0;
            for found in search.collect(&lattice, &west, Reach::edges(iterations), through_trees) {
                expected[found.node] = if found.edges == iterations { 2.0 } else { 0.0 };
            }
            assert_eq!(field(&run(&process(true), &mesh, iterations), "forest"), expected);
        }
    }
}

#[test]
fn trees_grow_and_lightning_strikes_as_often_as_told() {
    let forest = field(
        &run("ForestFire(tree_share: 0.0, growth: 0.01)", "connectivity: Four", 50),
        "forest",
    );
    let trees = forest.iter().sum::<f64>() / forest.len() as f64;
    let expected = 1.0 - 0.99_f64.powi(50);
    assert!((trees - expected).abs() < 0.04, "{trees} against {expected}");

    // Lone trees burn without setting fire to others.
    let lone = "ForestFire(tree_share: 1.0, west_edge_burns: false, lightning: 0.01)";
    let burning = field(&run(lone, "connectivity: Four", 1), "forest");
    let struck = burning.iter().filter(|&&tree| tree == 2.0).count() as f64 / burning.len() as f64;
    assert!((struck - 0.01).abs() < 0.007, "{struck}");
}

/// Waves of the scheme: levels obey `h(n + 1) - 2 h(n) + h(n - 1) = -k h(n)` from rest, whose
/// solution is `cos((n + 1/2) a) / cos(a / 2)` with `2 cos(a) = 2 - k`.
#[test]
fn water_in_pipes_swings_as_the_wave_equation_says() {
    let (step, share, spacing) = (0.5_f64, 0.2, 10.0);
    let seiche = "(field: \"water\", from: Seiche())";
    let process = format!("Pipes(step_s: {step}, cross_section: {share}, persistence: 1.0)");
    let k = step.powi(2) * share * 9.81 / spacing * (2.0 * (PI / COLUMNS as f64).sin()).powi(2);
    let a = (1.0 - k / 2.0).acos();
    for iterations in [1, 50, 333] {
        let run = run_from(seiche, &process, "connectivity: Four", iterations);
        let swing = ((f64::from(iterations) + 0.5) * a).cos() / (a / 2.0).cos();
        for (node, water) in field(&run, "water").into_iter().enumerate() {
            let expected = 10.0 + 0.1 * swing * wave(node);
            assert!((water - expected).abs() < 1e-9, "{iterations}: {water} {expected}");
        }
    }
}

#[test]
fn water_in_pipes_finds_its_level_in_every_basin_and_none_is_lost() {
    let hills = "(field: \"bed\", from: SmoothNoise(standard_deviation_m: 8.0)),
        (field: \"water\", from: Uniform(value: 4.0))";
    let run = run_from(hills, "Pipes()", "connectivity: FourEight", 20_000);
    let (bed, water) = (field(&run, "bed"), field(&run, "water"));
    let account = &run.snapshot().ledger().accounts()["water"];
    assert!(account.largest_gap < 1e-12 && account.initial > 0.0, "{account:?}");
    assert!(water.iter().any(|&water| water < 1e-3), "hills stand out");
    let lattice = run.lattice();
    for node in 0..lattice.node_count() {
        for edge in lattice.neighbours(node) {
            if water[node] > 0.01 && water[edge.node] > 0.01 {
                let step = bed[node] + water[node] - bed[edge.node] - water[edge.node];
                assert!(step.abs() < 0.01, "a step of {step} m at node {node}");
            }
        }
    }
}

/// Share of all wear that the most worn tenth of the ground has.
fn concentration(attraction: f64) -> f64 {
    let process =
        format!("Trails(walkers: 20, wear_by_step: 0.2, recovery: 0.01, attraction: {attraction})");
    let run = run(&process, "connectivity: Eight", 4000);
    let group = run.snapshot().world().resource::<Group<Walkers>>();
    assert_eq!(group.members().len(), 20, "walkers are neither lost nor made");
    assert!(group.globals > 500, "they come to their goals: {}", group.globals);
    let mut wear = field(&run, "wear");
    assert!(wear.iter().all(|wear| (0.0..=1.0).contains(wear)));
    wear.sort_by(f64::total_cmp);
    wear[wear.len() * 9 / 10..].iter().sum::<f64>() / wear.iter().sum::<f64>()
}

#[test]
fn walkers_that_follow_trails_share_them() {
    let [alone, together] = [concentration(0.0), concentration(0.6)];
    assert!(together > 1.05 * alone, "{alone} without, {together} with attraction");
}

/// What has settled hangs together, nobody is lost, and particles that rarely settle make it denser.
#[test]
fn drifting_particles_make_one_aggregate() {
    let spread = |process: &str| {
        let run = run(process, "connectivity: Four", 20_000);
        let arrival = field(&run, "arrival");
        let settled: Vec<usize> = (0..arrival.len()).filter(|&node| arrival[node] > 0.0).collect();
        let group = run.snapshot().world().resource::<Group<Drifters>>();
        assert_eq!(settled.len() as u64, group.globals + 1);
        let middle = settled.iter().copied().find(|&node| arrival[node] == 1.0).expect("a seed");
        let among = |_: usize, edge: &Edge| arrival[edge.node] > 0.0;
        let mut search = BreadthFirst::new();
        let found = search.collect(run.lattice(), &[middle], Reach::edges(u32::MAX), among);
        assert_eq!(found.len(), settled.len());
        assert_eq!(settled.len(), 151, "all have come");
        let lattice = run.lattice();
        let away =
            |&node: &usize| lattice.position(node).distance_squared(lattice.position(middle));
        settled.iter().map(away).sum::<f64>() / settled.len() as f64
    };
    let sticky = spread("Aggregation(drifters: 150, particles: 150)");
    let shy = spread("Aggregation(drifters: 150, particles: 150, sticking: 0.05)");
    assert!(shy < 0.8 * sticky, "{shy} {sticky}");
}

/// Keeps the checkpoint after one of the iterations.
struct After(u64, Arc<Mutex<Option<Checkpoint<'static>>>>);

impl Keeper for After {
    fn is_due(&mut self, progress: &Progress<'_>) -> bool {
        progress.iteration == self.0
    }

    fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String> {
        *self.1.lock().expect("one thread") = Some(checkpoint.into_owned());
        Ok(())
    }
}

/// Members, their states and births, globals and flows on edges come back from a checkpoint.
#[test]
fn a_lesson_that_is_resumed_ends_as_if_nothing_had_happened() {
    let lake = "(field: \"bed\", from: SmoothNoise(standard_deviation_m: 8.0)),
        (field: \"water\", from: Uniform(value: 4.0))";
    let lessons = [
        ("", "LivingCells()", TORUS, "cells"),
        ("", "ForestFire(growth: 0.02, lightning: 0.01)", "connectivity: Four", "forest"),
        (lake, "Pipes()", "connectivity: FourEight", "water"),
        ("", "Trails(walkers: 99)", TORUS, "wear"),
        ("", "Aggregation(drifters: 99, seed: Floor)", "connectivity: Eight", "arrival"),
    ];
    for (initial, process, mesh, name) in lessons {
        let kept = Arc::default();
        let mut whole = start(initial, process, mesh, 40);
        whole.keep_checkpoints(Box::new(After(17, Arc::clone(&kept))));
        let expected = field(&finish(whole), name);
        let checkpoint = kept.lock().expect("one thread").take().expect("a checkpoint");
        let mut resumed = start(initial, process, mesh, 40);
        resumed.resume(checkpoint, Path::new(".")).expect("a checkpoint of this run");
        assert_eq!(field(&finish(resumed), name), expected, "{process}");
    }
}
