//! `landform check`: reads scenarios and builds their domains without running them.

use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;

use super::arguments::CheckArguments;
use super::{Failure, Outcome, memory, run, talk};

/// Checks every scenario and reports all that are wrong.
pub(super) fn check(arguments: &CheckArguments, registry: &Arc<Registry>) -> Outcome {
    let memory_bytes = memory::limit(None).map_err(Failure::Refused)?;
    let limits = Limits { memory_bytes };
    let mut messages = Vec::new();
    for path in &arguments.scenarios {
        let checked = run::open(path, &arguments.set).and_then(|source| {
            let scenario = source.parse(registry)?;
            scenario.check(source.folder(), limits).map_err(|problem| source.render(&problem))
        });
        match checked {
            Ok(()) => talk::say(&format!("{}: good\n", path.display()))?,
            Err(message) => messages.push(message),
        }
    }
    match messages.is_empty() {
        true => Ok(()),
        false => Err(Failure::Refused(messages.join("\n"))),
    }
}
