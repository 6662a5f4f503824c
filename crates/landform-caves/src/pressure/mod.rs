//! Pressure in rock and in channels (thesis, section 5.2.2, figure 5.4).
//!
//! Pressure rises with the thickness of rock that water has to pass, and hardly in channels; where
//! it would rise more steeply, water is forced out of the pores until it does not. When erosion opens a
//! channel, pressure falls there and, like an avalanche, around it:
//!
//! > `p` is the greatest field with `p <= p0`, `p = 0` at sinks and `p(N) <= p(S) + k(S, N) d(S, N)` for
//! > neighbours S and N at distance d,
//!
//! where `k` is the rate of channels between two voxels of channels, and that of rock else. `p0` is the
//! pressure before channels break through ([`initial_pressure`]).
//!
//! There is one such field. Adding floating-point numbers is monotone, so every order of updates gives
//! it, bit for bit: the front of listing 5.2, the rounds of listing 5.4, or buckets
//! ([`landform_graph::marching::Relaxation`]), which are used here. And since channels only grow, so
//! that edges only get cheaper, it is enough to go on from the pressure before, at the voxels that
//! were opened: an iteration costs what it changes.

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;

use landform_graph::marching::Relaxation;
use landform_graph::{Edge, Lattice};

use crate::CaveError;
use crate::error::{check_length, check_range};

/// How steeply pressure may rise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// In rock, a metre.
    pub rock_per_m: f64,
    /// Between voxels of channels, a metre.
    pub channel_per_m: f64,
}

impl Rates {
    /// Checks that both are positive, and channels the easier way.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`].
    pub fn check(&self) -> Result<(), CaveError> {
        check_range("rock_rate_per_m", self.rock_per_m, [1e-12, 1e12])?;
        check_range("channel_rate_per_m", self.channel_per_m, [1e-12, self.rock_per_m])
    }

    /// The most by which pressure rises over an edge, given whether voxels belong to channels.
    #[inline]
    fn rise(&self, from: usize, edge: &Edge, in_channel: impl Fn(usize) -> bool) -> f64 {
        let open = in_channel(from) && in_channel(edge.node);
        edge.distance * if open { self.channel_per_m } else { self.rock_per_m }
    }
}

/// Pressure before channels break through: highest at the sources, falling evenly with the weighted
/// distance from them (thesis, section 5.2.1).
///
/// It is `most (1 - fall D / D_max)`, D the `distances` ([`weighted_distances`]) and D_max the largest of
/// them: `most` at sources, less by the share `fall` of it where the zones end. Rock that no source
/// claims has the pressure of the farthest.
///
/// [`weighted_distances`]: crate::stage_one::weighted_distances
pub fn initial_pressure(distances: &[f64], most: f64, fall: f64) -> Vec<f64> {
    let finite = distances.iter().copied().filter(|distance| distance.is_finite());
    let farthest = finite.fold(f64::MIN_POSITIVE, f64::max);
    let share = |distance: &f64| (distance / farthest).min(1.0);
    distances.iter().map(|distance| most * (1.0 - fall * share(distance))).collect()
}

/// Keeps pressure at the greatest field that the rates allow; memory that is used again.
#[derive(Clone, Debug, Default)]
pub struct Avalanches {
    relaxation: Relaxation,
    starts: Vec<usize>,
}

impl Avalanches {
    /// Memory for avalanches of pressure.
    pub fn new() -> Self {
        Self::default()
    }

    /// Lowers `pressure` everywhere to what the rates allow, whatever it was. Returns the number of
    /// times that a voxel lowered others.
    ///
    /// # Errors
    /// [`CaveError::Length`] if the pressure has not one value a voxel, [`CaveError::March`] for values
    /// without meaning.
    pub fn settle(
        &mut self,
        lattice: &Lattice,
        pressure: &mut [f64],
        rates: Rates,
        in_channel: impl Fn(usize) -> bool,
    ) -> Result<usize, CaveError> {
        check_length("pressure", pressure.len(), lattice.node_count())?;
        let is_too_low = |node: usize| {
            let allowed = |edge: &Edge| pressure[node] + rates.rise(node, edge, &in_channel);
            lattice.neighbours(node).any(|edge| allowed(&edge) < pressure[edge.node])
        };
        self.starts.clear();
        self.starts.extend((0..lattice.node_count()).filter(|&node| is_too_low(node)));
        self.relax(lattice, pressure, rates, in_channel)
    }

    /// Lowers `pressure`, which was settled, after channels grew: `opened` are the voxels that are
    /// new to them. Returns the number of times that a voxel lowered others.
    ///
    /// # Errors
    /// [`CaveError::March`] if the pressure has not one number a voxel, or an opened voxel does not
    /// exist.
    pub fn follow(
        &mut self,
        lattice: &Lattice,
        pressure: &mut [f64],
        rates: Rates,
        in_channel: impl Fn(usize) -> bool,
        opened: &[usize],
    ) -> Result<usize, CaveError> {
        self.starts.clear();
        for &node in opened {
            self.starts.push(node);
            // The edges to channels beside it got cheaper both ways.
            let beside = lattice.neighbours(node).map(|edge| edge.node);
            self.starts.extend(beside.filter(|&node| in_channel(node)));
        }
        self.relax(lattice, pressure, rates, in_channel)
    }

    fn relax(
        &mut self,
        lattice: &Lattice,
        pressure: &mut [f64],
        rates: Rates,
        in_channel: impl Fn(usize) -> bool,
    ) -> Result<usize, CaveError> {
        let width = 2.0 * rates.rock_per_m * lattice.spacing();
        let rise = |from: usize, edge: &Edge| rates.rise(from, edge, &in_channel);
        // All edges of a voxel of rock rise at the rate of rock, and none rises more steeply.
        let is_rock = |node: usize| !in_channel(node);
        Ok(self.relaxation.relax_even(lattice, pressure, &self.starts, width, rise, is_rock)?)
    }
}
