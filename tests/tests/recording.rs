//! What a run records: when outputs are due, series that grow, tables and numbers of agents.

use std::fs;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use landform::io::read_raster;
use landform::prelude::*;
use landform::sim::metric::RowsKept;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, Simulation};
use landform_tests::{Program, Scratch};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Gives the sand of every node the next of some values at each iteration.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Levels {
    /// The values.
    values: Vec<f64>,
}

impl Plugin for Levels {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, set_level);
    }
}

fn set_level(levels: Res<Settings<Levels>>, clock: Res<Clock>, mut sand: FieldMut<Sand>) {
    let level = levels.values[clock.tick as usize % levels.values.len()];
    sand.values_mut().fill(level);
}

impl Process for Levels {
    const NAME: &'static str = "Levels";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Sand>();
    }

    fn iterations(&self) -> Option<u64> {
        Some(self.values.len() as u64)
    }
}

/// Walkers that know how far they have come and what they carry.
struct Walkers;

#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct Walker {
    steps: u32,
    load_m3: f64,
}

impl AgentGroup for Walkers {
    type State = Walker;
    type Globals = ();
    const NAME: &'static str = "walkers";
    const QUANTITIES: &'static [Quantity<Walker>] = &[
        Quantity::new("steps", "1", |walker| f64::from(walker.steps)),
        Quantity::new("load", "m3", |walker| walker.load_m3),
    ];
}

/// At each iteration walkers go a node to the east, those at the border leave, and one is born
/// in the west.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Walk {}

impl Plugin for Walk {
    fn build(&self, app: &mut App) {
        app.add_systems(Iterate, walk);
    }
}

fn walk(clock: Res<Clock>, space: Res<Space>, mut walkers: Agents<Walkers>) {
    let mut walkers = walkers.view();
    walkers.visit(|walkers, node| {
        if let Some(walker) = walkers.get_mut(node) {
            walker.steps += 1;
        }
        let [column, ..] = space.coordinates(node);
        match column + 1 < space.width() {
            true => walkers.move_to(node, node + 1),
            false => walkers.deregister(node),
        };
    });
    walkers.register(0, Walker { steps: 0, load_m3: clock.tick as f64 / 4.0 });
}

impl Process for Walk {
    const NAME: &'static str = "Walk";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Sand>().group::<Walkers>();
    }
}

/// A scenario of one stage.
fn scenario(stages: &str, metrics: &str, outputs: &str) -> String {
    format!(
        r#"(
            title: "recording",
            seed: 7,
            domain: Grid(size: (4, 2), spacing_m: 10.0),
            initial: [(field: "sand", from: Uniform(value: 5.0))],
            stages: [{stages}],
            metrics: [{metrics}],
            outputs: [{outputs}],
        )"#
    )
}

fn build(text: &str) -> Result<Simulation, String> {
    let mut registry = landform::registry();
    registry.process::<Levels>().process::<Walk>();
    let source = ScenarioSource::from_text("recording.ron", text, std::path::Path::new("."));
    let scenario = source.parse(&Arc::new(registry))?;
    Simulation::new(scenario, source.folder(), Limits::default())
        .map_err(|problem| source.render(&problem))
}

/// Runs a scenario, which must be good so far, into a folder.
fn run(text: &str) -> (Scratch, Report, Result<(), String>) {
    let scratch = Scratch::new("recording");
    let mut simulation = build(text).unwrap_or_else(|message| panic!("{message}"));
    let mut report = Report::default();
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    let result = simulation.run(scratch.folder(), &mut hook, &mut report);
    (scratch, report, result.map_err(|error| error.to_string()))
}

