//! Rock that flowing water dissolves (thesis, equations 5.1 and 5.2).

use landform_graph::Lattice;

use crate::CaveError;
use crate::error::check_range;
use crate::sparse::Sparse;
use crate::water::{PoreWater, Rule, UNIT};

/// How flow dissolves rock.
///
/// The flow that counts is `f = (w_a f_a + f_c)^m`, and porosity P grows by `min(w_0 f, 1 - P)` an
/// iteration. f_c is the water that a voxel received, as a share of its volume; f_a is what voxels that
/// it could flow to contribute: a fraction of their f_c, from each. So erosion avalanches up the
/// pressure and widens channels, as on slopes (thesis, section 4.3.1). The text of section 5.2.2 names
/// the two flows the other way round than equation 4.5, which it refers to; this is the order of 4.5.
///
/// Rock without pores (P = 0) is not dissolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dissolution {
    /// w_0: porosity that a flow of 1 adds in an iteration.
    pub rate: f64,
    /// w_a: weight of contributed flow.
    pub contributed_weight: f64,
    /// m: exponent of the flow.
    pub exponent: f64,
    /// Part of its flow that a voxel contributes to each neighbour that leads to it.
    pub contributed_fraction: f64,
}

/// What an iteration dissolved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dissolved {
    /// Voxels that became part of channels, in node order.
    pub opened: Vec<usize>,
    /// Voxels whose porosity changed, in node order.
    pub changed: Vec<usize>,
    /// Rock that was dissolved, in volumes of a voxel.
    pub volume: f64,
}

/// Memory for [`Dissolution::dissolve`]: 8 bytes a voxel of the pages that water comes near.
#[derive(Clone, Debug)]
pub struct Contributions {
    /// Units contributed to each voxel: whole numbers, whose sums no order can change.
    units: Sparse<f64>,
}

impl Contributions {
    /// Memory for so many voxels.
    pub fn new(voxels: usize) -> Self {
        Self { units: Sparse::new(voxels) }
    }
}

impl Dissolution {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`CaveError::OutOfRange`].
    pub fn check(&self) -> Result<(), CaveError> {
        check_range("erosion_rate", self.rate, [0.0, 1e3])?;
        check_range("contributed_weight", self.contributed_weight, [0.0, 1e3])?;
        check_range("flow_exponent", self.exponent, [0.01, 10.0])?;
        check_range("contributed_fraction", self.contributed_fraction, [0.0, 1.0])
    }

    /// Lets the water that flowed in this iteration dissolve rock: `porosity` grows, which gives water
    /// more room. Voxels whose porosity comes to `passage` open.
    pub fn dissolve(
        &self,
        lattice: &Lattice,
        water: &mut PoreWater,
        rule: &impl Rule,
        (porosity, passage): (&mut [f64], f64),
        memory: &mut Contributions,
    ) -> Dissolved {
        let mut changed: Vec<usize> = water.flowed().iter().map(|&node| node as usize).collect();
        let flowed = changed.len();
        for at in 0..flowed {
            let node = changed[at];
            let units = f64::from(water.received(node));
            for edge in lattice.neighbours(node) {
                let beside = edge.node;
                if porosity[beside] > 0.0 && rule.leads(lattice, beside, node) {
                    let contributed = memory.units.get_mut(beside);
                    if *contributed == 0.0 && water.received(beside) == 0 {
                        changed.push(beside);
                    }
                    *contributed += units;
                }
            }
        }
        changed.sort();
        let mut dissolved = Dissolved::default();
        for &node in &changed {
            let contributed =
                std::mem::take(memory.units.get_mut(node)) * self.contributed_fraction;
            let flow = f64::from(water.received(node)) / UNIT;
            let growth = self.growth(flow, contributed / UNIT, porosity[node]);
            let before = porosity[node];
            porosity[node] = (before + growth).min(1.0);
            dissolved.volume += porosity[node] - before;
            if before < passage && porosity[node] >= passage {
                dissolved.opened.push(node);
            }
        }
        Dissolved { changed, ..dissolved }
    }

    /// Growth of porosity in an iteration (equations 5.1 and 5.2).
    fn growth(&self, flow: f64, contributed: f64, porosity: f64) -> f64 {
        let sum = self.contributed_weight * contributed + flow;
        let f = if self.exponent == 1.0 { sum } else { sum.powf(self.exponent) };
        (self.rate * f).min(1.0 - porosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::water::DownPressure;
    use landform_graph::{Boundary, Connectivity};

    /// Equations 5.1 and 5.2 by hand, in a row of voxels along which pressure falls.
    #[test]
    fn rock_is_dissolved_by_the_equations() {
        let lattice =
            Lattice::plane([4, 1], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let pressure = [3.0, 2.0, 1.0, 0.0];
        let rule = DownPressure { pressure: &pressure, exponent: 1 };
        let mut porosity = [0.5, 0.25, 0.5, 0.0];
        let mut water = PoreWater::dry(4);
        water.feed(&porosity, 0, 0.5);
        water.begin_iteration();
        water.sweep(&lattice, &rule, &porosity);
        assert_eq!(water.received(1), (0.25 * UNIT) as u32);
        let law = Dissolution {
            rate: 0.2,
            contributed_weight: 0.5,
            exponent: 2.0,
            contributed_fraction: 0.1,
        };
        let mut memory = Contributions::new(4);
        let dissolved =
            law.dissolve(&lattice, &mut water, &rule, (&mut porosity, 0.26), &mut memory);
        // Voxel 1 received 0.25; voxel 0, which leads to it, gets a tenth of that contributed.
        let grown = [0.2 * (0.5 * 0.025_f64).powi(2), 0.2 * 0.25_f64.powi(2)];
        assert!((porosity[0] - 0.5 - grown[0]).abs() < 1e-15);
        assert!((porosity[1] - 0.25 - grown[1]).abs() < 1e-15);
        assert_eq!(porosity[2..], [0.5, 0.0]);
        assert!((dissolved.volume - grown[0] - grown[1]).abs() < 1e-15);
        assert_eq!((dissolved.opened, dissolved.changed), (vec![1], vec![0, 1]));
        assert!(water.in_rock(&porosity).room(1) > 0);
        assert!((0..4).all(|node| memory.units.get(node) == 0.0));
    }

    #[test]
    fn porosity_ends_at_one_and_impermeable_rock_stays() {
        let lattice = Lattice::plane([3, 1], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let pressure = [1.0, 0.0, 2.0];
        let rule = DownPressure { pressure: &pressure, exponent: 1 };
        let mut porosity = [0.9, 0.9, 0.0];
        let mut water = PoreWater::dry(3);
        water.feed(&porosity, 0, 0.9);
        water.begin_iteration();
        water.sweep(&lattice, &rule, &porosity);
        let law = Dissolution {
            rate: 5.0,
            contributed_weight: 1.0,
            exponent: 1.0,
            contributed_fraction: 1.0,
        };
        let mut memory = Contributions::new(3);
        law.dissolve(&lattice, &mut water, &rule, (&mut porosity, 0.5), &mut memory);
        assert_eq!(porosity, [1.0, 1.0, 0.0]);
        assert!(law.check().is_ok());
        assert!(Dissolution { exponent: f64::NAN, ..law }.check().is_err());
    }
}
