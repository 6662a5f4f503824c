//! Files that are cut off or altered at random give an error or a raster, never a panic.

#[expect(dead_code, reason = "not every test counts files")]
mod support;

use std::fs;
use std::path::Path;

use landform_io::geotiff::{self, Options};
use landform_io::{
    IfExists, Metadata, Raster, ReadLimits, SampleType, npy, read_raster, read_raster_file,
    write_raster,
};
use proptest::prelude::*;
use support::Scratch;

/// Small enough that no accepted lie about the size takes much memory.
const LIMITS: ReadLimits = ReadLimits { max_cells: 1 << 20 };

/// Valid files of every format and sample type, and those of other programs.
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
    let own = own.map(|name| (name.to_string(), fs::read(folder.path(name)).unwrap()));
    let foreign = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign");
    let mut foreign: Vec<_> = fs::read_dir(foreign).unwrap().map(|entry| entry.unwrap()).collect();
    foreign.sort_by_key(|entry| entry.file_name());
    let foreign = foreign
        .into_iter()
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()));
    own.into_iter().chain(foreign).collect()
}

/// Every prefix of a file is refused, but for blanks at the end of a text.
#[test]
fn every_cut_is_noticed() {
    let folder = Scratch::new("cuts");
    for (name, bytes) in &valid_files()[..6] {
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn altered_bytes_never_panic(
        file in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        near_start in any::<bool>(),
        cut in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        thread_local!(static VALID: Vec<(String, Vec<u8>)> = valid_files());
        let (name, mut bytes) = VALID.with(|files| file.get(files).clone());
        // Headers and directories are where alterations hurt.
        let range = if near_start { bytes.len().min(400) } else { bytes.len() };
        for (place, byte) in changes {
            bytes[place.index(range)] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        let folder = Scratch::new("altered");
        let path = folder.path(&name);
        fs::write(&path, &bytes).unwrap();
        if let Ok(file) = read_raster_file(&path, &LIMITS) {
            prop_assert_eq!(file.raster.values.len(), file.raster.width * file.raster.height);
            prop_assert!(file.raster.values.iter().all(|value| !value.is_infinite()));
        }
    }
}

/// A file of each kind without any alteration: the starting points above are valid.
#[test]
fn unaltered_files_are_read() {
    let folder = Scratch::new("unaltered");
    for (name, bytes) in &valid_files()[..6] {
        fs::write(folder.path(name), bytes).unwrap();
        assert_eq!(read_raster(folder.path(name)).unwrap().size(), [40, 30], "{name}");
    }
}
