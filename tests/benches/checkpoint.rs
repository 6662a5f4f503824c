//! Checkpoints: what they cost a run beside the disk.
//!
//! Nanoseconds a node and field of doubles, on 1024x1024 nodes; times are those of the processor,
//! so waiting for the disk does not count, but handing bytes to the system does.
//!
//! - `collecting`: all that a run does until its keeper has the checkpoint, against a copy of the
//!   same numbers in memory;
//! - `writing`, `reading`: the archive with checksums, against the bare bytes.

mod measure;

use std::cell::Cell;
use std::fs;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use cpu_time::ThreadTime;
use landform::io::npz::{self, Content, Member};
use landform::io::{IfExists, write_atomically};
use landform::sim::checkpoint::Checkpoint;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Keeper, Limits, Progress, Report, Simulation};
use landform_tests::Scratch;
use measure::{Effort, Pair, pairs, table};

/// Nodes of the lattice, each with bed and sand.
const NODES: usize = 1024 * 1024;
const FIELDS: usize = 2;

const SCENARIO: &str = r#"(
    title: "checkpoint",
    domain: Grid(size: (1024, 1024), boundary: (Periodic, Periodic)),
    initial: [(field: "sand", from: WhiteNoise(mean_m: 20.0, amplitude_m: 5.0))],
    stages: [(processes: [Smoothing()], stop: Iterations(20))],
)"#;

fn main() {
    table("Checkpoints, 1024x1024, a node and field", |effort| {
        collecting(effort);
        files(effort);
    });
}

/// Takes the time from the question whether a checkpoint is due to having it, and copies it.
struct Timing {
    asked: ThreadTime,
    times: Rc<Cell<Vec<[f64; 2]>>>,
}

impl Keeper for Timing {
    fn is_due(&mut self, _: &Progress<'_>) -> bool {
        self.asked = ThreadTime::now();
        true
    }

    fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String> {
        let collected = self.asked.elapsed().as_nanos() as f64;
        let start = ThreadTime::now();
        let numbers: usize = checkpoint.arrays.values().map(|array| array.len()).sum();
        black_box(checkpoint.into_owned());
        let copied = start.elapsed().as_nanos() as f64;
        let mut times = self.times.take();
        times.push([collected, copied].map(|time| time / numbers as f64));
        self.times.set(times);
        Ok(())
    }
}

fn collecting(effort: Effort) {
    let source = ScenarioSource::from_text("checkpoint.ron", SCENARIO, Path::new(""));
    let scenario = source.parse(&Arc::new(landform::registry())).expect("a good scenario");
    let simulation = Simulation::new(scenario, Path::new(""), Limits::default());
    let mut simulation = simulation.expect("it fits");
    let times = Rc::new(Cell::new(Vec::new()));
    simulation
        .keep_checkpoints(Box::new(Timing { asked: ThreadTime::now(), times: Rc::clone(&times) }));
    let mut left = effort.rounds(15);
    let mut hook = |_: &Progress<'_>| {
        left = left.saturating_sub(1);
        if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    // The run is broken off when enough was measured.
    let _ = simulation.run(Path::new(""), &mut hook, &mut Report::default());
    Pair::of(&times.take()).print("collecting", "memory copy", "1 ns with writing");
}

fn files(effort: Effort) {
    let scratch = Scratch::new("bench_checkpoint");
    let values: Vec<f64> = (0..NODES * FIELDS).map(|node| (node as f64).sqrt()).collect();
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_ne_bytes()).collect();
    let members: Vec<Member<'_>> = bytes
        .chunks(NODES * 8)
        .enumerate()
        .map(|(field, bytes)| Member {
            name: format!("fields/{field}.npy"),
            content: Content::Array {
                kind: "f8".to_owned(),
                shape: vec![1024, 1024],
                bytes: bytes.into(),
            },
        })
        .collect();
    let (archive, bare) = (scratch.path("state.npz"), scratch.path("bare"));
    let written = pairs(
        effort.rounds(10),
        || {
            npz::write(&archive, &members, IfExists::Replace).expect("it can be written");
            NODES * FIELDS
        },
        || {
            let write =
                |file: &mut std::io::BufWriter<fs::File>| std::io::Write::write_all(file, &bytes);
            write_atomically(&bare, IfExists::Replace, write).expect("it can be written");
            NODES * FIELDS
        },
    );
    written.print("writing, with checksums", "bare bytes", "1 ns more");
    let read = pairs(
        effort.rounds(10),
        || {
            black_box(npz::read(&archive).expect("it can be read"));
            NODES * FIELDS
        },
        || {
            black_box(fs::read(&bare).expect("it can be read"));
            NODES * FIELDS
        },
    );
    read.print("reading, with checks", "bare bytes", "");
}
