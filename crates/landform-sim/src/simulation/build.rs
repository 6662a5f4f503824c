//! Building a run: domain, fields, nodes, initial conditions, all checked before the first step.

use std::path::Path;

use bevy_app::App;
use bevy_ecs::world::World;
use landform_graph::Lattice;

use super::checkpoint::Resumed;
use super::state::State;
use super::{Keeper, memory};
use crate::agent::{GroupListing, GroupTable, GroupUse, UnknownGroup, UnknownQuantity};
use crate::clock::Clock;
use crate::code::Code;
use crate::domain::Domain;
use crate::fault::Fault;
use crate::field::{Bed, FieldEntry, FieldTable, NodeField, Sand, surface};
use crate::initial::InitialContext;
use crate::ledger::Ledger;
use crate::metric::{Meter, RowsKept, Series};
use crate::nodes::spawn_nodes;
use crate::notes::Notes;
use crate::output::Sink;
use crate::parameters::Problem;
use crate::process::{Access, Declaration, GroupEntry};
use crate::random::RandomStream;
use crate::registry::{AnyOutput, Chosen};
use crate::scenario::validate::below;
use crate::scenario::{Scenario, StageEntry};
use crate::text::nearest;

/// What a run may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest memory in bytes; a run whose estimate is above is refused.
    pub memory_bytes: u64,
}

impl Default for Limits {
    /// 16 GiB.
    fn default() -> Self {
        Self { memory_bytes: 16 << 30 }
    }
}

/// A metric that decides when an output is due, the output's name and its path.
pub(super) type Schedule = (String, &'static str, String);

/// What a run will need, before anything is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Number of nodes.
    pub nodes: u64,
    /// Memory in bytes.
    pub memory_bytes: u64,
    /// Size of its final fields on the disk in bytes, as numbers of eight bytes.
    pub field_bytes: u64,
}

