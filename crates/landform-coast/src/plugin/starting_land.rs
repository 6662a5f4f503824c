//! The initial condition `StartingLand`.

use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The outline of land at the beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum LandShape {
    /// A rectangle with sea of the same width on all sides: a square on square maps.
    #[default]
    Square,
    /// A disc in the middle of the map.
    Disc,
    /// All land north of a strip of sea along the southern border.
    Strip,
    /// Land everywhere but at one node in the middle of the map, from which fronts of
    /// `IslandInterior` spread (thesis, figure 4.16).
    Point,
}

/// Land of a simple shape in the sea: 1 on land, 0 at sea (thesis, section 4.2: a square).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StartingLand {
    /// Its outline.
    pub shape: LandShape,
    /// Width of the sea as a share of the shorter side of the map; one node at least.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub margin: f64,
}

impl Default for StartingLand {
    fn default() -> Self {
        Self { shape: LandShape::Square, margin: 0.0625 }
    }
}

impl InitialCondition for StartingLand {
    const NAME: &'static str = "StartingLand";

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        let lattice = &context.domain.lattice;
        let [width, height, _] = lattice.size();
        let shorter = width.min(height) as f64;
        let margin = (self.margin * shorter).round().max(1.0) as usize;
        let has_margins = matches!(self.shape, LandShape::Square | LandShape::Disc);
        if has_margins && 2 * margin >= width.min(height) {
            let message = format!("{margin} nodes of sea on both sides leave no land");
            return Err(Problem::new("margin", message, "less than half of the map"));
        }
        let radius = 0.5 * shorter - margin as f64;
        let is_land = |node: usize| {
            let [x, y, _] = lattice.coordinates(node);
            match self.shape {
                LandShape::Square => {
                    let inside = |at: usize, size: usize| (margin..size - margin).contains(&at);
                    inside(x, width) && inside(y, height)
                }
                LandShape::Disc => {
                    let [x, y] = [(x, width), (y, height)]
                        .map(|(at, size)| at as f64 + 0.5 - 0.5 * size as f64);
                    x.hypot(y) < radius
                }
                LandShape::Strip => y + margin < height,
                LandShape::Point => [x, y] != [width / 2, height / 2],
            }
        };
        Ok((0..lattice.node_count()).map(|node| f64::from(u8::from(is_land(node)))).collect())
    }
}
