//! Pictures laid on the plane.

use std::path::Path;

use landform_io::{Grey, ReadLimits, read_grey};

use super::MaskSource;
use super::source::unusable;
use crate::SynthError;

/// Greys with straight lines between the middles of pixels, and those of the border beyond it.
#[derive(Debug)]
pub(super) struct Picture {
    grey: Grey,
    /// Middle of the south-western pixel.
    at: [f64; 2],
    /// Width of a pixel in metres.
    pixel: f64,
    slope: f64,
}

impl Picture {
    /// Reads the picture of a source that is one.
    pub fn read(
        source: &MaskSource,
        folder: &Path,
        at: [f64; 2],
        pixel: f64,
    ) -> Result<Self, SynthError> {
        let MaskSource::Picture(path) = source else {
            return Err(unusable("this is no picture".to_owned()));
        };
        if path.as_os_str().is_empty() {
            return Err(unusable("no picture is named; name a PNG file".to_owned()));
        }
        let limits = ReadLimits { max_cells: super::MOST_PIXELS as u64 };
        let grey = read_grey(folder.join(path), &limits);
        let grey = grey.map_err(|error| unusable(error.to_string()))?;
        let slope = steepest(&grey) / pixel;
        Ok(Self { grey, at, pixel, slope })
    }

    /// Number of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.grey.width, self.grey.height]
    }

    /// Grey at a point.
    pub fn share(&self, point: [f64; 2]) -> f64 {
        let [width, height] = self.size();
        let place = |axis: usize, count: usize| {
            let at = ((point[axis] - self.at[axis]) / self.pixel).clamp(0.0, (count - 1) as f64);
            let cell = (at.floor() as usize).min(count.saturating_sub(2));
            (cell, at - cell as f64)
        };
        let [(column, east), (row, north)] = [place(0, width), place(1, height)];
        let grey = |column: usize, row: usize| {
            let row = height - 1 - row.min(height - 1);
            self.grey.values[column.min(width - 1) + width * row]
        };
        let along = |row: usize| {
            let [from, to] = [grey(column, row), grey(column + 1, row)];
            from + east * (to - from)
        };
        let [south, farther] = [along(row), along(row + 1)];
        south + north * (farther - south)
    }

    /// Largest change of the grey a metre.
    pub fn slope(&self) -> f64 {
        self.slope
    }
}

/// Largest change a pixel between the middles of any four pixels.
fn steepest(grey: &Grey) -> f64 {
    let at = |column: usize, row: usize| {
        grey.values[column.min(grey.width - 1) + grey.width * row.min(grey.height - 1)]
    };
    let mut steepest = 0.0_f64;
    for row in 0..grey.height {
        for column in 0..grey.width {
            let [a, b] = [at(column, row), at(column + 1, row)];
            let [c, d] = [at(column, row + 1), at(column + 1, row + 1)];
            let across = (b - a).abs().max((d - c).abs());
            steepest = steepest.max(across.hypot((c - a).abs().max((d - b).abs())));
        }
    }
    steepest
}
