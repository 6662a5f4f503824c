//! Grey pictures as rasters.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, ErrorKind};
use std::path::Path;

use png::{BitDepth, ColorType, Decoder, DecodingError, Info};

use crate::{Encoding, Fault, Georeference, IoError, Metadata, Raster, RasterFile, ReadLimits};

/// Reads a picture of 8-bit or 16-bit grey: `value = offset + scale * grey`, with the scale and the
/// offset that [`write`](super::write) leaves in the text of the file. Without them the values are
/// the greys, from 0 to 255 or 65535.
///
/// # Errors
/// [`IoError`]: no such file, not a PNG or damaged, colours, more pixels than `limits` allow, or a
/// scale that is no number.
pub fn read(path: &Path, limits: &ReadLimits) -> Result<RasterFile, IoError> {
    let file = File::open(path).map_err(|error| IoError::system(path, "read", error))?;
    let fault = |error: DecodingError| damage(path, error);
    let mut reader = Decoder::new(BufReader::new(file)).read_info().map_err(fault)?;
    let bytes_a_grey = bytes_a_grey(reader.info()).map_err(|fault| fault.reading(path))?;
    let (width, height) = reader.info().size();
    let cells = limits.cells(path, &[width.into(), height.into()])?;
    check_length(path, (cells * bytes_a_grey) as u64)?;
    let mut bytes = vec![0; cells * bytes_a_grey];
    reader.next_frame(&mut bytes).map_err(fault)?;
    // Some programs write the text behind the picture.
    reader.finish().map_err(fault)?;
    let mut texts = texts(reader.info());
    let encoding = encoding(&mut texts).map_err(|fault| fault.reading(path))?;
    let mut values = greys(&bytes, bytes_a_grey);
    encoding.decode(&mut values);
    let metadata = Metadata::from_entries(texts);
    let [width, height] = [width as usize, height as usize];
    let spacing = metadata.spacing_m.filter(|spacing| *spacing > 0.0 && spacing.is_finite());
    let georeference = spacing.map(|spacing| Georeference::local(height, spacing));
    let raster = Raster { width, height, values, no_data: encoding.no_data, georeference };
    let raster = raster.checked().map_err(|fault| fault.reading(path))?;
    Ok(RasterFile { raster, metadata, encoding })
}

/// Refuses a file too short for its picture, before memory is taken: nothing becomes shorter than
/// a 1032nd of itself in this compression.
fn check_length(path: &Path, picture: u64) -> Result<(), IoError> {
    let length = std::fs::metadata(path).map_err(|error| IoError::system(path, "read", error))?;
    if picture / 1032 <= length.len() {
        return Ok(());
    }
    let problem = format!("the file is too short for a picture of {picture} bytes");
    Err(Fault::new(problem, "a whole PNG file", "fetch or save it again").reading(path))
}

fn damage(path: &Path, error: DecodingError) -> IoError {
    match error {
        DecodingError::IoError(error) if error.kind() != ErrorKind::UnexpectedEof => {
            IoError::system(path, "read", error)
        }
        error => {
            let problem = format!("this is no whole PNG picture ({error})");
            Fault::new(problem, "a PNG file", "fetch or save it again").reading(path)
        }
    }
}

/// 1 or 2; other pictures are refused.
fn bytes_a_grey(info: &Info<'_>) -> Result<usize, Fault> {
    match (info.color_type, info.bit_depth) {
        (ColorType::Grayscale, BitDepth::Eight) => Ok(1),
        (ColorType::Grayscale, BitDepth::Sixteen) => Ok(2),
        (colour, depth) => {
            let problem = format!("the picture holds {colour:?} of {} bits", depth as u8);
            let advice = "colours are no heights: save one band as grey";
            Err(Fault::new(problem, "grey of 8 or 16 bits", advice))
        }
    }
}

fn greys(bytes: &[u8], bytes_a_grey: usize) -> Vec<f64> {
    match bytes_a_grey {
        1 => bytes.iter().copied().map(f64::from).collect(),
        _ => {
            let pairs = bytes.chunks_exact(2);
            pairs.map(|pair| u16::from_be_bytes([pair[0], pair[1]]).into()).collect()
        }
    }
}

/// The text entries of a file, by their names as metadata have them.
fn texts(info: &Info<'_>) -> BTreeMap<String, String> {
    let plain = info.uncompressed_latin1_text.iter();
    let plain = plain.map(|entry| (entry.keyword.clone(), entry.text.clone()));
    let wide = info.utf8_text.iter();
    let wide = wide.filter_map(|entry| Some((entry.keyword.clone(), entry.get_text().ok()?)));
    let own = |name: String| if name == "Title" { "title".to_owned() } else { name };
    plain.chain(wide).map(|(name, text)| (own(name), text)).collect()
}

