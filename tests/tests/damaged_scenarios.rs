//! Any damage to a good scenario is refused or runs; nothing panics.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::sim::registry::Registry;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, Simulation};
use landform_tests::{Program, SMALL, Scratch};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// A test that fails once must fail again, so the damage is the same at every run of the tests.
fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(20_150_717),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// What is done to a text, at a place that is a share of its length.
#[derive(Clone, Debug)]
enum Damage {
    Replace(f64, u8),
    Remove(f64, usize),
    Insert(f64, &'static str),
    Repeat(f64, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    let place = 0.0..1.0_f64;
    let piece = prop::sample::select(vec![
        "-", "0", "9", "(", ")", "[", "]", "\"", ",", ":", "NaN", "inf", "1e309", "1e-320", "None",
        "Some(", "//", "/*", "\\", "é", "\u{202e}", "r#\"", "0x", "..", "()", "-1", "1e9",
    ]);
    prop_oneof![
        3 => (place.clone(), 0x20..0x7f_u8).prop_map(|(at, byte)| Damage::Replace(at, byte)),
        1 => (place.clone(), any::<u8>()).prop_map(|(at, byte)| Damage::Replace(at, byte)),
        2 => (place.clone(), 1..30_usize).prop_map(|(at, count)| Damage::Remove(at, count)),
        4 => (place.clone(), piece).prop_map(|(at, text)| Damage::Insert(at, text)),
        1 => (place, 1..60_usize).prop_map(|(at, count)| Damage::Repeat(at, count)),
    ]
}

fn damaged(text: &str, damages: &[Damage]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for damage in damages {
        let place = |at: f64| (at * bytes.len() as f64) as usize;
        match *damage {
            Damage::Replace(at, byte) => {
                let at = place(at);
                bytes.splice(at..(at + 1).min(bytes.len()), [byte]);
            }
            Damage::Remove(at, count) => {
                let at = place(at);
                bytes.drain(at..(at + count).min(bytes.len()));
            }
            Damage::Insert(at, text) => {
                let at = place(at);
                bytes.splice(at..at, text.bytes());
            }
            Damage::Repeat(at, count) => {
                let at = place(at);
                let part = bytes[at..(at + count).min(bytes.len())].to_vec();
                bytes.splice(at..at, part);
            }
        }
    }
    bytes
}

/// Reads, builds and runs one iteration, whatever comes of it.
fn try_out(text: &str, registry: &Arc<Registry>) {
    let source = ScenarioSource::from_text("damaged.ron", text, Path::new(""));
    let Ok(mut scenario) = source.parse(registry).inspect_err(|message| check(message)) else {
        return;
    };
    // Outputs are checked with the rest, but nothing is written here.
    if let Err(problem) = scenario.check(Path::new(""), Limits::default()) {
        return check(&source.render(&problem));
    }
    scenario.outputs.clear();
    let limits = Limits { memory_bytes: 32 << 20 };
    match Simulation::new(scenario, Path::new(""), limits) {
        Ok(mut simulation) => {
            let mut hook = |progress: &Progress<'_>| match progress.iteration {
                0 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            };
            let mut report = Report::default();
            // Damaged numbers may well end a run; the guards find that.
            let _ = simulation.run(Path::new(""), &mut hook, &mut report);
        }
        Err(problem) => check(&source.render(&problem)),
    }
}

/// Every refusal is a message of a few lines.
fn check(message: &str) {
    assert!(message.starts_with("error: ") && message.len() < 5000, "{message}");
}

proptest! {
    #![proptest_config(config(1500))]

    #[test]
    fn damaged_scenarios_are_refused_or_run(damages in prop::collection::vec(damage(), 1..4)) {
        thread_local!(static REGISTRY: Arc<Registry> = Arc::new(landform::registry()));
        if let Ok(text) = String::from_utf8(damaged(SMALL, &damages)) {
            REGISTRY.with(|registry| try_out(&text, registry));
        }
    }
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn the_program_survives_any_damage(damages in prop::collection::vec(damage(), 1..4)) {
        let scratch = Scratch::new("damaged");
        scratch.write("damaged.ron", damaged(SMALL, &damages));
        let ended = Program::within(scratch.folder()).line("check damaged.ron").run();
        prop_assert!(matches!(ended.status, Some(0 | 2)), "{:?}", ended);
        prop_assert_eq!(ended.status == Some(2), ended.stderr.starts_with("error: "), "{:?}", ended);
    }
}
