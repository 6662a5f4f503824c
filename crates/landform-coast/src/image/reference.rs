//! Image coasts by the letter: one function, one pixel after the other.

use super::numbers::{force, shore_pieces, strength, tile_length};
use super::settings::Steps;
use super::{ImageCoastError, ImageCoastSettings};

/// One iteration on `land`, 0 at sea, with `resistance` in steps
/// ([`super::numbers::resistance`]); both hold one value a pixel of `size` columns and rows.
/// Returns the number of pixels that fell.
///
/// # Errors
/// See [`ImageCoastError`].
pub fn step(
    size: [usize; 2],
    settings: &ImageCoastSettings,
    resistance: &[u16],
    land: &mut [u8],
) -> Result<usize, ImageCoastError> {
    settings.validate(size)?;
    let expected = size[0] * size[1];
    for (field, found) in [("resistance", resistance.len()), ("land", land.len())] {
        if found != expected {
            return Err(ImageCoastError::Length { field, expected, found });
        }
    }
    let steps = settings.steps(size);
    let before: Vec<u8> = land.iter().map(|&land| u8::from(land > 0)).collect();
    let lengths = tile_lengths(size, &steps, &before);
    let mut fallen = 0;
    for (pixel, land) in land.iter_mut().enumerate() {
        let place @ [x, y] = [pixel % size[0], pixel / size[0]];
        let exposed = exposed_sides(size, &before, place);
        if *land > 0 && exposed > 0 {
            let length = steps.length_at(&lengths, steps.place(x, 0), steps.place(y, 1));
            let force = force(steps.force, steps.attenuation, length);
            if strength(steps.weakening, resistance[pixel], exposed) < force {
                *land = 0;
                fallen += 1;
            }
        }
    }
    Ok(fallen)
}

/// Length of shore of every tile. A square of four pixels belongs to the tile of its north-western
/// pixel.
fn tile_lengths([width, height]: [usize; 2], steps: &Steps, land: &[u8]) -> Vec<u32> {
    let tiles = steps.tiles as usize;
    let mut pieces = vec![[0; 2]; tiles * tiles];
    for y in 0..height - 1 {
        for x in 0..width - 1 {
            let at = |x: usize, y: usize| land[y * width + x];
            let found = shore_pieces([at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)]);
            let tile = [x / steps.tile[0] as usize, y / steps.tile[1] as usize];
            for (sum, count) in pieces[tile[1] * tiles + tile[0]].iter_mut().zip(found) {
                *sum += count;
            }
        }
    }
    pieces.into_iter().map(|pieces| tile_length(pieces, steps.side)).collect()
}

/// Number of the four neighbours of a pixel that are sea; beyond the border is none.
fn exposed_sides([width, height]: [usize; 2], land: &[u8], [x, y]: [usize; 2]) -> u32 {
    let beside = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
    let is_sea = |&&(x, y): &&(usize, usize)| x < width && y < height && land[y * width + x] == 0;
    beside.iter().filter(is_sea).count() as u32
}
