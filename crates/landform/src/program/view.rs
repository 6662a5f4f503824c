//! `landform view`: a picture of a finished run or of a raster file.

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_io::{RasterFile, ReadLimits, read_raster_file};
use landform_sim::code::Code;
use landform_sim::outside::Outside;

use super::arguments::{LookName, ViewArguments};
use super::{Failure, Outcome, export, refused, talk};
use crate::explain::code_of_file;
use crate::outputs::{Flat, Look, Perspective, Relief, Subject, WaterDepths};

/// Draws the source of the arguments.
pub(super) fn view(arguments: &ViewArguments) -> Outcome {
    if arguments.output.exists() && !arguments.force {
        let shown = arguments.output.display();
        let message = format!("{shown} exists; use --force to replace it");
        return Err(Failure::refused(Code::FileExists, message));
    }
    if arguments.output.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("png")) {
        let shown = arguments.output.display();
        let message = format!("{shown}: pictures are PNG; use a name in .png");
        return Err(Failure::refused(Code::UnknownFormat, message));
    }
    let file = source(arguments)?;
    let raster = &file.raster;
    // A raster that does not say its spacing is drawn as if its nodes were a metre apart.
    let spacing_m = raster.spacing_m().ok().or(file.metadata.spacing_m).or_else(|| {
        let [east, north] = raster.georeference.as_ref()?.ground_cell_size_m(raster.size());
        Some((east * north).sqrt())
    });
    let lattice = Lattice::plane(
        raster.size(),
        spacing_m.unwrap_or(1.0),
        Connectivity::Four,
        [Boundary::Open; 2],
    )
    .map_err(refused(Code::Picture))?;
    let unit = file.metadata.unit.as_deref().unwrap_or("m");
    let water = water(arguments)?;
    let missing: Vec<bool> = raster.values.iter().map(|value| value.is_nan()).collect();
    let outside = Outside::new(&lattice, &missing);
    let mut values = raster.values.clone();
    outside.extend(&mut values);
    let subject = Subject { values, water, unit: unit.to_owned(), outside, ..Subject::default() };
    let image = look(arguments).draw(&lattice, &subject).map_err(refused(Code::Picture))?;
    let text = file.metadata.entries();
    let text: Vec<_> = text.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    image.write_png(&arguments.output, &text).map_err(refused(Code::Picture))?;
    talk::say(&format!("{}\n", arguments.output.display()))
}

fn source(arguments: &ViewArguments) -> Result<RasterFile, Failure> {
    match arguments.source.is_dir() {
        true => export::field_of(&arguments.source, &arguments.field),
        false => read_raster_file(&arguments.source, &ReadLimits::default())
            .map_err(|error| Failure::refused(code_of_file(&error), error)),
    }
}

/// Depths of water in the folder of a run, if they are asked for.
fn water(arguments: &ViewArguments) -> Result<Option<Vec<f64>>, Failure> {
    let Some(field) = &arguments.depths else { return Ok(None) };
    if !arguments.source.is_dir() {
        let message = "--depths names a field of a run; give the run's output folder";
        return Err(Failure::refused(Code::Arguments, message));
    }
    export::field_of(&arguments.source, field).map(|file| {
        let depths = file.raster.values.into_iter();
        Some(depths.map(|depth| if depth.is_nan() { 0.0 } else { depth }).collect())
    })
}

fn look(arguments: &ViewArguments) -> Look {
    let depths = arguments.depths.as_ref();
    let water = depths.map(|field| WaterDepths { field: field.clone(), ..WaterDepths::default() });
    let colours = |default: String| arguments.colours.clone().unwrap_or(default);
    match arguments.look {
        LookName::Relief => {
            let plain = Relief::default();
            Look::Relief(Relief {
                colours: colours(plain.colours),
                vertical_exaggeration: arguments.exaggeration.unwrap_or(1.0),
                water_level_m: arguments.water,
                water,
                ..Relief::default()
            })
        }
        LookName::Perspective => {
            let plain = Perspective::default();
            Look::Perspective(Perspective {
                colours: colours(plain.colours.clone()),
                bearing_deg: arguments.bearing.unwrap_or(plain.bearing_deg),
                pitch_deg: arguments.pitch.unwrap_or(plain.pitch_deg),
                zoom: arguments.zoom.unwrap_or(plain.zoom),
                vertical_exaggeration: arguments.exaggeration.unwrap_or(1.0),
                water_level_m: arguments.water,
                water,
                ..plain
            })
        }
        LookName::Flat => {
            let plain = Flat::default();
            Look::Flat(Flat { colours: colours(plain.colours.clone()), ..plain })
        }
    }
}
