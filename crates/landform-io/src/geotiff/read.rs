//! Rasters from GeoTIFF.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use tiff::TiffError;
use tiff::decoder::{ChunkType, Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::gdal;
use super::place::Tags;
use crate::files::RasterFile;
use crate::georeference::GeoKeys;
use crate::{Encoding, Fault, IoError, Metadata, Place, Raster, ReadLimits};

type Tiff = Decoder<BufReader<File>>;

/// GDAL's metadata, which the decoder has no name for.
const GDAL_METADATA: Tag = Tag::Unknown(42112);
const TRANSFORMATION: Tag = Tag::ModelTransformationTag;

/// Reads the first image of a GeoTIFF.
///
/// # Errors
/// [`IoError`]: no such file, damaged or cut off, more than one band, more cells than the
/// limit, a rotated raster, or no cell with a number.
pub fn read(path: &Path, limits: &ReadLimits) -> Result<RasterFile, IoError> {
    let system = |error| IoError::system(path, "read", error);
    let file = File::open(path).map_err(system)?;
    let length = file.metadata().map_err(system)?.len();
    let explain = |error| damage(error, Place::Whole).reading(path);
    let mut tiff = Decoder::new(BufReader::new(file)).map_err(explain)?;
    let (width, height) = tiff.dimensions().map_err(explain)?;
    let cells = limits.cells(path, &[width.into(), height.into()])?;
    tiff = tiff.with_limits(decoder_limits(cells));
    let fault = |fault: Fault| fault.reading(path);
    check_length(&mut tiff, length, cells as u64).map_err(fault)?;
    let [width, height] = [width, height].map(|size| size as usize);
    let mut values = read_cells(&mut tiff, [width, height]).map_err(fault)?;
    let georeference = tags(&mut tiff).map_err(explain)?.georeference().map_err(fault)?;
    let (metadata, encoding) = description(&mut tiff).map_err(explain)?;
    encoding.decode(&mut values);
    let raster = Raster { width, height, values, no_data: encoding.no_data, georeference };
    let raster = raster.checked().map_err(fault)?;
    Ok(RasterFile { raster, metadata, encoding })
}

/// More than any of the compressions that are read makes of a byte; 4096 is LZW's longest chain.
const MOST_PACKED: u64 = 1 << 12;

/// A file that is too short for its cells is known before memory is taken.
fn check_length(tiff: &mut Tiff, length: u64, cells: u64) -> Result<(), Fault> {
    let bits = tiff.find_tag_unsigned_vec::<u16>(Tag::BitsPerSample);
    let bits = bits.map_err(|error| damage(error, Place::Whole))?.unwrap_or_default();
    let bits = u64::from(bits.first().copied().unwrap_or(1).max(1));
    let least = (cells.saturating_mul(bits) / 8).div_ceil(MOST_PACKED);
    if length >= least {
        return Ok(());
    }
    let problem = format!("the file has {length} bytes for {cells} cells");
    let advice = "the file is cut off or its header is damaged: fetch or write it again";
    Err(Fault::new(problem, format!("at least {least} bytes, even if packed well"), advice))
}

/// A strip may hold the whole image, but no more.
fn decoder_limits(cells: usize) -> Limits {
    let mut limits = Limits::default();
    let whole = cells.saturating_mul(8).max(1 << 16);
    limits.decoding_buffer_size = whole;
    limits.intermediate_buffer_size = whole;
    limits.ifd_value_size = (1 << 26).min(whole.max(1 << 20));
    limits
}

const DAMAGED: &str = "the file is damaged: fetch or write it again";

/// What the decoder found wrong, for the reader of the message.
fn damage(error: TiffError, place: Place) -> Fault {
    let (expected, advice) = match &error {
        TiffError::UnsupportedError(_) => (
            "one band in strips or tiles, bare or compressed by deflate, LZW or PackBits",
            "convert the file, for example with gdal_translate -co COMPRESS=DEFLATE",
        ),
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            ("more bytes", "the file is cut off: fetch or write it again")
        }
        TiffError::LimitsExceeded | TiffError::IntSizeError => {
            ("strips no larger than the image", DAMAGED)
        }
        _ => ("a TIFF file", DAMAGED),
    };
    // The decoder quotes whole tags, whatever their length.
    let problem: String = error.to_string().chars().take(200).collect();
    Fault::new(problem, expected, advice).at(place)
}

/// Columns and rows of a strip or tile.
fn chunk_size(tiff: &mut Tiff, [width, height]: [usize; 2]) -> Result<[usize; 2], Fault> {
    let explain = |error| damage(error, Place::Whole);
    let mut tag = |tag, default: usize| {
        let found = tiff.find_tag_unsigned::<u32>(tag).map_err(explain)?;
        Ok(found.map_or(default, |size| size as usize))
    };
    let size = match tag(Tag::TileWidth, 0)? {
        0 => [width, tag(Tag::RowsPerStrip, height)?.min(height)],
        tile_width => [tile_width, tag(Tag::TileLength, 0)?],
    };
    match size {
        [0, _] | [_, 0] => {
            let problem = format!("strips or tiles of {} x {} cells", size[0], size[1]);
            Err(Fault::new(problem, "at least one cell", DAMAGED))
        }
        size => Ok(size),
    }
}

