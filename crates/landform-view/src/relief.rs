//! Shaded relief: the map seen from above.

use rayon::prelude::*;

use crate::light::{Light, quantise, shoulder};
use crate::shade::{Ground, shade};
use crate::surface::{Sampling, Surface};
use crate::water::Water;
use crate::{HeightField, Image, ViewError};

/// How a shaded relief is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct ReliefOptions {
    /// Colours and contour lines.
    pub ground: Ground,
    /// What lights it.
    pub light: Light,
    /// Factor of heights for light and shadow, not for colours and contour lines.
    pub vertical_exaggeration: f64,
    /// Standard deviation, in nodes, of a Gaussian that smooths the heights that are drawn: about
    /// 1 hides the steps of heights that are whole slabs of sand. 0 draws every height as it is.
    pub smoothing_nodes: f64,
    /// Width of a node in pixels; below 1 the picture is smaller than the field.
    pub pixels_per_node: f64,
    /// Whether the field continues at its other side.
    pub periodic: bool,
    /// Water at a level, or of the field's own depths; none is drawn when missing.
    pub water: Option<Water>,
}

impl ReliefOptions {
    /// A pixel a node under the light of maps, no exaggeration and no water.
    pub fn new(ground: Ground) -> Self {
        Self {
            ground,
            light: Light::map(),
            vertical_exaggeration: 1.0,
            smoothing_nodes: 0.0,
            pixels_per_node: 1.0,
            periodic: false,
            water: None,
        }
    }

    fn check(&self) -> Result<(), ViewError> {
        self.ground.check()?;
        self.light.check()?;
        let check = ViewError::check_option;
        let range = [1e-6, 1e6];
        check("vertical_exaggeration", self.vertical_exaggeration, range, "from 1e-6 to 1e6")?;
        check("smoothing_nodes", self.smoothing_nodes, [0.0, 100.0], "from 0 to 100 nodes")?;
        check("pixels_per_node", self.pixels_per_node, [1e-3, 64.0], "from 0.001 to 64")?;
        self.water.as_ref().map_or(Ok(()), Water::check)
    }
}

/// Draws the map of a field: colours by height under sun and sky with cast shadows.
///
/// ```
/// use landform_view::relief::{ReliefOptions, shaded_relief};
/// use landform_view::{ColourMap, Ground, HeightField};
///
/// let cone: Vec<f64> = (0..50 * 40)
///     .map(|i| (20.0 - f64::from(i % 50 - 25).hypot(f64::from(i / 50 - 20))).max(0.0))
///     .collect();
/// let field = HeightField::new(50, 40, 1.0, &cone)?;
/// let mut options = ReliefOptions::new(Ground::new(ColourMap::named("lajolla")?));
/// options.pixels_per_node = 2.0;
/// options.ground.contour_m = Some(5.0);
/// let map = shaded_relief(&field, &options)?;
/// assert_eq!((map.width, map.height), (100, 80));
/// # Ok::<(), landform_view::ViewError>(())
/// ```
///
/// The picture has `pixels_per_node` times the columns and rows of the field, rounded.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] or
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn shaded_relief(field: &HeightField<'_>, options: &ReliefOptions) -> Result<Image, ViewError> {
    options.check()?;
    let step = 1.0 / options.pixels_per_node;
    let size = [field.width(), field.height()].map(|nodes| (nodes as f64 / step).round() as usize);
    let origin = step / 2.0 - 0.5;
    let sampling = Sampling {
        size,
        origin,
        step,
        periodic: options.periodic,
        smoothing: options.smoothing_nodes,
        exaggeration: options.vertical_exaggeration,
    };
    let surface = Surface::sample(field, sampling)?;
    let mut colours = shade(&surface, &options.ground, &options.light);
    if let Some(water) = &options.water {
        water.cover(&surface, water.surface(field, sampling)?.as_ref(), &mut colours);
    }
    let [width, height] = size;
    let mut rgb = vec![[0; 3]; colours.len()];
    rgb.par_chunks_mut(width).zip(colours.par_chunks(width)).enumerate().for_each(
        |(row, (line, colours))| {
            for (column, (pixel, &colour)) in line.iter_mut().zip(colours).enumerate() {
                *pixel = quantise(shoulder(colour), column, row);
            }
        },
    );
    Ok(Image { width, height, rgb })
}
