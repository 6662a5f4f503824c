//! Files that are cut off anywhere are refused. Files that are altered at random: see
//! `tests/tests/damaged_input.rs`.

#[expect(dead_code, reason = "not every test counts files")]
mod support;

use std::fs;

use landform_io::geotiff::{self, Options};
use landform_io::{
    IfExists, Metadata, Raster, ReadLimits, SampleType, npy, read_raster, read_raster_file,
    write_raster,
};
use support::Scratch;

/// Small enough that no accepted lie about the size takes much memory.
const LIMITS: ReadLimits = ReadLimits { max_cells: 1 << 20 };

/// Valid files of every format and sample type.
fn valid_files() -> Vec<(String, Vec<u8>)> {
    let folder = Scratch::new("valid");
    let values = (0..40 * 30).map(|cell| f64::from(cell * 37 % 1000)).collect();
    let raster = Raster::local(40, 30, 5.0, values);
    let metadata = Metadata { seed: Some(7), ..Metadata::default() };
    for name in ["f64.tif", "f64.asc", "f64.npy"] {
        write_raster(folder.path(name), &raster, &metadata, IfExists::Replace).unwrap();
    }
    for (name, sample) in [("f32.tif", SampleType::F32), ("i16.tif", SampleType::I16)] {
        let options = Options { sample, ..Options::default() };
        let path = folder.path(name);
        geotiff::write(&path, &raster, &metadata, &options, IfExists::Replace).unwrap();
    }
    let path = folder.path("i16.npy");
    npy::write(&path, &raster, &metadata, SampleType::I16, IfExists::Replace).unwrap();
    let own = ["f64.tif", "f32.tif", "i16.tif", "f64.asc", "f64.npy", "i16.npy"];
    own.map(|name| (name.to_string(), fs::read(folder.path(name)).unwrap())).into()
}

/// Every prefix of a file is refused, but for blanks at the end of a text.
#[test]
fn every_cut_is_noticed() {
    let folder = Scratch::new("cuts");
    for (name, bytes) in &valid_files() {
        let path = folder.path(name);
        let end = bytes.trim_ascii_end().len();
        let step = (end / 200).max(1);
        // The last digits of a text may be cut without notice, so two bytes are spared.
        for length in (0..end.saturating_sub(4)).step_by(step) {
            fs::write(&path, &bytes[..length]).unwrap();
            let message = match read_raster_file(&path, &LIMITS) {
                Ok(_) => panic!("{name} cut to {length} of {} bytes was read", bytes.len()),
                Err(error) => error.to_string(),
            };
            assert!(message.contains(name.as_str()), "{message}");
        }
    }
}

/// A file of each kind without any alteration: the starting points above are valid.
#[test]
fn unaltered_files_are_read() {
    let folder = Scratch::new("unaltered");
    for (name, bytes) in &valid_files() {
        fs::write(folder.path(name), bytes).unwrap();
        assert_eq!(read_raster(folder.path(name)).unwrap().size(), [40, 30], "{name}");
    }
}
