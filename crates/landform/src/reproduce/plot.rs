//! Plots of a figure's numbers against a parameter, beside the laws that they are held against.

use std::path::{Path, PathBuf};

use landform_view::plot::{Axis, Figure as Drawn, Line, Marker, Panel, Point, Series};
use serde::Deserialize;

use super::{Figure, Law, TargetReport};

/// Name of the file in the folder of the figure.
const FILE: &str = "plot.png";
/// Points of a curve.
const STEPS: usize = 64;
/// Markers in the order of series.
const MARKERS: [Marker; 4] = [Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond];

/// A panel: numbers of a figure against a parameter or against each other.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotEntry {
    /// Words above it.
    #[serde(default)]
    pub title: String,
    /// What the horizontal axis shows, with its unit.
    pub x: String,
    /// What the vertical axis shows, with its unit.
    pub y: String,
    /// Whether the horizontal axis is logarithmic.
    #[serde(default)]
    pub log_x: bool,
    /// Whether the vertical axis is logarithmic.
    #[serde(default)]
    pub log_y: bool,
    /// First and last value of the vertical axis; without it those of the points and a little more.
    #[serde(default)]
    pub y_range: Option<(f64, f64)>,
    /// What is drawn.
    pub series: Vec<PlotSeries>,
}

/// Numbers that belong together, and what they are held against: a dashed line.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotSeries {
    /// Name of our numbers.
    pub name: String,
    /// The points.
    pub points: Vec<PlotPoint>,
    /// The law. Without it and `exponent`, the line joins the published numbers of the targets, as far as
    /// they have some.
    #[serde(default)]
    pub law: Option<Law>,
    /// The exponent of a law that leaves its factor open: the factor is that of our points.
    #[serde(default)]
    pub exponent: Option<f64>,
    /// Name of the law.
    #[serde(default)]
    pub law_name: String,
}

/// Where a target's number stands.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub enum PlotPoint {
    /// The value of the horizontal axis, and the name of the target.
    At(f64, String),
    /// The names of two targets: that of the horizontal axis and that of the vertical one.
    Of(String, String),
}

/// Checks that every point is that of a target and can stand on its axis.
///
/// # Errors
/// A message that names the plot and what is wrong.
pub(super) fn check(figure: &Figure) -> Result<(), String> {
    for entry in &figure.plots {
        let what = |why: String| format!("the plot of {} against {}: {why}", entry.y, entry.x);
        if let Some((low, high)) = entry.y_range
            && !(low < high && high.is_finite() && (!entry.log_y || low > 0.0))
        {
            return Err(what(format!("({low}, {high}) is no range of its axis")));
        }
        for point in entry.series.iter().flat_map(|series| &series.points) {
            let names = match point {
                PlotPoint::At(x, _) if !x.is_finite() || (entry.log_x && *x <= 0.0) => {
                    return Err(what(format!("{x} cannot stand on its axis")));
                }
                PlotPoint::At(_, name) => vec![name],
                PlotPoint::Of(x, y) => vec![x, y],
            };
            let known = |name: &str| figure.targets.iter().any(|target| target.name == name);
            if let Some(name) = names.into_iter().find(|name| !known(name)) {
                return Err(what(format!("no target is called `{name}`")));
            }
        }
        if entry.series.is_empty() || entry.series.iter().any(|series| series.points.is_empty()) {
            return Err(what("a plot wants series, and each of them points".to_owned()));
        }
    }
    Ok(())
}

/// Draws all plots of a figure, panels of one picture, and returns its name in `folder`; `None` when
/// none is asked for.
///
/// # Errors
/// A message when the picture cannot be written.
pub(super) fn write(
    figure: &Figure,
    targets: &[TargetReport],
    folder: &Path,
) -> Result<Option<PathBuf>, String> {
    if figure.plots.is_empty() {
        return Ok(None);
    }
    let panels: Vec<Panel> = figure.plots.iter().map(|entry| entry.panel(targets)).collect();
    let drawn = Drawn { columns: panels.len().min(2), panels, ..Drawn::default() };
    std::fs::create_dir_all(folder)
        .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let title = [("Title", figure.title.as_str())];
    drawn.write(&folder.join(FILE), &title).map_err(|error| error.to_string())?;
    Ok(Some(PathBuf::from(FILE)))
}

impl PlotEntry {
    fn panel(&self, targets: &[TargetReport]) -> Panel {
        let axis = |log: bool, label: &str| match log {
            true => Axis::log(label),
            false => Axis::linear(label),
        };
        let range = self.y_range.map(|(low, high)| [low, high]);
        let series = self.series.iter().enumerate();
        Panel {
            title: self.title.clone(),
            x: axis(self.log_x, &self.x),
            y: Axis { range, ..axis(self.log_y, &self.y) },
            series: series.flat_map(|(index, of)| of.drawn(index, self.log_x, targets)).collect(),
            ..Panel::default()
        }
    }
}

/// A point of a series: our number with the least and the greatest of the seeds, and the published one.
struct Measured {
    x: f64,
    y: f64,
    seeds: [f64; 2],
    published: Option<f64>,
}

