//! Animations as APNG (PNG specification, third edition, section 11.3.6).
//!
//! Every frame is made as a picture of its own, whose compressed rows then become a frame of the
//! animation. So no encoder lives from frame to frame, and a run that was killed goes on.

use crate::Image;
use crate::image::configure;

/// Where the chunk with the number of frames starts: after the signature and the head.
pub(super) const COUNT_PLACE: u64 = 8 + 25;

/// What an APNG file begins with before its first frame: everything that `image`, as a picture
/// of its own, has before its rows, and room for the number of frames.
pub(super) fn beginning(
    image: &Image,
    text: &[(&str, &str)],
) -> Result<Vec<u8>, png::EncodingError> {
    let picture = encoded(image, text)?;
    let mut bytes = picture[..COUNT_PLACE as usize].to_vec();
    bytes.extend(count_chunk(0));
    let heads = chunks(&picture).skip(1).take_while(|(name, _)| *name != b"IDAT");
    heads.for_each(|(name, contents)| bytes.extend(chunk(name, &[contents])));
    Ok(bytes)
}

/// The chunks of frame `number`.
pub(super) fn frame(
    image: &Image,
    number: usize,
    delay_ms: u32,
) -> Result<Vec<u8>, png::EncodingError> {
    let picture = encoded(image, &[])?;
    let rows: Vec<&[u8]> =
        chunks(&picture).filter(|(name, _)| *name == b"IDAT").map(|(_, rows)| rows).collect();
    // The control chunk and the rows of each frame but the first count on; here the rows of a
    // frame are one chunk.
    let sequence = if number == 0 { 0 } else { 2 * number as u32 - 1 };
    let mut control = sequence.to_be_bytes().to_vec();
    for size in [image.width as u32, image.height as u32, 0, 0] {
        control.extend(size.to_be_bytes());
    }
    control.extend([delay_ms as u16, 1000].map(u16::to_be_bytes).concat());
    // Frames stay where they are and replace what is there.
    control.extend([0, 0]);
    let mut bytes = chunk(b"fcTL", &[&control]);
    match number {
        0 => bytes.extend(chunk(b"IDAT", &rows)),
        _ => bytes
            .extend(chunk(b"fdAT", &[&[&(sequence + 1).to_be_bytes()[..]], &rows[..]].concat())),
    }
    Ok(bytes)
}

/// The chunk with the number of frames, which are shown over and over.
pub(super) fn count_chunk(frames: usize) -> Vec<u8> {
    chunk(b"acTL", &[&(frames as u32).to_be_bytes(), &[0; 4]])
}

/// What an APNG file ends with.
pub(super) fn end() -> Vec<u8> {
    chunk(b"IEND", &[])
}

fn encoded(image: &Image, text: &[(&str, &str)]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width as u32, image.height as u32);
    configure(&mut encoder, text)?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(image.rgb.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

/// Names and contents of the chunks of a PNG file: length, name, contents, checksum each.
fn chunks(file: &[u8]) -> impl Iterator<Item = (&[u8], &[u8])> {
    let mut rest = &file[8..];
    std::iter::from_fn(move || {
        let (length, name) = (rest.get(..4)?, rest.get(4..8)?);
        let length = u32::from_be_bytes(length.try_into().ok()?) as usize;
        let contents = rest.get(8..8 + length)?;
        rest = rest.get(12 + length..)?;
        Some((name, contents))
    })
}

/// A chunk whose contents are in several pieces.
fn chunk(name: &[u8], contents: &[&[u8]]) -> Vec<u8> {
    let length: usize = contents.iter().map(|piece| piece.len()).sum();
    let mut bytes = (length as u32).to_be_bytes().to_vec();
    bytes.extend(name);
    contents.iter().for_each(|piece| bytes.extend(*piece));
    let checksum = crc32fast::hash(&bytes[4..]);
    bytes.extend(checksum.to_be_bytes());
    bytes
}
