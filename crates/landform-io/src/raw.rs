//! Bare numbers for programs that read nothing else: f32, little endian, row by row from the
//! north-west, NaN or the raster's no-data number where there are no data. Size, unit and place
//! stand in the [`Sidecar`].

use std::path::Path;

use crate::stored::stored;
use crate::{IfExists, IoError, Metadata, Raster, SampleType, Sidecar};

/// Writes the numbers and their sidecar.
///
/// # Errors
/// [`IoError`]: a value is not finite or beyond f32, or the output cannot be written.
pub fn write(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let stored = stored(raster, SampleType::F32, [1.0, 0.0], SampleType::F32.marks())
        .map_err(|fault| fault.writing(path))?;
    let sidecar = Sidecar {
        size: vec![raster.width, raster.height],
        sample: SampleType::F32.name().into(),
        metadata: metadata.clone(),
        encoding: stored.encoding,
        georeference: raster.georeference.clone(),
    };
    sidecar.write_with(path, if_exists, |writer| SampleType::F32.write(&stored.numbers, writer))
}
