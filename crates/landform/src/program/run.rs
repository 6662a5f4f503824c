//! `landform run`: a scenario from file to output folder.

use std::path::Path;
use std::sync::Arc;

use landform_sim::checkpoint::Checkpoint;
use landform_sim::code::Code;
use landform_sim::output::OutputFile;
use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Limits, ProgressHook, Report, RunError, Simulation};

use super::arguments::RunArguments;
use super::checkpoint_file::{self, Claim, FileKeeper};
use super::progress_bar::Bar;
use super::resume::{self, Rest};
use super::{Failure, Outcome, failed, folder, interrupt, memory, refused, talk};
use crate::outputs::{SeriesFile, write_field};

/// Runs the scenario of the arguments.
pub(super) fn run(arguments: &RunArguments, registry: &Arc<Registry>) -> Outcome {
    let source = open(&arguments.scenario, &arguments.set)?;
    let memory_bytes =
        memory::limit(arguments.memory_limit_gib).map_err(refused(Code::Arguments))?;
    let pool = pool(arguments.threads).map_err(refused(Code::Arguments))?;
    interrupt::watch();
    pool.install(|| {
        let mut scenario = source.parse(registry).map_err(Failure::Refused)?;
        scenario.seed = arguments.seed.unwrap_or(scenario.seed);
        let mut simulation = Simulation::new(scenario, source.folder(), Limits { memory_bytes })
            .map_err(|problem| Failure::Refused(source.render(&problem)))?;
        // The checkpoint of a run that goes on holds the state of all outputs, this one included.
        SeriesFile::attach(&mut simulation);
        let folder = match &arguments.output {
            Some(folder) if arguments.resume => folder.clone(),
            asked => {
                let stem = arguments.scenario.file_stem().unwrap_or_default().to_string_lossy();
                folder::make(asked.as_deref(), &stem, arguments.force)?
            }
        };
        let Some(claim) = begin(arguments, &folder, &mut simulation, &source)? else {
            talk::tell(&format!("the run in {} is over: nothing is left to do", folder.display()));
            return Ok(());
        };
        let mut bar = Bar::new(arguments.quiet);
        let done = run_in(&folder, &mut simulation, &source, &mut bar);
        bar.finish();
        claim.release(&folder, done.as_ref().is_ok_and(|(_, result)| result.is_ok()));
        let (report, result) = done.map_err(failed(Code::Unwritable))?;
        result.map_err(|error| failure(error, &folder, &arguments.scenario))?;
        talk::say(&summary(&report, &folder))
    })
}

/// Claims the folder of a run and takes up what was done there before; `None` when nothing is left
/// to do.
fn begin(
    arguments: &RunArguments,
    folder: &Path,
    simulation: &mut Simulation,
    source: &ScenarioSource,
) -> Result<Option<Claim>, Failure> {
    let rest = match arguments.resume {
        true => resume::rest(folder, source)?,
        false => Rest::Everything,
    };
    if matches!(rest, Rest::Nothing) && !checkpoint_file::folder(folder).is_dir() {
        return Ok(None);
    }
    let claim = Claim::new(folder)?;
    match rest {
        Rest::After(checkpoint) => take_up(checkpoint, folder, simulation)?,
        Rest::Everything => claim.clear(folder).map_err(refused(Code::Unwritable))?,
        Rest::Nothing => {
            // The run was killed while it cleaned up.
            claim.release(folder, true);
            return Ok(None);
        }
    }
    if arguments.resume {
        folder::remove_leftovers(folder);
    }
    let (size, interval) = (simulation.lattice().size(), arguments.checkpoint_every);
    let keeper = FileKeeper::new(folder, interval, source.text(), size);
    simulation.keep_checkpoints(Box::new(keeper));
    Ok(Some(claim))
}

/// Takes over the state of a checkpoint.
fn take_up(
    checkpoint: Checkpoint<'static>,
    folder: &Path,
    simulation: &mut Simulation,
) -> Result<(), Failure> {
    simulation.resume(checkpoint, folder).map_err(|damage| {
        let path = checkpoint_file::path(folder);
        let message = format!(
            "cannot resume from {}: {damage}; start a new run in another folder, or here with \
             --force",
            path.display()
        );
        Failure::refused(damage.code(), message)
    })
}

