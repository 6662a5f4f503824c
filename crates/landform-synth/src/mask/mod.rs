//! Masks: regions of the plane, from polygons and pictures.

mod outline;
mod picture;
mod raster_ground;
mod source;
#[cfg(test)]
mod tests;

use std::path::Path;

use landform_graph::Lattice;
use landform_sim::initial::{InitialCondition, InitialContext};
use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use raster_ground::RasterGround;
pub use source::{KnownFractal, MaskSource};

use crate::error::Checks;
use crate::place::fill_by_tiles;
use crate::scenario::refusal;
use crate::{Generator, SynthError};
use outline::Outline;
use picture::Picture;

/// Name of the generator in messages.
const NAME: &str = "Mask";

/// Most pixels of a picture: half a gibibyte of numbers.
pub(crate) const MOST_PIXELS: usize = 1 << 26;

/// One value inside a region and another outside: polygons (even-odd: what lies within two rings
/// is outside again) whose edges are smooth over `edge_m`, or a picture, whose
/// least value is outside and whose greatest is inside, with straight lines between the middles
/// of pixels.
///
/// As an initial condition it fills a field; in a [`crate::ConstructionTree`] it is a height, or
/// what weights are multiplied with.
///
/// # Limits
/// At most 100 000 points, and pictures of 67 million pixels. In volumes all layers are alike. On periodic axes polygons must not
/// reach beyond the lattice, and pictures must have its size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mask {
    /// The region.
    pub of: MaskSource,
    /// Value outside, or of the least value of a picture.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub outside: f64,
    /// Value inside, or of the greatest value of a picture.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub inside: f64,
    /// Width of the border over which polygons change from one to the other; the spacing of the
    /// lattice when missing.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub edge_m: Option<f64>,
    /// Where the region's own 0, 0 lies: east and north of the south-western node. Pictures, and
    /// lines in longitude and latitude, have it at their south-western corner.
    #[schemars(inner(range(min = -1e12, max = 1e12)), extend("x-unit" = "m"))]
    pub at_m: [f64; 2],
    /// Factor of lengths: metres in a unit of the polygons' coordinates. A pixel of a picture is
    /// as wide as the spacing times this.
    #[schemars(range(min = 1e-9, max = 1e9))]
    pub scale: f64,
}

impl Default for Mask {
    fn default() -> Self {
        Self {
            of: MaskSource::default(),
            outside: 0.0,
            inside: 1.0,
            edge_m: None,
            at_m: [0.0; 2],
            scale: 1.0,
        }
    }
}

/// A mask made ready.
#[derive(Debug)]
pub(crate) struct MaskSurface {
    shape: Shape,
    outside: f64,
    inside: f64,
}

#[derive(Debug)]
enum Shape {
    Outline(Outline),
    Picture(Box<Picture>),
}

impl MaskSurface {
    /// Reads what there is to read, relative to `folder`, for nodes `spacing` metres apart.
    pub fn new(mask: &Mask, folder: &Path, spacing: f64) -> Result<Self, SynthError> {
        let checks = Checks(NAME);
        checks.elevation("outside", mask.outside)?;
        checks.elevation("inside", mask.inside)?;
        checks.place("at_m", mask.at_m)?;
        checks.range("scale", mask.scale, 1e-9..=1e9)?;
        let edge = mask.edge_m.unwrap_or(spacing);
        checks.length("edge_m", edge, 1e-6_f64.min(spacing))?;
        let shape = match mask.of.rings(folder)? {
            Some(rings) => Shape::Outline(Outline::new(&rings, mask.at_m, mask.scale, edge)?),
            None => {
                let pixel = spacing * mask.scale;
                Shape::Picture(Box::new(Picture::read(&mask.of, folder, mask.at_m, pixel)?))
            }
        };
        Ok(Self { shape, outside: mask.outside, inside: mask.inside })
    }

    /// Number of points of polygons, and of pixels.
    pub fn parts(&self) -> [usize; 2] {
        match &self.shape {
            Shape::Outline(outline) => [outline.points(), 0],
            Shape::Picture(picture) => [0, picture.size()[0] * picture.size()[1]],
        }
    }

    /// Value at a point in metres.
    pub fn at(&self, point: [f64; 2]) -> f64 {
        let share = match &self.shape {
            Shape::Outline(outline) => outline.share(point),
            Shape::Picture(picture) => picture.share(point),
        };
        self.outside + share * (self.inside - self.outside)
    }

    /// Least and greatest value.
    pub fn range(&self) -> [f64; 2] {
        [self.outside.min(self.inside), self.outside.max(self.inside)]
    }

    /// Largest change a metre.
    pub fn slope(&self) -> f64 {
        let slope = match &self.shape {
            Shape::Outline(outline) => outline.slope(),
            Shape::Picture(picture) => picture.slope(),
        };
        slope * (self.inside - self.outside).abs()
    }
}

impl Mask {
    /// One value a node. Relative paths are relative to `folder`.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range, a file cannot be read, or the mask does
    /// not close on a periodic axis.
    pub fn values_from(&self, folder: &Path, lattice: &Lattice) -> Result<Vec<f64>, SynthError> {
        let surface = MaskSurface::new(self, folder, lattice.spacing())?;
        for (axis, name) in ['x', 'y'].into_iter().enumerate() {
            let extent = lattice.size()[axis] as f64 * lattice.spacing();
            let closes = match &surface.shape {
                Shape::Outline(outline) => outline.is_within(axis, extent),
                Shape::Picture(picture) => {
                    picture.size() == [lattice.width(), lattice.height()] && self.scale == 1.0
                }
            };
            if lattice.is_periodic(axis) && !closes {
                let remedy = "keep polygons within the lattice, give pictures its size, or make \
                              the axis open";
                return Err(SynthError::DoesNotClose { generator: NAME, axis: name, remedy });
            }
        }
        let fill = |(): &mut (), points: &mut [[f64; 2]], values: &mut [f64]| {
            values.iter_mut().zip(points).for_each(|(value, point)| *value = surface.at(*point));
        };
        let mut values = fill_by_tiles(lattice, |_| (), fill);
        // The positions are those of the lowest layer.
        values.truncate(lattice.width() * lattice.height());
        Ok(values.repeat(lattice.depth()))
    }
}

impl Generator for Mask {
    fn generate(&self, lattice: &Lattice, _seed: u64) -> Result<Vec<f64>, SynthError> {
        self.values_from(Path::new(""), lattice)
    }
}

impl InitialCondition for Mask {
    const NAME: &'static str = NAME;

    fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
        self.values_from(context.folder, &context.domain.lattice).map_err(refusal)
    }
}
