//! The lessons are right: against each other, against searches and against what they conserve.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform_graph::{Boundary, BreadthFirst, Connectivity, Lattice, Reach};
use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Limits, Progress, Report, Simulation};

const COLUMNS: usize = 60;
const ROWS: usize = 40;

/// Runs `process` and returns the run as it is at the end.
fn run(process: &str, mesh: &str, iterations: u32) -> Simulation {
    let mut registry = Registry::new();
    landform_lessons::register(&mut registry);
    let text = format!(
        "(title: \"Lesson\", seed: 5, domain: Grid(size: ({COLUMNS}, {ROWS}), {mesh}),
        stages: [(processes: [{process}], stop: Iterations({iterations}))])"
    );
    let source = ScenarioSource::from_text("lesson.ron", &text, Path::new("."));
    let scenario = source.parse(&Arc::new(registry)).unwrap_or_else(|error| panic!("{error}"));
    let mut run = Simulation::new(scenario, Path::new("."), Limits::default())
        .unwrap_or_else(|problem| panic!("{problem}"));
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    run.run(Path::new("."), &mut hook, &mut Report::default()).expect("a run to its end");
    run
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
            let through_trees = |_: usize, edge: &landform_graph::Edge| trees[edge.node] == 1.0;
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
