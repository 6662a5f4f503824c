//! The triple-log plot of a spectrum.

use landform_analysis::{SpectralFit, Spectrum, TripleLogPlot};
use landform_view::plot::{Axis, ColourScale, Panel, Picture};
use landform_view::{ColourMap, Ground, ViewError, flat};

use super::super::SpectralNumbers;

/// Pixels of the plot along either side; odd, so that frequency 0 has one of its own.
const SIDE: usize = 601;

/// The plot with the two numbers of the thesis below it.
pub(super) fn panel(spectrum: &Spectrum, numbers: &SpectralNumbers) -> Result<Panel, ViewError> {
    let plot = TripleLogPlot::new(spectrum, SIDE, SpectralFit::FLOOR);
    let colours = ColourMap::named("batlow")?;
    let range = flat::finite_range(&plot.logarithms);
    let image = flat::colour_field(&plot.logarithms, SIDE, SIDE, colours, Some(range), 1)?;
    let ground = Ground { range_m: Some(range), ..Ground::new(colours) };
    let [x, y] = plot.reach.map(|reach| [-reach, reach]);
    let axis = |label: &str, range| Axis { range: Some(range), ..Axis::signed_log(label) };
    Ok(Panel {
        title: "spectral density".to_owned(),
        x: axis("waves from west to east", x),
        // The first row has the most negative wave numbers to the south.
        y: axis("waves from south to north", y),
        picture: Some(Picture { image, x, y }),
        colours: Some(ColourScale {
            ground,
            range,
            label: "ln of the amplitude in metres".to_owned(),
        }),
        caption: caption(numbers),
        ..Panel::default()
    })
}

fn caption(numbers: &SpectralNumbers) -> String {
    let mut parts = Vec::new();
    if let (Some(rms), Some(r2)) = (numbers.rms, numbers.r2) {
        parts.push(format!("RMS {rms:.3}, R² {r2:.3}"));
    }
    if let (Some(beta), Some(error)) = (numbers.beta, numbers.beta_error) {
        parts.push(format!("β {beta:.2} ± {error:.2}"));
    }
    parts.join(", ").replace('-', "\u{2212}")
}
