//! The figure of a raster.

use landform_analysis::{HypsometricCurve, Hypsometry, StrahlerCurve};
use landform_view::ViewError;
use landform_view::plot::{Axis, Figure, Line, Panel, Point, Series};

use super::super::raster::{Drawn, RasterAnalysis};
use super::super::table::words;
use super::view::Pictured;
use super::{PANEL, PIXELS_PER_UNIT, density, empty, map, title};

/// Draws map, view, spectrum and hypsometric curve; a panel that cannot be drawn says so.
pub(in crate::analyze) fn figure(analysis: &RasterAnalysis) -> Result<Figure, ViewError> {
    let RasterAnalysis { numbers, terrain, drawn } = analysis;
    let Drawn { curve, spectrum, streams } = drawn;
    let pictured = Pictured::new(terrain);
    let [map, view] = match &pictured {
        Some(pictured) => [map::map(terrain, pictured, streams)?, map::view(pictured)?],
        None => ["map", "view"].map(|name| empty(name, "too narrow to be drawn")),
    };
    let spectrum = match (spectrum, &numbers.spectrum) {
        (Some(spectrum), Some(found)) => density::panel(spectrum, &found.prepared)?,
        _ => empty("spectral density", "see the notes of the analysis"),
    };
    let curve = match (curve, &numbers.hypsometry) {
        (Some(curve), Some(hypsometry)) => hypsometric(curve, hypsometry),
        _ => empty("hypsometric curve", "all heights are the same"),
    };
    Ok(Figure {
        title: title(&numbers.file),
        panels: vec![map, view, spectrum, curve],
        columns: 4,
        panel_size: PANEL,
        pixels_per_unit: PIXELS_PER_UNIT,
    })
}

/// The curve with its nearest model.
fn hypsometric(curve: &HypsometricCurve, hypsometry: &Hypsometry) -> Panel {
    let measured = curve.points().map(|[x, y]| Point::new(x, y)).collect();
    let measured = Series { line: Some(Line::Solid), ..Series::new("measured", measured) };
    let mut series = vec![measured];
    if let Some(model) = StrahlerCurve::new(hypsometry.a_over_d, hypsometry.z) {
        let point = |index: u32| {
            let x = f64::from(index) / 200.0;
            Point::new(x, model.height_at(x))
        };
        let name = format!("a/d {:.3}, z {:.3}", hypsometry.a_over_d, hypsometry.z);
        let points = (0..=200).map(point).collect();
        series.push(Series { line: Some(Line::Dashed), ..Series::new(name, points) });
    }
    let axis = |label: &str| Axis { range: Some([0.0, 1.0]), ..Axis::linear(label) };
    Panel {
        title: "hypsometric curve".to_owned(),
        x: axis("share of the area above"),
        y: axis("relative height"),
        series,
        caption: format!("integral {:.3}, {}", hypsometry.integral, words(&hypsometry.stage)),
        ..Panel::default()
    }
}
