//! How much a file may claim before it is refused.

use std::path::Path;

use crate::IoError;

/// Bounds that are checked before memory is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadLimits {
    /// Largest number of cells of a raster or array.
    pub max_cells: u64,
}

impl Default for ReadLimits {
    /// 2^28 cells: 16384 x 16384, 2 GiB of f64.
    fn default() -> Self {
        Self { max_cells: 1 << 28 }
    }
}

impl ReadLimits {
    /// The number of cells of an array of `shape`, if it is within the limit.
    ///
    /// # Errors
    /// [`IoError::TooLarge`], also when the product overflows.
    pub fn cells(&self, path: &Path, shape: &[u64]) -> Result<usize, IoError> {
        let product = shape.iter().try_fold(1_u64, |cells, &size| cells.checked_mul(size));
        product
            .filter(|&cells| cells <= self.max_cells)
            .and_then(|cells| usize::try_from(cells).ok())
            .ok_or_else(|| IoError::TooLarge {
                path: path.into(),
                size: shape.iter().map(u64::to_string).collect::<Vec<_>>().join(" x "),
                limit: self.max_cells,
            })
    }
}
