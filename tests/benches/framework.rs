//! The framework tax: what a process costs more than the same loop written by hand.
//!
//! A run of the framework and a loop on plain `Vec`s take turns, iteration by iteration; the time
//! of the framework's side is all that passes between two calls of the progress hook: systems,
//! staged births and deaths, guards and ledger. Both sides start alike, and where they shall
//! end alike that is checked.
//!
//! - `dunes`: the dune engine on 512x512 nodes; nanoseconds a node and iteration;
//! - `life, dense`: the lesson `Life` on a field of bytes, against a kernel on two plain lists;
//! - `life, agents`: the lesson `LivingCells`, agents that are born and die, against the same;
//! - `sparse visit`: agents on a tenth of the nodes that read a field, against a list of nodes;
//! - `birth and death`: agents on a tenth of the nodes that all die while as many are born
//!   elsewhere, at random; nanoseconds a birth and a death, against a mask of the nodes;
//! - `walkers`: agents on a fifth of the nodes that step to a random neighbour if it is free;
//!   nanoseconds a step, against agents in a list with a mask of the nodes that are taken.

#[allow(dead_code, reason = "the framework takes turns in its own loop, without `pairs`")]
mod measure;

use std::cell::Cell;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::dunes::dunes::{Engine, Shadow, ShadowSettings};
use landform::dunes::plugin::Dunes;
use landform::lessons::Cells;
use landform::prelude::*;
use landform::sim::agent::Group;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, Simulation};
use measure::{Effort, Pair, table, time};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Columns and rows of every lattice here.
const SIDE: usize = 512;
const NODES: usize = SIDE * SIDE;

fn main() {
    table("Framework tax, 512x512", |effort| {
        dunes(effort);
        dense_life(effort);
        life_as_agents(effort);
        sparse_visits(effort);
        births_and_deaths(effort);
        walkers(effort);
    });
}

