//! Files as bytes, grown, cut and reopened.

use std::fs;

use super::*;
use crate::scratch::Scratch;

fn layout() -> Layout {
    let axis = |name: &str, values: &[f64]| Axis {
        variable: Variable::new(name).text("units", "m"),
        values: values.to_vec(),
    };
    Layout {
        whole: Variable::new("").text("title", "tests").number("spacing_m", 2.0),
        record: Variable::new("iteration"),
        axes: vec![axis("y", &[3.0, 1.0]), axis("x", &[1.0, 3.0, 5.0])],
        system: None,
        fields: vec![Variable::new("bed").text("units", "m"), Variable::new("sand")],
    }
}

fn write(path: &Path, records: std::ops::Range<u32>) -> SeriesWriter {
    let mut writer = SeriesWriter::create(path, &layout(), IfExists::Replace).unwrap();
    add(&mut writer, records);
    writer
}

fn add(writer: &mut SeriesWriter, records: std::ops::Range<u32>) {
    for number in records {
        let bed = [f64::from(number); 6];
        let sand = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|value| value / f64::from(number + 1));
        writer.append(f64::from(10 * number), &[&bed, &sand]).unwrap();
    }
}

/// The header word by word, as the specification writes its example.
#[test]
fn the_header_is_that_of_the_specification() {
    let folder = Scratch::new("netcdf_header");
    let path = folder.path("a.nc");
    let small = Layout {
        whole: Variable::new(""),
        record: Variable::new("t"),
        axes: vec![Axis { variable: Variable::new("x"), values: vec![7.0] }],
        system: None,
        fields: vec![Variable::new("sand").text("units", "m")],
    };
    let mut writer = SeriesWriter::create(&path, &small, IfExists::Refuse).unwrap();
    writer.append(5.0, &[&[0.5]]).unwrap();
    let [x, t, sand] = ["x\0\0\0", "t\0\0\0", "sand"]
        .map(|name| u32::from_be_bytes(name.as_bytes().try_into().unwrap()));
    let units = [0x756e_6974, 0x7300_0000];
    let m = 0x6d00_0000;
    #[rustfmt::skip]
    let words = [
        0x4344_4602, 1,
        0x0A, 2, 1, t, 0, 1, x, 1,
        0, 0,
        0x0B, 3,
        1, x, 1, 1, 0, 0, 6, 8, 0, 204,
        1, t, 1, 0, 0, 0, 6, 8, 0, 212,
        4, sand, 2, 0, 1, 0x0C, 1, 5, units[0], units[1], 2, 1, m, 6, 8, 0, 220,
    ];
    let mut bytes: Vec<u8> = words.iter().flat_map(|word: &u32| word.to_be_bytes()).collect();
    bytes.extend([7.0_f64, 5.0, 0.5].iter().flat_map(|value| value.to_be_bytes()));
    assert_eq!(fs::read(&path).unwrap(), bytes);
}

#[test]
fn a_reopened_file_grows_into_the_same_bytes() {
    let folder = Scratch::new("netcdf_reopen");
    let (whole, broken) = (folder.path("whole.nc"), folder.path("broken.nc"));
    write(&whole, 0..6);
    let expected = fs::read(&whole).unwrap();
    for kept in 0..6 {
        write(&broken, 0..6);
        let mut writer =
            SeriesWriter::reopen(&broken, &layout(), f64::from(10 * kept) - 10.0).unwrap();
        assert_eq!(writer.records(), u64::from(kept));
        add(&mut writer, kept..6);
        assert_eq!(fs::read(&broken).unwrap(), expected);
    }
}

/// Whatever a kill leaves behind the counted records does not matter.
#[test]
fn a_record_that_was_not_counted_is_written_again() {
    let folder = Scratch::new("netcdf_torn");
    let (whole, torn) = (folder.path("whole.nc"), folder.path("torn.nc"));
    write(&whole, 0..3);
    write(&torn, 0..2);
    let mut file = OpenOptions::new().append(true).open(&torn).unwrap();
    file.write_all(&[7; 19]).unwrap();
    let mut writer = SeriesWriter::reopen(&torn, &layout(), 10.0).unwrap();
    add(&mut writer, 2..3);
    assert_eq!(fs::read(&torn).unwrap(), fs::read(&whole).unwrap());
}

#[test]
fn what_is_not_the_file_of_the_run_is_refused() {
    let folder = Scratch::new("netcdf_refused");
    let path = folder.path("a.nc");
    write(&path, 0..3);
    let bytes = fs::read(&path).unwrap();
    let refused =
        |layout: &Layout| SeriesWriter::reopen(&path, layout, 1e9).unwrap_err().to_string();
    for length in 0..bytes.len() {
        fs::write(&path, &bytes[..length]).unwrap();
        let message = refused(&layout());
        assert!(message.contains("another layout") || message.contains("cut short"), "{message}");
    }
    fs::write(&path, &bytes).unwrap();
    let other = Layout { whole: Variable::new("").text("title", "other"), ..layout() };
    assert!(refused(&other).contains("another layout"));
    fs::remove_file(&path).unwrap();
    assert!(refused(&layout()).contains("check the spelling"));
}

#[test]
fn names_sizes_and_slices_are_checked() {
    let folder = Scratch::new("netcdf_checked");
    let path = folder.path("a.nc");
    let refused = |change: &dyn Fn(&mut Layout)| {
        let mut layout = layout();
        change(&mut layout);
        let result = SeriesWriter::create(&path, &layout, IfExists::Replace);
        result.unwrap_err().to_string()
    };
    assert!(refused(&|layout| layout.fields[0].name = "a/b".into()).contains("\"a/b\""));
    assert!(refused(&|layout| layout.fields[0].name = "x".into()).contains("two variables"));
    assert!(refused(&|layout| layout.fields[0].name.clear()).contains("called \"\""));
    assert!(refused(&|layout| layout.axes[0].values.clear()).contains("without nodes"));
    assert_eq!(folder.file_count(), 0);

    let mut writer = write(&path, 0..1);
    let short = writer.append(10.0, &[&[0.0; 6], &[0.0; 5]]).unwrap_err().to_string();
    assert!(short.contains("a field of 5 nodes; expected 6"), "{short}");
    let few = writer.append(10.0, &[&[0.0; 6]]).unwrap_err().to_string();
    assert!(few.contains("1 fields; expected 2"), "{few}");
    assert_eq!(writer.records(), 1);
}
