//! The Game of Life with agents: living cells are born and die.

use landform_sim::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::life::{Alive, needs_eight};

/// The living cells.
pub struct Cells;

impl AgentGroup for Cells {
    type State = ();
    type Globals = ();
    const NAME: &'static str = "cells";
}

/// Living neighbours of every node: an artifact by which cells tell that they are there.
pub struct Company;

impl NodeField for Company {
    type Value = u8;
    const NAME: &'static str = "company";
    const UNIT: &'static str = "1";
    const MEANING: &'static str = "living neighbours of the node";
}

/// The Game of Life with agents, as a lesson: cells are born and die.
///
/// The same model as `Life`, and with the same parameters the same cells. Its cost follows the
/// number of living cells.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LivingCells {
    /// Share of the cells that live at the beginning, drawn at random; 0 starts with what the
    /// field `alive` holds.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub alive_share: f64,
}

impl Default for LivingCells {
    fn default() -> Self {
        Self { alive_share: 0.3 }
    }
}

impl Process for LivingCells {
    const NAME: &'static str = "LivingCells";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Alive>().writes::<Company>().group::<Cells>().derives(
            "cells",
            "1",
            "1 where a cell lives",
            presence::<Cells>,
        );
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        needs_eight(lattice)
    }
}

impl Plugin for LivingCells {
    fn build(&self, app: &mut App) {
        app.insert_settings(self)
            .add_systems(Begin, settle)
            .add_systems(Iterate, (tell, live_and_die).chain());
    }
}

/// The first cells.
fn settle(
    settings: Res<Settings<LivingCells>>,
    clock: Res<Clock>,
    alive: Field<Alive>,
    mut cells: Agents<Cells>,
) {
    let random = RandomStream::new(clock.seed, "life");
    let mut cells = cells.view();
    for (node, &alive) in alive.values().iter().enumerate() {
        let lives = match settings.alive_share > 0.0 {
            true => random.unit(0, node, 0) < settings.alive_share,
            false => alive > 0,
        };
        if lives {
            cells.register(node, ());
        }
    }
}

/// Every cell tells its neighbours that it is there.
fn tell(space: Res<Space>, mut cells: Agents<Cells>, mut company: FieldMut<Company>) {
    let company = company.values_mut();
    company.fill(0);
    for node in cells.view().nodes() {
        space.neighbours(node).for_each(|edge| company[edge.node] += 1);
    }
}

/// Cells die of too little or too much company, and give birth beside them where it is right.
fn live_and_die(space: Res<Space>, mut cells: Agents<Cells>, company: Field<Company>) {
    let company = company.values();
    cells.view().visit(|cells, node| {
        if !(2..=3).contains(&company[node]) {
            cells.deregister(node);
        }
        for edge in space.neighbours(node) {
            if company[edge.node] == 3 {
                // Refused where a cell lives, or where another neighbour was faster.
                cells.register(edge.node, ());
            }
        }
    });
}
