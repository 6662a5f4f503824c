//! The topology of voxels and of their surface.

use landform_analysis::voxels::{VoxelSet, surface};
use landform_sim::metric::Metric;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Euler characteristic of the voxels of at least a value, as closed cubes (pieces less loops plus
/// hollows), and of the mesh around them, counted apart: half of the second, less the corners at which two
/// voxels touch and nothing else does, is the first. `euler_gap` is what is missing to that, 0 for every
/// set.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VoxelTopology {
    /// Name of the field.
    pub field: String,
    /// Voxels of at least this value belong to the set.
    pub at_least: f64,
}

impl Default for VoxelTopology {
    fn default() -> Self {
        Self { field: "porosity".to_owned(), at_least: 0.5 }
    }
}

impl Metric for VoxelTopology {
    type Memory = ();
    const NAME: &'static str = "VoxelTopology";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn measure(&self, (): &mut (), snapshot: &Snapshot<'_>) -> Result<Vec<(String, f64)>, Problem> {
        let values = snapshot
            .field(&self.field)
            .map_err(|error| Problem::new("field", error.to_string(), "a field of the run"))?;
        let set = VoxelSet::at_least(snapshot.lattice().size(), &values, self.at_least);
        let named = numbers(&set).map(|(name, value)| (name.to_owned(), value as f64));
        Ok(named.into())
    }
}

fn numbers(set: &VoxelSet) -> [(&'static str, i64); 4] {
    let mesh = surface(set);
    // Every triangle of a closed mesh has three edges, which it shares with one other each.
    let of_mesh = mesh.positions.len() as i64 - (mesh.triangles.len() / 2) as i64;
    let (of_voxels, contacts) = (set.euler_characteristic(), set.corner_contacts() as i64);
    [
        ("euler_of_voxels", of_voxels),
        ("euler_of_mesh", of_mesh),
        ("corner_contacts", contacts),
        ("euler_gap", of_mesh / 2 - contacts - of_voxels),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_shapes_have_known_characteristics() {
        let ball = VoxelSet::new([3; 3], |_| true);
        let hollow = VoxelSet::new([3; 3], |at| at != [1; 3]);
        let ring = VoxelSet::new([3, 3, 1], |at| at != [1, 1, 0]);
        let touching = VoxelSet::new([2; 3], |[x, y, z]| x == y && y == z);
        for (set, of_voxels, of_mesh, contacts) in
            [(ball, 1, 2, 0), (hollow, 2, 4, 0), (ring, 0, 0, 0), (touching, 1, 4, 1)]
        {
            assert_eq!(numbers(&set).map(|of| of.1), [of_voxels, of_mesh, contacts, 0]);
        }
    }
}
