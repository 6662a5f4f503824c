//! The command line.

mod analyze;
mod arguments;
mod check;
mod checkpoint_file;
mod collect;
mod describe;
mod explain;
mod export;
mod failure;
mod folder;
mod interrupt;
mod list;
mod memory;
mod progress_bar;
mod reproduce;
mod resume;
mod run;
mod sweep;
mod talk;
mod view;

use std::process::ExitCode;
use std::sync::Arc;

use clap::{CommandFactory, Parser};
use landform_sim::registry::Registry;

use arguments::{Arguments, Command};
pub(crate) use failure::{Failure, coded, failed, refused};
pub(crate) use folder::{write_json, write_text};

/// What a command returns.
pub(crate) type Outcome = Result<(), Failure>;

/// The program `landform`, to which other programs add their own processes.
pub struct Program {
    registry: Registry,
}

impl Default for Program {
    fn default() -> Self {
        Self::new()
    }
}

impl Program {
    /// The program with everything that is built in.
    pub fn new() -> Self {
        Self { registry: crate::registry() }
    }

    /// Adds to what scenarios may name.
    #[must_use]
    pub fn register(mut self, add: impl FnOnce(&mut Registry)) -> Self {
        add(&mut self.registry);
        self
    }

    /// Does what the command line says. Exit status: 0 done, 1 the run failed, 2 the input was
    /// refused, 130 interrupted.
    pub fn run(self) -> ExitCode {
        let arguments = match Arguments::try_parse() {
            Ok(arguments) => arguments,
            Err(error) => return talk::end(&error),
        };
        let registry = Arc::new(self.registry);
        match done(arguments.command, &registry) {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => {
                talk::complain(failure.message());
                ExitCode::from(failure.status())
            }
        }
    }
}

/// Does what a command asks.
fn done(command: Command, registry: &Arc<Registry>) -> Outcome {
    match command {
        Command::Run(arguments) => run::run(&arguments, registry),
        Command::Check(arguments) => check::check(&arguments, registry),
        Command::List { kind } => list::list(kind, registry),
        Command::Describe { name, json } => describe::describe(&name, json, registry),
        Command::Explain { code } => explain::explain(code.as_deref()),
        Command::Schema => schema(registry),
        Command::Export(arguments) => export::export(&arguments),
        Command::View(arguments) => view::view(&arguments),
        Command::Analyze(arguments) => analyze::run(&arguments),
        Command::Reproduce(arguments) => reproduce::reproduce(&arguments, registry),
        Command::Sweep(arguments) => sweep::sweep(&arguments, registry),
        Command::Collect { folder } => collect::collect(&folder),
        Command::Completions { shell } => {
            let mut command = Arguments::command();
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command, "landform", &mut script);
            talk::say(&String::from_utf8_lossy(&script))
        }
    }
}

/// `landform schema`: the JSON schema of whole scenarios.
fn schema(registry: &Registry) -> Outcome {
    let schema = landform_sim::scenario::scenario_schema(registry);
    talk::say(&(serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"))
}
