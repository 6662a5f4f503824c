//! Reading a scenario file and turning what is wrong with it into messages with a place.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ron::extensions::Extensions;

use super::Scenario;
use crate::parameters::Problem;
use crate::registry::{Registry, reading};
use crate::text::{Diagnostic, Located, Source, Tree, locate, ron_diagnostic, set};

/// The largest scenario file that is read: far above any that a person writes.
const LARGEST_FILE: u64 = 16 << 20;

/// The text of a scenario with the edits of the command line, and where it came from.
#[derive(Clone, Debug)]
pub struct ScenarioSource {
    source: Source,
    folder: PathBuf,
}

impl ScenarioSource {
    /// A scenario given as text; `name` is shown in messages, `folder` holds relative paths.
    pub fn from_text(name: &str, text: &str, folder: &Path) -> Self {
        Self { source: Source::new(name, text), folder: folder.to_owned() }
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// A message that says why the file cannot be read as text.
    pub fn open(path: &Path) -> Result<Self, String> {
        let shown = path.display();
        if path.is_dir() {
            return Err(format!("{shown} is a folder; name a scenario file (*.ron)"));
        }
        let mut bytes = Vec::new();
        // Pipes and devices do not tell their size.
        File::open(path)
            .and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes))
            .map_err(|error| format!("cannot read the scenario {shown}: {error}"))?;
        if bytes.len() as u64 > LARGEST_FILE {
            let mib = LARGEST_FILE >> 20;
            return Err(format!("{shown} has more than {mib} MiB: this is no scenario file"));
        }
        let text = String::from_utf8(bytes)
            .map_err(|_| format!("{shown} is not text in UTF-8: this is no scenario file"))?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(Self::from_text(&shown.to_string(), &text, &folder))
    }

    /// Replaces the value at `path` (`stages[0].processes.Dunes.slab_m`) by `value`, as RON.
    ///
    /// # Errors
    /// A message that names the path and what there is instead.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), String> {
        let edited = set(&self.source, path, value);
        self.source = edited.map_err(|diagnostic| diagnostic.render(&self.source))?;
        Ok(())
    }

    /// The text, with edits.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// Folder of the file, for relative paths.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Parses the scenario and checks everything that can be checked without reading other
    /// files or building the domain.
    ///
    /// # Errors
    /// Messages with file, line and column, what was expected and what to do.
    pub fn parse(&self, registry: &Arc<Registry>) -> Result<Scenario, String> {
        self.diagnose(registry).map_err(|diagnostics| {
            let texts = diagnostics.iter().map(|diagnostic| self.show(diagnostic));
            texts.collect::<Vec<_>>().join("\n")
        })
    }

    /// As [`ScenarioSource::parse`], with messages that other programs can take apart.
    ///
    /// # Errors
    /// All messages.
    pub fn diagnose(&self, registry: &Arc<Registry>) -> Result<Scenario, Vec<Diagnostic>> {
        let options = ron::Options::default().with_default_extension(
            Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES,
        );
        let scenario: Scenario = reading(registry, || options.from_str(self.source.text()))
            .map_err(|error| vec![ron_diagnostic(&self.source, &error)])?;
        let problems = scenario.problems();
        match problems.is_empty() {
            true => Ok(scenario),
            false => Err(problems.iter().map(|problem| self.diagnostic(problem)).collect()),
        }
    }

    /// A problem as a message that points at its parameter in the text.
    pub fn render(&self, problem: &Problem) -> String {
        self.show(&self.diagnostic(problem))
    }

    /// As [`ScenarioSource::render`], for other programs.
    pub fn diagnostic(&self, problem: &Problem) -> Diagnostic {
        let tree = Tree::parse(self.source.text());
        let message = match problem.parameter.as_str() {
            "" => problem.message.clone(),
            path => format!("{path}: {}", problem.message),
        };
        let mut diagnostic = Diagnostic::new(problem.code, message);
        diagnostic.span = nearest_place(&tree, &problem.parameter);
        diagnostic.expected = Some(problem.expected.clone()).filter(|text| !text.is_empty());
        diagnostic.help = Some(problem.help.clone()).filter(|text| !text.is_empty());
        diagnostic
    }

    /// A message about this scenario as text, with the line it is about.
    pub fn show(&self, diagnostic: &Diagnostic) -> String {
        diagnostic.render(&self.source)
    }

    /// A message about this scenario with its place in lines and columns.
    pub fn located(&self, diagnostic: &Diagnostic) -> Located {
        diagnostic.located(&self.source)
    }
}

/// Where the value at `path` stands; for a parameter that is not written, what it belongs to.
fn nearest_place(tree: &Tree, path: &str) -> Option<crate::text::Span> {
    let mut path = path;
    loop {
        if let Some(span) = locate(tree, path) {
            return Some(span);
        }
        let cut = path.rfind(['.', '['])?;
        path = &path[..cut];
    }
}
