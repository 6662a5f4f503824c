//! Search along a ray with a given direction (thesis, section 3.2.3).
//!
//! Two rays are offered. [`Lattice::ray`] samples the line: one node a column, row or layer
//! of the axis along which the line runs most, the one nearest to the line, as in the line
//! drawing of Bresenham (1965). [`Lattice::walk`] follows edges, so that consecutive nodes
//! are always neighbours and a filter on edges can end it: `walk.take_while(|step| ...)`.
//! Both wrap on periodic axes, end where an open axis ends, and allocate nothing.
//!
//! Limits: an endless ray on a lattice that is periodic along the ray never ends by itself.

use glam::DVec3;

use crate::{Edge, Lattice};

/// A node on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayStep {
    /// Index of the node.
    pub node: usize,
    /// Distance in metres from the start to the point of the ray nearest to which the node
    /// was chosen: where the line crosses the node's column, row or layer.
    pub distance: f64,
}

/// The nodes along a line, the start left out: see [`Lattice::ray`].
#[derive(Clone, Debug)]
pub struct Ray<'a> {
    lattice: &'a Lattice,
    origin: [usize; 3],
    /// Columns, rows and layers that the line moves from one node to the next.
    increment: [f64; 3],
    /// Metres from one node to the next along the line.
    stride: f64,
    length: f64,
    steps: u64,
}

impl Iterator for Ray<'_> {
    type Item = RayStep;

    #[inline]
    fn next(&mut self) -> Option<RayStep> {
        let count = (self.steps + 1) as f64;
        let distance = count * self.stride;
        // Written so that a stride which is not a number ends the ray.
        if !(distance <= self.length && distance.is_finite()) {
            return None;
        }
        let offset = self.increment.map(|step| (count * step).round() as isize);
        match self.lattice.offset(self.origin, offset) {
            Some(node) => {
                self.steps += 1;
                Some(RayStep { node, distance })
            }
            None => {
                self.length = f64::NEG_INFINITY;
                None
            }
        }
    }
}

impl std::iter::FusedIterator for Ray<'_> {}

/// A step of a walk along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkStep {
    /// The node that the step leaves.
    pub from: usize,
    /// The edge that it takes.
    pub edge: Edge,
    /// Progress in metres along the line at the end of the step.
    pub distance: f64,
}

/// A path over edges along a line: see [`Lattice::walk`].
#[derive(Clone, Debug)]
pub struct Walk<'a> {
    lattice: &'a Lattice,
    node: usize,
    /// Unit vector in columns, rows and layers.
    direction: DVec3,
    /// Columns, rows and layers moved from the start, not wrapped.
    moved: DVec3,
    length: f64,
}

impl Iterator for Walk<'_> {
    type Item = WalkStep;

    fn next(&mut self) -> Option<WalkStep> {
        let mut best: Option<(f64, f64, Edge)> = None;
        for edge in self.lattice.neighbours(self.node) {
            let step = DVec3::from_array(edge.step.map(f64::from));
            let moved = self.moved + step;
            let progress = moved.dot(self.direction);
            let offset = (moved - progress * self.direction).length_squared();
            let forward = step.dot(self.direction) > 0.0;
            if forward && best.is_none_or(|(least, _, _)| offset < least - TIE) {
                best = Some((offset, progress, edge));
            }
        }
        let (_, progress, edge) = best?;
        let distance = progress * self.lattice.spacing();
        if distance > self.length {
            return None;
        }
        let from = std::mem::replace(&mut self.node, edge.node);
        self.moved += DVec3::from_array(edge.step.map(f64::from));
        Some(WalkStep { from, edge, distance })
    }
}

/// Squared node spacings by which a step must be nearer to the line to be preferred, so that
/// rounding does not decide between steps that are equally near.
const TIE: f64 = 1e-9;

impl Lattice {
    /// Direction in columns, rows and layers of `angle_rad`, counter-clockwise from east.
    pub fn map_direction(angle_rad: f64) -> DVec3 {
        DVec3::new(angle_rad.cos(), angle_rad.sin(), 0.0)
    }

