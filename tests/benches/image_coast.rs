//! Coasts as images: what an iteration and a run to rest cost, beside a bound, the coast that
//! follows its agents, and a graphics processor.
//!
//! The workloads are those of table B.1 of the thesis: a square of random rock with f = 0.5.
//!
//! - `an iteration`: a pixel of a whole run, against a plain loop that looks at each square of 2 x 2
//!   pixels once. An iteration copies the land, looks at its squares, and looks at its pixels;
//! - `a run`: to rest, against the run of `Coast` with the shore within 20 nodes (g = 0.2);
//! - `literal`: the reference, at 128 x 128;
//! - `figure B.7` and, with the feature `gpu`, `figure B.5`: milliseconds by the clock on the wall
//!   of a run to rest and of its first 100 iterations, on one thread and on the device.

mod measure;

use std::hint::black_box;
use std::time::Instant;

use landform::coast::coast::{Coast, CoastSettings, Perimeter};
use landform::coast::image::{ImageCoast, ImageCoastSettings, numbers, reference};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::sim::random::RandomStream;
use measure::{Effort, pairs, table};

/// Side of the map, attenuation and offset (thesis, table B.1).
const WORKLOADS: [(usize, f64, u32); 4] =
    [(128, 0.230, 2), (256, 0.175, 2), (512, 0.150, 2), (1024, 0.147, 3)];

fn main() {
    table("Coasts as images", |effort| {
        let workloads = &WORKLOADS[..if effort == Effort::Quick { 2 } else { 4 }];
        for &workload in workloads {
            against_bounds(effort, &Island::new(workload));
        }
        literal(effort);
        println!(
            "\n{:<20} {:>12} {:>12} {:>12}  milliseconds",
            "", "iterations", "to rest", "first 100"
        );
        for &workload in workloads {
            walls(effort, &Island::new(workload));
        }
    });
}

/// A square of land of random rock.
struct Island {
    side: usize,
    settings: ImageCoastSettings,
    land: Vec<u8>,
    rock: Vec<f64>,
}

impl Island {
    fn new((side, attenuation, offset): (usize, f64, u32)) -> Self {
        let inside = |at: usize| (side / 16..side - side / 16).contains(&at);
        let nodes = side * side;
        let random = RandomStream::new(1, "rock");
        Self {
            side,
            settings: ImageCoastSettings { attenuation, offset, ..ImageCoastSettings::default() },
            land: (0..nodes).map(|n| u8::from(inside(n % side) && inside(n / side))).collect(),
            rock: (0..nodes).map(|node| random.unit(0, node, 0)).collect(),
        }
    }

    fn size(&self) -> [usize; 2] {
        [self.side; 2]
    }

    fn image_coast(&self) -> ImageCoast {
        ImageCoast::new(self.size(), self.settings, &self.rock).expect("a coast")
    }

    /// Erodes a copy until it rests, and gives the number of iterations.
    fn erode(&self) -> usize {
        self.image_coast().run(&mut self.land.clone(), usize::MAX).expect("a run")
    }

    /// Erodes a copy by the coast that follows its agents.
    fn erode_near(&self) {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane(self.size(), 1.0, Connectivity::Four, open);
        let settings = CoastSettings {
            force: 0.5,
            attenuation: 0.2,
            perimeter: Perimeter::Near { radius_m: 20.0 },
            ..CoastSettings::default()
        };
        let (mut land, mut rock) = (self.land.clone(), self.rock.clone());
        let coast = Coast::new(&lattice.expect("a lattice"), settings, &land, &rock);
        let mut coast = coast.expect("a coast");
        let initial = coast.shore().total();
        while !coast.step(&mut land, &mut rock, initial).expect("a step").eroded.is_empty() {}
    }
}

fn against_bounds(effort: Effort, island: &Island) {
    let (name, rounds) = (format!("{0}x{0}", island.side), effort.rounds(5));
    let pixels = island.land.len();
    let pass = || {
        for _ in 0..20 {
            black_box(mixed_squares(black_box(&island.land), island.side));
        }
        20 * pixels
    };
    let iteration = pairs(rounds, || (island.erode() + 1) * pixels, pass);
    iteration.print(&format!("an iteration, {name}, a pixel"), "a plain look at all squares", "");
    let run = pairs(
        rounds,
        || {
            island.erode();
            1000
        },
        || {
            island.erode_near();
            1000
        },
    );
    run.print(&format!("a run, {name}, in us"), "by the shore within 20 nodes", "");
}

/// Number of squares of 2 x 2 pixels that are neither all sea nor all land.
fn mixed_squares(land: &[u8], width: usize) -> u32 {
    let rows = land.chunks(width).zip(land[width..].chunks(width));
    let of_rows = |(north, south): (&[u8], &[u8])| -> u32 {
        let squares = north.windows(2).zip(south.windows(2));
        squares.map(|(n, s)| u32::from(!matches!(n[0] + n[1] + s[0] + s[1], 0 | 4))).sum()
    };
    rows.map(of_rows).sum()
}

fn literal(effort: Effort) {
    let island = Island::new(WORKLOADS[0]);
    let rock: Vec<u16> = island.rock.iter().map(|&u| numbers::resistance(u)).collect();
    let mut coast = island.image_coast();
    let step = |literal: bool, coast: &mut ImageCoast| {
        let mut land = island.land.clone();
        for _ in 0..20 {
            if literal {
                reference::step(island.size(), &island.settings, &rock, &mut land).expect("a step");
            } else {
                coast.step(&mut land).expect("a step");
            }
        }
        20 * land.len()
    };
    let mut other = coast.clone();
    let pair = pairs(effort.rounds(5), || step(false, &mut coast), || step(true, &mut other));
    pair.print("twenty iterations, 128x128, a pixel", "literal", "");
}

/// Milliseconds of some work: the least of `rounds`, by the clock on the wall.
fn milliseconds(rounds: usize, mut work: impl FnMut()) -> f64 {
    let mut once = || {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e3
    };
    (0..rounds).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn walls(effort: Effort, island: &Island) {
    let iterations = island.erode();
    let row = |figure: &str, whole: f64, first: f64| {
        let name = format!("{figure}, {}", island.side);
        println!("{name:<20} {iterations:>12} {whole:>12.2} {first:>12.2}");
    };
    let whole = milliseconds(effort.rounds(5), || {
        island.erode();
    });
    let first = milliseconds(effort.rounds(5), || {
        let (mut coast, mut land) = (island.image_coast(), island.land.clone());
        (0..100).for_each(|_| {
            coast.step(&mut land).expect("a step");
        });
    });
    row("figure B.7", whole, first);
    // Devices in software take a minute for the largest map.
    #[cfg(feature = "gpu")]
    if effort == Effort::Full || island.side < 1024 {
        device(island, row);
    }
}

/// The same on a graphics processor, whose programs and memory are ready.
#[cfg(feature = "gpu")]
fn device(island: &Island, row: impl Fn(&str, f64, f64)) {
    use landform::coast::image::GpuCoast;

    let coast = match GpuCoast::new(island.size(), island.settings, &island.rock) {
        Ok(coast) => coast,
        Err(error) => return println!("figure B.5: {error}"),
    };
    let coast = std::cell::RefCell::new(coast);
    let run = |most: usize| {
        milliseconds(1, || {
            let mut land = island.land.clone();
            coast.borrow_mut().run(&mut land, most).expect("a run");
        })
    };
    row("figure B.5", run(usize::MAX), run(100));
    println!("{:<20} on {}", "", coast.borrow().device());
}
