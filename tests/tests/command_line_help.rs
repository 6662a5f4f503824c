//! What the program tells about itself: lists, descriptions, help, completions; and what it does
//! when nobody listens.

use std::collections::BTreeMap;

use landform_tests::{Program, SMALL, Scratch};
use serde_json::Value;

fn told(line: &str) -> String {
    Program::within(&std::env::temp_dir()).line(line).run().good()
}

/// The registered names of each kind, as `landform list` calls it.
fn names() -> BTreeMap<&'static str, Vec<&'static str>> {
    let registry = landform::registry();
    BTreeMap::from([
        ("domains", registry.domains.names()),
        ("initial", registry.initial.names()),
        ("processes", registry.processes.names()),
        ("metrics", registry.metrics.names()),
        ("outputs", registry.outputs.names()),
    ])
}

/// The first word of each line that is set in.
fn listed(text: &str) -> Vec<&str> {
    let lines = text.lines().filter(|line| line.starts_with("  "));
    lines.filter_map(|line| line.split_whitespace().next()).collect()
}

#[test]
fn the_list_has_every_registered_name_with_its_first_sentence() {
    let all = told("list");
    let sections = ["domains", "initial", "processes", "metrics", "outputs"];
    let names = names();
    let expected: Vec<_> = sections.iter().flat_map(|kind| names[kind].clone()).collect();
    assert!(expected.contains(&"Dunes") && expected.contains(&"Grid"));
    assert_eq!(listed(&all), expected);
    for line in all.lines().filter(|line| line.starts_with("  ")) {
        assert!(line.split_whitespace().count() > 2, "no description: {line}");
    }
    for (kind, names) in names {
        assert_eq!(listed(&told(&format!("list {kind}"))), names, "{kind}");
    }
}

#[test]
fn every_name_has_a_page_and_a_schema_with_all_its_parameters() {
    for name in names().into_values().flatten() {
        let page = told(&format!("describe {name}"));
        assert!(page.starts_with(&format!("{name} (")), "{page}");
        let schema: Value =
            serde_json::from_str(&told(&format!("describe {name} --json"))).expect("JSON");
        for (parameter, about) in schema["properties"].as_object().into_iter().flatten() {
            assert!(page.contains(&format!("\n  {parameter}: ")), "{parameter} in {page}");
            assert!(about["description"].is_string(), "{name}.{parameter} is not described");
        }
    }
    let page = told("describe Dunes");
    for part in ["in degrees", "at least 0.1, at most 89", "default 33", "source: thesis"] {
        assert!(page.contains(part), "{part} in {page}");
    }
}

#[test]
fn the_schema_of_scenarios_is_closed_and_has_every_name() {
    let schema: Value = serde_json::from_str(&told("schema")).expect("JSON");
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["additionalProperties"], false);
    let kinds = ["domain", "initial", "process", "metric", "output"];
    let names = names();
    let registered = ["domains", "initial", "processes", "metrics", "outputs"].map(|k| &names[k]);
    for (kind, registered) in kinds.iter().zip(registered) {
        let alternatives = schema["$defs"][kind]["oneOf"].as_array().expect("alternatives");
        let found: Vec<&str> = alternatives
            .iter()
            .filter_map(|each| {
                each["required"][0].as_str().filter(|_| each["additionalProperties"] == false)
            })
            .collect();
        assert_eq!(&found, registered, "{kind}");
    }
    // A parameter has there what its definition says.
    let dunes = schema["$defs"]["process"]["oneOf"].as_array().into_iter().flatten();
    let dunes = dunes.map(|each| &each["properties"]["Dunes"]).find(|each| each.is_object());
    let repose = &dunes.expect("dunes")["properties"]["repose_deg"];
    assert_eq!(
        (&repose["maximum"], &repose["x-unit"]),
        (&Value::from(89.0), &Value::from("degrees"))
    );
    assert_references(&schema, &schema);
}

/// Checks that every reference of a schema leads somewhere.
fn assert_references(whole: &Value, part: &Value) {
    match part {
        Value::Object(keys) => {
            if let Some(target) = keys.get("$ref").and_then(Value::as_str) {
                let pointer = target.strip_prefix('#').expect("within the document");
                assert!(whole.pointer(pointer).is_some(), "{target}");
            }
            keys.values().for_each(|value| assert_references(whole, value));
        }
        Value::Array(items) => items.iter().for_each(|item| assert_references(whole, item)),
        _ => {}
    }
}

