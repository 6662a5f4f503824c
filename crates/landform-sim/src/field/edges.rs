//! Fields on directed edges: what flows between neighbours (thesis, section 3.2.3).

use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use landform_graph::Lattice;

use super::Number;
use crate::checkpoint::{Damage, Loader, Saver};

/// A field on directed edges: a number on every edge that leaves a node.
///
/// Implement it for an empty marker type and name it in
/// [`Declaration::edges`](crate::process::Declaration::edges); systems then ask for
/// `Res<OnEdges<F>>` or `ResMut<OnEdges<F>>`.
pub trait EdgeField: Send + Sync + 'static {
    /// Type of the number on an edge.
    type Value: Number;
    /// Name in reports, in lower case.
    const NAME: &'static str;
    /// Unit of the values, `"1"` when they have none.
    const UNIT: &'static str;
    /// What the value means, in a few words.
    const MEANING: &'static str;
}

/// The values of field `F` on edges: one slot for every node and direction, as
/// [`Lattice::slot`] and [`Lattice::reverse_slot`] number them. They start at zero.
///
/// Memory: the size of a value times [`Lattice::directions`] a node, which is 4 to 8 on a plane
/// and 6 to 26 in a volume; no more, as edges are no entities. Checkpoints save them.
#[derive(Resource)]
pub struct OnEdges<F: EdgeField> {
    values: Vec<F::Value>,
    directions: usize,
}

impl<F: EdgeField> OnEdges<F> {
    /// Zero on every edge.
    pub fn new(lattice: &Lattice) -> Self {
        let values = vec![F::Value::default(); lattice.slots()];
        Self { values, directions: lattice.directions() }
    }

    /// The values by slot.
    pub fn values(&self) -> &[F::Value] {
        &self.values
    }

    /// The values by slot, for writing.
    pub fn values_mut(&mut self) -> &mut [F::Value] {
        &mut self.values
    }

    /// The values on the edges that leave `node`, by direction.
    pub fn leaving(&self, node: usize) -> &[F::Value] {
        &self.values[node * self.directions..][..self.directions]
    }

    /// The values on the edges that leave `node`, by direction, for writing.
    pub fn leaving_mut(&mut self, node: usize) -> &mut [F::Value] {
        &mut self.values[node * self.directions..][..self.directions]
    }

    /// Saves the values of a run.
    pub(crate) fn save<'a>(world: &'a World, to: &mut Saver<'_, 'a>) {
        if let Some(edges) = world.get_resource::<Self>() {
            to.array("", &edges.values);
        }
    }

    /// Puts saved values in the place of those of a run.
    pub(crate) fn restore(world: &mut World, from: &Loader<'_>) -> Result<(), Damage> {
        let Some(mut edges) = world.get_resource_mut::<Self>() else { return Ok(()) };
        let values = from.array_of("", edges.values.len())?;
        edges.values.copy_from_slice(values);
        Ok(())
    }
}

/// A field on edges without its type.
#[derive(Clone, Copy, Debug)]
pub struct EdgeFieldEntry {
    /// Name in reports.
    pub name: &'static str,
    /// Unit of the values.
    pub unit: &'static str,
    /// What the value means.
    pub meaning: &'static str,
    /// Bytes that a direction of a node takes.
    pub bytes: usize,
    pub(crate) make: fn(&mut World, &Lattice),
    pub(crate) finite: fn(&World) -> bool,
}

impl EdgeFieldEntry {
    /// The entry of field `F`.
    pub(crate) fn of<F: EdgeField>() -> Self {
        Self {
            name: F::NAME,
            unit: F::UNIT,
            meaning: F::MEANING,
            bytes: size_of::<F::Value>(),
            make: |world, lattice| {
                if !world.contains_resource::<OnEdges<F>>() {
                    world.insert_resource(OnEdges::<F>::new(lattice));
                }
            },
            finite: |world| {
                let edges = world.get_resource::<OnEdges<F>>();
                edges.is_none_or(|edges| F::Value::all_finite(&edges.values))
            },
        }
    }
}
