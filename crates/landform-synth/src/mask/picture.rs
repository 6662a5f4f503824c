//! Pictures laid on the plane.

use std::path::Path;

use landform_io::{Raster, ReadLimits, read_raster_file};

use super::MaskSource;
use super::source::unusable;
use crate::SynthError;

/// Shares with straight lines between the middles of pixels, and those of the border beyond it.
#[derive(Debug)]
pub(super) struct Picture {
    /// 0 for the least value of the picture, 1 for the greatest.
    shares: Raster,
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
            return Err(unusable("no picture is named; name a raster file".to_owned()));
        }
        let path = folder.join(path);
        let limits = ReadLimits { max_cells: super::MOST_PIXELS as u64 };
        let file = read_raster_file(&path, &limits).map_err(|error| unusable(error.to_string()))?;
        let shares = file.raster;
        shares.complete(&path).map_err(|error| unusable(error.to_string()))?;
        let [least, most] = shares.range().unwrap_or_default();
        if least == most {
            let path = path.display();
            let problem = format!("{path} has the value {least} everywhere; it shows no region");
            return Err(unusable(problem));
        }
        Ok(Self::new(shares, at, pixel))
    }

    /// A raster without gaps, the middle of whose south-western pixel lies at `at`.
    pub fn new(mut raster: Raster, at: [f64; 2], pixel: f64) -> Self {
        let [least, most] = raster.range().unwrap_or_default();
        let scale = if most > least { 1.0 / (most - least) } else { 0.0 };
        raster.values.iter_mut().for_each(|value| *value = (*value - least) * scale);
        let slope = steepest(&raster) / pixel;
        Self { shares: raster, at, pixel, slope }
    }

    /// Number of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.shares.size()
    }

    /// Share at a point.
    pub fn share(&self, point: [f64; 2]) -> f64 {
        let [width, height] = self.size();
        let place = |axis: usize, count: usize| {
            let at = ((point[axis] - self.at[axis]) / self.pixel).clamp(0.0, (count - 1) as f64);
            let cell = (at.floor() as usize).min(count.saturating_sub(2));
            (cell, at - cell as f64)
        };
        let [(column, east), (row, north)] = [place(0, width), place(1, height)];
        let share = |column: usize, row: usize| {
            let row = height - 1 - row.min(height - 1);
            self.shares.values[column.min(width - 1) + width * row]
        };
        let along = |row: usize| {
            let [from, to] = [share(column, row), share(column + 1, row)];
            from + east * (to - from)
        };
        let [south, farther] = [along(row), along(row + 1)];
        south + north * (farther - south)
    }

    /// Largest change of the share a metre.
    pub fn slope(&self) -> f64 {
        self.slope
    }
}

/// Largest change a pixel between the middles of any four pixels.
fn steepest(raster: &Raster) -> f64 {
    let at = |column: usize, row: usize| {
        raster.values[column.min(raster.width - 1) + raster.width * row.min(raster.height - 1)]
    };
    let mut steepest = 0.0_f64;
    for row in 0..raster.height {
        for column in 0..raster.width {
            let [a, b] = [at(column, row), at(column + 1, row)];
            let [c, d] = [at(column, row + 1), at(column + 1, row + 1)];
            let across = (b - a).abs().max((d - c).abs());
            steepest = steepest.max(across.hypot((c - a).abs().max((d - b).abs())));
        }
    }
    steepest
}
