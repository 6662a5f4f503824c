//! `landform export`: a field of a finished run as a raster or a mesh.

use std::path::Path;

use landform_io::{IfExists, RasterFile, ReadLimits, read_raster_file, write_raster};
use landform_sim::code::Code;
use landform_view::ColourMap;

use super::arguments::ExportArguments;
use super::{Failure, Outcome, refused, talk};
use crate::explain::code_of_file;
use crate::outputs::{WaterDepths, WaterOver, water_of, write_mesh};

/// Writes the field of the arguments.
pub(super) fn export(arguments: &ExportArguments) -> Outcome {
    let file = field_of(&arguments.folder, &arguments.field)?;
    let if_exists = match arguments.force {
        true => IfExists::Replace,
        false => IfExists::Refuse,
    };
    let extension = arguments.to.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let water = water(arguments, &extension)?;
    let written = match extension.as_str() {
        "obj" | "ply" | "glb" | "stl" => {
            let colours = ColourMap::named("sand").map_err(refused(Code::Picture))?;
            let drawn = (colours, water);
            write_mesh(&arguments.to, &file.raster, &file.metadata, drawn, if_exists)
        }
        _ => write_raster(&arguments.to, &file.raster, &file.metadata, if_exists),
    };
    written.map_err(|error| Failure::refused(code_of_file(&error), error))?;
    talk::say(&format!("{}\n", arguments.to.display()))
}

/// The water over a mesh, if it is asked for.
fn water(arguments: &ExportArguments, extension: &str) -> Result<Option<WaterOver>, Failure> {
    let Some(field) = &arguments.depths else { return Ok(None) };
    if !matches!(extension, "obj" | "ply" | "glb") {
        let message = "--depths adds water to a mesh; write to .glb, .obj or .ply";
        return Err(Failure::refused(Code::Arguments, message));
    }
    let depths = field_of(&arguments.folder, field)?.raster.values;
    let look =
        water_of(None, Some(&WaterDepths { field: field.clone(), ..WaterDepths::default() }));
    Ok(look.map(|look| WaterOver { look, depths: Some(depths) }))
}

/// The field of a run's folder.
pub(super) fn field_of(folder: &Path, field: &str) -> Result<RasterFile, Failure> {
    let fields = folder.join("fields");
    let path = fields.join(format!("{field}.npy"));
    if !path.is_file() {
        let known = known_fields(&fields);
        let message = match known.is_empty() {
            true => format!("{} is not the output folder of a run", folder.display()),
            false => format!(
                "{} has no field `{field}`; there are: {}",
                folder.display(),
                known.join(", ")
            ),
        };
        return Err(Failure::refused(Code::NoRun, message));
    }
    read_raster_file(&path, &ReadLimits::default())
        .map_err(|error| Failure::refused(code_of_file(&error), error))
}

/// Names of the fields in a folder, in order.
fn known_fields(fields: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(fields).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "npy"))
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    names
}
