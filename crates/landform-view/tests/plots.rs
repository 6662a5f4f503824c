//! Plots as users make them: what is drawn, and that both kinds of file show it.

use landform_view::plot::{Axis, Figure, Line, Marker, Note, Panel, Point, Rule, Series};
use landform_view::{Image, ViewError};

/// Four panels with everything that a panel can hold.
fn figure() -> Figure {
    let powers = |slope: f64| {
        (0..=40)
            .map(move |i| 10.0_f64.powf(f64::from(i) / 10.0 - 1.0))
            .map(move |x| Point::new(x, x.powf(slope)))
    };
    let spectrum = Panel {
        title: "spectrum".to_owned(),
        x: Axis::log("wavenumber (1/m)"),
        y: Axis::log("density (m³)"),
        series: vec![
            Series {
                marker: Some(Marker::Dot),
                ..Series::new(
                    "measured",
                    powers(-1.8)
                        .map(|p| Point::new(p.x, p.y * (1.0 + 0.5 * (p.x * 9.0).sin())))
                        .collect(),
                )
            },
            Series { line: Some(Line::Dashed), ..Series::new("β = 1.8", powers(-1.8).collect()) },
        ],
        notes: vec![Note { at: [1.0, 10.0], text: "β = 1.80 ± 0.02".to_owned() }],
        ..Panel::default()
    };
    let hypsometry = Panel {
        title: "hypsometry".to_owned(),
        x: Axis { range: Some([0.0, 1.0]), ..Axis::linear("a/A") },
        y: Axis { range: Some([0.0, 1.0]), ..Axis::linear("h/H") },
        series: vec![Series {
            line: Some(Line::Solid),
            ..Series::new(
                "",
                (0..=50)
                    .map(|i| f64::from(i) / 50.0)
                    .map(|x| Point::new(x, (1.0 - x).powi(2)))
                    .collect(),
            )
        }],
        rules: vec![Rule::Horizontal(0.5), Rule::Vertical(0.5)],
        ..Panel::default()
    };
    let marker = [Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond];
    let sweep = (0..4)
        .map(|group| Series {
            line: Some(Line::Dotted),
            marker: Some(marker[group]),
            ..Series::new(
                format!("wind {group}"),
                (1..6)
                    .map(|x| {
                        let y = f64::from(x) * (1.0 + group as f64) * 20.0;
                        Point { error: Some([0.9 * y, 1.15 * y]), ..Point::new(f64::from(x), y) }
                    })
                    .collect(),
            )
        })
        .collect();
    let sweep = Panel {
        title: "sweep".to_owned(),
        x: Axis::linear("slab (m)"),
        y: Axis::linear("crest spacing (m)"),
        series: sweep,
        ..Panel::default()
    };
    let names = ["Shadow", "Protection", "None"].map(str::to_owned).to_vec();
    let named = Panel {
        title: "names".to_owned(),
        x: Axis { names, ..Axis::linear("shelter") },
        y: Axis::linear("near repose (%)"),
        series: vec![Series {
            marker: Some(Marker::Disc),
            ..Series::new(
                "",
                vec![
                    Point::new(0.0, 9.2),
                    Point::new(1.0, 39.0),
                    Point::new(2.0, 1e-2),
                    Point::new(f64::NAN, 1.0),
                ],
            )
        }],
        ..Panel::default()
    };
    Figure {
        title: "Everything a plot can hold".to_owned(),
        panels: vec![spectrum, hypsometry, sweep, named],
        ..Figure::default()
    }
}

