//! A plane with a frame of one node around it, so that no kernel asks what lies beyond a border.
//!
//! Values on the plane lie in rows of `stride = width + 2`. Beyond a periodic border the frame
//! repeats the other side ([`Frame::wrap`]), beyond an open one it holds what never takes part.

use landform_graph::{Connectivity, Lattice};
use rayon::slice::{ChunksExactMut, ParallelSliceMut};

use crate::RiverError;

/// Shape of a framed plane.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Values a framed row holds.
    pub(crate) stride: usize,
    periodic: [bool; 2],
    /// Numbers of neighbours of nodes whose row and column add to an even and to an odd number.
    degrees: [usize; 2],
}

impl Frame {
    /// The framed plane of a lattice.
    pub(crate) fn new(lattice: &Lattice) -> Result<Self, RiverError> {
        let degrees = match lattice.connectivity() {
            Connectivity::Four => [4, 4],
            Connectivity::FourEight => [8, 4],
            Connectivity::Eight => [8, 8],
            volume => return Err(RiverError::Volume(volume)),
        };
        let [width, height] = [lattice.width(), lattice.height()];
        let periodic = [lattice.is_periodic(0), lattice.is_periodic(1)];
        Ok(Self { width, height, stride: width + 2, periodic, degrees })
    }

    /// Whether the axis (0 = x, 1 = y) closes on itself.
    pub(crate) fn is_periodic(&self, axis: usize) -> bool {
        self.periodic[axis]
    }

    /// Number of values that a framed field holds.
    pub(crate) fn len(&self) -> usize {
        self.stride * (self.height + 2)
    }

    /// Framed index of a node of the lattice.
    pub(crate) fn at(&self, node: usize) -> usize {
        let [row, column] = [node / self.width, node % self.width];
        (row + 1) * self.stride + column + 1
    }

    /// Number of neighbours of the node at a framed row and column.
    #[inline]
    pub(crate) fn degree(&self, row: usize, column: usize) -> usize {
        self.degrees[(row + column) % 2]
    }

    /// Whether the node at a framed row and column has a neighbour in each direction, in the order of
    /// [`Frame::around`].
    pub(crate) fn pipes(&self, row: usize, column: usize) -> [bool; 8] {
        let [x, y] = self.periodic;
        let east = x || column < self.width;
        let north = y || row > 1;
        let west = x || column > 1;
        let south = y || row < self.height;
        let diagonals = [north && east, north && west, south && west, south && east];
        let diagonals = diagonals.map(|open| open && self.degree(row, column) == 8);
        let [north_east, north_west, south_west, south_east] = diagonals;
        [east, north, west, south, north_east, north_west, south_west, south_east]
    }

    /// Whether no neighbour of an inner node of the framed row lies beyond a border.
    pub(crate) fn is_inner_row(&self, row: usize) -> bool {
        row > 1 && row < self.height
    }

    /// The values around framed index `at`, over axes first, then over diagonals: the first
    /// [`Frame::degree`] of them belong to neighbours.
    #[inline(always)]
    pub(crate) fn around<T: Copy>(&self, values: &[T], at: usize) -> [T; 8] {
        let row = |first: usize| -> [T; 3] {
            let row = &values[first..][..3];
            [row[0], row[1], row[2]]
        };
        let [north_west, north, north_east] = row(at - self.stride - 1);
        let [west, _, east] = row(at - 1);
        let [south_west, south, south_east] = row(at + self.stride - 1);
        [east, north, west, south, north_east, north_west, south_west, south_east]
    }

    /// Repeats the other side of the plane beyond its periodic borders.
    pub(crate) fn wrap<T: Copy>(&self, values: &mut [T]) {
        let Self { width, height, stride, .. } = *self;
        if self.periodic[0] {
            for row in values.chunks_exact_mut(stride) {
                (row[0], row[width + 1]) = (row[width], row[1]);
            }
        }
        if self.periodic[1] {
            values.copy_within(height * stride..(height + 1) * stride, 0);
            values.copy_within(stride..2 * stride, (height + 1) * stride);
        }
    }

    /// Repeats the nearest value of the plane beyond open borders, and the other side beyond periodic
    /// ones, so that differences across an open border are zero.
    pub(crate) fn extend<T: Copy>(&self, values: &mut [T]) {
        let Self { width, height, stride, .. } = *self;
        for row in values.chunks_exact_mut(stride) {
            (row[0], row[width + 1]) = (row[1], row[width]);
        }
        values.copy_within(stride..2 * stride, 0);
        values.copy_within(height * stride..(height + 1) * stride, (height + 1) * stride);
        self.wrap(values);
    }

    /// The rows of a framed field without those of the frame above and below.
    pub(crate) fn rows_of<'a, T: Send>(&self, values: &'a mut [T]) -> ChunksExactMut<'a, T> {
        let Self { stride, height, .. } = *self;
        values[stride..(height + 1) * stride].par_chunks_exact_mut(stride)
    }
}
