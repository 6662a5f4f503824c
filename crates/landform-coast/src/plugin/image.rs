//! The process `ImageCoastErosion`.

use bevy_app::{App, Plugin};
use bevy_ecs::change_detection::{Res, ResMut};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::Commands;
use landform_graph::Lattice;
use landform_sim::fault::Fault;
use landform_sim::field::{Field, FieldMut};
use landform_sim::ledger::Ledger;
use landform_sim::nodes::Space;
use landform_sim::notes::Notes;
use landform_sim::parameters::Problem;
use landform_sim::process::{Begin, Declaration, Iterate, Process, ProcessApp, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::groups::{LAND_BUDGET, Land, Resistance, coast_surface, node_area_m2};
use super::image_device::{CoastDevice, DeviceCoast};
use crate::coast::Weakening;
use crate::image::{ImageCoastError, ImageCoastSettings};

/// Coast erosion in the form for images: the local perimeter is that of tiles of the map, blended
/// between their middles (thesis, appendix B.1).
///
/// A coast of the same kind as by `CoastErosion` with a perimeter within a radius, from work that
/// is the same for every node of the map. All arithmetic is in whole numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ImageCoastErosion {
    /// Force of the sea f on a coast of no length.
    #[schemars(range(min = 0.0, max = 2.0), extend("x-source" = "thesis, table B.1"))]
    pub force: f64,
    /// How strongly shore weakens the sea: g, where a straight coast across a tile counts 1.
    #[schemars(range(min = 0.0, max = 16.0), extend("x-source" = "thesis, table B.1"))]
    pub attenuation: f64,
    /// Logarithm to base 2 of the number of tiles along each side of the map.
    #[schemars(range(min = 0, max = 8), extend("x-source" = "thesis, table B.1"))]
    pub offset: u32,
    /// How rock resists the less, the more of its four sides lie bare.
    pub weakening: Weakening,
    /// What computes it: the same land, bit for bit. `Graphics` is the best graphics processor that
    /// Vulkan, Metal, DirectX 12 or OpenGL offers; the program must be built with
    /// `--features gpu`.
    pub device: CoastDevice,
}

impl Default for ImageCoastErosion {
    fn default() -> Self {
        let ImageCoastSettings { force, attenuation, offset, weakening } =
            ImageCoastSettings::default();
        Self { force, attenuation, offset, weakening, device: CoastDevice::default() }
    }
}

impl ImageCoastErosion {
    /// The settings of the kernels.
    pub fn settings(&self) -> ImageCoastSettings {
        let Self { force, attenuation, offset, weakening, .. } = *self;
        ImageCoastSettings { force, attenuation, offset, weakening }
    }
}

impl Process for ImageCoastErosion {
    const NAME: &'static str = "ImageCoastErosion";

    fn declare(&self, uses: &mut Declaration) {
        uses.reads::<Land>()
            .reads::<Resistance>()
            .writes::<Land>()
            .keeps::<ImageCoastRecord>()
            .rebuilds::<ImageCoastState>()
            .derives("coast_surface", "m", "land above the sea, to look at", coast_surface)
            .conserves(LAND_BUDGET)
            .scratch(self.device.bytes_per_node());
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let (connectivity, [width, height, _]) = (lattice.connectivity(), lattice.size());
        if connectivity.is_volume() {
            return Err(Problem::new("", "a volume is no image", "a 2-D domain"));
        }
        self.settings().validate([width, height]).map_err(|error| {
            let parameter = match error {
                ImageCoastError::Range { name, .. } => name,
                _ => "offset",
            };
            Problem::new(parameter, error.to_string(), "")
        })?;
        self.device.check([width, height])
    }
}

impl Plugin for ImageCoastErosion {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Begin, prepare).add_systems(Iterate, erode);
    }
}

/// What happened in the stage and in its latest iteration.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ImageCoastRecord {
    /// Nodes that fell; none before the first iteration.
    pub events: Option<u64>,
    /// Iterations of the stage in which something fell.
    pub iterations: u64,
    /// Land nodes when the stage began.
    pub initial_land: u64,
}

/// The coast at work; all of it follows from parameters and fields.
#[derive(Resource)]
struct ImageCoastState(DeviceCoast);

/// Takes the resistances of the rock to the device.
fn prepare(
    mut commands: Commands,
    settings: Res<Settings<ImageCoastErosion>>,
    space: Res<Space>,
    mut fault: ResMut<Fault>,
    mut notes: ResMut<Notes>,
    (land, rock): (Field<Land>, Field<Resistance>),
) {
    let size = [space.width(), space.height()];
    match DeviceCoast::new(settings.device, size, settings.settings(), rock.values()) {
        Ok(coast) => {
            if let Some(device) = coast.device() {
                notes.tell(format!("{} runs on {device}", ImageCoastErosion::NAME));
            }
            commands.insert_resource(ImageCoastState(coast));
            let initial_land = land.values().iter().filter(|&&land| land > 0).count() as u64;
            commands.insert_resource(ImageCoastRecord { initial_land, ..Default::default() });
        }
        Err(message) => fault.raise(message),
    }
}

/// One iteration of the sea.
fn erode(
    space: Res<Space>,
    mut state: ResMut<ImageCoastState>,
    mut record: ResMut<ImageCoastRecord>,
    mut ledger: ResMut<Ledger>,
    mut fault: ResMut<Fault>,
    mut land: FieldMut<Land>,
) {
    match state.0.step(land.values_mut()) {
        Ok(fallen) => {
            if fallen > 0 {
                ledger.leave("land", "sea", fallen as f64 * node_area_m2(&space));
            }
            record.events = Some(fallen as u64);
            record.iterations += u64::from(fallen > 0);
        }
        Err(message) => fault.raise(message),
    }
}
