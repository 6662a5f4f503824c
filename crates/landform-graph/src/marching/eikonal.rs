//! Travel times of a front: the eikonal equation by fast marching.

use std::ops::ControlFlow;

use fixedbitset::FixedBitSet;

use super::queue::TimeQueue;
use super::upwind::{Upwind, arrival};
use super::{MarchError, check_length, check_start};
use crate::Lattice;

/// How fast a front advances, in metres a unit of time.
#[derive(Clone, Copy, Debug)]
pub enum Speed<'a> {
    /// The same everywhere.
    Uniform(f64),
    /// One value a node; 0 is an obstacle, which the front never enters.
    Field(&'a [f64]),
}

impl Speed<'_> {
    fn at(self, node: usize) -> f64 {
        match self {
            Self::Uniform(speed) => speed,
            Self::Field(speeds) => speeds[node],
        }
    }
}

/// Order of the upwind differences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Differences to the next node along an axis. Never too small for uniform speed.
    #[default]
    First,
    /// Differences over two nodes where both were passed in order, else first order.
    Second,
}

/// How far and how exactly a front marches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarchOptions {
    /// Order of the differences.
    pub order: Order,
    /// Latest time; nodes that the front reaches later are left out.
    pub limit: f64,
}

impl Default for MarchOptions {
    fn default() -> Self {
        Self { order: Order::First, limit: f64::INFINITY }
    }
}

/// What a front reached.
#[derive(Clone, Copy, Debug)]
pub struct Arrivals<'a> {
    /// Time of arrival at every node; infinite where the front does not come.
    pub time: &'a [f64],
    /// The nodes that the front reached, in the order of arrival, ties by node.
    pub order: &'a [u32],
}

/// Solver of the eikonal equation `abs(grad T) F = 1` (thesis, equation A.3 and listing A.6),
/// with memory that is used again from one march to the next.
///
/// Scheme: upwind differences along the axes (Sethian 1996, 1999), whatever the diagonal
/// edges of the lattice, so that `Four`, `FourEight` and `Eight` give the same times, as do
/// the three kinds of voxel lattice. Error: of first order in the spacing, of second order
/// with [`Order::Second`] away from obstacles and from where fronts meet; close to a source
/// of a single node both are of first order, as the front is sharply curved there.
///
/// Second differences underestimate where a front is curved within a spacing or two. To have
/// second order all over, start from the exact times of the nodes within a few spacings of
/// a source. Where speeds jump or fronts go round an obstacle, both orders are of first.
///
/// Cost: that of the nodes reached, times the logarithm of the width of the front; nothing
/// that the front does not reach is touched, and nothing is allocated once the memory fits the
/// lattice and the front.
///
/// ```
/// use landform_graph::marching::{FastMarching, MarchOptions, Speed};
/// use landform_graph::{Boundary, Connectivity, Lattice};
/// let lattice = Lattice::plane([5, 1], 10.0, Connectivity::Four, [Boundary::Open; 2])?;
/// let mut marching = FastMarching::new();
/// // Two sources; the eastern one starts 4 later.
/// let starts = [(0, 0.0), (4, 4.0)];
/// let found = marching.solve(&lattice, Speed::Uniform(5.0), &starts, MarchOptions::default())?;
/// assert_eq!(found.time, [0.0, 2.0, 4.0, 6.0, 4.0]);
/// assert_eq!(found.order, [0, 1, 2, 4, 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct FastMarching {
    /// Final times of the nodes that the front has passed, else infinite.
    time: Vec<f64>,
    /// Least times so far of the nodes in `order` and of the narrow band, else infinite.
    due: Vec<f64>,
    /// Nodes where a front is released.
    starts: FixedBitSet,
    order: Vec<u32>,
    queue: TimeQueue,
}

impl FastMarching {
    /// Memory for marches; it grows to 20 bytes a node and the narrow band.
    pub fn new() -> Self {
        Self::default()
    }

