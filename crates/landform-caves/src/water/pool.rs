//! What voxels contain, and a sweep of offers.

use landform_graph::Lattice;

use super::Rule;
use crate::CaveError;
use crate::error::check_values;

/// Units of water in the volume of a voxel, 2^26: all that 26 neighbours can offer fits 32 bits.
pub const UNIT: f64 = 67_108_864.0;

/// Units of water that pores hold: 2^-12 of a voxel's volume.
pub const FILM: u32 = 1 << 14;

/// Water in pores, in units of a voxel's volume over 2^26.
///
/// Everything costs what is wet, whatever the size of the lattice.
#[derive(Clone, Debug)]
pub struct PoreWater {
    contents: Vec<u32>,
    capacity: Vec<u32>,
    /// Units received since [`PoreWater::begin_iteration`].
    received: Vec<u32>,
    /// Voxels that contain water, in order.
    wet: Vec<u32>,
    is_wet: Vec<bool>,
    /// Voxels that received water, in order after [`PoreWater::flowed`].
    flowed: Vec<u32>,
    offers: Vec<(u32, u32)>,
    /// End of the offers of each wet voxel, and what is taken of them.
    given: Vec<(usize, u32)>,
    asked: Vec<u32>,
    gain: Vec<u32>,
    /// Voxels that are offered something.
    touched: Vec<u32>,
}

/// Porosity as room for water.
#[inline]
fn units(share: f64) -> u32 {
    (share * UNIT) as u32
}

impl PoreWater {
    /// Bytes a voxel.
    pub const BYTES: usize = 5 * 4 + 1;

    /// Water in rock of this porosity: `water` is the share of each voxel's volume that is water.
    ///
    /// # Errors
    /// [`CaveError::Length`] and [`CaveError::Value`]: all shares lie from 0 to 1. Water that does not
    /// fit into the pores is refused.
    pub fn new(lattice: &Lattice, porosity: &[f64], water: &[f64]) -> Result<Self, CaveError> {
        let count = lattice.node_count();
        check_values("porosity", porosity, count, [0.0, 1.0])?;
        check_values("pore_water", water, count, [0.0, 1.0])?;
        let capacity: Vec<u32> = porosity.iter().map(|&porosity| units(porosity)).collect();
        let contents: Vec<u32> = water.iter().map(|&water| units(water)).collect();
        if let Some(node) = (0..count).find(|&node| contents[node] > capacity[node]) {
            let (value, most) = (water[node], porosity[node]);
            return Err(CaveError::Value { name: "pore_water", value, node, least: 0.0, most });
        }
        let is_wet: Vec<bool> = contents.iter().map(|&contents| contents > 0).collect();
        let wet = (0..count as u32).filter(|&node| is_wet[node as usize]).collect();
        Ok(Self {
            contents,
            capacity,
            received: vec![0; count],
            wet,
            is_wet,
            flowed: Vec::new(),
            offers: Vec::new(),
            given: Vec::new(),
            asked: vec![0; count],
            gain: vec![0; count],
            touched: Vec::new(),
        })
    }

    /// Units that a voxel contains.
    #[inline]
    pub fn contents(&self, node: usize) -> u32 {
        self.contents[node]
    }

    /// Units that a voxel may contain.
    #[inline]
    pub fn capacity(&self, node: usize) -> u32 {
        self.capacity[node]
    }

    /// Units that still fit into a voxel.
    #[inline]
    pub fn room(&self, node: usize) -> u32 {
        self.capacity[node] - self.contents[node]
    }

    /// Units that a voxel received in this iteration.
    #[inline]
    pub fn received(&self, node: usize) -> u32 {
        self.received[node]
    }

    /// Voxels that contain water.
    pub fn wet(&self) -> &[u32] {
        &self.wet
    }

    /// Voxels that received water in this iteration, in node order.
    pub fn flowed(&mut self) -> &[u32] {
        self.flowed.sort_unstable();
        &self.flowed
    }

    /// All water, in units.
    pub fn total(&self) -> u64 {
        self.wet.iter().map(|&node| u64::from(self.contents[node as usize])).sum()
    }

    /// Makes room in a voxel whose porosity has grown.
    pub fn widen(&mut self, node: usize, porosity: f64) {
        self.capacity[node] = units(porosity).max(self.capacity[node]);
    }

    /// Forgets what was received.
    pub fn begin_iteration(&mut self) {
        for node in self.flowed.drain(..) {
            self.received[node as usize] = 0;
        }
    }

    /// Adds up to `share` of its volume to a voxel, no more than it has room for; returns the units
    /// added.
    pub fn feed(&mut self, node: usize, share: f64) -> u32 {
        let amount = units(share.clamp(0.0, 1.0)).min(self.room(node));
        self.add(node, amount);
        amount
    }

    /// Empties a voxel; returns the units that it contained.
    pub fn drain(&mut self, node: usize) -> u32 {
        std::mem::take(&mut self.contents[node])
    }

    /// Lets all wet voxels give water to neighbours once, by a rule.
    pub fn sweep(&mut self, lattice: &Lattice, rule: &impl Rule) {
        self.collect_offers(lattice, rule);
        self.take_offers();
        for (&node, &(_, given)) in self.wet.iter().zip(&self.given) {
            self.contents[node as usize] -= given;
        }
        let mut touched = std::mem::take(&mut self.touched);
        for node in touched.drain(..) {
            self.asked[node as usize] = 0;
            let amount = std::mem::take(&mut self.gain[node as usize]);
            self.add(node as usize, amount);
        }
        self.touched = touched;
        let Self { wet, is_wet, contents, .. } = self;
        wet.retain(|&node| {
            is_wet[node as usize] = contents[node as usize] > 0;
            is_wet[node as usize]
        });
        // Sorted runs, which the stable sort merges: windows of memory are visited in sequence.
        wet.sort();
    }

    fn collect_offers(&mut self, lattice: &Lattice, rule: &impl Rule) {
        let mut offers = std::mem::take(&mut self.offers);
        offers.clear();
        self.given.clear();
        for at in 0..self.wet.len() {
            let (first, node) = (offers.len(), self.wet[at] as usize);
            if self.contents[node] > FILM {
                rule.offer(lattice, self, node, &mut offers);
            }
            for &(node, amount) in &offers[first..] {
                if self.asked[node as usize] == 0 && amount > 0 {
                    self.touched.push(node);
                }
                self.asked[node as usize] += amount;
            }
            self.given.push((offers.len(), 0));
        }
        self.offers = offers;
    }

    /// Settles what each voxel takes: all it is offered, or the same part of every offer.
    fn take_offers(&mut self) {
        let mut first = 0;
        for (end, given) in &mut self.given {
            for &(node, amount) in &self.offers[first..*end] {
                let node = node as usize;
                let (asked, room) = (self.asked[node], self.capacity[node] - self.contents[node]);
                let taken = match asked <= room {
                    true => amount,
                    false => (u64::from(amount) * u64::from(room) / u64::from(asked)) as u32,
                };
                self.gain[node] += taken;
                *given += taken;
            }
            first = *end;
        }
    }

    /// Adds water that fits.
    fn add(&mut self, node: usize, amount: u32) {
        if amount == 0 {
            return;
        }
        self.contents[node] += amount;
        if self.received[node] == 0 {
            self.flowed.push(node as u32);
        }
        self.received[node] = self.received[node].saturating_add(amount);
        if !std::mem::replace(&mut self.is_wet[node], true) {
            self.wet.push(node as u32);
        }
    }
}
