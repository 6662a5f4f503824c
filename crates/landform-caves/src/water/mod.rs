//! Water in the pores of rock (thesis, listing 5.3 and section 5.1).
//!
//! [`PoreWater`] holds what voxels contain, in whole units, so that nothing is lost; what they have
//! room for follows from their porosity ([`Pores`]). [`PoreWater::sweep`] lets all wet voxels offer water to their neighbours at the
//! same moment by a [`Rule`]: [`DownPressure`] to those of lower pressure, [`Falling`] to those below.
//! A voxel that is offered more than it has room for takes the same part of every offer. Listing 5.3
//! updates voxel after voxel, so that its result hangs on their order; here no order can matter, and
//! symmetric rock keeps water symmetric, bit for bit.
//!
//! Pores hold a film: less than [`FILM`] of a voxel's volume does not move, so that thin water does not
//! creep through all the rock.

mod falling;
mod pool;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;

pub use falling::Falling;
pub use pool::{FILM, PoreWater, Pores, UNIT};

use landform_graph::Lattice;

/// Who is offered how much of a voxel's water.
pub trait Rule {
    /// Adds to `offers` what the voxel `node` offers, pairs of a neighbour and units: no more in all
    /// than it contains, to nobody more than it has room for.
    fn offer(
        &self,
        lattice: &Lattice,
        pores: &Pores<'_>,
        node: usize,
        offers: &mut Vec<(u32, u32)>,
    );

    /// Whether water could come from voxel `from` to its neighbour `to`.
    fn leads(&self, lattice: &Lattice, from: usize, to: usize) -> bool;
}

/// Water goes to neighbours of lower pressure that have room (thesis, listing 5.3).
///
/// A neighbour is offered its room times a weight: the difference of pressure, to the power `exponent`,
/// as a share of all such differences. When that is more than there is, all offers are reduced alike.
#[derive(Clone, Copy, Debug)]
pub struct DownPressure<'a> {
    /// Pressure of every voxel.
    pub pressure: &'a [f64],
    /// 1 weighs by the difference; more makes water keep to the steepest ways.
    pub exponent: u32,
}

impl Rule for DownPressure<'_> {
    fn offer(
        &self,
        lattice: &Lattice,
        pores: &Pores<'_>,
        node: usize,
        offers: &mut Vec<(u32, u32)>,
    ) {
        let here = self.pressure[node];
        let mut weights = [0.0; 26];
        let first = offers.len();
        let mut largest = 0.0_f64;
        for edge in lattice.neighbours(node) {
            let difference = here - self.pressure[edge.node];
            if difference > 0.0 {
                let room = pores.room(edge.node);
                if room > 0 {
                    weights[offers.len() - first] = difference;
                    largest = largest.max(difference);
                    offers.push((edge.node as u32, room));
                }
            }
        }
        let offers = &mut offers[first..];
        let weights = &mut weights[..offers.len()];
        let exponent = self.exponent as i32;
        weights.iter_mut().for_each(|weight| *weight = (*weight / largest).powi(exponent));
        let sum: f64 = weights.iter().sum();
        for ((_, amount), weight) in offers.iter_mut().zip(weights) {
            *amount = (f64::from(*amount) * (*weight / sum)) as u32;
        }
        reduce(offers, pores.contents(node));
    }

    #[inline]
    fn leads(&self, _: &Lattice, from: usize, to: usize) -> bool {
        self.pressure[from] > self.pressure[to]
    }
}

/// Reduces all offers alike until they add up to no more than `most`.
fn reduce(offers: &mut [(u32, u32)], most: u32) {
    let all: u64 = offers.iter().map(|offer| u64::from(offer.1)).sum();
    if all > u64::from(most) {
        for (_, amount) in offers {
            *amount = (u64::from(*amount) * u64::from(most) / all) as u32;
        }
    }
}
