//! The spectrum of a raster, with and without the treatment that a terrain with borders needs.

use landform_analysis::grid::Grid;
use landform_analysis::{
    AnalysisError, RadialSpectrum, SpectralFit, Spectrum, remove_plane, taper,
};
use landform_graph::{Boundary, Connectivity, Lattice};
use serde::Serialize;

use super::Window;
use super::notes::Notes;

/// What is done to the heights before the spectrum is taken.
pub const PREPARATION: &str = "least-squares plane removed, Hann window";

/// Both fits to a spectrum. Numbers that a raster is too small or too flat for are `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SpectralNumbers {
    /// Scatter about the fall-off (thesis, section 2.1.6), for heights in metres.
    pub rms: Option<f64>,
    /// Coefficient of determination of the fall-off (thesis, section 2.1.6).
    pub r2: Option<f64>,
    /// Exponent of the fall-off of power with frequency, from bins of equal logarithmic width.
    pub beta: Option<f64>,
    /// Standard error of beta.
    pub beta_error: Option<f64>,
    /// Wavelengths in metres that beta was fitted to.
    pub beta_range_m: Option<[f64; 2]>,
    /// Standard deviation of the logarithms of the amplitudes about the fall-off; unlike `rms` it
    /// does not depend on the unit of the heights.
    pub scatter_nats: Option<f64>,
    /// `r2` when no wave is left out for its small amplitude.
    pub r2_unfloored: Option<f64>,
    /// Waves that the thesis' fit left out for their small amplitude, in per cent.
    pub rejected_percent: Option<f64>,
}

/// The spectrum of a raster in numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spectral {
    /// After [`PREPARATION`], without which the step from one border to the opposite one counts
    /// as roughness.
    #[serde(flatten)]
    pub prepared: SpectralNumbers,
    /// [`PREPARATION`].
    pub preparation: &'static str,
    /// Of the heights as they are: the thesis' procedure to the letter, right for terrains that
    /// continue at their other side.
    pub untreated: SpectralNumbers,
    /// The cells that were transformed: all, or the largest part without gaps.
    pub window: Window,
}

impl Spectral {
    /// Takes both spectra of the heights of a window, and returns the prepared one too.
    pub(super) fn measure(
        cells: &Grid,
        window: Window,
        mut heights: Vec<f64>,
        notes: &mut Notes,
    ) -> Option<(Self, Spectrum)> {
        let size = [window.columns, window.rows];
        let lattice = Lattice::plane(size, 1.0, Connectivity::Four, [Boundary::Open; 2]);
        let lattice = notes.found("spectrum", lattice)?;
        note_length(cells, window, notes);
        let untreated = spectrum(&lattice, cells, &heights);
        let untreated = untreated.map(|spectrum| numbers(&spectrum, None)).unwrap_or_default();
        let prepared = remove_plane(&lattice, &mut heights)
            .and_then(|()| taper(&lattice, &mut heights))
            .and_then(|()| spectrum(&lattice, cells, &heights));
        let spectrum = notes.found("spectrum", prepared)?;
        let prepared = numbers(&spectrum, Some(notes));
        prepared.rms.or(prepared.beta)?;
        Some((Self { prepared, preparation: PREPARATION, untreated, window }, spectrum))
    }
}

/// Says that a raster is so long that few waves fit across it.
fn note_length(cells: &Grid, window: Window, notes: &mut Notes) {
    const LONG: f64 = 4.0;
    let [width, height] = cells.cell_size();
    let sides = [window.columns as f64 * width, window.rows as f64 * height];
    let ratio = sides[0].max(sides[1]) / sides[0].min(sides[1]);
    if ratio >= LONG {
        notes.add(
            "spectrum",
            format!(
                "the terrain is {ratio:.1} times as long as wide, so few waves run across it, and \
                 its numbers are hard to compare with those of a square"
            ),
        );
    }
}

fn spectrum(lattice: &Lattice, cells: &Grid, heights: &[f64]) -> Result<Spectrum, AnalysisError> {
    Ok(Spectrum::new(lattice, heights)?.on_cells_of(cells))
}

/// Fits both lines; `notes` takes what is missing.
fn numbers(spectrum: &Spectrum, notes: Option<&mut Notes>) -> SpectralNumbers {
    let fit = SpectralFit::new(spectrum);
    let radial = RadialSpectrum::usual(spectrum);
    let exponent = radial.exponent();
    if let Some(notes) = notes {
        if let Err(error) = &fit {
            notes.add("spectrum (rms, r2)", error);
        }
        if let Err(error) = &exponent {
            notes.add("spectrum (beta)", error);
        }
    }
    let (fit, exponent) = (fit.ok(), exponent.ok());
    let wavelength = |bin: usize| {
        let bin = radial.bins.get(bin)?;
        Some(1.0 / (bin.frequency * spectrum.base_frequency_per_m()))
    };
    let shortest = wavelength(radial.bins.len().wrapping_sub(1));
    let range = shortest.zip(wavelength(0)).filter(|_| exponent.is_some());
    SpectralNumbers {
        rms: fit.map(|fit| fit.rms),
        r2: fit.map(|fit| fit.r_squared),
        beta: exponent.map(|exponent| exponent.beta),
        beta_error: exponent.map(|exponent| exponent.beta_error),
        beta_range_m: range.map(<[f64; 2]>::from),
        scatter_nats: fit.map(|fit| fit.scatter_nats),
        r2_unfloored: fit.map(|fit| fit.r_squared_unfloored),
        rejected_percent: fit.map(|fit| 100.0 * fit.rejected_share),
    }
}
