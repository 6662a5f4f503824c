//! The process `WaterColumn`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Bed, Field, FieldMut, OnEdges, Water};
use landform_sim::ledger::{Budget, Ledger};
use landform_sim::nodes::Space;
use landform_sim::outside::Outside;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fields::{Flow, PipeFlow, Rain, flow_log10, water_level};
use super::refusal;
use crate::RiverError;
use crate::water::{Algorithm, Columns, MOST_M, Place, Side, Sweeper, border_nodes};

/// Water that stands on the ground, falls as rain and flows to lower neighbours.
///
/// Every node holds a column of water, the field `water`; levels are bed and water together. An
/// iteration: rain falls and sources run; then `sweeps` times every node shares its water with its
/// lower neighbours by the `algorithm`, all at the same moment, and what has reached an outlet or a
/// sink is gone; then a share of all water is lost to ground and air. The field `flow` is the water
/// that a node received from neighbours, in all sweeps of the iteration. Where the map ends before
/// the lattice does, in nodes without data, its edge is an outlet.
///
/// A sweep moves water by one node. Depths are whole units of 2^-32 m, so water is conserved exactly,
/// and a lake at rest stays at rest, bit for bit. No sweep has a direction: symmetric ground keeps
/// water symmetric.
///
/// # Limits
/// Elevations and depths of at most 262 km. Water has no momentum but in pipes.
///
/// # Source
/// Thesis, sections 4.3.1 (figure 4.11) and 4.4.3 (listings 4.2 and 4.3).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WaterColumn {
    /// How a node shares its water among lower neighbours.
    pub algorithm: Algorithm,
    /// Sweeps an iteration, or steps of pipes.
    #[schemars(range(min = 1, max = 500), extend("x-source" = "chosen: see the calibration of rivers"))]
    pub sweeps: u32,
    /// Rain an iteration, everywhere; the field `rain` is added to it.
    #[schemars(range(min = 0.0, max = 1e3), extend("x-unit" = "m", "x-source" = "chosen: see the calibration of rivers"))]
    pub rain_m: f64,
    /// Springs.
    pub sources: Vec<Source>,
    /// Places where all water vanishes.
    pub sinks: Vec<Place>,
    /// Borders over which water leaves: all that reaches them does. The others are walls. Every open
    /// border when missing.
    pub outlets: Option<Vec<Side>>,
    /// Level of a sea: water that reaches ground below it is gone.
    #[schemars(range(min = -1e6, max = 1e6), extend("x-unit" = "m"))]
    pub sea_level_m: Option<f64>,
    /// Share of the water that an iteration loses to ground and air.
    #[schemars(range(min = 0.0, max = 1.0), extend("x-source" = "chosen: see the calibration of rivers"))]
    pub loss: f64,
}

/// A spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Its middle: share of the width from west to east, of the height from south to north.
    pub center: [f64; 2],
    /// Its radius; the node nearest to the middle belongs to it in any case.
    #[schemars(range(min = 0.0, max = 1e9), extend("x-unit" = "m"))]
    #[serde(default)]
    pub radius_m: f64,
    /// Water an iteration, shared evenly by its nodes.
    #[schemars(range(min = 0.0, max = 1e15), extend("x-unit" = "m3"))]
    pub volume_m3: f64,
}

impl Default for WaterColumn {
    fn default() -> Self {
        Self {
            algorithm: Algorithm::Specialised,
            sweeps: 8,
            rain_m: 0.01,
            sources: Vec::new(),
            sinks: Vec::new(),
            outlets: None,
            sea_level_m: None,
            loss: 0.02,
        }
    }
}

/// Where water comes in and goes out, by nodes.
struct Openings {
    sources: Vec<(Vec<usize>, f64)>,
    sinks: Vec<Vec<usize>>,
    outlets: Vec<(Side, Vec<usize>)>,
    /// Nodes outside the map and on its edge.
    gaps: Vec<usize>,
}

/// Where water leaves a map that ends before its lattice does.
const EDGE: &str = "edge of the map";

/// Deepest water that a spring may add to a node in an iteration.
const MOST_FED_M: f64 = MOST_M / 256.0;

impl WaterColumn {
    fn openings(&self, lattice: &Lattice, outside: &Outside) -> Result<Openings, Problem> {
        let sources = self.sources.iter().enumerate().map(|(number, source)| {
            let name = format!("sources[{number}]");
            let place = Place { center: source.center, radius_m: source.radius_m };
            let nodes = place.nodes(lattice).map_err(|error| refusal(&error, &name))?;
            let depth_m = source.volume_m3 / nodes.len() as f64 / lattice.spacing().powi(2);
            if depth_m <= MOST_FED_M {
                return Ok((nodes, depth_m));
            }
            let message = format!("the spring adds {depth_m} m to a node an iteration");
            let advice = format!("at most {MOST_FED_M} m: less volume, or a larger radius");
            Err(Problem::new(format!("{name}.volume_m3"), message, advice))
        });
        let sinks = self.sinks.iter().enumerate().map(|(number, sink)| {
            let name = format!("sinks[{number}]");
            sink.nodes(lattice).map_err(|error| refusal(&error, &name))
        });
        Ok(Openings {
            sources: sources.collect::<Result<_, _>>()?,
            sinks: sinks.collect::<Result<_, _>>()?,
            outlets: self.outlets(lattice)?,
            gaps: outside.nodes().chain(outside.edge().iter().copied()).collect(),
        })
    }

