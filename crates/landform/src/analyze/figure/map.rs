//! The map and the view of a terrain.

use landform_analysis::{LevelSetEdge, level_sets};
use landform_view::perspective::{PerspectiveOptions, render};
use landform_view::plot::{Axis, ColourScale, Line, Panel, Picture, Point, Series};
use landform_view::relief::{ReliefOptions, shaded_relief};
use landform_view::{Image, ViewError};

use super::super::Terrain;
use super::super::table::short;
use super::streams::Streams;
use super::view::Pictured;
use super::{PANEL, PIXELS_PER_UNIT};

/// Colour of cells without data.
const MISSING: [u8; 3] = [205; 3];
/// Number of the colour of water among those of plots.
const WATER: usize = 5;
/// Number of the colour of shores.
const SHORE: usize = 6;

/// The map: relief, streams and the shore, with axes in kilometres.
pub(super) fn map(
    terrain: &Terrain,
    pictured: &Pictured,
    streams: &Streams,
) -> Result<Panel, ViewError> {
    let mut options = ReliefOptions::new(pictured.ground()?);
    options.vertical_exaggeration = pictured.exaggeration();
    let longest = pictured.size[0].max(pictured.size[1]) as f64;
    options.pixels_per_node = (MAP_PIXELS / longest).clamp(1.0, 16.0);
    let mut image = shaded_relief(&pictured.field()?, &options)?;
    grey_gaps(&mut image, pictured);
    let grid = &terrain.grid;
    let side_km = |cells: usize, metres: f64| cells as f64 * metres / 1000.0;
    let [width, height] = grid.cell_size();
    let x = [0.0, side_km(grid.columns(), width)];
    let y = [0.0, side_km(grid.rows(), height)];
    let mut series =
        vec![water(&streams.brooks, terrain, 0.8), water(&streams.rivers, terrain, 1.8)];
    if pictured.sea {
        series.push(shore(pictured));
    }
    series.retain(|series| !series.points.is_empty());
    let label = format!("height ({})", terrain.unit.as_deref().unwrap_or("m"));
    Ok(Panel {
        title: "map".to_owned(),
        x: Axis { range: Some(x), ..Axis::linear("km from the western edge") },
        y: Axis { range: Some(y), ..Axis::linear("km from the southern edge") },
        picture: Some(Picture { image, x, y }),
        colours: Some(ColourScale { ground: pictured.ground()?, range: pictured.range_m, label }),
        series,
        caption: caption(streams, pictured.sea),
        exaggeration: Some(1.0),
        ..Panel::default()
    })
}

/// What the lines of the map are.
fn caption(streams: &Streams, sea: bool) -> String {
    let [brook, river] = Streams::SHARES.map(|share| short(100.0 * share));
    let streams = match streams.brooks.is_empty() && streams.rivers.is_empty() {
        true => String::new(),
        false => format!("streams of {brook} and {river} % of the area"),
    };
    let shore = if sea { "shore at 0 m" } else { "" };
    let parts = [streams.as_str(), shore];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
}

/// Pixels of the longer side of a map, about.
const MAP_PIXELS: f64 = 800.0;

/// The view: a block under a low sun.
pub(super) fn view(pictured: &Pictured) -> Result<Panel, ViewError> {
    let exaggeration = pictured.exaggeration();
    let mut options = PerspectiveOptions::new(pictured.ground()?);
    let room = [PANEL[0] - 28.0, PANEL[1] - 64.0];
    options.size = room.map(|side| (side * PIXELS_PER_UNIT) as usize);
    options.vertical_exaggeration = exaggeration;
    options.pitch_deg = 38.0;
    options.sky = [[255; 3]; 2];
    options.haze = 0.0;
    let image = render(&pictured.field()?, &options)?;
    let [x, y] = [[0.0, room[0]], [0.0, room[1]]];
    let mut caption = match exaggeration {
        1.0 => "looking north-east, heights as they are".to_owned(),
        factor => format!("looking north-east, heights × {}", short(factor)),
    };
    if pictured.known.contains(&false) {
        caption += ", gaps lowered";
    }
    Ok(Panel {
        title: "view".to_owned(),
        x: Axis { range: Some(x), ..Axis::default() },
        y: Axis { range: Some(y), ..Axis::default() },
        picture: Some(Picture { image, x, y }),
        caption,
        bare: true,
        ..Panel::default()
    })
}

/// Covers what has no data.
fn grey_gaps(image: &mut Image, pictured: &Pictured) {
    let [columns, rows] = pictured.size;
    let (width, height) = (image.width, image.height);
    for (index, pixel) in image.rgb.iter_mut().enumerate() {
        let (column, row) = (index % width * columns / width, index / width * rows / height);
        if !pictured.known[column + columns * row] {
            *pixel = MISSING;
        }
    }
}

/// Streams as a series.
fn water(lines: &[Vec<[f64; 2]>], terrain: &Terrain, width: f64) -> Series {
    let points = points(lines, terrain.grid.rows(), terrain.grid.cell_size());
    let (line, colour, width) = (Some(Line::Solid), Some(WATER), Some(width));
    Series { line, colour, width, ..Series::new("", points) }
}

/// The line at sea level, as fine as the picture.
fn shore(pictured: &Pictured) -> Series {
    let heights = pictured.with_gaps();
    let lines = level_sets(&heights, pictured.size, 0.0, LevelSetEdge::End).unwrap_or_default();
    let lines: Vec<Vec<[f64; 2]>> = lines.into_iter().map(|line| line.points).collect();
    let points = points(&lines, pictured.size[1], [pictured.spacing_m; 2]);
    let (line, colour, width) = (Some(Line::Solid), Some(SHORE), Some(0.9));
    Series { line, colour, width, ..Series::new("", points) }
}

/// Points of all lines of cells, in kilometres from the south-western corner, parted by points that
/// break the line.
fn points(lines: &[Vec<[f64; 2]>], rows: usize, [width, height]: [f64; 2]) -> Vec<Point> {
    let rows = rows as f64;
    let place = |&[column, row]: &[f64; 2]| {
        let (x, y) = ((column + 0.5) * width, (rows - row - 0.5) * height);
        Point::new(x / 1000.0, y / 1000.0)
    };
    let gap = || std::iter::once(Point::new(f64::NAN, f64::NAN));
    lines.iter().flat_map(|line| line.iter().map(place).chain(gap())).collect()
}
