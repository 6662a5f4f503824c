//! Image coasts on the processor: row by row, on all threads.

use std::ops::Range;

use rayon::prelude::*;

use super::numbers::{self, force, strength, tile_length};
use super::settings::Steps;
use super::{ImageCoastError, ImageCoastSettings};

/// A coast as an image (thesis, appendix B.1), with its memory for iterations.
///
/// ```
/// use landform_coast::image::{ImageCoast, ImageCoastSettings};
///
/// // A square of land whose rock is hard but for one pixel of its western coast.
/// let mut land: Vec<u8> =
///     (0..64).map(|pixel| u8::from((2..6).contains(&(pixel % 8)) && (2..6).contains(&(pixel / 8)))).collect();
/// let mut rock = vec![1.0; 64];
/// rock[3 * 8 + 2] = 0.1;
/// let settings = ImageCoastSettings { force: 0.2, attenuation: 0.0, ..Default::default() };
/// let mut coast = ImageCoast::new([8, 8], settings, &rock)?;
/// assert_eq!(coast.run(&mut land, 10)?, 1);
/// assert_eq!(land[3 * 8 + 2], 0);
/// # Ok::<(), landform_coast::image::ImageCoastError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ImageCoast {
    size: [usize; 2],
    steps: Steps,
    resistance: Vec<u16>,
    /// Where columns lie between the middles of tiles.
    columns: Vec<[u32; 2]>,
    /// The land before an iteration: rows with their first and last pixel once more before and
    /// behind them.
    before: Vec<u8>,
}

/// Pixels that are looked at together: as many as can be counted in a byte.
const BLOCK: usize = 64;

/// Rows whose shore is measured together.
const STRIP: usize = 64;

/// Pixels that a thread takes at once, so that handing them over costs little.
const TASK: usize = 16384;

impl ImageCoast {
    /// A coast on an image of `size` columns and rows, with a `resistance` of 0 to 1 a pixel.
    ///
    /// # Errors
    /// See [`ImageCoastError`].
    pub fn new(
        size: [usize; 2],
        settings: ImageCoastSettings,
        resistance: &[f64],
    ) -> Result<Self, ImageCoastError> {
        settings.validate(size)?;
        let expected = size[0] * size[1];
        let found = resistance.len();
        if found != expected {
            return Err(ImageCoastError::Length { field: "resistance", expected, found });
        }
        let resistance = resistance.iter().map(|&u| numbers::resistance(u)).collect();
        let steps = settings.steps(size);
        Ok(Self {
            size,
            steps,
            resistance,
            columns: (0..size[0]).map(|x| steps.place(x, 0)).collect(),
            before: vec![0; (size[0] + 2) * size[1]],
        })
    }

    /// Runs until nothing falls, or for `most` iterations, on `land`: 0 at sea. Returns the number
    /// of iterations in which something fell.
    ///
    /// # Errors
    /// [`ImageCoastError::Length`].
    pub fn run(&mut self, land: &mut [u8], most: usize) -> Result<usize, ImageCoastError> {
        for iteration in 0..most {
            if self.step(land)? == 0 {
                return Ok(iteration);
            }
        }
        Ok(most)
    }

    /// One iteration on `land`. Returns the number of pixels that fell.
    ///
    /// # Errors
    /// [`ImageCoastError::Length`].
    pub fn step(&mut self, land: &mut [u8]) -> Result<usize, ImageCoastError> {
        let (expected, found) = (self.resistance.len(), land.len());
        if found != expected {
            return Err(ImageCoastError::Length { field: "land", expected, found });
        }
        self.remember(land);
        let lengths = self.tile_lengths();
        // Where the least shore is: blended lengths are between those of tiles.
        let least = lengths.iter().copied().min().unwrap_or(0);
        let strongest = force(self.steps.force, self.steps.attenuation, least);
        let rows = land.par_chunks_mut(self.size[0]).enumerate();
        Ok(rows
            .with_min_len(TASK.div_ceil(self.size[0]))
            .map(|(y, land)| self.erode_row(y, (&lengths, strongest), land))
            .sum())
    }

    /// Takes the land as it is before this iteration.
    fn remember(&mut self, land: &[u8]) {
        let width = self.size[0];
        let rows = self.before.par_chunks_mut(width + 2).zip(land.par_chunks(width));
        rows.with_min_len(TASK.div_ceil(width)).for_each(|(before, land)| {
            for (before, &land) in before[1..].iter_mut().zip(land) {
                *before = u8::from(land > 0);
            }
            (before[0], before[width + 1]) = (before[1], before[width]);
        });
    }

