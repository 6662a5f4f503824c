//! An iteration: routes, uplift, incision, creep.

use landform_graph::Lattice;
use landform_sim::sums::sum;
use rayon::prelude::*;

use super::{Creep, Routes, StreamPowerErosion, StreamPowerLaw, incise};
use crate::RiverError;
use crate::error::{check_length, check_values};
use crate::water::MOST_M;

/// What became of the bed in an iteration: sums over nodes, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Evolved {
    /// By how much the ground rose.
    pub uplifted_m: f64,
    /// What rivers carried away.
    pub incised_m: f64,
    /// What crept over the base level and into the sea, less what crept back.
    pub crept_m: f64,
}

/// Ground that evolves by [`StreamPowerErosion`], with the memory that this takes.
#[derive(Clone, Debug)]
pub struct Evolution {
    lattice: Lattice,
    settings: StreamPowerErosion,
    law: StreamPowerLaw,
    routes: Routes,
    creep: Creep,
    base_level: Vec<usize>,
    surface: Vec<f64>,
    lost: Vec<f64>,
}

impl Evolution {
    /// Bytes a node.
    pub const BYTES: usize = Routes::BYTES + Creep::BYTES + 24;

    /// Memory for ground on a lattice.
    ///
    /// # Errors
    /// See [`StreamPowerErosion::check`].
    pub fn new(lattice: &Lattice, settings: &StreamPowerErosion) -> Result<Self, RiverError> {
        settings.check(lattice)?;
        Ok(Self {
            lattice: lattice.clone(),
            settings: settings.clone(),
            law: StreamPowerLaw::new(lattice, settings),
            routes: Routes::new(lattice)?,
            creep: Creep::new(lattice)?,
            base_level: settings.base_level_nodes(lattice),
            surface: vec![0.0; lattice.node_count()],
            lost: vec![0.0; lattice.node_count()],
        })
    }

    /// Makes base level of more nodes: they keep their height and take the water.
    pub fn keep(&mut self, nodes: impl IntoIterator<Item = usize>) {
        self.base_level.extend(nodes);
        self.base_level.sort_unstable();
        self.base_level.dedup();
    }

    /// Lets `bed` (elevation, metres) evolve for an iteration. `uplift` (m/yr), one a node or none at
    /// all, is added to the uplift of the settings.
    ///
    /// # Errors
    /// [`RiverError::Length`]; [`RiverError::Value`] for heights that are no numbers or beyond all
    /// bounds; [`RiverError::NoOutlet`] where the sea has no nodes.
    pub fn step(&mut self, bed: &mut [f64], uplift: &[f64]) -> Result<Evolved, RiverError> {
        check_length("bed", bed.len(), self.surface.len())?;
        check_values("bed", bed, -MOST_M)?;
        let outlets = self.outlets(bed);
        let kept: Vec<f64> = outlets.iter().map(|&node| bed[node]).collect();
        // To all that lies around them outlets are as high as the water that they lead to.
        let sea_m = self.settings.sea_level_m.unwrap_or(f64::NEG_INFINITY);
        outlets.iter().for_each(|&node| bed[node] = bed[node].max(sea_m));
        let evolved = self.evolve(bed, uplift, &outlets);
        outlets.iter().zip(kept).for_each(|(&node, kept)| bed[node] = kept);
        evolved
    }

    /// An iteration between outlets that are as high as they shall stay.
    fn evolve(
        &mut self,
        bed: &mut [f64],
        uplift: &[f64],
        outlets: &[usize],
    ) -> Result<Evolved, RiverError> {
        let start = bed.to_vec();
        let first_m = self.creep(bed, outlets);
        self.routes.find(&self.lattice, bed, outlets)?;
        let uplifted_m = self.raise(bed, uplift, outlets);
        outlets.iter().for_each(|&node| self.surface[node] = bed[node]);
        incise(&self.routes, &self.law, bed, &mut self.surface, &mut self.lost);
        let incised_m = sum(&self.lost);
        let crept_m = first_m + self.creep(bed, outlets);
        self.lose(&start, bed, uplift, outlets);
        Ok(Evolved { uplifted_m, incised_m, crept_m })
    }

    /// The nodes that keep their height and take the water, in order.
    fn outlets(&self, bed: &[f64]) -> Vec<usize> {
        let Some(sea_m) = self.settings.sea_level_m else { return self.base_level.clone() };
        let mut base_level = self.base_level.iter().peekable();
        let is_outlet = |&node: &usize| {
            base_level.next_if(|&&border| border == node).is_some() || bed[node] < sea_m
        };
        (0..bed.len()).filter(is_outlet).collect()
    }

    /// Uplift of a node that is no outlet.
    fn rise(&self, uplift: &[f64], node: usize) -> f64 {
        let more = uplift.get(node).copied().unwrap_or(0.0);
        (self.settings.uplift_m_per_yr + more) * self.settings.step_yr
    }

    /// Raises all but the outlets and returns the sum of it.
    fn raise(&mut self, bed: &mut [f64], uplift: &[f64], outlets: &[usize]) -> f64 {
        let mut rises = std::mem::take(&mut self.lost);
        rises.par_iter_mut().enumerate().for_each(|(node, rise)| *rise = self.rise(uplift, node));
        outlets.iter().for_each(|&node| rises[node] = 0.0);
        bed.par_iter_mut().zip(&rises).for_each(|(height, rise)| *height += rise);
        let uplifted_m = sum(&rises);
        self.lost = rises;
        uplifted_m
    }

    /// Lets hillslopes creep for half an iteration and returns what crept over the outlets.
    fn creep(&mut self, bed: &mut [f64], outlets: &[usize]) -> f64 {
        let steps = (0.5 * self.settings.creep_steps(&self.lattice)).ceil();
        if steps == 0.0 {
            return 0.0;
        }
        let diffusion_m2 = 0.5 * self.settings.diffusivity_m2_per_yr * self.settings.step_yr;
        let share = diffusion_m2 / self.lattice.spacing().powi(2) / steps;
        let mut gained = vec![0.0; outlets.len()];
        self.creep.run(bed, outlets, [steps, share], &mut gained);
        sum(&gained)
    }

    /// What nodes lost in an iteration that began at `start`.
    fn lose(&mut self, start: &[f64], bed: &[f64], uplift: &[f64], outlets: &[usize]) {
        let mut lost = std::mem::take(&mut self.lost);
        let nodes = lost.par_iter_mut().zip(start).zip(bed).enumerate();
        nodes.for_each(|(node, ((lost, start), end))| {
            *lost = start + self.rise(uplift, node) - end;
        });
        outlets.iter().for_each(|&node| lost[node] = 0.0);
        self.lost = lost;
    }

    /// What each node but outlets lost to rivers and by creep in the latest iteration, in metres.
    pub fn lost_m(&self) -> &[f64] {
        &self.lost
    }

    /// Where water went in the latest iteration.
    pub fn routes(&self) -> &Routes {
        &self.routes
    }
}
