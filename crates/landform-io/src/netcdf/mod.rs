//! Series of fields in one NetCDF file (`.nc`), written while a run goes on.
//!
//! The format is the classic one with 64-bit offsets (CDF-2): a header, the coordinates, and
//! records of one size each, one after the other. Every NetCDF library reads it, and a record is
//! added by writing it behind the others and then counting it in the header. A program that is
//! killed in between leaves a file with the records that were counted.
//!
//! Reference: The NetCDF Classic Format Specification, Unidata (NetCDF Users' Guide, appendix B).

mod header;
mod layout;
mod place;

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

pub use layout::{Attribute, Axis, Layout, Variable};
pub use place::axes;

use crate::{Fault, IfExists, IoError, write_atomically};
use header::Header;

/// Bytes of the number of records, which follows the four bytes that name the format.
const COUNT: std::ops::Range<usize> = 4..8;

/// Largest number of records: the count is a signed word.
const MOST_RECORDS: u64 = i32::MAX as u64;

/// A file with room for more records.
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    file: File,
    header: Header,
    records: u64,
}

impl SeriesWriter {
    /// Makes a file without records, in one step, and opens it for more.
    ///
    /// # Errors
    /// [`IoError`]: names that NetCDF does not know, fields that are too large for a record
    /// (4 GiB each), or an output that is there already or cannot be written.
    pub fn create(path: &Path, layout: &Layout, if_exists: IfExists) -> Result<Self, IoError> {
        let header = Header::new(layout).map_err(|fault| fault.writing(path))?;
        write_atomically(path, if_exists, |file| {
            file.write_all(&header.bytes)?;
            header::write_coordinates(layout, file)
        })?;
        let file = open(path)?;
        Ok(Self { path: path.to_owned(), file, header, records: 0 })
    }

    /// Opens a file that an interrupted run left, and removes its records from the first one
    /// on that lies beyond `last` on the axis of records.
    ///
    /// # Errors
    /// [`IoError`]: no such file, one with another layout, or one that is shorter than it says.
    pub fn reopen(path: &Path, layout: &Layout, last: f64) -> Result<Self, IoError> {
        let header = Header::new(layout).map_err(|fault| fault.writing(path))?;
        let mut writer = Self { path: path.to_owned(), file: open(path)?, header, records: 0 };
        let counted = writer.counted()?;
        let system = |error| IoError::system(path, "read", error);
        let mut value = [0; 8];
        while writer.records < counted {
            writer.file.seek(SeekFrom::Start(writer.end())).map_err(system)?;
            writer.file.read_exact(&mut value).map_err(system)?;
            if f64::from_be_bytes(value) > last {
                break;
            }
            writer.records += 1;
        }
        let system = |error| IoError::system(path, "write", error);
        writer.count().map_err(system)?;
        writer.file.set_len(writer.end()).map_err(system)?;
        Ok(writer)
    }

    /// Number of records.
    pub fn records(&self) -> u64 {
        self.records
    }

    /// Adds a record at `value` of the axis of records: a slice for each field of the layout,
    /// in node order. On an error the file keeps the records that it had.
    ///
    /// # Errors
    /// [`IoError`]: slices that do not fit the layout, too many records, or a disk that takes no
    /// more.
    pub fn append(&mut self, value: f64, fields: &[&[f64]]) -> Result<(), IoError> {
        let unfit = |problem: String, expected: String| {
            Err(Fault::new(problem, expected, "give what the layout says").writing(&self.path))
        };
        if fields.len() != self.header.fields {
            return unfit(format!("{} fields", fields.len()), self.header.fields.to_string());
        }
        let nodes = self.header.nodes;
        if let Some(field) = fields.iter().find(|field| field.len() != nodes) {
            return unfit(format!("a field of {} nodes", field.len()), nodes.to_string());
        }
        if self.records >= MOST_RECORDS {
            let expected = format!("at most {MOST_RECORDS}");
            let advice = "write fewer, or into several files";
            return Err(Fault::new("one more record", expected, advice).writing(&self.path));
        }
        self.write(value, fields).map_err(|error| IoError::system(&self.path, "write", error))
    }

    /// Writes a record and, once it is on the disk, counts it.
    fn write(&mut self, value: f64, fields: &[&[f64]]) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(self.end()))?;
        let mut writer = BufWriter::with_capacity(1 << 16, &self.file);
        writer.write_all(&value.to_be_bytes())?;
        for value in fields.iter().copied().flatten() {
            writer.write_all(&value.to_be_bytes())?;
        }
        writer.flush()?;
        drop(writer);
        self.file.sync_data()?;
        self.records += 1;
        self.count()
    }

    fn count(&mut self) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(COUNT.start as u64))?;
        self.file.write_all(&(self.records as u32).to_be_bytes())
    }

    /// The number of records by the header of the file, which must be that of the layout.
    fn counted(&mut self) -> Result<u64, IoError> {
        let system = |error| IoError::system(&self.path, "read", error);
        let mut found = vec![0; self.header.bytes.len()];
        let length = self.file.metadata().map_err(system)?.len();
        let whole = length >= self.header.start;
        if whole {
            self.file.read_exact(&mut found).map_err(system)?;
        }
        let mut count = [0; 4];
        count.copy_from_slice(&found[COUNT]);
        found[COUNT].fill(0);
        if !whole || found != self.header.bytes {
            let advice = "start the run anew, into another folder or with --force";
            let expected = "the file that the interrupted run wrote";
            return Err(Fault::new("another layout", expected, advice).reading(&self.path));
        }
        let count = u64::from(u32::from_be_bytes(count));
        if length < self.header.start + count * self.header.record_bytes {
            let problem = format!("{count} records do not fit into {length} bytes");
            let advice = "the file was cut short: start the run anew";
            return Err(Fault::new(problem, "a longer file", advice).reading(&self.path));
        }
        Ok(count)
    }

    /// Where the next record goes.
    fn end(&self) -> u64 {
        self.header.start + self.records * self.header.record_bytes
    }
}

fn open(path: &Path) -> Result<File, IoError> {
    let file = OpenOptions::new().read(true).write(true).open(path);
    file.map_err(|error| IoError::system(path, "open", error))
}

#[cfg(test)]
mod tests;
