//! Arguments and files around a scenario that must be refused: missing and absurd files,
//! folders that cannot be written, broken `--set` values, sizes beyond the memory.

use std::fs;
use std::time::{Duration, Instant};

use landform_tests::{Ended, Program, SMALL, Scratch};

fn scratch() -> Scratch {
    let scratch = Scratch::new("bad_arguments");
    scratch.write("small.ron", SMALL);
    scratch
}

fn run(scratch: &Scratch, arguments: &[&str]) -> Ended {
    Program::within(scratch.folder()).args(["run", "small.ron", "-o", "o"]).args(arguments).run()
}

#[test]
fn scenario_files_that_cannot_be_read() {
    let scratch = scratch();
    for (line, part) in [
        ("run nowhere.ron", "cannot read the scenario nowhere.ron: No such file"),
        ("run .", ". is a folder; name a scenario file (*.ron)"),
        ("run small.ron/x", "cannot read the scenario small.ron/x"),
        ("check nowhere.ron", "cannot read the scenario nowhere.ron"),
    ] {
        let message = Program::within(scratch.folder()).line(line).run().refused();
        assert!(message.contains(part), "{line}: {message}");
    }
    assert_eq!(scratch.names(), ["small.ron"]);
}

#[cfg(unix)]
#[test]
fn a_file_without_an_end_is_not_read_to_its_end() {
    let scratch = scratch();
    let begun = Instant::now();
    let message = Program::within(scratch.folder()).line("run /dev/zero").run().refused();
    assert!(message.contains("/dev/zero has more than 16 MiB"), "{message}");
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
}

#[test]
fn edits_that_cannot_be_made() {
    for (set, parts) in [
        ("stages[5].stop=Finished", &["--set stages[5].stop", "no \"5\"", "from 0 to 1"][..]),
        ("domian.size=(4, 4)", &["no \"domian\"", "did you mean \"domain\"?"]),
        ("stages[0].processes.Dnes.slab_m=1", &["no \"Dnes\"", "\"Dunes\"?"]),
        ("stages[0].processes.Dunes.slap_m=1", &["unknown field \"slap_m\"", "\"slab_m\"?"]),
        ("domain.size=(4", &["--set domain.size=(4", "not RON"]),
        ("domain.size=", &["no value after the equals sign"]),
        ("domain.size", &["write it as PATH=VALUE"]),
        ("=5", &["there is nothing to set"]),
        ("", &["write it as PATH=VALUE"]),
        ("seed=three", &["--set seed=three", "seed"]),
        ("domain.spacing_m=1e400", &["domain.spacing_m", "finite", "--set domain.spacing_m=1e400"]),
        ("stages=[()]", &["lacks the field \"processes\""]),
        ("title.a=5", &["title", "single value"]),
    ] {
        let scratch = scratch();
        let message = run(&scratch, &["--set", set]).refused();
        for part in parts {
            assert!(message.contains(part), "--set {set}: no `{part}` in\n{message}");
        }
        assert_eq!(scratch.names(), ["small.ron"], "{set}");
    }
}

#[test]
fn numbers_of_threads_and_memory_that_cannot_be() {
    let scratch = scratch();
    for (arguments, part) in [
        (["--threads", "0"], "--threads must be from 1 to 1024"),
        (["--threads", "5000"], "--threads must be from 1 to 1024"),
        (["--threads", "1.5"], "invalid value '1.5' for '--threads"),
        (["--memory-limit-gib", "0"], "--memory-limit-gib is 0"),
        (["--memory-limit-gib", "NaN"], "--memory-limit-gib is NaN"),
        (["--memory-limit-gib", "inf"], "--memory-limit-gib is inf"),
        (["--memory-limit-gib", "0.0001"], "1536 nodes need about"),
    ] {
        let message = run(&scratch, &arguments).refused();
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
    assert_eq!(scratch.names(), ["small.ron"]);
}

#[test]
fn sizes_beyond_the_memory_are_refused_before_it_is_taken() {
    for size in
        ["(100000, 100000)", "(4000000000, 1)", "(18446744073709551615, 18446744073709551615)"]
    {
        let scratch = scratch();
        let begun = Instant::now();
        let set = format!("domain.size={size}");
        // A little more than the estimate of a small run: taking more would be seen as a crash.
        let message = limited(&scratch, &set).refused();
        assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
        for part in ["nodes need about", "GiB", "small.ron:4:13", "--memory-limit-gib", "at most"] {
            assert!(message.contains(part), "{size}: no `{part}` in\n{message}");
        }
        assert_eq!(scratch.names(), ["small.ron"]);
    }
}

#[test]
fn a_check_takes_no_memory_for_sizes_that_a_run_could_not_have() {
    let scratch = scratch();
    let program = Program::within(scratch.folder()).args(["check", "small.ron"]);
    let shelter = "stages[0].processes.Dunes.shelter=Protection()";
    let program = program.args(["--set", "domain.size=(60000, 60000)", "--set", shelter]);
    let program =
        if cfg!(target_os = "linux") { program.below_memory_kib(1 << 20) } else { program };
    let message = program.run().refused();
    assert!(message.contains("3600000000 nodes need about"), "{message}");
}

/// Runs within 1 GiB of address space where the shell can limit it.
fn limited(scratch: &Scratch, set: &str) -> Ended {
    let program = Program::within(scratch.folder()).args([
        "run",
        "small.ron",
        "-o",
        "o",
        "--threads",
        "1",
        "--set",
        set,
    ]);
    if cfg!(target_os = "linux") { program.below_memory_kib(1 << 20).run() } else { program.run() }
}

#[test]
fn output_folders_that_cannot_be_made() {
    let scratch = scratch();
    scratch.write("file", "mine");
    let mut folders = vec!["file", "file/o"];
    if cfg!(target_os = "linux") {
        folders.extend(["/proc/o", "/dev/full", "/dev/full/o"]);
    }
    for folder in folders {
        let program = Program::within(scratch.folder()).args(["run", "small.ron", "-o", folder]);
        let message = program.run().refused();
        assert!(message.contains(&format!("the output folder {folder}")), "{folder}: {message}");
    }
    assert_eq!(fs::read(scratch.path("file")).unwrap(), b"mine");
    assert_eq!(scratch.names(), ["file", "small.ron"]);
}

#[test]
fn an_output_that_meets_a_folder_of_its_name_fails_and_says_so() {
    let scratch = scratch();
    fs::create_dir_all(scratch.path("o/map.png/inside")).unwrap();
    let ended = run(&scratch, &["--force"]);
    assert_eq!(ended.status, Some(1), "{ended:?}");
    assert!(ended.stderr.contains("map.png"), "{}", ended.stderr);
    assert!(scratch.path("o/report.json").is_file(), "what was done is reported");
    let left = fs::read_dir(scratch.path("o")).unwrap().map(|entry| entry.unwrap().file_name());
    let unfinished: Vec<_> = left.filter(|name| name.to_string_lossy().contains("tmp")).collect();
    assert!(unfinished.is_empty(), "{unfinished:?}");
}
