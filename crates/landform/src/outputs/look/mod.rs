//! How a field is drawn: as a map under light, in perspective, as flat colours, as a slice or
//! a body or a cloud of a volume, as the map of a cave or a cave from inside, as a spectrum, as a hypsometric curve, as a section.

mod cave_interior;
mod cave_map;
mod cloud;
mod flat;
mod gaps;
mod hypsometry;
mod marks;
mod passage_body;
mod passages;
mod perspective;
mod profile;
mod relief;
mod section;
mod slice;
mod standpoint;
mod subject;
mod text;

pub use cave_interior::{CaveInterior, CaveLamp, CaveRock, CaveWater};
pub use cave_map::{CaveMap, CaveMapView};
pub use cloud::{Cloud, CloudOpacity};
pub use flat::{Density, DensityAxes, Flat};
pub use hypsometry::Curve;
pub use passages::Passages;
pub use perspective::Perspective;
pub use relief::Relief;
pub use section::Section;
pub use slice::Slice;
pub use subject::WaterDepths;

pub(crate) use subject::{Subject, water_of};
pub(crate) use text::{picture_text, problem, write_picture};

use landform_graph::Lattice;
use landform_sim::code::Code;
use landform_sim::parameters::Problem;
use landform_view::plot::Figure;
use landform_view::relief::shaded_relief;
use landform_view::{ColourMap, Ground, HeightField, Image, MOST_PIXELS, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a field is drawn.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub enum Look {
    /// A map of heights under sun and sky, with cast shadows.
    Relief(Relief),
    /// A view from a camera.
    Perspective(Perspective),
    /// Colours by value, without light.
    Flat(Flat),
    /// A layer of a volume in colours by value.
    Slice(Slice),
    /// The voxels of at least a value as a body in perspective.
    Passages(Passages),
    /// The voxels of at least a value as a map of a cave: plan and elevations.
    CaveMap(CaveMap),
    /// The voxels of at least a value as a cave from inside, in the light of a lamp.
    CaveInterior(CaveInterior),
    /// The values of a volume as a translucent cloud.
    Cloud(Cloud),
    /// The spectral density of the field.
    Spectrum(Density),
    /// The hypsometric curve of the field.
    Hypsometry(Curve),
    /// Ground and water along a line across the map.
    Section(Section),
}

impl Default for Look {
    fn default() -> Self {
        Self::Relief(Relief::default())
    }
}

impl Look {
    /// Draws what it shows of a field of `lattice`.
    pub(crate) fn draw(&self, lattice: &Lattice, subject: &Subject) -> Result<Image, ViewError> {
        match self {
            Self::Slice(slice) => return slice.draw(lattice, subject),
            Self::Passages(passages) => return passages.draw(lattice, subject),
            Self::CaveMap(map) => return map.draw(lattice, subject),
            Self::CaveInterior(inside) => return inside.draw(lattice, subject),
            Self::Cloud(cloud) => return cloud.draw(lattice, subject),
            _ => {}
        }
        let size = [lattice.width(), lattice.height()];
        let periodic = lattice.is_periodic(0) && lattice.is_periodic(1);
        self.picture(size, lattice.spacing(), periodic, subject)
    }

    fn picture(
        &self,
        [width, height]: [usize; 2],
        spacing_m: f64,
        periodic: bool,
        subject: &Subject,
    ) -> Result<Image, ViewError> {
        let Subject { values, outside, .. } = subject;
        let field = |values| {
            let bare = HeightField::new(width, height, spacing_m, values)?;
            subject.water.as_deref().map_or(Ok(bare), |depths| bare.with_water(depths))
        };
        match self {
            Self::Relief(relief) => {
                let mut map = shaded_relief(&field(values)?, &relief.options(periodic)?)?;
                gaps::paint(outside, [width, height], &mut map);
                Ok(map)
            }
            Self::Perspective(view) => {
                let cut = gaps::cut_off(outside, values);
                landform_view::perspective::render(&field(&cut)?, &view.options()?)
            }
            Self::Flat(flat) => {
                flat.draw(&gaps::blank(outside, values), width, height, &subject.unit)
            }
            // Of a plane there is but one.
            Self::Slice(slice) => slice.flat().draw(values, width, height, &subject.unit),
            Self::Passages(passages) => passages.trial(),
            Self::CaveMap(map) => map.trial(),
            Self::CaveInterior(inside) => inside.trial(),
            Self::Cloud(cloud) => cloud.trial(),
            Self::Spectrum(density) => density.draw(values, [width, height]),
            Self::Hypsometry(curve) => curve.figure(values).image(),
            Self::Section(section) => section.figure([width, height], spacing_m, subject)?.image(),
        }
    }

    /// The plot that it draws of a field of `lattice`; none for looks that are no plots.
    pub(crate) fn figure(
        &self,
        lattice: &Lattice,
        subject: &Subject,
    ) -> Option<Result<Figure, ViewError>> {
        match self {
            Self::Hypsometry(curve) => Some(Ok(curve.figure(&subject.values))),
            Self::Section(section) => {
                let size = [lattice.width(), lattice.height()];
                Some(section.figure(size, lattice.spacing(), subject))
            }
            Self::Relief(_)
            | Self::Perspective(_)
            | Self::Flat(_)
            | Self::Slice(_)
            | Self::Passages(_)
            | Self::CaveMap(_)
            | Self::CaveInterior(_)
            | Self::Cloud(_)
            | Self::Spectrum(_) => None,
        }
    }

    /// Whether it is a plot, which can be written as SVG.
    pub(crate) fn is_plot(&self) -> bool {
        matches!(self, Self::Hypsometry(_) | Self::Section(_))
    }

    /// The field of water depths that it draws over heights.
    pub(crate) fn water(&self) -> Option<&WaterDepths> {
        match self {
            Self::Relief(relief) => relief.water.as_ref(),
            Self::Perspective(view) => view.water.as_ref(),
            Self::Section(section) => section.water.as_ref(),
            Self::Flat(_)
            | Self::Slice(_)
            | Self::Passages(_)
            | Self::CaveMap(_)
            | Self::CaveInterior(_)
            | Self::Cloud(_)
            | Self::Spectrum(_)
            | Self::Hypsometry(_) => None,
        }
    }

    /// Names of the fields that it draws when it shows `field`.
    pub(crate) fn fields(&self, field: &str) -> Vec<String> {
        let water = self.water().map(|water| water.field.clone());
        let paint = self.paint().map(str::to_owned);
        [field.to_owned()].into_iter().chain(water).chain(paint).collect()
    }

    /// The field by which it colours passages, if it is another one.
    pub(crate) fn paint(&self) -> Option<&str> {
        match self {
            Self::Passages(passages) => passages.colour_by.as_deref(),
            _ => None,
        }
    }

    /// Whether it marks where water comes in and goes out of caves.
    pub(crate) fn has_marks(&self) -> bool {
        match self {
            Self::Passages(passages) => passages.marks,
            Self::Slice(slice) => slice.marks,
            Self::CaveMap(map) => map.marks,
            Self::Cloud(cloud) => cloud.marks,
            _ => false,
        }
    }

    /// What the picture says in numbers, for looks that measure: RMS and R2 of a spectrum, as
    /// the thesis prints them below its plots, the hypsometric integral and stage, or the
    /// exaggeration of a section.
    pub(crate) fn numbers(&self, lattice: &Lattice, values: &[f64]) -> Option<String> {
        match self {
            Self::Spectrum(_) => Density::numbers(values, [lattice.width(), lattice.height()]),
            Self::Hypsometry(_) => Curve::numbers(values),
            Self::Section(section) => {
                section.numbers([lattice.width(), lattice.height()], lattice.spacing(), values)
            }
            Self::Relief(_)
            | Self::Perspective(_)
            | Self::Flat(_)
            | Self::Slice(_)
            | Self::Passages(_)
            | Self::CaveMap(_)
            | Self::CaveInterior(_)
            | Self::Cloud(_) => None,
        }
    }

    /// Refuses what cannot be drawn of any field of `lattice`.
    pub(crate) fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let nodes = [lattice.width() as f64, lattice.height() as f64];
        let [width, height] = match self {
            Self::Relief(relief) => nodes.map(|nodes| nodes * relief.pixels_per_node),
            Self::Perspective(view) => <[usize; 2]>::from(view.size).map(|size| size as f64),
            Self::Passages(passages) => <[usize; 2]>::from(passages.size).map(|size| size as f64),
            Self::Cloud(cloud) => <[usize; 2]>::from(cloud.size).map(|size| size as f64),
            Self::CaveMap(map) => map.samples(lattice),
            Self::CaveInterior(inside) => <[usize; 2]>::from(inside.size).map(|size| size as f64),
            Self::Slice(slice) => {
                slice.size(lattice).map(|voxels| (voxels * slice.pixels_per_node) as f64)
            }
            Self::Hypsometry(Curve { size }) | Self::Section(Section { size, .. }) => {
                <[usize; 2]>::from(*size).map(|size| size as f64)
            }
            Self::Flat(Flat { pixels_per_node, .. })
            | Self::Spectrum(Density { pixels_per_node, .. }) => {
                nodes.map(|nodes| nodes * *pixels_per_node as f64)
            }
        };
        let pixels = width * height;
        if !(1.0..=MOST_PIXELS as f64).contains(&pixels) {
            let message = format!("the picture would have {width:.0} x {height:.0} pixels");
            return Err(Problem::new("look", message, format!("from 1 to {MOST_PIXELS} pixels")));
        }
        let layers = lattice.depth();
        let of_volumes = matches!(
            self,
            Self::Slice(_)
                | Self::Passages(_)
                | Self::CaveMap(_)
                | Self::CaveInterior(_)
                | Self::Cloud(_)
        );
        if layers > 1 && !of_volumes {
            let message = format!("the domain has {layers} layers, and the look shows a map");
            return Err(Problem::new(
                "look",
                message,
                "the look Slice, which shows one of them, Passages, CaveMap, CaveInterior or Cloud",
            ));
        }
        match self {
            Self::Section(section) => section.check()?,
            Self::Passages(passages) => passages.check()?,
            _ => {}
        }
        let heights = matches!(self, Self::Relief(_) | Self::Perspective(_) | Self::Section(_));
        if heights && lattice.width().min(lattice.height()) < 2 {
            let message = format!("{} x {} nodes span no surface", nodes[0], nodes[1]);
            return Err(Problem::new("look", message, "at least 2 x 2 nodes, or the look Flat"));
        }
        let refuse =
            |error: ViewError| Problem::new("look", error.to_string(), "").code(Code::Picture);
        self.trial().map(|_| ()).map_err(refuse)
    }

    /// A tiny picture with all the settings, for what only drawing finds wrong.
    fn trial(&self) -> Result<Image, ViewError> {
        const SIDE: usize = 4;
        let mut small = self.clone();
        if let Self::Perspective(view) = &mut small {
            view.size = (SIDE, SIDE);
        }
        let flat = vec![0.0; SIDE * SIDE];
        let subject = Subject { water: Some(flat.clone()), values: flat, ..Subject::default() };
        small.picture([SIDE, SIDE], 1.0, false, &subject)
    }

    /// The values of the first and the last colour, when they are given.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        match self {
            Self::Relief(relief) => relief.range_m,
            Self::Perspective(view) => view.range_m,
            Self::Flat(flat) => flat.range,
            Self::Slice(slice) => slice.range,
            Self::Cloud(cloud) => cloud.range,
            Self::Section(section) => section.range_m,
            Self::Passages(_)
            | Self::CaveMap(_)
            | Self::CaveInterior(_)
            | Self::Spectrum(_)
            | Self::Hypsometry(_) => None,
        }
    }

    /// The same look with colours over a given range.
    pub(crate) fn with_range(mut self, range: (f64, f64)) -> Self {
        match &mut self {
            Self::Relief(relief) => relief.range_m = Some(range),
            Self::Perspective(view) => view.range_m = Some(range),
            Self::Flat(flat) => flat.range = Some(range),
            Self::Slice(slice) => slice.range = Some(range),
            Self::Cloud(cloud) => cloud.range = Some(range),
            Self::Section(section) => section.range_m = Some(range),
            Self::Passages(_)
            | Self::CaveMap(_)
            | Self::CaveInterior(_)
            | Self::Spectrum(_)
            | Self::Hypsometry(_) => {}
        }
        self
    }
}

pub(super) fn ground(colours: &str, range_m: Option<(f64, f64)>) -> Result<Ground, ViewError> {
    let range_m = range_m.map(|(low, high)| [low, high]);
    Ok(Ground { range_m, ..Ground::new(ColourMap::named(colours)?) })
}
