//! Texts of scenarios, with edits of the command line before them.
//!
//! Lines at the head that begin with `--set ` are edits, and the rest is the scenario:
//!
//! ```text
//! --set stages[0].stop=Iterations(3)
//! (title: "Dunes", ...)
//! ```

use std::cell::OnceCell;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::sim::parameters::{ParameterDescription, Problem};
use landform::sim::registry::Registry;
use landform::sim::scenario::{Scenario, ScenarioSource};
use landform::sim::simulation::{Limits, Progress, Report, Simulation};

use crate::{SMALL, files_below, shown};

/// Memory of a run that is tried out: some ten thousand nodes.
const SMALL_MEMORY: Limits = Limits { memory_bytes: 2 << 20 };

/// Parameters whose numbers are work, not faults: a billion grains take a billion topplings.
const WORK: [&str; 3] = ["feed_slabs", "grains_per_iteration", "warm_up_iterations"];

fn registry() -> Arc<Registry> {
    thread_local!(static REGISTRY: OnceCell<Arc<Registry>> = const { OnceCell::new() });
    REGISTRY.with(|cell| Arc::clone(cell.get_or_init(|| Arc::new(landform::registry()))))
}

/// What `landform check` does with a text and its edits.
pub fn check(bytes: &[u8]) -> bool {
    let Some((source, scenario)) = read(bytes) else { return false };
    let checked = scenario.check(Path::new(""), Limits::default());
    checked.inspect_err(|problem| good_message(&source.render(problem))).is_ok()
}

/// Reads a scenario, checks all of it, and runs two iterations if it is small.
pub fn run(bytes: &[u8]) -> bool {
    let Some((source, mut scenario)) = read(bytes) else { return false };
    if WORK.iter().any(|work| source.text().contains(work)) {
        return false;
    }
    let refuse = |problem: &Problem| good_message(&source.render(problem));
    if scenario.check(Path::new(""), SMALL_MEMORY).inspect_err(refuse).is_err() {
        return false;
    }
    // Outputs are checked with the rest, but nothing is written here.
    scenario.outputs.clear();
    let simulation = Simulation::new(scenario, Path::new(""), SMALL_MEMORY).inspect_err(refuse);
    let Ok(mut simulation) = simulation else { return false };
    let mut hook = |progress: &Progress<'_>| match progress.iteration {
        0 | 1 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    };
    // Odd numbers may well end a run; the guards find that.
    let _ = simulation.run(Path::new(""), &mut hook, &mut Report::default());
    true
}

/// The scenario that the bytes hold, if it can be read; else its refusal is looked at.
fn read(bytes: &[u8]) -> Option<(ScenarioSource, Scenario)> {
    let mut text = str::from_utf8(bytes).ok()?;
    let mut edits = Vec::new();
    while let Some((line, rest)) = text.split_once('\n') {
        let Some(edit) = line.strip_prefix("--set ") else { break };
        edits.push(edit.split_once('=')?);
        text = rest;
    }
    let mut source = ScenarioSource::from_text("damaged.ron", text, Path::new(""));
    for (path, value) in edits {
        source.set(path, value).inspect_err(|message| good_message(message)).ok()?;
    }
    let scenario = source.parse(&registry()).inspect_err(|message| good_message(message)).ok()?;
    Some((source, scenario))
}

/// Every refusal is a message of a few lines, for each thing that is wrong.
fn good_message(message: &str) {
    assert!(message.starts_with("error[L"), "{message}");
    assert!(message.len() < 20_000, "{} bytes:\n{message:.3000}", message.len());
}

/// The scenarios of the repository, and one with edits.
pub fn seeds() -> Vec<(String, Vec<u8>)> {
    let mut seeds = small_seeds();
    for path in files_below("scenarios", "ron") {
        let text = fs::read(&path).expect("a scenario can be read");
        seeds.push((shown(&path).replace('/', "_"), text));
    }
    seeds
}

/// A small scenario of each process, and the one that uses every kind of output.
pub fn small_seeds() -> Vec<(String, Vec<u8>)> {
    let edits = "--set stages[0].stop=Iterations(3)\n--set stages[0].processes.Dunes.slab_m=2.0\n\
        --set domain.spacing_m=20.0\n--set title=Edited\n";
    let mut seeds = vec![
        ("small.ron".to_owned(), SMALL.into()),
        ("edited.ron".to_owned(), [edits, SMALL].concat().into()),
    ];
    for process in registry().processes.names() {
        // Which field a process reads is its own affair: those that do not fit are left out.
        for field in ["sand", "bed", "grains"] {
            let text = format!(
                "(title: \"{process}\", domain: Grid(size: (24, 16), spacing_m: 10.0),\n \
                 initial: [(field: \"{field}\", from: SmoothNoise(mean_m: 9.0))],\n \
                 stages: [(processes: [{process}()], stop: Iterations(2))])\n"
            );
            if run(text.as_bytes()) {
                seeds.push((format!("{process}_{field}.ron"), text.into()));
            }
        }
    }
    seeds
}

/// Names that scenarios use, and pieces of RON.
pub fn words() -> Vec<String> {
    let registry = registry();
    let mut words: Vec<String> = [
        "-",
        "0",
        "9",
        "(",
        ")",
        "[",
        "]",
        "\"",
        ",",
        ":",
        "NaN",
        "inf",
        "1e309",
        "1e-320",
        "None",
        "Some(",
        "//",
        "/*",
        "*/",
        "\\",
        "é",
        "\u{202e}",
        "r#\"",
        "\"#",
        "0x",
        "..",
        "()",
        "-1",
        "1e9",
        "'a'",
        "b\"",
        "{",
        "}",
        "#![enable(",
        "\n--set ",
        "--set ",
        "=",
        "true",
        "title",
        "description",
        "seed",
        "domain",
        "initial",
        "stages",
        "metrics",
        "outputs",
        "processes",
        "stop",
        "name",
        "field",
        "from",
        "combine",
        "measure_every",
        "Iterations(",
        "Finished",
        "Below(",
        "Above(",
        "Steady(",
        "Any([",
        "Periodic",
        "Open",
        "18446744073709551615",
    ]
    .map(str::to_owned)
    .into();
    let mut entry = |name: &str, parameters: Vec<ParameterDescription>| {
        words.push(format!("{name}("));
        words.extend(parameters.iter().map(|parameter| format!("{}: ", parameter.name)));
    };
    registry.domains.iter().for_each(|known| entry(known.name, known.parameters()));
    registry.initial.iter().for_each(|known| entry(known.name, known.parameters()));
    registry.processes.iter().for_each(|known| entry(known.name, known.parameters()));
    registry.metrics.iter().for_each(|known| entry(known.name, known.parameters()));
    registry.outputs.iter().for_each(|known| entry(known.name, known.parameters()));
    words.sort();
    words.dedup();
    words
}
