//! NumPy's array files, format 1.0 to 3.0 (NumPy Enhancement Proposal 1).
//!
//! Arrays are read in either byte order, in C or Fortran order, as f64; rasters must have two
//! axes (rows, columns). What the format cannot hold stands in the [`Sidecar`].

pub(crate) mod header;
mod read;

use std::io::Write;
use std::path::Path;

use crate::files::RasterFile;
use crate::stored::stored;
use crate::{
    Encoding, Fault, IfExists, IoError, Metadata, Raster, ReadLimits, SampleType, Sidecar,
};

pub use read::{Array, read_array, read_shape};

/// Reads a raster, with its sidecar when there is one.
///
/// # Errors
/// [`IoError`]: the file or its sidecar cannot be read, is no array of two axes, is too
/// large, too short, or holds no number.
pub fn read(path: &Path, limits: &ReadLimits) -> Result<RasterFile, IoError> {
    let Array { shape, mut values } = read_array(path, limits)?;
    let [height, width] = shape[..] else {
        let problem = format!("the array has {} axes: {shape:?}", shape.len());
        let fault = Fault::new(problem, "two axes: rows, columns", "save a slice of two axes");
        return Err(fault.reading(path));
    };
    let sidecar = Sidecar::read(path)?;
    let encoding = sidecar.as_ref().map(|sidecar| sidecar.encoding).unwrap_or_default();
    encoding.decode(&mut values);
    let (metadata, georeference) = match sidecar {
        Some(sidecar) => (sidecar.metadata, sidecar.georeference),
        None => (Metadata::default(), None),
    };
    let raster = Raster { width, height, values, no_data: encoding.no_data, georeference };
    let raster = raster.checked().map_err(|fault| fault.reading(path))?;
    Ok(RasterFile { raster, metadata, encoding })
}

/// Writes a raster in C order, little endian, and its sidecar. Floating-point types mark
/// missing cells with NaN unless the raster names a no-data value; the others round to the
/// nearest whole number.
///
/// # Errors
/// [`IoError`]: a value does not fit the sample type, or the output cannot be written.
pub fn write(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    sample: SampleType,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let stored =
        stored(raster, sample, [1.0, 0.0], sample.marks()).map_err(|fault| fault.writing(path))?;
    let sidecar = Sidecar {
        size: vec![raster.width, raster.height],
        sample: sample.name().into(),
        metadata: metadata.clone(),
        encoding: stored.encoding,
        georeference: raster.georeference.clone(),
    };
    sidecar.write_with(path, if_exists, |writer| {
        writer.write_all(&header::bytes(&[raster.height, raster.width], sample.name()))?;
        sample.write(&stored.numbers, writer)
    })
}

/// Writes an array of any number of axes, and its sidecar. `shape` is as NumPy has it: the
/// last axis varies fastest, so a field on a volume lattice is `[layers, rows, columns]`.
///
/// # Errors
/// [`IoError`]: shape and values disagree, or the output cannot be written.
pub fn write_array(
    path: &Path,
    shape: &[usize],
    values: &[f64],
    metadata: &Metadata,
    sample: SampleType,
    if_exists: IfExists,
) -> Result<(), IoError> {
    if shape.iter().try_fold(1, |cells: usize, &size| cells.checked_mul(size)) != Some(values.len())
    {
        let problem = format!("the shape {shape:?} with {} values", values.len());
        return Err(Fault::new(problem, "one value a cell", "make them agree").writing(path));
    }
    let sidecar = Sidecar {
        size: shape.iter().rev().copied().collect(),
        sample: sample.name().into(),
        metadata: metadata.clone(),
        encoding: Encoding::default(),
        georeference: None,
    };
    sidecar.write_with(path, if_exists, |writer| {
        writer.write_all(&header::bytes(shape, sample.name()))?;
        sample.write(values, writer)
    })
}
