//! Cantor's set.

use super::check_level;
use crate::SynthError;

/// ln 2 / ln 3.
pub const CANTOR_DIMENSION: f64 = 0.630_929_753_571_457_4;

/// The intervals `[start, end]` that are left of 0 to 1 when the middle third of every interval
/// has been taken out `level` times, in order: `2^level` of them.
///
/// # Errors
/// [`SynthError::OutOfRange`] for levels above 20.
pub fn cantor_set(level: u32) -> Result<Vec<[f64; 2]>, SynthError> {
    check_level("cantor_set", level, 20)?;
    let mut intervals = vec![[0.0, 1.0]];
    for _ in 0..level {
        let thirds = |&[start, end]: &[f64; 2]| {
            let third = (end - start) / 3.0;
            [[start, start + third], [end - third, end]]
        };
        intervals = intervals.iter().flat_map(thirds).collect();
    }
    Ok(intervals)
}
