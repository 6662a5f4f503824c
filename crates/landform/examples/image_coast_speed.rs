//! Figures B.5 and B.7 of the thesis: what image coasts take on maps of 128 to 1024 nodes a side
//! (table B.1), on this machine. `cargo run --release -p landform --example image_coast_speed`
//! writes `image_coast_speed.png`; with `--features gpu` a graphics processor is timed too.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use landform::coast::image::{ImageCoast, ImageCoastSettings};
use landform::sim::random::RandomStream;
use landform::view::plot::{Axis, Figure, Line, Marker, Panel, Point, Series};

/// Side of the map, attenuation and offset.
const WORKLOADS: [(usize, f64, u32); 4] =
    [(128, 0.230, 2), (256, 0.175, 2), (512, 0.150, 2), (1024, 0.147, 3)];

/// Iterations of a run that is cut short.
const FIRST: usize = 100;

/// What runs on one kind of device took, by the size of the map.
struct Times {
    device: String,
    whole: Vec<f64>,
    first: Vec<f64>,
}

/// A way to run a coast: `run(land, most)` erodes land for so many iterations at most, and gives
/// their number.
type Run<'a> = &'a mut dyn FnMut(&mut [u8], usize) -> Result<usize, Box<dyn Error>>;

impl Times {
    fn new(device: impl Into<String>) -> Self {
        Self { device: device.into(), whole: Vec::new(), first: Vec::new() }
    }

    /// Times a coast to rest and its first iterations. Returns how many it took to rest.
    fn time(&mut self, land: &[u8], run: Run<'_>) -> Result<usize, Box<dyn Error>> {
        let mut seconds = |most| -> Result<(f64, usize), Box<dyn Error>> {
            let mut land = land.to_vec();
            let start = Instant::now();
            let iterations = run(&mut land, most)?;
            Ok((start.elapsed().as_secs_f64(), iterations))
        };
        let (whole, iterations) = seconds(usize::MAX)?;
        self.whole.push(whole);
        // A coast that rests earlier would do the same for the rest of them.
        let (first, done) = seconds(FIRST)?;
        self.first.push(first * FIRST as f64 / done.max(1) as f64);
        Ok(iterations)
    }
}

/// A panel over the size of the map.
fn panel(title: &str, label: &str, lines: &[(&str, &[f64])]) -> Panel {
    let series = |&(name, values): &(&str, &[f64])| {
        let points = WORKLOADS.iter().zip(values);
        let points = points.map(|(&(side, ..), &value)| Point::new(side as f64, value));
        Series {
            line: Some(Line::Solid),
            marker: Some(Marker::Disc),
            ..Series::new(name, points.collect())
        }
    };
    Panel {
        title: title.to_owned(),
        x: Axis::log("nodes along a side"),
        y: Axis::log(label),
        series: lines.iter().map(series).collect(),
        ..Panel::default()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut all = Vec::from([Times::new("processor")]);
    let mut iterations = Vec::new();
    for (side, attenuation, offset) in WORKLOADS {
        let settings = ImageCoastSettings { attenuation, offset, ..ImageCoastSettings::default() };
        let (size, random) = ([side; 2], RandomStream::new(1, "rock"));
        let rock: Vec<f64> = (0..side * side).map(|node| random.unit(0, node, 0)).collect();
        let inside = |at: usize| (side / 16..side - side / 16).contains(&at);
        let island = |node: usize| u8::from(inside(node % side) && inside(node / side));
        let land: Vec<u8> = (0..side * side).map(island).collect();
        let mut coast = ImageCoast::new(size, settings, &rock)?;
        let taken = all[0].time(&land, &mut |land, most| Ok(coast.run(land, most)?))?;
        iterations.push(taken as f64);
        #[cfg(feature = "gpu")]
        {
            let mut coast = landform::coast::image::GpuCoast::new(size, settings, &rock)?;
            if all.len() == 1 {
                all.push(Times::new(coast.device()));
            }
            all[1].time(&land, &mut |land, most| Ok(coast.run(land, most)?))?;
        }
    }
    let of = |values: fn(&Times) -> &[f64]| -> Vec<(&str, &[f64])> {
        all.iter().map(|times| (times.device.as_str(), values(times))).collect()
    };
    let figure = Figure {
        title: "Image coasts: time to rest, iterations, time of the first 100".to_owned(),
        panels: vec![
            panel("to rest", "seconds", &of(|times| &times.whole)),
            panel("to rest", "iterations", &[("", &iterations)]),
            panel("first 100 iterations", "seconds", &of(|times| &times.first)),
        ],
        columns: 3,
        panel_size: [400.0, 320.0],
        pixels_per_unit: 1.0,
    };
    let path = Path::new("image_coast_speed.png");
    figure.write(path, &[("Title", &figure.title)])?;
    println!("{}", path.display());
    Ok(())
}
