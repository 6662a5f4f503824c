//! What pictures show: a field, and the water over it.

use landform_caves::CavePlaces;
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::outside::Outside;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::Water;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Look;
use crate::outputs::field_file;

/// Water of a field of depths, drawn as a surface over the heights (thesis, section A.2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WaterDepths {
    /// Name of the field of depths in metres. The heights that are drawn are those below it.
    pub field: String,
    /// Shallower water is not drawn: about the depth of the smallest channel.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub least_m: f64,
    /// Depth at which two thirds of the ground's colour are gone.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "m"))]
    pub clear_m: f64,
}

impl Default for WaterDepths {
    fn default() -> Self {
        Self { field: "water".to_owned(), least_m: 0.1, clear_m: 2.0 }
    }
}

/// The water of a look: at a level, of depths, or both.
pub(crate) fn water_of(level_m: Option<f64>, depths: Option<&WaterDepths>) -> Option<Water> {
    /// Thickness of a sea below which the ground shows through.
    const CLEAR_SEA_M: f64 = 10.0;
    match (level_m, depths) {
        (level_m, Some(depths)) => {
            Some(Water { level_m, least_m: depths.least_m, ..Water::new(depths.clear_m) })
        }
        (Some(level_m), None) => Some(Water::at(level_m, CLEAR_SEA_M)),
        (None, None) => None,
    }
}

/// The values that a look draws.
#[derive(Clone, Debug, Default)]
pub(crate) struct Subject {
    /// One value a node.
    pub values: Vec<f64>,
    /// Depths of the water over them, for looks that draw it.
    pub water: Option<Vec<f64>>,
    /// Values by which passages are coloured, for looks that colour them by another field.
    pub paint: Option<Vec<f64>>,
    /// Where water comes in and goes out of caves, for looks that mark it.
    pub places: CavePlaces,
    /// Unit of the values.
    pub unit: String,
    /// The nodes that do not belong to the map.
    pub outside: Outside,
}

impl Subject {
    /// What a look of a field draws of the present state of a run.
    pub fn of(snapshot: &Snapshot<'_>, field: &str, look: &Look) -> Result<Self, Problem> {
        let (values, entry) = field_file::values(snapshot, field)?;
        let depths = look.water().map(|water| field_file::values(snapshot, &water.field));
        let water = depths.transpose()?.map(|(depths, _)| depths);
        let paint = look.paint().map(|field| field_file::values(snapshot, field)).transpose()?;
        let places = snapshot.world().get_resource::<CavePlaces>().filter(|_| look.has_marks());
        Ok(Self {
            values,
            water,
            paint: paint.map(|(values, _)| values),
            places: places.cloned().unwrap_or_default(),
            unit: entry.unit.to_owned(),
            outside: snapshot.domain().outside.clone(),
        })
    }

    /// Keeps what is drawn under a name in a checkpoint.
    pub fn save<'a>(&'a self, name: &str, to: &mut Saver<'_, 'a>) {
        to.array(name, &self.values);
        if let Some(depths) = &self.water {
            to.array(&water_name(name), depths);
        }
        if let Some(values) = &self.paint {
            to.array(&paint_name(name), values);
        }
        to.value(&places_name(name), &(&self.places.sources, &self.places.sinks));
    }

    /// What a look of a field drew, from a checkpoint.
    ///
    /// # Errors
    /// [`Damage`] where it is not there whole.
    pub fn restore(
        name: &str,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        field: &str,
        look: &Look,
    ) -> Result<Self, Damage> {
        let nodes = snapshot.lattice().node_count();
        let array = |name: &str| from.array_of(name, nodes).map(<[f64]>::to_vec);
        let (sources, sinks) = from.value(&places_name(name))?;
        Ok(Self {
            values: array(name)?,
            water: look.water().map(|_| array(&water_name(name))).transpose()?,
            paint: look.paint().map(|_| array(&paint_name(name))).transpose()?,
            places: CavePlaces { sources, sinks },
            unit: snapshot.entry(field).map_or_else(|_| String::new(), |entry| entry.unit.into()),
            outside: snapshot.domain().outside.clone(),
        })
    }
}

/// Name of the depths of water beside values in checkpoints.
fn water_name(name: &str) -> String {
    format!("{name}-water")
}

/// Name of the values that colour passages beside those that show them.
fn paint_name(name: &str) -> String {
    format!("{name}-paint")
}

/// Name of the sources and sinks of caves beside values.
fn places_name(name: &str) -> String {
    format!("{name}-places")
}
