//! Equations 4.4 and 4.6 of the thesis, integrated by explicit steps.

use landform_graph::Lattice;
use landform_graph::quadric::gradient_field;
use landform_sim::sums::sum;
use rayon::prelude::*;

use super::HydraulicErosion;
use crate::RiverError;
use crate::error::check_length;
use crate::frame::Frame;

/// What an iteration did to the bed: sums over nodes, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// What was eroded, uplift left out.
    pub eroded_m: f64,
    /// What diffusion raised nodes by, uplift left out.
    pub deposited_m: f64,
    /// Uplift.
    pub uplifted_m: f64,
}

/// Erodes `bed` (elevation, metres) for an iteration with flow `f` ([`super::flow_map`]); the nodes
/// of `fixed` keep their height, and those below the level of a sea. To the land around it the sea
/// is ground at its level.
///
/// # Errors
/// [`RiverError::Length`]; see [`HydraulicErosion::check`].
pub fn erode(
    lattice: &Lattice,
    settings: &HydraulicErosion,
    f: &[f64],
    bed: &mut [f64],
    fixed: &[usize],
) -> Result<Change, RiverError> {
    settings.check(lattice)?;
    check_length("bed", bed.len(), lattice.node_count())?;
    check_length("flow", f.len(), lattice.node_count())?;
    let before = bed.to_vec();
    let largest = f.par_iter().copied().reduce(|| 0.0, f64::max);
    let steps = settings.steps(lattice, largest);
    let sea = settings.sea_level_m;
    let at_sea = |node: &usize| sea.is_some_and(|sea| before[*node] < sea);
    let kept: Vec<usize> = fixed.iter().copied().chain((0..bed.len()).filter(at_sea)).collect();
    let cover = |bed: &mut [f64]| {
        if let Some(sea) = sea {
            bed.iter_mut().for_each(|height| *height = height.max(sea));
        }
    };
    let mut terms = Terms::new(lattice)?;
    cover(bed);
    for _ in 0..steps as usize {
        terms.step(lattice, settings, f, bed, 1.0 / steps);
        kept.iter().for_each(|&node| bed[node] = before[node]);
        cover(bed);
    }
    kept.iter().for_each(|&node| bed[node] = before[node]);
    Ok(Change::between(&before, bed, settings.uplift_m, &kept))
}

impl Change {
    /// What became of a bed under `uplift_m`, but at the nodes of `fixed`.
    pub(crate) fn between(before: &[f64], after: &[f64], uplift_m: f64, fixed: &[usize]) -> Self {
        let mut uplift = vec![uplift_m; before.len()];
        fixed.iter().for_each(|&node| uplift[node] = 0.0);
        let part = |sign: f64| {
            let parts = before.par_iter().zip(after).zip(&uplift);
            let part =
                parts.map(|((before, after), uplift)| (sign * (after - before - uplift)).max(0.0));
            sum(&part.collect::<Vec<f64>>())
        };
        Self { eroded_m: part(-1.0), deposited_m: part(1.0), uplifted_m: sum(&uplift) }
    }
}

/// What the equation needs of the heights around every node.
struct Terms {
    frame: Frame,
    /// Heights of before, framed.
    heights: Vec<f64>,
    east: Vec<f64>,
    north: Vec<f64>,
}

impl Terms {
    fn new(lattice: &Lattice) -> Result<Self, RiverError> {
        let frame = Frame::new(lattice)?;
        let [east, north] = [0; 2].map(|_| vec![0.0; lattice.node_count()]);
        Ok(Self { heights: vec![0.0; frame.len()], frame, east, north })
    }

    /// A step of length `dt` iterations.
    fn step(
        &mut self,
        lattice: &Lattice,
        settings: &HydraulicErosion,
        f: &[f64],
        bed: &mut [f64],
        dt: f64,
    ) {
        gradient_field(lattice, bed, &mut self.east, &mut self.north);
        let Self { frame, heights, east, north } = self;
        let (frame, width) = (&*frame, frame.width);
        let framed = frame.rows_of(heights).zip(bed.par_chunks_exact(width));
        framed.for_each(|(framed, row)| framed[1..=width].copy_from_slice(row));
        frame.extend(heights);
        let squared = lattice.spacing().powi(2);
        bed.par_chunks_exact_mut(width).enumerate().for_each(|(row, bed)| {
            for (column, height) in bed.iter_mut().enumerate() {
                let node = row * width + column;
                let around = frame.around(heights, (row + 1) * frame.stride + column + 1);
                let neighbours = &around[..frame.degree(row + 1, column + 1)];
                let lowest = neighbours.iter().copied().fold(f64::INFINITY, f64::min);
                let slope = (east[node] * east[node] + north[node] * north[node]).sqrt();
                let laplacian = compact_laplacian(*height, &around) / squared;
                *height += rise(settings, f[node], dt, [*height, lowest, slope, laplacian]);
            }
        });
    }
}

/// By how much equation 4.4 or 4.6 raises a node in a step of `dt` iterations where the flow is `f`:
/// height, lowest neighbour, slope and Laplacian are given.
#[inline]
pub(super) fn rise(
    settings: &HydraulicErosion,
    f: f64,
    dt: f64,
    [height, lowest, slope, laplacian]: [f64; 4],
) -> f64 {
    let diffusion = settings.diffusion_share(f) * settings.diffusion_m2 * laplacian;
    if height > lowest {
        let incision = f * (settings.incision_m * slope + settings.bed_erosion_m);
        ((diffusion - incision + settings.uplift_m) * dt).max(lowest - height)
    } else {
        (diffusion - f * settings.bed_erosion_m + settings.uplift_m) * dt
    }
}

/// The compact isotropic nine-point Laplacian, times the spacing squared, of a `height` and those
/// `around` it: along the axes first, then along the diagonals, each counter-clockwise.
///
/// ```text
/// 1/6 |1   4  1|
///     |4 -20  4|
///     |1   4  1|
/// ```
///
/// It damps every wave that the lattice holds, those of one node up and one down the most; a
/// quadric fitted to the same nodes would amplify these.
#[inline]
pub fn compact_laplacian(height: f64, around: &[f64; 8]) -> f64 {
    let [east, north, west, south, north_east, north_west, south_west, south_east] = around;
    let axes = (east + west) + (north + south);
    let diagonals = (north_east + south_west) + (north_west + south_east);
    (4.0 * axes + diagonals - 20.0 * height) / 6.0
}
