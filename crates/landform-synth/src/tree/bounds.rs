//! What is known of a node in a region: ranges and Lipschitz constants.

/// Ranges and slopes that a node of a tree never leaves in a region. Slopes are Lipschitz constants: two
/// places `x` metres apart differ by at most `slope * x`, as far as the node has weight between
/// them; a whole terrain has weight everywhere.
///
/// `L` stands for [`Bounds::slope`], `F` for [`Bounds::faded_slope`], `A` for
/// [`Bounds::weight_slope`] in the formulas of the nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least and greatest elevation in metres where the node has weight.
    pub elevation_m: [f64; 2],
    /// Least and greatest weight.
    pub weight: [f64; 2],
    /// Largest rise of the elevation a metre, `L`. Infinite for a blend that has places without
    /// weight: at their rim it may go from any child to any other within no distance.
    pub slope: f64,
    /// Largest product of the elevation's rise a metre and the weight, which counts as 1 at most:
    /// `F`. It stays finite where blends fade out, and is what a node adds to the slope of one
    /// that it is laid on.
    pub faded_slope: f64,
    /// Largest change of the weight a metre, `A`.
    pub weight_slope: f64,
}

impl Bounds {
    /// Bounds of a surface with a slope of its own: `F = L min(1, greatest weight)`.
    pub(super) fn new(
        elevation_m: [f64; 2],
        slope: f64,
        weight: [f64; 2],
        weight_slope: f64,
    ) -> Self {
        let faded_slope = times(slope, weight[1].min(1.0));
        Self { elevation_m, weight, slope, faded_slope, weight_slope }
    }

    /// Bounds where there is nothing.
    pub(super) const NOTHING: Self = Self {
        elevation_m: [0.0; 2],
        weight: [0.0; 2],
        slope: 0.0,
        faded_slope: 0.0,
        weight_slope: 0.0,
    };

    /// Bounds of a surface that has weight 1 everywhere.
    pub(super) fn full(elevation_m: [f64; 2], slope: f64) -> Self {
        Self::new(elevation_m, slope, [1.0; 2], 0.0)
    }

    /// Bounds of the same surface with all slopes multiplied.
    pub(super) fn steepened(self, factor: f64) -> Self {
        Self {
            slope: times(self.slope, factor),
            faded_slope: times(self.faded_slope, factor),
            weight_slope: times(self.weight_slope, factor),
            ..self
        }
    }
}

/// A product in which 0 times infinity is 0.
pub(super) fn times(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}
