//! The example of the chapter "Write a process" is a program of its own: it builds, its
//! processes are listed beside the built-in ones, and its scenarios leave their pictures.

use std::env::consts;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use landform::view::Image;
use landform_tests::{Program, Scratch, build_folder, cuts, files_below, repository, shown};
use serde_json::Value;

/// Builds the example as the tests were built, so that the libraries of others are shared.
fn build() -> PathBuf {
    let folder = build_folder();
    let target = folder.parent().expect("the folder of the profile lies in the target folder");
    let mut cargo = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()));
    cargo.args(["build", "--quiet", "--locked", "--manifest-path"]);
    cargo.arg(repository().join("docs/write-a-process/Cargo.toml"));
    cargo.arg("--target-dir").arg(target);
    for setting in [
        "profile.dev.opt-level=2",
        "profile.dev.debug=\"line-tables-only\"",
        "profile.dev.package.\"*\".debug=false",
    ] {
        cargo.args(["--config", setting]);
    }
    if folder.ends_with("release") {
        cargo.arg("--release");
    }
    let output = cargo.output().expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder.join(format!("write-a-process{}", consts::EXE_SUFFIX))
}

#[test]
fn the_example_builds_and_its_scenarios_leave_pictures() {
    let program = build();
    let scenarios = files_below("docs/write-a-process", "ron");
    assert!(!scenarios.is_empty(), "the example has scenarios");
    for file in scenarios {
        let scratch = Scratch::new("write_a_process");
        let cuts = cuts(&file, &scratch.path("none.tif"));
        let call = Program::of(&program, scratch.folder()).line("run -o o --quiet").args([&file]);
        call.args(cuts).run().good();
        let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
        let report: Value = serde_json::from_str(&report).expect("JSON");
        let outputs = report["outputs"].as_array().expect("outputs");
        let mut pictures = outputs.iter().filter(|output| output["kind"] == "picture");
        let picture = pictures.next().unwrap_or_else(|| panic!("{} leaves none", shown(&file)));
        let path = scratch.path("o").join(picture["file"].as_str().expect("a file"));
        assert!(Image::read_png(&path).is_ok(), "{}", path.display());
    }
    let built_in = landform::registry().processes.names();
    let listed = Program::of(&program, &repository()).line("list processes").run().good();
    assert!(built_in.iter().all(|name| listed.contains(name)), "{listed}");
    assert!(listed.lines().count() > built_in.len() + 1, "and its own: {listed}");
}
