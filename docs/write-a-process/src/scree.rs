//! Scree: rock falls from slopes that are too steep and comes to rest at their foot.

// ANCHOR: use
use landform::graph::Edge;
use landform::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
// ANCHOR_END: use

// ANCHOR: parameters
/// Rock that falls from slopes steeper than repose, down every edge that is too steep.
///
/// Over an edge of length `l` between heights `a > b`, `rate * (a - b - l tan(repose))` metres
/// of rock move down in an iteration. Conserves the volume of the bed.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Scree {
    /// Steepest slope at which rock rests.
    #[schemars(range(min = 1.0, max = 89.0), extend("x-unit" = "degrees"))]
    pub repose_deg: f64,
    /// Share of the height above repose that falls over an edge in an iteration.
    #[schemars(range(min = 0.0, max = 0.125))]
    pub rate: f64,
}

impl Default for Scree {
    fn default() -> Self {
        Self { repose_deg: 33.0, rate: 0.1 }
    }
}
// ANCHOR_END: parameters

// ANCHOR: process
impl Process for Scree {
    const NAME: &'static str = "Scree";

    fn declare(&self, uses: &mut Declaration) {
        uses.writes::<Bed>().conserves(Budget::volume::<Bed>(1e-9)).scratch(size_of::<f64>());
    }
}

impl Plugin for Scree {
    fn build(&self, app: &mut App) {
        app.insert_settings(self).add_systems(Iterate, fall);
    }
}
// ANCHOR_END: process

// ANCHOR: system
fn fall(settings: Res<Settings<Scree>>, space: Res<Space>, mut bed: FieldMut<Bed>) {
    let before = bed.values().to_vec();
    let steepest = settings.repose_deg.to_radians().tan();
    crumble(&space, steepest, settings.rate, &before, bed.values_mut());
}
// ANCHOR_END: system

// ANCHOR: kernel
/// Moves the heights `before` to `after`; `steepest` is the tangent of the slope of repose.
fn crumble(lattice: &Lattice, steepest: f64, rate: f64, before: &[f64], after: &mut [f64]) {
    for (node, height) in after.iter_mut().enumerate() {
        for edge in lattice.neighbours(node) {
            let rise = before[edge.node] - before[node];
            let excess = (rise.abs() - steepest * edge.distance).max(0.0);
            *height += rate * excess.copysign(rise);
        }
    }
}
// ANCHOR_END: kernel

// ANCHOR: metric
/// Share of the nodes with an edge that falls too steeply.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SteepGround {
    /// Slope above which an edge counts.
    #[schemars(range(min = 1.0, max = 89.0), extend("x-unit" = "degrees"))]
    pub steeper_than_deg: f64,
}

impl Default for SteepGround {
    fn default() -> Self {
        Self { steeper_than_deg: 35.0 }
    }
}

impl Metric for SteepGround {
    type Memory = ();
    const NAME: &'static str = "SteepGround";

    fn fields(&self) -> Vec<String> {
        vec!["bed".to_owned()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let Ok(bed) = snapshot.field("bed") else { return Ok(Vec::new()) };
        let lattice = snapshot.lattice();
        let limit = self.steeper_than_deg.to_radians().tan();
        let is_steep = |&node: &usize| {
            let fall = |edge: Edge| (bed[node] - bed[edge.node]) / edge.distance;
            lattice.neighbours(node).any(|edge| fall(edge) > limit)
        };
        let steep = (0..bed.len()).filter(is_steep).count();
        Ok(vec![("steep_percent".to_owned(), 100.0 * steep as f64 / bed.len() as f64)])
    }
}
// ANCHOR_END: metric

// ANCHOR: test
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_falls_and_no_rock_is_lost() {
        let lattice = Lattice::plane([4, 1], 1.0, Connectivity::Four, [Boundary::Open; 2]);
        let before = [10.0, 10.0, 0.0, 0.0];
        let mut after = before;
        crumble(&lattice.expect("a lattice"), 2.0, 0.125, &before, &mut after);
        assert_eq!(after, [10.0, 9.0, 1.0, 0.0]);
    }
}
// ANCHOR_END: test
