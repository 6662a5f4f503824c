//! A stage at work: the schedules of its processes, one turn each at every iteration.

use bevy_app::App;
use bevy_ecs::schedule::{
    LogLevel, Schedule, ScheduleBuildError, ScheduleBuildSettings, ScheduleBuildWarning,
    ScheduleGraph, ScheduleLabel, Schedules,
};
use bevy_ecs::world::World;

use super::state::State;
use super::turn::Turn;
use super::{RunError, guard};
use crate::clock::Clock;
use crate::process::{Access, Begin, Iterate};
use crate::registry::{AnyProcess, Chosen};

/// Adds the processes of a stage to the app and runs their [`Begin`] systems.
///
/// `prepare` puts the world into the state that `Begin` is to see: a run that is resumed shows it
/// the fields of the checkpoint.
pub(super) fn begin(
    app: &mut App,
    processes: &[Chosen<dyn AnyProcess>],
    state: &State,
    prepare: impl Fn(&mut World) -> Result<(), RunError>,
) -> Result<Vec<Turn>, RunError> {
    let mut turns = Vec::with_capacity(processes.len());
    for process in processes {
        prepare(app.world_mut())?;
        app.init_schedule(Begin).init_schedule(Iterate);
        process.value.build(app);
        let mut begin = take(app, Begin, process.name)?;
        let iterate = take(app, Iterate, process.name)?;
        let uses = process.value.declaration();
        let written = uses.fields().filter(|(_, access)| *access == Access::Writes);
        let turn = Turn {
            name: process.name,
            written: written.map(|(entry, _)| *entry).collect(),
            edges: uses.edges.clone(),
            groups: uses.groups.clone(),
            budgets: uses.budgets.clone(),
            iterate,
        };
        begin.run(app.world_mut());
        state.check(app.world(), process.name)?;
        apply_groups(app, &turn, 0);
        guard::open_budgets(app.world_mut(), &turn);
        guard::check(app.world_mut(), &turn)?;
        turns.push(turn);
    }
    Ok(turns)
}

/// Runs one iteration: a turn of each process, its staged births and deaths, its checks.
pub(super) fn iterate(app: &mut App, turns: &mut [Turn]) -> Result<(), RunError> {
    for turn in turns {
        turn.iterate.run(app.world_mut());
        apply_groups(app, turn, 1);
        guard::check(app.world_mut(), turn)?;
    }
    Ok(())
}

/// Makes births and deaths real; agents born now act `delay` iterations later at the earliest.
fn apply_groups(app: &mut App, turn: &Turn, delay: u32) {
    let tick = app.world().resource::<Clock>().tick as u32 + delay;
    for group in &turn.groups {
        (group.apply)(app.world_mut(), tick);
    }
}

/// Takes the schedule that a plugin filled out of the app and makes it ready to run.
fn take(
    app: &mut App,
    label: impl ScheduleLabel,
    process: &'static str,
) -> Result<Schedule, RunError> {
    let broken = |message: String| RunError::Plugin { process: process.to_owned(), message };
    let mut schedule = app
        .world_mut()
        .resource_mut::<Schedules>()
        .remove(label)
        .ok_or_else(|| broken("it removed a schedule of the framework".to_owned()))?;
    // Two systems that touch the same data in an order that nobody stated would make results
    // depend on the executor.
    schedule.set_build_settings(ScheduleBuildSettings {
        ambiguity_detection: LogLevel::Error,
        ..ScheduleBuildSettings::default()
    });
    match schedule.initialize(app.world_mut()) {
        Ok(_) => Ok(schedule),
        Err(error) => Err(broken(explained(&error, schedule.graph(), app.world()))),
    }
}

/// Why a schedule cannot be built; systems without an order are named with what they share.
fn explained(error: &ScheduleBuildError, graph: &ScheduleGraph, world: &World) -> String {
    let ScheduleBuildError::Elevated(ScheduleBuildWarning::Ambiguity(conflicts)) = error else {
        return error.to_string(graph, world);
    };
    let pairs = conflicts.0.to_string(graph, world.components()).map(|(first, second, shared)| {
        let shared: Vec<_> = shared.iter().map(|name| name.shortname().to_string()).collect();
        format!("{first} and {second} share {}", shared.join(", "))
    });
    let pairs: Vec<String> = pairs.collect();
    let advice = "nothing says which comes first; add them in an order, (first, second).chain()";
    format!("{}; {advice}", pairs.join("; "))
}
