//! L-systems: strings that are rewritten, and a turtle that draws them.

mod rewrite;
mod turtle;

pub use rewrite::{Rule, rewrite};
pub use turtle::{Turtle, walk};

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::branching::{BranchWidth, Branching, Shown, paint};
use crate::error::Checks;
use crate::{Generator, SynthError};

const NAME: &str = "LSystem";

/// A string of letters in which every letter is replaced at once, again and again, by a rule
/// (Lindenmayer 1968), drawn by a turtle (Prusinkiewicz and Lindenmayer 1990).
///
/// Letters without a rule stay. A letter with several rules takes one of them at random, by their
/// weights. The turtle knows
///
/// | letter | does |
/// |---|---|
/// | `F`, `G` | a step ahead that draws |
/// | `f` | a step ahead that does not |
/// | `+`, `-` | turns left, right |
/// | `&`, `^` | pitches down, up |
/// | `\`, `/` | rolls left, right |
/// | `\|` | turns round |
/// | `[`, `]` | remembers place, heading and length of steps; returns to what was remembered last |
/// | `"` | multiplies the length of steps by `step_factor` |
///
/// and nothing else; other letters are for the rules. It begins heading north on a map and up in
/// a volume.
///
/// # Limits
/// At most 10 million letters, 64 rules, and as many places at a time as there are letters.
/// Context-free: rules do not see the letters beside theirs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LSystem {
    /// The string to begin with.
    pub axiom: String,
    /// What letters become.
    pub rules: Vec<Rule>,
    /// How often all letters are replaced.
    #[schemars(range(max = 64))]
    pub derivations: u32,
    /// Angle of turns.
    #[schemars(range(min = -360.0, max = 360.0), extend("x-unit" = "deg"))]
    pub angle_deg: f64,
    /// Length of a step; when missing, what makes the drawing fill nine tenths of the lattice,
    /// in its middle.
    #[schemars(range(min = 1e-6, max = 1e12), extend("x-unit" = "m"))]
    pub step_m: Option<f64>,
    /// Factor of the length of steps at `"`.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub step_factor: f64,
    /// Where the turtle begins, as shares of the lattice from west to east, south to north and
    /// bottom to top; not used without `step_m`.
    pub start: [f64; 3],
    /// How thick the lines are.
    pub width: BranchWidth,
    /// Seed of its random numbers, so that several fields and files show the same drawing; of the run
    /// when missing.
    pub seed: Option<u64>,
    /// What is shown of it.
    pub show: Shown,
    /// Factor of what is shown.
    #[schemars(range(min = -1e12, max = 1e12))]
    pub scale: f64,
}

impl Default for LSystem {
    /// The plant of figure 1.24 f of Prusinkiewicz and Lindenmayer 1990.
    fn default() -> Self {
        let rule =
            |letter, becomes: &str| Rule { letter, becomes: becomes.to_owned(), weight: 1.0 };
        Self {
            axiom: "X".to_owned(),
            rules: vec![rule('X', "F-[[X]+X]+F[+FX]-X"), rule('F', "FF")],
            derivations: 5,
            angle_deg: 22.5,
            step_m: None,
            step_factor: 0.7,
            start: [0.5, 0.0, 0.0],
            width: BranchWidth::default(),
            seed: None,
            show: Shown::Inside,
            scale: 1.0,
        }
    }
}

impl LSystem {
    /// The drawing as branches on a lattice; `seed` counts unless it has its own.
    ///
    /// # Errors
    /// [`SynthError`] if a parameter is out of its range, the string becomes too long, brackets do
    /// not match, or nothing is drawn.
    pub fn branching(&self, lattice: &Lattice, seed: u64) -> Result<Branching, SynthError> {
        let checks = Checks(NAME);
        checks.range("derivations", f64::from(self.derivations), 0.0..=64.0)?;
        checks.range("angle_deg", self.angle_deg, -360.0..=360.0)?;
        checks.length("step_m", self.step_m.unwrap_or(1.0), 1e-6)?;
        checks.range("step_factor", self.step_factor, 0.01..=100.0)?;
        self.start.into_iter().try_for_each(|share| checks.range("start", share, 0.0..=1.0))?;
        checks.elevation("scale", self.scale)?;
        self.width.check(&checks)?;
        let seed = self.seed.unwrap_or(seed);
        let letters = rewrite(&self.axiom, &self.rules, self.derivations, seed)?;
        let top = lattice.size().map(|nodes| (nodes - 1) as f64 * lattice.spacing());
        let turtle = Turtle {
            start: [0, 1, 2].map(|axis| self.start[axis] * top[axis]),
            upwards: lattice.depth() > 1,
            angle_deg: self.angle_deg,
            step: self.step_m.unwrap_or(1.0),
            step_factor: self.step_factor,
        };
        let mut branching = walk(&letters, &turtle)?;
        if branching.len() < 2 {
            let problem = "the turtle draws nothing; F and G draw".to_owned();
            return Err(SynthError::Unusable { generator: NAME, parameter: "axiom", problem });
        }
        if self.step_m.is_none() {
            fit(&mut branching, top)?;
        }
        self.width.apply(&mut branching);
        Ok(branching)
    }
}