/// The cells, strip by strip or tile by tile.
fn read_cells(tiff: &mut Tiff, size: [usize; 2]) -> Result<Vec<f64>, Fault> {
    let [width, height] = size;
    check_bands(tiff)?;
    let chunk = chunk_size(tiff, size)?;
    let across = width.div_ceil(chunk[0]);
    let count = chunk_count(tiff, across * height.div_ceil(chunk[1]))?;
    let mut values = vec![0.0; width * height];
    for index in 0..count {
        let place = Place::Chunk(index);
        let part = tiff.read_chunk(index).map_err(|error| damage(error, place))?;
        let column = index as usize % across * chunk[0];
        let row = index as usize / across * chunk[1];
        let columns = column..width.min(column + chunk[0]);
        let rows = row..height.min(row + chunk[1]);
        let part = numbers(part);
        if part.len() < columns.len() * rows.len() {
            let expected = format!("{} x {}", columns.len(), rows.len());
            let fault = Fault::new(format!("{} numbers", part.len()), expected, DAMAGED);
            return Err(fault.at(place));
        }
        for (row, part) in rows.zip(part.chunks(columns.len())) {
            values[row * width..][columns.clone()].copy_from_slice(part);
        }
    }
    Ok(values)
}

fn check_bands(tiff: &mut Tiff) -> Result<(), Fault> {
    let bands = tiff.find_tag_unsigned::<u16>(Tag::SamplesPerPixel);
    match bands.map_err(|error| damage(error, Place::Whole))?.unwrap_or(1) {
        1 => Ok(()),
        bands => {
            let problem = format!("the image has {bands} bands");
            let advice = "extract one, for example with gdal_translate -b 1";
            Err(Fault::new(problem, "one band of heights", advice))
        }
    }
}

/// The number of strips or tiles, which must be what the size demands.
fn chunk_count(tiff: &mut Tiff, demanded: usize) -> Result<u32, Fault> {
    let count = match tiff.get_chunk_type() {
        ChunkType::Strip => tiff.strip_count(),
        ChunkType::Tile => tiff.tile_count(),
    };
    let count = count.map_err(|error| damage(error, Place::Whole))?;
    if count as usize != demanded {
        let problem = format!("the file has {count} strips or tiles");
        return Err(Fault::new(problem, format!("{demanded} to fill the image"), DAMAGED));
    }
    Ok(count)
}

fn numbers(part: DecodingResult) -> Vec<f64> {
    fn all<T: Into<f64>>(numbers: Vec<T>) -> Vec<f64> {
        numbers.into_iter().map(Into::into).collect()
    }
    match part {
        DecodingResult::F64(numbers) => numbers,
        DecodingResult::F32(numbers) => all(numbers),
        DecodingResult::F16(numbers) => numbers.into_iter().map(|v| v.to_f64()).collect(),
        DecodingResult::I8(numbers) => all(numbers),
        DecodingResult::I16(numbers) => all(numbers),
        DecodingResult::I32(numbers) => all(numbers),
        DecodingResult::U8(numbers) => all(numbers),
        DecodingResult::U16(numbers) => all(numbers),
        DecodingResult::U32(numbers) => all(numbers),
        DecodingResult::I64(numbers) => numbers.into_iter().map(|v| v as f64).collect(),
        DecodingResult::U64(numbers) => numbers.into_iter().map(|v| v as f64).collect(),
    }
}

/// The tags that place the raster.
fn tags(tiff: &mut Tiff) -> Result<Tags, TiffError> {
    let mut doubles = |tag| match tiff.find_tag(tag)? {
        Some(value) => value.into_f64_vec(),
        None => Ok(Vec::new()),
    };
    let pixel_scale = doubles(Tag::ModelPixelScaleTag)?;
    let tie_points = doubles(Tag::ModelTiepointTag)?;
    let transformation = doubles(TRANSFORMATION)?;
    let keys = GeoKeys {
        doubles: doubles(Tag::GeoDoubleParamsTag)?,
        directory: match tiff.find_tag(Tag::GeoKeyDirectoryTag)? {
            Some(value) => value.into_u16_vec()?,
            None => Vec::new(),
        },
        text: text(tiff, Tag::GeoAsciiParamsTag)?.unwrap_or_default(),
    };
    Ok(Tags { pixel_scale, tie_points, transformation, keys })
}

fn text(tiff: &mut Tiff, tag: Tag) -> Result<Option<String>, TiffError> {
    tiff.find_tag(tag)?.map(|value| value.into_string()).transpose()
}

/// Metadata, scale, offset and the no-data number.
fn description(tiff: &mut Tiff) -> Result<(Metadata, Encoding), TiffError> {
    let xml = text(tiff, GDAL_METADATA)?.unwrap_or_default();
    let (metadata, [scale, offset]) = gdal::parse(&xml);
    let mark = text(tiff, Tag::GdalNodata)?;
    let no_data = mark.and_then(|mark| mark.trim_end_matches('\0').trim().parse().ok());
    Ok((metadata, Encoding { scale, offset, no_data }))
}
