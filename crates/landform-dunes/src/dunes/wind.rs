//! Winds: a rose of directions, and the straight line of nodes that a wind blows along.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DuneError, check};

/// A wind with a spread of directions around its mean (thesis, section 4.1: +-15 degrees).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Wind {
    /// Direction that the wind blows **to**, degrees counter-clockwise from east. Default 0.
    pub towards_deg: f64,
    /// Share of the time that it blows, relative to the other winds of the rose. Default 1.
    pub weight: f64,
    /// Greatest deviation to either side, degrees in [0, 180]. Default 15.
    pub spread_deg: f64,
    /// Number of directions spread evenly over the deviation; one blows along the mean only.
    /// Default 3.
    pub directions: u32,
}

impl Default for Wind {
    fn default() -> Self {
        Self { towards_deg: 0.0, weight: 1.0, spread_deg: 15.0, directions: 3 }
    }
}

impl Wind {
    /// A wind that never varies.
    pub fn steady(towards_deg: f64) -> Self {
        Self { towards_deg, spread_deg: 0.0, directions: 1, ..Self::default() }
    }
}

/// The winds of a place and how often each blows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Rose {
    /// The winds. Default: one, to the east.
    pub winds: Vec<Wind>,
}

impl Default for Rose {
    fn default() -> Self {
        Self { winds: vec![Wind::default()] }
    }
}

impl Rose {
    /// Checks ranges.
    ///
    /// # Errors
    /// [`DuneError::NoWind`]; [`DuneError::Range`] for angles that are not finite, weights
    /// that are negative or all zero, a spread beyond 180 degrees, or a wrong direction count.
    pub fn validate(&self) -> Result<(), DuneError> {
        if self.winds.is_empty() {
            return Err(DuneError::NoWind);
        }
        for wind in &self.winds {
            let angle = wind.towards_deg;
            check(angle.is_finite(), "towards_deg", angle, "a finite angle")?;
            let weight = wind.weight;
            check((0.0..=1e9).contains(&weight), "weight", weight, "between 0 and 1e9")?;
            let spread = wind.spread_deg;
            check((0.0..=180.0).contains(&spread), "spread_deg", spread, "between 0 and 180")?;
            let count = wind.directions;
            check((1..=3600).contains(&count), "directions", count.into(), "between 1 and 3600")?;
        }
        let total: f64 = self.winds.iter().map(|wind| wind.weight).sum();
        check(total > 0.0, "sum of weights", total, "above 0")
    }

    /// Every direction in radians with the probability that the wind blows no later in the
    /// list: ready for [`Directions::draw`].
    ///
    /// # Errors
    /// See [`Rose::validate`].
    pub fn directions(&self) -> Result<Directions, DuneError> {
        self.validate()?;
        let total: f64 = self.winds.iter().map(|wind| wind.weight).sum();
        let mut below = 0.0;
        let mut list = Vec::new();
        for wind in self.winds.iter().filter(|wind| wind.weight > 0.0) {
            for number in 0..wind.directions {
                let deviation = match wind.directions {
                    1 => 0.0,
                    count => 2.0 * f64::from(number) / f64::from(count - 1) - 1.0,
                };
                below += wind.weight / total / f64::from(wind.directions);
                let degrees = wind.towards_deg + deviation * wind.spread_deg;
                list.push((degrees.to_radians(), below));
            }
        }
        Ok(Directions { list })
    }
}

/// The directions of a rose with their cumulated probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct Directions {
    list: Vec<(f64, f64)>,
}

impl Directions {
    /// The direction, in radians, that the random number `chance` in [0, 1) picks.
    pub fn draw(&self, chance: f64) -> f64 {
        let picked = self.list.partition_point(|&(_, below)| below <= chance);
        // Rounding may leave the last probability a little below one.
        self.list[picked.min(self.list.len() - 1)].0
    }

    /// The directions in radians, in the order of the rose.
    pub fn angles(&self) -> impl Iterator<Item = f64> + '_ {
        self.list.iter().map(|&(angle, _)| angle)
    }
}

/// The axis that a wind mostly blows along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along rows: columns change at every step.
    Columns,
    /// Along columns: rows change at every step.
    Rows,
}

/// A straight line of nodes along the wind, as Bresenham draws it.
///
/// Each step goes one node along the axis nearest to the wind and `slope` nodes on average
/// across. The crossing steps happen at the same steps of every line, so the lines of one wind
/// never meet and together visit every node once, on a torus too. `phase` moves the places of
/// the crossing steps: drawn anew each time, it leaves no groove at fixed columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindLine {
    angle: f64,
    axis: Axis,
    forward: bool,
    slope: f64,
    phase: f64,
}

impl WindLine {
    /// The lines of a wind blowing to `angle` radians (counter-clockwise from east), with
    /// `phase` in [0, 1).
    pub fn new(angle: f64, phase: f64) -> Self {
        // Rows run south: north is against them.
        let [columns, rows] = [angle.cos(), -angle.sin()];
        let (axis, along, across) = match columns.abs() >= rows.abs() {
            true => (Axis::Columns, columns, rows),
            false => (Axis::Rows, rows, columns),
        };
        let slope = across / along.abs();
        // A quarter turn in radians is inexact; without this, axis winds would creep sideways.
        let slope = if slope.abs() < 1e-12 { 0.0 } else { slope.clamp(-1.0, 1.0) };
        Self { angle, axis, forward: along > 0.0, slope, phase }
    }

