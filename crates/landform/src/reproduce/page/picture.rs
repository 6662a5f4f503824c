//! A picture within the page: small enough to send the page about, large enough to look into.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use jpeg_encoder::{ColorType, Encoder};
use landform_view::Image;

use super::escape;

/// Widest picture in the page, in pixels; the file beside it is as it was drawn.
const WIDEST: usize = 1600;

/// Quality of what is not kept without loss, of 100.
const QUALITY: u8 = 88;

/// The element that shows the picture `shown`, which lies at `path`.
///
/// A picture is embedded as it is drawn or, where that is smaller by half, with less of what the eye
/// does not see: lines stay sharp, and shaded relief takes little room.
pub(super) fn picture(shown: &Path, path: &Path) -> Result<String, String> {
    let file = escape(&shown.display().to_string());
    let bytes =
        std::fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let (kind, bytes) = match path.extension().and_then(|extension| extension.to_str()) {
        Some("gif") => ("image/gif", bytes),
        Some("svg") => ("image/svg+xml", bytes),
        _ => smaller(path, bytes)?,
    };
    let data = STANDARD.encode(bytes);
    Ok(format!(
        "<img alt=\"{file}\" title=\"{file}\" loading=\"lazy\" src=\"data:{kind};base64,{data}\">\n"
    ))
}

/// The media type and the bytes of a PNG file as they are embedded.
fn smaller(path: &Path, bytes: Vec<u8>) -> Result<(&'static str, Vec<u8>), String> {
    // Animations and pictures of other kinds stay as they are.
    let Ok((image, _)) = Image::read_png(path) else { return Ok(("image/png", bytes)) };
    let image = image.shrunk(WIDEST);
    let (Ok(width), Ok(height)) = (u16::try_from(image.width), u16::try_from(image.height)) else {
        return Ok(("image/png", bytes));
    };
    let mut lossy = Vec::new();
    Encoder::new(&mut lossy, QUALITY)
        .encode(image.rgb.as_flattened(), width, height, ColorType::Rgb)
        .map_err(|error| format!("cannot embed {}: {error}", path.display()))?;
    Ok(if 2 * lossy.len() < bytes.len() { ("image/jpeg", lossy) } else { ("image/png", bytes) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines on white stay as they are; a slope with some noise does not.
    #[test]
    fn what_is_embedded_is_small() {
        let folder = std::env::temp_dir().join(format!("landform-page-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let embed = |colour: &dyn Fn(usize, usize) -> [u8; 3]| {
            let path = folder.join("p.png");
            let rgb = (0..90_000).map(|index| colour(index % 300, index / 300)).collect();
            Image { width: 300, height: 300, rgb }.write_png(&path, &[]).expect("a picture");
            let size = std::fs::metadata(&path).expect("a file").len() as usize;
            (picture(Path::new("a/p.png"), &path).expect("an element"), size)
        };
        let (lines, size) = embed(&|x, _| if x % 60 == 0 { [0; 3] } else { [255; 3] });
        assert!(lines.contains("data:image/png;base64,") && lines.len() < 2 * size + 200);
        let mix = |bits: u32| (bits ^ bits >> 15).wrapping_mul(0x2C1B_3C6D);
        let noise = |seed: usize| mix(mix(mix(seed as u32 + 1))) >> 30;
        let slope = |x: usize, y: usize| {
            [0, 1, 2].map(|channel| (x / 2) as u8 + noise(x + 300 * y + 90_000 * channel) as u8)
        };
        let (relief, size) = embed(&slope);
        assert!(relief.contains("title=\"a/p.png\"") && relief.contains("data:image/jpeg;base64,"));
        assert!(relief.len() < size, "{} of {size}", relief.len());
        assert!(picture(Path::new("q.png"), &folder.join("q.png")).is_err());
        std::fs::remove_dir_all(&folder).expect("a folder");
    }
}
