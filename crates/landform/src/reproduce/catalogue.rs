//! The target files that there are, and those that are asked for.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;
use landform_sim::text::{Source, ron_diagnostic};

use super::{Figure, check};

/// What target files end with.
const ENDING: &str = ".targets.ron";

/// A figure with where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name of its file without the ending, with the folder of another source: `fig_5_9`,
    /// `dendry/table_1`.
    pub name: String,
    /// What it is part of: `Chapter 5`, `Appendix B`, or another source.
    pub part: String,
    /// Folder of the file, which its scenarios are relative to.
    pub base: PathBuf,
    /// What the file says.
    pub figure: Figure,
    /// Its scenarios, each once, in the order of the runs.
    pub scenarios: Vec<ScenarioText>,
    /// The texts of the file and of its scenarios: all that its numbers follow from but data.
    pub text: String,
}

/// A scenario of a figure, for its readers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioText {
    /// Its file, relative to the target file.
    pub path: PathBuf,
    /// What it says of itself.
    pub description: String,
    /// All of the file.
    pub text: String,
}

impl Entry {
    /// Reads a target file, to be run with so many `seeds` instead of its own, and checks it with its
    /// scenarios. Figures of the thesis lie in the folder `thesis`, those of other sources in folders
    /// beside it.
    ///
    /// # Errors
    /// A message that says where the file is wrong and what was expected.
    pub fn read(
        path: &Path,
        thesis: &Path,
        seeds: Option<u64>,
        registry: &Arc<Registry>,
        limits: Limits,
    ) -> Result<Self, String> {
        let mut text = read(path)?;
        let mut figure = parse(path, &text)?;
        figure.seeds = seeds.unwrap_or(figure.seeds);
        let base = path.parent().unwrap_or(Path::new("")).to_owned();
        let descriptions = check(&figure, &base, registry, limits)
            .map_err(|why| format!("{}: {why}", path.display()))?;
        let mut scenarios: Vec<ScenarioText> = Vec::new();
        for (run, description) in figure.runs.iter().zip(descriptions) {
            let scenario = read(&base.join(&run.scenario))?;
            text += &scenario;
            if scenarios.iter().all(|other| other.path != run.scenario) {
                let path = run.scenario.clone();
                scenarios.push(ScenarioText { path, description, text: scenario });
            }
        }
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let file = file.strip_suffix(ENDING).unwrap_or(&file).to_owned();
        let (name, part) = match folder_beside(thesis, &base) {
            Some(folder) => (format!("{folder}/{file}"), folder),
            None if base == thesis => (file.clone(), chapter_of(&file)),
            None => (file, base.display().to_string()),
        };
        Ok(Self { name, part, base, figure, scenarios, text })
    }
}

/// The name of `folder` if it lies beside that of the thesis.
fn folder_beside(thesis: &Path, folder: &Path) -> Option<String> {
    let is_beside = folder != thesis && folder.parent() == thesis.parent();
    folder.file_name().filter(|_| is_beside).map(|name| name.to_string_lossy().into_owned())
}