    fn outlets(&self, lattice: &Lattice) -> Result<Vec<(Side, Vec<usize>)>, Problem> {
        let open = || Side::ALL.into_iter().filter(|side| side.is_open(lattice)).collect();
        let sides: Vec<Side> = self.outlets.clone().unwrap_or_else(open);
        if let Some(side) = sides.iter().find(|side| !side.is_open(lattice)) {
            return Err(refusal(&RiverError::NoBorder { border: side.border() }, "outlets"));
        }
        Ok(sides.into_iter().map(|side| (side, border_nodes(lattice, side))).collect())
    }
}

impl Process for WaterColumn {
    const NAME: &'static str = "WaterColumn";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads_or_zero::<Bed>()
            .reads_or_zero::<Rain>()
            .writes::<Water>()
            .writes::<Flow>()
            .rebuilds::<WaterWorks>()
            .conserves(Budget::volume::<Water>(1e-12))
            .scratch(Columns::BYTES + Sweeper::BYTES);
        uses.derives(
            "water_level",
            "m",
            "level of the water, of the ground where dry",
            water_level,
        );
        let meaning = "decimal logarithm of the flow in m, at least -6";
        uses.derives("flow_log10", "1", meaning, flow_log10);
        if let Algorithm::Hydrostatic(_) = self.algorithm {
            uses.edges::<PipeFlow>();
        }
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        Sweeper::check(lattice, self.algorithm).map_err(|error| refusal(&error, "algorithm"))?;
        self.openings(lattice, &Outside::default()).map(|_| ())
    }
}

impl Plugin for WaterColumn {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, lay_out).add_systems(Iterate, flow);
    }
}

/// Columns, sweeps and openings; all of it follows from parameters and lattice.
#[derive(Resource)]
struct WaterWorks {
    columns: Columns,
    sweeper: Sweeper,
    openings: Openings,
}

fn lay_out(
    mut commands: Commands,
    settings: Res<Settings<WaterColumn>>,
    (space, outside): (Res<Space>, Res<Outside>),
    mut fault: ResMut<Fault>,
) {
    let made = || -> Result<WaterWorks, Problem> {
        let refused = |error| refusal(&error, "algorithm");
        Ok(WaterWorks {
            columns: Columns::new(&space).map_err(refused)?,
            sweeper: Sweeper::new(&space, settings.algorithm).map_err(refused)?,
            openings: settings.openings(&space, &outside)?,
        })
    };
    match made() {
        Ok(works) => commands.insert_resource(works),
        Err(problem) => fault.raise(problem.message),
    }
}

/// An iteration of water.
fn flow(
    settings: Res<Settings<WaterColumn>>,
    space: Res<Space>,
    mut works: ResMut<WaterWorks>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    (bed, rain): (Field<Bed>, Field<Rain>),
    (mut water, mut flow): (FieldMut<Water>, FieldMut<Flow>),
    mut pipes: Option<ResMut<OnEdges<PipeFlow>>>,
) {
    let pipes = pipes.as_mut().map_or(&mut [][..], |pipes| pipes.values_mut());
    let fields = Fields { bed: bed.values(), rain: rain.values(), water: water.values_mut() };
    let mut book = Book { ledger: &mut ledger, area_m2: space.spacing().powi(2) };
    if let Err(error) = works.iterate(&settings, fields, flow.values_mut(), pipes, &mut book) {
        fault.raise(error.to_string());
    }
}

/// Fields that an iteration reads, and the water.
struct Fields<'a> {
    bed: &'a [f64],
    rain: &'a [f64],
    water: &'a mut [f64],
}

/// The account of water.
struct Book<'a> {
    ledger: &'a mut Ledger,
    area_m2: f64,
}

impl Book<'_> {
    /// Books what came in, or went out if it is negative: depths summed over nodes.
    fn enter(&mut self, place: &str, sum_m: f64) {
        if sum_m > 0.0 {
            self.ledger.enter("water", place, sum_m * self.area_m2);
        } else if sum_m < 0.0 {
            self.ledger.leave("water", place, -sum_m * self.area_m2);
        }
    }

    /// Takes all water off `nodes` and books it.
    fn drain(&mut self, place: &str, columns: &mut Columns, nodes: &[usize]) {
        if !nodes.is_empty() {
            self.enter(place, -columns.drain(nodes));
        }
    }
}

impl WaterWorks {
    fn iterate(
        &mut self,
        settings: &WaterColumn,
        fields: Fields<'_>,
        flow: &mut [f64],
        pipes: &mut [f64],
        book: &mut Book<'_>,
    ) -> Result<(), RiverError> {
        let Self { columns, sweeper, openings } = self;
        columns.begin(fields.bed, fields.water)?;
        book.enter("rain", columns.rain(settings.rain_m, Some(fields.rain))?);
        for (nodes, depth_m) in &openings.sources {
            book.enter("sources", columns.feed(nodes, *depth_m));
        }
        let sea: Vec<usize> = settings.sea_level_m.map_or_else(Vec::new, |level_m| {
            (0..fields.bed.len()).filter(|&node| fields.bed[node] < level_m).collect()
        });
        // Rain on the sea and outside the map runs nowhere.
        book.drain("sea", columns, &sea);
        book.drain(EDGE, columns, &openings.gaps);
        for _ in 0..settings.sweeps {
            sweeper.sweep(columns, pipes)?;
            for (side, nodes) in &openings.outlets {
                book.drain(side.border(), columns, nodes);
            }
            for nodes in &openings.sinks {
                book.drain("sinks", columns, nodes);
            }
            book.drain("sea", columns, &sea);
            book.drain(EDGE, columns, &openings.gaps);
        }
        book.enter("losses", -columns.lose(settings.loss));
        book.enter("rounding", columns.finish(fields.water, flow));
        Ok(())
    }
}
