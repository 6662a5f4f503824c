//! Colours by value, and spectra drawn in them.

use landform_analysis::{SpectralFit, Spectrum};
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
}

impl Default for Density {
    fn default() -> Self {
        Self { colours: "batlow".to_owned(), pixels_per_node: 2, floor: SpectralFit::FLOOR }
    }
}

impl Density {
    pub(super) fn draw(
        &self,
        values: &[f64],
        [width, height]: [usize; 2],
    ) -> Result<Image, ViewError> {
        let colours = ColourMap::named(&self.colours)?;
        let logarithms = logarithms(values, [width, height], self.floor);
        flat::colour_field(&logarithms, width, height, colours, None, self.pixels_per_node)
    }
}

/// Natural logarithms of the amplitudes, frequency zero in the middle; those of a field without
/// a spectrum (one that is not finite) are grey.
fn logarithms(values: &[f64], size: [usize; 2], floor: f64) -> Vec<f64> {
    let lattice = Lattice::plane(size, 1.0, Connectivity::Four, [Boundary::Open; 2]).ok();
    lattice
        .and_then(|lattice| Spectrum::new(&lattice, values).ok())
        .map_or_else(|| vec![f64::NAN; values.len()], |spectrum| spectrum.triple_log_plot(floor))
}
