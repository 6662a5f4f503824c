//! How long a tick of the dune engine takes, beside a copy of the same memory.
//!
//! `cargo run --release -p landform-dunes --example dune_speed [THREADS]` prints, for growing
//! lattices with Werner's canonical numbers, nanoseconds a node and tick and a lift. The copy
//! reads and writes a field of the same size once: what is left of its time is bandwidth.

use std::time::Instant;

use landform_dunes::dunes::{
    AvalancheSettings, DuneSettings, Engine, Rose, Shadow, ShadowSettings, TransportSettings, Wind,
};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::{RandomStream, unit};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let threads = match std::env::args().nth(1) {
        Some(threads) => threads.parse()?,
        None => 1,
    };
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    println!("nodes      ns a node-tick   ns a lift   copy ns a node");
    for (size, ticks) in
        [([256, 128], 200), ([512, 512], 60), ([1024, 1024], 15), ([4096, 4096], 3)]
    {
        measure(size, ticks)?;
    }
    Ok(())
}

/// Times `ticks` ticks after a quarter as many to let the noise settle.
fn measure(size: [usize; 2], ticks: u64) -> Result<(), Box<dyn std::error::Error>> {
    let lattice = Lattice::plane(size, 3.0, Connectivity::Four, [Boundary::Periodic; 2])?;
    let nodes = lattice.node_count();
    let settings = DuneSettings {
        rose: Rose { winds: vec![Wind::steady(0.0)] },
        transport: TransportSettings { slab_m: 1.0, hop_m: 15.0, ..Default::default() },
        avalanche: AvalancheSettings { repose_deg: 33.7, ..Default::default() },
    };
    let random = RandomStream::new(1, "sand");
    let slabs = |node| (21.0 * unit(random.block(0, node, 0)[0])).floor();
    let mut sand: Vec<f64> = (0..nodes).map(slabs).collect();
    let bed = vec![0.0; nodes];
    let mut engine = Engine::new(lattice, settings, 1)?;
    let mut shadow = Shadow::new(ShadowSettings { reach_m: None, ..Default::default() })?;
    for tick in 0..ticks.div_ceil(4) {
        engine.tick(&bed, &mut sand, tick, &mut shadow)?;
    }
    let start = Instant::now();
    let mut lifts = 0;
    for tick in 0..ticks {
        lifts += engine.tick(&bed, &mut sand, 1000 + tick, &mut shadow)?.transport.lifts;
    }
    let spent = start.elapsed().as_nanos() as f64;
    let mut copy = vec![1.0; nodes];
    let start = Instant::now();
    copy.copy_from_slice(std::hint::black_box(&sand));
    let copying = start.elapsed().as_nanos() as f64;
    std::hint::black_box(&copy);
    println!(
        "{nodes:>8}   {:>14.1}   {:>9.1}   {:>14.2}",
        spent / (nodes as f64 * ticks as f64),
        spent / lifts as f64,
        copying / nodes as f64
    );
    Ok(())
}
