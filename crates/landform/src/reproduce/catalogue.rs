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
    /// Name of its file without the ending: `fig_5_9`.
    pub name: String,
    /// Folder of the file, which its scenarios are relative to.
    pub base: PathBuf,
    /// What the file says.
    pub figure: Figure,
    /// The texts of the file and of its scenarios: all that its numbers follow from but data.
    pub text: String,
}

impl Entry {
    /// Reads a target file, to be run with so many `seeds` instead of its own, and checks it with its
    /// scenarios.
    ///
    /// # Errors
    /// A message that says where the file is wrong and what was expected.
    pub fn read(
        path: &Path,
        seeds: Option<u64>,
        registry: &Arc<Registry>,
        limits: Limits,
    ) -> Result<Self, String> {
        let mut text = read(path)?;
        let mut figure = parse(path, &text)?;
        figure.seeds = seeds.unwrap_or(figure.seeds);
        let base = path.parent().unwrap_or(Path::new("")).to_owned();
        check(&figure, &base, registry, limits)
            .map_err(|why| format!("{}: {}", path.display(), why.trim_start_matches("error: ")))?;
        for run in &figure.runs {
            text += &read(&base.join(&run.scenario))?;
        }
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let name = file.strip_suffix(ENDING).unwrap_or(&file).to_owned();
        Ok(Self { name, base, figure, text })
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

/// The target file of a figure: a path, the name of a file in `folder`, or that of one beside it with
/// its folder: `dendry/table_1`.
///
/// # Errors
/// A message that names the first two.
pub fn find(name: &str, folder: &Path) -> Result<PathBuf, String> {
    let file = format!("{name}{ENDING}");
    let named = folder.join(&file);
    let beside = folder.parent().unwrap_or(Path::new("")).join(file);
    let candidates = [PathBuf::from(name), named.clone(), beside];
    candidates
        .into_iter()
        .find(|path| path.is_file())
        .ok_or_else(|| format!("there is no target file {name}, nor {}", named.display()))
}

/// All target files of a folder, or those of a chapter (`4`, `B`), in the order of the thesis.
///
/// # Errors
/// A message when the folder cannot be read or has none of these.
pub fn all(folder: &Path, chapter: Option<&str>) -> Result<Vec<PathBuf>, String> {
    let shown = folder.display();
    let entries = std::fs::read_dir(folder).map_err(|error| {
        format!("cannot read {shown}: {error}; run this where the folder of scenarios lies")
    })?;
    let mut files: Vec<(Vec<Part>, PathBuf)> = Vec::new();
    for entry in entries.flatten() {
        let file = entry.file_name().to_string_lossy().into_owned();
        if let Some(name) = file.strip_suffix(ENDING) {
            let place = place(name);
            let is_asked = chapter.is_none_or(|chapter| place.first() == part(chapter).as_ref());
            if is_asked {
                files.push((place, entry.path()));
            }
        }
    }
    files.sort();
    match (files.is_empty(), chapter) {
        (false, _) => Ok(files.into_iter().map(|(_, path)| path).collect()),
        (true, Some(chapter)) => Err(format!("{shown} has no target files of chapter {chapter}")),
        (true, None) => Err(format!("{shown} has no target files (NAME{ENDING})")),
    }
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
