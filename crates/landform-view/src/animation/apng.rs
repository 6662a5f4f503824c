//! Animations as APNG (PNG specification, third edition, section 11.3.6).

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use crate::atomic_file::{AtomicFile, write_error};
use crate::image::configure;
use crate::{Image, ViewError};

/// Number of frames in the file's head until the true one is known.
const UNKNOWN_FRAMES: u32 = u32::MAX;

/// An APNG file that is being written.
pub(super) struct Apng {
    guard: AtomicFile,
    writer: png::Writer<BufWriter<File>>,
}

impl Apng {
    /// Opens the file; `text` as of [`Image::write_png`].
    pub(super) fn create(
        path: &Path,
        [width, height]: [usize; 2],
        delay_ms: u32,
        text: &[(&str, &str)],
    ) -> Result<Self, ViewError> {
        let (guard, file) = AtomicFile::create(path)?;
        let problem = |error| ViewError::format(path, error);
        let mut encoder = png::Encoder::new(file, width as u32, height as u32);
        configure(&mut encoder, text).map_err(problem)?;
        encoder.set_animated(UNKNOWN_FRAMES, 0).map_err(problem)?;
        encoder.set_frame_delay(delay_ms as u16, 1000).map_err(problem)?;
        let writer = encoder.write_header().map_err(problem)?;
        Ok(Self { guard, writer })
    }

    /// Writes a frame of the size of the file.
    pub(super) fn add(&mut self, image: &Image) -> Result<(), ViewError> {
        self.writer
            .write_image_data(image.rgb.as_flattened())
            .map_err(|error| ViewError::format(self.guard.target(), error))
    }

    /// Ends the file; the number of frames is known only now and goes into its head.
    pub(super) fn finish(self, frames: usize) -> Result<(), ViewError> {
        let target = self.guard.target();
        self.writer.finish().map_err(|error| ViewError::format(target, error))?;
        write_frame_count(self.guard.temporary(), frames as u32)
            .map_err(|error| write_error(target, error))?;
        self.guard.finish()
    }
}

impl std::fmt::Debug for Apng {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Apng").field("guard", &self.guard).finish_non_exhaustive()
    }
}

/// Puts the number of frames into the `acTL` chunk of a file.
fn write_frame_count(path: &Path, frames: u32) -> io::Result<()> {
    let mut file = OpenOptions::new().read(true).write(true).open(path)?;
    // Chunks follow the eight bytes of the signature: length, name, contents, checksum.
    let mut start = 8;
    loop {
        let mut head = [0; 8];
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(&mut head)?;
        if head.ends_with(b"acTL") {
            break;
        }
        let [a, b, c, d, ..] = head;
        start += 12 + u64::from(u32::from_be_bytes([a, b, c, d]));
    }
    // Frame count and number of plays; 0 plays for ever.
    let mut chunk = *b"acTL\0\0\0\0\0\0\0\0";
    chunk[4..8].copy_from_slice(&frames.to_be_bytes());
    file.seek(SeekFrom::Start(start + 4))?;
    file.write_all(&chunk)?;
    file.write_all(&checksum(&chunk).to_be_bytes())?;
    file.sync_all()
}

/// CRC-32 of a chunk's name and contents (PNG specification, annex D).
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            (sum >> 1) ^ (0xEDB8_8320 & (sum & 1).wrapping_neg())
        })
    })
}
