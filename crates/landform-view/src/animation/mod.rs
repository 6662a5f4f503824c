//! Animations: frames written to a file as they come.

mod apng;
mod gif_file;
mod part;

use std::io;
use std::path::{Path, PathBuf};

use crate::atomic_file::write_error;
use crate::{Image, ViewError};
use part::{Part, PartMark};

/// An animation that is being written: `.png` and `.apng` files keep every colour (APNG), `.gif`
/// files have 256 colours a frame.
///
/// Frames go to a file of their own one by one, so memory holds one frame at most; the animation
/// appears in its place with [`Animation::finish`]. Dropped before that, it leaves nothing
/// behind, unless [`Animation::mark`] was asked for something to [go on](Animation::resume)
/// from.
///
/// ```
/// use landform_view::Image;
/// use landform_view::animation::Animation;
///
/// let path = std::env::temp_dir().join(format!("landform-doc-{}.gif", std::process::id()));
/// let mut animation = Animation::create(&path, &path.with_extension("part"), 100, &[("seed", "7")])?;
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
    part: PathBuf,
    format: Format,
    delay_ms: u32,
    text: Vec<(String, String)>,
    size: [usize; 2],
    frames: usize,
    file: Option<Part>,
}

/// How far an animation was: what it takes to go on later.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mark {
    /// Number of frames.
    pub frames: usize,
    /// Columns and rows of each frame.
    pub size: [usize; 2],
    /// Bytes of the file with the frames.
    pub length: u64,
    /// Checksum (CRC-32) of that file.
    pub checksum: u32,
}

#[derive(Clone, Copy, Debug)]
enum Format {
    Apng,
    Gif,
}

impl Animation {
    /// An animation without frames that repeats for ever; each frame stays `delay_ms`
    /// milliseconds (GIF rounds to hundredths of a second). `text` holds `(keyword, text)`
    /// entries as of [`Image::write_png`]. Frames are collected in the file `part`, on the
    /// same disk as `path`, which is made with the first one.
    ///
    /// # Errors
    /// [`ViewError::UnknownFormat`] for other endings, [`ViewError::Option`] for delays above
    /// a minute.
    pub fn create(
        path: &Path,
        part: &Path,
        delay_ms: u32,
        text: &[(&str, &str)],
    ) -> Result<Self, ViewError> {
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
        let (path, part) = (path.into(), part.into());
        Ok(Self { path, part, format, delay_ms, text, size: [0; 2], frames: 0, file: None })
    }

    /// Takes an animation that was just created to where another one, with the same arguments,
    /// was [marked](Animation::mark). Frames that came after the mark are cut off.
    ///
    /// # Errors
    /// [`ViewError::File`] when the frames are missing or have changed.
    pub fn resume(&mut self, mark: Mark) -> Result<(), ViewError> {
        let Mark { frames, size, length, checksum } = mark;
        if frames > 0 {
            let part = Part::reopen(&self.part, PartMark { length, checksum });
            let read_error =
                |source| ViewError::File { action: "read", path: self.part.clone(), source };
            self.file = Some(part.map_err(read_error)?);
        }
        (self.frames, self.size) = (frames, size);
        Ok(())
    }

    /// Brings the frames so far to the disk and says how far the animation is. From now on the
    /// file with the frames stays, even beyond [`Animation::finish`].
    ///
    /// # Errors
    /// [`ViewError::File`] when it cannot be written.
    pub fn mark(&mut self) -> Result<Mark, ViewError> {
        let Some(file) = &mut self.file else { return Ok(Mark::default()) };
        let PartMark { length, checksum } =
            file.mark().map_err(|source| write_error(&self.part, source))?;
        Ok(Mark { frames: self.frames, size: self.size, length, checksum })
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
        let mut bytes = if self.frames == 0 { self.beginning(frame)? } else { Vec::new() };
        bytes.extend(self.chunks_of(frame)?);
        let written = match &mut self.file {
            Some(file) => file.append(&bytes),
            None => self.open().and_then(|file| file.append(&bytes)),
        };
        written.map_err(|source| write_error(&self.path, source))?;
        self.frames += 1;
        Ok(())
    }

    fn open(&mut self) -> io::Result<&mut Part> {
        Ok(self.file.insert(Part::create(&self.part)?))
    }

    /// What the file begins with.
    fn beginning(&self, first: &Image) -> Result<Vec<u8>, ViewError> {
        let text: Vec<(&str, &str)> =
            self.text.iter().map(|(keyword, entry)| (keyword.as_str(), entry.as_str())).collect();
        match self.format {
            Format::Apng => {
                apng::beginning(first, &text).map_err(|e| ViewError::format(&self.path, e))
            }
            Format::Gif => gif_file::beginning(gif_file::size_of(self.size)?, &text)
                .map_err(|e| ViewError::format(&self.path, e)),
        }
    }

    /// The next frame as it stands in the file.
    fn chunks_of(&self, frame: &Image) -> Result<Vec<u8>, ViewError> {
        match self.format {
            Format::Apng => apng::frame(frame, self.frames, self.delay_ms)
                .map_err(|e| ViewError::format(&self.path, e)),
            Format::Gif => gif_file::frame(frame, gif_file::size_of(self.size)?, self.delay_ms)
                .map_err(|e| ViewError::format(&self.path, e)),
        }
    }

    /// Ends the file and puts it in its place.
    ///
    /// # Errors
    /// [`ViewError::NoFrames`] without a frame, [`ViewError::File`] when it cannot be written.
    pub fn finish(self) -> Result<(), ViewError> {
        let Some(file) = self.file else { return Err(ViewError::NoFrames { path: self.path }) };
        let (changes, end) = match self.format {
            Format::Apng => {
                (vec![(apng::COUNT_PLACE, apng::count_chunk(self.frames))], apng::end())
            }
            Format::Gif => (Vec::new(), vec![gif_file::END]),
        };
        file.finish(&self.path, &changes, &end).map_err(|source| write_error(&self.path, source))
    }
}
