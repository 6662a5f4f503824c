//! The fields of a run by name, for scenarios, metrics, pictures and files.

use std::any::TypeId;

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use bytemuck::TransparentWrapper;
use thiserror::Error;

use super::param::one_slice;
use super::{Bed, Column, NodeField, Number, Sand};
use crate::checkpoint::{Damage, Loader, Saver};
use crate::process::{Restore, Save};

/// A name that is no field of the run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no field is called `{name}`; the fields are: {}", known.join(", "))]
pub struct UnknownField {
    /// The name asked for.
    pub name: String,
    /// The names there are.
    pub known: Vec<&'static str>,
}

/// A stored or a derived field of a run.
#[derive(Clone, Copy, Debug)]
pub struct FieldEntry {
    /// Name in scenarios, reports and files.
    pub name: &'static str,
    /// Unit of the values.
    pub unit: &'static str,
    /// What the value means.
    pub meaning: &'static str,
    /// The least value that a run may start with.
    pub least: f64,
    /// Bytes a node takes, zero for derived fields.
    pub bytes: usize,
    marker: Option<TypeId>,
    read: fn(&World) -> Vec<f64>,
    write: Option<fn(&mut World, &[f64])>,
    codec: Option<(Save, Restore)>,
    finite: fn(&World) -> bool,
    declare: fn(&mut World),
}

/// Bytes of the two change ticks that a component carries beside its value.
const TICKS: usize = 8;

impl FieldEntry {
    /// The entry of a stored field.
    pub fn stored<F: NodeField>() -> Self {
        Self {
            name: F::NAME,
            unit: F::UNIT,
            meaning: F::MEANING,
            least: F::LEAST,
            bytes: size_of::<F::Value>() + TICKS,
            marker: Some(TypeId::of::<F>()),
            read: read_column::<F>,
            write: Some(write_column::<F>),
            codec: Some((save_column::<F>, restore_column::<F>)),
            finite: |world| F::Value::all_finite(stored_values::<F>(world)),
            declare: |world| {
                world.register_required_components::<crate::nodes::Node, Column<F>>();
            },
        }
    }

    /// The entry of a field that is computed from others whenever it is asked for.
    pub fn derived(
        name: &'static str,
        unit: &'static str,
        meaning: &'static str,
        read: fn(&World) -> Vec<f64>,
    ) -> Self {
        Self {
            name,
            unit,
            meaning,
            least: f64::NEG_INFINITY,
            bytes: 0,
            marker: None,
            read,
            write: None,
            codec: None,
            finite: |_| true,
            declare: |_| {},
        }
    }

    /// Values as doubles in node order.
    pub fn read(&self, world: &World) -> Vec<f64> {
        (self.read)(world)
    }

    /// Replaces the values; a derived field stays as it is and `false` is returned.
    pub fn write(&self, world: &mut World, values: &[f64]) -> bool {
        self.write.map(|write| write(world, values)).is_some()
    }

    /// Saves the stored values; derived ones follow from others.
    pub(crate) fn save<'a>(&self, world: &'a World, to: &mut Saver<'_, 'a>) {
        if let Some((save, _)) = self.codec {
            save(world, &mut to.below(self.name));
        }
    }

    /// Replaces the stored values by those that were saved.
    pub(crate) fn restore(&self, world: &mut World, from: &Loader<'_>) -> Result<(), Damage> {
        self.codec.map_or(Ok(()), |(_, restore)| restore(world, &from.below(self.name)))
    }

    /// Whether all stored values are finite; derived fields are not looked at.
    pub(crate) fn is_finite(&self, world: &World) -> bool {
        (self.finite)(world)
    }

    /// Whether the values are stored rather than computed.
    pub fn is_stored(&self) -> bool {
        self.write.is_some()
    }
}

/// Every field of a run, in the order of declaration.
#[derive(Resource, Clone, Debug, Default)]
pub struct FieldTable {
    entries: Vec<FieldEntry>,
}

impl FieldTable {
    /// Adds a field unless it is there already. `false` when the name belongs to another field.
    pub fn insert(&mut self, entry: FieldEntry) -> bool {
        match self.entries.iter().find(|known| known.name == entry.name) {
            Some(known) => known.marker == entry.marker,
            None => {
                self.entries.push(entry);
                true
            }
        }
    }

    /// The field called `name`.
    ///
    /// # Errors
    /// [`UnknownField`] lists the names there are.
    pub fn get(&self, name: &str) -> Result<&FieldEntry, UnknownField> {
        self.entries.iter().find(|entry| entry.name == name).ok_or_else(|| UnknownField {
            name: name.to_owned(),
            known: self.entries.iter().map(|entry| entry.name).collect(),
        })
    }

    /// The fields in the order of their declaration.
    pub fn iter(&self) -> impl Iterator<Item = &FieldEntry> {
        self.entries.iter()
    }

    /// Bytes a node takes in all stored fields.
    pub fn bytes_per_node(&self) -> usize {
        self.entries.iter().map(|entry| entry.bytes).sum()
    }

    /// Makes the stored fields required components of nodes, before any node exists.
    pub(crate) fn declare_all(&self, world: &mut World) {
        for entry in &self.entries {
            (entry.declare)(world);
        }
    }
}

/// Elevation of the surface: bed and sand together, whichever of them the run has.
pub fn surface(world: &World) -> Vec<f64> {
    let mut surface = read_column::<Bed>(world);
    let sand = read_column::<Sand>(world);
    if surface.is_empty() {
        return sand;
    }
    surface.iter_mut().zip(&sand).for_each(|(height, sand)| *height += sand);
    surface
}

/// Values of a stored field; empty when the run does not have it.
pub fn read_column<F: NodeField>(world: &World) -> Vec<f64> {
    stored_values::<F>(world).iter().map(|value| value.to_f64()).collect()
}

/// Values of a stored field as one slice in node order; empty when the run does not have it.
pub fn stored_values<F: NodeField>(world: &World) -> &[F::Value] {
    let Some(mut query) = world.try_query::<&Column<F>>() else { return &[] };
    one_slice::<F, _>(query.contiguous_iter(world).ok().into_iter().flatten())
        .map_or(&[], TransparentWrapper::peel_slice)
}

fn write_column<F: NodeField>(world: &mut World, values: &[f64]) {
    change_column::<F>(world, |column| {
        column.iter_mut().zip(values).for_each(|(slot, &value)| *slot = F::Value::from_f64(value));
    });
}

fn save_column<'a, F: NodeField>(world: &'a World, to: &mut Saver<'_, 'a>) {
    to.array("", stored_values::<F>(world));
}

fn restore_column<F: NodeField>(world: &mut World, from: &Loader<'_>) -> Result<(), Damage> {
    let values = from.array_of("", stored_values::<F>(world).len())?;
    change_column::<F>(world, |column| column.copy_from_slice(values));
    Ok(())
}

fn change_column<F: NodeField>(world: &mut World, change: impl FnOnce(&mut [F::Value])) {
    let mut query = world.query::<&mut Column<F>>();
    let columns = query.contiguous_iter_mut(world).ok().into_iter().flatten();
    let Some(column) = one_slice::<F, _>(columns) else { return };
    let column = ContiguousMut::bypass_change_detection_split(column).0;
    change(TransparentWrapper::peel_slice_mut(column));
}
