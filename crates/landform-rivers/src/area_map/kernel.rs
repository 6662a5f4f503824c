//! An iteration of equation 4.3.

use landform_analysis::grid::{Grid, GridError};
use landform_analysis::hydrology::{FlowDirections, fill_depressions};
use landform_graph::Lattice;
use rayon::prelude::*;

use super::AreaMapErosion;
use crate::RiverError;
use crate::erosion::{Change, compact_laplacian};
use crate::error::check_length;
use crate::frame::Frame;

/// What an iteration did.
#[derive(Clone, Debug, PartialEq)]
pub struct Evolved {
    /// Area that each node drained at its beginning, itself included, in m².
    pub area_m2: Vec<f64>,
    /// What became of the bed.
    pub change: Change,
}

/// Lets `bed` (elevation, metres) evolve for an iteration; the nodes of `fixed` keep their height.
///
/// # Errors
/// [`RiverError::Length`]; see [`AreaMapErosion::check`]; [`RiverError::LongStep`] also for slopes that
/// have become too steep for the step.
pub fn evolve(
    lattice: &Lattice,
    settings: &AreaMapErosion,
    bed: &mut [f64],
    fixed: &[usize],
) -> Result<Evolved, RiverError> {
    settings.check(lattice)?;
    check_length("bed", bed.len(), lattice.node_count())?;
    let streams = Streams::of(lattice, settings, bed).map_err(RiverError::Routing)?;
    let steps = settings.steps(lattice, streams.most_area_m2(), streams.steepest(bed))?;
    let dt = settings.step_yr / steps;
    let before = bed.to_vec();
    let frame = Frame::new(lattice)?;
    let mut heights = vec![0.0; frame.len()];
    for _ in 0..steps as usize {
        let framed = frame.rows_of(&mut heights).zip(bed.par_chunks_exact(frame.width));
        framed.for_each(|(framed, row)| framed[1..=frame.width].copy_from_slice(row));
        frame.extend(&mut heights);
        bed.par_iter_mut().enumerate().for_each(|(node, height)| {
            let at = frame.at(node);
            let laplacian = compact_laplacian(*height, &frame.around(&heights, at));
            let creep = settings.diffusivity_m2_per_yr * laplacian / lattice.spacing().powi(2);
            let cut = streams.incision(settings, &frame, &heights, node);
            *height += (creep - cut + settings.uplift_m_per_yr) * dt;
        });
        fixed.iter().for_each(|&node| bed[node] = before[node]);
    }
    let uplift_m = settings.uplift_m_per_yr * settings.step_yr;
    Ok(Evolved { change: Change::between(&before, bed, uplift_m, fixed), area_m2: streams.area_m2 })
}

/// Where water goes, and how much ground it drains.
struct Streams {
    /// Neighbour that takes the water of a node, and the distance to it; none where water leaves or
    /// stands.
    next: Vec<Option<(usize, f64)>>,
    area_m2: Vec<f64>,
    /// K A^m of each node.
    power: Vec<f64>,
}

impl Streams {
    fn of(lattice: &Lattice, settings: &AreaMapErosion, bed: &[f64]) -> Result<Self, GridError> {
        let spacing = lattice.spacing();
        let grid = Grid::new([lattice.width(), lattice.height()], [spacing; 2])?;
        let filled = fill_depressions(&grid, bed)?;
        let directions = FlowDirections::over_filled(&grid, &filled)?;
        let lengths = grid.step_lengths();
        let next = |node: usize| {
            let [next, direction] =
                [directions.receiver(node)?, directions.direction(node)?.into()];
            // Nothing is cut under the water of a lake.
            (filled[node] > filled[next] && filled[node] == bed[node])
                .then_some((next, lengths[direction]))
        };
        let cells = directions.contributing_cells();
        let area_m2: Vec<f64> =
            cells.iter().map(|&cells| f64::from(cells) * grid.cell_area()).collect();
        let power = |area: &f64| settings.erodibility_m_per_yr * area.powf(settings.area_exponent);
        Ok(Self {
            next: (0..bed.len()).map(next).collect(),
            power: area_m2.iter().map(power).collect(),
            area_m2,
        })
    }

    fn most_area_m2(&self) -> f64 {
        self.area_m2.iter().copied().fold(0.0, f64::max)
    }

    /// The steepest slope along a stream, 1 where there is none.
    fn steepest(&self, bed: &[f64]) -> f64 {
        let slopes = self.next.iter().zip(bed).filter_map(|(next, height)| {
            let (next, length) = (*next)?;
            Some((height - bed[next]) / length)
        });
        slopes.reduce(f64::max).unwrap_or(1.0)
    }

    /// Speed at which a stream cuts down at a node.
    fn incision(
        &self,
        settings: &AreaMapErosion,
        frame: &Frame,
        heights: &[f64],
        node: usize,
    ) -> f64 {
        let Some((next, length)) = self.next[node] else { return 0.0 };
        let slope = ((heights[frame.at(node)] - heights[frame.at(next)]) / length).max(0.0);
        let stress = self.power[node] * slope.powf(settings.slope_exponent);
        (stress - settings.erodibility_m_per_yr * settings.threshold).max(0.0)
    }
}
