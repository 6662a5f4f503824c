//! Animations: frames written to a file as they come.

mod apng;
mod gif_file;

use std::path::{Path, PathBuf};

use crate::{Image, ViewError};
use apng::Apng;
use gif_file::GifFile;

/// An animation that is being written: `.png` and `.apng` files keep every colour (APNG), `.gif`
/// files have 256 colours a frame.
///
/// Frames go to a temporary file one by one, so memory holds one frame at most; the file appears
/// in its place with [`Animation::finish`]. Dropped before that, it leaves nothing behind.
///
/// ```
/// use landform_view::Image;
/// use landform_view::animation::Animation;
///
/// let path = std::env::temp_dir().join(format!("landform-doc-{}.gif", std::process::id()));
/// let mut animation = Animation::create(&path, 100, &[("seed", "7")])?;
/// for grey in [40, 120, 200] {
///     animation.add(&Image::filled(64, 48, [grey; 3])?)?;
/// }
/// assert_eq!(animation.frames(), 3);
/// animation.finish()?;
/// # let _ = std::fs::remove_file(&path);
/// # Ok::<(), landform_view::ViewError>(())
/// ```
#[derive(Debug)]
pub struct Animation {
    path: PathBuf,
    format: Format,
    delay_ms: u32,
    text: Vec<(String, String)>,
    size: [usize; 2],
    frames: usize,
    file: Option<Encoder>,
}

#[derive(Clone, Copy, Debug)]
enum Format {
    Apng,
    Gif,
}

#[derive(Debug)]
enum Encoder {
    Apng(Apng),
    Gif(GifFile),
}

impl Animation {
    /// An animation without frames that repeats for ever; each frame stays `delay_ms`
    /// milliseconds (GIF rounds to hundredths of a second). `text` holds `(keyword, text)`
    /// entries as of [`Image::write_png`]. The file is opened with the first frame.
    ///
    /// # Errors
    /// [`ViewError::UnknownFormat`] for other endings, [`ViewError::Option`] for delays above
    /// a minute.
    pub fn create(path: &Path, delay_ms: u32, text: &[(&str, &str)]) -> Result<Self, ViewError> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let format = match ending.to_ascii_lowercase().as_str() {
            "png" | "apng" => Format::Apng,
            "gif" => Format::Gif,
            _ => {
                let expected = ".png, .apng or .gif";
                return Err(ViewError::UnknownFormat { path: path.into(), expected });
            }
        };
        let range = [0.0, 60_000.0];
        ViewError::check_option("delay_ms", delay_ms.into(), range, "from 0 to 60000")?;
        let text = text.iter().map(|&(keyword, entry)| (keyword.into(), entry.into())).collect();
        Ok(Self { path: path.into(), format, delay_ms, text, size: [0; 2], frames: 0, file: None })
    }

    /// Number of frames so far.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Writes a frame.
    ///
    /// # Errors
    /// [`ViewError::FrameSize`] when it is not as large as the first one, [`ViewError::File`] and
    /// [`ViewError::Format`] when it cannot be written.
    pub fn add(&mut self, frame: &Image) -> Result<(), ViewError> {
        frame.check()?;
        let found = [frame.width, frame.height];
        if self.frames > 0 && found != self.size {
            return Err(ViewError::FrameSize { frame: self.frames, found, expected: self.size });
        }
        self.size = found;
        if self.file.is_none() {
            self.file = Some(self.open()?);
        }
        match &mut self.file {
            Some(Encoder::Apng(file)) => file.add(frame)?,
            Some(Encoder::Gif(file)) => file.add(frame)?,
            None => {}
        }
        self.frames += 1;
        Ok(())
    }

    /// Opens the file for frames of the size of the first one.
    fn open(&self) -> Result<Encoder, ViewError> {
        let text: Vec<(&str, &str)> =
            self.text.iter().map(|(keyword, entry)| (keyword.as_str(), entry.as_str())).collect();
        Ok(match self.format {
            Format::Apng => {
                Encoder::Apng(Apng::create(&self.path, self.size, self.delay_ms, &text)?)
            }
            Format::Gif => {
                Encoder::Gif(GifFile::create(&self.path, self.size, self.delay_ms, &text)?)
            }
        })
    }

    /// Ends the file and puts it in its place.
    ///
    /// # Errors
    /// [`ViewError::NoFrames`] without a frame, [`ViewError::File`] and [`ViewError::Format`]
    /// when it cannot be written.
    pub fn finish(self) -> Result<(), ViewError> {
        match self.file {
            Some(Encoder::Apng(file)) => file.finish(self.frames),
            Some(Encoder::Gif(file)) => file.finish(),
            None => Err(ViewError::NoFrames { path: self.path }),
        }
    }
}
