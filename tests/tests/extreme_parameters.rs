//! Every number of every process at the ends of its range: refused or run, never a panic.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::sim::registry::Registry;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, Simulation};
use serde_json::Value;

/// Numbers whose upper end is only a matter of patience.
const WORK: [&str; 3] = ["feed_slabs", "grains_per_iteration", "warm_up_iterations"];

/// Values to try for a number with this schema: the ends of its range and zero.
fn extremes(schema: &Value) -> Vec<String> {
    let integer = schema["type"] == "integer";
    let bound = |key: &str, otherwise: f64| schema[key].as_f64().unwrap_or(otherwise);
    let ends = match integer {
        true => [bound("minimum", 0.0), bound("maximum", 1e6)],
        false => [bound("minimum", -1e300), bound("maximum", 1e300)],
    };
    let text = |number: f64| if integer { format!("{number:.0}") } else { format!("{number:e}") };
    let mut values = vec![text(ends[0]), text(ends[1])];
    if ends[0] < 0.0 {
        values.push(text(0.0));
    }
    values
}

/// Three iterations, and what came of them.
fn outcome(process: &str, domain: &str, registry: &Arc<Registry>) -> Result<(), String> {
    let text = format!(
        "(title: \"extreme\", domain: Grid(size: (30, 24), {domain}),
          stages: [(processes: [{process}], stop: Iterations(3))])"
    );
    let folder = Path::new("");
    let source = ScenarioSource::from_text("extreme.ron", &text, folder);
    let scenario = source.parse(registry)?;
    let limits = Limits { memory_bytes: 64 << 20 };
    let mut simulation =
        Simulation::new(scenario, folder, limits).map_err(|problem| source.render(&problem))?;
    let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
    simulation.run(folder, &mut hook, &mut Report::default()).map_err(|error| error.to_string())
}

#[test]
fn every_number_of_every_process_may_stand_at_its_limits() {
    let registry = Arc::new(landform::registry());
    let mut tried = 0;
    for process in registry.processes.iter() {
        let schema = process.schema();
        for (parameter, about) in schema["properties"].as_object().into_iter().flatten() {
            if about["type"] != "number" && about["type"] != "integer" {
                continue;
            }
            let work = WORK.contains(&parameter.as_str());
            let values =
                if work { vec!["0".to_owned(), "1000".to_owned()] } else { extremes(about) };
            for value in values {
                for domain in ["connectivity: Four", "boundary: (Periodic, Periodic)"] {
                    let text = format!("{}({parameter}: {value})", process.name);
                    let result = outcome(&text, domain, &registry);
                    if let Err(message) = result {
                        assert!(message.len() < 2000, "{text}: {message}");
                    }
                    tried += 1;
                }
            }
        }
    }
    assert!(tried > 20, "{tried} numbers were tried");
}
