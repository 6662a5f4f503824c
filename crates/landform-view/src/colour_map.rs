//! Colour maps: perceptually uniform, readable with colour-blind eyes and in grey.
//!
//! The tables (256 entries of red, green and blue) come from published packages, all under the
//! MIT licence or equally free ones: `batlow`, `broc`, `bukavu`, `davos`, `fes`, `grayC`,
//! `lajolla`, `lapaz`, `oleron`, `turku` and `vik` by Crameri (2018, "Scientific colour maps",
//! <https://doi.org/10.5281/zenodo.1243862>; Crameri, Shephard and Heron 2020,
//! <https://doi.org/10.1038/s41467-020-19160-7>), `viridis` by Smith, van der Walt and Firing,
//! `cividis` by Nunez, Anderton and Renslow (2018,
//! <https://doi.org/10.1371/journal.pone.0199239>). `sand` was made for this crate: four sand
//! colours joined by monotone cubics in Oklab, lightness rising with height.

use crate::ViewError;
use crate::light::{Rgb, decode};

/// Bytes of a table: 256 times red, green and blue.
const TABLE_BYTES: usize = 768;

macro_rules! tables {
    ($($name:literal),*) => {
        &[$(ColourMap {
            name: $name,
            table: include_bytes!(concat!("colour_maps/", $name, ".rgb")),
        }),*]
    };
}

/// Every map, by name.
static MAPS: &[ColourMap] = tables![
    "batlow", "broc", "bukavu", "cividis", "davos", "fes", "grayC", "lajolla", "lapaz", "oleron",
    "sand", "turku", "vik", "viridis"
];

/// A named table of 256 colours.
///
/// `batlow`, `viridis`, `cividis`, `lapaz`, `davos`, `lajolla`, `turku` and `grayC` run from dark
/// to light or back; `oleron`, `bukavu` and `fes` have sea below and land above their middle;
/// `vik` and `broc` diverge from a pale middle; `sand` is for dunes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColourMap {
    name: &'static str,
    table: &'static [u8; TABLE_BYTES],
}

impl ColourMap {
    /// The map of that name.
    ///
    /// # Errors
    /// [`ViewError::UnknownColourMap`] with the names that exist.
    pub fn named(name: &str) -> Result<Self, ViewError> {
        MAPS.iter().find(|map| map.name == name).copied().ok_or_else(|| {
            let known = Self::names().collect::<Vec<_>>().join(", ");
            ViewError::UnknownColourMap { name: name.into(), known }
        })
    }

    /// Names of all maps, in alphabetical order.
    pub fn names() -> impl Iterator<Item = &'static str> {
        MAPS.iter().map(|map| map.name)
    }

    /// Name of this map.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Colour of a value in [0, 1], in sRGB; values outside take the colour of the nearer end
    /// and NaN that of the lower one.
    pub fn colour(&self, value: f64) -> [u8; 3] {
        self.entry((value.clamp(0.0, 1.0) * 255.0).round() as usize)
    }

    /// Colour of a value in [0, 1] in linear light, interpolated between entries.
    pub(crate) fn linear(&self, value: f64) -> Rgb {
        let position = value.clamp(0.0, 1.0) * 255.0;
        let lower = (position as usize).min(254);
        let [low, high] = [lower, lower + 1].map(|index| self.entry(index).map(decode));
        let share = (position - lower as f64) as f32;
        std::array::from_fn(|channel| low[channel] + (high[channel] - low[channel]) * share)
    }

    /// Colour of the table at an index from 0 to 255.
    fn entry(&self, index: usize) -> [u8; 3] {
        std::array::from_fn(|channel| self.table[3 * index + channel])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::decode;

    fn lightness(colour: [u8; 3]) -> f32 {
        let [red, green, blue] = colour.map(decode);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    /// First and last colours as published with the maps.
    #[test]
    fn tables_are_the_published_ones() {
        for (name, first, last) in [
            ("viridis", [68, 1, 84], [253, 231, 37]),
            ("cividis", [0, 34, 78], [254, 232, 56]),
            ("batlow", [1, 25, 89], [250, 204, 250]),
            ("vik", [0, 18, 97], [89, 0, 8]),
        ] {
            let map = ColourMap::named(name).unwrap();
            assert_eq!((map.colour(0.0), map.colour(1.0)), (first, last), "{name}");
        }
    }

    #[test]
    fn sequential_maps_grow_lighter_all_the_way() {
        for name in ["batlow", "cividis", "davos", "lajolla", "lapaz", "sand", "turku", "viridis"] {
            let map = ColourMap::named(name).unwrap();
            let steps = (1..256).map(|i| lightness(map.entry(i)) - lightness(map.entry(i - 1)));
            let (down, up) = steps.fold((0.0, 0.0), |(down, up), step| match step < 0.0 {
                true => (down - step, up),
                false => (down, up + step),
            });
            assert!(down < 0.02 * up, "{name}: {down} down, {up} up");
        }
    }

    #[test]
    fn names_are_sorted_and_found_again() {
        assert!(ColourMap::names().is_sorted_by_key(str::to_lowercase));
        for name in ColourMap::names() {
            assert_eq!(ColourMap::named(name).unwrap().name(), name);
        }
        let message = ColourMap::named("Batlow").unwrap_err().to_string();
        assert!(message.contains("`Batlow`") && message.contains("batlow, broc"), "{message}");
    }

    #[test]
    fn values_outside_take_the_ends() {
        let map = ColourMap::named("batlow").unwrap();
        assert_eq!(map.colour(-3.0), map.colour(0.0));
        assert_eq!(map.colour(f64::INFINITY), map.colour(1.0));
        assert_eq!(map.colour(f64::NAN), map.colour(0.0));
    }
}
