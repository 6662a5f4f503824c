//! Signed distance from the zero level of a field.

use super::{FastMarching, MarchError, MarchOptions, Speed, check_length};
use crate::Lattice;

impl FastMarching {
    /// Writes the distance in metres from the zero level of `level` to every node, with the
    /// sign of `level`: positive outside, negative inside, 0 where `level` is 0.
    ///
    /// Nodes beside the zero level start at the distance from the plane through the points
    /// where `level`, linear from node to node, vanishes along the axes; the front marches
    /// away from there on both sides. Order: that of `options` for a smooth `level`; beside a
    /// mask, which tells no more than on which side a node lies, distances are off by up to
    /// half a spacing. Beyond `options.limit`, and where `level` has one sign everywhere,
    /// distances are infinite. Both slices hold one value a node.
    ///
    /// # Errors
    /// [`MarchError::Length`]; [`MarchError::Value`] in `level`.
    pub fn signed_distance(
        &mut self,
        lattice: &Lattice,
        level: &[f64],
        options: MarchOptions,
        distance: &mut [f64],
    ) -> Result<(), MarchError> {
        check_length(lattice, "distance", distance.len())?;
        let starts = interface_starts(lattice, level)?;
        distance.copy_from_slice(level);
        distance.iter_mut().for_each(|d| *d = f64::INFINITY.copysign(*d));
        // Each side is an obstacle to the front on the other: second differences across the
        // zero level would take distances for level there.
        for side in [1.0, -1.0] {
            let speed: Vec<_> =
                level.iter().map(|level| f64::from(u8::from(level * side >= 0.0))).collect();
            let own: Vec<_> = starts.iter().copied().filter(|start| speed[start.0] > 0.0).collect();
            let found = self.solve(lattice, Speed::Field(&speed), &own, options)?;
            for &node in found.order {
                distance[node as usize] = side * found.time[node as usize];
            }
        }
        Ok(())
    }
}

/// The nodes beside the zero level of `level` with their distances from it in metres: the
/// starts of a front that is the zero level, for [`FastMarching::solve`] (divide by the speed).
///
/// # Errors
/// [`MarchError::Length`]; [`MarchError::Value`].
pub fn interface_starts(lattice: &Lattice, level: &[f64]) -> Result<Vec<(usize, f64)>, MarchError> {
    check_length(lattice, "level", level.len())?;
    if let Some(node) = level.iter().position(|value| value.is_nan()) {
        return Err(MarchError::Value { field: "level", node, value: level[node] });
    }
    let start = |node| distance_from_zero(lattice, level, node).map(|distance| (node, distance));
    Ok((0..lattice.node_count()).filter_map(start).collect())
}

/// Distance in metres of a node beside the zero level; `None` elsewhere.
fn distance_from_zero(lattice: &Lattice, level: &[f64], node: usize) -> Option<f64> {
    let own = level[node];
    if own == 0.0 {
        return Some(0.0);
    }
    // Distance along each axis to where the level would vanish, in node spacings; beyond a
    // neighbour of the same sign it is extrapolated.
    let mut crossings = [f64::INFINITY; 3];
    let mut beside = false;
    for edge in lattice.neighbours(node) {
        let Some(axis) = axis_of(edge.step) else { continue };
        let other = level[edge.node];
        beside |= own.signum() != other.signum() && other != 0.0;
        crossings[axis] = crossings[axis].min(crossing(own, other));
    }
    let inverse_squares: f64 = crossings.iter().map(|&distance| distance.powi(-2)).sum();
    beside.then(|| lattice.spacing() / inverse_squares.sqrt())
}

/// Where the line from `own` to `other` vanishes; infinite if it runs away from zero.
fn crossing(own: f64, other: f64) -> f64 {
    let opposite = own.signum() != other.signum();
    if opposite && own.is_infinite() && other.is_infinite() {
        // A mask, whose border lies half way.
        return 0.5;
    }
    // Dividing by `own` first keeps the difference of huge levels finite.
    let position = 1.0 / (1.0 - other / own);
    if opposite || position > 0.0 { position } else { f64::INFINITY }
}

/// The axis of a step that moves along one axis only.
fn axis_of(step: [i8; 3]) -> Option<usize> {
    match step {
        [_, 0, 0] => Some(0),
        [0, _, 0] => Some(1),
        [0, 0, _] => Some(2),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Order;
    use super::*;
    use crate::{Boundary, Connectivity};

    /// Largest error of the distance from a circle of radius 0.6 on a unit square, away from
    /// its centre, where the distance has a kink.
    fn error(nodes: usize, order: Order) -> f64 {
        let spacing = 2.0 / (nodes - 1) as f64;
        let lattice =
            Lattice::plane([nodes, nodes], spacing, Connectivity::Eight, [Boundary::Open; 2]);
        let lattice = lattice.unwrap();
        let centre = glam::DVec3::new(1.0, 1.0, 0.0);
        let exact = |node: usize| lattice.position(node).distance(centre) - 0.6;
        let level: Vec<_> = (0..lattice.node_count()).map(exact).collect();
        let mut distance = vec![0.0; level.len()];
        let options = MarchOptions { order, ..Default::default() };
        let mut marching = FastMarching::new();
        marching.signed_distance(&lattice, &level, options, &mut distance).unwrap();
        let errors = level.iter().zip(&distance).filter(|(exact, _)| **exact > -0.4);
        errors.map(|(exact, found)| (exact - found).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn signed_distance_converges_at_its_order() {
        for (order, least) in [(Order::First, 0.85), (Order::Second, 1.7)] {
            let (coarse, fine) = (error(51, order), error(101, order));
            let rate = (coarse / fine).log2();
            assert!(rate > least && rate < 2.5, "{order:?}: {coarse} {fine}, order {rate}");
        }
    }

    #[test]
    fn one_sign_is_infinitely_far_and_bad_fields_are_refused() {
        let lattice = Lattice::plane([3, 2], 1.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
        let mut distance = [0.0; 6];
        let mut marching = FastMarching::new();
        let mut signed = |level: &[f64]| {
            let options = MarchOptions::default();
            marching.signed_distance(&lattice, level, options, &mut distance).map(|()| distance)
        };
        assert_eq!(signed(&[-1.0; 6]), Ok([f64::NEG_INFINITY; 6]));
        let nan = signed(&[1.0, f64::NAN, 0.0, 0.0, 0.0, 0.0]);
        assert!(matches!(nan, Err(MarchError::Value { field: "level", node: 1, .. })));
        let short = MarchError::Length { field: "level", expected: 6, found: 2 };
        assert_eq!(signed(&[1.0, -1.0]), Err(short));
        let huge = [f64::MAX, -f64::MAX, -1.0, f64::MAX, -f64::MAX, -1.0];
        assert_eq!(signed(&huge), Ok([0.5, -0.5, -1.5, 0.5, -0.5, -1.5]));
        let tiny = [f64::MIN_POSITIVE, -1.0, -2.0, f64::MIN_POSITIVE, -1.0, -2.0];
        let tiny = signed(&tiny).unwrap();
        assert!(tiny[0] >= 0.0 && tiny[0] < 1e-300 && tiny[1] == -1.0, "{tiny:?}");
        assert_eq!(signed(&[-1.0, 0.0, 1.0, -1.0, 0.0, 1.0]), Ok([-1.0, 0.0, 1.0, -1.0, 0.0, 1.0]));
    }
}
