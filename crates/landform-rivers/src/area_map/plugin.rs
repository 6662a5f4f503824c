//! The process `AreaMapErosion`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, FieldMut};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Declaration, Iterate, Process, ProcessApp, Settings};

use super::{AreaMapErosion, evolve};
use crate::RiverError;
use crate::plugin::{book, refusal};
use crate::slope_area::DrainageArea;
use crate::water::border_nodes;

impl Process for AreaMapErosion {
    const NAME: &'static str = "AreaMapErosion";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Bed>()
            .writes::<DrainageArea>()
            .conserves(Budget::volume::<Bed>(1e-12))
            .scratch(96);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.check(lattice).map_err(|error| {
            let parameter = match error {
                RiverError::LongStep { .. } => "step_yr",
                _ => "",
            };
            refusal(&error, parameter)
        })
    }
}

impl Plugin for AreaMapErosion {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, pass);
    }
}

/// An iteration.
fn pass(
    settings: Res<Settings<AreaMapErosion>>,
    space: Res<Space>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    mut bed: FieldMut<Bed>,
    mut area: FieldMut<DrainageArea>,
) {
    let sides = settings.fixed_sides();
    let fixed: Vec<usize> = sides.into_iter().flat_map(|side| border_nodes(&space, side)).collect();
    match evolve(&space, &settings, bed.values_mut(), &fixed) {
        Ok(evolved) => {
            area.values_mut().copy_from_slice(&evolved.area_m2);
            book(&evolved.change, space.spacing().powi(2), &mut ledger);
        }
        Err(error) => fault.raise(error.to_string()),
    }
}
