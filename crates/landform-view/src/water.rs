//! Water over the ground: seas at a level, rivers and lakes of any depth.

use rayon::prelude::*;

use crate::light::{Rgb, decode, mix};
use crate::surface::{Sampling, Surface, bound};
use crate::{HeightField, ViewError};

/// What water looks like, and where it is.
///
/// It stands wherever the ground is below `level_m`, and wherever the depths of a field
/// ([`HeightField::with_water`]) are at least `least_m`. It is a surface of its own, as far above
/// the ground as the water is deep, through which the ground is seen the darker and bluer the
/// longer the way through the water (thesis, section A.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Height of a sea in metres; none when missing.
    pub level_m: Option<f64>,
    /// Depth in metres of the shallowest water of a field that is drawn: about that of the
    /// smallest channel.
    pub least_m: f64,
    /// Colour of deep water, sRGB.
    pub colour: [u8; 3],
    /// Depth in metres at which about two thirds of the ground's colour are gone.
    pub clear_m: f64,
}

impl Water {
    /// Blue-green water that hides the ground at depths of a few `clear_m` metres: the depths of
    /// a field, from a tenth of `clear_m`.
    pub fn new(clear_m: f64) -> Self {
        Self { level_m: None, least_m: 0.1 * clear_m, colour: [38, 92, 120], clear_m }
    }

    /// The same at a level.
    pub fn at(level_m: f64, clear_m: f64) -> Self {
        Self { level_m: Some(level_m), ..Self::new(clear_m) }
    }

    pub(crate) fn check(&self) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        let level = self.level_m.unwrap_or_default();
        check("water.level_m", level, [-1e12, 1e12], "a height in metres")?;
        let range = [f64::MIN_POSITIVE, f64::MAX];
        check("water.least_m", self.least_m, range, "a positive number of metres")?;
        check("water.clear_m", self.clear_m, range, "a positive number of metres")
    }

    /// Share of the ground's colour that `path_m` metres of water hide.
    pub fn opacity(&self, path_m: f64) -> f64 {
        // Even a film of water darkens the ground, which makes the shore a line.
        1.0 - 0.8 * (-path_m.max(0.0) / self.clear_m).exp()
    }

    /// Colour of ground seen through `path_m` metres of water.
    pub(crate) fn over(&self, ground: Rgb, path_m: f64) -> Rgb {
        mix(ground, self.colour.map(decode), self.opacity(path_m) as f32)
    }

    /// Height of the water's surface at each node in metres, as pictures draw it: where there is
    /// water, and at the nodes beside it, where the surface goes on below the ground, so that the
    /// shore lies where both meet. NaN elsewhere.
    ///
    /// # Errors
    /// [`ViewError::Option`] for settings that are no numbers or not positive.
    pub fn surface_heights(&self, field: &HeightField<'_>) -> Result<Vec<f64>, ViewError> {
        self.check()?;
        let levels = self.known_levels(field, 1, false);
        Ok(levels.into_iter().map(|level| level.unwrap_or(f64::NAN)).collect())
    }

    /// Covers the nodes of a surface that lie below water, seen from above.
    pub(crate) fn cover(&self, ground: &Surface, water: Option<&Surface>, colours: &mut [Rgb]) {
        let metres = |surface: &Surface, node: usize| surface.metres(surface.heights[node]);
        colours.par_iter_mut().enumerate().for_each(|(node, colour)| {
            let own = water.map(|water| metres(water, node));
            let top = own.or(self.level_m).unwrap_or(f64::NEG_INFINITY);
            let depth = top - metres(ground, node);
            if depth > 0.0 {
                *colour = self.over(*colour, depth);
            }
        });
    }

    /// The surface of the water on a field, sampled like the ground; none when the field has no
    /// depths.
    pub(crate) fn surface(
        &self,
        field: &HeightField<'_>,
        sampling: Sampling,
    ) -> Result<Option<Surface>, ViewError> {
        if field.water_depths().is_none() {
            return Ok(None);
        }
        let levels = self.levels(field, sampling.periodic);
        let raised = HeightField::new(field.width(), field.height(), field.spacing_m(), &levels)?;
        Surface::sample_above(&raised, field.range()[0], sampling).map(Some)
    }

    /// Height of the water at nodes where it stands and up to `rings` nodes beside them, where it
    /// goes on below the ground.
    fn known_levels(
        &self,
        field: &HeightField<'_>,
        rings: usize,
        periodic: bool,
    ) -> Vec<Option<f64>> {
        let (heights, sea) = (field.heights(), self.level_m.unwrap_or(f64::NEG_INFINITY));
        let size = [field.width(), field.height()];
        let nodes = || (0..heights.len()).into_par_iter();
        let wet = |node: usize| {
            let depth = field.water_depths().map_or(0.0, |depths| depths[node]);
            let own = if depth >= self.least_m { depth } else { 0.0 };
            let level = sea.max(heights[node] + own);
            (level > heights[node]).then_some(level)
        };
        let mut known: Vec<Option<f64>> = nodes().map(wet).collect();
        for _ in 0..rings {
            let beside = |node: usize| {
                let (sum, count) = around(node, size, 1, periodic)
                    .filter_map(|near| known[near])
                    .fold((0.0, 0.0), |(sum, count), level| (sum + level, count + 1.0));
                // Water that flows past, above this ground, does not lie on it.
                (count > 0.0 && sum / count < heights[node]).then(|| sum / count)
            };
            known = nodes().map(|node| known[node].or_else(|| beside(node))).collect();
        }
        known
    }

    /// Height of the water at each node. Beside the water it goes on below the ground, so that
    /// the shore lies where both surfaces meet; elsewhere it is so far below that splines which
    /// swing beside a cliff do not lift it above the ground.
    fn levels(&self, field: &HeightField<'_>, periodic: bool) -> Vec<f64> {
        /// Nodes by which levels go on.
        const RINGS: usize = 2;
        /// Share of the relief nearby by which splines may swing.
        const SWING: f64 = 0.35;
        let known = self.known_levels(field, RINGS, periodic);
        let (heights, size) = (field.heights(), [field.width(), field.height()]);
        let nodes = || (0..heights.len()).into_par_iter();
        let below = |node: usize| {
            let bounds = around(node, size, 2, periodic)
                .flat_map(|near| [heights[near], known[near].unwrap_or(heights[near])]);
            let [low, high] = bounds.fold([heights[node]; 2], |[low, high], height| {
                [low.min(height), high.max(height)]
            });
            heights[node] - self.least_m.max(SWING * (high - low))
        };
        nodes().map(|node| known[node].unwrap_or_else(|| below(node))).collect()
    }
}

