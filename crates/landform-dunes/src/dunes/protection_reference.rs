//! Protection by its definition: the readable reference of [`super::Protection`].

use landform_graph::Lattice;

use super::ProtectionSettings;
use super::cone::{Cone, covers};
use super::cone_sums::QUANTA;
use super::error::{DuneError, check_length};

/// The nodes that [`super::Protection`] shelters, by its definition: the readable reference.
///
/// Looks at every other node for each node, so use it on small lattices. The wind blows to
/// `towards_deg` and varies by `spread_deg` to either side. Heights count in the same
/// quanta, so the answer is the same to the bit.
///
/// # Errors
/// As [`super::Protection::new`] and [`super::Protection::update`].
pub fn protection_by_definition(
    lattice: &Lattice,
    surface: &[f64],
    settings: &ProtectionSettings,
    towards_deg: f64,
    spread_deg: f64,
) -> Result<Vec<bool>, DuneError> {
    check_length("surface", surface.len(), lattice.node_count())?;
    Cone::new(lattice, towards_deg, spread_deg, settings.reach_m)?;
    let reach = settings.reach_m / lattice.spacing();
    let most = reach.ceil() as isize;
    let quanta = |height: f64| (height * (QUANTA / lattice.spacing())).round_ties_even();
    let mean = surface.iter().map(|&height| quanta(height)).sum::<f64>() / surface.len() as f64;
    let protected = (0..lattice.node_count()).map(|node| {
        let (mut sum, mut count) = (0.0, 0.0);
        for row in -most..=most {
            for column in -most..=most {
                let displacement = [column, row];
                let inside =
                    covers(towards_deg.to_radians(), spread_deg.to_radians(), reach, displacement);
                let upwind = lattice.offset(lattice.coordinates(node), [-column, -row, 0]);
                if let (true, Some(upwind)) = (inside, upwind) {
                    sum += quanta(surface[upwind]);
                    count += 1.0;
                }
            }
        }
        let own = quanta(surface[node]);
        sum > count * (mean + settings.own_weight * (own - mean))
    });
    Ok(protected.collect())
}
