//! The dune kernels: what a tick, a lift, a shadow, an avalanche and a step of smoothing cost.
//!
//! The numbers are Werner's (slabs of a third of the spacing, hops of five nodes, shadow of 15
//! degrees). Young sand has blown for 15 ticks from noise: 0.56 lifts a node and tick, as in the
//! runs by which the reach was set. Mature dunes have for 400; they lift half as many slabs, and
//! those slide over three times as many edges. Both are grown on 256x128 nodes and tiled to the
//! larger sizes, so that sizes differ in nothing else.
//!
//! - `tick`: nanoseconds a node and tick, against copying bed, sand and surface;
//! - `a lift`: the same time for each slab lifted, against the literal serial model;
//! - `large against small`: 1 when the cost does not depend on the size;
//! - `settle`: avalanches after the slabs of one tick have moved without them, a node;
//! - `shadow`, `protection`: shelter of all nodes, a node. Protection is brought up to date after
//!   every height has changed, which is its worst case, or a node in fifty, and then marked;
//! - `smoothing`: one step, a node.

mod measure;

use std::hint::black_box;

use landform::dunes::dunes::{
    AvalancheSettings, DuneSettings, Engine, Protection, ProtectionSettings, Rose, Shadow,
    ShadowSettings, SmoothingSettings, TransportSettings, Wind, WindLine, cast_shadow, reference,
    smooth,
};
use landform::graph::{Boundary, Connectivity, Lattice};
use landform::sim::random::{RandomStream, unit};
use measure::{Effort, Pair, pairs, table, time};

/// Size of the dunes that grow before anything is timed.
const GROWN: [usize; 2] = [256, 128];

fn main() {
    table("Dunes", |effort| {
        let young = Field::grown(15);
        let mature = Field::grown(if effort == Effort::Quick { 50 } else { 400 });
        for (name, grown) in [("young", &young), ("mature", &mature)] {
            ticks(effort, name, grown);
            flatness(effort, name, grown);
        }
        let field = mature.tiled([512, 512]);
        settle(effort, &field);
        shelter(effort, &field);
        smoothing(effort, &field);
    });
}

/// Sand on a level bed.
#[derive(Clone)]
struct Field {
    lattice: Lattice,
    bed: Vec<f64>,
    sand: Vec<f64>,
}

/// An engine, its shadow, the sand and the number of ticks done.
struct Blown {
    engine: Engine,
    shadow: Shadow,
    field: Field,
    ticks: u64,
    lifts: u64,
}

fn plane(size: [usize; 2]) -> Lattice {
    let boundary = [Boundary::Periodic; 2];
    Lattice::plane(size, 3.0, Connectivity::Four, boundary).expect("a lattice")
}

fn settings() -> DuneSettings {
    DuneSettings {
        rose: Rose { winds: vec![Wind::steady(0.0)] },
        transport: TransportSettings { slab_m: 1.0, hop_m: 15.0, ..Default::default() },
        avalanche: AvalancheSettings { repose_deg: 33.7, ..Default::default() },
    }
}

fn shadow_settings() -> ShadowSettings {
    ShadowSettings { reach_m: None, ..Default::default() }
}

impl Field {
    /// Dunes after some ticks on noise.
    fn grown(ticks: u64) -> Self {
        let lattice = plane(GROWN);
        let random = RandomStream::new(1, "sand");
        let slabs = |node| (21.0 * unit(random.block(0, node, 0)[0])).floor();
        let sand: Vec<f64> = (0..lattice.node_count()).map(slabs).collect();
        let mut blown = Blown::new(&Self { bed: vec![0.0; sand.len()], lattice, sand });
        (0..ticks).for_each(|_| blown.tick());
        blown.field
    }

    /// The same dunes again and again.
    fn tiled(&self, size: [usize; 2]) -> Self {
        let lattice = plane(size);
        let [width, height, _] = self.lattice.size();
        let sand: Vec<f64> = (0..lattice.node_count())
            .map(|node| self.sand[node % size[0] % width + width * (node / size[0] % height)])
            .collect();
        Self { lattice, bed: vec![0.0; sand.len()], sand }
    }

    fn nodes(&self) -> usize {
        self.sand.len()
    }
}

impl Blown {
    fn new(field: &Field) -> Self {
        Self {
            engine: Engine::new(field.lattice.clone(), settings(), 1).expect("an engine"),
            shadow: Shadow::new(shadow_settings()).expect("a shadow"),
            field: field.clone(),
            ticks: 0,
            lifts: 0,
        }
    }

    fn tick(&mut self) {
        let Field { bed, sand, .. } = &mut self.field;
        let counts = self.engine.tick(bed, sand, self.ticks, &mut self.shadow).expect("a tick");
        self.ticks += 1;
        self.lifts += counts.transport.lifts;
    }
}

/// Work that copies some fields of `nodes` nodes.
fn copying(fields: usize, nodes: usize) -> impl FnMut() -> usize {
    let from = vec![1.0; fields * nodes];
    let mut to = vec![0.0; fields * nodes];
    move || {
        to.copy_from_slice(black_box(&from));
        black_box(&to);
        nodes
    }
}

