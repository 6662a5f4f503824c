//! OpenEXR: a raster as one channel of 32-bit floats, for renderers (feature `exr`).

use std::io;
use std::path::Path;

use exr::prelude::{AttributeValue, Image, SpecificChannels, Text, WritableImage};

use crate::stored::stored;
use crate::{IfExists, IoError, Metadata, Raster, SampleType, write_atomically};

/// Writes the values as channel `Y`, in their own unit and not scaled; metadata and place stand
/// in attributes of the image.
///
/// # Errors
/// [`IoError`]: a value is not finite or beyond f32, or the output cannot be written.
pub fn write(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let stored = stored(raster, SampleType::F32, [1.0, 0.0], SampleType::F32.marks())
        .map_err(|fault| fault.writing(path))?;
    let width = raster.width;
    let channels = SpecificChannels::build()
        .with_channel("Y")
        .with_pixel_fn(|at| (stored.numbers[at.y() * width + at.x()] as f32,));
    let mut image = Image::from_channels((width, raster.height), channels);
    for (name, text) in metadata.entries() {
        let text = Text::new_or_none(&text).map(AttributeValue::Text);
        if let (Some(name), Some(text)) = (Text::new_or_none(&name), text) {
            image.layer_data.attributes.other.insert(name, text);
        }
    }
    write_atomically(path, if_exists, |file| {
        image.write().to_buffered(file).map_err(|error| io::Error::other(error.to_string()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_back() {
        let values: Vec<f64> = (0..12).map(|cell| f64::from(cell) * 0.25 - 1.0).collect();
        let raster = Raster::local(4, 3, 10.0, values.clone());
        let metadata = Metadata { unit: Some("m".into()), ..Metadata::default() };
        let path = std::env::temp_dir().join(format!("landform-{}.exr", std::process::id()));
        write(&path, &raster, &metadata, IfExists::Replace).unwrap();
        let read = exr::prelude::read_first_flat_layer_from_file(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        let channel = &read.layer_data.channel_data.list[0];
        assert_eq!(channel.name.to_string(), "Y");
        let back: Vec<f64> = channel.sample_data.values_as_f32().map(f64::from).collect();
        assert_eq!(back, values);
        let unit = read.layer_data.attributes.other.get(&Text::from("unit"));
        assert_eq!(unit, Some(&AttributeValue::Text(Text::from("m"))));
    }
}
