//! Every message of the program has a code, and every code a page whose example causes it.
//!
//! A block of a page that names a file (`ron,ignore,example.ron`) is written to it; the `sh`
//! block is then run in that folder, and its last command must end with the page's code.

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::explain::{page, title};
use landform::prelude::*;
use landform::sim::code::Code;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, RunError, Simulation};
use landform_tests::{Program, Scratch, blocks, files_below, repository};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What only a plugin can do wrong: these pages have no example that the program runs.
const BY_PLUGINS: [Code; 3] = [Code::Contradiction, Code::NotFinite, Code::Plugin];

#[test]
fn every_code_has_a_page_in_the_book_and_no_page_is_without_a_code() {
    let summary = fs::read_to_string(repository().join("docs/src/SUMMARY.md")).expect("a summary");
    let index = fs::read_to_string(repository().join("docs/src/errors.md")).expect("an index");
    for code in Code::ALL {
        let entry = format!("[{code}: {}](errors/{code}.md)", title(code));
        assert!(summary.contains(&entry), "SUMMARY.md lacks {entry}");
        let entry = format!("[{code}](errors/{code}.md) {}", title(code));
        assert!(index.contains(&entry), "errors.md lacks {entry}");
    }
    let pages = files_below("docs/src/errors", "md");
    assert_eq!(pages.len(), Code::ALL.len(), "each page belongs to a code: {pages:?}");
}

#[test]
fn the_program_explains_its_codes() {
    let scratch = Scratch::new("explain");
    let call = |line: &str| Program::within(scratch.folder()).line(line).run();
    let told = call("explain L0201").good();
    assert!(told.starts_with("L0201: out of range\n") && !told.contains("```"), "{told}");
    for line in page(Code::OutOfRange).lines().filter(|line| !line.starts_with(['#', '`'])) {
        assert!(told.contains(line), "no `{line}` in\n{told}");
    }
    assert_eq!([call("explain l0201").good(), call("explain 201").good()], [told.clone(), told]);
    let all = call("explain").good();
    assert_eq!(all.lines().count(), Code::ALL.len(), "{all}");
    let near = call("explain L0299").refused();
    assert!(near.starts_with("error[L0002]: ") && near.contains("L0201, L0202"), "{near}");
    assert!(call("explain dunes").refused().contains("`landform explain` lists all"));
    let clap = call("explain L0201 --loud").refused();
    assert!(clap.starts_with("error[L0001]: unexpected argument '--loud'"), "{clap}");
}

#[cfg(unix)]
#[test]
fn the_example_of_every_page_causes_its_error() {
    for code in Code::ALL {
        let blocks = blocks(page(code));
        let runs = |language: &str| language.starts_with("sh");
        assert_eq!(blocks.is_empty(), BY_PLUGINS.contains(&code), "{code}");
        let Some(script) = blocks.iter().find(|block| runs(&block.language)) else { continue };
        let scratch = Scratch::new("explained");
        for block in blocks.iter().filter(|block| !runs(&block.language)) {
            let file = block.language.rsplit(',').next().unwrap_or_default();
            assert!(file.contains('.'), "{code}: the block of line {} names no file", block.line);
            scratch.write(file, &block.text);
        }
        causes(code, &script.text, &scratch);
    }
}

/// Runs the commands in the folder; the last one must be refused, or fail, with the code.
#[cfg(unix)]
fn causes(code: Code, script: &str, scratch: &Scratch) {
    use landform_tests::{Ended, executable};
    use std::os::unix::fs::symlink;
    let programs = scratch.path("programs");
    fs::create_dir(&programs).expect("a folder");
    symlink(executable(), programs.join("landform")).expect("a link");
    symlink(repository().join("scenarios"), scratch.path("scenarios")).expect("a link");
    let others = std::env::var("PATH").unwrap_or_default();
    let mut shell = std::process::Command::new("sh");
    shell.args(["-ec", script]).current_dir(scratch.folder());
    shell.env("PATH", format!("{}:{others}", programs.display()));
    let ended = Ended::of(shell.output().expect("a shell"));
    let first = ended.stderr.split("error[").nth(1).unwrap_or_default();
    assert!(first.starts_with(&format!("{code}]: ")), "{code}: {ended:?}");
    assert!(matches!(ended.status, Some(1 | 2 | 130)), "{code}: {ended:?}");
}

/// A process that does what no process should.
#[derive(Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Broken {
    /// Whether its systems have no order.
    unordered: bool,
    /// Whether it divides by zero.
    divides: bool,
    /// Whether it calls its group like that of the forest fire.
    imitates: bool,
}

/// A group with the name of another one.
struct OtherTrees;

impl AgentGroup for OtherTrees {
    type State = f64;
    type Globals = ();
    const NAME: &'static str = "trees";
}

impl Process for Broken {
    const NAME: &'static str = "Broken";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Sand>();
        if self.imitates {
            uses.group::<OtherTrees>();
        }
    }
}

impl Plugin for Broken {
    fn build(&self, app: &mut App) {
        if self.divides {
            app.add_systems(Iterate, |mut sand: FieldMut<Sand>| sand.values_mut()[7] = 1.0 / 0.0);
        }
        if self.unordered {
            app.add_systems(Iterate, |mut sand: FieldMut<Sand>| sand.values_mut()[0] = 1.0);
            app.add_systems(Iterate, |mut sand: FieldMut<Sand>| sand.values_mut()[0] = 2.0);
        }
    }
}

/// The code of what goes wrong with these processes, while a run is built or while it goes on.
fn code_of(processes: &str) -> Option<Code> {
    let mut registry = landform::registry();
    registry.process::<Broken>();
    let text = format!(
        "(title: \"broken\", domain: Grid(size: (8, 8)),
          stages: [(processes: [{processes}], stop: Iterations(2))])"
    );
    let source = ScenarioSource::from_text("broken.ron", &text, Path::new(""));
    let scenario = source.parse(&Arc::new(registry)).expect("a scenario");
    let scratch = Scratch::new("broken");
    let mut simulation = match Simulation::new(scenario, Path::new(""), Limits::default()) {
        Ok(simulation) => simulation,
        Err(problem) => return Some(problem.code),
    };
    let mut go_on = |_: &Progress<'_>| ControlFlow::Continue(());
    let result = simulation.run(scratch.folder(), &mut go_on, &mut Report::default());
    result.err().map(|error: RunError| error.code())
}

#[test]
fn plugins_have_codes_of_their_own() {
    assert_eq!(code_of("Broken()"), None);
    assert_eq!(code_of("Broken(divides: true)"), Some(Code::NotFinite));
    assert_eq!(code_of("Broken(unordered: true)"), Some(Code::Plugin));
    assert_eq!(code_of("ForestFire(), Broken(imitates: true)"), Some(Code::Contradiction));
}
