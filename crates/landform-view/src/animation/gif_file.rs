//! Animations as GIF.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use gif::{AnyExtension, Encoder, Frame, Repeat};

use crate::atomic_file::{AtomicFile, write_error};
use crate::{Image, ViewError};

/// About how many pixels of a frame its palette is learnt from.
const PALETTE_SAMPLE: usize = 60_000;

/// Label of a comment block (GIF89a specification, section 24).
const COMMENT: AnyExtension = AnyExtension(0xFE);

/// A GIF file that is being written.
pub(super) struct GifFile {
    guard: AtomicFile,
    encoder: Encoder<BufWriter<File>>,
    size: [u16; 2],
    delay: u16,
}

impl GifFile {
    /// Opens the file; `text` becomes comments.
    pub(super) fn create(
        path: &Path,
        size: [usize; 2],
        delay_ms: u32,
        text: &[(&str, &str)],
    ) -> Result<Self, ViewError> {
        let [Ok(width), Ok(height)] = size.map(u16::try_from) else {
            let (what, [width, height]) = ("a GIF frame", size);
            return Err(ViewError::TooLarge { what, width, height });
        };
        let (guard, file) = AtomicFile::create(path)?;
        let problem = |error| ViewError::format(path, error);
        let mut encoder = Encoder::new(file, width, height, &[]).map_err(problem)?;
        encoder.set_repeat(Repeat::Infinite).map_err(problem)?;
        for (keyword, entry) in text {
            let comment = format!("{keyword}: {entry}");
            let blocks: Vec<&[u8]> = comment.as_bytes().chunks(255).collect();
            encoder.write_raw_extension(COMMENT, &blocks).map_err(problem)?;
        }
        let delay = ((delay_ms + 5) / 10) as u16;
        Ok(Self { guard, encoder, size: [width, height], delay })
    }

    /// Writes a frame of the size of the file with a palette of its own.
    pub(super) fn add(&mut self, image: &Image) -> Result<(), ViewError> {
        let [width, height] = self.size;
        let pixels = image.rgb.as_flattened();
        // Every so many pixels count; the encoder allows up to every thirtieth.
        let every = (image.rgb.len() / PALETTE_SAMPLE).clamp(1, 30) as i32;
        let mut frame = Frame::from_rgb_speed(width, height, pixels, every);
        frame.delay = self.delay;
        let problem = |error| ViewError::format(self.guard.target(), error);
        self.encoder.write_frame(&frame).map_err(problem)
    }

    /// Ends the file and puts it in its place.
    pub(super) fn finish(self) -> Result<(), ViewError> {
        let problem = |error| ViewError::format(self.guard.target(), error);
        let mut file = self.encoder.into_inner().map_err(problem)?;
        file.flush().map_err(|error| write_error(self.guard.target(), error))?;
        self.guard.finish()
    }
}

impl std::fmt::Debug for GifFile {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("GifFile").field("guard", &self.guard).finish_non_exhaustive()
    }
}
