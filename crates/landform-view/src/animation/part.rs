//! The file that an animation is in while frames are still to come.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A file that only grows, and of which a checkpoint can say how far it was.
///
/// Dropped before it was marked, it removes itself; what a checkpoint counts on stays.
#[derive(Debug)]
pub(super) struct Part {
    path: PathBuf,
    file: File,
    length: u64,
    checksum: crc32fast::Hasher,
    marked: bool,
}

/// How far the file of an animation was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PartMark {
    pub length: u64,
    pub checksum: u32,
}

impl Part {
    /// An empty file at `path`, in the place of what may be there.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        let file = File::create(path)?;
        let checksum = crc32fast::Hasher::new();
        Ok(Self { path: path.into(), file, length: 0, checksum, marked: false })
    }

    /// The file at `path` as it was at `mark`; what came after it is cut off.
    pub(super) fn reopen(path: &Path, mark: PartMark) -> io::Result<Self> {
        let mut file = OpenOptions::new().read(true).write(true).open(path)?;
        let mut checksum = crc32fast::Hasher::new();
        let mut bytes = vec![0; 1 << 16];
        let mut left = mark.length;
        while left > 0 {
            let block = &mut bytes[..left.min(1 << 16) as usize];
            file.read_exact(block)?;
            checksum.update(block);
            left -= block.len() as u64;
        }
        if checksum.clone().finalize() != mark.checksum {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "its frames have changed"));
        }
        file.set_len(mark.length)?;
        Ok(Self { path: path.into(), file, length: mark.length, checksum, marked: true })
    }

    /// Adds bytes at the end.
    pub(super) fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.length += bytes.len() as u64;
        self.checksum.update(bytes);
        Ok(())
    }

    /// Brings everything to the disk and says how far the file is. It stays from now on.
    pub(super) fn mark(&mut self) -> io::Result<PartMark> {
        self.file.sync_all()?;
        self.marked = true;
        Ok(PartMark { length: self.length, checksum: self.checksum.clone().finalize() })
    }

    /// Puts the finished file to `target`: these `changes` at their places, and `end` after
    /// everything. A marked part stays as it is for a run that goes on from the mark.
    pub(super) fn finish(
        mut self,
        target: &Path,
        changes: &[(u64, Vec<u8>)],
        end: &[u8],
    ) -> io::Result<()> {
        let mut whole = self.path.clone().into_os_string();
        whole.push(".whole");
        let whole = PathBuf::from(whole);
        if self.marked {
            fs::copy(&self.path, &whole)?;
        } else {
            fs::rename(&self.path, &whole)?;
            // There is nothing left to remove.
            self.marked = true;
        }
        let mut file = OpenOptions::new().write(true).open(&whole)?;
        for (place, bytes) in changes {
            file.seek(SeekFrom::Start(*place))?;
            file.write_all(bytes)?;
        }
        file.seek(SeekFrom::End(0))?;
        file.write_all(end)?;
        file.sync_all()?;
        fs::rename(&whole, target)
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.marked {
            // Nothing better can be done about a file that cannot be removed.
            let _ = fs::remove_file(&self.path);
        }
    }
}
