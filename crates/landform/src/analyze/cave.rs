//! Everything that is measured of caves: surveys, and volumes of voxels.

use std::path::Path;

use landform_analysis::caves::{
    CaveField, CaveIndices, CaveNetwork, NetworkShape, OBSERVED, Observed,
};
use landform_analysis::voxels::VoxelSet;
use landform_io::npy::read_array;
use landform_io::{Fault, IoError, ReadLimits, read_survey};
use serde::Serialize;

use super::{AnalyzeError, Settings};

/// Memory that the analysis of a survey takes, in bytes a leg, and that of a volume in bytes a voxel;
/// rounded up.
const BYTES_A_LEG: u64 = 400;
const BYTES_A_VOXEL: u64 = 24;

/// The analysis of a cave.
#[derive(Clone, Debug, Serialize)]
pub struct CaveAnalysis {
    /// What was measured.
    #[serde(flatten)]
    pub numbers: CaveNumbers,
    /// The network of its passages.
    #[serde(skip)]
    pub network: CaveNetwork,
}

/// The numbers of a cave.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaveNumbers {
    /// The file as it was named.
    pub file: String,
    /// `cave survey` or `cave voxels`.
    pub kind: &'static str,
    /// Number of stations of the network.
    pub stations: usize,
    /// Number of legs.
    pub legs: usize,
    /// Geometry and topology of the network.
    pub shape: NetworkShape,
    /// Morphometric indices over the rectangle around the cave, of voxels.
    pub indices: Option<CaveIndices>,
    /// Each measure of the shape beside its range over surveyed caves.
    pub observed: Vec<Beside>,
}

/// A measure beside what was observed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Beside {
    /// Name of the measure.
    pub name: &'static str,
    /// Its value, if the cave has it.
    pub value: Option<f64>,
    /// Its range over 31 surveyed caves (Collon et al. 2017).
    pub range: [f64; 2],
    /// Whether the value lies in the range.
    pub within: Option<bool>,
}

impl Beside {
    fn new(observed: &Observed, shape: &NetworkShape) -> Self {
        let value = shape.value(observed.name);
        let [least, most] = observed.range;
        let within = value.map(|value| (least..=most).contains(&value));
        Self { name: observed.name, value, range: observed.range, within }
    }
}

impl CaveAnalysis {
    /// Reads and measures a survey ([`read_survey`]).
    ///
    /// # Errors
    /// [`AnalyzeError`]: a file that cannot be read, is too large, or is no survey.
    pub fn survey(path: &Path, settings: &Settings) -> Result<Self, AnalyzeError> {
        let limits = ReadLimits { max_cells: settings.memory_bytes / BYTES_A_LEG };
        let survey = read_survey(path, &limits)
            .map_err(|error| AnalyzeError::of(error, settings.memory_bytes))?;
        let network = CaveNetwork::new(survey.stations, &survey.legs)
            .map_err(|error| refused(path, &error.to_string(), "check the coordinates"))?;
        Ok(Self::of(path, "cave survey", network, None))
    }

    /// Reads and measures a volume: voxels of at least `settings.at_least` are passages.
    ///
    /// # Errors
    /// [`AnalyzeError`]: a file that cannot be read, a volume that is too large, or one without
    /// passages.
    pub fn voxels(path: &Path, settings: &Settings) -> Result<Self, AnalyzeError> {
        let limits = ReadLimits { max_cells: settings.memory_bytes / BYTES_A_VOXEL };
        let array = read_array(path, &limits)
            .map_err(|error| AnalyzeError::of(error, settings.memory_bytes))?;
        let [layers, rows, columns] = array.shape[..] else {
            let problem = format!("the array has {} axes", array.shape.len());
            return Err(refused(path, &problem, "save one with layers, rows and columns"));
        };
        let spacing_m = settings.spacing_m.unwrap_or(1.0);
        let set = VoxelSet::at_least([columns, rows, layers], &array.values, settings.at_least);
        let advice = "choose the least value of passages with --at-least";
        let measured = CaveNetwork::of_passages(&set, spacing_m).and_then(|network| {
            let indices = CaveIndices::of(&set, spacing_m, CaveField::Rectangle)?;
            Ok((network.resampled(spacing_m), indices))
        });
        let (network, indices) =
            measured.map_err(|error| refused(path, &error.to_string(), advice))?;
        Ok(Self::of(path, "cave voxels", network, Some(indices)))
    }

    fn of(
        path: &Path,
        kind: &'static str,
        network: CaveNetwork,
        indices: Option<CaveIndices>,
    ) -> Self {
        let shape = NetworkShape::of(&network);
        let numbers = CaveNumbers {
            file: path.display().to_string(),
            kind,
            stations: network.stations().len(),
            legs: network.legs().len(),
            observed: OBSERVED.iter().map(|observed| Beside::new(observed, &shape)).collect(),
            shape,
            indices,
        };
        Self { numbers, network }
    }
}

/// A file whose content is no cave.
fn refused(path: &Path, problem: &str, advice: &'static str) -> AnalyzeError {
    let error: IoError = Fault::new(problem, "a cave with passages", advice).reading(path);
    AnalyzeError::Read(error)
}
