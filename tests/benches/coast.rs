//! The coast: what a whole run to rest costs, and an event.
//!
//! A square of random rock erodes on the lattice with four neighbours until it rests. `a run` is in
//! milliseconds. Figure 4.5 of the thesis took 195 to 308 s for the contiguous search and 1444 to
//! 3724 s for the other one, on 256x256 nodes and a machine of 2006.
//!
//! - `whole`: force by the whole shore;
//! - `near`, `contiguous`: by the shore within 20 and within 150 nodes; `critical`: with a force so
//!   little damped that the coast hardly comes to rest;
//! - `an event`: iterations without the making of the coast, by the nodes that fall in them;
//!   against it stands the same number at 256x256, so that the ratio is 1 where the cost of an
//!   event does not depend on the size;
//! - `made`: the making of the coast, by the nodes of the map;
//! - `literal`: the reference, an iteration of 64x64 nodes against one of the fast coast.
//!
//! `--full` adds 4096x4096 nodes.

mod measure;

use cpu_time::ThreadTime;
use landform::coast::coast::{Coast, CoastSettings, Perimeter, reference};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::sim::random::RandomStream;
use measure::{Effort, Pair, pairs, table};

fn main() {
    table("Coasts", |effort| {
        let near = |radius_m| Perimeter::Near { radius_m };
        let contiguous = |radius_m| Perimeter::Contiguous { radius_m };
        for (name, force, attenuation, perimeter, reach) in [
            ("whole", 0.495, 0.18, Perimeter::Whole, "flat"),
            ("near 20", 0.5, 0.2, near(20.0), "100 ms; 1000 ms at 1024x1024"),
            ("near 150", 0.5, 0.2, near(150.0), "100 ms; 1000 ms at 1024x1024"),
            ("contiguous 20", 0.5, 0.25, contiguous(20.0), "150 ms; 2000 ms at 1024x1024"),
            ("contiguous 150", 0.5, 0.2, contiguous(150.0), "150 ms; 2000 ms at 1024x1024"),
            ("critical 20", 0.5, 0.2, contiguous(20.0), "150 ms; 2000 ms at 1024x1024"),
        ] {
            let settings =
                CoastSettings { force, attenuation, perimeter, ..CoastSettings::default() };
            runs(effort, name, &settings, reach);
        }
        literal(effort);
    });
}

/// A square of land of random rock.
struct Island {
    lattice: Lattice,
    land: Vec<u8>,
    rock: Vec<f64>,
}

impl Island {
    fn new(side: usize) -> Self {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([side; 2], 1.0, Connectivity::Four, open).expect("a lattice");
        let inside = |at: usize| (side / 16..side - side / 16).contains(&at);
        let nodes = side * side;
        let random = RandomStream::new(1, "rock");
        Self {
            land: (0..nodes).map(|n| u8::from(inside(n % side) && inside(n / side))).collect(),
            rock: (0..nodes).map(|node| random.unit(0, node, 0)).collect(),
            lattice,
        }
    }

    /// Erodes a copy until it rests, or until many nodes have fallen.
    fn erode(&self, settings: &CoastSettings) -> Run {
        let (mut land, mut rock) = (self.land.clone(), self.rock.clone());
        let start = ThreadTime::now();
        let coast = Coast::new(&self.lattice, settings.clone(), &land, &rock);
        let mut coast = coast.expect("a coast");
        let initial = coast.shore().total();
        let made_ns = start.elapsed().as_nanos() as f64;
        let mut events = 0;
        while events < MOST_EVENTS {
            let fallen = coast.step(&mut land, &mut rock, initial).expect("a step").eroded.len();
            events += fallen;
            if fallen == 0 {
                break;
            }
        }
        Run { made_ns, all_ns: start.elapsed().as_nanos() as f64, events }
    }
}

/// Events after which a run is long enough.
const MOST_EVENTS: usize = 500_000;

/// What a run took.
struct Run {
    made_ns: f64,
    all_ns: f64,
    events: usize,
}

impl Run {
    /// Nanoseconds an event, without the making.
    fn event_ns(&self) -> f64 {
        (self.all_ns - self.made_ns) / self.events as f64
    }
}

fn runs(effort: Effort, name: &str, settings: &CoastSettings, reach: &str) {
    let sizes: &[usize] = match effort {
        Effort::Quick => &[256],
        Effort::Normal => &[256, 512, 1024, 2048],
        Effort::Full => &[256, 512, 1024, 2048, 4096],
    };
    let small = Island::new(256);
    for &side in sizes {
        let island = Island::new(side);
        let rounds = effort.rounds(if side > 1024 { 3 } else { 5 });
        // The first round is for warming up.
        let both = || [island.erode(settings), small.erode(settings)];
        let runs: Vec<[Run; 2]> = (0..=rounds).map(|_| both()).skip(1).collect();
        let median = |figure: &dyn Fn(&Run) -> f64| {
            let mut figures: Vec<f64> = runs.iter().map(|[run, _]| figure(run)).collect();
            figures.sort_by(f64::total_cmp);
            figures[rounds / 2]
        };
        println!(
            "{:<50} {:>9.1} ms a run; made in {:.1} ns a node {:>18}  {reach}",
            format!("{name}, {side}x{side}, {} events", runs[0][0].events),
            median(&|run| run.all_ns) / 1e6,
            median(&|run| run.made_ns) / (side * side) as f64,
            ""
        );
        let events: Vec<[f64; 2]> =
            runs.iter().map(|both| both.each_ref().map(Run::event_ns)).collect();
        let pair = Pair::of(&events);
        pair.print(&format!("{name}, {side}x{side}: an event"), "an event at 256x256", "1 (flat)");
    }
}

fn literal(effort: Effort) {
    let island = Island::new(64);
    let settings = CoastSettings {
        perimeter: Perimeter::Contiguous { radius_m: 15.0 },
        ..CoastSettings::default()
    };
    let step = |literal: bool| {
        let (mut land, mut rock) = (island.land.clone(), island.rock.clone());
        if literal {
            let step = reference::step(&island.lattice, &settings, &mut land, &mut rock, 1);
            step.expect("a step").len()
        } else {
            let coast = Coast::new(&island.lattice, settings.clone(), &land, &rock);
            let mut coast = coast.expect("a coast");
            coast.step(&mut land, &mut rock, 1).expect("a step").eroded.len()
        }
        .max(1)
    };
    let pair: Pair = pairs(effort.rounds(5), || step(false), || step(true));
    pair.print("first iteration, 64x64: an event", "literal", "");
}
