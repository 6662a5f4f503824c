//! The network of a terrain, and the sites that it erodes.

use std::borrow::Cow;

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::{FlowDirections, fill_depressions};
use rayon::prelude::*;

use super::Pits;

/// A site that is lowered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Index of the site.
    pub site: usize,
    /// Height to which it is lowered, in metres.
    pub height: f64,
}

/// The surface that water flows over and where the water of each site goes: the terrain itself,
/// or with its lakes where rivers spill over the rims of pits.
///
/// # Errors
/// See [`GridError`].
pub fn drain<'a>(
    grid: &Grid,
    heights: &'a [f64],
    pits: Pits,
) -> Result<(Cow<'a, [f64]>, FlowDirections), GridError> {
    match pits {
        Pits::End => Ok((Cow::Borrowed(heights), FlowDirections::steepest(grid, heights)?)),
        Pits::Spill => {
            let filled = fill_depressions(grid, heights)?;
            let directions = FlowDirections::over_filled(grid, &filled)?;
            Ok((Cow::Owned(filled), directions))
        }
    }
}

/// The sites whose stress is above the threshold, by their index, with the heights at which it is
/// not: `z_next + d threshold / sqrt(A)`.
///
/// `surface` is what the water flows over, `cells` the number of cells that each site drains, as
/// [`FlowDirections::contributing_cells`] counts them. Sites whose water leaves the grid, or
/// stays, are stable, and so is the ground of a lake, whose surface is level.
pub fn unstable_sites(
    surface: &[f64],
    directions: &FlowDirections,
    cells: &[u32],
    threshold_m: f64,
) -> Vec<Event> {
    let grid = directions.grid();
    let lengths = grid.step_lengths();
    let event = |site: usize| {
        let [next, direction] = [directions.receiver(site)?, directions.direction(site)?.into()];
        let area = f64::from(cells[site]) * grid.cell_area();
        let height = surface[next] + lengths[direction] * threshold_m / area.sqrt();
        (surface[site] > height).then_some(Event { site, height })
    };
    (0..surface.len()).into_par_iter().filter_map(event).collect()
}