    /// Row `y` of the land before this iteration, with a pixel more before and behind it; beyond
    /// the border the row at it.
    fn row(&self, y: usize) -> &[u8] {
        let [width, height] = self.size;
        let start = y.min(height - 1) * (width + 2);
        &self.before[start..start + width + 2]
    }

    /// Length of shore of every tile.
    fn tile_lengths(&self) -> Vec<u32> {
        let [rows, tiles] = [self.steps.tile[1], self.steps.tiles].map(|count| count as usize);
        let strips = rows.div_ceil(STRIP);
        let of_strip = |strip: usize| {
            let (tile_row, first) = (strip / strips, strip % strips * STRIP);
            let rows = tile_row * rows + first..tile_row * rows + (first + STRIP).min(rows);
            self.strip_pieces(rows)
        };
        let pieces: Vec<Vec<[u32; 2]>> =
            (0..tiles * strips).into_par_iter().map(of_strip).collect();
        let of_tile_row = |strips: &[Vec<[u32; 2]>]| -> Vec<u32> {
            let sum = |tile: usize| {
                let pieces = strips.iter().map(|strip| strip[tile]);
                pieces.fold([0, 0], |[a, b], [c, d]| [a + c, b + d])
            };
            (0..tiles).map(|tile| tile_length(sum(tile), self.steps.side)).collect()
        };
        pieces.chunks(strips).flat_map(of_tile_row).collect()
    }

    /// Pieces of shore of every tile that some rows lie in.
    fn strip_pieces(&self, rows: Range<usize>) -> Vec<[u32; 2]> {
        let (columns, last) = (self.steps.tile[0] as usize, self.size.map(|side| side - 1));
        let mut pieces = vec![[0; 2]; self.steps.tiles as usize];
        for y in rows.start..rows.end.min(last[1]) {
            let [north, south] = [&self.row(y)[1..], &self.row(y + 1)[1..]];
            for (tile, pieces) in pieces.iter_mut().enumerate() {
                let columns = columns * tile..(columns * (tile + 1)).min(last[0]);
                add_pieces(north, south, columns, pieces);
            }
        }
        pieces
    }

    /// Erodes a row of land by the lengths of shore of the tiles, and the force where it is
    /// strongest. Returns the number of pixels that fell.
    fn erode_row(&self, y: usize, (lengths, strongest): (&[u32], u32), land: &mut [u8]) -> usize {
        let width = self.size[0];
        let [north, here, south] = [self.row(y.saturating_sub(1)), self.row(y), self.row(y + 1)];
        let resistance = &self.resistance[y * width..(y + 1) * width];
        let row = self.steps.place(y, 1);
        let mut fallen = 0;
        for start in (0..width).step_by(BLOCK) {
            let block = start..(start + BLOCK).min(width);
            let exposed = exposed_sides([north, here, south], block.clone());
            // Most of an image is sea or lies inland.
            if exposed.iter().fold(0, |any, &exposed| any | exposed) == 0 {
                continue;
            }
            for (x, exposed) in block.zip(exposed).filter(|&(_, exposed)| exposed > 0) {
                let strength = strength(self.steps.weakening, resistance[x], exposed.into());
                // Most rock withstands the sea wherever it stands.
                if strength >= strongest {
                    continue;
                }
                let length = self.steps.length_at(lengths, self.columns[x], row);
                if strength < force(self.steps.force, self.steps.attenuation, length) {
                    land[x] = 0;
                    fallen += 1;
                }
            }
        }
        fallen
    }
}

/// Number of the four sides of the land pixels of a block that lie at sea, 0 for pixels at sea and
/// behind the block; rows have a pixel more before and behind them.
#[inline]
fn exposed_sides([north, here, south]: [&[u8]; 3], block: Range<usize>) -> [u8; BLOCK] {
    let Range { start, end } = block;
    // Zipped slices have no bounds to check, so that many pixels are looked at together.
    let beside = here[start..end].iter().zip(&here[start + 2..end + 2]);
    let across = north[start + 1..end + 1].iter().zip(&south[start + 1..end + 1]);
    let around = here[start + 1..end + 1].iter().zip(beside.zip(across));
    let mut exposed = [0; BLOCK];
    for (exposed, (land, ((west, east), (north, south)))) in exposed.iter_mut().zip(around) {
        // All bits of a land pixel, none at sea: bytes are quicker to mask than to multiply.
        *exposed = land.wrapping_neg() & (4 - (west + east + north + south));
    }
    exposed
}

