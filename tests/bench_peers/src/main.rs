//! The Game of Life and a forest fire in Landform, krABMaga and Mesa, timed in one run.
//!
//! All start from the same cells, none draws random numbers after that, and all cells are
//! compared at the end: the same model, or no figure. Times are CPU times of one thread.
//!
//! ```sh
//! python3 -m venv venv && venv/bin/pip install -r requirements.txt
//! cargo run --release            # 1024 x 1024; with another side: cargo run --release 256
//! ```
//! Without the environment `venv` Mesa is left out.

mod by_hand;
mod krabmaga_models;
mod landform_models;
mod mesa_models;
mod model;

use model::{Model, Timed};

/// Iterations of the compiled frameworks.
const STEPS: usize = 20;

/// Iterations of Mesa, which takes seconds for each.
const MESA_STEPS: usize = 3;

fn main() {
    let side = std::env::args().nth(1).and_then(|side| side.parse().ok()).unwrap_or(1024);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    // Kernels that use threads then stay on this one, whose time is taken.
    pool.expect("a thread can be started").install(|| {
        for model in [Model::Life, Model::Fire] {
            compare(model, side);
        }
    });
}

/// Runs one model everywhere and prints the table.
fn compare(model: Model, side: usize) {
    println!("\n{model:?}, {side} x {side}: CPU nanoseconds for a cell and an iteration");
    let start = model.start(side);
    let plain = by_hand::run(model, &start, side, STEPS);
    let expected = plain.cells.clone();
    let base = plain.report("plain arrays", None);
    let check = |timed: Timed, name: &str| {
        assert!(timed.cells == expected, "{name}: other cells than by hand after {STEPS} steps");
        timed.report(name, Some(base));
    };
    for (name, process) in model.processes() {
        check(landform_models::run(model, process, side, STEPS), name);
    }
    check(
        krabmaga_models::on_a_grid(model, &start, side, STEPS),
        "krABMaga, a stepper on its grid",
    );
    check(krabmaga_models::as_agents(model, &start, side, STEPS), "krABMaga, an agent a cell");
    let expected = by_hand::run(model, &start, side, MESA_STEPS).cells;
    for kind in ["layer", "agents"] {
        let Some(timed) = mesa_models::run(model, kind, &start, side, MESA_STEPS) else { continue };
        let name = format!("Mesa, {kind}");
        assert!(timed.cells == expected, "{name}: other cells after {MESA_STEPS} steps");
        timed.report(&name, Some(base));
    }
}