/// A run that is ready to go.
pub struct Simulation {
    pub(super) app: App,
    pub(super) domain: Domain,
    pub(super) title: String,
    pub(super) stages: Vec<StageEntry>,
    pub(super) metrics: Vec<(&'static str, Box<dyn Meter>)>,
    pub(super) measure_every: u64,
    pub(super) sinks: Vec<(&'static str, Box<dyn Sink>)>,
    pub(super) schedules: Vec<Schedule>,
    pub(super) series: Series,
    pub(super) warnings: Vec<String>,
    pub(super) state: State,
    pub(super) keeper: Option<Box<dyn Keeper>>,
    pub(super) resumed: Option<Resumed>,
    pub(super) start: String,
}

impl Simulation {
    /// Builds the run of a checked scenario. Relative paths are relative to `folder`.
    ///
    /// # Errors
    /// The [`Problem`] holds the full path of the parameter in the scenario.
    pub fn new(scenario: Scenario, folder: &Path, limits: Limits) -> Result<Self, Problem> {
        let Plan { domain, fields, uses, .. } = plan(&scenario, folder, limits)?;
        let mut app = App::empty();
        let world = app.world_mut();
        fields.declare_all(world);
        let groups = collect_groups(&uses);
        groups.iter().for_each(|group| (group.declare)(world));
        spawn_nodes(world, domain.lattice.clone());
        groups.iter().for_each(|group| (group.make)(world, domain.lattice.node_count()));
        uses.iter().flat_map(|uses| &uses.edges).for_each(|e| (e.make)(world, &domain.lattice));
        world.insert_resource(domain.outside.clone());
        world.insert_resource(fields);
        world.insert_resource(GroupTable(listings(&groups)));
        world.insert_resource(Clock { seed: scenario.seed, ..Clock::default() });
        world.insert_resource(Ledger::default());
        world.insert_resource(Fault::default());
        world.insert_resource(Notes::default());
        fill(&mut app, &scenario, &domain, folder)?;
        let state = State::new(app.world(), groups, &uses)?;

        let schedules = schedules(&scenario);
        Ok(Self {
            app,
            warnings: domain.remarks.clone(),
            domain,
            title: scenario.title,
            sinks: scenario.outputs.iter().map(|each| (each.name, each.value.open())).collect(),
            schedules,
            series: Series::new(longest_rule(&scenario.stages)),
            stages: scenario.stages,
            metrics: scenario.metrics.iter().map(|each| (each.name, each.value.open())).collect(),
            measure_every: scenario.measure_every,
            state,
            keeper: None,
            resumed: None,
            start: String::new(),
        })
    }

    /// Adds an output that no scenario names, unless one of that name is there. Its errors are
    /// told under `name`.
    pub fn add_sink(&mut self, name: &'static str, sink: Box<dyn Sink>) {
        if self.sinks.iter().all(|(known, _)| *known != name) {
            self.sinks.push((name, sink));
        }
    }

    /// Decides which rows of the series stay in memory; at first all do.
    pub fn keep_rows(&mut self, kept: RowsKept) {
        self.series.keep(kept);
    }

    /// The lattice of the run.
    pub fn lattice(&self) -> &Lattice {
        &self.domain.lattice
    }

    /// The domain of the run.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// What was measured so far.
    pub fn series(&self) -> &Series {
        &self.series
    }
}

/// Everything that is settled before nodes are made.
struct Plan {
    domain: Domain,
    fields: FieldTable,
    uses: Vec<Declaration>,
    needs: Needs,
}

/// Checks a scenario without making nodes.
pub(crate) fn check(scenario: &Scenario, folder: &Path, limits: Limits) -> Result<Needs, Problem> {
    plan(scenario, folder, limits).map(|plan| plan.needs)
}

/// Directions of the lattices with the fewest, for an estimate before there is a lattice.
const LEAST_DIRECTIONS: usize = 4;

/// Makes the domain and checks everything against it, within the limits.
fn plan(scenario: &Scenario, folder: &Path, limits: Limits) -> Result<Plan, Problem> {
    let declare = |stage: &StageEntry| -> Vec<Declaration> {
        stage.processes.iter().map(|process| process.value.declaration()).collect()
    };
    let declarations: Vec<Vec<Declaration>> = scenario.stages.iter().map(declare).collect();
    let fields = collect_fields(&declarations)?;
    check_groups(&declarations)?;
    let uses: Vec<Declaration> = declarations.into_iter().flatten().collect();
    let bytes = |directions| memory::bytes_per_node(fields.bytes_per_node(), &uses, directions);
    if let Some(nodes) = scenario.domain.value.nodes() {
        memory::check(nodes, bytes(LEAST_DIRECTIONS), limits.memory_bytes)?;
    }
    let domain = scenario.domain.value.make(folder).map_err(|problem| below("domain", problem))?;
    let bytes = bytes(domain.lattice.directions());
    memory::check(domain.lattice.node_count() as u128, bytes, limits.memory_bytes)?;
    check_processes(&scenario.stages, &domain.lattice)?;
    check_names(scenario, &fields, &uses)?;
    let groups = GroupTable(listings(&collect_groups(&uses)));
    check_metrics(scenario, &fields, &groups, &domain.lattice)?;
    check_outputs(scenario, &fields, &groups, &domain.lattice)?;
    let nodes = domain.lattice.node_count() as u64;
    let needs = Needs {
        nodes,
        memory_bytes: nodes.saturating_mul(bytes as u64),
        field_bytes: nodes.saturating_mul(8 * fields.iter().count() as u64),
    };
    Ok(Plan { domain, fields, uses, needs })
}

/// All fields that the processes name, the bed when there is no stage to name any, and the
/// surface when there is a bed or sand.
fn collect_fields(declarations: &[Vec<Declaration>]) -> Result<FieldTable, Problem> {
    let mut fields = FieldTable::default();
    if declarations.is_empty() {
        fields.insert(FieldEntry::stored::<Bed>());
    }
    for (stage, processes) in declarations.iter().enumerate() {
        for (index, uses) in processes.iter().enumerate() {
            for (entry, _) in uses.fields() {
                if !fields.insert(*entry) {
                    let message = format!("field `{}` is defined twice, differently", entry.name);
                    let path = format!("stages[{stage}].processes[{index}]");
                    return Err(Problem::new(path, message, "one definition of the field")
                        .code(Code::Contradiction)
                        .help("rename the field in one of the plugins"));
                }
            }
        }
    }
    if [Bed::NAME, Sand::NAME].iter().any(|name| fields.get(name).is_ok()) {
        let meaning = "elevation of the surface: bed and sand";
        fields.insert(FieldEntry::derived("surface", "m", meaning, surface));
    }
    Ok(fields)
}

/// Refuses two groups of one name, which would share one place in checkpoints.
fn check_groups(declarations: &[Vec<Declaration>]) -> Result<(), Problem> {
    let mut known: Vec<GroupEntry> = Vec::new();
    for (stage, processes) in declarations.iter().enumerate() {
        for (index, uses) in processes.iter().enumerate() {
            for group in &uses.groups {
                if known
                    .iter()
                    .any(|other| other.listing.name == group.listing.name && other.id != group.id)
                {
                    let message =
                        format!("two groups of agents are called `{}`", group.listing.name);
                    let path = format!("stages[{stage}].processes[{index}]");
                    return Err(Problem::new(path, message, "a name for each group")
                        .code(Code::Contradiction)
                        .help("rename the group in one of the plugins"));
                }
                known.push(*group);
            }
        }
    }
    Ok(())
}

/// The groups of all processes, each once.
fn collect_groups(declarations: &[Declaration]) -> Vec<GroupEntry> {
    let mut groups: Vec<GroupEntry> = Vec::new();
    for group in declarations.iter().flat_map(|uses| &uses.groups) {
        if groups.iter().all(|known| known.listing.name != group.listing.name) {
            groups.push(*group);
        }
    }
    groups
}

fn listings(groups: &[GroupEntry]) -> Vec<GroupListing> {
    groups.iter().map(|group| group.listing).collect()
}

/// The metrics that decide when outputs are due.
fn schedules(scenario: &Scenario) -> Vec<Schedule> {
    let of = |(index, output): (usize, &Chosen<dyn AnyOutput>)| {
        let name = output.name;
        let schedule = move |metric| (metric, name, format!("outputs[{index}].when"));
        output.value.metrics().into_iter().map(schedule).collect::<Vec<_>>()
    };
    scenario.outputs.iter().enumerate().flat_map(of).collect()
}

/// Measurements that the stop rule which looks back farthest looks at.
fn longest_rule(stages: &[StageEntry]) -> usize {
    stages.iter().map(|stage| stage.stop.measurements()).max().unwrap_or(1)
}

fn check_processes(stages: &[StageEntry], lattice: &Lattice) -> Result<(), Problem> {
    for (stage, entry) in stages.iter().enumerate() {
        for (index, process) in entry.processes.iter().enumerate() {
            let path = format!("stages[{stage}].processes[{index}]");
            process.value.validate(lattice).map_err(|problem| below(&path, problem))?;
        }
    }
    Ok(())
}

/// Checks that every field that is named exists and that every field that is read is provided.
fn check_names(
    scenario: &Scenario,
    fields: &FieldTable,
    declarations: &[Declaration],
) -> Result<(), Problem> {
    for (index, entry) in scenario.initial.iter().enumerate() {
        let path = format!("initial[{index}].field");
        let field = known_field(fields, &entry.field, path.clone())?;
        if !field.is_stored() {
            let message = format!("field `{}` is computed from others", entry.field);
            return Err(Problem::new(path, message, "a stored field").code(Code::InitialValues));
        }
    }
    let mut provided: Vec<&str> = scenario.initial.iter().map(|e| e.field.as_str()).collect();
    for uses in declarations {
        for (entry, access) in uses.fields() {
            if access == Access::Reads && entry.is_stored() && !provided.contains(&entry.name) {
                let message =
                    format!("nothing provides field `{}` ({})", entry.name, entry.meaning);
                let help =
                    format!("add (field: \"{}\", from: Uniform(value: 0.0)) say", entry.name);
                return Err(Problem::new("initial", message, "an entry for it")
                    .code(Code::NotProvided)
                    .help(help));
            }
            provided.push(entry.name);
        }
    }
    Ok(())
}

/// Checks that every metric can be measured in the run.
fn check_metrics(
    scenario: &Scenario,
    fields: &FieldTable,
    groups: &GroupTable,
    lattice: &Lattice,
) -> Result<(), Problem> {
    for (index, metric) in scenario.metrics.iter().enumerate() {
        let path = format!("metrics[{index}]");
        for field in metric.value.fields() {
            known_field(fields, &field, format!("{path}.field"))?;
        }
        known_groups(groups, &metric.value.groups(), &path)?;
        metric.value.validate(lattice).map_err(|problem| below(&path, problem))?;
    }
    Ok(())
}

/// Checks that every output can be made from the run, and that no two share a file.
fn check_outputs(
    scenario: &Scenario,
    fields: &FieldTable,
    groups: &GroupTable,
    lattice: &Lattice,
) -> Result<(), Problem> {
    for (index, output) in scenario.outputs.iter().enumerate() {
        let path = format!("outputs[{index}]");
        for field in output.value.fields() {
            known_field(fields, &field, format!("{path}.field"))?;
        }
        known_groups(groups, &output.value.groups(), &path)?;
        known_stages(&scenario.stages, &output.value.stages(), &path)?;
        output.value.validate(lattice).map_err(|problem| below(&path, problem))?;
        let Some(file) = output.value.file() else { continue };
        let earlier = &scenario.outputs[..index];
        if let Some(other) = earlier.iter().position(|other| other.value.file() == Some(file)) {
            let message = format!("outputs[{other}] writes `{}` already", file.display());
            let problem = Problem::new(format!("{path}.file"), message, "a file of its own");
            return Err(problem.code(Code::OutputFile));
        }
    }
    Ok(())
}

fn known_field<'a>(
    fields: &'a FieldTable,
    name: &str,
    path: String,
) -> Result<&'a FieldEntry, Problem> {
    fields.get(name).map_err(|unknown| {
        let problem = Problem::new(
            path,
            format!("no field is called `{name}`"),
            format!("one of {}", unknown.known.join(", ")),
        )
        .code(Code::NotInRun);
        match nearest(name, unknown.known.iter().copied()) {
            Some(guess) => problem.help(format!("did you mean {guess:?}?")),
            None => problem,
        }
    })
}

