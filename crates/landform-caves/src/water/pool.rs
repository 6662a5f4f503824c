//! What voxels contain, and a sweep of offers.

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};

use super::Rule;
use crate::sparse::Sparse;

/// Units of water in the volume of a voxel, 2^26: all that 26 neighbours can offer fits 32 bits.
pub const UNIT: f64 = 67_108_864.0;

/// Units of water that pores hold: 2^-12 of a voxel's volume.
pub const FILM: u32 = 1 << 14;

/// Water in pores, in units of a voxel's volume over 2^26.
///
/// Everything costs what is wet, memory too, whatever the size of the lattice.
#[derive(Clone, Debug)]
pub struct PoreWater {
    voxels: usize,
    pores: Sparse<Pore>,
    /// Voxels that contain water, in order.
    wet: Vec<u32>,
    /// Voxels that received water, in order after [`PoreWater::flowed`].
    flowed: Vec<u32>,
    offers: Vec<(u32, u32)>,
    /// End of the offers of each wet voxel, and what is taken of them.
    given: Vec<(usize, u32)>,
    /// Voxels that are offered something.
    touched: Vec<u32>,
}

/// The units of a voxel.
#[derive(Clone, Copy, Debug, Default)]
struct Pore {
    contents: u32,
    /// Received since [`PoreWater::begin_iteration`].
    received: u32,
    /// Offered in this sweep, and taken of that.
    asked: u32,
    gain: u32,
    /// Whether the voxel is in the list of those that contain water.
    is_wet: bool,
}

/// Water in rock of a porosity.
#[derive(Clone, Copy)]
pub struct Pores<'a> {
    water: &'a PoreWater,
    porosity: &'a [f64],
}

/// Porosity as room for water.
#[inline]
fn units(share: f64) -> u32 {
    (share * UNIT) as u32
}

impl Pores<'_> {
    /// Units that a voxel contains.
    #[inline]
    pub fn contents(&self, node: usize) -> u32 {
        self.water.contents(node)
    }

    /// Units that a voxel may contain.
    #[inline]
    pub fn capacity(&self, node: usize) -> u32 {
        units(self.porosity[node])
    }

    /// Units that still fit into a voxel.
    #[inline]
    pub fn room(&self, node: usize) -> u32 {
        self.capacity(node).saturating_sub(self.contents(node))
    }
}

impl PoreWater {
    /// Dry rock of so many voxels.
    pub fn dry(voxels: usize) -> Self {
        Self {
            voxels,
            pores: Sparse::new(voxels),
            wet: Vec::new(),
            flowed: Vec::new(),
            offers: Vec::new(),
            given: Vec::new(),
            touched: Vec::new(),
        }
    }

    /// The water in rock of this porosity, one value a voxel.
    pub fn in_rock<'a>(&'a self, porosity: &'a [f64]) -> Pores<'a> {
        Pores { water: self, porosity }
    }

    /// Number of voxels, wet or dry.
    pub fn voxels(&self) -> usize {
        self.voxels
    }

    /// Units that a voxel contains.
    #[inline]
    pub fn contents(&self, node: usize) -> u32 {
        self.pores.get(node).contents
    }

