//! How the tree grows: the branch of a cell, given the tree of the coarser levels.

use super::cell::{Cell, Keys, Point};
use super::course::Course;
use super::piece::{Joint, Piece};
use crate::Terrain;

/// Columns and rows around a cell in which branches start that can be nearest to what lies in it.
pub(super) const REACH: i64 = 2;

/// What the tree of a [`super::Dendry`] depends on, made ready for one seed.
#[derive(Debug)]
pub(super) struct Growth {
    pub keys: Keys,
    pub levels: u32,
    /// Of every level.
    pub displacement: Vec<f64>,
    pub smooth: bool,
    pub control: Terrain,
    /// Width of a cell of level 0 in metres.
    pub cell_m: f64,
    /// Least slope of the finest branches; without it the tree has no heights.
    pub least_slope: Option<f64>,
}

/// A key point of level 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    pub point: Point,
    /// Value of the control function.
    pub control: f64,
    /// Decides between equals.
    pub tie: u32,
}

impl Source {
    fn is_below(&self, other: &Self) -> bool {
        self.control.total_cmp(&other.control).then(self.tie.cmp(&other.tie)).is_lt()
    }
}

impl Growth {
    /// Values of the control function at some points.
    pub fn control(&self, points: &[Point]) -> Vec<f64> {
        let places: Vec<Point> =
            points.iter().map(|point| point.map(|x| x * self.cell_m)).collect();
        self.control.elevations(&places)
    }

    /// The cell next to one of level 0, or itself, whose key point is the lowest.
    pub fn lowest(cell: Cell, source: impl Fn(Cell) -> Source) -> Cell {
        let lower = |best: Cell, other: Cell| {
            if source(other).is_below(&source(best)) { other } else { best }
        };
        cell.around(1).fold(cell, lower)
    }

    /// The branch of a cell of level 0: to the lowest key point around, or a mere point if that is
    /// its own. `source` knows the key points of cells at most two away.
    pub fn trunk(&self, cell: Cell, source: impl Fn(Cell) -> Source) -> Vec<Piece> {
        let next = Self::lowest(cell, &source);
        let [own, target] = [cell, next].map(&source);
        let beyond = source(Self::lowest(next, &source));
        let onward = [0, 1].map(|axis| beyond.point[axis] - target.point[axis]);
        let [height, below] = match self.least_slope {
            Some(_) => [own.control, target.control],
            None => [0.0; 2],
        };
        let joint = Joint { point: target.point, height: below, onward, slope: 0.0 };
        if next == cell {
            let (along, inverse, rise, slope) = ([0.0; 2], 0.0, 0.0, 0.0);
            return vec![Piece { from: own.point, along, inverse, height, rise, onward, slope }];
        }
        let slope = (height - below) / self.length(own.point, target.point);
        self.course(cell).pieces(own.point, height, &joint, onward, slope)
    }

    /// The branch of a cell of a finer level: from its key point, where the control function has a
    /// value in metres, to a joint.
    pub fn tributary(&self, cell: Cell, key: Point, control: f64, joint: &Joint) -> Vec<Piece> {
        let length = self.length(key, joint.point);
        let Some(least) = self.least_slope else {
            return self.course(cell).pieces(key, 0.0, joint, joint.onward, 0.0);
        };
        let least = least * flint(self.levels - 1 - cell.level);
        let height = control.max(joint.height + least * length);
        let slope = if length > 0.0 { (height - joint.height) / length } else { least };
        let arrival = arrival(key, joint, slope);
        self.course(cell).pieces(key, height, joint, arrival, slope)
    }

    fn course(&self, cell: Cell) -> Course {
        Course {
            parts: if cell.level < 2 { 4 } else { 2 },
            displacement: self.displacement[cell.level as usize],
            bends: self.keys.bends(cell),
            smooth: self.smooth,
        }
    }

    /// Distance in metres.
    fn length(&self, from: Point, to: Point) -> f64 {
        (to[0] - from[0]).hypot(to[1] - from[1]) * self.cell_m
    }
}

/// Flint's law, simplified: the slope of a river over that of its finest tributaries,
/// `(2 mu - 1)^-0.6`. The magnitude mu is 1 for these and three times as much for every coarser
/// level.
fn flint(levels_above_finest: u32) -> f64 {
    let magnitude = 3.0_f64.powi(levels_above_finest as i32);
    (2.0 * magnitude - 1.0).powf(-0.6)
}

/// Howard's law: the direction in which a tributary reaches a river, whose own is turned by the
/// angle with the cosine `slope of the river / slope of the tributary`.
pub(super) fn arrival(from: Point, joint: &Joint, slope: f64) -> Point {
    let [east, north] = joint.onward;
    let cosine = if slope > 0.0 { (joint.slope / slope).clamp(0.0, 1.0) } else { 1.0 };
    let sine = (1.0 - cosine * cosine).sqrt();
    let [x, y] = [from[0] - joint.point[0], from[1] - joint.point[1]];
    // What comes from the left flows to the right.
    let sine = if east * y - north * x > 0.0 { -sine } else { sine };
    [cosine * east - sine * north, sine * east + cosine * north]
}