impl PlotSeries {
    /// The law, and our points above it.
    fn drawn(&self, index: usize, log_x: bool, targets: &[TargetReport]) -> Vec<Series> {
        let mut measured: Vec<Measured> =
            self.points.iter().filter_map(|point| point.find(targets)).collect();
        measured.sort_by(|one, other| one.x.total_cmp(&other.x));
        let line = Series {
            line: Some(Line::Dashed),
            colour: Some(index),
            ..Series::new(self.law_name.clone(), self.line(&measured, log_x))
        };
        let point = |of: &Measured| {
            let error = (of.seeds[0] < of.seeds[1]).then_some(of.seeds);
            Point { x: of.x, y: of.y, error }
        };
        let ours = Series {
            marker: Some(MARKERS[index % MARKERS.len()]),
            colour: Some(index),
            ..Series::new(self.name.clone(), measured.iter().map(point).collect())
        };
        let is_there = |series: &Series| !series.points.is_empty();
        [line, ours].into_iter().filter(is_there).collect()
    }

    /// What the points are held against, from the first of them to the last.
    fn line(&self, measured: &[Measured], log_x: bool) -> Vec<Point> {
        let places: Vec<[f64; 2]> = measured.iter().map(|of| [of.x, of.y]).collect();
        let law = match (self.law, self.exponent) {
            (None, Some(exponent)) => Law::through(exponent, &places),
            (law, _) => law,
        };
        let Some(law) = law else {
            let point = |of: &Measured| Some(Point::new(of.x, of.published?));
            return measured.iter().filter_map(point).collect();
        };
        let [Some(first), Some(last)] =
            [measured.first(), measured.last()].map(|of| of.map(|of| of.x))
        else {
            return Vec::new();
        };
        let place = |step: usize| {
            let share = step as f64 / STEPS as f64;
            match log_x {
                true => first * (last / first).powf(share),
                false => first + share * (last - first),
            }
        };
        (0..=STEPS).map(place).map(|x| Point::new(x, law.at(x))).collect()
    }
}

impl PlotPoint {
    /// Where it stands; nowhere where data are absent.
    fn find(&self, targets: &[TargetReport]) -> Option<Measured> {
        let of = |name: &str| targets.iter().find(|target| target.name == name);
        let (x, target) = match self {
            Self::At(x, name) => (*x, of(name)?),
            Self::Of(x, name) => (of(x)?.value?, of(name)?),
        };
        let seeds = [f64::INFINITY, f64::NEG_INFINITY];
        let seeds = target.seeds.iter().fold(seeds, |[low, high], &of| [low.min(of), high.max(of)]);
        Some(Measured { x, y: target.value?, seeds, published: target.thesis })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Verdict;

    fn target(name: &str, seeds: &[f64], thesis: Option<f64>) -> TargetReport {
        TargetReport {
            name: name.to_owned(),
            value: seeds.first().copied(),
            seeds: seeds.to_vec(),
            thesis,
            band: String::new(),
            verdict: Verdict::Printed,
            reason: String::new(),
        }
    }

    fn series(points: Vec<PlotPoint>) -> PlotSeries {
        let (name, law_name) = ("ours".to_owned(), "law".to_owned());
        PlotSeries { name, points, law: None, exponent: None, law_name }
    }

    #[test]
    fn points_stand_beside_their_law() {
        let targets = [
            target("a", &[2.0, 1.0, 3.0], Some(2.5)),
            target("b", &[8.0], Some(9.0)),
            target("absent", &[], None),
        ];
        let at = |x: f64, name: &str| PlotPoint::At(x, name.to_owned());
        let points = vec![at(2.0, "b"), at(1.0, "a"), at(3.0, "absent")];
        let drawn = |series: PlotSeries| series.drawn(0, false, &targets);
        let [law, ours] = &drawn(series(points.clone()))[..] else { panic!("two series") };
        assert_eq!(ours.points[0], Point { x: 1.0, y: 2.0, error: Some([1.0, 3.0]) });
        assert_eq!(ours.points[1], Point::new(2.0, 8.0));
        assert_eq!(law.points, [Point::new(1.0, 2.5), Point::new(2.0, 9.0)]);

        let known = PlotSeries { law: Some(Law::Power(3.0, 1.0)), ..series(points.clone()) };
        let curve = &drawn(known)[0].points;
        assert_eq!(
            (curve.len(), curve[0], curve[STEPS]),
            (65, Point::new(1.0, 3.0), Point::new(2.0, 6.0))
        );
        let open = PlotSeries { exponent: Some(2.0), ..series(points) };
        let first = drawn(open)[0].points[0].y;
        assert!((first - 2.0).abs() < 1e-12, "four times as much at twice the place: {first}");

        let both = PlotPoint::Of("a".to_owned(), "b".to_owned());
        assert_eq!(drawn(series(vec![both]))[1].points, [Point::new(2.0, 8.0)]);
        assert!(drawn(series(vec![at(1.0, "absent")])).is_empty());
    }
}
