//! Laws that hold through the whole stack, from the scenario's text to the report: sand is
//! conserved, slopes come to rest, and the books close at open borders.
//!
//! The physics of the kernels is tested beside them, in their own crates.

use landform::prelude::*;
use landform::sim::sums::sum;
use landform_tests::Run;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The steepest edge that leads down from a node with sand, as a share of the step at repose,
/// and the volume of the sand.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct SandAtRest {
    /// Angle of repose of the process.
    repose_deg: f64,
}

impl Metric for SandAtRest {
    type Memory = ();
    const NAME: &'static str = "SandAtRest";

    fn fields(&self) -> Vec<String> {
        vec!["surface".to_owned(), "sand".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let field = |name| snapshot.field(name).map_err(|e| Problem::new("", e.to_string(), ""));
        let (surface, sand) = (field("surface")?, field("sand")?);
        let lattice = snapshot.lattice();
        let repose = self.repose_deg.to_radians().tan();
        let mut steepest: f64 = 0.0;
        for node in (0..lattice.node_count()).filter(|&node| sand[node] > 0.0) {
            for edge in lattice.neighbours(node) {
                let slope = (surface[node] - surface[edge.node]) / edge.distance;
                steepest = steepest.max(slope / repose);
            }
        }
        let volume = sum(&sand) * lattice.spacing().powi(2);
        let least = sand.iter().copied().fold(f64::INFINITY, f64::min);
        let values = [("steepest", steepest), ("volume_m3", volume), ("least_m", least)];
        Ok(values.map(|(name, value)| (name.to_owned(), value)).into())
    }
}

fn registry() -> Registry {
    let mut registry = landform::registry();
    registry.metric::<SandAtRest>();
    registry
}

/// Dunes on a hilly bed, measured at each iteration.
fn run(process: &str, boundary: &str, connectivity: &str, repose_deg: f64) -> Run {
    let text = format!(
        r#"(
            title: "physics",
            seed: 11,
            domain: Grid(size: (96, 50), spacing_m: 10.0, boundary: {boundary}, connectivity: {connectivity}),
            initial: [
                (field: "sand", from: WhiteNoise(mean_m: 12.0, amplitude_m: 12.0)),
                (field: "bed", from: SmoothNoise(standard_deviation_m: 6.0, correlation_length_m: 100.0)),
            ],
            stages: [(processes: [{process}], stop: Iterations(25))],
            metrics: [SandAtRest(repose_deg: {repose_deg:?})],
        )"#
    );
    Run::of(&text, registry(), 2)
}

const PERIODIC: &str = "(Periodic, Periodic)";

#[test]
fn sand_is_conserved_at_every_iteration() {
    for process in [
        "Dunes(slab_m: 3.0)",
        "Dunes(slab_m: 0.7, shelter: Protection())",
        "Dunes(slab_m: 3.0, refinement: (coarse_ticks: 10, phases: 3))",
        "Smoothing()",
    ] {
        let run = run(process, PERIODIC, "FourEight", 33.0);
        let account = &run.report.ledger.accounts()["sand"];
        assert!(account.largest_gap <= 1e-12, "{process}: {account:?}");
        assert!(account.entered.is_empty() && account.left.is_empty(), "{process}: {account:?}");
        let volumes = run.series.values("volume_m3");
        assert_eq!(volumes.len(), 26, "the start and every iteration");
        for volume in &volumes {
            let drift = (volume - volumes[0]).abs() / volumes[0];
            assert!(drift <= 1e-12, "{process}: {drift:e}");
        }
        let least = run.series.values("least_m");
        assert!(least.iter().all(|&least| least >= 0.0), "{process}: negative sand");
    }
}

#[test]
fn no_sand_is_steeper_than_repose_after_an_iteration() {
    for (connectivity, repose_deg) in [("FourEight", 33.0), ("Four", 33.0), ("Eight", 25.0)] {
        for boundary in [PERIODIC, "(Open, Open)"] {
            let process = format!("Dunes(slab_m: 3.0, repose_deg: {repose_deg:?})");
            let run = run(&process, boundary, connectivity, repose_deg);
            let steepest = run.series.values("steepest");
            assert!(steepest[0] > 1.2, "the start is too steep: {}", steepest[0]);
            for (iteration, &slope) in steepest.iter().enumerate().skip(1) {
                assert!(slope <= 1.0 + 1e-9, "{connectivity} {boundary} {iteration}: {slope}");
            }
            let most = steepest[1..].iter().copied().fold(0.0, f64::max);
            assert!(most > 0.9, "{connectivity} {boundary}: slip faces are near repose: {most}");
        }
    }
}

#[test]
fn the_books_close_where_sand_crosses_borders() {
    let process = "Dunes(slab_m: 3.0, feed_slabs: 40.0)";
    let run = run(process, "(Open, Periodic)", "FourEight", 33.0);
    let account = &run.report.ledger.accounts()["sand"];
    assert!(account.largest_gap <= 1e-12, "{account:?}");
    let slab_m3 = 3.0 * 100.0;
    assert_eq!(account.entered["upwind feed"], 25.0 * 40.0 * slab_m3);
    let east = account.left["east border"];
    assert!(east > 0.0 && east % slab_m3 == 0.0, "whole slabs leave downwind: {east}");
    assert!(!account.left.contains_key("north border"), "the axis is closed: {account:?}");
    let there = sum(run.field("sand")) * 100.0;
    let expected =
        account.initial + account.entered["upwind feed"] - account.left.values().sum::<f64>();
    assert!((there - expected).abs() <= 1e-12 * there, "{there} and {expected}");
}

#[test]
fn a_steady_wind_blows_sand_over_one_border_only() {
    let wind = "winds: [(towards_deg: 0.0, spread_deg: 0.0, directions: 1)]";
    let run = run(&format!("Dunes(slab_m: 3.0, {wind})"), "(Open, Open)", "FourEight", 33.0);
    let account = &run.report.ledger.accounts()["sand"];
    let borders: Vec<_> = account.left.keys().map(String::as_str).collect();
    assert_eq!(borders, ["east border"], "{account:?}");
}
