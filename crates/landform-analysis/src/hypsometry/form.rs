//! The form of a curve, and the stage of erosion that it stands for.

use serde::Serialize;

use super::{FamilyFit, HypsometricCurve};

/// How a hypsometric curve bends, from the summit down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HypsometricForm {
    /// Concave above, convex below: the usual form of eroded terrain (figure 2.12).
    ConcaveConvex,
    /// Concave throughout.
    Concave,
    /// No bend to speak of.
    Straight,
    /// Convex throughout (figure 2.13 a).
    Convex,
    /// Convex above, concave below (figure 2.13 c).
    ConvexConcave,
    /// More than one inflection (figure 2.13 b).
    ManyInflections,
}

/// Stage of erosion after Strahler (thesis, section 2.4.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HypsometricStage {
    /// Youth: most of the area still lies high; the integral is above 0.60.
    Inequilibrium,
    /// Maturity: the integral is 0.35 to 0.60.
    Equilibrium,
    /// Old age with isolated hills: the integral is below 0.35.
    Monadnock,
    /// A form that erosion by water does not make (figure 2.13).
    Unusual,
}

impl HypsometricStage {
    /// Integrals that bound the equilibrium stage (Strahler 1952).
    pub const EQUILIBRIUM: [f64; 2] = [0.35, 0.60];

    /// The stage of a curve with this form and integral.
    pub fn new(form: HypsometricForm, integral: f64) -> Self {
        use HypsometricForm::{Concave, ConcaveConvex, Straight};
        let [old, young] = Self::EQUILIBRIUM;
        match form {
            ConcaveConvex | Concave | Straight if integral > young => Self::Inequilibrium,
            ConcaveConvex | Concave | Straight if integral < old => Self::Monadnock,
            ConcaveConvex | Concave | Straight => Self::Equilibrium,
            _ => Self::Unusual,
        }
    }
}

/// Curves as near as this to Strahler's family bend as their model curve does.
const FAMILY_MISFIT: f64 = 0.025;
/// Parts of the area whose mean slopes are compared.
const PARTS: usize = 10;
/// Change of slope that is a bend; the mean slope of every curve is -1.
const BEND: f64 = 0.35;

impl HypsometricForm {
    /// The form of `curve`, of which `fit` is the nearest model curve.
    ///
    /// The curve is cut into ten parts of the same area, and the runs over which their slopes
    /// rise or fall by more than 0.35 are counted. A curve that bends, within 0.025 (root mean
    /// square) of the family, has the form of its model curve, which is known exactly.
    pub fn new(curve: &HypsometricCurve, fit: &FamilyFit) -> Self {
        let bends = bends(&slopes(curve));
        if !bends.is_empty() && fit.misfit <= FAMILY_MISFIT {
            return match fit.curve.inflection() {
                place if place >= 1.0 => Self::Concave,
                place if place <= 0.0 => Self::Convex,
                _ => Self::ConcaveConvex,
            };
        }
        match *bends {
            [] => Self::Straight,
            [true] => Self::Concave,
            [false] => Self::Convex,
            [true, false] => Self::ConcaveConvex,
            [false, true] => Self::ConvexConcave,
            _ => Self::ManyInflections,
        }
    }
}

/// Mean slope in each part.
fn slopes(curve: &HypsometricCurve) -> Vec<f64> {
    let height = |part: usize| curve.height_at(part as f64 / PARTS as f64);
    (0..PARTS).map(|part| (height(part + 1) - height(part)) * PARTS as f64).collect()
}

