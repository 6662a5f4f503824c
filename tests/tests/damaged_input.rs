//! Damage to anything that Landform reads is refused or harmless; nothing panics. The fuzzers in
//! `tests/fuzz` call the same functions for longer, and look for damage more cleverly.

use landform_tests::fuzzing::{self, TARGETS, Target};
use landform_tests::{Program, SMALL, Scratch};

/// Tries out so many cases of damage on a target, after its seeds as they are.
fn damage(name: &str, cases: u64) {
    let is = |target: &&Target| target.name == name;
    let target = TARGETS.iter().find(is).expect("a target of this name");
    let (seeds, words) = ((target.seeds)(), (target.words)());
    let good = seeds.iter().filter(|(_, bytes)| (target.try_out)(bytes)).count();
    assert!(2 * good > seeds.len(), "{name}: only {good} of {} seeds are good", seeds.len());
    let accepted = |case: &u64| {
        let (_, seed) = &seeds[*case as usize % seeds.len()];
        (target.try_out)(&fuzzing::mutated(seed, &words, *case))
    };
    let accepted = (0..cases).filter(accepted).count() as u64;
    // Damage that is always noticed or never is not the kind that finds faults; only archives and
    // pictures have checksums.
    let least = if ["npz", "png"].contains(&name) { 0 } else { cases / 50 };
    assert!((least..cases).contains(&accepted), "{name}: {accepted} of {cases} accepted");
}

#[test]
fn scenarios_as_they_are_checked() {
    damage("scenario_text", 3000);
}

#[test]
fn scenarios_as_they_are_run() {
    damage("scenario_run", 2000);
}

#[test]
fn rasters_of_other_programs() {
    damage("geotiff", 1500);
}

#[test]
fn grids_as_text() {
    damage("esri_ascii", 1500);
}

#[test]
fn pictures() {
    damage("png", 2000);
}

#[test]
fn arrays() {
    damage("npy", 3000);
}

#[test]
fn archives_of_arrays() {
    damage("npz", 2000);
}

#[test]
fn files_beside_rasters() {
    damage("sidecar", 2000);
}

#[test]
fn every_target_is_tried_out_here() {
    let source = include_str!("damaged_input.rs");
    let missing = |target: &&Target| !source.contains(&format!("damage({:?}, ", target.name));
    let missing: Vec<_> = TARGETS.iter().filter(missing).map(|target| target.name).collect();
    assert!(missing.is_empty(), "no test of {missing:?}");
}

#[test]
fn every_target_has_a_fuzzer() {
    let manifest = include_str!("../fuzz/Cargo.toml");
    let missing = |target: &&Target| !manifest.contains(&format!("name = {:?}", target.name));
    let missing: Vec<_> = TARGETS.iter().filter(missing).map(|target| target.name).collect();
    assert!(missing.is_empty(), "no fuzzer for {missing:?}");
}

#[test]
fn the_program_survives_any_damage() {
    for case in 0..60 {
        let scratch = Scratch::new("damaged");
        let words = ["NaN", "(", "]", "\"", "-1"].map(str::to_owned);
        scratch.write("damaged.ron", fuzzing::mutated(SMALL.as_bytes(), &words, case));
        let ended = Program::within(scratch.folder()).line("check damaged.ron").run();
        assert!(matches!(ended.status, Some(0 | 2)), "{ended:?}");
        let refused = ended.status == Some(2);
        assert_eq!(refused, ended.stderr.starts_with("error[L"), "{ended:?}");
    }
}
