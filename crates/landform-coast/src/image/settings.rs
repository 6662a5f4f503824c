//! The numbers of an image coast, with their ranges.

use thiserror::Error;

use super::numbers::{between_tiles, blend};
use crate::coast::Weakening;

/// Why a coast cannot be simulated as an image.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ImageCoastError {
    /// A number lies outside its range.
    #[error("{name} is {value}; it must be {expected}")]
    Range {
        /// Name of the setting.
        name: &'static str,
        /// Value given.
        value: f64,
        /// Range allowed, in words.
        expected: &'static str,
    },
    /// The image cannot be cut into tiles of the same size.
    #[error(
        "an image of {0} x {1} pixels cannot be cut into {2} x {2} tiles of the same size, at most \
         {most} pixels a side; take sides that are multiples of {2}, or another `offset`",
        most = ImageCoastSettings::LARGEST_TILE
    )]
    Tiles(usize, usize, usize),
    /// A field does not hold one value a pixel.
    #[error("the {field} field has {found} values; the image has {expected} pixels")]
    Length {
        /// Which field.
        field: &'static str,
        /// Number of pixels.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
}

/// Settings of an image coast (thesis, table B.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageCoastSettings {
    /// Force of the sea f on a coast of no length: 0 to below 2.
    pub force: f64,
    /// How strongly shore weakens the sea, g: 0 to below 16. A straight coast across a tile counts
    /// as a length of 1.
    pub attenuation: f64,
    /// Logarithm to base 2 of the number of tiles along a side: 0 to 8.
    pub offset: u32,
    /// How exposure weakens rock.
    pub weakening: Weakening,
}

impl Default for ImageCoastSettings {
    /// The coast of 512 x 512 pixels in table B.1.
    fn default() -> Self {
        Self { force: 0.5, attenuation: 0.15, offset: 2, weakening: Weakening::Share }
    }
}

impl ImageCoastSettings {
    /// Most pixels along the side of a tile.
    pub const LARGEST_TILE: usize = 16384;

    /// Checks the ranges, and that an image of `size` columns and rows can be cut into tiles.
    ///
    /// # Errors
    /// [`ImageCoastError::Range`] and [`ImageCoastError::Tiles`].
    pub fn validate(&self, size: [usize; 2]) -> Result<(), ImageCoastError> {
        let range = |name, value: f64, below: f64, expected| match (0.0..below).contains(&value) {
            true => Ok(()),
            false => Err(ImageCoastError::Range { name, value, expected }),
        };
        range("force", self.force, 2.0, "at least 0 and below 2")?;
        range("attenuation", self.attenuation, 16.0, "at least 0 and below 16")?;
        range("offset", f64::from(self.offset), 9.0, "a whole number from 0 to 8")?;
        let tiles = 1 << self.offset;
        let fits = |side: usize| {
            side > 0 && side.is_multiple_of(tiles) && side / tiles <= Self::LARGEST_TILE
        };
        match size.into_iter().all(fits) {
            true => Ok(()),
            false => Err(ImageCoastError::Tiles(size[0], size[1], tiles)),
        }
    }

    /// The settings in steps, for an image that they were checked for.
    pub(super) fn steps(&self, size: [usize; 2]) -> Steps {
        let tiles = 1 << self.offset;
        let tile = size.map(|side| (side / tiles) as u32);
        Steps {
            force: (self.force * 2_f64.powi(31)) as u32,
            attenuation: ((self.attenuation * 4096.0).round() as u32).min(0xffff),
            tiles: tiles as u32,
            tile,
            side: u32::midpoint(tile[0], tile[1]),
            weakening: self.weakening,
        }
    }
}

/// Settings in whole numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Steps {
    /// Force in steps of 2^-31.
    pub force: u32,
    /// Attenuation in steps of 1/4096.
    pub attenuation: u32,
    /// Tiles along a side.
    pub tiles: u32,
    /// Columns and rows of a tile.
    pub tile: [u32; 2],
    /// Length of a straight coast across a tile.
    pub side: u32,
    /// How exposure weakens rock.
    pub weakening: Weakening,
}

impl Steps {
    /// Where the column of a pixel lies between the middles of tiles, or its row, by `axis`: see
    /// [`between_tiles`].
    pub fn place(&self, pixel: usize, axis: usize) -> [u32; 2] {
        between_tiles(pixel as u32, self.tile[axis], self.tiles)
    }

    /// Length of shore at a pixel, blended from those of the tiles whose middles lie round it; its
    /// column and its row are given by [`Steps::place`].
    #[inline]
    pub fn length_at(
        &self,
        lengths: &[u32],
        [column, east]: [u32; 2],
        [row, south]: [u32; 2],
    ) -> u32 {
        let last = self.tiles - 1;
        let at = |column: u32, row: u32| {
            lengths[(row.min(last) * self.tiles + column.min(last)) as usize]
        };
        let across = |row: u32| blend(at(column, row), at(column + 1, row), east);
        blend(across(row), across(row + 1), south)
    }
}