/// Alternating runs of rising (true) and falling slope that are larger than [`BEND`].
fn bends(slopes: &[f64]) -> Vec<bool> {
    let mut runs: Vec<bool> = Vec::new();
    let [mut lowest, mut highest] = [slopes[0]; 2];
    for &slope in slopes {
        lowest = lowest.min(slope);
        highest = highest.max(slope);
        match runs.last() {
            // Inside a run only its extreme moves on; a turn starts from there.
            Some(true) if slope == highest => lowest = slope,
            Some(false) if slope == lowest => highest = slope,
            _ => {}
        }
        let turned = [slope - lowest > BEND, highest - slope > BEND];
        if turned[0] && runs.last() != Some(&true) {
            runs.push(true);
            [lowest, highest] = [slope; 2];
        } else if turned[1] && runs.last() != Some(&false) {
            runs.push(false);
            [lowest, highest] = [slope; 2];
        }
    }
    runs
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::{Hypsometry, StrahlerCurve};
    use super::*;

    /// The curve of a terrain whose relative heights are `f` of the share above.
    pub(crate) fn sampled(f: &dyn Fn(f64) -> f64) -> HypsometricCurve {
        let heights: Vec<f64> = (0..=20_000).map(|k| f(f64::from(k) / 20_000.0)).collect();
        HypsometricCurve::new(&heights).unwrap()
    }

    fn analysed(f: &dyn Fn(f64) -> f64) -> Hypsometry {
        Hypsometry::new(&sampled(f))
    }

    /// Figure 2.11: curves with a/d of 0.01, 0.1 and 0.5. They have at most one inflection,
    /// with the concavity above, so each belongs to the stage of its integral.
    #[test]
    fn the_curves_of_figure_2_11_have_the_stage_of_their_integral() {
        use HypsometricStage::{Equilibrium, Inequilibrium, Monadnock};
        let mut seen = Vec::new();
        for ratio in [0.01, 0.1, 0.5] {
            for z in [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 0.9, 1.0, 1.5, 2.0, 3.0, 5.0]
            {
                let curve = StrahlerCurve::new(ratio, z).unwrap();
                let found = analysed(&|x| curve.height_at(x));
                let steps = 100_000;
                let integral = (0..steps)
                    .map(|k| curve.height_at((f64::from(k) + 0.5) / f64::from(steps)))
                    .sum::<f64>()
                    / f64::from(steps);
                let stage = match integral {
                    young if young > 0.6 => Inequilibrium,
                    old if old < 0.35 => Monadnock,
                    _ => Equilibrium,
                };
                assert_eq!(found.stage, stage, "{ratio} {z}: {found:?}");
                seen.push(stage);
            }
        }
        assert!([Inequilibrium, Equilibrium, Monadnock].iter().all(|stage| seen.contains(stage)));
    }

    /// Figure 2.13, and entirely convex members of the family.
    #[test]
    fn unusual_forms_are_named() {
        let pi = std::f64::consts::PI;
        for (f, form) in [
            (&(|x: f64| 1.0 - x * x) as &dyn Fn(f64) -> f64, HypsometricForm::Convex),
            (&|x: f64| (1.0 - x).sqrt(), HypsometricForm::Convex),
            (&|x: f64| 0.5 + 0.5 * (pi * x).cos(), HypsometricForm::ConvexConcave),
            (&|x: f64| 1.0 - x + 0.06 * (4.0 * pi * x).sin(), HypsometricForm::ManyInflections),
        ] {
            let found = analysed(f);
            assert_eq!((found.form, found.stage), (form, HypsometricStage::Unusual), "{found:?}");
        }
    }

    #[test]
    fn usual_forms_are_named() {
        use HypsometricForm::{Concave, ConcaveConvex, Straight};
        use HypsometricStage::{Equilibrium, Monadnock};
        for (f, form, stage) in [
            (&(|x: f64| 1.0 - x) as &dyn Fn(f64) -> f64, Straight, Equilibrium),
            (&|x: f64| 0.5 - 4.0 * (x - 0.5).powi(3), ConcaveConvex, Equilibrium),
            (&|x: f64| (1.0 - x).powi(3), Concave, Monadnock),
        ] {
            let found = analysed(f);
            assert_eq!((found.form, found.stage), (form, stage), "{found:?}");
        }
    }

    #[test]
    fn runs_of_slopes_are_counted_with_their_direction() {
        assert_eq!(bends(&[-1.0, -1.1, -0.9, -1.0]), [] as [bool; 0]);
        assert_eq!(bends(&[-3.0, -2.0, -1.0, -0.5]), [true]);
        assert_eq!(bends(&[-3.0, -1.0, -0.5, -0.7, -2.0]), [true, false]);
        assert_eq!(bends(&[-0.5, -0.7, -0.9, -0.7, -0.5]), [false, true]);
        assert_eq!(bends(&[-3.0, -0.5, -2.0, -0.5, -2.0]), [true, false, true, false]);
    }
}
