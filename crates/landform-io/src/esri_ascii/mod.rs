//! ESRI ASCII grids: a header of key words, then the rows from north to south as text.
//!
//! Key words in any case and order: `ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner`
//! or `yllcenter`, `cellsize` (or `dx` and `dy`, as GDAL writes) and `nodata_value`. The
//! coordinate system comes from the sidecar, or the text of `NAME.prj` or `NAME.prj.txt`.

mod header;
mod read;
mod tokens;
mod write;

pub use read::read;
pub use write::write;
