//! Pictures of a field in 16-bit grey, with the scale that turns grey into values.

mod read;

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use png::{BitDepth, ColorType, Compression, Encoder};

use crate::{Encoding, Fault, IfExists, IoError, Metadata, Raster};

pub use read::read;

/// Writes a field as 16-bit grey: `value = offset + scale * grey`. The greys span `range`
/// (least and greatest value; values beyond it get its ends), or the whole range of the
/// raster. When cells are missing, grey 0 is theirs alone and the values start at 1.
///
/// The text chunks of the file hold the metadata, `scale`, `offset` and, if needed, `no_data`.
///
/// # Errors
/// [`IoError`]: no cell has a value, a value is infinite, the range is not increasing, or the
/// output cannot be written.
pub fn write(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    range: Option<[f64; 2]>,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let fault = |fault: Fault| fault.writing(path);
    raster.check_size().map_err(fault)?;
    let encoding = encoding(raster, range).map_err(fault)?;
    let size = raster.size().map(u32::try_from);
    let [Ok(width), Ok(height)] = size else {
        let problem = format!("{} x {} cells", raster.width, raster.height);
        return Err(fault(Fault::new(problem, "at most 2^32 a side", "write a part")));
    };
    crate::write_atomically(path, if_exists, |writer| {
        let mut encoder = Encoder::new(writer, width, height);
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::Sixteen);
        encoder.set_compression(Compression::Balanced);
        for (name, text) in texts(metadata, &encoding) {
            // Plain text chunks are the best known, but hold Latin letters only.
            match text.is_ascii() {
                true => encoder.add_text_chunk(name, text)?,
                false => encoder.add_itxt_chunk(name, text)?,
            }
        }
        let mut header = encoder.write_header()?;
        let mut stream = header.stream_writer()?;
        for row in raster.values.chunks(raster.width) {
            stream.write_all(&greys(row, &encoding))?;
        }
        stream.finish()?;
        header.finish().map_err(io::Error::from)
    })
}

/// Scale and offset that spread `range` over the greys.
fn encoding(raster: &Raster, range: Option<[f64; 2]>) -> Result<Encoding, Fault> {
    let whole = raster.range().ok_or_else(|| {
        Fault::new("no cell has a value", "at least one number", "check the field")
    })?;
    let [least, most] = range.unwrap_or(whole);
    let finite = whole.iter().chain([&least, &most]).all(|value| value.is_finite());
    if !finite || least > most || (range.is_some() && least == most) {
        let problem = format!("values from {least} to {most}");
        return Err(Fault::new(problem, "a finite, increasing range", "check field and range"));
    }
    let missing = raster.missing_count() > 0;
    let first = f64::from(u8::from(missing));
    let scale = if most > least { (most - least) / (GREATEST - first) } else { 1.0 };
    Ok(Encoding { scale, offset: least - first * scale, no_data: missing.then_some(0.0) })
}

const GREATEST: f64 = 65535.0;

fn texts(metadata: &Metadata, encoding: &Encoding) -> Vec<(String, String)> {
    let mut texts = metadata.entries();
    texts.push(("scale".into(), encoding.scale.to_string()));
    texts.push(("offset".into(), encoding.offset.to_string()));
    texts.extend(encoding.no_data.map(|mark| ("no_data".into(), mark.to_string())));
    for (name, _) in &mut texts {
        *name = keyword(name).into_owned();
    }
    texts
}

/// A name as a keyword of the format: 1 to 79 printable letters. The title has a standard one.
fn keyword(name: &str) -> Cow<'_, str> {
    let fits = |letter: char| letter.is_ascii_graphic();
    match name {
        "title" => Cow::Borrowed("Title"),
        "" => Cow::Borrowed("note"),
        _ if name.len() < 80 && name.chars().all(fits) => Cow::Borrowed(name),
        _ => name.chars().map(|c| if fits(c) { c } else { '_' }).take(79).collect(),
    }
}

fn greys(row: &[f64], encoding: &Encoding) -> Vec<u8> {
    let first = f64::from(u8::from(encoding.no_data.is_some()));
    let grey = |&value: &f64| match value.is_nan() {
        true => 0,
        false => ((value - encoding.offset) / encoding.scale).round().clamp(first, GREATEST) as u16,
    };
    row.iter().flat_map(|value| grey(value).to_be_bytes()).collect()
}
