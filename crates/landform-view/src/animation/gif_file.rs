//! Animations as GIF. Every frame is made by an encoder of its own, so that a run that was
//! killed goes on.

use gif::{AnyExtension, Encoder, EncodingError, Frame, Repeat};

use crate::{Image, ViewError};

/// About how many pixels of a frame its palette is learnt from.
const PALETTE_SAMPLE: usize = 60_000;

/// Label of a comment block (GIF89a specification, section 24).
const COMMENT: AnyExtension = AnyExtension(0xFE);

/// What a GIF file ends with (section 27).
pub(super) const END: u8 = 0x3B;

/// The size of a frame as GIF counts it.
pub(super) fn size_of([width, height]: [usize; 2]) -> Result<[u16; 2], ViewError> {
    match [width, height].map(u16::try_from) {
        [Ok(width), Ok(height)] => Ok([width, height]),
        _ => Err(ViewError::TooLarge { what: "a GIF frame", width, height }),
    }
}

/// What a GIF file begins with; `text` becomes comments.
pub(super) fn beginning(size: [u16; 2], text: &[(&str, &str)]) -> Result<Vec<u8>, EncodingError> {
    let mut encoder = Encoder::new(Vec::new(), size[0], size[1], &[])?;
    encoder.set_repeat(Repeat::Infinite)?;
    for (keyword, entry) in text {
        let comment = format!("{keyword}: {entry}");
        let blocks: Vec<&[u8]> = comment.as_bytes().chunks(255).collect();
        encoder.write_raw_extension(COMMENT, &blocks)?;
    }
    without_end(encoder)
}

/// A frame with a palette of its own.
pub(super) fn frame(
    image: &Image,
    [width, height]: [u16; 2],
    delay_ms: u32,
) -> Result<Vec<u8>, EncodingError> {
    // Every so many pixels count; the encoder allows up to every thirtieth.
    let every = (image.rgb.len() / PALETTE_SAMPLE).clamp(1, 30) as i32;
    let mut frame = Frame::from_rgb_speed(width, height, image.rgb.as_flattened(), every);
    frame.delay = ((delay_ms + 5) / 10) as u16;
    let head = without_end(Encoder::new(Vec::new(), width, height, &[])?)?.len();
    let mut encoder = Encoder::new(Vec::new(), width, height, &[])?;
    encoder.write_frame(&frame)?;
    let mut bytes = without_end(encoder)?;
    bytes.drain(..head);
    Ok(bytes)
}

fn without_end(encoder: Encoder<Vec<u8>>) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = encoder.into_inner()?;
    if bytes.last() == Some(&END) {
        bytes.pop();
    }
    Ok(bytes)
}
