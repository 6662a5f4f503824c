//! Reads and writes one raster in every format and prints megabytes of cells (8 bytes each) a
//! second: `cargo run --release -p landform-io --example timing -- RASTER FOLDER`.

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use landform_io::{IfExists, Metadata, Raster, read_raster, write_raster};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(path), Some(folder)) = (arguments.next(), arguments.next()) else {
        return Err("name a raster and a folder".into());
    };
    let raster = timed("read", &path, || Ok(read_raster(&path)?))?;
    println!("{} x {} cells", raster.width, raster.height);
    for name in ["timing.tif", "timing.asc", "timing.npy", "timing.raw", "timing.png"] {
        let path = folder.join(name);
        timed("write", &path, || {
            write_raster(&path, &raster, &Metadata::default(), IfExists::Replace)?;
            Ok(raster.clone())
        })?;
        if !matches!(name, "timing.raw" | "timing.png") {
            timed("read", &path, || Ok(read_raster(&path)?))?;
        }
    }
    Ok(())
}

/// Runs `work` and prints its speed, and the size of the file.
fn timed(
    what: &str,
    path: &PathBuf,
    work: impl FnOnce() -> Result<Raster, Box<dyn Error>>,
) -> Result<Raster, Box<dyn Error>> {
    let start = Instant::now();
    let raster = work()?;
    let seconds = start.elapsed().as_secs_f64();
    let cells = raster.values.len() as f64 * 8e-6 / seconds;
    let file = std::fs::metadata(path)?.len() as f64 * 1e-6 / seconds;
    println!("{what:5} {}: {cells:.0} MB/s of cells, {file:.0} MB/s of file", path.display());
    Ok(raster)
}
