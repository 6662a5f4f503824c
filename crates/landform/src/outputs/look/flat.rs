//! Colours by value, and spectra drawn in them.

use landform_analysis::{SpectralFit, Spectrum, TripleLogPlot};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_view::flat::{self, ColourBar};
use landform_view::{ColourMap, Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Colours by value, without light, with a colour bar.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Flat {
    /// Name of the colour map.
    pub colours: String,
    /// Values of the first and the last colour; the field's own range when missing.
    pub range: Option<(f64, f64)>,
    /// Width of a node in pixels.
    #[schemars(range(min = 1, max = 64))]
    pub pixels_per_node: usize,
    /// Whether a colour bar is drawn beside the map.
    pub bar: bool,
}

impl Default for Flat {
    fn default() -> Self {
        Self { colours: "viridis".to_owned(), range: None, pixels_per_node: 2, bar: true }
    }
}

impl Flat {
    pub(super) fn draw(
        &self,
        values: &[f64],
        width: usize,
        height: usize,
        unit: &str,
    ) -> Result<Image, ViewError> {
        let colours = ColourMap::named(&self.colours)?;
        let range = self.range.map_or_else(|| flat::finite_range(values), <[f64; 2]>::from);
        let pixels = self.pixels_per_node;
        let image = flat::colour_field(values, width, height, colours, Some(range), pixels)?;
        match self.bar {
            true => {
                ColourBar { colours, range, label: unit.to_owned(), text_size: 14.0 }.beside(&image)
            }
            false => Ok(image),
        }
    }
}

/// How wave numbers are spread over a picture of a spectrum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum DensityAxes {
    /// Equal differences are equal lengths: a pixel, or some, for each wave.
    #[default]
    Linear,
    /// Equal ratios are equal lengths, on both sides of 0: the triple-log plot of the thesis.
    Logarithmic,
}

/// The spectral density of a field: logarithm of the amplitude of each wave, frequency zero in
/// the middle (thesis, figure 2.3).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Density {
    /// Name of the colour map.
    pub colours: String,
    /// Width of a wave number in pixels.
    #[schemars(range(min = 1, max = 64))]
    pub pixels_per_node: usize,
    /// Amplitudes below this are drawn as this.
    #[schemars(range(min = 1e-300, max = 1e300), extend("x-source" = "thesis 2.1.6"))]
    pub floor: f64,
    /// How wave numbers are spread; on logarithmic axes the picture is a square of as many pixels.
    pub axes: DensityAxes,
}

impl Default for Density {
    fn default() -> Self {
        let (floor, axes) = (SpectralFit::FLOOR, DensityAxes::Linear);
        Self { colours: "batlow".to_owned(), pixels_per_node: 2, floor, axes }
    }
}

impl Density {
    pub(super) fn draw(
        &self,
        values: &[f64],
        [width, height]: [usize; 2],
    ) -> Result<Image, ViewError> {
        let colours = ColourMap::named(&self.colours)?;
        let Some(spectrum) = spectrum(values, [width, height]) else {
            let grey = vec![f64::NAN; values.len()];
            return flat::colour_field(&grey, width, height, colours, None, self.pixels_per_node);
        };
        match self.axes {
            DensityAxes::Linear => {
                let logarithms = spectrum.triple_log_plot(self.floor);
                flat::colour_field(&logarithms, width, height, colours, None, self.pixels_per_node)
            }
            DensityAxes::Logarithmic => {
                let nodes = (width as f64 * height as f64).sqrt();
                let side = (nodes * self.pixels_per_node as f64).round() as usize;
                let plot = TripleLogPlot::new(&spectrum, side, self.floor);
                flat::colour_field(&plot.logarithms, side, side, colours, None, 1)
            }
        }
    }
}

impl Density {
    /// RMS and R2 of the thesis' fit (section 2.1.6), none for a field without a spectrum.
    pub(super) fn numbers(values: &[f64], size: [usize; 2]) -> Option<String> {
        let fit = SpectralFit::new(&spectrum(values, size)?).ok()?;
        Some(format!("RMS {:.3}, R² {:.3}", fit.rms, fit.r_squared))
    }
}

/// The spectrum of a field; none of one that is not finite.
fn spectrum(values: &[f64], size: [usize; 2]) -> Option<Spectrum> {
    let lattice = Lattice::plane(size, 1.0, Connectivity::Four, [Boundary::Open; 2]).ok()?;
    Spectrum::new(&lattice, values).ok()
}
