//! A run that is killed at any moment and resumed leaves what an unbroken run leaves, byte for
//! byte.

use std::collections::BTreeMap;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use landform::sim::random::{RandomStream, unit};
use landform_tests::{Ended, Program, Scratch, differences, tree};

/// Two stages with every kind of output and a metric that remembers.
const DUNES: &str = r#"(
    title: "Dunes to interrupt",
    domain: Grid(size: (64, 48), spacing_m: 10.0, boundary: (Periodic, Open)),
    initial: [(field: "sand", from: WhiteNoise(mean_m: 20.0, amplitude_m: 5.0))],
    stages: [
        (name: "wind", processes: [Dunes(slab_m: 3.0)], stop: Iterations(24)),
        (name: "smooth", processes: [Smoothing(), Dunes(shelter: Protection())], stop: Iterations(9)),
    ],
    metrics: [Migration(), RidgeDrift(warm_up_iterations: 4), DuneActivity(), FieldStatistic(field: "sand", statistic: Maximum)],
    measure_every: 2,
    outputs: [
        Picture(file: "maps/map.png", when: Every(5)),
        Panels(file: "panels.png"),
        Figure(file: "figure.png", panels: [
            (field: "sand", look: Flat()), (at: "smooth", since: "wind", look: Hypsometry()),
            (at: "wind", look: Relief(water: (field: "sand"))),
        ]),
        Animation(file: "growth.apng", every: 2),
        Animation(file: "films/growth.gif", every: 3),
        FieldFile(file: "surface.tif", when: StageEnds),
        Mesh(file: "surface.glb"),
        FieldSeries(file: "fields.nc", fields: ["sand", "bed"], when: Any([Every(3), StageEnds])),
        Picture(file: "high.png", when: Above(metric: "sand_maximum_m", value: 30.0)),
    ],
)"#;

/// Processes that keep state beside the fields, and records that outlast their stage.
const PILES: &str = r#"(
    title: "Piles to interrupt",
    domain: Grid(size: (80, 60), connectivity: Four, boundary: (Open, Open)),
    initial: [
        (field: "sand", from: WhiteNoise(mean_m: 60.0, amplitude_m: 55.0)),
        (field: "bed", from: Uniform(value: 100.0)),
    ],
    stages: [
        (name: "sand", processes: [SandLike()], stop: Iterations(20)),
        (name: "rock", processes: [CorrosionLike(), Smoothing()], stop: Iterations(20)),
        (name: "pile", processes: [Sandpile(grains_per_iteration: 900)], stop: Iterations(20)),
        (name: "rice", processes: [RicePile(grains_per_iteration: 30)], stop: Iterations(9)),
        (name: "slabs", processes: [SlidingSlabs(grains_per_iteration: 90)], stop: Iterations(9)),
        (name: "rest", processes: [Smoothing(diffusivity_m2: 0.1)], stop: Iterations(8)),
    ],
    metrics: [
        Avalanches(), GrainShares(warm_up_iterations: 3),
        FieldStatistic(field: "bed", statistic: Mean),
    ],
    outputs: [Animation(file: "grains.gif", field: "grains", look: Flat(range: (0.0, 3.0)), every: 4)],
)"#;

/// Agents that are born, move on and die.
const AGENTS: &str = r#"(
    title: "Agents to interrupt",
    domain: Grid(size: (150, 100), connectivity: Eight),
    stages: [
        (name: "fire", processes: [ForestFire(growth: 0.02, lightning: 0.0005), LivingCells()],
         stop: Iterations(70)),
        (name: "ash", processes: [LivingCells(alive_share: 0.2)], stop: Iterations(30)),
    ],
    metrics: [
        FieldStatistic(field: "forest"), FieldStatistic(field: "burnt", statistic: Sum),
        AgentCount(group: "trees"),
    ],
    outputs: [
        AgentTable(file: "fires.csv", group: "fires", when: Every(20)),
        Animation(file: "fire.apng", field: "forest", look: Flat(range: (0.0, 2.0)), every: 10),
    ],
)"#;