/// The chapter or the appendix that a target file of the thesis belongs to.
fn chapter_of(name: &str) -> String {
    match place(name).first() {
        Some(Part::Number(number)) => format!("Chapter {number}"),
        Some(Part::Word(word)) => format!("Appendix {}", word.to_uppercase()),
        None => "Thesis".to_owned(),
    }
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn parse(path: &Path, text: &str) -> Result<Figure, String> {
    let source = Source::new(path.display().to_string(), text.to_owned());
    let options = ron::Options::default()
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
        .with_default_extension(ron::extensions::Extensions::UNWRAP_VARIANT_NEWTYPES);
    options.from_str(source.text()).map_err(|error| ron_diagnostic(&source, &error).render(&source))
}

/// The target files that a name stands for: a path, the name of a file in `folder`, that of one beside
/// it with its folder, `dendry/table_1`, or a folder beside it: `physics`.
///
/// # Errors
/// A message that names the first two.
pub fn find(name: &str, folder: &Path) -> Result<Vec<PathBuf>, String> {
    let file = format!("{name}{ENDING}");
    let named = folder.join(&file);
    let scenarios = folder.parent().unwrap_or(Path::new(""));
    let candidates = [PathBuf::from(name), named.clone(), scenarios.join(file)];
    if let Some(file) = candidates.into_iter().find(|path| path.is_file()) {
        return Ok(vec![file]);
    }
    let whole = scenarios.join(name);
    let files =
        if !name.is_empty() && whole.is_dir() { of_folder(&whole, None)? } else { Vec::new() };
    match files.is_empty() {
        true => Err(format!("there is no target file {name}, nor {}", named.display())),
        false => Ok(files),
    }
}

/// The target files of a chapter of the thesis (`4`, `B`), or all: those of the thesis in its order,
/// then those of the folders beside `thesis`.
///
/// # Errors
/// A message when a folder cannot be read or there are no such files.
pub fn all(thesis: &Path, chapter: Option<&str>) -> Result<Vec<PathBuf>, String> {
    let shown = thesis.display();
    let mut files = of_folder(thesis, chapter)?;
    match (files.is_empty(), chapter) {
        (true, Some(chapter)) => Err(format!("{shown} has no target files of chapter {chapter}")),
        (true, None) => Err(format!("{shown} has no target files (NAME{ENDING})")),
        (false, Some(_)) => Ok(files),
        (false, None) => {
            let beside = thesis.parent().unwrap_or(Path::new(""));
            let mut folders: Vec<PathBuf> = list(beside)?;
            folders.retain(|path| path.is_dir() && path != thesis);
            folders.sort();
            for folder in folders {
                files.extend(of_folder(&folder, None)?);
            }
            Ok(files)
        }
    }
}

/// The target files of a folder, or those of a chapter, by the numbers in their names.
fn of_folder(folder: &Path, chapter: Option<&str>) -> Result<Vec<PathBuf>, String> {
    let mut files: Vec<(Vec<Part>, PathBuf)> = Vec::new();
    for path in list(folder)? {
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        if let Some(name) = file.strip_suffix(ENDING) {
            let place = place(name);
            let is_asked = chapter.is_none_or(|chapter| place.first() == part(chapter).as_ref());
            if is_asked {
                files.push((place, path.clone()));
            }
        }
    }
    files.sort();
    Ok(files.into_iter().map(|(_, path)| path).collect())
}

/// What lies in a folder, in no order.
fn list(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| {
        let folder = folder.display();
        format!("cannot read {folder}: {error}; run this where the folder of scenarios lies")
    })?;
    Ok(entries.flatten().map(|entry| entry.path()).collect())
}

/// A part of the number of a figure: numbers before letters, as chapters before appendices.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Number(u64),
    Word(String),
}

fn part(text: &str) -> Option<Part> {
    match text.parse() {
        _ if text.is_empty() => None,
        Ok(number) => Some(Part::Number(number)),
        Err(_) => Some(Part::Word(text.to_lowercase())),
    }
}

/// Where `fig_5_10` and `table_4_1` stand: chapter, number, figures before tables, and the rest.
fn place(name: &str) -> Vec<Part> {
    let (kind, number) = name.split_once('_').unwrap_or(("", name));
    let mut parts: Vec<&str> = number.split('_').collect();
    parts.insert(parts.len().min(2), kind);
    parts.into_iter().filter_map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_stand_in_the_order_of_the_thesis() {
        let mut names = ["fig_b_4", "fig_5_10", "table_4_1", "fig_5_9", "fig_4_1_b", "fig_4_1"];
        names.sort_by_key(|name| place(name));
        let sorted = ["fig_4_1", "fig_4_1_b", "table_4_1", "fig_5_9", "fig_5_10", "fig_b_4"];
        assert_eq!(names, sorted);
        assert_eq!(place("fig_b_4")[0], part("B").unwrap());
        assert_ne!(place("fig_5_9")[0], part("4").unwrap());
    }
}
