//! Figures: panels in rows.

use std::io::Write;
use std::path::Path;

use super::axis::Axis;
use super::drawing::Drawing;
use super::layout;
use super::picture::{ColourScale, Picture};
use super::series::{Area, Note, Rule, Series};
use crate::atomic_file::{AtomicFile, write_error};
use crate::{Image, ViewError};

/// One plot of a figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Words above it.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Filled areas below everything but a picture, the first below the others.
    pub areas: Vec<Area>,
    /// What is drawn, the first below the others.
    pub series: Vec<Series>,
    /// Rules behind the series.
    pub rules: Vec<Rule>,
    /// Words in the plot.
    pub notes: Vec<Note>,
    /// A picture below everything else.
    pub picture: Option<Picture>,
    /// What the colours of the picture mean.
    pub colours: Option<ColourScale>,
    /// Words below the plot.
    pub caption: String,
    /// How many times as long a unit of the vertical axis is as one of the horizontal axis: 1 on a
    /// map, more in a section whose heights are exaggerated. Without it the plot fills its room.
    pub exaggeration: Option<f64>,
    /// Whether the axes are left out, as round a view.
    pub bare: bool,
}

/// Panels of one size, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Words above all panels.
    pub title: String,
    /// The panels.
    pub panels: Vec<Panel>,
    /// Panels in a row, at most.
    pub columns: usize,
    /// Width and height of a panel with its axes, in the units of the SVG.
    pub panel_size: [f64; 2],
    /// Pixels of the PNG for each unit.
    pub pixels_per_unit: f64,
}

impl Default for Figure {
    fn default() -> Self {
        Self {
            title: String::new(),
            panels: Vec::new(),
            columns: 2,
            panel_size: [480.0, 340.0],
            pixels_per_unit: 2.0,
        }
    }
}

impl Figure {
    /// Draws the figure into a picture.
    ///
    /// # Errors
    /// [`ViewError::Option`] for sizes out of range, [`ViewError::TooSmall`] without a panel,
    /// [`ViewError::TooLarge`] for more pixels than a picture may have.
    pub fn image(&self) -> Result<Image, ViewError> {
        self.drawing()?.image(self.pixels_per_unit as f32)
    }

    /// The figure as the text of an SVG file.
    ///
    /// # Errors
    /// As [`Figure::image`].
    pub fn svg(&self) -> Result<String, ViewError> {
        Ok(self.drawing()?.svg())
    }

    /// Writes the figure into a `.png` or `.svg` file, beside its place and then renamed. A PNG
    /// file takes text entries, as [`Image::write_png`] does.
    ///
    /// # Errors
    /// As [`Figure::image`]; [`ViewError::UnknownFormat`] for other endings, [`ViewError::File`]
    /// when the file cannot be written.
    pub fn write(&self, path: &Path, text: &[(&str, &str)]) -> Result<(), ViewError> {
        let ends = |ending: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        if ends("png") {
            return self.image()?.write_png(path, text);
        }
        if !ends("svg") {
            return Err(ViewError::UnknownFormat { path: path.into(), expected: ".png or .svg" });
        }
        let drawn = self.svg()?;
        let (guard, mut file) = AtomicFile::create(path)?;
        let written = file.write_all(drawn.as_bytes()).and_then(|()| file.flush());
        written.map_err(|source| write_error(path, source))?;
        guard.finish()
    }

    fn drawing(&self) -> Result<Drawing, ViewError> {
        let [width, height] = self.panel_size;
        let size = "from 100 to 10000";
        ViewError::check_option("panel_size[0]", width, [100.0, 10_000.0], size)?;
        ViewError::check_option("panel_size[1]", height, [100.0, 10_000.0], size)?;
        let scale = "from 0.25 to 16";
        ViewError::check_option("pixels_per_unit", self.pixels_per_unit, [0.25, 16.0], scale)?;
        if self.panels.is_empty() || self.columns == 0 {
            return Err(ViewError::TooSmall {
                what: "a figure",
                width: self.columns,
                height: self.panels.len(),
                least: 1,
            });
        }
        Ok(layout::draw(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_needs_a_panel_and_sizes_in_range() {
        let empty = Figure::default();
        assert!(matches!(empty.image(), Err(ViewError::TooSmall { .. })));
        let good = Figure { panels: vec![Panel::default()], ..Figure::default() };
        assert!(good.svg().is_ok());
        for bad in [
            Figure { panel_size: [f64::NAN, 100.0], ..good.clone() },
            Figure { panel_size: [100.0, 1e9], ..good.clone() },
            Figure { pixels_per_unit: 0.0, ..good.clone() },
        ] {
            assert!(matches!(bad.svg(), Err(ViewError::Option { .. })));
        }
        let huge = Figure { panels: vec![Panel::default(); 5000], ..good };
        assert!(matches!(huge.image(), Err(ViewError::TooLarge { .. })));
    }

    #[test]
    fn files_are_told_by_their_ending() {
        let figure = Figure { panels: vec![Panel::default()], ..Figure::default() };
        let refused = figure.write(Path::new("plot.pdf"), &[]);
        assert!(matches!(refused, Err(ViewError::UnknownFormat { .. })));
        assert!(!Path::new("plot.pdf").exists());
    }
}
