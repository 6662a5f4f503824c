//! Everything that is measured of lines.

use std::path::Path;

use landform_analysis::{
    Dimension, DimensionError, Polyline, ScaleRange, box_dimension, divider_dimension,
};
use landform_io::{LineCoordinates, LineFile, ReadLimits, read_lines};
use serde::Serialize;

use super::notes::Notes;
use super::{AnalyzeError, Settings};

/// Memory that the analysis of lines takes, in bytes a point; measured, and rounded up.
const BYTES_A_POINT: u64 = 200;

/// The analysis of lines.
#[derive(Clone, Debug, Serialize)]
pub struct LineAnalysis {
    /// What was measured.
    #[serde(flatten)]
    pub numbers: LineNumbers,
    /// The lines.
    #[serde(skip)]
    pub lines: Vec<Polyline>,
}

/// The numbers of lines. What they are too few or too coarse for is `None`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LineNumbers {
    /// The file as it was named.
    pub file: String,
    /// `lines`.
    pub kind: &'static str,
    /// Number of lines.
    pub lines: usize,
    /// Number of those that end where they start.
    pub closed: usize,
    /// Number of points.
    pub points: usize,
    /// Whether the points were degrees; they are measured on the sphere then.
    pub geographic: bool,
    /// Length of all lines.
    pub length_m: f64,
    /// Dimension by dividers: [`divider_dimension`].
    pub divider: Option<Dimension>,
    /// Dimension by box counting: [`box_dimension`].
    #[serde(rename = "box")]
    pub boxes: Option<Dimension>,
    /// What is missing and why: `part: remark`.
    pub notes: Vec<String>,
}

impl LineAnalysis {
    /// Reads and measures the lines of a CSV or GeoJSON file.
    ///
    /// # Errors
    /// [`AnalyzeError`]: a file that cannot be read or is too large, or rulers that do not suit
    /// its lines.
    pub fn read(path: &Path, settings: &Settings) -> Result<Self, AnalyzeError> {
        let max_cells = settings.memory_bytes / BYTES_A_POINT;
        let file = read_lines(path, &ReadLimits { max_cells });
        let file = file.map_err(|error| AnalyzeError::of(error, settings.memory_bytes))?;
        Self::of(path, &file, settings.rulers)
    }

    /// Measures lines that were read.
    ///
    /// # Errors
    /// [`AnalyzeError::Line`]; [`AnalyzeError::Rulers`] for `rulers` that do not suit the lines.
    pub fn of(
        path: &Path,
        file: &LineFile,
        rulers: Option<ScaleRange>,
    ) -> Result<Self, AnalyzeError> {
        let geographic = file.coordinates == LineCoordinates::Geographic;
        let polyline = |points: &Vec<[f64; 2]>| match geographic {
            true => Polyline::geographic(points),
            false => Polyline::planar(points),
        };
        let lines: Result<Vec<Polyline>, _> = file.lines.iter().map(polyline).collect();
        let lines = lines.map_err(|source| AnalyzeError::Line { path: path.into(), source })?;
        let mut notes = Notes::default();
        let [divider, boxes] = dimensions(&lines, rulers, &mut notes)
            .map_err(|source| AnalyzeError::Rulers { path: path.into(), source })?;
        let numbers = LineNumbers {
            file: path.display().to_string(),
            kind: "lines",
            lines: lines.len(),
            closed: lines.iter().filter(|line| line.is_closed()).count(),
            points: file.point_count(),
            geographic,
            length_m: lines.iter().map(Polyline::length_m).sum(),
            divider,
            boxes,
            notes: notes.into_inner(),
        };
        Ok(Self { numbers, lines })
    }
}

/// The dimension by dividers and that by boxes. Rulers that were asked for must do; without them
/// whatever is wrong becomes a remark.
fn dimensions(
    lines: &[Polyline],
    asked: Option<ScaleRange>,
    notes: &mut Notes,
) -> Result<[Option<Dimension>; 2], DimensionError> {
    if let Some(range) = asked {
        let both = [divider_dimension(lines, &range)?, box_dimension(lines, &range)?];
        return Ok(both.map(Some));
    }
    let Some(range) = notes.found("divider, box", ScaleRange::usual(lines)) else {
        return Ok([None, None]);
    };
    Ok([
        notes.found("divider", divider_dimension(lines, &range)),
        notes.found("box", box_dimension(lines, &range)),
    ])
}