/// A run of one process.
fn simulation(process: &str, initial: &str, iterations: usize) -> Simulation {
    let mut registry = landform::registry();
    registry.process::<Walk>().process::<Look>().process::<Renewal>();
    let text = format!(
        "(title: \"Benchmark\", seed: 1,
        domain: Grid(size: ({SIDE}, {SIDE}), spacing_m: 10.0, connectivity: Eight,
            boundary: (Periodic, Periodic)),
        initial: [{initial}],
        stages: [(name: \"all\", processes: [{process}], stop: Iterations({iterations}))])"
    );
    let source = ScenarioSource::from_text("benchmark", &text, Path::new("."));
    let scenario = source.parse(&Arc::new(registry)).expect("a scenario");
    Simulation::new(scenario, Path::new("."), Limits::default()).expect("a run")
}

/// Runs the simulation, and the work by hand after each of its iterations; both sides' times a
/// unit of work.
fn tax(run: &mut Simulation, units: usize, mut by_hand: impl FnMut()) -> Pair {
    let mut times = Vec::new();
    let mut since = cpu_time::ThreadTime::now();
    let mut hook = |progress: &Progress<'_>| {
        let spent = since.elapsed().as_nanos() as f64;
        if progress.iteration > 0 && times.len() < progress.iteration as usize {
            let by_hand = time(&mut || {
                by_hand();
                units
            });
            times.push([spent / units as f64, by_hand]);
        }
        since = cpu_time::ThreadTime::now();
        ControlFlow::Continue(())
    };
    run.run(Path::new("."), &mut hook, &mut Report::default()).expect("a run to its end");
    // The first iteration warms up.
    Pair::of(&times[1..])
}

fn dunes(effort: Effort) {
    let process = "Dunes(winds: [(spread_deg: 0.0)], slab_m: 3.0, wind_strength_m: 50.0, \
        shelter: Shadow(reach_m: None))";
    let noise = "(field: \"sand\", from: WhiteNoise(mean_m: 30.0, amplitude_m: 10.0))";
    let mut run = simulation(process, noise, effort.rounds(40) + 1);
    let mut sand = run.snapshot().field("sand").expect("sand");
    let bed = vec![0.0; NODES];
    let mut settings = Dunes { slab_m: 3.0, wind_strength_m: 50.0, ..Dunes::default() }.settings();
    settings.rose.winds[0].spread_deg = 0.0;
    let mut engine = Engine::new(run.lattice().clone(), settings, 1).expect("an engine");
    let shadow = ShadowSettings { reach_m: None, ..ShadowSettings::default() };
    let mut shadow = Shadow::new(shadow).expect("a shadow");
    engine.settle(&bed, &mut sand).expect("sand at rest");
    let mut tick = 0;
    let pair = tax(&mut run, NODES, || {
        engine.tick(&bed, &mut sand, tick, &mut shadow).expect("a tick");
        tick += 1;
    });
    assert_eq!(run.snapshot().field("sand").expect("sand"), sand, "both sides end alike");
    pair.print("dunes, a node", "the engine by hand", "1.1 x");
}

/// The pattern that the lessons sow.
fn soup() -> Vec<u8> {
    let random = RandomStream::new(1, "life");
    (0..NODES).map(|node| u8::from(random.unit(0, node, 0) < 0.3)).collect()
}

/// One generation of the Game of Life on a torus, by windows of three rows.
fn generation(cells: &[u8], next: &mut [u8]) {
    let row = |row: usize| &cells[row % SIDE * SIDE..][..SIDE];
    for (y, next) in next.chunks_exact_mut(SIDE).enumerate() {
        let rows = [row(y + SIDE - 1), row(y), row(y + 1)];
        let mut sums = [0; SIDE];
        for (x, sum) in sums.iter_mut().enumerate() {
            *sum = rows[0][x] + rows[1][x] + rows[2][x];
        }
        let lives = |west: u8, here: u8, east: u8, alive: u8| {
            let all = west + here + east;
            u8::from(all == 3) | (u8::from(all == 4) & alive)
        };
        let inner = next[1..].iter_mut().zip(&rows[1][1..]);
        for ((next, &alive), sums) in inner.zip(sums.windows(3)) {
            *next = lives(sums[0], sums[1], sums[2], alive);
        }
        next[0] = lives(sums[SIDE - 1], sums[0], sums[1], rows[1][0]);
        next[SIDE - 1] = lives(sums[SIDE - 2], sums[SIDE - 1], sums[0], rows[1][SIDE - 1]);
    }
}

/// Generations on plain lists.
struct PlainLife {
    cells: Vec<u8>,
    next: Vec<u8>,
}

impl PlainLife {
    fn new() -> Self {
        Self { cells: soup(), next: vec![0; NODES] }
    }

    fn step(&mut self) {
        generation(&self.cells, &mut self.next);
        std::mem::swap(&mut self.cells, &mut self.next);
        black_box(&self.cells);
    }
}

fn dense_life(effort: Effort) {
    let mut run = simulation("Life(alive_share: 0.3)", "", effort.rounds(400) + 1);
    let mut plain = PlainLife::new();
    let pair = tax(&mut run, NODES, || plain.step());
    let alive = run.snapshot().field("alive").expect("cells");
    assert!(alive.iter().zip(&plain.cells).all(|(a, &b)| *a == f64::from(b)), "both end alike");
    pair.print("life, dense, a cell", "plain Vec", "1.2 x");
}

/// The eight nodes around a node of the torus.
fn around(node: usize) -> [usize; 8] {
    let (x, y) = (node % SIDE, node / SIDE);
    let [west, east] = [(x + SIDE - 1) % SIDE, (x + 1) % SIDE];
    let [north, here, south] = [y + SIDE - 1, y, y + 1].map(|row| row % SIDE * SIDE);
    [
        north + west,
        north + x,
        north + east,
        here + west,
        here + east,
        south + west,
        south + x,
        south + east,
    ]
}

fn life_as_agents(effort: Effort) {
    let mut run = simulation("LivingCells(alive_share: 0.3)", "", effort.rounds(200) + 1);
    let mut plain = PlainLife::new();
    let pair = tax(&mut run, NODES, || plain.step());
    let group = run.snapshot().world().resource::<Group<Cells>>();
    let alive = plain.cells.iter().enumerate().filter(|&(_, &alive)| alive == 1);
    assert!(group.members().iter().eq(alive.map(|(node, _)| node)), "both end alike");
    pair.print("life, agents, a cell", "plain Vec", "6 ns");
}

/// Agents that look at the field where they stand.
struct Watchers;

impl AgentGroup for Watchers {
    type State = ();
    type Globals = f64;
    const NAME: &'static str = "watchers";
}

/// Agents on a tenth of the nodes that add what they see.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
struct Look {}

impl Process for Look {
    const NAME: &'static str = "Look";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Sand>().group::<Watchers>();
    }
}

impl Plugin for Look {
    fn build(&self, app: &mut App) {
        app.add_systems(Begin, |mut watchers: Agents<Watchers>| {
            let mut watchers = watchers.view();
            for node in tenth(0) {
                watchers.register(node, ());
            }
        });
        app.add_systems(Iterate, |sand: Field<Sand>, mut watchers: Agents<Watchers>| {
            let (sand, mut watchers) = (sand.values(), watchers.view());
            *watchers.globals_mut() = watchers.nodes().map(|node| sand[node]).sum();
        });
    }
}

/// A tenth of the nodes, drawn at random, in node order.
fn tenth(draw: u64) -> impl Iterator<Item = usize> {
    let random = RandomStream::new(1, "tenth");
    (0..NODES).filter(move |&node| random.unit(draw, node, 0) < 0.1)
}

