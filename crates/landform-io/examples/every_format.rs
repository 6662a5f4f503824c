//! Writes one small field in every format into a folder:
//! `cargo run -p landform-io --example every_format -- FOLDER`.

use std::error::Error;
use std::path::PathBuf;

use landform_io::geotiff::{self, Options};
use landform_io::mesh::height_mesh;
use landform_io::{
    CoordinateSystem, Georeference, IfExists, Metadata, Raster, SampleType, npy, write_mesh,
    write_raster,
};

const SPACING: f64 = 30.0;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("name a folder")?);
    let raster = hill(65, 49);
    let metadata = Metadata {
        title: Some("A hill with a gap".into()),
        field: Some("height".into()),
        unit: Some("m".into()),
        spacing_m: Some(SPACING),
        seed: Some(7),
        ..Metadata::default()
    };
    for name in ["hill.tif", "hill.asc", "hill.npy", "hill.png", "hill.raw"] {
        write_raster(folder.join(name), &raster, &metadata, IfExists::Replace)?;
    }
    for (name, sample, scale) in
        [("hill_f32.tif", SampleType::F32, 1.0), ("hill_i16.tif", SampleType::I16, 0.1)]
    {
        let options = Options { sample, scale, offset: 0.0 };
        geotiff::write(&folder.join(name), &raster, &metadata, &options, IfExists::Replace)?;
    }
    let path = folder.join("hill_i16.npy");
    npy::write(&path, &raster, &metadata, SampleType::I16, IfExists::Replace)?;
    let mut mesh = height_mesh(&raster, SPACING)?;
    let [least, most] = raster.range().ok_or("no cell has a value")?;
    let grey = |height: f64| (255.0 * (height - least) / (most - least)) as u8;
    mesh.colours = mesh.positions.iter().map(|&[_, _, z]| [grey(z), 160, 90]).collect();
    for name in ["hill.obj", "hill.ply", "hill.glb", "hill.stl"] {
        write_mesh(folder.join(name), &mesh, &metadata, IfExists::Replace)?;
    }
    Ok(())
}

/// A round hill in a UTM zone; three cells have no data.
fn hill(width: usize, height: usize) -> Raster {
    let level = |cell: usize| {
        let x = (cell % width) as f64 / width as f64 - 0.5;
        let y = (cell / width) as f64 / height as f64 - 0.5;
        800.0 * (-8.0 * (x * x + y * y)).exp() + 0.123 * x
    };
    let mut values: Vec<f64> = (0..width * height).map(level).collect();
    values[5 * width + 3..5 * width + 6].fill(f64::NAN);
    let georeference = Georeference {
        west: 376_313.66,
        north: 3_808_117.83,
        cell_size: [SPACING; 2],
        registration: Default::default(),
        coordinate_system: CoordinateSystem::from_epsg(32611),
    };
    Raster { width, height, values, no_data: None, georeference: Some(georeference) }
}
