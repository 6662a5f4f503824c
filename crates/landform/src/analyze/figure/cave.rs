//! The figure of a cave: plan, elevations, and its measures beside those of surveyed caves.

use landform_view::plot::{Axis, Figure, Line, Marker, Note, Panel, Point, Series};

use super::super::cave::{Beside, CaveAnalysis};
use super::super::table::short;
use super::{PANEL, PIXELS_PER_UNIT, title};

/// Draws the plan and the elevations from the south and from the east, and the measures.
pub(in crate::analyze) fn figure(analysis: &CaveAnalysis) -> Figure {
    let names = ["m from the western end", "m from the southern end", "m from below"];
    let length = format!("{} m long", short(analysis.numbers.shape.length_m));
    Figure {
        title: title(&analysis.numbers.file),
        panels: vec![
            view(analysis, "plan", [0, 1], names, length),
            view(analysis, "elevation from the south", [0, 2], names, String::new()),
            view(analysis, "elevation from the east", [1, 2], names, String::new()),
            measures(analysis),
        ],
        columns: 2,
        panel_size: PANEL,
        pixels_per_unit: PIXELS_PER_UNIT,
    }
}

/// The legs seen along an axis.
fn view(
    analysis: &CaveAnalysis,
    name: &str,
    axes: [usize; 2],
    names: [&str; 3],
    caption: String,
) -> Panel {
    let network = &analysis.network;
    let least = [0, 1, 2].map(|axis| {
        network.stations().iter().map(|station| station[axis]).fold(f64::INFINITY, f64::min)
    });
    let place = |station: usize| axes.map(|axis| network.stations()[station][axis] - least[axis]);
    let point = |station: usize| Point::new(place(station)[0], place(station)[1]);
    let gap = Point::new(f64::NAN, f64::NAN);
    let legs = network.legs().iter().flat_map(|&[from, to]| [point(from), point(to), gap]);
    let series = Series {
        line: Some(Line::Solid),
        width: Some(0.8),
        ..Series::new("", legs.collect::<Vec<_>>())
    };
    let most = |index: usize| {
        (0..network.stations().len()).map(|station| place(station)[index]).fold(0.0, f64::max)
    };
    let margin = 0.04 * most(0).max(most(1));
    let axis = |index: usize| Axis {
        range: Some([-margin, most(index) + margin]),
        ..Axis::linear(names[axes[index]])
    };
    let [x, y] = [axis(0), axis(1)];
    Panel {
        title: name.to_owned(),
        x,
        y,
        series: vec![series],
        caption,
        exaggeration: Some(1.0),
        ..Panel::default()
    }
}

/// Where each measure lies in its range over surveyed caves: 0 at the least, 1 at the greatest; what
/// lies far outside is drawn at the edge.
fn measures(analysis: &CaveAnalysis) -> Panel {
    const SIDES: [f64; 2] = [-0.4, 1.4];
    let observed = &analysis.numbers.observed;
    let rows = || (1..).map(f64::from).zip(observed);
    let points = rows().filter_map(|(row, beside)| {
        let [least, most] = beside.range;
        let place = (beside.value? - least) / (most - least);
        Some(Point::new(place.clamp(SIDES[0], SIDES[1]), row))
    });
    let last = observed.len() as f64 + 0.5;
    let edge = |x: f64| {
        let ends = vec![Point::new(x, 0.5), Point::new(x, last)];
        Series { line: Some(Line::Dashed), ..Series::new("", ends) }
    };
    let measured = Series { marker: Some(Marker::Disc), ..Series::new("", points.collect()) };
    let name = |(row, beside): (f64, &Beside)| Note {
        at: [SIDES[0] - 1.2, row],
        text: beside.name.trim_end_matches("_m").replace('_', " "),
    };
    Panel {
        title: "beside surveyed caves".to_owned(),
        x: Axis {
            range: Some([SIDES[0] - 1.25, SIDES[1] + 0.1]),
            ..Axis::linear("0: least of 31 caves, 1: greatest")
        },
        y: Axis { range: Some([0.5, last]), ..Axis::linear("") },
        series: vec![edge(0.0), edge(1.0), measured],
        notes: rows().map(name).collect(),
        ..Panel::default()
    }
}
