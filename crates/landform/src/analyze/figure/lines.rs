//! The figure of lines: map, Richardson plot and box plot.

use landform_analysis::{Dimension, ScalePoint, on_plane};
use landform_view::plot::{Axis, Figure, Line, Marker, Panel, Point, Series};

use super::super::lines::LineAnalysis;
use super::super::table::short;
use super::{PANEL, PIXELS_PER_UNIT, empty, title};

/// Draws the map, the length by dividers and the number of boxes.
pub(in crate::analyze) fn figure(analysis: &LineAnalysis) -> Figure {
    let numbers = &analysis.numbers;
    let reason = "see the notes of the analysis";
    let divider = numbers.divider.as_ref().map(richardson);
    let boxes = numbers.boxes.as_ref().map(boxes);
    Figure {
        title: title(&numbers.file),
        panels: vec![
            map(analysis),
            divider.unwrap_or_else(|| empty("length by dividers", reason)),
            boxes.unwrap_or_else(|| empty("boxes", reason)),
        ],
        columns: 3,
        panel_size: PANEL,
        pixels_per_unit: PIXELS_PER_UNIT,
    }
}

/// The lines on a plane, in kilometres.
fn map(analysis: &LineAnalysis) -> Panel {
    let mut lines = on_plane(&analysis.lines);
    let finest = extent(&lines) / FINEST;
    lines.iter_mut().for_each(|line| thin(line, finest));
    let place = |&[x, y]: &[f64; 2]| Point::new(x / 1000.0, y / 1000.0);
    let gap = || std::iter::once(Point::new(f64::NAN, f64::NAN));
    let points: Vec<Point> =
        lines.iter().flat_map(|line| line.iter().map(place).chain(gap())).collect();
    let most =
        |axis: usize| lines.iter().flatten().map(|point| point[axis] / 1000.0).fold(0.0, f64::max);
    let margin = 0.04 * most(0).max(most(1));
    let axis = |label: &str, axis: usize| Axis {
        range: Some([-margin, most(axis) + margin]),
        ..Axis::linear(label)
    };
    let line = Series { line: Some(Line::Solid), width: Some(0.7), ..Series::new("", points) };
    let projection = match analysis.numbers.geographic {
        true => "equal-area projection, ",
        false => "",
    };
    Panel {
        title: "map".to_owned(),
        x: axis("km from the western end", 0),
        y: axis("km from the southern end", 1),
        series: vec![line],
        caption: format!("{projection}{} km long", short(analysis.numbers.length_m / 1000.0)),
        exaggeration: Some(1.0),
        ..Panel::default()
    }
}

/// Points of a map that are nearer to each other than this part of its extent are one.
const FINEST: f64 = 5000.0;

/// The longer side of lines whose least coordinates are 0.
fn extent(lines: &[Vec<[f64; 2]>]) -> f64 {
    lines.iter().flatten().flatten().copied().fold(0.0, f64::max)
}

/// Leaves out points nearer than `finest` to the last one that stays, but for the first and the
/// last of the line.
fn thin(line: &mut Vec<[f64; 2]>, finest: f64) {
    let (Some(&first), Some(&last)) = (line.first(), line.last()) else { return };
    let mut kept = first;
    line.retain(|&[x, y]| {
        let stays = [x, y] == first || (x - kept[0]).hypot(y - kept[1]) >= finest;
        if stays {
            kept = [x, y];
        }
        stays
    });
    if kept != last {
        line.push(last);
    }
}

/// Length in kilometres over the ruler: falls as ruler^(1 - D).
fn richardson(found: &Dimension) -> Panel {
    let length = |point: &ScalePoint| point.measure * point.scale_m / 1000.0;
    Panel {
        title: "length by dividers".to_owned(),
        x: Axis::log("ruler (km)"),
        y: Axis::log("length (km)"),
        ..law(found, length, 1.0 - found.dimension)
    }
}

/// Number of boxes over their side: falls as side^-D.
fn boxes(found: &Dimension) -> Panel {
    Panel {
        title: "boxes".to_owned(),
        x: Axis::log("side of the boxes (km)"),
        y: Axis::log("number of boxes"),
        ..law(found, |point| point.measure, -found.dimension)
    }
}

/// Measured points with the line of a slope through their middle.
fn law(found: &Dimension, measure: impl Fn(&ScalePoint) -> f64, slope: f64) -> Panel {
    let points: Vec<[f64; 2]> =
        found.scales.iter().map(|point| [point.scale_m / 1000.0, measure(point)]).collect();
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis].ln()).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let fitted = |point: &[f64; 2]| Point::new(point[0], (y + slope * (point[0].ln() - x)).exp());
    let fit: Vec<Point> =
        [points.first(), points.last()].into_iter().flatten().map(fitted).collect();
    let measured = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
    let name = format!("slope {slope:.3}").replace('-', "\u{2212}");
    Panel {
        series: vec![
            Series { marker: Some(Marker::Disc), ..Series::new("measured", measured) },
            Series { line: Some(Line::Dashed), ..Series::new(name, fit) },
        ],
        caption: format!("D = {:.3} ± {:.3}", found.dimension, found.error),
        ..Panel::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_a_map_cannot_tell_apart_are_one() {
        let mut line: Vec<[f64; 2]> = (0..=1000).map(|x| [f64::from(x), 0.0]).collect();
        thin(&mut line, 99.5);
        assert_eq!(line, (0..=10).map(|x| [100.0 * f64::from(x), 0.0]).collect::<Vec<_>>());
        let mut line = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
        thin(&mut line, 50.0);
        assert_eq!(line, [[0.0, 0.0], [2.0, 0.0]], "the ends stay");
    }
}
