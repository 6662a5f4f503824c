//! One door for all raster formats.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::Path;

use crate::{
    Encoding, Fault, IfExists, IoError, Metadata, Raster, ReadLimits, SampleType, esri_ascii,
    geotiff, npy, png16, raw,
};

/// A raster with all that its file says about it.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterFile {
    /// The cells and where they lie.
    pub raster: Raster,
    /// What the values are; empty when nothing says.
    pub metadata: Metadata,
    /// How the file stored them; the raster holds values, not stored numbers.
    pub encoding: Encoding,
}

const READABLE: &str = ".tif, .tiff, .asc, .npy, .png";
#[cfg(not(feature = "exr"))]
const WRITABLE: &str = ".tif, .tiff, .asc, .npy, .png, .raw (.exr with the feature `exr`)";
#[cfg(feature = "exr")]
const WRITABLE: &str = ".tif, .tiff, .asc, .npy, .png, .raw, .exr";

/// Reads a raster within the default [`ReadLimits`]: GeoTIFF, NPY and PNG are known by their first
/// bytes, ESRI ASCII by its extension or its first word.
///
/// # Errors
/// [`IoError`]: no such file, an unknown format, or content that is damaged or absurd.
pub fn read_raster(path: impl AsRef<Path>) -> Result<Raster, IoError> {
    read_raster_file(path, &ReadLimits::default()).map(|file| file.raster)
}

/// Reads a raster with its metadata; see [`read_raster`].
///
/// # Errors
/// As [`read_raster`].
pub fn read_raster_file(
    path: impl AsRef<Path>,
    limits: &ReadLimits,
) -> Result<RasterFile, IoError> {
    let path = path.as_ref();
    let start = first_bytes(path)?;
    let text = String::from_utf8_lossy(&start).to_ascii_lowercase();
    match (extension(path).as_str(), start.as_slice()) {
        (_, [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..]) => {
            geotiff::read(path, limits)
        }
        (_, [0x93, b'N', b'U', b'M', b'P', b'Y', ..]) => npy::read(path, limits),
        (_, [0x89, b'P', b'N', b'G', ..]) => png16::read(path, limits),
        ("asc", _) => esri_ascii::read(path, limits),
        _ if text.trim_start().starts_with("ncols") => esri_ascii::read(path, limits),
        // Damaged files of a known name: their reader says what is wrong.
        ("tif" | "tiff", _) => geotiff::read(path, limits),
        ("npy", _) => npy::read(path, limits),
        ("png", _) => png16::read(path, limits),
        (extension, _) => Err(unknown(path, extension, READABLE)),
    }
}

/// Writes a raster in the format that the extension names, as doubles (`.tif`, `.npy`), text
/// (`.asc`), singles (`.raw`) or 16-bit grey over the whole range (`.png`). Scale, offset,
/// unit, spacing and seed go with it, in the file or in a sidecar `NAME.EXT.json`.
///
/// The modules of the formats have functions with more choices.
///
/// # Errors
/// [`IoError`]: an unknown extension, values that are infinite, or an output that is there
/// already or cannot be written.
pub fn write_raster(
    path: impl AsRef<Path>,
    raster: &Raster,
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let path = path.as_ref();
    match extension(path).as_str() {
        "tif" | "tiff" => {
            geotiff::write(path, raster, metadata, &geotiff::Options::default(), if_exists)
        }
        "asc" => esri_ascii::write(path, raster, metadata, if_exists),
        "npy" => npy::write(path, raster, metadata, SampleType::F64, if_exists),
        "png" => png16::write(path, raster, metadata, None, if_exists),
        "raw" => raw::write(path, raster, metadata, if_exists),
        #[cfg(feature = "exr")]
        "exr" => crate::open_exr::write(path, raster, metadata, if_exists),
        extension => Err(unknown(path, extension, WRITABLE)),
    }
}

/// The extension in lower case, without the dot.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map(|text| text.to_string_lossy().to_lowercase()).unwrap_or_default()
}

pub(crate) fn unknown(path: &Path, extension: &str, known: &'static str) -> IoError {
    IoError::UnknownFormat { path: path.into(), extension: extension.into(), known }
}

/// Text that stands beside a raster; `None` when there is none.
pub(crate) fn text_beside(path: &Path) -> Result<Option<String>, IoError> {
    const LONGEST: u64 = 1 << 24;
    let mut text = String::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_string(&mut text));
    match read {
        Ok(length) if length as u64 > LONGEST => {
            let expected = format!("at most {LONGEST} bytes");
            let fault = Fault::new("the text is too long", expected, "remove or repair the file");
            Err(fault.reading(path))
        }
        Ok(_) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(IoError::system(path, "read", error)),
    }
}

fn first_bytes(path: &Path) -> Result<Vec<u8>, IoError> {
    let system = |error| IoError::system(path, "read", error);
    let kind = fs::metadata(path).map_err(system)?.file_type();
    // Opening a pipe waits until somebody writes, and what is read of it once is gone.
    if !kind.is_file() && !kind.is_dir() {
        let fault = Fault::new("this is a pipe or a device", "a file", "save it to a file first");
        return Err(fault.reading(path));
    }
    let mut start = Vec::new();
    File::open(path).map_err(system)?.take(64).read_to_end(&mut start).map_err(system)?;
    Ok(start)
}
