//! Output folders of runs: made once, never overwritten without being asked.

use std::fs;
use std::path::{Path, PathBuf};

use landform_io::{IfExists, write_atomically};
use landform_sim::code::Code;
use serde::Serialize;

use super::{Failure, refused};

/// File that shows whether a folder can be written; a process that is killed may leave it.
const PROBE: &str = ".landform-probe.tmp";

/// Makes the output folder of a run.
///
/// An existing folder is refused unless it is empty or `force` is given; without a name a new
/// folder below `out` is made.
pub(super) fn make(asked: Option<&Path>, stem: &str, force: bool) -> Result<PathBuf, Failure> {
    let folder = match asked {
        Some(folder) => folder.to_owned(),
        None => fresh(stem),
    };
    check(&folder, force)?;
    let shown = folder.display();
    fs::create_dir_all(&folder)
        .map_err(|error| format!("cannot make the output folder {shown}: {error}"))
        .map_err(refused(Code::Unwritable))?;
    let probe = folder.join(PROBE);
    fs::write(&probe, b"")
        .and_then(|()| fs::remove_file(&probe))
        .map_err(|error| format!("cannot write into the output folder {shown}: {error}"))
        .map_err(refused(Code::Unwritable))?;
    Ok(folder)
}

/// Refuses a file, and without `force` a folder that holds something.
pub(super) fn check(folder: &Path, force: bool) -> Result<(), Failure> {
    let shown = folder.display();
    if folder.is_file() {
        let message = format!("the output folder {shown} is a file; name another with -o");
        return Err(Failure::refused(Code::FolderInUse, message));
    }
    if !is_empty(folder) && !force {
        let message = format!(
            "the output folder {shown} exists and is not empty; name another with -o, or use \
             --force to replace files of the same names"
        );
        return Err(Failure::refused(Code::FolderInUse, message));
    }
    Ok(())
}

/// Whether nothing is seen in a folder, or there is none.
pub(super) fn is_empty(folder: &Path) -> bool {
    let mut entries = fs::read_dir(folder).into_iter().flatten();
    entries.all(|entry| entry.is_ok_and(|entry| entry.file_name() == PROBE))
}

/// The first of `out/STEM`, `out/STEM-2`, ... that does not exist.
pub(super) fn fresh(stem: &str) -> PathBuf {
    let first = Path::new("out").join(stem);
    if !first.exists() {
        return first;
    }
    (2_u32..)
        .map(|number| Path::new("out").join(format!("{stem}-{number}")))
        .find(|folder| !folder.exists())
        .unwrap_or(first)
}

/// Removes files that a process which was killed had begun to write beside their places, as far
/// as that is possible: `.NAME.PROCESS.NUMBER.tmp` and `NAME.PROCESS.part`.
pub(super) fn remove_leftovers(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        let parts: Vec<&str> = name.rsplit('.').collect();
        let is_number =
            |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        let is_leftover = match parts[..] {
            _ if name == PROBE => true,
            ["tmp", number, process, _, ..] => {
                name.starts_with('.') && is_number(number) && is_number(process)
            }
            ["part", process, _, ..] => is_number(process),
            _ => false,
        };
        match entry.file_type() {
            Ok(kind) if kind.is_dir() => remove_leftovers(&path),
            Ok(kind) if kind.is_file() && is_leftover => drop(fs::remove_file(&path)),
            _ => {}
        }
    }
}

/// Writes text into a file of the folder.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), String> {
    use std::io::Write;
    write_atomically(path, IfExists::Replace, |file| file.write_all(text.as_bytes()))
        .map_err(|error| error.to_string())
}

/// Writes a value as JSON into a file of the folder.
pub(crate) fn write_json(path: &Path, value: &impl Serialize) -> Result<(), String> {
    let text = serde_json::to_string_pretty(value).map_err(|error| error.to_string())?;
    write_text(path, &(text + "\n"))
}
