//! A layer of a volume in flat colours.

use landform_graph::Lattice;
use landform_view::mark::Mark;
use landform_view::{Image, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Flat, Subject, marks};

/// What a slice lies across.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Across {
    /// The vertical: a map of a layer.
    #[default]
    Up,
    /// The way from south to north: a section seen from the south, west at its left.
    North,
    /// The way from west to east: a section seen from the east, south at its left.
    East,
}

/// A layer of voxels in colours by value, with a colour bar.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Slice {
    /// What it lies across.
    pub across: Across,
    /// Where: 0 at the lowest, southern or western voxels, 1 at those opposite.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f64,
    /// Name of the colour map.
    pub colours: String,
    /// Values of the first and the last colour; the range within the slice when missing.
    pub range: Option<(f64, f64)>,
    /// Width of a voxel in pixels.
    #[schemars(range(min = 1, max = 64))]
    pub pixels_per_node: usize,
    /// Whether a colour bar is drawn beside the slice.
    pub bar: bool,
    /// Whether sources and sinks of caves that lie in the slice, or a voxel beside it, are marked.
    pub marks: bool,
}

impl Default for Slice {
    fn default() -> Self {
        let Flat { colours, range, bar, .. } = Flat::default();
        Self { across: Across::Up, at: 0.5, colours, range, pixels_per_node: 6, bar, marks: true }
    }
}

impl Slice {
    /// Columns and rows of its picture in voxels.
    pub(super) fn size(&self, lattice: &Lattice) -> [usize; 2] {
        let [width, height, layers] = lattice.size();
        match self.across {
            Across::Up => [width, height],
            Across::North => [width, layers],
            Across::East => [height, layers],
        }
    }

    /// The values that it cuts, row by row from the top of its picture.
    pub(super) fn cut(&self, lattice: &Lattice, values: &[f64]) -> Vec<f64> {
        let [width, height, layers] = lattice.size();
        let nth = |count: usize| (self.at * (count - 1) as f64).round() as usize;
        let [columns, rows] = self.size(lattice);
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let voxel = |(column, row): (usize, usize)| match self.across {
            Across::Up => [column, row, nth(layers)],
            Across::North => [column, height - 1 - nth(height), layers - 1 - row],
            Across::East => [nth(width), height - 1 - column, layers - 1 - row],
        };
        places.map(|place| values[lattice.node(voxel(place))]).collect()
    }

    pub(super) fn draw(&self, lattice: &Lattice, subject: &Subject) -> Result<Image, ViewError> {
        let [columns, rows] = self.size(lattice);
        let values = self.cut(lattice, &subject.values);
        let mut image = self.flat().draw(&values, columns, rows, &subject.unit)?;
        let extent = [columns, rows].map(|voxels| (voxels * self.pixels_per_node) as f32);
        for (mark, at) in marks::of(&subject.places) {
            if let Some(place) = self.place(lattice, at) {
                draw_inside(mark, &mut image, place, extent);
            }
        }
        Ok(image)
    }

    /// Column and row in pixels of a place in metres, if the slice passes it.
    fn place(&self, lattice: &Lattice, at: [f64; 3]) -> Option<[f32; 2]> {
        let [width, height, layers] = lattice.size().map(|count| count as f64);
        let [x, y, z] = at.map(|at| at / lattice.spacing());
        let (column, row, depth, count) = match self.across {
            Across::Up => (x, height - y, z, layers),
            Across::North => (x, layers - z, y, height),
            Across::East => (y, layers - z, x, width),
        };
        let away = depth - 0.5 - (self.at * (count - 1.0)).round();
        (away.abs() <= 1.0)
            .then(|| [column, row].map(|voxels| (voxels * self.pixels_per_node as f64) as f32))
    }

    /// How the plane that it cuts is drawn.
    pub(super) fn flat(&self) -> Flat {
        Flat {
            colours: self.colours.clone(),
            range: self.range,
            pixels_per_node: self.pixels_per_node,
            bar: self.bar,
        }
    }
}

/// Draws a mark, moved to where it is whole.
fn draw_inside(mark: Mark, image: &mut Image, [column, row]: [f32; 2], extent: [f32; 2]) {
    let size = (extent[0].min(extent[1]) / 18.0).clamp(9.0, 22.0);
    let column = column.clamp(0.6 * size, (extent[0] - 0.6 * size).max(0.6 * size));
    let above = if mark == Mark::Source { 1.1 * size } else { 0.6 * size };
    let row = row.clamp(above, (extent[1] - 0.6 * size).max(above));
    mark.draw(image, [column, row], size);
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn slices_look_as_seen_from_above_from_the_south_and_from_the_east() {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([2, 3, 2], 1.0, Connectivity::Voxel6, open).unwrap();
        // Hundreds: column, tens: row from the north, ones: layer from below.
        let values: Vec<f64> = (0..12)
            .map(|node| {
                let [x, y, z] = lattice.coordinates(node);
                (100 * x + 10 * y + z) as f64
            })
            .collect();
        let cut = |across, at| Slice { across, at, ..Slice::default() }.cut(&lattice, &values);
        assert_eq!(cut(Across::Up, 1.0), [1.0, 101.0, 11.0, 111.0, 21.0, 121.0]);
        assert_eq!(cut(Across::North, 0.0), [21.0, 121.0, 20.0, 120.0]);
        assert_eq!(cut(Across::North, 1.0), [1.0, 101.0, 0.0, 100.0]);
        assert_eq!(cut(Across::East, 0.0), [21.0, 11.0, 1.0, 20.0, 10.0, 0.0]);
    }

    #[test]
    fn a_mark_stands_where_the_slice_passes_its_place() {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([4, 6, 3], 2.0, Connectivity::Voxel6, open).unwrap();
        let place = |across, at, point| {
            Slice { across, at, pixels_per_node: 10, ..Slice::default() }.place(&lattice, point)
        };
        let point = [3.0, 3.0, 5.0];
        assert_eq!(place(Across::Up, 1.0, point), Some([15.0, 45.0]));
        assert_eq!(place(Across::Up, 0.0, point), None);
        assert_eq!(place(Across::North, 0.0, point), Some([15.0, 5.0]));
        assert_eq!(place(Across::East, 0.5, point), Some([15.0, 5.0]));
    }
}
