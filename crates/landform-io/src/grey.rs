//! PNG pictures read as greys.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use png::{ColorType, Decoder, DecodingError, Transformations};

use crate::{Fault, IoError, ReadLimits};

/// A picture as greys.
#[derive(Clone, Debug, PartialEq)]
pub struct Grey {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Greys from 0, black, to 1, white: row by row from the top.
    pub values: Vec<f64>,
}

/// Reads a PNG picture of 8 or 16 bits as greys. Colours become their luma after Rec. 709,
/// without gamma; transparency is passed over.
///
/// # Errors
/// [`IoError`]: no such file, not a PNG, damaged, or more pixels than `limits` allow.
pub fn read_grey(path: impl AsRef<Path>, limits: &ReadLimits) -> Result<Grey, IoError> {
    let path = path.as_ref();
    let system = |error| IoError::system(path, "read", error);
    let kind = std::fs::metadata(path).map_err(system)?.file_type();
    // Opening a pipe waits until somebody writes.
    if !kind.is_file() && !kind.is_dir() {
        let fault = Fault::new("this is a pipe or a device", "a file", "save it to a file first");
        return Err(fault.reading(path));
    }
    let mut decoder = Decoder::new(BufReader::new(File::open(path).map_err(system)?));
    decoder.set_transformations(Transformations::EXPAND);
    let fault = |error: DecodingError| match error {
        DecodingError::IoError(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => {
            IoError::system(path, "read", error)
        }
        error => {
            let problem = format!("this is no whole PNG picture ({error})");
            Fault::new(problem, "a PNG file", "save it again").reading(path)
        }
    };
    let mut reader = decoder.read_info().map_err(fault)?;
    let (width, height) = reader.info().size();
    limits.cells(path, &[u64::from(width), u64::from(height), 8])?;
    let mut bytes = vec![0; reader.output_buffer_size().unwrap_or_default()];
    let frame = reader.next_frame(&mut bytes).map_err(fault)?;
    let (color, depth) = reader.output_color_type();
    bytes.truncate(frame.buffer_size());
    let samples: Vec<f64> = match depth {
        png::BitDepth::Sixteen => {
            let pairs = bytes.chunks_exact(2);
            pairs.map(|pair| f64::from(u16::from_be_bytes([pair[0], pair[1]])) / 65535.0).collect()
        }
        _ => bytes.iter().map(|&byte| f64::from(byte) / 255.0).collect(),
    };
    let luma = |pixel: &[f64]| match color {
        ColorType::Rgb | ColorType::Rgba => {
            0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]
        }
        _ => pixel[0],
    };
    let values: Vec<f64> = samples.chunks_exact(color.samples()).map(luma).collect();
    Ok(Grey { width: width as usize, height: height as usize, values })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scratch::Scratch;
    use crate::{IfExists, Metadata, Raster};

    #[test]
    fn greys_come_back() {
        let scratch = Scratch::new("grey");
        let path = scratch.path("grey.png");
        let raster = Raster::local(3, 2, 1.0, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        crate::write_raster(&path, &raster, &Metadata::default(), IfExists::Refuse).unwrap();
        let grey = read_grey(&path, &ReadLimits::default()).unwrap();
        assert_eq!((grey.width, grey.height), (3, 2));
        for (number, value) in grey.values.into_iter().enumerate() {
            assert!((value - number as f64 / 5.0).abs() < 1e-4, "{number}: {value}");
        }
        let small = ReadLimits { max_cells: 10 };
        assert!(matches!(read_grey(&path, &small), Err(IoError::TooLarge { .. })));
    }

    #[test]
    fn colours_become_luma() {
        let scratch = Scratch::new("grey");
        let path = scratch.path("colour.png");
        let mut encoder = png::Encoder::new(File::create(&path).unwrap(), 2, 1);
        encoder.set_color(ColorType::Rgba);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[0, 255, 0, 9, 255, 255, 255, 0]).unwrap();
        writer.finish().unwrap();
        let grey = read_grey(&path, &ReadLimits::default()).unwrap();
        assert!((grey.values[0] - 0.7152).abs() < 1e-12 && (grey.values[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let scratch = Scratch::new("grey");
        let [text, cut] = ["text.png", "cut.png"].map(|name| scratch.path(name));
        std::fs::write(&text, "ncols 3").unwrap();
        let raster = Raster::local(9, 9, 1.0, (0..81).map(f64::from).collect());
        crate::write_raster(&cut, &raster, &Metadata::default(), IfExists::Refuse).unwrap();
        let bytes = std::fs::read(&cut).unwrap();
        std::fs::write(&cut, &bytes[..bytes.len() - 40]).unwrap();
        for path in [text, cut] {
            let refused = read_grey(&path, &ReadLimits::default()).unwrap_err().to_string();
            assert!(refused.contains("no whole PNG picture"), "{refused}");
        }
        let absent = read_grey(scratch.path("none.png"), &ReadLimits::default());
        assert!(absent.unwrap_err().to_string().contains("none.png"));
    }
}