/// The files that are written by an output with this schedule, while the mean of the sand is 5
/// at the start and then 4, 1, 3, 2 in a first stage and 6, 1 in a second one.
fn files(measure_every: u64, when: &str) -> Vec<String> {
    let stages = "(processes: [Levels(values: [4.0, 1.0, 3.0, 2.0])]), \
                  (processes: [Levels(values: [6.0, 1.0])])";
    let metrics = "FieldStatistic(field: \"sand\")";
    let outputs = format!("FieldFile(file: \"s.npy\", field: \"sand\", when: {when})");
    let text = scenario(stages, metrics, &outputs);
    let text = text.replace("seed: 7,", &format!("seed: 7, measure_every: {measure_every},"));
    let (scratch, report, result) = run(&text);
    result.expect("a good run");
    let files: Vec<String> =
        report.outputs.iter().map(|output| output.file.display().to_string()).collect();
    let mut sorted = files.clone();
    sorted.sort();
    let there = scratch.names().into_iter().filter(|name| name.ends_with(".npy"));
    assert_eq!(there.collect::<Vec<_>>(), sorted, "{when}: each file once");
    files
}

#[test]
fn conditions_on_metrics_are_met_once_or_while_they_hold() {
    let low = |more: &str| format!("Below(metric: \"sand_mean_m\", value: 2.5{more})");
    let high = |more: &str| format!("Above(metric: \"sand_mean_m\", value: 3.5{more})");
    let always = ", while_it_holds: true";
    assert_eq!(files(1, &low("")), ["s.npy"]);
    assert_eq!(files(1, &low(always)), ["s_000002.npy", "s_000004.npy", "s_000006.npy"]);
    assert_eq!(files(1, &high(always)), ["s_000000.npy", "s_000001.npy", "s_000005.npy"]);
    assert_eq!(files(1, "Below(metric: \"sand_mean_m\", value: 0.5)"), [""; 0]);
    // Conditions look at measurements: here those after 0, 3, 4 (a stage ends) and 6 iterations.
    assert_eq!(files(3, &low(always)), ["s_000004.npy", "s_000006.npy"]);
}

#[test]
fn moments_that_coincide_leave_one_file() {
    assert_eq!(
        files(1, "Any([Every(3), StageEnds, End])"),
        ["s_000000.npy", "s_000003.npy", "s_000004.npy", "s_000006.npy"]
    );
    let mixed = "Any([Start, Below(metric: \"sand_mean_m\", value: 2.5), Any([End])])";
    assert_eq!(files(1, mixed), ["s_000000.npy", "s_000002.npy", "s_000006.npy"]);
}

#[test]
fn the_file_of_a_condition_holds_the_moment_when_it_was_met() {
    let outputs = "FieldFile(file: \"s.npy\", field: \"sand\", \
                   when: Below(metric: \"sand_mean_m\", value: 2.5))";
    let stages = "(processes: [Levels(values: [4.0, 1.0, 3.0, 2.0])])";
    let (scratch, ..) = run(&scenario(stages, "FieldStatistic(field: \"sand\")", outputs));
    assert_eq!(read_raster(scratch.path("s.npy")).expect("a raster").values, [1.0; 8]);
}

#[test]
fn schedules_that_are_never_met_are_refused() {
    let stage = "(processes: [Levels(values: [4.0, 1.0])])";
    let mean = "FieldStatistic(field: \"sand\")";
    let refused = |metrics: &str, when: &str| {
        let outputs = format!("Picture(file: \"p.png\", when: {when})");
        build(&scenario(stage, metrics, &outputs)).err().unwrap_or_default()
    };
    for (metrics, when, part) in [
        (mean, "Every(0)", "every 0 iterations"),
        (mean, "Any([])", "never due"),
        (mean, "Any([End, Every(0)])", "every 0 iterations"),
        (mean, "Below(metric: \"sand_mean_m\", value: NaN)", "not finite"),
        ("", "Any([End, Above(metric: \"a\", value: 1.0)])", "measures none"),
        (mean, "Sometimes", "Sometimes"),
        (mean, "Below(metric: \"a\", value: 1.0, while: true)", "while"),
        (mean, "Below(metric: \"a\")", "value"),
    ] {
        let message = refused(metrics, when);
        assert!(message.contains(part) && message.contains("recording.ron:8:"), "{message}");
    }
    for output in ["Picture(file: \"p.png\"", "FieldSeries(file: \"p.nc\""] {
        let when = "when: Below(metric: \"sand_mean\", value: 1.0))";
        let (_, _, result) = run(&scenario(stage, mean, &format!("{output}, {when}")));
        let message = result.expect_err("a wrong name");
        for part in ["outputs[0].when", "nothing measures `sand_mean`", "\"sand_mean_m\"?"] {
            assert!(message.contains(part), "{message}");
        }
    }
}

