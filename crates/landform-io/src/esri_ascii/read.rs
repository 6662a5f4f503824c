//! Grids from text.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::header::{self, Failure, cut_off, number};
use super::tokens::Tokens;
use crate::files::{RasterFile, text_beside};
use crate::{
    CoordinateSystem, Encoding, Fault, IoError, Metadata, Place, Raster, ReadLimits, Sidecar,
};

/// Reads a grid, with its sidecar or the text of its coordinate system when there is one.
///
/// # Errors
/// [`IoError`]: no such file, a header that is incomplete or contradicts itself, more cells
/// than the limit or than the file can hold, words that are no numbers, or too many numbers.
pub fn read(path: &Path, limits: &ReadLimits) -> Result<RasterFile, IoError> {
    let system = |error| IoError::system(path, "read", error);
    let file = File::open(path).map_err(system)?;
    let length = file.metadata().map_err(system)?.len();
    let explain = |failure| match failure {
        Failure::System(error) => system(error),
        Failure::Content(fault) => fault.reading(path),
    };
    let mut tokens = Tokens::new(file);
    let header = header::read(&mut tokens).map_err(explain)?;
    let cells = limits.cells(path, &[header.columns, header.rows])?;
    check_length(length, cells as u64, tokens.line()).map_err(|fault| fault.reading(path))?;
    let mut values = Vec::with_capacity(cells);
    values.extend(header.first);
    read_values(&mut tokens, cells, &mut values).map_err(explain)?;
    let encoding = Encoding { no_data: header.no_data, ..Encoding::default() };
    encoding.decode(&mut values);
    let (metadata, coordinate_system) = description(path)?;
    let mut georeference = header.georeference;
    georeference.coordinate_system = coordinate_system;
    let raster = Raster {
        width: header.columns as usize,
        height: header.rows as usize,
        values,
        no_data: header.no_data,
        georeference: Some(georeference),
    };
    let raster = raster.checked().map_err(|fault| fault.reading(path))?;
    Ok(RasterFile { raster, metadata, encoding })
}

/// A cell takes a digit and a separator, so a short file is known before memory is taken.
fn check_length(length: u64, cells: u64, line: u64) -> Result<(), Fault> {
    if length.div_ceil(2) >= cells {
        return Ok(());
    }
    let expected = format!("at least {} bytes for {cells} cells", 2 * cells - 1);
    Err(cut_off(format!("the file has {length} bytes"), expected, line))
}

fn read_values<R: Read>(
    tokens: &mut Tokens<R>,
    cells: usize,
    values: &mut Vec<f64>,
) -> Result<(), Failure> {
    while let Some(token) = tokens.next()? {
        if values.len() == cells {
            let problem = format!("more numbers follow the {cells} of the header");
            let advice = "correct ncols or nrows, or cut the rest off";
            return Err(Fault::new(problem, "the end", advice).at(Place::Line(token.line)).into());
        }
        values.push(number(token.text, token.line)?);
    }
    if values.len() < cells {
        let problem = format!("the numbers end after {}", values.len());
        return Err(cut_off(problem, format!("{cells} numbers"), tokens.line()).into());
    }
    Ok(())
}

/// What the files beside say: the sidecar, else the text of the coordinate system.
fn description(path: &Path) -> Result<(Metadata, CoordinateSystem), IoError> {
    if let Some(sidecar) = Sidecar::read(path)? {
        let system = sidecar.georeference.map(|place| place.coordinate_system);
        return Ok((sidecar.metadata, system.unwrap_or_default()));
    }
    for extension in ["prj", "prj.txt"] {
        if let Some(text) = text_beside(&path.with_extension(extension))? {
            return Ok((Metadata::default(), CoordinateSystem::from_text(&text)));
        }
    }
    Ok(Default::default())
}
