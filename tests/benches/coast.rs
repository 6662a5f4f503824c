//! The coast: what a whole run to rest costs, and an event.
//!
//! A square of random rock erodes on the lattice with four neighbours until it rests. `a run` is in
//! milliseconds. Figure 4.5 of the thesis took 195 to 308 s for the contiguous search and 1444 to
//! 3724 s for the other one, on 256x256 nodes and a machine of 2006.
//!
//! - `whole`: force by the whole shore;
//! - `near`, `contiguous`: by the shore within 20 and within 150 nodes;
//! - the events of a run divide its time; against it stands the same number at 256x256, so that
//!   the ratio is 1 where the cost of an event does not depend on the size;
//! - `literal`: the reference, an iteration of 64x64 nodes against one of the fast coast.

mod measure;

use landform::coast::coast::{Coast, CoastSettings, Perimeter, reference};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::sim::random::RandomStream;
use measure::{Effort, Pair, pairs, table, time};

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

    /// Erodes a copy until it rests, and gives the number of nodes that fell.
    fn erode(&self, settings: &CoastSettings) -> usize {
        let (mut land, mut rock) = (self.land.clone(), self.rock.clone());
        let coast = Coast::new(&self.lattice, settings.clone(), &land, &rock);
        let mut coast = coast.expect("a coast");
        let initial = coast.shore().total();
        let mut events = 0;
        loop {
            let fallen = coast.step(&mut land, &mut rock, initial).expect("a step").eroded.len();
            events += fallen;
            if fallen == 0 {
                return events;
            }
        }
    }
}

fn runs(effort: Effort, name: &str, settings: &CoastSettings, reach: &str) {
    let sizes: &[usize] = match effort {
        Effort::Quick => &[256],
        Effort::Normal => &[256, 1024],
        Effort::Full => &[256, 1024, 4096],
    };
    let small = Island::new(256);
    for &side in sizes {
        let island = Island::new(side);
        let rounds = effort.rounds(5);
        let mut nanoseconds: Vec<f64> = (0..rounds)
            .map(|_| {
                time(&mut || {
                    island.erode(settings);
                    1
                })
            })
            .collect();
        nanoseconds.sort_by(f64::total_cmp);
        let whole = nanoseconds[rounds / 2];
        println!(
            "{:<50} {:>9.1} ms a run{:>45}  {reach}",
            format!("{name}, {side}x{side}"),
            whole / 1e6,
            ""
        );
        let pair = pairs(rounds, || island.erode(settings), || small.erode(settings));
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
