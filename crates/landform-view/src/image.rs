//! Pictures in memory and PNG files.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use crate::ViewError;
use crate::atomic_file::AtomicFile;

/// A picture of 8-bit sRGB colours, row by row from the top left pixel.
///
/// The fields are open for callers who draw on a picture; functions that take one check that the
/// number of colours fits the size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Colours: red, green, blue; `width * height` of them.
    pub rgb: Vec<[u8; 3]>,
}

impl Image {
    /// A picture of one colour.
    ///
    /// # Errors
    /// [`ViewError::TooSmall`] or [`ViewError::TooLarge`] for sizes that no picture can have.
    pub fn filled(width: usize, height: usize, colour: [u8; 3]) -> Result<Self, ViewError> {
        ViewError::check_size("a picture", [width, height], 1)?;
        Ok(Self { width, height, rgb: vec![colour; width * height] })
    }

    /// Colour of the pixel at a column and a row, which must lie in the picture.
    pub fn pixel(&self, column: usize, row: usize) -> [u8; 3] {
        self.rgb[column + self.width * row]
    }

    /// Copies `other` with its top left corner at a column and a row; what lies outside is cut.
    pub fn paste(&mut self, other: &Self, column: usize, row: usize) {
        let width = other.width.min(self.width.saturating_sub(column));
        let height = other.height.min(self.height.saturating_sub(row));
        for line in 0..height {
            let to = column + self.width * (row + line);
            let from = other.width * line;
            self.rgb[to..to + width].copy_from_slice(&other.rgb[from..from + width]);
        }
    }

    /// The picture at most `width` pixels wide, each of them the mean of the pixels that it
    /// replaces; as it is where it is not wider.
    #[must_use]
    pub fn shrunk(&self, width: usize) -> Self {
        let width = width.max(1);
        if self.width <= width {
            return self.clone();
        }
        let height = (self.height * width / self.width).max(1);
        let part =
            |index: usize, of: usize, size: usize| index * size / of..(index + 1) * size / of;
        let mut rgb = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let (mut sum, mut count) = ([0_u64; 3], 0);
                for y in part(row, height, self.height) {
                    for x in part(column, width, self.width) {
                        let pixel = self.pixel(x, y);
                        sum = [0, 1, 2].map(|channel| sum[channel] + u64::from(pixel[channel]));
                        count += 1;
                    }
                }
                rgb.push(sum.map(|sum| (sum / count) as u8));
            }
        }
        Self { width, height, rgb }
    }

    /// Checks that the number of colours fits the size.
    pub(crate) fn check(&self) -> Result<(), ViewError> {
        ViewError::check_size("a picture", [self.width, self.height], 1)?;
        if self.rgb.len() == self.width * self.height {
            return Ok(());
        }
        let (width, height) = (self.width, self.height);
        Err(ViewError::Length { what: "a picture", found: self.rgb.len(), width, height })
    }

    /// Writes a PNG file with text entries, `(keyword, text)` such as `("seed", "7")`. The file
    /// is written beside its place and renamed, so it is there whole or not at all.
    ///
    /// # Errors
    /// [`ViewError::File`] when the file cannot be written; [`ViewError::Format`] for keywords
    /// that PNG forbids (empty, above 79 bytes or not Latin-1).
    pub fn write_png(&self, path: &Path, text: &[(&str, &str)]) -> Result<(), ViewError> {
        self.check()?;
        let (guard, file) = AtomicFile::create(path)?;
        self.encode_png(file, text).map_err(|error| ViewError::format(path, error))?;
        guard.finish()
    }

    /// Writes the bytes of a PNG file.
    pub(crate) fn encode_png(
        &self,
        to: impl std::io::Write,
        text: &[(&str, &str)],
    ) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(to, self.width as u32, self.height as u32);
        configure(&mut encoder, text)?;
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.rgb.as_flattened())?;
        writer.finish()
    }

    /// Reads an 8-bit colour PNG file and its text entries.
    ///
    /// # Errors
    /// [`ViewError::File`] when it cannot be read, [`ViewError::Format`] when it is no such file.
    pub fn read_png(path: &Path) -> Result<(Self, Vec<(String, String)>), ViewError> {
        let read_error = |source| ViewError::File { action: "read", path: path.into(), source };
        let file = BufReader::new(File::open(path).map_err(read_error)?);
        let mut reader =
            png::Decoder::new(file).read_info().map_err(|e| ViewError::format(path, e))?;
        let info = reader.info();
        let (width, height) = (info.width as usize, info.height as usize);
        ViewError::check_size("the picture in the file", [width, height], 1)?;
        let text = info
            .utf8_text
            .iter()
            .filter_map(|entry| Some((entry.keyword.clone(), entry.get_text().ok()?)));
        let latin = info.uncompressed_latin1_text.iter();
        let latin = latin.map(|entry| (entry.keyword.clone(), entry.text.clone()));
        let text = latin.chain(text).collect();
        if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
            return Err(ViewError::format(path, "not a PNG of 8-bit red, green and blue"));
        }
        let mut rgb = vec![[0; 3]; width * height];
        reader
            .next_frame(rgb.as_flattened_mut())
            .map_err(|error| ViewError::format(path, error))?;
        Ok((Self { width, height, rgb }, text))
    }
}

/// Sets colour type, compression and text entries of a PNG file.
pub(crate) fn configure<W: std::io::Write>(
    encoder: &mut png::Encoder<'_, W>,
    text: &[(&str, &str)],
) -> Result<(), png::EncodingError> {
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::Balanced);
    for &(keyword, entry) in text {
        match entry.chars().all(|letter| letter as u32 <= 0xFF) {
            true => encoder.add_text_chunk(keyword.into(), entry.into())?,
            false => encoder.add_itxt_chunk(keyword.into(), entry.into())?,
        }
    }
    Ok(())
}
