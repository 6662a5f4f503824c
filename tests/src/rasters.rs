//! Synthetic rasters, for scenarios that start from one.

use std::path::Path;

use landform::io::{IfExists, Metadata, Raster, write_raster};

/// Hills of 100 m on a slope of 2 degrees, on cells of 30 m: every height is finite, no two
/// rows are alike and nothing is periodic.
pub fn hills(width: usize, height: usize) -> Raster {
    let elevation = |cell: usize| {
        let (column, row) = ((cell % width) as f64, (cell / width) as f64);
        300.0
            + 1.05 * column
            + 50.0 * (column / 7.0).sin()
            + 50.0 * (row / 5.0 + 0.1 * column).cos()
    };
    Raster::local(width, height, 30.0, (0..width * height).map(elevation).collect())
}

/// Writes [`hills`] into a file whose extension names the format.
pub fn write_hills(path: &Path, width: usize, height: usize) {
    let metadata = Metadata { unit: Some("m".to_owned()), ..Metadata::default() };
    write_raster(path, &hills(width, height), &metadata, IfExists::Replace)
        .expect("a raster can be written");
}

/// Writes the shore of a round island and of a smaller one beside it, in metres.
pub fn write_shore(path: &Path) {
    let mut text = "line,x,y\n".to_owned();
    for (number, [east, radius]) in [[0.0, 900.0], [1300.0, 250.0]].into_iter().enumerate() {
        for step in 0..72 {
            let angle = f64::from(step) * std::f64::consts::TAU / 72.0;
            let reach = radius * (1.0 + 0.2 * (5.0 * angle).sin());
            let [x, y] = [east + reach * angle.cos(), reach * angle.sin()];
            text += &format!("{number},{x:?},{y:?}\n");
        }
    }
    std::fs::write(path, text).expect("a shore can be written");
}
