//! Pictures and animations as files: written whole, read back, refused with a reason.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use landform_view::animation::Animation;
use landform_view::{Image, ViewError};

/// An empty folder for one test, removed with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("landform-view-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn gradient(shift: usize) -> Image {
    let mut image = Image::filled(40, 30, [0; 3]).unwrap();
    for (index, pixel) in image.rgb.iter_mut().enumerate() {
        *pixel = [((index + shift) % 40 * 6) as u8, (index / 40 * 8) as u8, 90];
    }
    image
}

#[test]
fn png_files_keep_pixels_and_text() {
    let folder = Folder::new("png");
    let path = folder.0.join("picture.png");
    gradient(0).write_png(&path, &[("seed", "7"), ("Title", "größer als β")]).unwrap();
    let (image, text) = Image::read_png(&path).unwrap();
    assert_eq!(image, gradient(0));
    assert!(text.contains(&("seed".into(), "7".into())), "{text:?}");
    assert!(text.contains(&("Title".into(), "größer als β".into())), "{text:?}");
    assert_eq!(folder.files(), ["picture.png"]);
}

#[test]
fn files_that_cannot_be_written_are_refused_and_leave_nothing() {
    let folder = Folder::new("refused");
    let missing = folder.0.join("no/such/folder/picture.png");
    let error = gradient(0).write_png(&missing, &[]).unwrap_err();
    assert!(matches!(error, ViewError::File { .. }), "{error}");
    assert!(error.to_string().contains("picture.png"), "{error}");
    let error = gradient(0).write_png(&folder.0.join("x.png"), &[("", "no keyword")]).unwrap_err();
    assert!(matches!(error, ViewError::Format { .. }), "{error}");
    let mut broken = gradient(0);
    broken.rgb.pop();
    let error = broken.write_png(&folder.0.join("y.png"), &[]).unwrap_err();
    assert!(matches!(error, ViewError::Length { found: 1199, .. }), "{error}");
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

#[test]
fn files_that_are_no_pictures_are_refused() {
    let folder = Folder::new("unreadable");
    let path = folder.0.join("text.png");
    fs::write(&path, "not a picture").unwrap();
    assert!(matches!(Image::read_png(&path), Err(ViewError::Format { .. })));
    assert!(matches!(
        Image::read_png(&folder.0),
        Err(ViewError::File { .. } | ViewError::Format { .. })
    ));
}

/// An animation whose frames are collected beside it.
fn create(path: &Path, delay_ms: u32, text: &[(&str, &str)]) -> Result<Animation, ViewError> {
    Animation::create(path, &path.with_extension("part"), delay_ms, text)
}

fn animate(path: &Path, frames: usize) {
    let mut animation = create(path, 80, &[("seed", "7")]).unwrap();
    for shift in 0..frames {
        animation.add(&gradient(shift)).unwrap();
    }
    assert_eq!(animation.frames(), frames);
    animation.finish().unwrap();
}

#[test]
fn apng_files_hold_every_frame_as_it_was() {
    let folder = Folder::new("apng");
    let path = folder.0.join("run.apng");
    animate(&path, 5);
    let file = std::io::BufReader::new(File::open(&path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 5);
    for shift in 0..5 {
        let mut frame = gradient(0);
        reader.next_frame(frame.rgb.as_flattened_mut()).unwrap();
        assert_eq!(frame, gradient(shift), "frame {shift}");
        let control = reader.info().frame_control().unwrap();
        assert_eq!((control.delay_num, control.delay_den), (80, 1000));
    }
    assert_eq!(folder.files(), ["run.apng"]);
}

#[test]
fn gif_files_hold_every_frame() {
    let folder = Folder::new("gif");
    let path = folder.0.join("run.gif");
    animate(&path, 4);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = options.read_info(File::open(&path).unwrap()).unwrap();
    assert_eq!((reader.width(), reader.height()), (40, 30));
    let mut frames = 0;
    while let Some(frame) = reader.read_next_frame().unwrap() {
        assert_eq!(frame.delay, 8);
        // 1200 colours became 256, so only the mean difference has to be small.
        let pixels = frame.buffer.chunks(4).zip(gradient(frames).rgb);
        let off = pixels.flat_map(|(pixel, own)| [0, 1, 2].map(|i| pixel[i].abs_diff(own[i])));
        let mean = off.map(f64::from).sum::<f64>() / 3600.0;
        assert!(mean < 6.0, "frame {frames} is {mean} off");
        frames += 1;
    }
    assert_eq!(frames, 4);
}

#[test]
fn unfinished_animations_leave_nothing() {
    let folder = Folder::new("unfinished");
    for name in ["run.png", "run.gif"] {
        let mut animation = create(&folder.0.join(name), 80, &[]).unwrap();
        animation.add(&gradient(0)).unwrap();
        assert_eq!(folder.files().len(), 1, "the temporary file");
        drop(animation);
        let empty = create(&folder.0.join(name), 80, &[]).unwrap();
        assert!(matches!(empty.finish(), Err(ViewError::NoFrames { .. })));
    }
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}

#[test]
fn wrong_frames_and_formats_are_refused() {
    let folder = Folder::new("frames");
    let error = create(&folder.0.join("run.mp4"), 80, &[]).unwrap_err();
    assert!(error.to_string().contains(".gif"), "{error}");
    let mut animation = create(&folder.0.join("run.gif"), 80, &[]).unwrap();
    animation.add(&gradient(0)).unwrap();
    let other = Image::filled(41, 30, [0; 3]).unwrap();
    let error = animation.add(&other).unwrap_err();
    assert!(matches!(error, ViewError::FrameSize { frame: 1, found: [41, 30], .. }), "{error}");
    animation.add(&gradient(1)).unwrap();
    animation.finish().unwrap();
    let wide = Image::filled(70_000, 1, [0; 3]).unwrap();
    let mut animation = create(&folder.0.join("wide.gif"), 80, &[]).unwrap();
    assert!(matches!(animation.add(&wide), Err(ViewError::TooLarge { .. })));
}

/// The end of a run that was killed comes from a mark, and the bytes are those of an unbroken run.
#[test]
fn an_animation_goes_on_from_a_mark_with_the_same_bytes() {
    for name in ["run.apng", "run.gif"] {
        let folder = Folder::new("resume");
        let whole = folder.0.join(format!("whole_{name}"));
        animate(&whole, 5);
        let path = folder.0.join(name);
        let mut first = create(&path, 80, &[("seed", "7")]).unwrap();
        first.add(&gradient(0)).unwrap();
        first.add(&gradient(1)).unwrap();
        let mark = first.mark().unwrap();
        first.add(&gradient(9)).unwrap();
        drop(first);
        // Once more, since a resumed run may be killed after it has finished its files.
        for _ in 0..2 {
            let mut second = create(&path, 80, &[("seed", "7")]).unwrap();
            second.resume(mark).unwrap();
            (2..5).for_each(|shift| second.add(&gradient(shift)).unwrap());
            second.finish().unwrap();
            assert!(fs::read(&path).unwrap() == fs::read(&whole).unwrap(), "{name}");
        }
        let part = path.with_extension("part");
        let mut bytes = fs::read(&part).unwrap();
        bytes[50] ^= 1;
        fs::write(&part, &bytes).unwrap();
        let error = create(&path, 80, &[]).unwrap().resume(mark).unwrap_err();
        assert!(error.to_string().contains("changed"), "{error}");
        fs::write(&part, &bytes[..50]).unwrap();
        assert!(create(&path, 80, &[]).unwrap().resume(mark).is_err());
    }
}