#[test]
fn what_is_wrong_with_a_scenario_can_be_read_by_an_editor() {
    let scratch = Scratch::new("editor");
    scratch.write("good.ron", SMALL);
    scratch.write("bad.ron", SMALL.replace("slab_m", "slap_m"));
    let call = |line: &str| Program::within(scratch.folder()).line(line).run();
    assert_eq!(call("check --json good.ron").good(), "[]\n");
    let ended = call("check --json good.ron bad.ron none.ron");
    assert_eq!(ended.status, Some(2), "{ended:?}");
    let list: Value = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(list.as_array().map(Vec::len), Some(2), "{list}");
    let bad = &list[0];
    let line = SMALL.lines().position(|line| line.contains("slab_m")).expect("a line");
    let column = SMALL.lines().nth(line).and_then(|line| line.find("slab_m")).expect("a column");
    assert_eq!((&bad["file"], &bad["code"]), (&"bad.ron".into(), &"L0102".into()));
    assert_eq!(bad["start"], serde_json::json!([line + 1, column + 1]));
    assert_eq!(bad["end"], serde_json::json!([line + 1, column + 7]));
    assert_eq!(bad["help"], "did you mean \"slab_m\"?");
    assert_eq!((&list[1]["file"], &list[1]["start"]), (&Value::from("none.ron"), &Value::Null));
    assert_eq!(list[1]["code"], "L0107");
}

#[test]
fn help_has_examples_and_every_command_is_explained() {
    let help = told("--help");
    assert!(help.contains("Examples:\n  landform run scenarios/"), "{help}");
    let commands = help.split("Commands:").nth(1).and_then(|rest| rest.split("\n\n").next());
    let commands = listed(commands.expect("a list of commands"));
    let expected = [
        "run", "check", "list", "describe", "explain", "schema", "export", "view", "analyze",
        "sweep",
    ];
    for command in expected {
        assert!(commands.contains(&command), "{command} in {commands:?}");
    }
    for command in commands.iter().filter(|&&command| command != "help") {
        let help = told(&format!("{command} --help"));
        assert!(help.contains("Usage: landform") || help.contains("Usage:"), "{help}");
        assert!(help.lines().next().is_some_and(|line| line.len() > 15), "{help}");
    }
    assert_eq!(told("--version"), concat!("landform ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn every_shell_gets_completions() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = told(&format!("completions {shell}"));
        assert!(script.contains("landform") && script.contains("describe"), "{shell}: {script}");
    }
}

#[test]
fn wrong_calls_exit_with_2_and_say_what_there_is() {
    for (line, parts) in [
        ("", &["Usage"][..]),
        ("rum", &["unrecognized subcommand 'rum'", "run"]),
        ("list proceses", &["invalid value 'proceses'", "processes"]),
        ("describe Dnes", &["nothing is called `Dnes`", "did you mean \"Dunes\"?"]),
        ("describe Qqqqqqqqqqqqqqqq", &["`landform list` shows what there is"]),
        ("run", &["<SCENARIO>"]),
        ("check", &["<SCENARIOS>"]),
        ("run s.ron --threads two", &["invalid value 'two' for '--threads"]),
        ("run s.ron --seed 99999999999999999999", &["'--seed <SEED>': number too large"]),
        ("completions tcsh", &["invalid value 'tcsh'", "bash"]),
    ] {
        let ended = Program::within(&std::env::temp_dir()).line(line).run();
        assert_eq!((ended.status, ended.stdout.as_str()), (Some(2), ""), "{line}: {ended:?}");
        for part in parts {
            assert!(ended.stderr.contains(part), "{line}: {part} in {}", ended.stderr);
        }
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let scratch = Scratch::new("pipe");
    scratch.write("small.ron", SMALL);
    for line in ["list", "describe Dunes", "completions zsh", "run small.ron", "check small.ron"] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut program = Program::within(scratch.folder()).line(line);
        program.command().stdout(writer).stderr(std::process::Stdio::piped());
        let ended = program.end();
        assert_eq!((ended.status, ended.stderr.as_str()), (Some(0), ""), "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_reported_and_never_a_panic() {
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a device");
    let mut program = Program::within(&std::env::temp_dir()).line("list");
    program.command().stdout(full()).stderr(std::process::Stdio::piped());
    let ended = program.end();
    assert_eq!(ended.status, Some(1), "{ended:?}");
    assert!(ended.stderr.contains("cannot write to standard output"), "{}", ended.stderr);

    let mut program = Program::within(&std::env::temp_dir()).line("describe Dnes");
    program.command().stdout(std::process::Stdio::piped()).stderr(full());
    assert_eq!(program.end().status, Some(2), "the status tells what the device cannot");
}
