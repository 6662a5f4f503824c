//! The upwind discretisation of the eikonal equation at one node.

/// What one axis tells of the arrival at a node: `weight * (t - value)^2` is the square of
/// the upwind difference along it, in node spacings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Upwind {
    /// Time upwind along the axis.
    pub value: f64,
    /// Square of the leading coefficient of the difference.
    pub weight: f64,
}

impl Upwind {
    /// No front comes along the axis.
    pub const NONE: Self = Self { value: f64::INFINITY, weight: 0.0 };

    /// First order: `t - near`.
    pub fn first(near: f64) -> Self {
        Self { value: near, weight: 1.0 }
    }

    /// Second order: `(3 t - 4 near + far) / 2`, for `far <= near`.
    pub fn second(near: f64, far: f64) -> Self {
        Self { value: (4.0 * near - far) / 3.0, weight: 2.25 }
    }
}

/// Solves `sum of weight_i (t - value_i)^2 = cost^2` for the latest `t` over the axes that
/// lie upwind of it; infinite when no axis does. `cost` is the spacing over the speed.
///
/// Axes are taken in the order of their values, for as long as the front arrives after them.
pub(super) fn arrival(mut axes: [Upwind; 3], cost: f64) -> f64 {
    sort_by_value(&mut axes);
    let start = axes[0].value;
    if start == f64::INFINITY {
        return f64::INFINITY;
    }
    // Times are counted from the earliest value, which keeps differences of large times.
    let (mut a, mut b, mut c) = (0.0, 0.0, -cost * cost);
    let mut elapsed = f64::INFINITY;
    for axis in axes {
        let value = axis.value - start;
        if value >= elapsed || value == f64::INFINITY {
            break;
        }
        a += axis.weight;
        b += axis.weight * value;
        c += axis.weight * value * value;
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            break;
        }
        elapsed = (b + discriminant.sqrt()) / a;
    }
    start + elapsed
}

#[inline]
fn sort_by_value(axes: &mut [Upwind; 3]) {
    for (first, second) in [(0, 1), (1, 2), (0, 1)] {
        if axes[second].value < axes[first].value {
            axes.swap(first, second);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn one_axis_adds_the_cost() {
        let axes = [Upwind::NONE, Upwind::first(3.0), Upwind::NONE];
        assert_eq!(arrival(axes, 2.0), 5.0);
        assert_eq!(arrival([Upwind::NONE; 3], 2.0), f64::INFINITY);
    }

    #[test]
    fn a_plane_front_is_exact() {
        let diagonal = arrival([Upwind::first(0.0), Upwind::first(0.0), Upwind::NONE], 1.0);
        assert!((diagonal - 0.5_f64.sqrt()).abs() < 1e-15);
        let late = arrival([Upwind::first(0.0), Upwind::first(1.5), Upwind::NONE], 1.0);
        assert_eq!(late, 1.0);
    }

    proptest! {
        /// The residual with all axes counted where `t` lies beyond them is the cost.
        #[test]
        fn arrival_solves_the_upwind_equation(
            values in prop::array::uniform3(0.0..3.0_f64),
            falls in prop::array::uniform3(0.0..1.0_f64), cost in 0.01..5.0_f64,
            second in prop::array::uniform3(any::<bool>()),
        ) {
            let axes: [Upwind; 3] = std::array::from_fn(|axis| match second[axis] {
                true => Upwind::second(values[axis], values[axis] - falls[axis]),
                false => Upwind::first(values[axis]),
            });
            let time = arrival(axes, cost);
            let sum: f64 =
                axes.iter().map(|axis| axis.weight * (time - axis.value).max(0.0).powi(2)).sum();
            prop_assert!((sum.sqrt() - cost).abs() < 1e-9, "{axes:?}: {time}");
        }
    }
}