/// Runs a simulation, which was built from `source`, and leaves in `folder` what every run leaves
/// there, however it ended: this is a run of `landform run` and of a sweep.
///
/// # Errors
/// A message when the folder cannot be written.
pub(super) fn run_in(
    folder: &Path,
    simulation: &mut Simulation,
    source: &ScenarioSource,
    hook: &mut dyn ProgressHook,
) -> Result<(Report, Result<(), RunError>), String> {
    let mut report = Report::default();
    folder::write_text(&folder.join("scenario.ron"), source.text())?;
    SeriesFile::attach(simulation);
    let result = simulation.run(folder, hook, &mut report);
    finish(simulation, folder, &mut report)?;
    Ok((report, result))
}

/// Opens a scenario and makes the edits of the command line.
pub(super) fn open(path: &Path, edits: &[String]) -> Result<ScenarioSource, Failure> {
    let mut source = ScenarioSource::open(path).map_err(refused(Code::UnreadableScenario))?;
    for edit in edits {
        let (path, value) = edit.split_once('=').ok_or_else(|| {
            let message = format!("--set {edit}: write it as PATH=VALUE, domain.spacing_m=5.0 say");
            Failure::refused(Code::Edit, message)
        })?;
        source.set(path, value).map_err(Failure::Refused)?;
    }
    Ok(source)
}

/// Threads for a run, all cores without a number.
pub(super) fn pool(threads: Option<usize>) -> Result<rayon::ThreadPool, String> {
    if threads.is_some_and(|threads| !(1..=1024).contains(&threads)) {
        return Err("--threads must be from 1 to 1024".to_owned());
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .map_err(|error| format!("cannot start the threads: {error}"))
}

fn failure(error: RunError, folder: &Path, scenario: &Path) -> Failure {
    let message = format!("{error}\nwhat was done until then is in {}", folder.display());
    match error {
        RunError::Interrupted { kept: true, .. } => Failure::interrupted(format!(
            "{message}\ngo on with: landform run {} -o {} --resume (and the same --set and --seed)",
            scenario.display(),
            folder.display()
        )),
        RunError::Interrupted { .. } => Failure::interrupted(message),
        error => Failure::failed(error.code(), message),
    }
}

/// Writes what every run leaves beside its series and its scenario: the final fields and the
/// report.
fn finish(simulation: &Simulation, folder: &Path, report: &mut Report) -> Result<(), String> {
    let mut keep = |file: &str, kind: &str| {
        report.outputs.push(OutputFile { file: file.into(), kind: kind.to_owned() });
    };
    let snapshot = simulation.snapshot();
    let fields = folder.join("fields");
    std::fs::create_dir_all(&fields)
        .map_err(|error| format!("cannot make {}: {error}", fields.display()))?;
    for entry in snapshot.fields() {
        let file = format!("fields/{}.npy", entry.name);
        let values = snapshot.field(entry.name).unwrap_or_default();
        write_field(&folder.join(&file), &snapshot, values, entry)
            .map_err(|error| error.to_string())?;
        keep(&file, "field");
    }
    keep(SeriesFile::NAME, "series");
    keep("scenario.ron", "scenario");
    folder::write_json(&folder.join("report.json"), report)
}

/// What a person reads when a run is done.
fn summary(report: &Report, folder: &Path) -> String {
    let mut text = format!("{}: {} nodes, {:.1} s\n", report.title, report.nodes, report.seconds);
    for stage in &report.stages {
        let name = if stage.name.is_empty() { "stage" } else { &stage.name };
        text += &format!("  {name}: {} iterations, {}\n", stage.iterations, stage.stopped);
    }
    for (name, value) in &report.metrics {
        text += &format!("  {name} = {value:.6}\n");
    }
    for warning in &report.warnings {
        text += &format!("  note: {warning}\n");
    }
    for output in report.outputs.iter().filter(|output| output.kind != "field") {
        text += &format!("  {} {}\n", output.kind, folder.join(&output.file).display());
    }
    text
}
