//! Hypsometry: how much of a terrain lies above each height.

mod curve;
mod family;
mod form;

pub use curve::{HypsometricCurve, HypsometryError};
pub use family::{FamilyFit, StrahlerCurve};
pub use form::{HypsometricForm, HypsometricStage};

use serde::Serialize;

/// The hypsometric analysis of the thesis (section 2.4.1) in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Hypsometry {
    /// Hypsometric integral, the area under the curve: (mean - lowest) / (highest - lowest).
    pub integral: f64,
    /// Stage of erosion.
    pub stage: HypsometricStage,
    /// Ratio a/d of the model curve that fits best (equation 2.9).
    pub a_over_d: f64,
    /// Exponent z of the model curve that fits best.
    pub z: f64,
    /// Shape of the curve.
    pub form: HypsometricForm,
    /// Root mean square distance of the curve from the model curve, in relative heights.
    pub misfit: f64,
}

impl Hypsometry {
    /// Fits equation 2.9 to the curve and names its form and stage.
    pub fn new(curve: &HypsometricCurve) -> Self {
        let fit = FamilyFit::new(curve);
        let form = HypsometricForm::new(curve, &fit);
        Self {
            integral: curve.integral(),
            stage: HypsometricStage::new(form, curve.integral()),
            a_over_d: fit.curve.a_over_d(),
            z: fit.curve.z(),
            form,
            misfit: fit.misfit,
        }
    }
}
