//! What goes wrong with files, said so that the reader can repair it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Where in a file, or in a raster, a fault lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Somewhere, or everywhere.
    Whole,
    /// A line of a text file; the first is 1.
    Line(u64),
    /// A byte from the start of the file.
    Byte(u64),
    /// A cell: column and row from the north-west, the first is 0.
    Cell(usize, usize),
    /// A strip or tile of a TIFF file; the first is 0.
    Chunk(u32),
}

impl fmt::Display for Place {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Line(line) => write!(out, "line {line}: "),
            Self::Byte(byte) => write!(out, "byte {byte}: "),
            Self::Cell(column, row) => write!(out, "cell at column {column}, row {row}: "),
            Self::Chunk(chunk) => write!(out, "strip or tile {chunk}: "),
        }
    }
}

/// Why a file cannot be read or written. Every message names the file, what was found, what
/// was expected and what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IoError {
    /// The system refused to open, read, write or rename.
    #[error("cannot {doing} {}: {source}; {advice}", path.display())]
    System {
        /// File or folder.
        path: PathBuf,
        /// The operation, a verb: `read`, `write`.
        doing: &'static str,
        /// What the system said.
        source: io::Error,
        /// What to do about it.
        advice: &'static str,
    },
    /// The file does not hold what its format demands.
    #[error("{}: {fault}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        fault: Box<Fault>,
    },
    /// More cells than the caller allows.
    #[error(
        "{}: {size} is more than the limit of {limit} cells; check the header, cut out or \
         resample a smaller part, or raise the limit",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The size that the file claims, as columns x rows.
        size: String,
        /// The limit.
        limit: u64,
    },
    /// The output is there already.
    #[error("{} exists already; choose another name, or ask for it to be replaced", path.display())]
    Exists {
        /// The output.
        path: PathBuf,
    },
    /// The name does not say which format is meant.
    #[error("{}: no format is known for {}; expected one of {known}", path.display(), named(extension))]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// Its extension, lower case, without the dot; empty when there is none.
        extension: String,
        /// The extensions that work.
        known: &'static str,
    },
    /// The data in memory do not fit the format or one another.
    #[error("cannot write {}: {fault}", path.display())]
    Unwritable {
        /// The output.
        path: PathBuf,
        /// What is wrong, and where.
        fault: Box<Fault>,
    },
}

fn named(extension: &str) -> String {
    match extension {
        "" => "a name without extension".into(),
        other => format!("the extension .{other}"),
    }
}

/// One fault in the content of a file or of a raster.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{place}{problem}; expected {expected}; {advice}")]
pub struct Fault {
    /// Where.
    pub place: Place,
    /// What was found.
    pub problem: String,
    /// What belongs there.
    pub expected: String,
    /// What to do.
    pub advice: String,
}

impl Fault {
    /// A fault at no particular place.
    pub fn new(
        problem: impl Into<String>,
        expected: impl Into<String>,
        advice: impl Into<String>,
    ) -> Self {
        let (problem, expected, advice) = (problem.into(), expected.into(), advice.into());
        Self { place: Place::Whole, problem, expected, advice }
    }

    /// The same fault, at `place`.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.place = place;
        self
    }

    /// The fault as an error of reading `path`.
    pub fn reading(self, path: &Path) -> IoError {
        IoError::Content { path: path.into(), fault: Box::new(self) }
    }

    /// The fault as an error of writing `path`.
    pub fn writing(self, path: &Path) -> IoError {
        IoError::Unwritable { path: path.into(), fault: Box::new(self) }
    }
}

impl IoError {
    /// Its number in the book: `L0401` to `L0404` for what is read, `L1002`, `L1003` and `L1006`
    /// for what is written.
    pub fn code(&self) -> &'static str {
        match self {
            Self::System { doing: "write", .. } => "L1002",
            Self::System { .. } => "L0401",
            Self::Content { .. } => "L0402",
            Self::TooLarge { .. } => "L0403",
            Self::UnknownFormat { .. } => "L0404",
            Self::Exists { .. } => "L1003",
            Self::Unwritable { .. } => "L1006",
        }
    }

    /// A refusal by the system, with advice that fits its kind.
    pub fn system(path: &Path, doing: &'static str, source: io::Error) -> Self {
        let advice = match source.kind() {
            io::ErrorKind::NotFound => "check the spelling, and that the folder is there",
            io::ErrorKind::PermissionDenied => "check the rights on the file and its folder",
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                "free some space, or write elsewhere"
            }
            io::ErrorKind::IsADirectory => "name a file, not a folder",
            io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder",
            io::ErrorKind::UnexpectedEof => "the file ends too early: fetch or write it again",
            _ => "check the disk and the path",
        };
        Self::System { path: path.into(), doing, source, advice }
    }
}