fn sparse_visits(effort: Effort) {
    let noise = "(field: \"sand\", from: WhiteNoise(mean_m: 30.0, amplitude_m: 10.0))";
    let mut run = simulation("Look()", noise, effort.rounds(200) + 1);
    let sand = run.snapshot().field("sand").expect("sand");
    let nodes: Vec<usize> = tenth(0).collect();
    let mut sum = 0.0;
    let pair = tax(&mut run, nodes.len(), || {
        sum = black_box(&nodes).iter().map(|&node| sand[node]).sum();
    });
    let group = run.snapshot().world().resource::<Group<Watchers>>();
    assert_eq!(group.globals, sum, "both sides end alike");
    pair.print("sparse visit, an agent", "a list of nodes", "2 x");
}

/// Agents that live for an iteration.
struct Mayflies;

impl AgentGroup for Mayflies {
    type State = u32;
    type Globals = ();
    const NAME: &'static str = "mayflies";
}

/// Lists of a tenth of the nodes, in random order, one after another.
fn broods() -> [Vec<usize>; 8] {
    let random = RandomStream::new(1, "broods");
    std::array::from_fn(|brood| {
        let mut nodes: Vec<usize> = (0..NODES).filter(|node| node % 8 == brood).collect();
        nodes.sort_by_key(|&node| random.block(0, node, 0));
        nodes.truncate(NODES / 10);
        nodes
    })
}

/// Agents that are all replaced by others elsewhere at each iteration.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
struct Renewal {}

impl Process for Renewal {
    const NAME: &'static str = "Renewal";

    fn declare(&self, uses: &mut Declaration) {
        uses.group::<Mayflies>();
    }
}

impl Plugin for Renewal {
    fn build(&self, app: &mut App) {
        let broods = broods();
        app.add_systems(Iterate, move |clock: Res<Clock>, mut mayflies: Agents<Mayflies>| {
            let mut mayflies = mayflies.view();
            mayflies.visit(|mayflies, node| _ = mayflies.deregister(node));
            for &node in &broods[clock.tick as usize % 8] {
                mayflies.register(node, 7);
            }
        });
    }
}

fn births_and_deaths(effort: Effort) {
    let iterations = effort.rounds(200) + 1;
    let mut run = simulation("Renewal()", "", iterations);
    let broods = broods();
    let (mut alive, mut ages) = (vec![false; NODES], vec![0_u32; NODES]);
    let mut tick = 0;
    let pair = tax(&mut run, broods[0].len(), || {
        for &node in &broods[(tick + 7) % 8] {
            alive[node] = false;
        }
        for &node in &broods[tick % 8] {
            (alive[node], ages[node]) = (true, 7);
        }
        tick += 1;
    });
    let group = run.snapshot().world().resource::<Group<Mayflies>>();
    assert!(group.members().iter().eq((0..NODES).filter(|&node| alive[node])), "both end alike");
    pair.print("birth and death, both", "a mask and values", "14 ns");
}

/// Agents that wander.
struct Walkers;

impl AgentGroup for Walkers {
    /// Where its random numbers are.
    type State = u32;
    type Globals = usize;
    const NAME: &'static str = "walkers";
}

/// Agents that step to a random neighbour.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
struct Walk {}

impl Process for Walk {
    const NAME: &'static str = "Walk";

    fn declare(&self, uses: &mut Declaration) {
        uses.group::<Walkers>();
    }
}

impl Plugin for Walk {
    fn build(&self, app: &mut App) {
        app.add_systems(Begin, |mut walkers: Agents<Walkers>| {
            let mut walkers = walkers.view();
            for node in (0..NODES).step_by(5) {
                walkers.register(node, node as u32 + 1);
            }
        });
        app.add_systems(Iterate, |mut walkers: Agents<Walkers>| {
            walkers.view().visit(|walkers, node| {
                let Some(state) = walkers.get_mut(node) else { return };
                let towards = roll(state);
                walkers.move_to(node, around(node)[towards]);
            });
        });
    }
}

/// The next of eight directions (xorshift of Marsaglia 2003).
fn roll(state: &mut u32) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    (*state >> 29) as usize
}

fn walkers(effort: Effort) {
    let mut run = simulation("Walk()", "", effort.rounds(100) + 1);
    let mut list: Vec<(usize, u32)> =
        (0..NODES).step_by(5).map(|node| (node, node as u32 + 1)).collect();
    let count = list.len();
    let mut taken: Vec<bool> = (0..NODES).map(|node| node % 5 == 0).collect();
    let moves = Cell::new(0);
    let pair = tax(&mut run, count, || {
        for (node, state) in &mut list {
            let to = around(*node)[roll(state)];
            if !taken[to] {
                (taken[*node], taken[to]) = (false, true);
                *node = to;
                moves.set(moves.get() + 1);
            }
        }
    });
    assert!(moves.get() > count, "walkers walk");
    pair.print("walkers, a step", "list and mask", "20 ns");
}