/// Takes scale, offset and the mark of missing cells out of the entries.
fn encoding(texts: &mut BTreeMap<String, String>) -> Result<Encoding, Fault> {
    let plain = Encoding::default();
    let mut take = |name: &str| {
        let Some(text) = texts.remove(name) else { return Ok(None) };
        let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        number.map(Some).ok_or_else(|| {
            let problem = format!("the text entry `{name}` is {text:?}");
            Fault::new(problem, "a finite number", "correct or remove the entry")
        })
    };
    Ok(Encoding {
        scale: take("scale")?.unwrap_or(plain.scale),
        offset: take("offset")?.unwrap_or(plain.offset),
        no_data: take("no_data")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scratch::Scratch;
    use crate::{IfExists, read_raster_file, write_raster};

    fn file(path: &Path) -> RasterFile {
        read_raster_file(path, &ReadLimits::default()).unwrap()
    }

    #[test]
    fn what_is_written_comes_back_to_a_step_of_grey() {
        let scratch = Scratch::new("png16");
        let path = scratch.path("height.png");
        let mut raster = Raster::local(7, 5, 12.5, (0..35).map(|i| f64::from(i * i)).collect());
        let metadata = Metadata {
            title: Some("Hügel – 山".into()),
            unit: Some("m".into()),
            spacing_m: Some(12.5),
            seed: Some(7),
            ..Metadata::default()
        };
        for gap in [false, true] {
            if gap {
                raster.values[11] = f64::NAN;
            }
            write_raster(&path, &raster, &metadata, IfExists::Replace).unwrap();
            let found = file(&path);
            assert_eq!(found.metadata, metadata);
            assert_eq!(found.raster.spacing_m(), Ok(12.5));
            for (found, value) in found.raster.values.iter().zip(&raster.values) {
                let same = (found - value).abs() <= 0.51 * 1156.0 / 65534.0;
                assert!(same || found.is_nan() && value.is_nan(), "{found} {value}");
            }
        }
    }

    fn encode(
        path: &Path,
        colour: ColorType,
        depth: BitDepth,
        bytes: &[u8],
        text: &[(&str, &str)],
    ) {
        let mut encoder = png::Encoder::new(File::create(path).unwrap(), 2, 2);
        encoder.set_color(colour);
        encoder.set_depth(depth);
        for (name, text) in text {
            encoder.add_text_chunk((*name).into(), (*text).into()).unwrap();
        }
        encoder.write_header().unwrap().write_image_data(bytes).unwrap();
    }

    #[test]
    fn pictures_of_others_are_greys_and_colours_are_refused() {
        let scratch = Scratch::new("foreign_png");
        let path = scratch.path("other.png");
        encode(&path, ColorType::Grayscale, BitDepth::Eight, &[0, 1, 7, 255], &[]);
        let found = file(&path);
        assert_eq!(found.raster.values, [0.0, 1.0, 7.0, 255.0]);
        assert_eq!((found.raster.georeference, found.metadata), (None, Metadata::default()));
        encode(&path, ColorType::Rgb, BitDepth::Eight, &[9; 12], &[]);
        let message = crate::read_raster(&path).unwrap_err().to_string();
        assert!(
            message.contains("Rgb of 8 bits") && message.contains("save one band"),
            "{message}"
        );
        let bad = [("scale", "nan"), ("offset", "high")];
        for entry in bad {
            encode(&path, ColorType::Grayscale, BitDepth::Eight, &[0, 1, 7, 255], &[entry]);
            let message = crate::read_raster(&path).unwrap_err().to_string();
            assert!(message.contains(entry.0) && message.contains("finite number"), "{message}");
        }
    }

    #[test]
    fn damaged_and_large_pictures_are_refused() {
        let scratch = Scratch::new("bad_png");
        let path = scratch.path("bad.png");
        let raster = Raster::local(40, 30, 1.0, (0..1200).map(f64::from).collect());
        write_raster(&path, &raster, &Metadata::default(), IfExists::Refuse).unwrap();
        let small = read_raster_file(&path, &ReadLimits { max_cells: 1199 });
        assert!(matches!(small, Err(IoError::TooLarge { .. })), "{small:?}");
        let whole = std::fs::read(&path).unwrap();
        for length in [4, 8, 20, 33, whole.len() / 2, whole.len() - 20] {
            std::fs::write(&path, &whole[..length]).unwrap();
            let message = crate::read_raster(&path).unwrap_err().to_string();
            assert!(message.contains("bad.png"), "{length}: {message}");
        }
        // Sizes that nobody has: they are refused before memory is taken.
        let mut huge = whole;
        huge[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
        std::fs::write(&path, &huge).unwrap();
        assert!(crate::read_raster(&path).is_err());
        huge[16..24].copy_from_slice(&[0, 0, 0x3f, 0xff, 0, 0, 0x3f, 0xff]);
        std::fs::write(&path, &huge).unwrap();
        assert!(crate::read_raster(&path).is_err());
    }

    #[test]
    fn a_spacing_that_is_no_length_is_no_place() {
        let scratch = Scratch::new("png_spacing");
        let path = scratch.path("spacing.png");
        for spacing in ["0", "-3", "inf", "nan"] {
            let grey = (ColorType::Grayscale, BitDepth::Eight);
            encode(&path, grey.0, grey.1, &[0, 1, 7, 255], &[("spacing_m", spacing)]);
            assert_eq!(file(&path).raster.georeference, None, "{spacing}");
        }
    }
}
