//! Where outputs may write.

use std::path::{Component, Path, PathBuf};

use crate::checkpoint;
use crate::code::Code;
use crate::parameters::Problem;

/// What every run leaves under these names.
const TAKEN: [&str; 3] = ["series.csv", "report.json", "scenario.ron"];

/// Refuses names of files that lead out of the output folder, that every run writes itself, or
/// that do not end in one of `extensions`, which are in lower case.
///
/// # Errors
/// The [`Problem`] is one of the parameter `file`.
pub fn check_file(file: &Path, extensions: &[&str]) -> Result<(), Problem> {
    let refuse = |why: &str, expected: &str| {
        let message = format!("`{}` {why}", file.display());
        Err(Problem::new("file", message, expected).code(Code::OutputFile))
    };
    let mut parts = file.components();
    if file.file_name().is_none() || !parts.all(|part| matches!(part, Component::Normal(_))) {
        return refuse("leads out of the output folder", "a name below the output folder");
    }
    if file.starts_with("fields") {
        return refuse("lies in the folder of the final fields", "a name outside `fields`");
    }
    if file.starts_with(checkpoint::FOLDER) {
        return refuse("lies in the folder of the checkpoint", "a name outside `checkpoint`");
    }
    if TAKEN.iter().any(|taken| file == Path::new(taken)) {
        return refuse("is what every run leaves itself", "another name");
    }
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extensions.contains(&extension.as_str()) {
        true => Ok(()),
        false => {
            let expected = format!("one that ends in .{}", extensions.join(", ."));
            refuse("ends in no format that is known here", &expected)
        }
    }
}

/// The path of an output below its folder, whose parent folders are made.
///
/// # Errors
/// The [`Problem`] is one of the parameter `file`.
pub fn below(folder: &Path, file: &Path) -> Result<PathBuf, Problem> {
    let path = folder.join(file);
    if let Some(parent) = path.parent() {
        std::fs::create_dir_all(parent).map_err(|error| {
            let message = format!("cannot make {}: {error}", parent.display());
            Problem::new("file", message, "").code(Code::Unwritable)
        })?;
    }
    Ok(path)
}