fn ticks(effort: Effort, name: &str, grown: &Field) {
    let mut sizes = vec![(GROWN, 40), ([512, 512], 15), ([1024, 1024], 7)];
    if effort == Effort::Full {
        sizes.push(([4096, 4096], 3));
    }
    let serial = serial_lift(grown);
    for (size, rounds) in sizes {
        let mut blown = Blown::new(&grown.tiled(size));
        let nodes = blown.field.nodes();
        blown.tick();
        let work = || {
            blown.tick();
            nodes
        };
        let rounds = effort.rounds(rounds);
        let pair = pairs(rounds, work, copying(3, nodes));
        pair.print(&format!("{name}, tick {size:?}"), "copy of bed, sand, surface", "60 ns");
        let polls_a_lift = (nodes as u64 * blown.ticks) as f64 / blown.lifts as f64;
        let lift = pair.ns[0] * polls_a_lift;
        let pair = Pair { ns: [lift, serial], ratio: lift / serial };
        pair.print(
            &format!("{name}, a lift {size:?}"),
            "serial model [256, 128], a lift",
            "120 ns",
        );
    }
}

/// Nanoseconds a lift of the serial model.
fn serial_lift(grown: &Field) -> f64 {
    let Field { lattice, bed, mut sand } = grown.clone();
    time(&mut || {
        let lifts =
            reference::tick(&lattice, &settings(), &shadow_settings(), (1, 0), &bed, &mut sand);
        lifts.expect("a tick") as usize
    })
}

fn flatness(effort: Effort, name: &str, grown: &Field) {
    let large_size = if effort == Effort::Full { [4096, 4096] } else { [1024, 1024] };
    let [mut large, mut small] = [large_size, GROWN].map(|size| Blown::new(&grown.tiled(size)));
    let work = |blown: &mut Blown, ticks: usize| {
        (0..ticks).for_each(|_| blown.tick());
        ticks * blown.field.nodes()
    };
    let pair = pairs(effort.rounds(5), || work(&mut large, 1), || work(&mut small, 32));
    pair.print(&format!("{name}, {large_size:?} against small"), "tick [256, 128]", "1.2");
}

fn settle(effort: Effort, field: &Field) {
    let mut still = settings();
    // Nothing slides, so that all the sliding of a tick is left to do.
    still.avalanche.repose_deg = 89.0;
    let mut engine = Engine::new(field.lattice.clone(), still, 1).expect("an engine");
    let mut shadow = Shadow::new(shadow_settings()).expect("a shadow");
    let mut moved = field.clone();
    engine.tick(&moved.bed, &mut moved.sand, 0, &mut shadow).expect("a tick");
    let mut resting = Engine::new(field.lattice.clone(), settings(), 1).expect("an engine");
    let mut sand = moved.sand.clone();
    let work = || {
        sand.copy_from_slice(&moved.sand);
        resting.settle(&moved.bed, &mut sand).expect("sand at rest");
        field.nodes()
    };
    let pair = pairs(effort.rounds(20), work, copying(3, field.nodes()));
    pair.print("settle after a tick [512, 512]", "copy of bed, sand, surface", "");
}

fn shelter(effort: Effort, field: &Field) {
    let Field { lattice, sand, .. } = field;
    let nodes = field.nodes();
    let mut sheltered = vec![false; nodes];
    for degrees in [0.0_f64, 15.0, 90.0] {
        let wind = WindLine::new(degrees.to_radians(), 0.3);
        let work = || {
            cast_shadow(lattice, sand, &wind, &shadow_settings(), &mut sheltered);
            nodes
        };
        let pair = pairs(effort.rounds(25), work, copying(1, nodes));
        pair.print(&format!("shadow, wind to {degrees} degrees"), "copy of the surface", "2 ns");
    }
    let settings = ProtectionSettings { reach_m: 36.0, ..Default::default() };
    let mut cones = Protection::new(settings, &Rose::default(), lattice).expect("cones");
    for (name, every) in [("every height", 1), ("a height in 50", 50)] {
        let mut surface = sand.clone();
        let work = || {
            surface.iter_mut().step_by(every).for_each(|height| *height += 1.0);
            cones.update(0, &surface).expect("a surface");
            cones.mark(0, &mut sheltered);
            nodes
        };
        let pair = pairs(effort.rounds(25), work, copying(1, nodes));
        pair.print(&format!("protection, {name} changed"), "copy of the surface", "3 ns");
    }
}

fn smoothing(effort: Effort, field: &Field) {
    let settings = SmoothingSettings { diffusivity_m2: 1.0, steps: 10 };
    let mut sand = field.sand.clone();
    let work = || {
        smooth(&field.lattice, &settings, &field.bed, &mut sand).expect("smooth sand");
        10 * field.nodes()
    };
    let pair = pairs(effort.rounds(15), work, copying(2, field.nodes()));
    pair.print("smoothing, a step", "copy of bed and sand", "");
}
