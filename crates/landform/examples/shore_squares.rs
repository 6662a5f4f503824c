//! Figure B.2 of the thesis: how the shore runs through squares of 2 x 2 pixels, and a map that it
//! divides. `cargo run --release -p landform --example shore_squares` writes `shore_squares.png`.

use std::error::Error;
use std::path::Path;

use landform::coast::image::numbers::shore_pieces;
use landform::view::Image;
use landform::view::plot::{Axis, Figure, Panel, Picture};

const SEA: [u8; 3] = [168, 200, 220];
const LAND: [u8; 3] = [232, 212, 170];
const SHORE: [u8; 3] = [40, 40, 60];

/// The shore through a square: ends of its pieces, on the sides of the square, whose corners are
/// the middles of its pixels: north-west, north-east, south-west, south-east.
fn pieces(square: [u8; 4]) -> Vec<[[f64; 2]; 2]> {
    let [nw, ne, sw, se] = square;
    let [north, east, south, west] = [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]];
    // A piece cuts off each corner that differs from both corners beside it.
    let corners = [(nw, ne, sw, west, north), (ne, nw, se, north, east)];
    let corners = corners.into_iter().chain([(sw, nw, se, west, south), (se, ne, sw, south, east)]);
    let cut = corners.filter(|&(own, a, b, ..)| own != a && own != b);
    let cut: Vec<_> = cut.map(|(.., from, to)| [from, to]).collect();
    match (cut.len(), nw == ne, nw == sw) {
        // Of four corners, two that lie across are cut off.
        (4, ..) if nw == 1 => vec![cut[0], cut[3]],
        (4, ..) => vec![cut[1], cut[2]],
        (0, true, false) => vec![[west, east]],
        (0, false, true) => vec![[north, south]],
        _ => cut,
    }
}

/// Width of a pixel of a map in those of the picture.
const WIDTH: usize = 40;

/// A map of rows of pixels, 1 on land, with its shore.
fn map(title: String, rows: &[&[u8]]) -> Result<Panel, Box<dyn Error>> {
    let (width, height) = (rows[0].len(), rows.len());
    let mut shore = Vec::new();
    for y in 0..height - 1 {
        for x in 0..width - 1 {
            let square = [rows[y][x], rows[y][x + 1], rows[y + 1][x], rows[y + 1][x + 1]];
            let found = pieces(square);
            let [straight, corners] = shore_pieces(square);
            if found.len() as u32 != straight + corners {
                return Err(format!("{square:?} has other pieces in the model").into());
            }
            let place = |[east, south]: [f64; 2]| [x as f64 + 0.5 + east, y as f64 + 0.5 + south];
            shore.extend(found.into_iter().map(|ends| ends.map(place)));
        }
    }
    let size = [width, height].map(|pixels| pixels * WIDTH);
    let colour = |pixel: usize| {
        let [x, y] = [pixel % size[0], pixel / size[0]];
        let place = [x, y].map(|at| (at as f64 + 0.5) / WIDTH as f64);
        match rows[y / WIDTH][x / WIDTH] {
            _ if shore.iter().any(|piece| distance(place, *piece) < 0.04) => SHORE,
            1 => LAND,
            _ => SEA,
        }
    };
    let rgb = (0..size[0] * size[1]).map(colour).collect();
    let axis = |length: usize| Axis { range: Some([0.0, length as f64]), ..Axis::linear("") };
    let picture = Picture {
        image: Image { width: size[0], height: size[1], rgb },
        x: [0.0, width as f64],
        y: [0.0, height as f64],
    };
    Ok(Panel {
        title,
        x: axis(width),
        y: axis(height),
        picture: Some(picture),
        exaggeration: Some(1.0),
        bare: true,
        ..Panel::default()
    })
}

/// Distance of a place from a piece of shore.
fn distance([x, y]: [f64; 2], [from, to]: [[f64; 2]; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let way = [x - from[0], y - from[1]];
    let share = (way[0] * along[0] + way[1] * along[1]) / (along[0].powi(2) + along[1].powi(2));
    let share = share.clamp(0.0, 1.0);
    (way[0] - share * along[0]).hypot(way[1] - share * along[1])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut panels = Vec::new();
    for case in 0..16_u8 {
        let [nw, ne, sw, se] = [3, 2, 1, 0].map(|bit| case >> bit & 1);
        let name = match shore_pieces([nw, ne, sw, se]) {
            [0, 0] => "none",
            [1, _] => "1",
            [_, 1] => "1/√2",
            _ => "2/√2",
        };
        panels.push(map(format!("{case:04b}: {name}"), &[&[nw, ne], &[sw, se]])?);
    }
    panels.push(map("3 x 3".to_owned(), &[&[0, 0, 1], &[0, 1, 1], &[0, 0, 1]])?);
    panels.push(map(
        "a map".to_owned(),
        &[
            &[0, 0, 0, 0, 0, 0, 0, 0],
            &[0, 1, 1, 0, 0, 1, 0, 0],
            &[0, 1, 1, 1, 1, 1, 1, 0],
            &[0, 0, 1, 1, 0, 1, 1, 0],
            &[0, 1, 1, 1, 1, 1, 0, 0],
            &[0, 0, 0, 1, 1, 0, 0, 0],
            &[0, 1, 0, 0, 1, 0, 1, 0],
            &[0, 0, 0, 0, 0, 0, 0, 0],
        ],
    )?);
    let figure = Figure {
        title: "Shore in squares of 2 x 2 pixels, and its length in spacings".to_owned(),
        panels,
        columns: 6,
        panel_size: [150.0, 170.0],
        pixels_per_unit: 1.0,
    };
    let path = Path::new("shore_squares.png");
    figure.write(path, &[("Title", &figure.title)])?;
    println!("{}", path.display());
    Ok(())
}
