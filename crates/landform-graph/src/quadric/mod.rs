//! Quadratic fitting: value, gradient, second derivatives and Laplacian of a field (thesis,
//! section 3.2.3, after Feddema and Little 1997).
//!
//! A quadric `q(r) = c + g.r + r.H.r / 2` is fitted by least squares to the nodes of a window
//! around a node: 3 x 3 nodes on a `FourEight` or `Eight` lattice, 3 x 3 x 3 on `Voxel18` and
//! `Voxel26`. Over such a window the least-squares problem separates into averages, slopes
//! and curvatures along the axes, so that no system of equations is solved. On a `Four` or
//! `Voxel6` lattice the window is the cross of the node's neighbours: the quadric goes
//! through the node, and its mixed derivatives, which a cross does not see, are zero.
//!
//! Where an open axis ends, the window (of a cross: the line of three nodes) stays inside the
//! lattice and the quadric is evaluated off its centre. Axes of two nodes are fitted by a
//! line, axes of one node by a constant.
//!
//! Order: exact for every quadric field. Of smooth fields, the gradient is of second order in
//! the spacing everywhere; second derivatives are of second order inside and of first order
//! at open borders.

mod fields;
mod line;

use glam::{DMat3, DVec3};

use self::line::{Axis, Line};
use crate::{Connectivity, Edge, Lattice};

pub use self::fields::{gradient_field, laplacian_field};

/// The quadric fitted around a node, in the frame x east, y north, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    /// Value at the node: smoothed by a window, the node's own on a cross.
    pub value: f64,
    /// First derivatives, in units of the field a metre. It points uphill.
    pub gradient: DVec3,
    /// Second derivatives, in units of the field a square metre; symmetric.
    pub hessian: DMat3,
}

impl Quadric {
    /// Fits a quadric to `field` (one value a node) around `node`.
    ///
    /// Cost: 9 or 27 values read over a window, 5 or 7 over a cross.
    ///
    /// # Panics
    /// If `node` does not lie in the lattice or `field` is shorter than the lattice.
    pub fn fit(lattice: &Lattice, field: &[f64], node: usize) -> Self {
        let axes = Axis::around(lattice, node);
        let steps = match lattice.connectivity() {
            Connectivity::Four | Connectivity::Voxel6 => Self::over_cross(&axes, field, node),
            _ => Self::over_window(&axes, field),
        };
        steps.in_metres(lattice.spacing())
    }

    /// Sum of the second derivatives along the axes.
    pub fn laplacian(&self) -> f64 {
        let [x, y, z] = [self.hessian.x_axis.x, self.hessian.y_axis.y, self.hessian.z_axis.z];
        x + y + z
    }

    /// Derivatives in steps along columns, rows and layers, from the axes through the node.
    fn over_cross(axes: &[Axis; 3], field: &[f64], node: usize) -> Self {
        let lines: [Line; 3] = std::array::from_fn(|axis| {
            let through = |index: usize| axes[axis].line_through(node, index);
            axes[axis].fit(|index| field[through(index)])
        });
        let gradient = std::array::from_fn(|axis| {
            lines[axis].slope + lines[axis].curvature * axes[axis].off_centre
        });
        let curvatures = DVec3::from_array(lines.map(|line| line.curvature));
        Self {
            value: field[node],
            gradient: DVec3::from_array(gradient),
            hessian: DMat3::from_diagonal(curvatures),
        }
    }

    /// Derivatives in steps along columns, rows and layers, by least squares over the window.
    fn over_window(axes: &[Axis; 3], field: &[f64]) -> Self {
        let [x_axis, y_axis, z_axis] = axes;
        // Each fit turns the values along one axis into mean, slope and curvature.
        let along_x = |y, z| x_axis.fit(|x| field[x_axis.at(x) + y_axis.at(y) + z_axis.at(z)]);
        let mut rows = [[Line::default(); 3]; 3];
        for (z, rows) in rows.iter_mut().enumerate().take(z_axis.count()) {
            for (y, row) in rows.iter_mut().enumerate().take(y_axis.count()) {
                *row = along_x(y, z);
            }
        }
        let along_y = |z: usize, part: fn(Line) -> f64| y_axis.fit(|y| part(rows[z][y]));
        let along_z = |first: fn(Line) -> f64, second: fn(Line) -> f64| {
            z_axis.fit(|z| second(along_y(z, first)))
        };
        let (mean, slope, curvature) = (Line::mean, Line::slope, Line::curvature);
        let base = along_z(mean, mean);
        let (x, y) = (along_z(slope, mean), along_z(mean, slope));
        let xx = along_z(curvature, mean).mean;
        let yy = along_z(mean, curvature).mean;
        let xy = along_z(slope, slope).mean;
        let (xz, yz, zz) = (x.slope, y.slope, base.curvature);
        let hessian = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        let centre = Self {
            value: base.mean - 0.5 * DVec3::new(xx, yy, zz).dot(Axis::spreads(axes)),
            gradient: DVec3::new(x.mean, y.mean, base.slope),
            hessian,
        };
        centre.moved(DVec3::from_array([x_axis, y_axis, z_axis].map(|axis| axis.off_centre)))
    }

    /// The same quadric about a point `offset` from the present one.
    fn moved(self, offset: DVec3) -> Self {
        let bent = self.hessian * offset;
        Self {
            value: self.value + self.gradient.dot(offset) + 0.5 * bent.dot(offset),
            gradient: self.gradient + bent,
            hessian: self.hessian,
        }
    }

    /// From steps of columns, rows and layers (rows run south) to metres east, north and up.
    fn in_metres(self, spacing: f64) -> Self {
        let flip = DVec3::new(1.0, -1.0, 1.0) / spacing;
        let scale = DMat3::from_diagonal(flip);
        Self {
            value: self.value,
            gradient: self.gradient * flip,
            hessian: scale * self.hessian * scale,
        }
    }
}

/// The edge over which `height` falls most steeply from `node`, with the slope (fall in
/// units of the field a metre of edge); `None` in pits and on flats.
///
/// Of equally steep edges the first in neighbour order is taken. Heights that are not numbers
/// are never lower.
///
/// # Panics
/// If `node` does not lie in the lattice or `height` is shorter than the lattice.
pub fn steepest_descent(lattice: &Lattice, height: &[f64], node: usize) -> Option<(Edge, f64)> {
    let mut steepest: Option<(Edge, f64)> = None;
    for edge in lattice.neighbours(node) {
        let slope = (height[node] - height[edge.node]) / edge.distance;
        if slope > steepest.map_or(0.0, |(_, most)| most) {
            steepest = Some((edge, slope));
        }
    }
    steepest
}

#[cfg(test)]
mod tests;