fn known_groups(groups: &GroupTable, uses: &[GroupUse], path: &str) -> Result<(), Problem> {
    let refuse = |parameter: &str, name: &str, message: String, known: &[&str]| {
        let problem = Problem::new(format!("{path}.{parameter}"), message, "").code(Code::NotInRun);
        match nearest(name, known.iter().copied()) {
            Some(guess) => problem.help(format!("did you mean {guess:?}?")),
            None => problem,
        }
    };
    for GroupUse { group, quantity } in uses {
        let unknown = |error: UnknownGroup| refuse("group", group, error.to_string(), &error.known);
        let listing = groups.get(group).map_err(unknown)?;
        let Some(name) = quantity else { continue };
        let unknown =
            |error: UnknownQuantity| refuse("quantity", name, error.to_string(), &error.known);
        listing.quantity(name).map_err(unknown)?;
    }
    Ok(())
}

/// Refuses names that no stage has.
fn known_stages(stages: &[StageEntry], named: &[String], path: &str) -> Result<(), Problem> {
    let known = || stages.iter().map(|stage| stage.name.as_str());
    let Some(name) = named.iter().find(|name| known().all(|stage| stage != name.as_str())) else {
        return Ok(());
    };
    let expected = format!("one of {}", known().collect::<Vec<_>>().join(", "));
    let message = format!("no stage is called `{name}`");
    let problem = Problem::new(path, message, expected).code(Code::NotInRun);
    Err(match nearest(name, known()) {
        Some(guess) => problem.help(format!("did you mean {guess:?}?")),
        None => problem,
    })
}

