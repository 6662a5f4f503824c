//! The process `StreamPowerErosion`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut, NodeField};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::outside::Outside;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};

use super::{Evolution, Evolved, StreamPowerErosion};
use crate::RiverError;
use crate::plugin::refusal;
use crate::slope_area::{DrainageArea, drainage_area_log10};

/// Uplift beside that which acts everywhere.
pub struct Uplift;

impl NodeField for Uplift {
    type Value = f64;
    const NAME: &'static str = "uplift";
    const UNIT: &'static str = "m/yr";
    const MEANING: &'static str = "uplift beside that which acts everywhere";
}

/// What erosion removes.
pub struct ErosionRate;

impl NodeField for ErosionRate {
    type Value = f64;
    const NAME: &'static str = "erosion_rate";
    const UNIT: &'static str = "m/yr";
    const MEANING: &'static str =
        "what streams and creep removed in the latest iteration, less than 0 where they deposit";
}

impl Process for StreamPowerErosion {
    const NAME: &'static str = "StreamPowerErosion";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Uplift>()
            .writes::<Bed>()
            .writes::<DrainageArea>()
            .writes::<ErosionRate>()
            .rebuilds::<Works>()
            .conserves(Budget::volume::<Bed>(1e-12))
            .scratch(Evolution::BYTES);
        drainage_area_log10(uses);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.check(lattice).map_err(|error| {
            let parameter = match error {
                RiverError::LongStep { .. } => "step_yr",
                RiverError::NoBorder { .. } | RiverError::NoOutlet => "base_level",
                _ => "",
            };
            refusal(&error, parameter)
        })
    }
}

impl Plugin for StreamPowerErosion {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, lay_out).add_systems(Iterate, pass);
    }
}

/// The ground at work; all of it follows from parameters and lattice.
#[derive(Resource)]
struct Works(Evolution);

fn lay_out(
    mut commands: Commands,
    settings: Res<Settings<StreamPowerErosion>>,
    (space, outside): (Res<Space>, Res<Outside>),
    mut fault: ResMut<Fault>,
) {
    match Evolution::new(&space, &settings) {
        Ok(mut evolution) => {
            evolution.keep(outside.nodes());
            commands.insert_resource(Works(evolution));
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

/// An iteration.
fn pass(
    (settings, space): (Res<Settings<StreamPowerErosion>>, Res<Space>),
    mut works: ResMut<Works>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    uplift: Field<Uplift>,
    mut bed: FieldMut<Bed>,
    (mut area, mut rate): (FieldMut<DrainageArea>, FieldMut<ErosionRate>),
) {
    let evolution = &mut works.0;
    match evolution.step(bed.values_mut(), uplift.values()) {
        Ok(evolved) => {
            let area_m2 = space.spacing().powi(2);
            let cells = evolution.routes().cells();
            let areas = area.values_mut().iter_mut().zip(cells);
            areas.for_each(|(area, &cells)| *area = f64::from(cells) * area_m2);
            let rates = rate.values_mut().iter_mut().zip(evolution.lost_m());
            rates.for_each(|(rate, lost)| *rate = lost / settings.step_yr);
            book(&evolved, area_m2, &mut ledger);
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

/// Books what the bed gained and lost.
fn book(evolved: &Evolved, area_m2: f64, ledger: &mut Ledger) {
    let Evolved { uplifted_m, incised_m, crept_m } = *evolved;
    for (place, gained_m) in
        [("uplift", uplifted_m), ("incision", -incised_m), ("creep over the base level", -crept_m)]
    {
        if gained_m > 0.0 {
            ledger.enter("bed", place, gained_m * area_m2);
        } else if gained_m < 0.0 {
            ledger.leave("bed", place, -gained_m * area_m2);
        }
    }
}