#[test]
fn names_that_every_run_uses_itself_are_refused() {
    let stage = "(processes: [Walk()], stop: Iterations(2))";
    let table = "AgentTable(file: \"series.csv\", group: \"walkers\")";
    let message = build(&scenario(stage, "", table)).err().unwrap_or_default();
    assert!(message.contains("is what every run leaves itself"), "{message}");
}

#[test]
fn agents_are_counted_measured_and_listed() {
    let stage = "(processes: [Walk()], stop: Iterations(7))";
    let metrics = "AgentCount(group: \"walkers\"), \
        AgentStatistic(group: \"walkers\", quantity: \"steps\", statistic: Sum), \
        AgentStatistic(group: \"walkers\", quantity: \"load\", statistic: Maximum)";
    let outputs = "AgentTable(file: \"w.csv\", group: \"walkers\"), \
        AgentTable(file: \"early/w.csv\", group: \"walkers\", when: Every(3))";
    let (scratch, report, result) = run(&scenario(stage, metrics, outputs));
    result.expect("a good run");
    // One is born in every other iteration, since a node is free only after its walker has gone.
    // Two of the four have left over the border; moves are neither births nor deaths.
    let metrics: Vec<_> =
        report.metrics.iter().map(|(name, &value)| (name.as_str(), value)).collect();
    assert_eq!(
        metrics,
        [
            ("walkers_births", 4.0),
            ("walkers_count", 2.0),
            ("walkers_deaths", 2.0),
            ("walkers_load_maximum_m3", 1.5),
            ("walkers_steps_sum", 2.0),
        ]
    );
    let table = fs::read_to_string(scratch.path("w.csv")).expect("a table");
    assert_eq!(
        table,
        "node,column,row,since,steps,load_m3\n\
        0,0,0,7,0.0,1.5\n2,2,0,7,2.0,1.0\n"
    );
    let early = |tick| fs::read_to_string(scratch.path(&format!("early/w_{tick:06}.csv")));
    assert_eq!(early(0).expect("a table"), "node,column,row,since,steps,load_m3\n");
    assert_eq!(early(3).expect("a table").lines().count(), 3);
    assert!(early(7).is_err(), "seven is no multiple of three");
}

#[test]
fn groups_and_quantities_that_are_not_there_are_refused() {
    let stage = "(processes: [Walk()], stop: Iterations(2))";
    let count = |group: &str| format!("AgentCount(group: \"{group}\")");
    let load = |name: &str| format!("AgentStatistic(group: \"walkers\", quantity: \"{name}\")");
    for (metrics, outputs, parts) in [
        (count("walker"), "", ["no group of agents is called `walker`", "\"walkers\"?"]),
        (load("lod"), "", ["agents of `walkers` know no `lod`", "\"load\"?"]),
        (String::new(), "AgentTable(group: \"x\")", ["outputs[0].group", "are: walkers"]),
        ("AgentCount()".to_owned(), "", ["group", "recording.ron:7:"]),
    ] {
        let message = build(&scenario(stage, &metrics, outputs)).err().unwrap_or_default();
        for part in parts {
            assert!(message.contains(part), "{part}: {message}");
        }
    }
    let dunes = "(processes: [Smoothing()], stop: Iterations(2))";
    let message = build(&scenario(dunes, &count("walkers"), "")).err().unwrap_or_default();
    assert!(message.contains("the groups are: none"), "{message}");
}