    /// Direction that the wind blows to, in radians counter-clockwise from east.
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// The axis nearest to the wind.
    pub fn axis(&self) -> Axis {
        self.axis
    }

    /// Whether columns (or rows) grow downwind.
    pub fn is_forward(&self) -> bool {
        self.forward
    }

    /// Nodes moved across the axis at each step, on average: between -1 and 1.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Nodes across the axis at step `step` of a line, relative to where the line started.
    #[inline]
    pub fn shift(&self, step: isize) -> isize {
        (step as f64 * self.slope + self.phase).floor() as isize
    }

    /// Length of one step in node spacings: between 1 and the square root of 2.
    pub fn step_length(&self) -> f64 {
        self.slope.hypot(1.0)
    }

    /// Columns and rows of a jump of `length` node spacings, at least one step. The random
    /// numbers in [0, 1) round the jump so that its mean keeps length and direction.
    pub fn jump(&self, length: f64, chances: [f64; 2]) -> [isize; 2] {
        let steps = length / self.step_length();
        // A length of 5 that arrives as 4.999999999 shall always be 5.
        let nearest = steps.round();
        let steps = if (steps - nearest).abs() < 1e-9 { nearest } else { steps + chances[0] };
        let along = (steps.floor() as isize).max(1);
        let across = (along as f64 * self.slope + chances[1]).floor() as isize;
        let along = if self.forward { along } else { -along };
        match self.axis {
            Axis::Columns => [along, across],
            Axis::Rows => [across, along],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_rose_blows_fifteen_degrees_to_either_side() {
        let directions = Rose::default().directions().unwrap();
        let degrees: Vec<f64> = directions.angles().map(f64::to_degrees).collect();
        assert!(degrees.iter().zip([-15.0, 0.0, 15.0]).all(|(a, b)| (a - b).abs() < 1e-12));
        let drawn = [0.1, 0.5, 0.9].map(|chance| directions.draw(chance).to_degrees().round());
        assert_eq!(drawn, [-15.0, 0.0, 15.0]);
    }

    #[test]
    fn weights_share_the_time() {
        let often = Wind { weight: 3.0, ..Wind::steady(90.0) };
        let never = Wind { weight: 0.0, ..Wind::steady(10.0) };
        let rose = Rose { winds: vec![often, never, Wind::steady(0.0)] };
        let directions = rose.directions().unwrap();
        let north = (0..1000).filter(|&n| directions.draw(f64::from(n) / 1000.0) > 1.0).count();
        assert_eq!(north, 750);
        assert!(directions.draw(0.999_999_999_999) < 0.1);
    }

    #[test]
    fn bad_roses_are_refused() {
        let with = |wind: Wind| Rose { winds: vec![wind] }.validate();
        assert_eq!(Rose { winds: vec![] }.validate(), Err(DuneError::NoWind));
        for wind in [
            Wind { towards_deg: f64::NAN, ..Wind::default() },
            Wind { weight: -1.0, ..Wind::default() },
            Wind { weight: 0.0, ..Wind::default() },
            Wind { spread_deg: 200.0, ..Wind::default() },
            Wind { directions: 0, ..Wind::default() },
        ] {
            assert!(matches!(with(wind.clone()), Err(DuneError::Range { .. })), "{wind:?}");
        }
    }

    /// The mean jump has the wind's direction and length, whole nodes are exact.
    #[test]
    fn jumps_keep_length_and_direction_on_average() {
        for degrees in [0.0_f64, 15.0, 45.0, 100.0, 180.0, 260.0, 333.0] {
            let wind = WindLine::new(degrees.to_radians(), 0.0);
            let mut mean = [0.0; 2];
            let fine = 200;
            for (a, b) in (0..fine).flat_map(|a| (0..fine).map(move |b| (a, b))) {
                let chances = [a, b].map(|n| (f64::from(n) + 0.5) / f64::from(fine));
                let jump = wind.jump(7.3, chances);
                mean = [0, 1].map(|i| mean[i] + jump[i] as f64 / f64::from(fine * fine));
            }
            let expected = [7.3 * degrees.to_radians().cos(), -7.3 * degrees.to_radians().sin()];
            let error = (mean[0] - expected[0]).hypot(mean[1] - expected[1]);
            assert!(error < 0.03, "{degrees} degrees: {mean:?}, expected {expected:?}");
        }
        assert_eq!(WindLine::new(std::f64::consts::FRAC_PI_2, 0.5).jump(5.0, [0.99; 2]), [0, -5]);
        assert_eq!(WindLine::new(0.0, 0.5).jump(0.0, [0.0; 2]), [1, 0]);
    }

    /// Lines of one wind never meet: at any step they are shifted by the same nodes.
    #[test]
    fn shifts_grow_by_at_most_one() {
        for degrees in 0..360 {
            let wind = WindLine::new(f64::from(degrees).to_radians(), 0.7);
            for step in -50..50 {
                assert!((wind.shift(step + 1) - wind.shift(step)).abs() <= 1);
            }
            assert!((1.0..1.415).contains(&wind.step_length()));
        }
    }
}
