//! Image coasts on the processor: row by row, on all threads.

use rayon::prelude::*;

use super::numbers::{self, force, shore_pieces, strength, tile_length};
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
    before: Vec<u8>,
}

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
        Ok(Self { size, steps: settings.steps(size), resistance, before: vec![0; expected] })
    }

    /// Runs until nothing falls, or for `most` iterations, on `land`: 1 on land, 0 at sea. Returns
    /// the number of iterations in which something fell.
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
        let (expected, found) = (self.before.len(), land.len());
        if found != expected {
            return Err(ImageCoastError::Length { field: "land", expected, found });
        }
        self.before.copy_from_slice(land);
        let lengths = self.tile_lengths();
        let [width, _] = self.size;
        let fallen = land
            .par_chunks_mut(width)
            .enumerate()
            .map(|(y, land)| self.erode_row(y, &lengths, land));
        Ok(fallen.sum())
    }

    /// Row `y` of the land before this iteration; beyond the border the row at it.
    fn row(&self, y: usize) -> &[u8] {
        let [width, height] = self.size;
        let start = y.min(height - 1) * width;
        &self.before[start..start + width]
    }

    /// Length of shore of every tile.
    fn tile_lengths(&self) -> Vec<u32> {
        let [columns, rows] = self.steps.tile.map(|side| side as usize);
        let tiles = self.steps.tiles as usize;
        let of_tile_row = |tile_row: usize| {
            let mut pieces = vec![[0_u32; 2]; tiles];
            for y in rows * tile_row..rows * (tile_row + 1) {
                let [north, south] = [self.row(y), self.row(y + 1)];
                if y + 1 < self.size[1] {
                    for (tile, pieces) in pieces.iter_mut().enumerate() {
                        add_pieces(north, south, columns * tile..columns * (tile + 1), pieces);
                    }
                }
            }
            pieces.into_iter().map(|pieces| tile_length(pieces, self.steps.side)).collect()
        };
        let lengths: Vec<Vec<u32>> = (0..tiles).into_par_iter().map(of_tile_row).collect();
        lengths.concat()
    }

    /// Erodes a row of land. Returns the number of pixels that fell.
    fn erode_row(&self, y: usize, lengths: &[u32], land: &mut [u8]) -> usize {
        let [width, _] = self.size;
        let [north, here, south] = [self.row(y.saturating_sub(1)), self.row(y), self.row(y + 1)];
        let resistance = &self.resistance[y * width..(y + 1) * width];
        let mut fallen = 0;
        for x in 0..width {
            if here[x] == 0 {
                continue;
            }
            let around =
                [here[x.saturating_sub(1)], here[(x + 1).min(width - 1)], north[x], south[x]];
            let exposed = 4 - around.iter().map(|&land| u32::from(land)).sum::<u32>();
            if exposed > 0 {
                let length = self.steps.length_at(lengths, [x, y]);
                let force = force(self.steps.force, self.steps.attenuation, length);
                if strength(self.steps.weakening, resistance[x], exposed) < force {
                    land[x] = 0;
                    fallen += 1;
                }
            }
        }
        fallen
    }
}

/// Adds the pieces of shore between two rows, in the squares whose western pixels lie in `columns`.
fn add_pieces(north: &[u8], south: &[u8], columns: std::ops::Range<usize>, pieces: &mut [u32; 2]) {
    let end = columns.end.min(north.len() - 1);
    for x in columns.start..end {
        let square = [north[x], north[x + 1], south[x], south[x + 1]];
        let [straight, corners] = shore_pieces(square);
        pieces[0] += straight;
        pieces[1] += corners;
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
            tiles in [1_usize..9, 1..9], offset in 0_u32..3, seed: u64,
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
