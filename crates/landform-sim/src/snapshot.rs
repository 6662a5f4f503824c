//! A run as metrics and outputs see it: everything by name, nothing to change.

use bevy_ecs::world::World;
use landform_graph::Lattice;

use crate::agent::{GroupSnapshot, GroupTable, UnknownGroup};
use crate::clock::Clock;
use crate::domain::Domain;
use crate::field::{FieldEntry, FieldTable, UnknownField};
use crate::ledger::Ledger;
use crate::metric::Series;
use crate::nodes::Space;

/// Read access to a run between two iterations.
#[derive(Clone, Copy)]
pub struct Snapshot<'a> {
    world: &'a World,
    domain: &'a Domain,
    stage_name: &'a str,
    title: &'a str,
    series: &'a Series,
}

impl<'a> Snapshot<'a> {
    pub(crate) fn new(
        world: &'a World,
        domain: &'a Domain,
        title: &'a str,
        stage_name: &'a str,
        series: &'a Series,
    ) -> Self {
        Self { world, domain, stage_name, title, series }
    }

    /// Values of a stored or derived field, in node order.
    ///
    /// # Errors
    /// [`UnknownField`] lists the names there are.
    pub fn field(&self, name: &str) -> Result<Vec<f64>, UnknownField> {
        Ok(self.entry(name)?.read(self.world))
    }

    /// What is known of a field.
    ///
    /// # Errors
    /// [`UnknownField`] lists the names there are.
    pub fn entry(&self, name: &str) -> Result<&'a FieldEntry, UnknownField> {
        self.world.resource::<FieldTable>().get(name)
    }

    /// All fields of the run.
    pub fn fields(&self) -> impl Iterator<Item = &'a FieldEntry> {
        self.world.resource::<FieldTable>().iter()
    }

    /// The agents of a group.
    ///
    /// # Errors
    /// [`UnknownGroup`] lists the names there are.
    pub fn group(&self, name: &str) -> Result<GroupSnapshot<'a>, UnknownGroup> {
        let listing = self.world.resource::<GroupTable>().get(name)?;
        Ok(GroupSnapshot::new(listing, self.world))
    }

    /// What was measured so far.
    pub fn series(&self) -> &'a Series {
        self.series
    }

    /// The lattice.
    pub fn lattice(&self) -> &'a Lattice {
        &self.world.resource::<Space>().0
    }

    /// The domain with its raster and georeference.
    pub fn domain(&self) -> &'a Domain {
        self.domain
    }

    /// Iterations done, stage and seed.
    pub fn clock(&self) -> Clock {
        *self.world.resource::<Clock>()
    }

    /// Name of the present stage.
    pub fn stage_name(&self) -> &'a str {
        self.stage_name
    }

    /// Title of the scenario.
    pub fn title(&self) -> &'a str {
        self.title
    }

    /// The ledger of the run.
    pub fn ledger(&self) -> &'a Ledger {
        self.world.resource::<Ledger>()
    }

    /// The world itself, for metrics that read resources of their process.
    pub fn world(&self) -> &'a World {
        self.world
    }
}
