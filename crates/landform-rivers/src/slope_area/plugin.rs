//! The process `SlopeAreaErosion`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::world::World;
use landform_analysis::grid::{Grid, GridError};
use landform_graph::{Connectivity, Lattice};
use landform_sim::agent::{AgentGroup, AgentView, Agents, Quantity};
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut, NodeField, stored_values};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};

use super::kernel::{Event, drain, unstable_sites};
use super::params::SlopeAreaErosion;

/// Area that each node drains, itself included: the area map.
pub struct DrainageArea;

impl NodeField for DrainageArea {
    type Value = f64;
    const NAME: &'static str = "drainage_area";
    const UNIT: &'static str = "m2";
    const MEANING: &'static str = "area whose water passes the node, itself included";
    const LEAST: f64 = 0.0;
}

/// Offers the decimal logarithm of [`DrainageArea`], for pictures.
pub(crate) fn drainage_area_log10(uses: &mut Declaration) {
    let logarithm = |world: &World| {
        stored_values::<DrainageArea>(world).iter().map(|area| area.max(1.0).log10()).collect()
    };
    let meaning = "decimal logarithm of the drainage area in m2";
    uses.derives("drainage_area_log10", "1", meaning, logarithm);
}

/// The sites that were lowered in the latest iteration. A site that is lowered again stays a
/// member; none is left when the terrain is at rest.
pub struct ErodingSites;

impl AgentGroup for ErodingSites {
    /// Metres by which the site was lowered.
    type State = f64;
    type Globals = ();
    const NAME: &'static str = "eroding";
    const QUANTITIES: &'static [Quantity<f64>] =
        &[Quantity { name: "depth", unit: "m", of: |depth| *depth }];
}

impl Process for SlopeAreaErosion {
    const NAME: &'static str = "SlopeAreaErosion";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Bed>()
            .writes::<DrainageArea>()
            .group::<ErodingSites>()
            .conserves(Budget::volume::<Bed>(1e-12))
            .scratch(48);
        drainage_area_log10(uses);
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if lattice.connectivity() != Connectivity::Eight {
            let message = format!("the lattice joins {:?}", lattice.connectivity());
            return Err(Problem::new("", message, "`connectivity: Eight` in the domain"));
        }
        if lattice.is_periodic(0) || lattice.is_periodic(1) {
            let message = "the lattice is periodic, and rivers would run round it for ever";
            return Err(Problem::new("", message, "`boundary: (Open, Open)` in the domain"));
        }
        grid(lattice).map(|_| ()).map_err(|error| Problem::new("", error.to_string(), ""))
    }
}

impl Plugin for SlopeAreaErosion {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, map_area).add_systems(Iterate, erode);
    }
}

fn grid(lattice: &Lattice) -> Result<Grid, GridError> {
    Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2])
}

/// The area map of the terrain as it is.
fn map_area(
    settings: Res<Settings<SlopeAreaErosion>>,
    space: Res<Space>,
    mut fault: ResMut<Fault>,
    bed: Field<Bed>,
    mut area: FieldMut<DrainageArea>,
) {
    let mapped = settings.events(&space, bed.values(), area.values_mut());
    if let Err(error) = mapped {
        fault.raise(error.to_string());
    }
}

/// An iteration: the network is found, and all unstable sites erode.
fn erode(
    settings: Res<Settings<SlopeAreaErosion>>,
    space: Res<Space>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    mut bed: FieldMut<Bed>,
    mut area: FieldMut<DrainageArea>,
    mut sites: Agents<ErodingSites>,
) {
    let bed = bed.values_mut();
    match settings.events(&space, bed, area.values_mut()) {
        Ok(events) => {
            let lowered_m = lower(bed, &events, &mut sites.view());
            ledger.leave("bed", "eroded", lowered_m * space.spacing().powi(2));
        }
        Err(error) => fault.raise(error.to_string()),
    }
}

impl SlopeAreaErosion {
    /// Maps the drainage area and returns what it erodes.
    fn events(
        &self,
        lattice: &Lattice,
        bed: &[f64],
        area: &mut [f64],
    ) -> Result<Vec<Event>, GridError> {
        let grid = grid(lattice)?;
        let (surface, directions) = drain(&grid, bed, self.pits)?;
        let cells = directions.contributing_cells();
        for (area, &cells) in area.iter_mut().zip(&cells) {
            *area = f64::from(cells) * grid.cell_area();
        }
        Ok(unstable_sites(&surface, &directions, &cells, self.threshold_m))
    }
}

/// Lowers the sites of `events`, which become the members of the group, and returns the sum of the
/// depths in metres.
fn lower(bed: &mut [f64], events: &[Event], sites: &mut AgentView<'_, ErodingSites>) -> f64 {
    let mut eroding = events.iter().peekable();
    let members: Vec<usize> = sites.nodes().collect();
    for site in members {
        while eroding.next_if(|event| event.site < site).is_some() {}
        if eroding.next_if(|event| event.site == site).is_none() {
            sites.deregister(site);
        }
    }
    let mut lowered_m = 0.0;
    for &Event { site, height } in events {
        let depth = bed[site] - height;
        lowered_m += depth;
        bed[site] = height;
        match sites.get_mut(site) {
            Some(state) => *state = depth,
            None => _ = sites.register(site, depth),
        }
    }
    lowered_m
}
