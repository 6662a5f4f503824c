//! `landform analyze`: measures of rasters, lines and caves.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use landform_sim::code::Code;
use serde_json::{Value, json};

use super::arguments::AnalyzeArguments;
use super::{Failure, Outcome, coded, failed, folder, memory, refused, talk};
use crate::analyze::{Analysis, AnalyzeError, Settings, analyze};

/// Analyses every file of the arguments; one that is wrong does not stop the others.
pub(super) fn run(arguments: &AnalyzeArguments) -> Outcome {
    let memory_bytes =
        memory::limit(arguments.memory_limit_gib).map_err(refused(Code::Arguments))?;
    let settings = Settings {
        rulers: arguments.rulers,
        spacing_m: arguments.spacing_m,
        at_least: arguments.at_least,
        memory_bytes,
    };
    let mut results = Results::new(arguments)?;
    for path in &arguments.files {
        match analyze(path, &settings) {
            Ok(analysis) => results.take(path, &analysis)?,
            Err(error) => results.refuse(path, &error),
        }
    }
    results.end()
}

/// Where results go.
struct Results<'a> {
    arguments: &'a AnalyzeArguments,
    /// The output folder once it is made.
    folder: Option<PathBuf>,
    /// Names of files in the folder, without their endings.
    names: BTreeSet<String>,
    /// What `--json` prints.
    objects: Vec<Value>,
    /// Files that were refused, and why.
    wrong: Vec<String>,
}

impl<'a> Results<'a> {
    fn new(arguments: &'a AnalyzeArguments) -> Result<Self, Failure> {
        if let Some(asked) = &arguments.output {
            folder::check(asked, arguments.force)?;
        }
        let (names, objects, wrong) = (BTreeSet::new(), Vec::new(), Vec::new());
        Ok(Self { arguments, folder: None, names, objects, wrong })
    }

    /// Notes that a file was refused.
    fn refuse(&mut self, path: &Path, error: &AnalyzeError) {
        let (file, message) = (path.display().to_string(), error.to_string());
        self.objects.push(json!({ "file": file, "code": error.code(), "error": &message }));
        self.wrong.push(coded(error.code(), &message));
    }

    /// Prints and writes what was found out about a file.
    fn take(&mut self, path: &Path, analysis: &Analysis) -> Outcome {
        match self.arguments.json {
            true => self.objects.push(analysis.json()),
            false => talk::say(&analysis.table())?,
        }
        match &self.arguments.output {
            Some(asked) => self.write(asked, path, analysis),
            None => Ok(()),
        }
    }

    /// Writes the numbers and the figure of a file into the output folder.
    fn write(&mut self, asked: &Path, path: &Path, analysis: &Analysis) -> Outcome {
        let folder = match &self.folder {
            Some(folder) => folder.clone(),
            None => {
                let made = folder::make(Some(asked), "", self.arguments.force);
                self.folder.insert(made?).clone()
            }
        };
        let name = self.name(path);
        let place = |ending: &str| folder.join(format!("{name}.{ending}"));
        folder::write_json(&place("json"), &analysis.json()).map_err(failed(Code::Unwritable))?;
        match analysis.figure() {
            Err(error) => {
                let message = format!("{}: no figure: {error}", path.display());
                self.wrong.push(coded(Code::Picture, &message));
            }
            Ok(figure) => {
                let text = [("Title", figure.title.as_str()), ("Software", SOFTWARE)];
                for ending in ["png", "svg"] {
                    let written = figure.write(&place(ending), &text);
                    written.map_err(failed(Code::Unwritable))?;
                }
                if !self.arguments.json {
                    talk::say(&format!("  {:<12} {}\n", "figure", place("png").display()))?;
                }
            }
        }
        Ok(())
    }

    /// A name for a file's results that no other file has: its own without the ending, with a
    /// number where several files have the same.
    fn name(&mut self, path: &Path) -> String {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let numbered = (2_u32..).map(|number| format!("{stem}-{number}"));
        let mut names = std::iter::once(stem.clone()).chain(numbered);
        let name = names.find(|name| !self.names.contains(name)).unwrap_or(stem);
        self.names.insert(name.clone());
        name
    }

    /// Prints one file's object as it is and several in an array, and says what was refused.
    fn end(mut self) -> Outcome {
        let value = match self.objects.len() {
            _ if !self.arguments.json => None,
            1 => self.objects.pop().filter(|_| self.wrong.is_empty()),
            _ => Some(Value::Array(self.objects)),
        };
        if let Some(value) = value {
            talk::say(&(serde_json::to_string_pretty(&value).unwrap_or_default() + "\n"))?;
        }
        match self.wrong.is_empty() {
            true => Ok(()),
            false => Err(Failure::Refused(self.wrong.join("\n"))),
        }
    }
}

/// What made the figures.
const SOFTWARE: &str = concat!("landform ", env!("CARGO_PKG_VERSION"));
