//! The registered kinds without their types, for scenarios that name them at run time.

use std::path::Path;

use bevy_app::App;
use landform_graph::Lattice;
use serde_json::Value;

use super::{Kind, Registry};
use crate::agent::GroupUse;
use crate::domain::{Domain, DomainSource};
use crate::initial::{InitialCondition, InitialContext};
use crate::metric::{Meter, Metric, Opened};
use crate::output::{Output, Sink};
use crate::parameters::{Parameters, Problem, check};
use crate::process::{Declaration, Process, Settings};

/// Parameters without their type.
pub trait AnyParameters {
    /// Values out of the ranges of their definition.
    fn check(&self) -> Vec<Problem>;

    /// The parameters with all defaults filled in.
    fn to_json(&self) -> Value;
}

impl<P: Parameters> AnyParameters for P {
    fn check(&self) -> Vec<Problem> {
        check(self)
    }

    fn to_json(&self) -> Value {
        serde_json::to_value(self).unwrap_or_default()
    }
}

/// A kind of registered type, as the reader of scenarios needs it.
pub(super) trait Registered {
    /// Name of the kind in messages.
    const WHAT: &'static str;

    /// The registered types of this kind.
    fn kind(registry: &Registry) -> &Kind<Self>;
}

macro_rules! registered {
    ($($type:ident, $what:literal, $field:ident;)*) => {$(
        impl Registered for dyn $type {
            const WHAT: &'static str = $what;
            fn kind(registry: &Registry) -> &Kind<Self> {
                &registry.$field
            }
        }
    )*};
}

registered! {
    AnyDomain, "domain", domains;
    AnyInitial, "initial condition", initial;
    AnyProcess, "process", processes;
    AnyMetric, "metric", metrics;
    AnyOutput, "output", outputs;
}

/// A [`DomainSource`] without its type.
pub trait AnyDomain: AnyParameters {
    /// See [`DomainSource::nodes`].
    fn nodes(&self) -> Option<u128>;

    /// See [`DomainSource::make`].
    ///
    /// # Errors
    /// As the source says.
    fn make(&self, folder: &Path) -> Result<Domain, Problem>;
}

impl<D: DomainSource> AnyDomain for D {
    fn nodes(&self) -> Option<u128> {
        DomainSource::nodes(self)
    }

    fn make(&self, folder: &Path) -> Result<Domain, Problem> {
        DomainSource::make(self, folder)
    }
}

/// An [`InitialCondition`] without its type.
pub trait AnyInitial: AnyParameters {
    /// See [`InitialCondition::values`].
    ///
    /// # Errors
    /// As the condition says.
    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem>;
}

impl<I: InitialCondition> AnyInitial for I {
    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        InitialCondition::values(self, context)
    }
}

/// A [`Process`] without its type.
pub trait AnyProcess: AnyParameters {
    /// See [`Process::declare`].
    fn declaration(&self) -> Declaration;

    /// See [`Process::validate`].
    ///
    /// # Errors
    /// As the process says.
    fn validate(&self, lattice: &Lattice) -> Result<(), Problem>;

    /// See [`Process::iterations`].
    fn iterations(&self) -> Option<u64>;

    /// Adds the process to an app.
    fn build(&self, app: &mut App);
}

impl<P: Process> AnyProcess for P {
    fn declaration(&self) -> Declaration {
        let mut declaration = Declaration::default();
        self.declare(&mut declaration);
        declaration.rebuilds::<Settings<P>>();
        declaration
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        Process::validate(self, lattice)
    }

    fn iterations(&self) -> Option<u64> {
        Process::iterations(self)
    }

    fn build(&self, app: &mut App) {
        bevy_app::Plugin::build(self, app);
    }
}

/// A [`Metric`] without its type.
pub trait AnyMetric: AnyParameters {
    /// See [`Metric::fields`].
    fn fields(&self) -> Vec<String>;

    /// See [`Metric::groups`].
    fn groups(&self) -> Vec<GroupUse>;

    /// See [`Metric::validate`].
    ///
    /// # Errors
    /// As the metric says.
    fn validate(&self, lattice: &Lattice) -> Result<(), Problem>;

    /// The metric at work, with nothing to remember so far.
    fn open(&self) -> Box<dyn Meter>;
}

impl<M: Metric> AnyMetric for M {
    fn fields(&self) -> Vec<String> {
        Metric::fields(self)
    }

    fn groups(&self) -> Vec<GroupUse> {
        Metric::groups(self)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        Metric::validate(self, lattice)
    }

    fn open(&self) -> Box<dyn Meter> {
        Box::new(Opened { metric: self.clone(), memory: M::Memory::default() })
    }
}

/// An [`Output`] without its type.
pub trait AnyOutput: AnyParameters {
    /// See [`Output::fields`].
    fn fields(&self) -> Vec<String>;

    /// See [`Output::groups`].
    fn groups(&self) -> Vec<GroupUse>;

    /// See [`Output::metrics`].
    fn metrics(&self) -> Vec<String>;

    /// See [`Output::stages`].
    fn stages(&self) -> Vec<String>;

    /// See [`Output::file`].
    fn file(&self) -> Option<&Path>;

    /// See [`Output::validate`].
    ///
    /// # Errors
    /// As the output says.
    fn validate(&self, lattice: &Lattice) -> Result<(), Problem>;

    /// See [`Output::open`].
    fn open(&self) -> Box<dyn Sink>;
}

impl<O: Output> AnyOutput for O {
    fn fields(&self) -> Vec<String> {
        Output::fields(self)
    }

    fn groups(&self) -> Vec<GroupUse> {
        Output::groups(self)
    }

    fn metrics(&self) -> Vec<String> {
        Output::metrics(self)
    }

    fn stages(&self) -> Vec<String> {
        Output::stages(self)
    }

    fn file(&self) -> Option<&Path> {
        Output::file(self)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        Output::validate(self, lattice)
    }

    fn open(&self) -> Box<dyn Sink> {
        Output::open(self)
    }
}