/// Adds the pieces of shore between two rows, in the squares whose western pixels lie in `columns`:
/// [`shore_pieces`](super::numbers::shore_pieces) without a branch.
#[inline]
fn add_pieces(north: &[u8], south: &[u8], columns: Range<usize>, pieces: &mut [u32; 2]) {
    for start in columns.clone().step_by(BLOCK) {
        let end = columns.end.min(start + BLOCK);
        let west = north[start..end].iter().zip(&south[start..end]);
        let east = north[start + 1..end + 1].iter().zip(&south[start + 1..end + 1]);
        let (mut straight, mut corners) = (0_u8, 0_u8);
        for ((nw, sw), (ne, se)) in west.zip(east) {
            let land = nw + ne + sw + se;
            let (two, diagonal) = (u8::from(land == 2), u8::from(nw == se));
            straight += two & (1 - diagonal);
            corners += (land & 1) + 2 * (two & diagonal);
        }
        pieces[0] += u32::from(straight);
        pieces[1] += u32::from(corners);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::Weakening;
    use crate::image::reference;
    use crate::image::testing::island;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_give_the_land_of_the_reference(
            tiles in [1_usize..40, 1..40], offset in 0_u32..3, seed: u64,
            force in 0.2..0.9_f64, attenuation in 0.0..0.5_f64,
            weakening in prop::sample::select(vec![Weakening::None, Weakening::Share, Weakening::Power]),
        ) {
            let size = tiles.map(|side| (side << offset).max(4 << offset));
            let settings = ImageCoastSettings { force, attenuation, offset, weakening };
            let (mut land, rock) = island(size, seed);
            let mut literal = land.clone();
            let steps: Vec<u16> = rock.iter().map(|&u| numbers::resistance(u)).collect();
            let mut coast = ImageCoast::new(size, settings, &rock).unwrap();
            for _ in 0..20 {
                let fallen = coast.step(&mut land).unwrap();
                prop_assert_eq!(fallen, reference::step(size, &settings, &steps, &mut literal).unwrap());
                prop_assert_eq!(&land, &literal);
            }
        }
    }

    /// The coast of 128 x 128 pixels in table B.1 comes to rest within its 100 iterations and
    /// leaves most of the land.
    #[test]
    fn the_coasts_of_table_b1_come_to_rest() {
        let (mut land, rock) = island([128, 128], 7);
        let before = land.iter().filter(|&&land| land == 1).count();
        let settings = ImageCoastSettings { attenuation: 0.23, ..Default::default() };
        let mut coast = ImageCoast::new([128, 128], settings, &rock).unwrap();
        let iterations = coast.run(&mut land, 1000).unwrap();
        assert!((5..=100).contains(&iterations), "{iterations}");
        let left = land.iter().filter(|&&land| land == 1).count() as f64 / before as f64;
        assert!((0.5..0.95).contains(&left), "{left}");
        assert_eq!(coast.step(&mut land).unwrap(), 0);
    }

    #[test]
    fn settings_and_fields_that_do_not_fit_are_refused() {
        let of = |settings| ImageCoast::new([8, 8], settings, &[0.5; 64]).map(|_| ());
        let good = ImageCoastSettings::default();
        assert_eq!(of(good), Ok(()));
        for force in [-0.1, 2.0, f64::NAN] {
            let refused = of(ImageCoastSettings { force, ..good }).unwrap_err();
            assert!(matches!(refused, ImageCoastError::Range { name: "force", .. }), "{refused}");
        }
        let refused = of(ImageCoastSettings { offset: 4, ..good }).unwrap_err();
        assert_eq!(refused, ImageCoastError::Tiles(8, 8, 16));
        let refused = ImageCoast::new([8, 8], good, &[0.5; 63]).unwrap_err();
        assert!(refused.to_string().contains("63 values"), "{refused}");
        let mut coast = ImageCoast::new([8, 8], good, &[0.5; 64]).unwrap();
        assert!(coast.step(&mut [1; 9]).is_err());
    }
}
