//! System parameters that hand the values of a field to a kernel as one slice in node order.

use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::system::{Query, SystemParam};
use bytemuck::TransparentWrapper;

use super::{Column, NodeField};

/// Read access to the field `F` in a system.
#[derive(SystemParam)]
pub struct Field<'w, 's, F: NodeField> {
    columns: Query<'w, 's, &'static Column<F>>,
}

impl<F: NodeField> Field<'_, '_, F> {
    /// The values, one a node, in node order.
    pub fn values(&self) -> &[F::Value] {
        one_slice::<F, _>(self.columns.contiguous_iter().ok().into_iter().flatten())
            .map_or(&[], TransparentWrapper::peel_slice)
    }
}

/// Write access to the field `F` in a system.
#[derive(SystemParam)]
pub struct FieldMut<'w, 's, F: NodeField> {
    columns: Query<'w, 's, &'static mut Column<F>>,
}

impl<F: NodeField> FieldMut<'_, '_, F> {
    /// The values, one a node, in node order.
    pub fn values(&self) -> &[F::Value] {
        one_slice::<F, _>(self.columns.contiguous_iter().ok().into_iter().flatten())
            .map_or(&[], TransparentWrapper::peel_slice)
    }

    /// The values for writing, one a node, in node order. Change ticks are not marked:
    /// nothing in Landform reads them, and marking costs as much as a simple kernel.
    pub fn values_mut(&mut self) -> &mut [F::Value] {
        one_slice::<F, _>(self.columns.contiguous_iter_mut().ok().into_iter().flatten())
            .map(|column| ContiguousMut::bypass_change_detection_split(column).0)
            .map_or(&mut [], TransparentWrapper::peel_slice_mut)
    }
}

/// The only slice of a column: all nodes live in one table because they are spawned once, with
/// every field, and never despawned.
pub(crate) fn one_slice<F: NodeField, S>(mut slices: impl Iterator<Item = S>) -> Option<S> {
    let first = slices.next();
    assert!(
        slices.next().is_none(),
        "field `{}` lies in several tables: a system changed the components of some nodes; \
         use an agent group for what only some nodes have",
        F::NAME
    );
    first
}
