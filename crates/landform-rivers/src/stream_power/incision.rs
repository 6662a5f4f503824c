//! Incision by stream power over a time step, by backward Euler along the rivers.

use landform_graph::Lattice;

use super::{Routes, StreamPowerErosion};

/// Most steps of Newton's method: from where it starts a few suffice.
const MOST_STEPS: usize = 64;

/// Areas, in nodes, whose powers are kept.
const KEPT: usize = 1024;

/// What a river cuts in a time step `dt`: `K A^m S^n dt`.
#[derive(Clone, Debug)]
pub struct StreamPowerLaw {
    /// K dt a^m / d^n of each of the eight steps, a the area of a node and d the length of the step.
    strength: [f64; 8],
    /// n^m of n nodes.
    powers: Vec<f64>,
    area_exponent: f64,
    slope_exponent: f64,
}

impl StreamPowerLaw {
    /// The law of a process on a lattice.
    pub fn new(lattice: &Lattice, settings: &StreamPowerErosion) -> Self {
        let [m, n] = [settings.area_exponent, settings.slope_exponent];
        let spacing = lattice.spacing();
        let strength = settings.erodibility_m_per_yr * settings.step_yr * spacing.powf(2.0 * m);
        let [axis, diagonal, _] = lattice.edge_lengths().map(|length| strength / length.powf(n));
        Self {
            strength: [axis, axis, axis, axis, diagonal, diagonal, diagonal, diagonal],
            powers: (0..KEPT).map(|cells| (cells as f64).powf(m)).collect(),
            area_exponent: m,
            slope_exponent: n,
        }
    }

    /// How far a node stays above the node that takes its water if it was `height` metres above it
    /// before: the root of `x + F x^n = height`, with `F = K A^m dt / d^n`, the area given in nodes.
    #[inline]
    pub fn remains(&self, height: f64, cells: u32, direction: u8) -> f64 {
        let power = match self.powers.get(cells as usize) {
            Some(power) => *power,
            None => f64::from(cells).powf(self.area_exponent),
        };
        let strength = self.strength[usize::from(direction & 7)] * power;
        if self.slope_exponent == 1.0 {
            return height / (1.0 + strength);
        }
        height * root(strength * height.powf(self.slope_exponent - 1.0), self.slope_exponent)
    }
}

/// The root between 0 and 1 of `t + G t^n = 1`.
///
/// Newton's method on the convex one of `t` and `t^n`, from above, where it falls steadily towards the
/// root.
fn root(g: f64, n: f64) -> f64 {
    if !g.is_finite() {
        return 0.0;
    }
    // t = s^(1 / n) turns an exponent below 1 into one above.
    let [linear, curved, p] = if n > 1.0 { [1.0, g, n] } else { [g, 1.0, n.recip()] };
    let mut s = linear.recip().min(curved.powf(-p.recip())).min(1.0);
    for _ in 0..MOST_STEPS {
        let power = s.powf(p - 1.0);
        let next = s - (linear * s + curved * s * power - 1.0) / (linear + p * curved * power);
        if next >= s * (1.0 - 1e-15) {
            break;
        }
        s = next;
    }
    if n > 1.0 { s } else { s.powf(p) }
}

/// Cuts rivers into `bed` (metres) for a time step: every node comes to lie above the node that takes
/// its water as [`StreamPowerLaw::remains`] says, from the outlets upwards, so that all see the heights
/// at the end of the step.
///
/// `surface` holds at the outlets the level of the water that they lead to, and is filled with that of
/// the ground or of the lake on it: a node below the surface of the node that takes its water lies under
/// a lake and is not cut. `cut` takes what each node lost, in metres.
///
/// # Panics
/// If the slices do not have a value a node.
pub fn incise(
    routes: &Routes,
    law: &StreamPowerLaw,
    bed: &mut [f64],
    surface: &mut [f64],
    cut: &mut [f64],
) {
    let cells = routes.cells();
    for node in routes.downstream().rev() {
        let (Some(receiver), Some(direction)) = (routes.receiver(node), routes.direction(node))
        else {
            cut[node] = 0.0;
            continue;
        };
        let base = surface[receiver];
        let height = bed[node] - base;
        if height <= 0.0 {
            surface[node] = base;
            cut[node] = 0.0;
            continue;
        }
        let after = base + law.remains(height, cells[node], direction);
        cut[node] = bed[node] - after;
        bed[node] = after;
        surface[node] = after;
    }
}
