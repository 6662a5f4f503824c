//! Branches as a mesh.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::IfExists;
use landform_io::mesh::{self, Mesh};
use landform_sim::code::Code;
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_synth::tubes;
use landform_view::ColourMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::branch_source::BranchSource;
use super::field_file;
use crate::explain::file_problem;

/// The branches of a dendrite, an aggregate or an L-system as tubes: glTF (`.glb`), `.obj`, `.ply`,
/// `.stl`. Every branch is a closed manifold of its own that begins inside the one it leaves.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BranchMesh {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// The branches; thick ones.
    pub of: BranchSource,
    /// Corners of the cross-section of a tube.
    #[schemars(range(min = 3, max = 64))]
    pub sides: u32,
    /// Name of the colour map of the vertices, from tips to the thickest branch.
    pub colours: String,
    /// When it is written.
    pub when: When,
}

impl Default for BranchMesh {
    fn default() -> Self {
        Self {
            file: "branches.glb".into(),
            of: BranchSource::default(),
            sides: 8,
            colours: "batlow".to_owned(),
            when: When::End,
        }
    }
}

impl FileOutput for BranchMesh {
    const NAME: &'static str = "BranchMesh";
    const KIND: &'static str = "mesh";
    const EXTENSIONS: &'static [&'static str] = &["glb", "obj", "ply", "stl"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        self.colour_map()?;
        self.of.check(lattice)
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let branching = self.of.branching(snapshot)?;
        let body = tubes(&branching, self.sides)
            .map_err(|error| Problem::new("of", error.to_string(), "branches with a width"))?;
        let thickest = branching.radii.iter().copied().fold(0.0, f64::max);
        let map = self.colour_map()?;
        let colour = |node: &u32| map.colour(branching.radii[*node as usize] / thickest);
        let mesh = Mesh {
            colours: body.nodes.iter().map(colour).collect(),
            positions: body.positions,
            triangles: body.triangles,
            ..Mesh::default()
        };
        let metadata = field_file::run_metadata(snapshot);
        let refuse = |error: landform_io::IoError| file_problem("file", &error);
        mesh::write_mesh(path, &mesh.with_normals(), &metadata, IfExists::Replace).map_err(refuse)
    }
}

impl BranchMesh {
    fn colour_map(&self) -> Result<ColourMap, Problem> {
        ColourMap::named(&self.colours).map_err(|error| {
            Problem::new("colours", error.to_string(), "a colour map").code(Code::Picture)
        })
    }
}
