//! The surface of the voxels of at least a value as a mesh.

use std::path::{Path, PathBuf};

use landform_analysis::voxels::{Surface, VoxelSet, smooth_surface};
use landform_io::IfExists;
use landform_io::mesh::{self, Mesh};
use landform_sim::code::Code;
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::ColourMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use crate::explain::file_problem;

/// The surface of the voxels of a volume that are at least a value, such as the passages of a cave, as
/// a closed manifold of triangles with colours by height: glTF (`.glb`), `.obj`, `.ply`, `.stl`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VoxelMesh {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// Voxels of at least this value lie inside.
    pub at_least: f64,
    /// Steps of 4-8 subdivision that smooth it; each doubles the number of triangles.
    #[schemars(range(max = 5), extend("x-source" = "thesis A.3"))]
    pub smoothing: usize,
    /// Name of the colour map of the vertices, from the foot of the block to its top.
    pub colours: String,
    /// When it is written.
    pub when: When,
}

impl Default for VoxelMesh {
    fn default() -> Self {
        Self {
            file: "passages.glb".into(),
            field: "porosity".to_owned(),
            at_least: 0.5,
            smoothing: 0,
            colours: "batlow".to_owned(),
            when: When::End,
        }
    }
}

impl FileOutput for VoxelMesh {
    const NAME: &'static str = "VoxelMesh";
    const KIND: &'static str = "mesh";
    const EXTENSIONS: &'static [&'static str] = &["glb", "obj", "ply", "stl"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, _lattice: &landform_graph::Lattice) -> Result<(), Problem> {
        self.colour_map().map(|_| ())
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (values, entry) = field_file::values(snapshot, &self.field)?;
        let lattice = snapshot.lattice();
        let set = VoxelSet::at_least(lattice.size(), &values, self.at_least);
        if set.is_empty() {
            let message = format!("no voxel of `{}` is at least {}", self.field, self.at_least);
            return Err(Problem::new("at_least", message, "a value that voxels have"));
        }
        let Surface { positions, triangles } = smooth_surface(&set, self.smoothing);
        let layers = lattice.depth() as f64;
        let colours = self.colour_map()?;
        let body = Mesh {
            colours: positions
                .iter()
                .map(|position| colours.colour(position[2] / layers))
                .collect(),
            positions: positions.iter().map(|at| at.map(|at| at * lattice.spacing())).collect(),
            triangles,
            ..Mesh::default()
        };
        let metadata = field_file::metadata(snapshot, entry);
        let refuse = |error: landform_io::IoError| file_problem("file", &error);
        mesh::write_mesh(path, &body.with_normals(), &metadata, IfExists::Replace).map_err(refuse)
    }
}

impl VoxelMesh {
    fn colour_map(&self) -> Result<ColourMap, Problem> {
        ColourMap::named(&self.colours).map_err(|error| {
            Problem::new("colours", error.to_string(), "a colour map").code(Code::Picture)
        })
    }
}
