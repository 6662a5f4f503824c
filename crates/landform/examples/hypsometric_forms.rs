//! Figures 2.11 to 2.13 of the thesis: Strahler's families of hypsometric curves, the stages of
//! erosion and unusual forms, each classified. `cargo run --release -p landform --example
//! hypsometric_forms` writes `hypsometric_forms.png`.

use std::error::Error;
use std::path::Path;

use landform::analysis::{HypsometricCurve, Hypsometry, StrahlerCurve};
use landform::view::plot::{Axis, Figure, Line, Panel, Point, Series};

/// The curve of a terrain whose relative heights are `f` of the share above.
fn curve(f: &dyn Fn(f64) -> f64) -> Result<HypsometricCurve, Box<dyn Error>> {
    let heights: Vec<f64> = (0..=20_000).map(|k| f(f64::from(k) / 20_000.0)).collect();
    Ok(HypsometricCurve::new(&heights)?)
}

/// A line of a plot, named after what it is and what it is classified as.
fn series(name: &str, f: &dyn Fn(f64) -> f64) -> Result<Series, Box<dyn Error>> {
    let curve = curve(f)?;
    let stage = format!("{:?}", Hypsometry::new(&curve).stage).to_lowercase();
    let points = curve.points().map(|[x, y]| Point::new(x, y)).collect();
    Ok(Series { line: Some(Line::Solid), ..Series::new(format!("{name}: {stage}"), points) })
}

fn panel(title: &str, series: Vec<Series>) -> Panel {
    let axis = |label: &str| Axis { range: Some([0.0, 1.0]), ..Axis::linear(label) };
    Panel {
        title: title.to_owned(),
        x: axis("share of the area above"),
        y: axis("relative height"),
        series,
        ..Panel::default()
    }
}

/// Figure 2.11: a family with one ratio a/d.
fn family(a_over_d: f64) -> Result<Panel, Box<dyn Error>> {
    let mut lines = Vec::new();
    for z in [0.1, 0.25, 0.5, 1.0, 2.0] {
        let model = StrahlerCurve::new(a_over_d, z).ok_or("a ratio and an exponent in range")?;
        lines.push(series(&format!("z {z}"), &|x| model.height_at(x))?);
    }
    Ok(panel(&format!("a/d = {a_over_d}"), lines))
}

fn main() -> Result<(), Box<dyn Error>> {
    let pi = std::f64::consts::PI;
    let mut stages = Vec::new();
    for (name, a_over_d, z) in [("young", 0.1, 0.1), ("mature", 0.1, 0.35), ("old", 0.02, 0.6)] {
        let model = StrahlerCurve::new(a_over_d, z).ok_or("a ratio and an exponent in range")?;
        stages.push(series(name, &|x| model.height_at(x))?);
    }
    let unusual = vec![
        series("convex", &|x| 1.0 - x * x)?,
        series("inflections", &|x| 1.0 - x + 0.06 * (4.0 * pi * x).sin())?,
        series("reversed", &|x| 0.5 + 0.5 * (pi * x).cos())?,
    ];
    let panels = vec![
        family(0.01)?,
        family(0.1)?,
        family(0.5)?,
        panel("stages", stages),
        panel("unusual forms", unusual),
    ];
    let figure = Figure {
        title: "Strahler's curves, the stages of erosion and unusual forms".to_owned(),
        panels,
        columns: 3,
        panel_size: [400.0, 340.0],
        pixels_per_unit: 1.0,
    };
    let path = Path::new("hypsometric_forms.png");
    figure.write(path, &[("Title", &figure.title)])?;
    println!("{}", path.display());
    Ok(())
}