/// A panel of fixed ranges with one series, without words beside its axes.
fn panel(scale: fn(&'static str) -> Axis, range: [f64; 2], series: Series) -> Panel {
    let axis = || Axis { range: Some(range), ..scale("") };
    Panel { x: axis(), y: axis(), series: vec![series], ..Panel::default() }
}

/// The columns and rows of the pixels of a colour: their middle and their number.
fn found(image: &Image, colour: [u8; 3]) -> ([f64; 2], usize) {
    let places = (0..image.rgb.len()).filter(|&at| image.rgb[at] == colour);
    let (mut sum, mut count) = ([0.0; 2], 0);
    for at in places {
        sum = [sum[0] + (at % image.width) as f64, sum[1] + (at / image.width) as f64];
        count += 1;
    }
    (sum.map(|sum| sum / count as f64 + 0.5), count)
}

/// The corners of the plot of a figure with one panel, from the frame in the SVG.
fn frame(svg: &str) -> [[f64; 2]; 2] {
    let rect = svg.split("<clipPath").nth(1).expect("a plot is cut");
    let value = |key: &str| -> f64 {
        let rest = rect.split(&format!(" {key}=\"")).nth(1).expect("a rectangle");
        rest.split('"').next().expect("a value").parse().expect("a number")
    };
    let (x, y) = (value("x"), value("y"));
    [[x, y], [x + value("width"), y + value("height")]]
}

#[test]
fn points_stand_where_their_axes_say() {
    for (scale, range, at) in [
        (Axis::linear as fn(&'static str) -> Axis, [0.0, 10.0], [7.5, 2.5]),
        (Axis::log, [1.0, 1e4], [1e3, 10.0]),
    ] {
        let point = vec![Point::new(at[0], at[1])];
        let series = Series { marker: Some(Marker::Disc), ..Series::new("", point) };
        let figure = Figure { panels: vec![panel(scale, range, series)], ..Figure::default() };
        let [[left, top], [right, bottom]] = frame(&figure.svg().unwrap());
        let expected = [left + 0.75 * (right - left), bottom - 0.25 * (bottom - top)];
        let (middle, count) = found(&figure.image().unwrap(), [0, 114, 178]);
        assert!(count > 100, "{count} pixels");
        for (middle, expected) in middle.iter().zip(expected) {
            assert!((middle / 2.0 - expected).abs() < 0.3, "{middle} {expected}");
        }
    }
}

#[test]
fn lines_break_at_what_cannot_be_drawn() {
    let points = [0.0, 1.0, f64::NAN, 2.0, 3.0, f64::INFINITY, 4.0].map(|x| Point::new(x, x));
    let series = Series { line: Some(Line::Solid), ..Series::new("", points.to_vec()) };
    let colour = "stroke=\"#0072b2\"";
    let drawn = |panel: Panel| {
        let svg = Figure { panels: vec![panel], ..Figure::default() }.svg().unwrap();
        svg.matches(colour).count()
    };
    assert_eq!(drawn(panel(Axis::linear, [0.0, 5.0], series.clone())), 2);
    let mut logarithmic = panel(Axis::log, [0.1, 5.0], series);
    logarithmic.series[0].points[1].y = -1.0;
    assert_eq!(drawn(logarithmic), 1);
}

#[test]
fn what_lies_outside_is_cut_off() {
    let series = Series {
        line: Some(Line::Solid),
        ..Series::new("", vec![Point::new(-50.0, -50.0), Point::new(50.0, 50.0)])
    };
    let panel = panel(Axis::linear, [0.0, 1.0], series);
    let figure = Figure { panels: vec![panel], pixels_per_unit: 1.0, ..Figure::default() };
    let [[left, top], [right, bottom]] = frame(&figure.svg().unwrap());
    let image = figure.image().unwrap();
    for (index, pixel) in
        image.rgb.iter().enumerate().filter(|(_, p)| p[2] > p[0].saturating_add(60))
    {
        let [x, y] = [(index % image.width) as f64, (index / image.width) as f64];
        let inside = x >= left - 1.0 && x <= right && y >= top - 1.0 && y <= bottom;
        assert!(inside, "ink {pixel:?} at {x}, {y}");
    }
}

#[test]
fn both_files_have_every_part_and_the_same_bytes_each_time() {
    let figure = figure();
    let svg = figure.svg().unwrap();
    for words in [
        "Everything a plot can hold",
        "(d) names",
        "wavenumber (1/m)",
        "10⁻⁴",
        "Shadow",
        "β = 1.80 ± 0.02",
        "wind 3",
    ] {
        assert!(svg.contains(&format!(">{words}</text>")), "{words}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    assert_eq!(svg, figure.svg().unwrap());
    let image = figure.image().unwrap();
    assert_eq!([image.width, image.height], [1920, 1416]);
    assert!(image == figure.image().unwrap());
    for colour in [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167]] {
        assert!(found(&image, colour).1 > 50, "{colour:?}");
    }
}

#[test]
fn extreme_values_are_drawn_or_left_out() {
    for values in [&[1e308, -1e308][..], &[1e-320, 2e-320], &[f64::MAX; 3], &[0.0], &[]] {
        for scale in [Axis::linear as fn(&'static str) -> Axis, Axis::log] {
            let points = values.iter().map(|&value| Point {
                error: Some([-f64::MAX, f64::MAX]),
                ..Point::new(value, value)
            });
            let series = Series {
                line: Some(Line::Dashed),
                marker: Some(Marker::Dot),
                ..Series::new("series", points.collect())
            };
            let panel =
                Panel { x: scale("x"), y: scale("y"), series: vec![series], ..Panel::default() };
            let figure = Figure { panels: vec![panel], pixels_per_unit: 0.5, ..Figure::default() };
            assert!(figure.image().is_ok());
            let svg: Result<String, ViewError> = figure.svg();
            assert!(!svg.unwrap().contains("NaN"), "{values:?}");
        }
    }
}