/// A cave, whose history and marks outlast an interruption.
const CAVE: &str = r#"(
    title: "Cave to interrupt",
    domain: Volume(size: (40, 30, 14)),
    initial: [(field: "porosity", from: Uniform(value: 0.2))],
    stages: [
        (name: "fine", processes: [Protochannels(sources: [(center: (0.1, 0.2, 1.0))], protosinks: 12)],
         stop: Iterations(1)),
        (name: "grown", processes: [CaveGrowth(
            sources: [(center: (0.1, 0.2, 1.0)), (center: (0.5, 0.8, 1.0))],
            sinks: [(center: (1.0, 0.5, 0.1))],
         )], stop: Iterations(90)),
        (name: "smooth", processes: [CaveGrowth(
            sources: [(center: (0.1, 0.2, 1.0))], sinks: [(center: (1.0, 0.5, 0.1))],
         )], stop: Iterations(10)),
    ],
    metrics: [CaveCourses()],
    outputs: [
        CaveEventTable(),
        Figure(file: "figure.png", panels: [
            (at: "fine", field: "protochannels", look: Passages(
                at_least: 1.0, tube_radius_m: 0.3, colour_by: "pressure_zone", size: (200, 150),
            )),
            (at: "grown", after: 30, field: "porosity", look: CaveMap(at_least: 0.35, width: 200)),
            (at: "grown", field: "pressure", look: Cloud(size: (200, 150))),
        ]),
        Animation(file: "growth.gif", field: "porosity", look: Passages(at_least: 0.35, size: (120, 90)), every: 10),
    ],
)"#;

/// A scenario in a folder of its own, with what an unbroken run of it left.
struct Case {
    scratch: Scratch,
    expected: BTreeMap<String, Vec<u8>>,
    duration: Duration,
    every: &'static str,
}

impl Case {
    fn new(scenario: &str, every: &'static str) -> Self {
        let scratch = Scratch::new("resume");
        scratch.write("run.ron", scenario);
        let start = Instant::now();
        Program::within(scratch.folder()).line("run run.ron -o whole --threads 2").run().good();
        let duration = start.elapsed();
        let expected = tree(&scratch.path("whole"));
        Self { scratch, expected, duration, every }
    }

    fn program(&self, options: &str) -> Program {
        let line =
            format!("run run.ron -o o --quiet --threads 2 --checkpoint-every {}", self.every);
        Program::within(self.scratch.folder()).line(&line).line(options)
    }

    /// Kills runs and resumed runs, and lets one come to its end.
    fn kill_and_resume(&self, random: &mut impl FnMut() -> f64) -> usize {
        let mut kills = 0;
        let mut child = self.program("").start();
        let mut attempts = 3;
        while attempts > 0 {
            sleep(self.duration.mul_f64(0.9 * random()));
            kills += usize::from(kill(child));
            attempts = if random() < 0.5 { 0 } else { attempts - 1 };
            child = self.program("--resume").start();
        }
        let ended = Ended::of(child.wait_with_output().expect("the run ends"));
        assert_eq!(ended.status, Some(0), "{ended:?}");
        kills
    }

    fn check(&self) {
        let found = tree(&self.scratch.path("o"));
        let different = differences(&self.expected, &found);
        assert!(different.is_empty(), "not as in an unbroken run: {different:?}");
        std::fs::remove_dir_all(self.scratch.path("o")).expect("the folder can go");
    }
}

/// Kills a process like a failure of power; `false` when it had come to its end.
fn kill(mut child: Child) -> bool {
    let running = child.try_wait().expect("a state").is_none();
    child.kill().expect("it can be killed");
    child.wait().expect("it ends");
    running
}

/// Kills runs of a scenario, and runs that were resumed, at random moments, [`KILLS`] times.
fn survive(scenario: &str, every: &'static str) {
    let case = Case::new(scenario, every);
    let stream = RandomStream::new(7, scenario);
    let mut drawn = 0;
    let mut random = || {
        drawn += 1;
        unit(stream.block(drawn, 0, 0)[0])
    };
    let mut kills = 0;
    for trial in 0.. {
        kills += case.kill_and_resume(&mut random);
        case.check();
        if kills >= KILLS {
            break;
        }
        assert!(trial < 5 * KILLS, "{kills} kills: most runs are over before they can be killed");
    }
}

/// Times that runs of each scenario are killed.
const KILLS: usize = 17;

#[test]
fn dunes_with_all_outputs_survive_kills() {
    survive(DUNES, "2it");
}

#[test]
fn piles_with_state_of_their_own_survive_kills() {
    survive(PILES, "3it");
}

#[test]
fn agents_survive_kills() {
    survive(AGENTS, "0.02s");
}

#[test]
fn caves_survive_kills() {
    survive(CAVE, "3it");
}

#[test]
fn ctrl_c_keeps_a_checkpoint_and_says_how_to_go_on() {
    let case = Case::new(DUNES, "0");
    for pause in [0.3, 0.6] {
        let child = case.program("").start();
        sleep(case.duration.mul_f64(pause));
        let id = child.id().to_string();
        let sent = std::process::Command::new("kill").args(["-INT", &id]).status();
        assert!(sent.expect("kill is there").success());
        let ended = Ended::of(child.wait_with_output().expect("it ends"));
        assert_eq!(ended.status, Some(130), "{ended:?}");
        assert!(ended.stderr.contains("landform run run.ron -o o --resume"), "{ended:?}");
        case.program("--resume").run().good();
        case.check();
    }
}