    /// Marches a front from `starts`, pairs of a node and the time at which a front is
    /// released there (unless another came by before).
    ///
    /// # Errors
    /// [`MarchError::Start`], [`MarchError::StartTime`]; [`MarchError::Length`] of the speed
    /// field; [`MarchError::Speed`] where the front meets a speed that is negative or not
    /// finite.
    pub fn solve(
        &mut self,
        lattice: &Lattice,
        speed: Speed<'_>,
        starts: &[(usize, f64)],
        options: MarchOptions,
    ) -> Result<Arrivals<'_>, MarchError> {
        self.search(lattice, speed, starts, options, |_, _| ControlFlow::<()>::Continue(()))?;
        Ok(Arrivals { time: &self.time, order: &self.order })
    }

    /// As [`FastMarching::solve`], and `visit(node, time)` is told of every node that the front
    /// reaches, in the order of arrival: it may end the march with [`ControlFlow::Break`], whose
    /// value is returned. So does an agent search for the nearest node of a kind.
    ///
    /// # Errors
    /// As [`FastMarching::solve`].
    pub fn search<B>(
        &mut self,
        lattice: &Lattice,
        speed: Speed<'_>,
        starts: &[(usize, f64)],
        options: MarchOptions,
        visit: impl FnMut(usize, f64) -> ControlFlow<B>,
    ) -> Result<Option<B>, MarchError> {
        self.begin(lattice.node_count());
        for &(node, time) in starts {
            self.start(lattice, node, time)?;
        }
        self.march(lattice, speed, options, visit)
    }

    /// Distance in metres from the nearest of `sources` to every node.
    ///
    /// # Errors
    /// [`MarchError::Start`].
    pub fn distance(
        &mut self,
        lattice: &Lattice,
        sources: &[usize],
        options: MarchOptions,
    ) -> Result<Arrivals<'_>, MarchError> {
        self.begin(lattice.node_count());
        for &node in sources {
            self.start(lattice, node, 0.0)?;
        }
        let all = |_, _| ControlFlow::<()>::Continue(());
        self.march(lattice, Speed::Uniform(1.0), options, all)?;
        Ok(Arrivals { time: &self.time, order: &self.order })
    }

    /// Releases a front at a node.
    fn start(&mut self, lattice: &Lattice, node: usize, time: f64) -> Result<(), MarchError> {
        check_start(lattice, node, time)?;
        self.starts.insert(node);
        self.offer(node, time);
        Ok(())
    }

    /// Forgets the last march.
    fn begin(&mut self, nodes: usize) {
        let reached = self.order.drain(..).map(|node| node as usize);
        for node in reached.chain(self.queue.drain()) {
            self.time[node] = f64::INFINITY;
            self.due[node] = f64::INFINITY;
            self.starts.set(node, false);
        }
        self.time.resize(nodes, f64::INFINITY);
        self.due.resize(nodes, f64::INFINITY);
        self.starts.grow(nodes);
    }

    /// Whether the front has passed a node.
    #[inline]
    fn passed(&self, node: usize) -> bool {
        self.time[node] < f64::INFINITY
    }

    /// Lowers the time of a node of the narrow band.
    #[inline]
    fn offer(&mut self, node: usize, time: f64) {
        if time < self.due[node] {
            self.due[node] = time;
            self.queue.push(time, node);
        }
    }

    fn march<B>(
        &mut self,
        lattice: &Lattice,
        speed: Speed<'_>,
        options: MarchOptions,
        mut visit: impl FnMut(usize, f64) -> ControlFlow<B>,
    ) -> Result<Option<B>, MarchError> {
        if let Speed::Field(speeds) = speed {
            check_length(lattice, "speed", speeds.len())?;
        }
        let medium = Medium { axes: Axes::new(lattice), speed, options };
        while let Some((time, node)) = self.queue.pop() {
            if self.passed(node) {
                continue;
            }
            if time > medium.options.limit {
                self.queue.push(time, node);
                break;
            }
            self.time[node] = time;
            self.order.push(node as u32);
            if let ControlFlow::Break(found) = visit(node, time) {
                return Ok(Some(found));
            }
            self.update_neighbours(&medium, node)?;
        }
        Ok(None)
    }

    /// Recomputes the times of the neighbours of a node that was just reached.
    fn update_neighbours(&mut self, medium: &Medium<'_>, node: usize) -> Result<(), MarchError> {
        let at = medium.axes.lattice.coordinates(node);
        for axis in 0..3 {
            for step in [-1, 1] {
                let Some((beside, coordinate)) = medium.axes.beside(node, at, axis, step) else {
                    continue;
                };
                if self.passed(beside) {
                    continue;
                }
                let mut place = at;
                place[axis] = coordinate;
                if let Some(cost) = medium.cost(beside)? {
                    let upwind = [0, 1, 2].map(|axis| self.upwind(medium, beside, place, axis));
                    self.offer(beside, arrival(upwind, cost));
                }
            }
        }
        Ok(())
    }

    /// What the nodes that the front has passed along an axis tell of a node.
    #[inline]
    fn upwind(&self, medium: &Medium<'_>, node: usize, at: [usize; 3], axis: usize) -> Upwind {
        // Infinite where the front has not passed, and beyond open borders.
        let time = |steps: isize| {
            let beside = medium.axes.beside(node, at, axis, steps);
            beside.map_or(f64::INFINITY, |(node, _)| self.time[node])
        };
        let (back, ahead) = (time(-1), time(1));
        let (near, step) = if back <= ahead { (back, -1) } else { (ahead, 1) };
        if near == f64::INFINITY {
            return Upwind::NONE;
        }
        // Where a front is curved within a spacing or two, as around a single node, second
        // differences give times that are too small. Starts are there to give such places
        // exact times, so they yield to first differences only.
        if medium.options.order == Order::Second && !self.starts.contains(node) {
            let far = time(2 * step);
            if far <= near {
                return Upwind::second(near, far);
            }
        }
        Upwind::first(near)
    }
}

