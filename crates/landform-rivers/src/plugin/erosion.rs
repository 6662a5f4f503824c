//! The process `HydraulicErosion`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::outside::Outside;
use landform_sim::parameters::Problem;
use landform_sim::process::{Declaration, Iterate, Process, ProcessApp, Settings};
use landform_sim::sums::sum;

use super::fields::Flow;
use super::refusal;
use crate::RiverError;
use crate::erosion::{Change, HydraulicErosion, erode, flow_map};
use crate::water::border_nodes;

impl Process for HydraulicErosion {
    const NAME: &'static str = "HydraulicErosion";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Flow>()
            .writes::<Bed>()
            .conserves(Budget::volume::<Bed>(1e-12))
            .scratch(64);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.check(lattice).map_err(|error| {
            let parameter = match error {
                RiverError::Stiff { .. } => "diffusion_m2",
                RiverError::NoBorder { .. } => "base_level",
                _ => "",
            };
            refusal(&error, parameter)
        })
    }
}

impl Plugin for HydraulicErosion {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, wear);
    }
}

/// An iteration of erosion.
fn wear(
    settings: Res<Settings<HydraulicErosion>>,
    (space, outside): (Res<Space>, Res<Outside>),
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    flow: Field<Flow>,
    mut bed: FieldMut<Bed>,
) {
    let f = flow_map(&space, &settings, bed.values(), flow.values());
    let sides = settings.base_level.iter().flat_map(|&side| border_nodes(&space, side));
    let fixed: Vec<usize> = sides.chain(outside.nodes()).collect();
    let area_m2 = space.spacing().powi(2);
    match erode(&space, &settings, &f, bed.values_mut(), &fixed) {
        Ok(change) => book(&change, area_m2, &mut ledger),
        Err(error) => return fault.raise(error.to_string()),
    }
    if !outside.is_empty() {
        follow(&outside, bed.values_mut(), area_m2, &mut ledger);
    }
}

/// Brings nodes outside the map to the height of its edge, so that no bank grows along it.
fn follow(outside: &Outside, bed: &mut [f64], area_m2: f64, ledger: &mut Ledger) {
    let risen: Vec<f64> =
        outside.pairs().iter().map(|&(node, nearest)| bed[nearest] - bed[node]).collect();
    outside.extend(bed);
    match sum(&risen) * area_m2 {
        raised if raised > 0.0 => ledger.enter("bed", "outside the map", raised),
        lowered => ledger.leave("bed", "outside the map", -lowered),
    }
}

/// Books what the bed lost and gained.
pub(crate) fn book(change: &Change, area_m2: f64, ledger: &mut Ledger) {
    ledger.leave("bed", "erosion", change.eroded_m * area_m2);
    ledger.enter("bed", "deposition by diffusion", change.deposited_m * area_m2);
    if change.uplifted_m > 0.0 {
        ledger.enter("bed", "uplift", change.uplifted_m * area_m2);
    }
}