    /// The nodes along the ray from `node` at `angle_rad` (counter-clockwise from east on the
    /// map) up to `length_m` metres, nearest first, `node` itself left out.
    ///
    /// `node` must lie in the lattice. Cost: constant a node, whatever the angle.
    pub fn ray(&self, node: usize, angle_rad: f64, length_m: f64) -> Ray<'_> {
        self.ray_along(node, Self::map_direction(angle_rad), length_m)
    }

    /// As [`Lattice::ray`], along a vector (x east, y north, z up) of any length. A vector
    /// that is zero or not finite gives no nodes; 2-D lattices ignore z.
    ///
    /// Halves are rounded away from the start, so that opposite rays are mirror images.
    pub fn ray_along(&self, node: usize, direction: DVec3, length_m: f64) -> Ray<'_> {
        let direction = self.in_steps(direction);
        let increment = direction / direction.abs().max_element();
        Ray {
            lattice: self,
            origin: self.coordinates(node),
            increment: increment.to_array(),
            stride: increment.length() * self.spacing(),
            length: length_m,
            steps: 0,
        }
    }

    /// The path over edges that keeps nearest to the line from `node` along `direction`
    /// (x east, y north, z up; any length), up to `length_m` metres of progress along it.
    ///
    /// Every step goes forward and, of the edges that do, takes the one whose end is nearest
    /// to the line; ties go to the first in neighbour order. The walk ends at open borders. A
    /// vector that is zero or not finite gives no steps. Cost: one neighbour search a step.
    pub fn walk(&self, node: usize, direction: DVec3, length_m: f64) -> Walk<'_> {
        let direction = self.in_steps(direction).normalize_or_zero();
        Walk { lattice: self, node, direction, moved: DVec3::ZERO, length: length_m }
    }

    /// A vector (x east, y north, z up) in columns, rows and layers.
    fn in_steps(&self, direction: DVec3) -> DVec3 {
        let up = if self.connectivity().is_volume() { direction.z } else { 0.0 };
        DVec3::new(direction.x, -direction.y, up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::any_lattice;
    use crate::{Boundary, Connectivity};
    use proptest::prelude::*;

    fn plane(size: usize, connectivity: Connectivity, boundary: Boundary) -> Lattice {
        Lattice::plane([size, size], 2.0, connectivity, [boundary; 2]).unwrap()
    }

    fn nodes(ray: Ray<'_>) -> Vec<usize> {
        ray.map(|step| step.node).collect()
    }

    #[test]
    fn rays_along_the_axes_follow_the_compass() {
        let lattice = plane(5, Connectivity::Eight, Boundary::Open);
        let centre = lattice.node([2, 2, 0]);
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_eq!(nodes(lattice.ray(centre, 0.0, 9.0)), [13, 14]);
        assert_eq!(nodes(lattice.ray(centre, quarter, 9.0)), [7, 2]);
        assert_eq!(nodes(lattice.ray(centre, 2.0 * quarter, 9.0)), [11, 10]);
        assert_eq!(nodes(lattice.ray(centre, 3.0 * quarter, 9.0)), [17, 22]);
        let diagonal = lattice.ray_along(centre, DVec3::new(3.0, 3.0, 0.0), 9.0);
        assert_eq!(nodes(diagonal), [8, 4]);
    }

    #[test]
    fn length_is_measured_along_the_line() {
        let lattice = plane(9, Connectivity::Eight, Boundary::Open);
        let diagonal = DVec3::new(1.0, -1.0, 0.0);
        let steps: Vec<_> = lattice.ray_along(0, diagonal, 6.0).collect();
        let root = 8.0_f64.sqrt();
        assert_eq!(steps.len(), 2);
        assert!((steps[0].distance - root).abs() < 1e-12);
        assert!((steps[1].distance - 2.0 * root).abs() < 1e-12);
    }

    #[test]
    fn rays_wrap_on_periodic_axes() {
        let lattice = plane(4, Connectivity::Four, Boundary::Periodic);
        assert_eq!(nodes(lattice.ray(3, 0.0, 12.0)), [0, 1, 2, 3, 0, 1]);
    }

    #[test]
    fn directions_without_meaning_give_nothing() {
        let lattice = plane(4, Connectivity::Four, Boundary::Periodic);
        for direction in [DVec3::ZERO, DVec3::NAN, DVec3::new(f64::INFINITY, 1.0, 0.0), DVec3::Z] {
            assert_eq!(lattice.ray_along(0, direction, 100.0).next(), None);
            assert_eq!(lattice.walk(0, direction, 100.0).next(), None);
        }
        assert_eq!(lattice.ray(0, 0.3, f64::NAN).next(), None);
    }

    /// Distance of a point from the line, in node spacings.
    fn distance_to_line(point: DVec3, direction: DVec3) -> f64 {
        (point - point.dot(direction) * direction).length()
    }

    proptest! {
        /// Of all nodes of its column (row, layer), the ray takes the nearest to the line.
        #[test]
        fn every_node_of_a_ray_is_nearest_to_the_line(
            x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in -1.0..1.0_f64,
        ) {
            let size = [23, 23, 23];
            let lattice =
                Lattice::volume(size, 2.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap();
            let start = lattice.node([11; 3]);
            let direction = DVec3::new(x, y, z);
            let along = DVec3::new(x, -y, z);
            let axis = (0..3).max_by(|&a, &b| along[a].abs().total_cmp(&along[b].abs())).unwrap();
            let steps: Vec<_> = lattice.ray_along(start, direction, 1e3).collect();
            prop_assert_eq!(steps.len(), 11);
            for (index, step) in steps.iter().enumerate() {
                let crossing = along * ((index + 1) as f64 / along[axis].abs());
                let at = |node: usize| {
                    DVec3::from_array(lattice.coordinates(node).map(|c| c as f64 - 11.0))
                };
                let same_layer = |node: &usize| {
                    (at(*node)[axis] - crossing[axis]).abs() < 0.5
                };
                let nearest = (0..lattice.node_count())
                    .filter(same_layer)
                    .map(|node| at(node).distance(crossing))
                    .fold(f64::INFINITY, f64::min);
                prop_assert!((at(step.node).distance(crossing) - nearest).abs() < 1e-9);
                prop_assert!((step.distance - 2.0 * crossing.length()).abs() < 1e-9);
            }
        }

        /// On every kind of lattice a walk uses edges, advances and keeps to the line.
        #[test]
        fn walks_keep_to_the_line(
            lattice in any_lattice(), start in 0..1000_usize,
            x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in -1.0..1.0_f64,
        ) {
            let start = start % lattice.node_count();
            let unit = lattice.in_steps(DVec3::new(x, y, z)).normalize();
            prop_assume!(unit.is_finite());
            let mut moved = DVec3::ZERO;
            let mut at = start;
            let length = 20.0 * lattice.spacing();
            let mut last = 0.0;
            for step in lattice.walk(start, DVec3::new(x, y, z), length) {
                prop_assert_eq!(step.from, at);
                prop_assert!(lattice.neighbours(at).any(|edge| edge == step.edge));
                moved += DVec3::from_array(step.edge.step.map(f64::from));
                at = step.edge.node;
                prop_assert!(step.distance > last && step.distance <= length);
                last = step.distance;
            }
            let axes = if lattice.connectivity().is_volume() { 3 } else { 2 };
            let open = (0..axes).any(|axis| !lattice.is_periodic(axis));
            prop_assert!(open || last > length - 2.0 * lattice.spacing());
            // Near an open border a walk may slide along it, so only full tori are held to this.
            prop_assert!(open || distance_to_line(moved, unit) < 1.0);
        }

        #[test]
        fn opposite_rays_are_mirror_images(angle in -7.0..7.0_f64) {
            let lattice = plane(31, Connectivity::Eight, Boundary::Periodic);
            let start = lattice.node([15, 15, 0]);
            let mirrored = |node: usize| {
                let [x, y, _] = lattice.coordinates(node);
                lattice.node([30 - x, 30 - y, 0])
            };
            let direction = Lattice::map_direction(angle);
            let there = nodes(lattice.ray_along(start, direction, 30.0));
            let back = nodes(lattice.ray_along(start, -direction, 30.0));
            prop_assert!(there.iter().map(|&node| mirrored(node)).eq(back));
        }
    }
}
