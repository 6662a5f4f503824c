//! Least-squares fits along one axis of a window.

use glam::DVec3;

use crate::Lattice;

/// The part of one axis that a window covers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Index offsets of the window's coordinates, from node 0; `count` are used.
    offsets: [usize; 3],
    count: usize,
    /// Steps from the middle of the window to the node.
    pub off_centre: f64,
    /// Index offset of the node's own coordinate.
    own: usize,
}

impl Axis {
    /// The parts of the three axes around a node.
    pub fn around(lattice: &Lattice, node: usize) -> [Self; 3] {
        let [width, height, _] = lattice.size();
        let strides = [1, width, width * height];
        let coordinates = lattice.coordinates(node);
        std::array::from_fn(|axis| {
            let (size, periodic) = (lattice.size()[axis], lattice.is_periodic(axis));
            Self::new(coordinates[axis], size, periodic, strides[axis])
        })
    }

    fn new(coordinate: usize, size: usize, periodic: bool, stride: usize) -> Self {
        let count = size.min(3);
        let first = match periodic {
            true => (coordinate + size - 1) % size,
            false => coordinate.saturating_sub(1).min(size - count),
        };
        let offsets = std::array::from_fn(|index| (first + index) % size * stride);
        // A periodic window wraps and is centred on its node.
        let from_first = if periodic { 1 } else { coordinate - first };
        let off_centre = from_first as f64 - (count - 1) as f64 / 2.0;
        Self { offsets, count, off_centre, own: coordinate * stride }
    }

    /// Number of coordinates that the window covers.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Index offset of one of the window's coordinates.
    pub fn at(&self, index: usize) -> usize {
        self.offsets[index]
    }

    /// The node on the line through `node` along this axis.
    pub fn line_through(&self, node: usize, index: usize) -> usize {
        node - self.own + self.offsets[index]
    }

    /// Fits the values along the axis, which `value` gives by index.
    pub fn fit(&self, value: impl Fn(usize) -> f64) -> Line {
        match self.count {
            1 => Line { mean: value(0), slope: 0.0, curvature: 0.0 },
            2 => {
                let [first, last] = [value(0), value(1)];
                Line { mean: (first + last) * 0.5, slope: last - first, curvature: 0.0 }
            }
            _ => Line::of(value(0), value(1), value(2)),
        }
    }

    /// Mean squares of the window's coordinates about its middle, for axes that can bend.
    pub fn spreads(axes: &[Self; 3]) -> DVec3 {
        DVec3::from_array(axes.map(|axis| if axis.count == 3 { 2.0 / 3.0 } else { 0.0 }))
    }
}

/// What a least-squares fit says of values along a line, in steps.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    /// Average of the values.
    pub mean: f64,
    /// First derivative in the middle.
    pub slope: f64,
    /// Second derivative.
    pub curvature: f64,
}

impl Line {
    /// The parabola through three values.
    #[inline(always)]
    pub fn of(first: f64, middle: f64, last: f64) -> Self {
        Self {
            mean: (first + middle + last) * (1.0 / 3.0),
            slope: (last - first) * 0.5,
            curvature: first - 2.0 * middle + last,
        }
    }

    /// Average of the values.
    pub fn mean(self) -> f64 {
        self.mean
    }

    /// First derivative in the middle.
    pub fn slope(self) -> f64 {
        self.slope
    }

    /// Second derivative.
    pub fn curvature(self) -> f64 {
        self.curvature
    }
}
