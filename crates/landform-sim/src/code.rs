//! Numbers of what can go wrong.
//!
//! Everything that is refused and every run that fails carries a [`Code`], which messages show
//! as `error[L0201]`. Each has a page in the book (`docs/src/errors/L0201.md`), which the program
//! prints as well. A code never changes its meaning, and one that is given up is not used again.

use std::fmt;

use serde::{Serialize, Serializer};

/// What is wrong, as a number that stays the same from version to version.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u16)]
pub enum Code {
    /// The command line asks for what the program does not know, or with a value it cannot use.
    Arguments = 1,
    /// A name on the command line that nothing has.
    UnknownSubject = 2,
    /// The text does not follow the notation.
    Notation = 101,
    /// A name that nobody registered, or a field that a struct does not have.
    UnknownName = 102,
    /// A field without a default is not written.
    MissingField = 103,
    /// A field is written twice.
    RepeatedField = 104,
    /// A value of another type than the field's.
    WrongType = 105,
    /// A change of the command line that finds no place in the scenario.
    Edit = 106,
    /// The scenario cannot be read as text.
    UnreadableScenario = 107,
    /// A number outside its range, one that is not finite, or a list that is too short.
    OutOfRange = 201,
    /// A value that does not suit the others, or the lattice.
    #[default]
    Unsuitable = 202,
    /// A stage without a process, or with one twice.
    Stage = 203,
    /// A stop rule or a moment that never comes.
    Never = 204,
    /// More nodes than fit into the memory.
    Memory = 301,
    /// A field, group, quantity or stage that the run does not have.
    NotInRun = 302,
    /// A field that a process reads and nothing provides.
    NotProvided = 303,
    /// Plugins that define one name differently.
    Contradiction = 304,
    /// Values that a field cannot start with.
    InitialValues = 305,
    /// A file that cannot be read.
    UnreadableFile = 401,
    /// A file that does not hold what its format demands.
    DamagedFile = 402,
    /// A file with more cells than the limit.
    LargeFile = 403,
    /// A file whose format is not known by its name.
    UnknownFormat = 404,
    /// A raster whose cells have no size in metres.
    NoSpacing = 405,
    /// A raster with cells without data.
    Gaps = 406,
    /// A raster of another size than the domain.
    OtherSize = 407,
    /// A folder that holds no run, or not the field that is asked for.
    NoRun = 408,
    /// Nothing to go on with.
    NoCheckpoint = 501,
    /// A run of another scenario.
    OtherScenario = 502,
    /// A checkpoint that cannot be used.
    DamagedCheckpoint = 503,
    /// A folder in which another process is at work.
    Busy = 504,
    /// A value that became infinite or NaN.
    NotFinite = 601,
    /// A budget that did not close.
    Budget = 602,
    /// A process that could not go on.
    Fault = 603,
    /// A plugin whose systems cannot run.
    Plugin = 604,
    /// A metric or an output that failed in a run.
    Recording = 605,
    /// The user interrupted.
    Interrupted = 606,
    /// Rulers that do not suit the lines.
    Rulers = 701,
    /// A sweep that makes no runs, or too many.
    Sweep = 801,
    /// A run of a sweep that is refused.
    SweptRun = 802,
    /// Runs that need more disk than the limit.
    Disk = 803,
    /// A folder that holds no sweep, or another.
    OtherSweep = 804,
    /// Runs of a sweep that failed.
    FailedRuns = 805,
    /// A figure that is not there or whose target file cannot be used.
    Figure = 901,
    /// A figure whose run failed.
    FailedFigure = 902,
    /// An output folder that is not empty.
    FolderInUse = 1001,
    /// A folder or file that cannot be written.
    Unwritable = 1002,
    /// A file that exists.
    FileExists = 1003,
    /// An output without a file of its own in the output folder.
    OutputFile = 1004,
    /// A picture that cannot be drawn.
    Picture = 1005,
    /// Data that the format of a file cannot hold.
    OtherFormat = 1006,
}

impl Code {
    /// All codes, by number.
    pub const ALL: [Self; 50] = [
        Self::Arguments,
        Self::UnknownSubject,
        Self::Notation,
        Self::UnknownName,
        Self::MissingField,
        Self::RepeatedField,
        Self::WrongType,
        Self::Edit,
        Self::UnreadableScenario,
        Self::OutOfRange,
        Self::Unsuitable,
        Self::Stage,
        Self::Never,
        Self::Memory,
        Self::NotInRun,
        Self::NotProvided,
        Self::Contradiction,
        Self::InitialValues,
        Self::UnreadableFile,
        Self::DamagedFile,
        Self::LargeFile,
        Self::UnknownFormat,
        Self::NoSpacing,
        Self::Gaps,
        Self::OtherSize,
        Self::NoRun,
        Self::NoCheckpoint,
        Self::OtherScenario,
        Self::DamagedCheckpoint,
        Self::Busy,
        Self::NotFinite,
        Self::Budget,
        Self::Fault,
        Self::Plugin,
        Self::Recording,
        Self::Interrupted,
        Self::Rulers,
        Self::Sweep,
        Self::SweptRun,
        Self::Disk,
        Self::OtherSweep,
        Self::FailedRuns,
        Self::Figure,
        Self::FailedFigure,
        Self::FolderInUse,
        Self::Unwritable,
        Self::FileExists,
        Self::OutputFile,
        Self::Picture,
        Self::OtherFormat,
    ];

    /// The number; its hundreds are the group.
    pub const fn number(self) -> u16 {
        self as u16
    }

    /// The code that is written so: `L0201`, `l201` or `201`.
    pub fn named(text: &str) -> Option<Self> {
        let digits = text.trim().trim_start_matches(['L', 'l']);
        let number: u16 = digits.parse().ok()?;
        Self::ALL.into_iter().find(|code| code.number() == number)
    }
}

impl fmt::Display for Code {
    /// `L` and four digits.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "L{:04}", self.number())
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_rise_and_are_read_back() {
        assert!(Code::ALL.is_sorted_by(|one, next| one < next), "each once, in order");
        for code in Code::ALL {
            assert_eq!(Code::named(&code.to_string()), Some(code));
            assert_eq!(Code::named(&code.number().to_string()), Some(code));
        }
        for text in ["", "L", "L0000", "0", "L9999", "-1", "x", "L1 2", "99999999999"] {
            assert_eq!(Code::named(text), None, "{text:?}");
        }
    }
}
