//! What can go wrong when a picture is made.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Most pixels (or resampled surface nodes) that one picture may have: 2^28, 768 MiB of colours.
pub const MOST_PIXELS: usize = 1 << 28;

/// Why a picture, a colour map or an animation cannot be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A field or a picture without columns or rows.
    #[error(
        "{what} of {width} x {height} has nothing to show; both sizes must be at least {least}"
    )]
    TooSmall {
        /// What has the size.
        what: &'static str,
        /// Number of columns.
        width: usize,
        /// Number of rows.
        height: usize,
        /// Smallest size that works.
        least: usize,
    },
    /// More pixels than a picture may have.
    #[error(
        "{what} of {width} x {height} is more than {MOST_PIXELS} pixels; ask for a smaller one"
    )]
    TooLarge {
        /// What has the size.
        what: &'static str,
        /// Number of columns.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// The number of values is not the number of nodes.
    #[error("{what} has {found} values; {width} x {height} nodes need {}", width * height)]
    Length {
        /// What has the values.
        what: &'static str,
        /// Number of values given.
        found: usize,
        /// Number of columns.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// A value that is infinite, not a number, or too large to be one.
    #[error(
        "{what} is {value} at column {column}, row {row}; it must be a number of at most 1e12, so \
         fill the gaps of the field first"
    )]
    NotFinite {
        /// What has the value.
        what: &'static str,
        /// The value.
        value: f64,
        /// Column of the node, from the west.
        column: usize,
        /// Row of the node, from the north.
        row: usize,
    },
    /// An option out of its range.
    #[error("{name} is {value}; it must be {expected}")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// Value given.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// No colour map of that name.
    #[error("there is no colour map `{name}`; take one of {known}")]
    UnknownColourMap {
        /// Name asked for.
        name: String,
        /// Names that exist, with commas.
        known: String,
    },
    /// The file name does not say which format to write.
    #[error("`{path}` ends in no known format; end it in {expected}")]
    UnknownFormat {
        /// File asked for.
        path: PathBuf,
        /// Endings that work.
        expected: &'static str,
    },
    /// A frame of another size than the first one.
    #[error(
        "frame {frame} of the animation is {found:?} pixels and the first one {expected:?}; \
         all frames need one size"
    )]
    FrameSize {
        /// Number of the frame, from 0.
        frame: usize,
        /// Width and height of the frame.
        found: [usize; 2],
        /// Width and height of the first frame.
        expected: [usize; 2],
    },
    /// An animation was finished without a frame.
    #[error("`{path}` would be an animation without frames; add one before finishing it")]
    NoFrames {
        /// File asked for.
        path: PathBuf,
    },
    /// A file cannot be written or read.
    #[error("cannot {action} `{path}`: {source}; check that the folder exists and may be written")]
    File {
        /// What was tried: `write` or `read`.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The contents of a picture file cannot be written or understood.
    #[error("`{path}`: {problem}")]
    Format {
        /// The file.
        path: PathBuf,
        /// What the encoder or decoder said.
        problem: String,
    },
}

impl ViewError {
    /// An error of the encoder or decoder of `path`.
    pub(crate) fn format(path: &Path, problem: impl ToString) -> Self {
        Self::Format { path: path.into(), problem: problem.to_string() }
    }

    /// Checks a size: at least `least` both ways and not above [`MOST_PIXELS`].
    pub(crate) fn check_size(
        what: &'static str,
        [width, height]: [usize; 2],
        least: usize,
    ) -> Result<(), Self> {
        if width < least || height < least {
            return Err(Self::TooSmall { what, width, height, least });
        }
        match width.checked_mul(height) {
            Some(pixels) if pixels <= MOST_PIXELS => Ok(()),
            _ => Err(Self::TooLarge { what, width, height }),
        }
    }

    /// Checks that an option lies in a closed range, which `expected` describes.
    pub(crate) fn check_option(
        name: &'static str,
        value: f64,
        range: [f64; 2],
        expected: &'static str,
    ) -> Result<(), Self> {
        if value >= range[0] && value <= range[1] {
            return Ok(());
        }
        Err(Self::Option { name, value, expected })
    }
}