/// The nodes up to `reach` columns and rows from a node, itself included; those beyond an open
/// edge are those at the edge.
fn around(
    node: usize,
    [width, height]: [usize; 2],
    reach: isize,
    periodic: bool,
) -> impl Iterator<Item = usize> {
    let (column, row) = ((node % width) as isize, (node / width) as isize);
    (-reach..=reach).flat_map(move |down| {
        (-reach..=reach).map(move |across| {
            bound(column + across, width, periodic) + width * bound(row + down, height, periodic)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ditch of 2 m with 1 m of water: the shore lies half-way up its banks.
    #[test]
    fn shores_lie_where_the_water_meets_the_ground() {
        let heights: Vec<f64> =
            (0..9 * 4).map(|node| [0.0, 2.0][usize::from(node % 9 != 4)]).collect();
        let depths: Vec<f64> = heights.iter().map(|height| (1.0 - height).max(0.0)).collect();
        let field = HeightField::new(9, 4, 1.0, &heights).unwrap().with_water(&depths).unwrap();
        let levels = Water::new(1.0).levels(&field, false);
        // Two metres of relief may swing by 0.7.
        let far = 2.0 - 0.35 * 1.0;
        assert_eq!(levels[..9], [far, far, 1.0, 1.0, 1.0, 1.0, 1.0, far, far]);
        let surface = Water::new(1.0).surface_heights(&field).unwrap();
        assert_eq!(surface[3..6], [1.0; 3]);
        assert!(surface[..3].iter().chain(&surface[6..9]).all(|height| height.is_nan()));
        // A film below the least depth is not drawn.
        let film = Water { least_m: 1.5, ..Water::new(1.0) }.levels(&field, false);
        assert!(film.iter().zip(&heights).all(|(level, height)| level < height));
        // A sea covers the film and the plain alike.
        let sea = Water { least_m: 1.5, ..Water::at(3.0, 1.0) }.levels(&field, false);
        assert_eq!(sea, [3.0; 36]);
    }

    #[test]
    fn bad_depths_are_refused() {
        let heights = [0.0; 4];
        let field = HeightField::new(2, 2, 1.0, &heights).unwrap();
        let refused = field.with_water(&[0.0, 1.0, -1e-9, 0.0]).unwrap_err();
        assert!(refused.to_string().contains("the depth of water"), "{refused}");
        assert!(field.with_water(&[f64::NAN; 4]).is_err());
        assert!(field.with_water(&[0.0; 3]).is_err());
    }
}
