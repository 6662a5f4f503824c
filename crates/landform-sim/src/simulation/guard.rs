//! The checks after each turn of a process: faults, finite values, budgets.

use bevy_ecs::world::World;
use rayon::prelude::*;

use super::RunError;
use super::turn::Turn;
use crate::clock::Clock;
use crate::fault::Fault;
use crate::field::FieldEntry;
use crate::ledger::Ledger;
use crate::nodes::Space;

/// Opens the accounts of the budgets of a process with what is there.
pub(super) fn open_budgets(world: &mut World, turn: &Turn) {
    for budget in &turn.budgets {
        let amount = (budget.measure)(world);
        world.resource_mut::<Ledger>().open(budget, amount);
    }
}

/// Checks what a process has done in its turn.
pub(super) fn check(world: &mut World, turn: &Turn) -> Result<(), RunError> {
    let iteration = world.resource::<Clock>().tick;
    let process = || turn.name.to_owned();
    if let Some(message) = world.resource_mut::<Fault>().take() {
        return Err(RunError::Fault { process: process(), message, iteration });
    }
    for field in &turn.written {
        check_finite(world, field, turn.name, iteration)?;
    }
    if let Some(edges) = turn.edges.iter().find(|edges| !(edges.finite)(world)) {
        let message = format!("field `{}` on edges is no longer finite", edges.name);
        return Err(RunError::Fault { process: process(), message, iteration });
    }
    for budget in &turn.budgets {
        let measured = (budget.measure)(world);
        let checked = world.resource_scope::<Ledger, _>(|world, mut ledger| {
            ledger.check(budget, measured, || (budget.magnitude)(world))
        });
        checked.map_err(|(expected, measured)| RunError::Budget {
            process: process(),
            account: budget.account.to_owned(),
            unit: budget.unit.to_owned(),
            expected,
            measured,
            iteration,
        })?;
    }
    Ok(())
}

fn check_finite(
    world: &World,
    field: &FieldEntry,
    process: &str,
    iteration: u64,
) -> Result<(), RunError> {
    if field.is_finite(world) {
        return Ok(());
    }
    let values = field.read(world);
    let Some(node) = values.par_iter().position_first(|value| !value.is_finite()) else {
        return Ok(());
    };
    let [column, row, layer] = world.resource::<Space>().coordinates(node);
    Err(RunError::NotFinite {
        process: process.to_owned(),
        field: field.name.to_owned(),
        value: values[node],
        node,
        column,
        row,
        layer,
        iteration,
    })
}
