//! Plots: panels with axes, points, lines and error bars, as PNG and as SVG.
//!
//! Below the series of a panel may lie a [`Picture`], such as a map with its [`ColourScale`].
//!
//! A [`Figure`] is data; [`Figure::image`] and [`Figure::svg`] draw the same shapes, so both files
//! show the same. Axes are linear or logarithmic, series differ by colour and by marker, and the
//! colours can be told apart by the colour-blind (Okabe and Ito 2008). The bytes do not depend on
//! the machine's fonts or threads: letters in the PNG are those of the embedded font.
//!
//! ```
//! use landform_view::plot::{Axis, Figure, Line, Panel, Point, Series};
//!
//! let spectrum: Vec<Point> =
//!     (1..64).map(|k| Point::new(f64::from(k), f64::from(k).powf(-1.8))).collect();
//! let panel = Panel {
//!     x: Axis::log("wavenumber (1/m)"),
//!     y: Axis::log("density (m³)"),
//!     series: vec![Series { line: Some(Line::Solid), ..Series::new("slope 1.8", spectrum) }],
//!     ..Panel::default()
//! };
//! let figure = Figure { panels: vec![panel], ..Figure::default() };
//! assert!(figure.svg()?.contains("wavenumber"));
//! assert_eq!(figure.image()?.width, 960);
//! # Ok::<(), landform_view::ViewError>(())
//! ```

mod axes;
mod axis;
mod base64;
pub(crate) mod drawing;
mod figure;
mod label;
mod layout;
mod legend;
mod marks;
mod picture;
mod raster;
mod series;
mod svg;
mod ticks;

pub use axis::{Axis, Scale};
pub use figure::{Figure, Panel};
pub use label::label;
pub use picture::{ColourScale, Picture};
pub use series::{Area, Line, Marker, Note, Point, Rule, Series};
