//! The process `Smoothing`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut, Sand};
use landform_sim::ledger::Budget;
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::dunes::refusal;
use crate::dunes::{SmoothingSettings, smooth};

/// Diffusion of sand over the bed, dh/dt = K lap(h): one explicit step an iteration.
///
/// The thesis ends its dune runs with ten steps to hide the grooves that discrete wind
/// directions leave (section 4.1.1, equation 4.1). Conserves sand and never erodes the bed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Smoothing {
    /// Diffusivity K times the step; stable up to a quarter of the spacing squared.
    #[schemars(range(min = 0.0, max = 1e12), extend("x-unit" = "m2", "x-source" = "thesis, table 4.2"))]
    pub diffusivity_m2: f64,
}

impl Default for Smoothing {
    fn default() -> Self {
        Self { diffusivity_m2: SmoothingSettings::default().diffusivity_m2 }
    }
}

impl Smoothing {
    fn step(&self) -> SmoothingSettings {
        SmoothingSettings { diffusivity_m2: self.diffusivity_m2, steps: 1 }
    }
}

impl Process for Smoothing {
    const NAME: &'static str = "Smoothing";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Bed>()
            .writes::<Sand>()
            .conserves(Budget::volume::<Sand>(1e-12))
            .scratch(16);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.step().validate(lattice).map_err(|error| refusal(&error))
    }
}

impl Plugin for Smoothing {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, diffuse);
    }
}

fn diffuse(
    settings: Res<Settings<Smoothing>>,
    space: Res<Space>,
    mut fault: ResMut<Fault>,
    bed: Field<Bed>,
    mut sand: FieldMut<Sand>,
) {
    if let Err(error) = smooth(&space, &settings.step(), bed.values(), sand.values_mut()) {
        fault.raise(error.to_string());
    }
}