    /// Units that a voxel received in this iteration.
    #[inline]
    pub fn received(&self, node: usize) -> u32 {
        self.pores.get(node).received
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

    /// What every voxel contains, as a share of its volume.
    pub fn content_shares(&self) -> Vec<f64> {
        self.shares(&self.wet, |pore| pore.contents)
    }

    /// What every voxel received in this iteration, as a share of its volume.
    pub fn flow_shares(&self) -> Vec<f64> {
        self.shares(&self.flowed, |pore| pore.received)
    }

    fn shares(&self, nodes: &[u32], of: impl Fn(Pore) -> u32) -> Vec<f64> {
        let mut shares = vec![0.0; self.voxels];
        for &node in nodes {
            shares[node as usize] = f64::from(of(self.pores.get(node as usize))) / UNIT;
        }
        shares
    }

    /// All water, in units.
    pub fn total(&self) -> u64 {
        self.wet.iter().map(|&node| u64::from(self.contents(node as usize))).sum()
    }

    /// Forgets what was received.
    pub fn begin_iteration(&mut self) {
        for node in self.flowed.drain(..) {
            self.pores.get_mut(node as usize).received = 0;
        }
    }

    /// Adds up to `share` of its volume to a voxel, no more than it has room for in rock of this
    /// `porosity`; returns the units added.
    pub fn feed(&mut self, porosity: &[f64], node: usize, share: f64) -> u32 {
        let amount = units(share.clamp(0.0, 1.0)).min(self.in_rock(porosity).room(node));
        self.add(node, amount);
        amount
    }

    /// Empties a voxel; returns the units that it contained.
    pub fn drain(&mut self, node: usize) -> u32 {
        match self.contents(node) {
            0 => 0,
            _ => std::mem::take(&mut self.pores.get_mut(node).contents),
        }
    }

    /// Lets all wet voxels give water to neighbours once, by a rule, in rock of this `porosity`.
    pub fn sweep(&mut self, lattice: &Lattice, rule: &impl Rule, porosity: &[f64]) {
        self.collect_offers(lattice, rule, porosity);
        self.take_offers(porosity);
        for (&node, &(_, given)) in self.wet.iter().zip(&self.given) {
            self.pores.get_mut(node as usize).contents -= given;
        }
        let mut touched = std::mem::take(&mut self.touched);
        for node in touched.drain(..) {
            let pore = self.pores.get_mut(node as usize);
            pore.asked = 0;
            let amount = std::mem::take(&mut pore.gain);
            self.add(node as usize, amount);
        }
        self.touched = touched;
        let Self { wet, pores, .. } = self;
        wet.retain(|&node| {
            let pore = pores.get_mut(node as usize);
            pore.is_wet = pore.contents > 0;
            pore.is_wet
        });
        // Sorted runs, which the stable sort merges: windows of memory are visited in sequence.
        wet.sort();
    }

    fn collect_offers(&mut self, lattice: &Lattice, rule: &impl Rule, porosity: &[f64]) {
        let mut offers = std::mem::take(&mut self.offers);
        offers.clear();
        self.given.clear();
        for at in 0..self.wet.len() {
            let (first, node) = (offers.len(), self.wet[at] as usize);
            if self.contents(node) > FILM {
                rule.offer(lattice, &self.in_rock(porosity), node, &mut offers);
            }
            for &(node, amount) in offers[first..].iter().filter(|offer| offer.1 > 0) {
                let pore = self.pores.get_mut(node as usize);
                if pore.asked == 0 {
                    self.touched.push(node);
                }
                pore.asked += amount;
            }
            self.given.push((offers.len(), 0));
        }
        self.offers = offers;
    }

    /// Settles what each voxel takes: all it is offered, or the same part of every offer.
    fn take_offers(&mut self, porosity: &[f64]) {
        let mut first = 0;
        for (end, given) in &mut self.given {
            for &(node, amount) in self.offers[first..*end].iter().filter(|offer| offer.1 > 0) {
                let pore = self.pores.get_mut(node as usize);
                let room = units(porosity[node as usize]).saturating_sub(pore.contents);
                let taken = match pore.asked <= room {
                    true => amount,
                    false => (u64::from(amount) * u64::from(room) / u64::from(pore.asked)) as u32,
                };
                pore.gain += taken;
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
        let pore = self.pores.get_mut(node);
        pore.contents += amount;
        if pore.received == 0 {
            self.flowed.push(node as u32);
        }
        pore.received = pore.received.saturating_add(amount);
        if !std::mem::replace(&mut pore.is_wet, true) {
            self.wet.push(node as u32);
        }
    }
}

/// Wet voxels and those with flow are kept with their units; the rest is memory to work in.
impl Keep for PoreWater {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        let units = |nodes: &[u32], of: fn(Pore) -> u32| -> Vec<u32> {
            nodes.iter().map(|&node| of(self.pores.get(node as usize))).collect()
        };
        to.value("voxels", &self.voxels);
        to.array("wet", &self.wet);
        to.owned("contents", units(&self.wet, |pore| pore.contents));
        to.array("flowed", &self.flowed);
        to.owned("received", units(&self.flowed, |pore| pore.received));
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let mut water = Self::dry(from.value("voxels")?);
        let nodes = |name: &str| -> Result<Vec<u32>, Damage> {
            let nodes: &[u32] = from.array(name)?;
            match nodes.iter().all(|&node| (node as usize) < water.voxels) {
                true => Ok(nodes.to_vec()),
                false => Err(from.refuse(name, "a voxel that does not exist")),
            }
        };
        let (wet, flowed) = (nodes("wet")?, nodes("flowed")?);
        for (&node, &contents) in wet.iter().zip(from.array_of("contents", wet.len())?) {
            let pore = water.pores.get_mut(node as usize);
            (pore.contents, pore.is_wet) = (contents, true);
        }
        for (&node, &received) in flowed.iter().zip(from.array_of("received", flowed.len())?) {
            water.pores.get_mut(node as usize).received = received;
        }
        Ok(Self { wet, flowed, ..water })
    }
}