/// Fills the fields by the initial conditions, in order.
fn fill(app: &mut App, scenario: &Scenario, domain: &Domain, folder: &Path) -> Result<(), Problem> {
    let nodes = domain.lattice.node_count();
    for (index, entry) in scenario.initial.iter().enumerate() {
        let path = format!("initial[{index}]");
        let [low, high, ..] = RandomStream::new(scenario.seed, "initial").block(0, index, 0);
        let seed = u64::from(low) | u64::from(high) << 32;
        let context = InitialContext { domain, seed, folder };
        let from = format!("{path}.from");
        let new = entry.from.value.values(&context).map_err(|problem| below(&from, problem))?;
        if new.len() != nodes {
            let message = format!("{} values for {nodes} nodes", new.len());
            return Err(Problem::new(from, message, "one value a node").code(Code::InitialValues));
        }
        let world = app.world_mut();
        let field = known_field(world.resource::<FieldTable>(), &entry.field, path)?;
        let field = *field;
        let mut values = field.read(world);
        values.iter_mut().zip(&new).for_each(|(value, &new)| {
            *value = entry.combine.apply(*value, new);
        });
        if let Some(node) = values.iter().position(|value| !value.is_finite()) {
            let message = format!("field `{}` is {} at node {node}", field.name, values[node]);
            return Err(Problem::new(from, message, "finite values").code(Code::InitialValues));
        }
        field.write(world, &values);
    }
    check_least(app.world(), scenario)
}

/// Refuses values below the least that their field may have, once all entries are combined.
fn check_least(world: &World, scenario: &Scenario) -> Result<(), Problem> {
    for (index, entry) in scenario.initial.iter().enumerate() {
        let path = format!("initial[{index}]");
        let field = known_field(world.resource::<FieldTable>(), &entry.field, path.clone())?;
        let values = field.read(world);
        if let Some(node) = values.iter().position(|&value| value < field.least) {
            let FieldEntry { name, unit, least, .. } = field;
            let message =
                format!("field `{name}` starts with {} {unit} at node {node}", values[node]);
            let help = "raise its mean or lower its amplitude".to_owned();
            return Err(Problem::new(path, message, format!("at least {least} {unit}"))
                .code(Code::InitialValues)
                .help(help));
        }
    }
    Ok(())
}
