//! Rasters as GeoTIFF.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use tiff::encoder::colortype::{ColorType, Gray32Float, Gray64Float, GrayI16};
use tiff::encoder::{
    Compression, DeflateLevel, DirectoryEncoder, Predictor, TiffEncoder, TiffKind, TiffKindBig,
    TiffKindStandard, TiffValue,
};
use tiff::tags::Tag;
use tiff::{TiffError, TiffResult};

use super::gdal;
use super::place::Tags;
use crate::stored::{Stored, stored};
use crate::{Fault, IfExists, IoError, Metadata, Raster, SampleType};

/// How values are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// F64, F32 or I16.
    pub sample: SampleType,
    /// `value = offset + scale * stored`; readers that know GDAL's metadata apply it.
    pub scale: f64,
    /// See `scale`.
    pub offset: f64,
}

impl Default for Options {
    /// Doubles, unscaled: every bit is kept.
    fn default() -> Self {
        Self { sample: SampleType::F64, scale: 1.0, offset: 0.0 }
    }
}

/// From this size on a file of 32-bit offsets might not suffice.
const BIG: u64 = 3_500_000_000;

/// Writes a raster with its georeference, metadata and no-data number. Missing cells are NaN
/// in floating point unless the raster names a number.
///
/// # Errors
/// [`IoError`]: a sample type other than the three, a value that does not fit it, or an
/// output that cannot be written.
pub fn write(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    options: &Options,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let fault = |fault: Fault| fault.writing(path);
    let Options { sample, scale, offset } = *options;
    if !matches!(sample, SampleType::F64 | SampleType::F32 | SampleType::I16) {
        let problem = format!("the sample type {sample:?}");
        return Err(fault(Fault::new(problem, "F64, F32 or I16", "choose one of them")));
    }
    let [Ok(_), Ok(_)] = raster.size().map(u32::try_from) else {
        let problem = format!("{} x {} cells", raster.width, raster.height);
        return Err(fault(Fault::new(problem, "fewer than 2^32 a side", "write a part")));
    };
    let stored = stored(raster, sample, [scale, offset], sample.marks()).map_err(fault)?;
    let image = Image { raster, metadata, stored: &stored };
    let bytes = raster.values.len() as u64 * sample.size() as u64;
    crate::write_atomically(path, if_exists, |writer| {
        let result = match bytes < BIG {
            true => image.encode::<TiffKindStandard>(writer, sample),
            false => image.encode::<TiffKindBig>(writer, sample),
        };
        result.map_err(|error| match error {
            TiffError::IoError(error) => error,
            other => io::Error::other(other),
        })
    })
}

/// What goes into the file.
struct Image<'a> {
    raster: &'a Raster,
    metadata: &'a Metadata,
    stored: &'a Stored<'a>,
}

impl Image<'_> {
    fn encode<K: TiffKind>(
        &self,
        writer: &mut BufWriter<File>,
        sample: SampleType,
    ) -> TiffResult<()> {
        let predictor = match sample {
            SampleType::I16 => Predictor::Horizontal,
            _ => Predictor::None,
        };
        let deflate = Compression::Deflate(DeflateLevel::Fast);
        let encoder = TiffEncoder::<_, K>::new_generic(writer)?;
        let encoder = encoder.with_compression(deflate).with_predictor(predictor);
        let numbers = &self.stored.numbers;
        match sample {
            SampleType::F32 => {
                let numbers: Vec<f32> = numbers.iter().map(|&v| v as f32).collect();
                self.image::<Gray32Float, K>(encoder, &numbers)
            }
            SampleType::I16 => {
                let numbers: Vec<i16> = numbers.iter().map(|&v| v as i16).collect();
                self.image::<GrayI16, K>(encoder, &numbers)
            }
            _ => self.image::<Gray64Float, K>(encoder, numbers),
        }
    }

    fn image<C: ColorType, K: TiffKind>(
        &self,
        mut encoder: TiffEncoder<&mut BufWriter<File>, K>,
        numbers: &[C::Inner],
    ) -> TiffResult<()>
    where
        [C::Inner]: TiffValue,
    {
        // `write` has checked that the sizes fit.
        let [width, height] = self.raster.size().map(|size| size as u32);
        let mut image = encoder.new_image::<C>(width, height)?;
        self.write_tags(image.encoder())?;
        image.write_data(numbers)
    }

    fn write_tags<K: TiffKind>(
        &self,
        directory: &mut DirectoryEncoder<'_, &mut BufWriter<File>, K>,
    ) -> TiffResult<()> {
        let encoding = &self.stored.encoding;
        directory.write_tag(Tag::ImageDescription, self.title().as_str())?;
        directory.write_tag(Tag::Unknown(42112), gdal::xml(self.metadata, encoding).as_str())?;
        if let Some(mark) = encoding.no_data {
            directory.write_tag(Tag::GdalNodata, mark.to_string().as_str())?;
        } else if self.raster.missing_count() > 0 {
            directory.write_tag(Tag::GdalNodata, "nan")?;
        }
        let Some(place) = &self.raster.georeference else { return Ok(()) };
        let tags = Tags::of(place);
        directory.write_tag(Tag::ModelPixelScaleTag, &tags.pixel_scale[..])?;
        directory.write_tag(Tag::ModelTiepointTag, &tags.tie_points[..])?;
        directory.write_tag(Tag::GeoKeyDirectoryTag, &tags.keys.directory[..])?;
        if !tags.keys.doubles.is_empty() {
            directory.write_tag(Tag::GeoDoubleParamsTag, &tags.keys.doubles[..])?;
        }
        if !tags.keys.text.is_empty() {
            directory.write_tag(Tag::GeoAsciiParamsTag, tags.keys.text.as_str())?;
        }
        Ok(())
    }

    /// Field, unit and title in one line of ASCII.
    fn title(&self) -> String {
        let Metadata { title, field, unit, .. } = self.metadata;
        let unit = unit.as_ref().map(|unit| format!("[{unit}]"));
        let parts = [field, &unit, title].map(|part| part.as_deref().unwrap_or_default());
        let text = parts.join(" ");
        text.trim().chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).collect()
    }
}
