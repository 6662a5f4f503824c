//! Every scenario file of the repository is checked as it is and run at a small size by the
//! program itself. A new file is found by itself.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform::io::{ReadLimits, npy};
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::Limits;
use landform_tests::{
    Program, Scratch, cuts, files_below, repository, shown, write_hills, write_shore,
};
use serde_json::Value;

/// Scenario files; tables and other data lie in `scenarios/data`, and what `landform reproduce`
/// reads is called `NAME.targets.ron`, sweeps `NAME.sweep.ron`.
fn scenarios() -> Vec<PathBuf> {
    let data = repository().join("scenarios/data");
    let mut files = files_below("scenarios", "ron");
    let other = [".targets.ron", ".sweep.ron"];
    files.retain(|file| {
        !file.starts_with(&data) && !other.iter().any(|ending| shown(file).ends_with(ending))
    });
    assert!(!files.is_empty(), "there are scenarios");
    files
}

/// Runs a scenario in a folder of its own; `options` are further arguments.
fn run(scenario: &Path, options: &[String]) -> (Scratch, Value) {
    let scratch = Scratch::new("scenario");
    let told = Program::within(scratch.folder())
        .args(["run", "-o", "o", "--quiet"])
        .args([scenario])
        .args(options)
        .run()
        .good();
    assert!(!told.is_empty());
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    (scratch, serde_json::from_str(&report).expect("JSON"))
}

/// What every finished run must show.
fn examine(scenario: &Path, scratch: &Scratch, report: &Value) {
    let name = shown(scenario);
    for output in report["outputs"].as_array().expect("outputs") {
        let file = scratch.path("o").join(output["file"].as_str().expect("a file"));
        assert!(fs::metadata(&file).is_ok_and(|file| file.len() > 0), "{name}: {}", file.display());
    }
    let nodes = report["nodes"].as_u64().expect("nodes") as usize;
    let mut fields = 0;
    for entry in fs::read_dir(scratch.path("o/fields")).expect("fields") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == "npy") {
            // Volumes have three axes.
            let field = npy::read_array(&path, &ReadLimits::default()).expect("a field");
            assert_eq!(field.values.len(), nodes, "{name}: {}", path.display());
            let finite = field.values.iter().all(|value| value.is_finite());
            assert!(finite, "{name}: {}", path.display());
            fields += 1;
        }
    }
    assert!(fields > 0, "{name} left no field");
    for stage in report["stages"].as_array().expect("stages") {
        assert!(stage["iterations"].as_u64().is_some_and(|count| count > 0), "{name}: {stage}");
    }
    for (account, budget) in report["ledger"]["accounts"].as_object().expect("a ledger") {
        let gap = budget["largest_gap"].as_f64();
        assert!(gap.is_some_and(|gap| gap <= 1e-9), "{name}: {account} has a gap: {budget}");
    }
}

#[test]
fn every_scenario_is_good_as_it_stands_or_wants_a_file() {
    let registry = Arc::new(landform::registry());
    for file in scenarios() {
        let source = ScenarioSource::open(&file).unwrap_or_else(|error| panic!("{error}"));
        let scenario = source.parse(&registry).unwrap_or_else(|error| panic!("{error}"));
        assert!(!scenario.title.is_empty(), "{} has no title", shown(&file));
        if let Err(problem) = scenario.check(source.folder(), Limits::default()) {
            let from_file = matches!(scenario.domain.name, "Raster" | "Shoreline");
            let wants_file = from_file && problem.parameter == "domain.path";
            assert!(wants_file, "{}", source.render(&problem));
        }
    }
}

#[test]
fn every_scenario_runs_at_a_small_size() {
    let rasters = Scratch::new("hills");
    let raster = rasters.path("hills.tif");
    write_hills(&raster, 60, 44);
    write_shore(&rasters.path("hills.csv"));
    for file in scenarios() {
        let (scratch, report) = run(&file, &cuts(&file, &raster));
        examine(&file, &scratch, &report);
    }
}

/// Real elevation tiles: below `LANDFORM_DATA`, or in `shared/data` beside the checkout.
fn real_tiles() -> Vec<PathBuf> {
    let beside = || repository().parent().map(|parent| parent.join("shared/data"));
    let Some(data) = env::var_os("LANDFORM_DATA").map(PathBuf::from).or_else(beside) else {
        return Vec::new();
    };
    let mut tiles: Vec<PathBuf> = fs::read_dir(data.join("dem"))
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "tif" || end == "asc"))
        .collect();
    tiles.sort();
    tiles
}

#[test]
fn scenarios_on_a_raster_run_on_real_tiles_where_there_are_some() {
    let tiles = real_tiles();
    if tiles.is_empty() {
        println!("no real tiles: LANDFORM_DATA is not set and ../shared/data/dem does not exist");
        return;
    }
    let wants_raster = |file: &PathBuf| {
        fs::read_to_string(file).is_ok_and(|text| text.contains("domain: Raster("))
    };
    for file in scenarios().iter().filter(|file| wants_raster(file)) {
        for tile in &tiles {
            let mut options = cuts(file, tile);
            // Every tenth node of a tile is enough here.
            options.extend(
                ["--set", "domain.every=10", "--set", "domain.gaps=Lowest"].map(str::to_owned),
            );
            let (scratch, report) = run(file, &options);
            examine(file, &scratch, &report);
            println!("{} on {}: {} nodes", shown(file), tile.display(), report["nodes"]);
        }
    }
}
