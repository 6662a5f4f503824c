//! Files that are either whole or not there: written beside, then renamed.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::IoError;

/// What to do when the output is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IfExists {
    /// Leave it as it is and say so.
    Refuse,
    /// Put the new file in its place, at once and only when complete.
    Replace,
}

/// Writes `path` so that no half-written file ever bears its name: `write` fills a temporary
/// file in the same folder, which is flushed to the disk and then renamed.
///
/// When `write` fails or panics the temporary file is removed; when the process is killed it
/// stays, as `.NAME.PROCESS.NUMBER.tmp`, and an earlier `path` is untouched.
///
/// # Errors
/// [`IoError::Exists`] with [`IfExists::Refuse`]; [`IoError::System`] when the folder is
/// missing, nothing may be written there, the disk is full, or `write` returns an error.
pub fn write_atomically(
    path: &Path,
    if_exists: IfExists,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), IoError> {
    let refused = |source| IoError::system(path, "write", source);
    check_target(path, if_exists)?;
    let (temporary, file) = Temporary::beside(path).map_err(refused)?;
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    write(&mut writer).and_then(|()| writer.flush()).map_err(refused)?;
    writer.get_ref().sync_all().map_err(refused)?;
    drop(writer);
    check_target(path, if_exists)?;
    temporary.rename(path).map_err(refused)
}

fn check_target(path: &Path, if_exists: IfExists) -> Result<(), IoError> {
    if path.is_dir() {
        let source = io::Error::from(io::ErrorKind::IsADirectory);
        return Err(IoError::system(path, "write", source));
    }
    if if_exists == IfExists::Refuse && path.symlink_metadata().is_ok() {
        return Err(IoError::Exists { path: path.into() });
    }
    Ok(())
}

/// A file that is removed unless it is renamed.
struct Temporary(PathBuf);

impl Temporary {
    fn beside(path: &Path) -> io::Result<(Self, File)> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let name = path.file_name().ok_or(io::ErrorKind::IsADirectory)?.to_string_lossy();
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let temporary = path.with_file_name(format!(".{name}.{}.{number}.tmp", process::id()));
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary)?;
        Ok((Self(temporary), file))
    }

    fn rename(mut self, path: &Path) -> io::Result<()> {
        fs::rename(&self.0, path)?;
        self.0.clear();
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.0.as_os_str().is_empty() {
            // Nothing more can be done here, and the first error is the one to report.
            let _ = fs::remove_file(&self.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scratch::Scratch;

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() {
        let folder = Scratch::new("atomic_failure");
        let path = folder.path("out.txt");
        fs::write(&path, "old").unwrap();
        let full = io::Error::from(io::ErrorKind::StorageFull);
        let error = write_atomically(&path, IfExists::Replace, |writer| {
            writer.write_all(b"half")?;
            Err(full)
        });
        let message = error.unwrap_err().to_string();
        assert!(message.contains("out.txt") && message.contains("free some space"), "{message}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(folder.file_count(), 1);
    }

    #[test]
    fn an_existing_file_is_replaced_only_when_asked() {
        let folder = Scratch::new("atomic_existing");
        let path = folder.path("out.txt");
        let write = |text: &'static str, if_exists| {
            write_atomically(&path, if_exists, |writer| writer.write_all(text.as_bytes()))
        };
        write("first", IfExists::Refuse).unwrap();
        let message = write("second", IfExists::Refuse).unwrap_err().to_string();
        assert!(message.contains("exists already"), "{message}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "first");
        write("second", IfExists::Replace).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "second");
        assert_eq!(folder.file_count(), 1);
    }

    #[test]
    fn missing_folders_and_folders_as_files_are_named() {
        let folder = Scratch::new("atomic_folders");
        let write = |path: &Path| {
            let result = write_atomically(path, IfExists::Replace, |_| Ok(()));
            result.unwrap_err().to_string()
        };
        let message = write(&folder.path("nowhere/out.txt"));
        assert!(message.contains("the folder is there"), "{message}");
        let message = write(&folder.path("."));
        assert!(message.contains("not a folder"), "{message}");
        fs::write(folder.path("file"), "").unwrap();
        let message = write(&folder.path("file/out.txt"));
        assert!(message.contains("is a file, not a folder"), "{message}");
    }
}