impl Generator for LSystem {
    fn generate(&self, lattice: &Lattice, seed: u64) -> Result<Vec<f64>, SynthError> {
        let mut values = paint(&self.branching(lattice, seed)?, lattice, self.show);
        values.iter_mut().for_each(|value| *value *= self.scale);
        Ok(values)
    }
}

/// Scales and moves a drawing so that it fills nine tenths of a block, in its middle.
fn fit(branching: &mut Branching, top: [f64; 3]) -> Result<(), SynthError> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for position in &branching.positions {
        low = [0, 1, 2].map(|axis| low[axis].min(position[axis]));
        high = [0, 1, 2].map(|axis| high[axis].max(position[axis]));
    }
    let flat = |axis: usize| high[axis] - low[axis] <= 1e-9;
    let scales =
        (0..3).filter(|&axis| !flat(axis)).map(|axis| 0.9 * top[axis] / (high[axis] - low[axis]));
    let scale = scales.fold(f64::INFINITY, f64::min);
    if !(scale > 0.0 && scale.is_finite()) {
        let problem = "the drawing does not fit the lattice; give step_m".to_owned();
        return Err(SynthError::Unusable { generator: NAME, parameter: "step_m", problem });
    }
    for position in &mut branching.positions {
        *position = [0, 1, 2].map(|axis| {
            let middle = (low[axis] + high[axis]) / 2.0;
            top[axis] / 2.0 + scale * (position[axis] - middle)
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{KOCH_DIMENSION, koch_curve};
    use landform_graph::{Boundary, Connectivity};

    fn rule(letter: char, becomes: &str) -> Rule {
        Rule { letter, becomes: becomes.to_owned(), weight: 1.0 }
    }

    /// The turtle draws the curve that is made point by point elsewhere; pieces and lengths
    /// have Koch's dimension.
    #[test]
    fn kochs_curve_by_letters_is_kochs_curve_by_points() {
        for level in 0..6 {
            let letters = rewrite("F", &[rule('F', "F+F--F+F")], level, 0).unwrap();
            let step = 3.0_f64.powi(-(level as i32));
            let turtle = Turtle { angle_deg: 60.0, step, ..Turtle::default() };
            let drawn = walk(&letters, &turtle).unwrap();
            let points = koch_curve(level).unwrap();
            assert_eq!(drawn.len(), points.len());
            for (drawn, [ahead, left]) in drawn.positions.iter().zip(points) {
                // Ahead is north, left is west.
                assert!((drawn[1] - ahead).abs() < 1e-12 && (drawn[0] + left).abs() < 1e-12);
            }
            let pieces = (drawn.len() - 1) as f64;
            if level > 0 {
                assert!((pieces.ln() / -step.ln() - KOCH_DIMENSION).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_plant_fills_its_lattice() {
        let lattice =
            Lattice::plane([200, 300], 2.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let plant = LSystem::default();
        let branching = plant.branching(&lattice, 0).unwrap();
        let extent = |axis: usize| {
            let along = || branching.positions.iter().map(|at| at[axis]);
            along().fold(0.0, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        // It is wider, in comparison with the lattice, than it is high.
        assert!((extent(0) - 0.9 * 398.0).abs() < 1e-6 && extent(1) < 0.9 * 598.0);
        let field = plant.generate(&lattice, 0).unwrap();
        assert!(field.iter().sum::<f64>() > 1000.0);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        let lattice =
            Lattice::plane([20, 20], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let refused = |change: fn(&mut LSystem)| {
            let mut system = LSystem::default();
            change(&mut system);
            system.generate(&lattice, 0).unwrap_err().to_string()
        };
        assert!(refused(|system| system.axiom = "X]".to_owned()).contains("]"));
        assert!(refused(|system| system.derivations = 40).contains("10000000"));
        assert!(refused(|system| system.rules.clear()).contains("draws nothing"));
        assert!(refused(|system| system.angle_deg = f64::NAN).contains("angle_deg"));
        assert!(refused(|system| system.rules[0].weight = -1.0).contains("weight"));
    }
}
