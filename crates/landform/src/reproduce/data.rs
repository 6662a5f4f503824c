//! Files of measured data that a figure analyses.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use landform_sim::simulation::Limits;

use crate::analyze::{Analysis, RasterNumbers, Settings, analyze};
use crate::metrics::hypsometry_columns;

use super::measure::Places;
use super::{AnalysisEntry, Figure, Target};

/// Name of the stage under which a target finds the numbers of a file.
pub(super) const ANALYSIS: &str = "analysis";

/// The files of data of a figure.
pub(super) struct Data<'a> {
    /// Those that are there, by the names of their runs.
    pub analysed: Vec<(&'a str, Analysed)>,
    /// Why the others are absent.
    absent: BTreeMap<&'a str, String>,
}

/// What an analysis came to.
pub(super) struct Analysed {
    /// The file.
    pub file: PathBuf,
    /// Its numbers.
    pub metrics: BTreeMap<String, f64>,
    /// Its figure, relative to the output folder.
    pub picture: PathBuf,
}

impl<'a> Data<'a> {
    /// Analyses the files that are there. `tell` hears which.
    pub fn analyze(
        figure: &'a Figure,
        places: Places<'_>,
        limits: Limits,
        tell: &dyn Fn(&str),
    ) -> Result<Self, String> {
        let (mut analysed, mut absent) = (Vec::new(), BTreeMap::new());
        for entry in &figure.analyses {
            let path = places.data.map(|data| data.join(&entry.file));
            match path.filter(|path| path.is_file()) {
                Some(file) => {
                    tell(&entry.name);
                    let found = entry.analyze(file, places.output, limits)?;
                    analysed.push((entry.name.as_str(), found));
                }
                None => drop(absent.insert(entry.name.as_str(), entry.absence(places.data))),
            }
        }
        Ok(Self { analysed, absent })
    }

    /// Why a target has no numbers, if data that it needs are absent.
    pub fn absence(&self, target: &Target) -> Option<&str> {
        let sources = target.value.sources();
        let reason = sources.iter().find_map(|source| self.absent.get(source.run.as_str()));
        reason.map(String::as_str)
    }
}

impl AnalysisEntry {
    /// Why there are no numbers of the file.
    fn absence(&self, data: Option<&Path>) -> String {
        let file = self.file.display();
        match data {
            Some(data) => format!("{file} is not in {}", data.display()),
            None => format!("{file} is needed; name the folder that holds it with --data DIR"),
        }
    }

    /// Analyses the file and draws the figure into `folder/NAME/`.
    fn analyze(&self, file: PathBuf, folder: &Path, limits: Limits) -> Result<Analysed, String> {
        let path = file.as_path();
        let settings = Settings { memory_bytes: limits.memory_bytes, ..Settings::default() };
        let analysis = analyze(path, &settings).map_err(|error| error.to_string())?;
        let metrics = match &analysis {
            Analysis::Raster(raster) => metrics(&raster.numbers),
            Analysis::Lines(_) | Analysis::Cave(_) => {
                return Err(format!("{}: expected a raster", path.display()));
            }
        };
        let figure = analysis.figure().map_err(|error| format!("{}: {error}", path.display()))?;
        let picture = Path::new(&self.name).join("analysis.png");
        let place = folder.join(&self.name);
        std::fs::create_dir_all(&place)
            .map_err(|error| format!("cannot make {}: {error}", place.display()))?;
        let text = [("Title", figure.title.as_str())];
        figure.write(&folder.join(&picture), &text).map_err(|error| error.to_string())?;
        Ok(Analysed { file, metrics, picture })
    }
}

/// Numbers of a raster, named as the metrics `Hypsometry` and `SpectralFalloff` name them; those of
/// the spectrum belong to the heights as they are, and with `prepared` to those without a plane
/// and tapered to the borders.
fn metrics(numbers: &RasterNumbers) -> BTreeMap<String, f64> {
    let mut metrics = BTreeMap::new();
    if let Some(found) = &numbers.hypsometry {
        metrics.extend(hypsometry_columns(found));
    }
    if let Some(found) = &numbers.spectrum {
        for (prefix, fit) in [("spectral", &found.untreated), ("prepared", &found.prepared)] {
            let values = [("rms", fit.rms), ("r2", fit.r2), ("beta", fit.beta)];
            let known = values.into_iter().filter_map(|(name, value)| Some((name, value?)));
            metrics.extend(known.map(|(name, value)| (format!("{prefix}_{name}"), value)));
        }
    }
    metrics
}