#[test]
fn statistics_look_at_a_part_of_the_nodes() {
    let stage = "(processes: [Levels(values: [2.0])])";
    let over =
        |region: &str| format!("FieldStatistic(field: \"sand\", statistic: Sum, over: {region})");
    let metrics = [
        over("Above(field: \"surface\", value: 1.5)"),
        over("Below(field: \"sand\", value: 2.0)"),
        over("Everywhere"),
    ];
    let (_, report, result) = run(&scenario(stage, &metrics.join(", "), ""));
    result.expect("a good run");
    let names: Vec<&String> = report.metrics.keys().collect();
    assert_eq!(names, ["sand_sum_m", "sand_sum_m_where_surface_above_1.5"]);
    assert_eq!(report.metrics["sand_sum_m_where_surface_above_1.5"], 16.0);
    for (region, part) in [
        ("Above(field: \"snd\", value: 1.0)", "\"sand\"?"),
        ("Above(field: \"sand\", value: inf)", "not finite"),
    ] {
        let message = build(&scenario(stage, &over(region), "")).err().unwrap_or_default();
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn a_series_of_fields_holds_every_record() {
    let stages = "(processes: [Levels(values: [4.0, 1.0, 3.0])])";
    let outputs =
        "FieldSeries(file: \"deep/a.nc\", fields: [\"sand\", \"surface\"], when: Every(2))";
    let (scratch, report, result) = run(&scenario(stages, "", outputs));
    result.expect("a good run");
    assert_eq!(report.outputs[0].kind, "fields");
    let bytes = fs::read(scratch.path("deep/a.nc")).expect("a file");
    assert_eq!(bytes[..8], [b'C', b'D', b'F', 2, 0, 0, 0, 2], "two records");
    let numbers: Vec<f64> = bytes[bytes.len() - 2 * 17 * 8..]
        .chunks_exact(8)
        .map(|bytes| f64::from_be_bytes(bytes.try_into().expect("eight bytes")))
        .collect();
    let record = |tick: f64, level: f64| [vec![tick], vec![level; 16]].concat();
    assert_eq!(numbers, [record(0.0, 5.0), record(2.0, 1.0)].concat());

    for (fields, part) in [
        ("[\"sand\", \"sand\"]", "field `sand` stands twice"),
        ("[\"snd\"]", "no field is called `snd`"),
        ("[]", "at least 1"),
    ] {
        let outputs = format!("FieldSeries(fields: {fields})");
        let message = build(&scenario(stages, "", &outputs)).err().unwrap_or_default();
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn rules_look_at_the_same_values_when_rows_are_not_kept() {
    let stages = "(processes: [Levels(values: [4.0, 1.0, 3.0, 3.0, 3.0, 9.0])], \
                  stop: Any([Finished, Steady(metric: \"sand_mean_m\", change: 0.0, measurements: 3)]))";
    let text = scenario(stages, "FieldStatistic(field: \"sand\")", "");
    let reasons = [RowsKept::All, RowsKept::Latest].map(|kept| {
        let mut simulation = build(&text).unwrap_or_else(|message| panic!("{message}"));
        simulation.keep_rows(kept);
        let mut report = Report::default();
        let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
        let result = simulation.run(std::path::Path::new(""), &mut hook, &mut report);
        result.expect("a good run");
        let rows = simulation.series().rows().count();
        assert_eq!(rows, if kept == RowsKept::All { 6 } else { 1 });
        (report.stages[0].stopped.clone(), report.stages[0].iterations)
    });
    assert_eq!(reasons[0], ("sand_mean_m is steady at 3".to_owned(), 5));
    assert_eq!(reasons[0], reasons[1]);
}

#[test]
fn the_series_of_a_run_can_be_read_while_it_goes_on() {
    let scratch = Scratch::new("growing");
    let stage = "(processes: [Smoothing()], stop: Iterations(100000000))";
    let text = scenario(stage, "FieldStatistic(field: \"sand\")", "");
    scratch.write("long.ron", text.replace("size: (4, 2)", "size: (32, 32)"));
    let mut child = Program::within(scratch.folder()).line("run long.ron -o o --threads 1").start();
    let start = Instant::now();
    let lines = || fs::read_to_string(scratch.path("o/series.csv")).unwrap_or_default();
    while lines().lines().count() < 3 && start.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(50));
    }
    child.kill().expect("it runs");
    child.wait().expect("it ends");
    let text = lines();
    assert!(text.starts_with("iteration,sand_mean_m\n0,5.0\n1,") && text.ends_with('\n'));
    for (number, line) in text.lines().skip(1).enumerate() {
        let (tick, value) = line.split_once(',').expect("two cells");
        assert_eq!(tick.parse(), Ok(number));
        assert!(value.parse::<f64>().is_ok(), "{line}");
    }
}