/// What a front marches through.
struct Medium<'a> {
    axes: Axes<'a>,
    speed: Speed<'a>,
    options: MarchOptions,
}

impl Medium<'_> {
    /// Time to cross a spacing at a node; `None` at an obstacle.
    #[inline]
    fn cost(&self, node: usize) -> Result<Option<f64>, MarchError> {
        let speed = self.speed.at(node);
        if !(speed >= 0.0 && speed.is_finite()) {
            return Err(MarchError::Speed { node, speed });
        }
        Ok((speed > 0.0).then(|| self.axes.lattice.spacing() / speed))
    }
}

/// Steps along the axes of a lattice.
struct Axes<'a> {
    lattice: &'a Lattice,
    strides: [isize; 3],
}

impl<'a> Axes<'a> {
    fn new(lattice: &'a Lattice) -> Self {
        let [width, height, _] = lattice.size().map(|size| size as isize);
        Self { lattice, strides: [1, width, width * height] }
    }

    /// The node `steps` along an axis from a node at `at`, and its coordinate on the axis.
    #[inline]
    fn beside(
        &self,
        node: usize,
        at: [usize; 3],
        axis: usize,
        steps: isize,
    ) -> Option<(usize, usize)> {
        let size = self.lattice.size()[axis];
        let from = at[axis];
        let to = match from.checked_add_signed(steps).filter(|&to| to < size) {
            Some(to) => to,
            None if !self.lattice.is_periodic(axis) => return None,
            None => (from as isize + steps).rem_euclid(size as isize) as usize,
        };
        let moved = (to as isize - from as isize) * self.strides[axis];
        Some((node.wrapping_add_signed(moved), to))
    }
}

#[cfg(test)]
mod tests;
