//! How rough the shore of a field at some level is.

use landform_analysis::{
    LevelSetEdge, Polyline, ScaleRange, divider_dimension, level_sets, perimeter_dimension,
};
use landform_graph::Lattice;
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{check_plane, columns, heights};

/// The level of a shore.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum ShoreLevel {
    /// The median of the field: half of the nodes are land.
    #[default]
    Median,
    /// A value of the field.
    At(f64),
}

/// Fractal dimension of the shore of a field (figure 2.2 of the thesis): that of all islands
/// together by the perimeter method (2 - H for fractional Brownian surfaces, measured 0.02 to
/// 0.08 high), its error, and that of the longest line alone by dividers. Nothing without a
/// shore or on fewer than 32 nodes a side.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShoreDimension {
    /// Name of the field.
    pub field: String,
    /// Land is where the field is at or above this.
    pub level: ShoreLevel,
    /// Shortest and longest ruler of the dividers; without it a range that suits the line.
    #[schemars(extend("x-unit" = "m"))]
    pub rulers_m: Option<(f64, f64)>,
}

impl Default for ShoreDimension {
    fn default() -> Self {
        Self { field: "surface".to_owned(), level: ShoreLevel::Median, rulers_m: None }
    }
}

impl Metric for ShoreDimension {
    type Memory = ();
    const NAME: &'static str = "ShoreDimension";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if let Err(why) = self.rulers() {
            return Err(Problem::new("rulers_m", why, "two lengths above 0, the shorter first"));
        }
        match self.level {
            ShoreLevel::At(level) if !level.is_finite() => {
                Err(Problem::new("level", format!("the level is {level}"), "a finite number"))
            }
            _ => check_plane(lattice),
        }
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let heights = heights(snapshot, &self.field)?;
        let level = match self.level {
            ShoreLevel::Median => median(&heights),
            ShoreLevel::At(level) => level,
        };
        let land: Vec<bool> = heights.iter().map(|&height| height >= level).collect();
        let lattice = snapshot.lattice();
        let size = [lattice.width(), lattice.height()];
        let Ok(all) = perimeter_dimension(&land, size, lattice.spacing()) else {
            return Ok(Vec::new());
        };
        Ok(columns([
            ("shore_dimension", Some(all.dimension)),
            ("shore_dimension_error", Some(all.error)),
            (
                "longest_shore_dimension",
                longest(&heights, size, level, lattice.spacing(), self.rulers().unwrap_or(None)),
            ),
        ]))
    }
}

impl ShoreDimension {
    /// The range of rulers that is asked for.
    fn rulers(&self) -> Result<Option<ScaleRange>, String> {
        let range = self.rulers_m.map(|(shortest, longest)| ScaleRange::new(shortest, longest));
        range.transpose().map_err(|error| error.to_string())
    }
}

/// The value that half of the others are at or above; NaN without any.
fn median(heights: &[f64]) -> f64 {
    let mut heights = heights.to_vec();
    let middle = heights.len() / 2;
    match heights.get(middle) {
        Some(_) => *heights.select_nth_unstable_by(middle, f64::total_cmp).1,
        None => f64::NAN,
    }
}

/// Dimension of the longest line at a level by dividers, if it is long enough.
fn longest(
    heights: &[f64],
    size: [usize; 2],
    level: f64,
    spacing: f64,
    rulers: Option<ScaleRange>,
) -> Option<f64> {
    let lines = level_sets(heights, size, level, LevelSetEdge::End).ok()?;
    let lines = lines.iter().filter_map(|line| line.polyline([spacing; 2]).ok());
    let longest = lines.max_by(|a: &Polyline, b| a.length_m().total_cmp(&b.length_m()))?;
    let usual = || ScaleRange::usual(std::slice::from_ref(&longest)).ok();
    let range = rulers.or_else(usual)?;
    Some(divider_dimension(&[longest], &range).ok()?.dimension)
}
