//! The hypsometric curve of a field.

use landform_analysis::{HypsometricCurve, Hypsometry, StrahlerCurve};
use landform_view::plot::{Axis, Figure, Line, Panel, Point, Series};
use landform_view::{Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The hypsometric curve of a field with the nearest of Strahler's model curves, dashed (thesis,
/// section 2.4.1).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Curve {
    /// Width and height of the plot.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
}

impl Default for Curve {
    fn default() -> Self {
        Self { size: (512, 512) }
    }
}

/// Pixels for each unit of a plot: letters of a plot of the usual size are as large as captions.
const PIXELS_PER_UNIT: f64 = 1.5;

/// A state of a field: its name and its values.
type State<'a> = (&'a str, &'a [f64]);

impl Curve {
    /// The plot of the curve, empty for a field without one.
    pub(super) fn figure(&self, values: &[f64]) -> Figure {
        let mut series = Vec::new();
        if let Ok(curve) = HypsometricCurve::new(values) {
            let found = Hypsometry::new(&curve);
            series.push(Series { line: Some(Line::Solid), ..Series::new("", measured(&curve)) });
            if let Some(model) = StrahlerCurve::new(found.a_over_d, found.z) {
                let model = points(&|share| model.height_at(share));
                series.push(Series { line: Some(Line::Dashed), ..Series::new("", model) });
            }
        }
        self.plot(series)
    }

    /// The curves of a state before and of one after, the later one heavier and below the other
    /// (thesis, figures 4.12 and 4.21). Flat states have none.
    pub(crate) fn draw_change(&self, [before, after]: [State<'_>; 2]) -> Result<Image, ViewError> {
        let heavy = [(after, 3.0), (before, 1.2)];
        let series =
            heavy.into_iter().enumerate().filter_map(|(colour, ((name, values), width))| {
                let curve = HypsometricCurve::new(values).ok()?;
                let (line, width, colour) = (Some(Line::Solid), Some(width), Some(colour));
                Some(Series { line, width, colour, ..Series::new(name, measured(&curve)) })
            });
        self.plot(series.collect()).image()
    }

    fn plot(&self, series: Vec<Series>) -> Figure {
        let axis = |label: &str| Axis { range: Some([0.0, 1.0]), ..Axis::linear(label) };
        let panel = Panel {
            x: axis("share of the area above"),
            y: axis("relative height"),
            series,
            ..Panel::default()
        };
        let (width, height) = self.size;
        Figure {
            panels: vec![panel],
            columns: 1,
            panel_size: [width, height].map(|side| side as f64 / PIXELS_PER_UNIT),
            pixels_per_unit: PIXELS_PER_UNIT,
            ..Figure::default()
        }
    }

    /// What the curve says in numbers, none for a flat field.
    pub(super) fn numbers(values: &[f64]) -> Option<String> {
        let found = Hypsometry::new(&HypsometricCurve::new(values).ok()?);
        let stage = format!("{:?}", found.stage).to_lowercase();
        Some(format!("integral {:.2}, {stage}", found.integral))
    }

    /// The same of a state before and of one after, none where one is flat.
    pub(crate) fn numbers_of_change([before, after]: [&[f64]; 2]) -> Option<String> {
        Some(format!("{}, then {}", Self::numbers(before)?, Self::numbers(after)?))
    }
}

/// Points of a curve at equal distances.
fn points(height_at: &dyn Fn(f64) -> f64) -> Vec<Point> {
    let place = |index: usize| index as f64 / (HypsometricCurve::PLACES - 1) as f64;
    let places = (0..HypsometricCurve::PLACES).map(place);
    places.map(|share| Point::new(share, height_at(share))).collect()
}

/// Points of a measured curve.
fn measured(curve: &HypsometricCurve) -> Vec<Point> {
    points(&|share| curve.height_at(share))
}
