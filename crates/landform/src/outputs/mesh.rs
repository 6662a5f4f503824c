//! A field of heights as a mesh.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::mesh::{self, Body, height_mesh};
use landform_io::{Fault, IfExists, IoError, Metadata, Raster};
use landform_sim::code::Code;
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::{ColourMap, HeightField, ViewError, Water};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::look::{WaterDepths, water_of};
use super::map_place::check_plane;
use crate::explain::file_problem;

/// A field of heights as a triangle mesh with colours: glTF (`.glb`), `.obj`, `.ply`, `.stl`. With
/// water, its surface is a second mesh, translucent in `.glb` and `.ply`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mesh {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// Name of the colour map of the vertices.
    pub colours: String,
    /// Elevation of a water surface; none when missing.
    #[schemars(extend("x-unit" = "m"))]
    pub water_level_m: Option<f64>,
    /// Water of a field of depths over the heights; none when missing.
    pub water: Option<WaterDepths>,
    /// When it is written.
    pub when: When,
}

impl Default for Mesh {
    fn default() -> Self {
        Self {
            file: "surface.glb".into(),
            field: "surface".to_owned(),
            colours: "sand".to_owned(),
            water_level_m: None,
            water: None,
            when: When::End,
        }
    }
}

impl FileOutput for Mesh {
    const NAME: &'static str = "Mesh";
    const KIND: &'static str = "mesh";
    const EXTENSIONS: &'static [&'static str] = &["glb", "obj", "ply", "stl"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        let depths = self.water.as_ref().map(|water| water.field.clone());
        [self.field.clone()].into_iter().chain(depths).collect()
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        colour_map(&self.colours)?;
        check_plane(lattice)?;
        let water = water_of(self.water_level_m, self.water.as_ref());
        let is_stl = self.file.extension().is_some_and(|end| end.eq_ignore_ascii_case("stl"));
        if water.is_some() && is_stl {
            let message = "STL holds one mesh, without colours";
            return Err(Problem::new("water", message, "no water, or .glb, .obj or .ply"));
        }
        let [width, height, _] = lattice.size();
        match width.min(height) {
            0 | 1 => {
                let message = format!("{width} x {height} nodes span no surface");
                Err(Problem::new("", message, "at least 2 x 2 nodes"))
            }
            _ => Ok(()),
        }
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (values, entry) = field_file::values(snapshot, &self.field)?;
        let depths = self.water.as_ref().map(|water| field_file::values(snapshot, &water.field));
        let depths = depths.transpose()?.map(|(depths, _)| depths);
        let colours = colour_map(&self.colours)?;
        let raster = field_file::raster_of(snapshot, values);
        let metadata = field_file::metadata(snapshot, entry);
        let water = water_of(self.water_level_m, self.water.as_ref());
        let water = water.map(|look| WaterOver { look, depths });
        write_mesh(path, &raster, &metadata, (colours, water), IfExists::Replace)
            .map_err(|error| file_problem("file", &error))
    }
}

fn colour_map(name: &str) -> Result<ColourMap, Problem> {
    ColourMap::named(name)
        .map_err(|error| Problem::new("colours", error.to_string(), "").code(Code::Picture))
}

/// Water over the ground of a mesh.
pub(crate) struct WaterOver {
    /// Where it stands and what it looks like.
    pub look: Water,
    /// Its depths in metres, one a node, if a field has them.
    pub depths: Option<Vec<f64>>,
}

/// Writes the surface of a raster of heights as a mesh, coloured by height, and that of the water
/// over it.
pub(crate) fn write_mesh(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    (colours, water): (ColourMap, Option<WaterOver>),
    if_exists: IfExists,
) -> Result<(), IoError> {
    let spacing_m = metadata.spacing_m.or(raster.spacing_m().ok()).unwrap_or(1.0);
    let mut ground = height_mesh(raster, spacing_m).map_err(|fault| fault.writing(path))?;
    let [low, high] = raster.range().unwrap_or([0.0, 1.0]);
    let span = if high > low { high - low } else { 1.0 };
    let present = raster.values.iter().filter(|value| !value.is_nan());
    ground.colours = present.map(|value| colours.colour((value - low) / span)).collect();
    let surface = water.map(|water| water.surface(raster, spacing_m)).transpose();
    let surface = surface.map_err(|fault| fault.writing(path))?.flatten();
    let mut bodies = vec![Body { name: "ground", mesh: &ground }];
    bodies.extend(surface.as_ref().map(|mesh| Body { name: "water", mesh }));
    mesh::write_meshes(path, &bodies, metadata, if_exists)
}

impl WaterOver {
    /// The surface of the water, as pictures draw it; none where all is dry.
    fn surface(&self, raster: &Raster, spacing_m: f64) -> Result<Option<mesh::Mesh>, Fault> {
        let dry = |value: &f64| if value.is_nan() { 0.0 } else { *value };
        let heights: Vec<f64> = raster.values.iter().map(dry).collect();
        let depths: Option<Vec<f64>> =
            self.depths.as_ref().map(|depths| depths.iter().map(dry).collect());
        let refuse = |error: ViewError| Fault::new(error.to_string(), "water on ground", "");
        let bare = HeightField::new(raster.width, raster.height, spacing_m, &heights);
        let field = bare.map_err(refuse)?;
        let field = match &depths {
            Some(depths) => field.with_water(depths).map_err(refuse)?,
            None => field,
        };
        let mut levels = self.look.surface_heights(&field).map_err(refuse)?;
        let outside = |(level, height): (&mut f64, &f64)| {
            if height.is_nan() {
                *level = f64::NAN;
            }
        };
        levels.iter_mut().zip(&raster.values).for_each(outside);
        let depths = levels.iter().zip(&heights).filter(|(level, _)| !level.is_nan());
        let opacity = |(level, height)| (255.0 * self.look.opacity(level - height)).round() as u8;
        let opacities: Vec<u8> = depths.map(opacity).collect();
        let levels = Raster { values: levels, ..raster.clone() };
        // Nothing but puddles of one node span no triangle.
        let Ok(mut surface) = height_mesh(&levels, spacing_m) else { return Ok(None) };
        surface.colours = vec![self.look.colour; opacities.len()];
        surface.opacities = opacities;
        Ok(Some(surface))
    }
}
