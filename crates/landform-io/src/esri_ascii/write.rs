//! Grids as text.

use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use crate::stored::stored;
use crate::{
    Fault, Georeference, IfExists, IoError, Metadata, Raster, Registration, SampleType, Sidecar,
};

/// Writes a grid with every digit that its values need to be read back bit for bit, and a
/// sidecar. Missing cells are the raster's no-data value, or -9999 unless that occurs.
///
/// # Errors
/// [`IoError`]: there is no georeference, cells are not square, a value is infinite, or the
/// output cannot be written.
pub fn write(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let fault = |fault: Fault| fault.writing(path);
    let header = header(raster).map_err(fault)?;
    let stored = stored(raster, SampleType::F64, [1.0, 0.0], &MARKS).map_err(fault)?;
    let sidecar = Sidecar {
        size: vec![raster.width, raster.height],
        sample: "text".into(),
        metadata: metadata.clone(),
        encoding: stored.encoding,
        georeference: raster.georeference.clone(),
    };
    sidecar.write_with(path, if_exists, |writer| {
        writer.write_all(header.as_bytes())?;
        if let Some(mark) = stored.encoding.no_data {
            writeln!(writer, "NODATA_value {}", Text(mark))?;
        }
        stored.numbers.chunks(raster.width).try_for_each(|row| write_row(row, writer))
    })
}

/// Numbers for missing cells; text has no NaN that every program reads.
const MARKS: [f64; 3] = [-9999.0, -99999.0, -1e30];

/// The key words before the no-data value.
fn header(raster: &Raster) -> Result<String, Fault> {
    let place = raster.georeference.as_ref().ok_or_else(|| {
        let advice = "give the raster a georeference, `Georeference::local` if it has no place";
        Fault::new("the raster has no georeference", "a corner and a cell size", advice)
    })?;
    let [width, height] = place.cell_size;
    if width != height {
        let problem = format!("the cells measure {width} x {height}");
        let advice = "resample the raster, or write a GeoTIFF";
        return Err(Fault::new(problem, "square cells", advice));
    }
    let south = south(place, raster.height);
    let (word, x, y) = match place.registration {
        Registration::Area => ("corner", place.west, south),
        Registration::Point => ("center", place.west + 0.5 * width, south + 0.5 * height),
    };
    Ok(format!(
        "ncols {}\nnrows {}\nxll{word} {}\nyll{word} {}\ncellsize {}\n",
        raster.width,
        raster.height,
        Text(x),
        Text(y),
        Text(width)
    ))
}

/// The southern edge with the fewest decimals that lead back to the same northern edge.
fn south(place: &Georeference, rows: usize) -> f64 {
    let extent = rows as f64 * place.cell_size[1];
    let exact = place.north - extent;
    let rounded = (0..16).filter_map(|decimals| format!("{exact:.decimals$}").parse().ok());
    rounded.into_iter().find(|south: &f64| south + extent == place.north).unwrap_or(exact)
}

fn write_row(row: &[f64], writer: &mut impl Write) -> io::Result<()> {
    for (column, &number) in row.iter().enumerate() {
        let separator = if column == 0 { "" } else { " " };
        write!(writer, "{separator}{}", Text(number))?;
    }
    writeln!(writer)
}

/// A number as the shortest text that is read back as the same number.
struct Text(f64);

impl fmt::Display for Text {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            0.0 | 1e-5..1e16 => write!(out, "{}", self.0),
            _ => write!(out, "{:e}", self.0),
        }
    }
}
