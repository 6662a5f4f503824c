//! What a scenario may name: domains, initial conditions, processes, metrics and outputs.
//!
//! Registration is explicit and in order; a program registers its own types beside the built-in
//! ones before it reads a scenario.

mod chosen;
mod kinds;

pub use chosen::Chosen;
pub use kinds::{AnyDomain, AnyInitial, AnyMetric, AnyOutput, AnyParameters, AnyProcess};

pub(crate) use chosen::reading;

use serde_json::Value;

use crate::domain::{DomainSource, Grid, Volume};
use crate::initial::InitialCondition;
use crate::metric::Metric;
use crate::output::Output;
use crate::parameters::{ParameterDescription, Parameters, describe, schema_of};
use crate::process::Process;

/// Reads the parameters of an entry from whatever stands after its name.
type Reader<T> = fn(&mut dyn erased_serde::Deserializer<'_>) -> erased_serde::Result<Box<T>>;

/// A registered type: its name, its parameters and how to read them.
pub struct Entry<T: ?Sized> {
    /// Name in scenarios.
    pub name: &'static str,
    schema: fn() -> Value,
    describe: fn() -> Vec<ParameterDescription>,
    pub(crate) read: Reader<T>,
}

impl<T: ?Sized> Entry<T> {
    fn of<P: Parameters>(name: &'static str, read: Reader<T>) -> Self {
        Self { name, schema: schema_of::<P>, describe: describe::<P>, read }
    }

    /// What it is: the doc comment of the type.
    pub fn description(&self) -> String {
        (self.schema)()["description"].as_str().unwrap_or_default().to_owned()
    }

    /// Its parameters in the order of their definition.
    pub fn parameters(&self) -> Vec<ParameterDescription> {
        (self.describe)()
    }

    /// JSON schema of its parameters.
    pub fn schema(&self) -> Value {
        (self.schema)()
    }
}

/// The registered types of one kind, in the order of registration.
pub struct Kind<T: ?Sized> {
    entries: Vec<Entry<T>>,
}

impl<T: ?Sized> Default for Kind<T> {
    fn default() -> Self {
        Self { entries: Vec::new() }
    }
}

impl<T: ?Sized> Kind<T> {
    /// The registered types in the order of registration.
    pub fn iter(&self) -> impl Iterator<Item = &Entry<T>> {
        self.entries.iter()
    }

    /// The type called `name`.
    pub fn get(&self, name: &str) -> Option<&Entry<T>> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    /// Names in the order of registration.
    pub fn names(&self) -> Vec<&'static str> {
        self.entries.iter().map(|entry| entry.name).collect()
    }

    /// Adds an entry, in place of an earlier one of the same name.
    fn insert(&mut self, entry: Entry<T>) {
        self.entries.retain(|known| known.name != entry.name);
        self.entries.push(entry);
    }
}

/// Everything a scenario may name.
#[derive(Default)]
pub struct Registry {
    /// Ways to make a domain.
    pub domains: Kind<dyn AnyDomain>,
    /// Initial conditions.
    pub initial: Kind<dyn AnyInitial>,
    /// Processes.
    pub processes: Kind<dyn AnyProcess>,
    /// Metrics.
    pub metrics: Kind<dyn AnyMetric>,
    /// Outputs.
    pub outputs: Kind<dyn AnyOutput>,
}

impl Registry {
    /// A registry with what the framework itself offers: the domains [`Grid`] and [`Volume`].
    pub fn new() -> Self {
        let mut registry = Self::default();
        registry.domain::<Grid>().domain::<Volume>();
        registry
    }

    /// Registers a way to make a domain. A later type of the same name takes the place of the
    /// earlier one, here and in the other methods.
    pub fn domain<D: DomainSource>(&mut self) -> &mut Self {
        self.domains.insert(Entry::of::<D>(D::NAME, |from| Ok(Box::new(read::<D>(from)?))));
        self
    }

    /// Registers an initial condition.
    pub fn initial<I: InitialCondition>(&mut self) -> &mut Self {
        self.initial.insert(Entry::of::<I>(I::NAME, |from| Ok(Box::new(read::<I>(from)?))));
        self
    }

    /// Registers a process.
    pub fn process<P: Process>(&mut self) -> &mut Self {
        self.processes.insert(Entry::of::<P>(P::NAME, |from| Ok(Box::new(read::<P>(from)?))));
        self
    }

    /// Registers a metric.
    pub fn metric<M: Metric>(&mut self) -> &mut Self {
        self.metrics.insert(Entry::of::<M>(M::NAME, |from| Ok(Box::new(read::<M>(from)?))));
        self
    }

    /// Registers an output.
    pub fn output<O: Output>(&mut self) -> &mut Self {
        self.outputs.insert(Entry::of::<O>(O::NAME, |from| Ok(Box::new(read::<O>(from)?))));
        self
    }
}

fn read<P: Parameters>(from: &mut dyn erased_serde::Deserializer<'_>) -> erased_serde::Result<P> {
    erased_serde::deserialize(from)
}
