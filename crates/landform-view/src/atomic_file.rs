//! Files that appear whole or not at all.

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use crate::ViewError;

/// A file that is written beside its target and renamed at the end. Dropped unfinished, it
/// takes its temporary file with it, so a failure never leaves half a picture.
#[derive(Debug)]
pub(crate) struct AtomicFile {
    target: PathBuf,
    temporary: PathBuf,
    finished: bool,
}

impl AtomicFile {
    /// Opens the temporary file of `target`.
    pub(crate) fn create(target: &Path) -> Result<(Self, BufWriter<File>), ViewError> {
        let mut name = target.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.part", std::process::id()));
        let temporary = target.with_file_name(name);
        let file = File::create(&temporary).map_err(|source| write_error(target, source))?;
        let guard = Self { target: target.into(), temporary, finished: false };
        Ok((guard, BufWriter::new(file)))
    }

    /// Puts the file, which must be flushed, in its place.
    pub(crate) fn finish(mut self) -> Result<(), ViewError> {
        fs::rename(&self.temporary, &self.target)
            .map_err(|source| write_error(&self.target, source))?;
        self.finished = true;
        Ok(())
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if !self.finished {
            // Nothing better can be done about a temporary file that cannot be removed.
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

/// The error for a file that cannot be written.
pub(crate) fn write_error(path: &Path, source: std::io::Error) -> ViewError {
    ViewError::File { action: "write", path: path.into(), source }
}
