//! The surface as profiles along the wind: what most measures of dunes look at.

use landform_graph::Lattice;

use super::{Axis, WindLine};

/// The rows or the columns of a lattice, whichever a wind is nearer to, read downwind.
#[derive(Clone, Debug)]
pub(super) struct Profiles {
    /// Number of profiles.
    pub count: usize,
    /// Number of nodes in each.
    pub length: usize,
    /// Whether the ends of a profile meet.
    pub is_cyclic: bool,
    /// Whether the first profile is a neighbour of the last.
    pub sides_meet: bool,
    /// Distance between the nodes of a profile, metres.
    pub spacing: f64,
    first: usize,
    along: isize,
    across: usize,
}

impl Profiles {
    /// The profiles of a lattice in a wind that blows to `towards_deg`.
    pub fn new(lattice: &Lattice, towards_deg: f64) -> Self {
        let wind = WindLine::new(towards_deg.to_radians(), 0.5);
        let [width, height, _] = lattice.size();
        let (axis, length, count, step, across) = match wind.axis() {
            Axis::Columns => (0, width, height, 1, width),
            Axis::Rows => (1, height, width, width, 1),
        };
        let forward = wind.is_forward();
        Self {
            count,
            length,
            is_cyclic: lattice.is_periodic(axis),
            sides_meet: lattice.is_periodic(1 - axis),
            spacing: lattice.spacing(),
            first: if forward { 0 } else { (length - 1) * step },
            along: if forward { step as isize } else { -(step as isize) },
            across,
        }
    }

    /// The node at `place` (counted downwind) of a profile.
    #[inline]
    pub fn node(&self, profile: usize, place: usize) -> usize {
        (self.first + profile * self.across).wrapping_add_signed(place as isize * self.along)
    }

    /// The heights along a profile, downwind.
    pub fn heights(&self, surface: &[f64], profile: usize) -> Vec<f64> {
        (0..self.length).map(|place| surface[self.node(profile, place)]).collect()
    }
}

/// Which way a profile went when it last went far.
#[derive(Clone, Copy, PartialEq)]
enum Trend {
    Level,
    Up,
    Down,
}

/// Crests and troughs of a profile: places in turn, each at least `swing` metres (above 0)
/// higher or lower than the one before. Lesser ups and downs are passed over.
///
/// Open profiles begin and end with their first and last place. Cyclic ones begin with
/// their lowest place, `p`, and end with it again, as `p + length`. A profile without one
/// full swing has no turning points.
pub(super) fn turning_points(heights: &[f64], swing: f64, is_cyclic: bool) -> Vec<usize> {
    let length = heights.len();
    let lower = |low: usize, place: usize| if heights[place] < heights[low] { place } else { low };
    let start = if is_cyclic { (0..length).fold(0, lower) } else { 0 };
    let last = if is_cyclic { length } else { length.saturating_sub(1) };
    let height = |step: usize| heights[(start + step) % length];
    let (mut trend, mut low, mut high) = (Trend::Level, 0, 0);
    let mut turns = vec![0];
    for step in 1..=last {
        let here = height(step);
        low = if here <= height(low) { step } else { low };
        high = if here >= height(high) { step } else { high };
        if trend != Trend::Up && here - height(low) >= swing {
            turns.push(low);
            (trend, high) = (Trend::Up, step);
        } else if trend != Trend::Down && height(high) - here >= swing {
            turns.push(high);
            (trend, low) = (Trend::Down, step);
        }
    }
    match trend {
        Trend::Level => return Vec::new(),
        Trend::Up => turns.push(high),
        Trend::Down => turns.push(low),
    }
    turns.push(last);
    turns.dedup();
    turns.iter().map(|step| start + step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    #[test]
    fn small_ups_and_downs_are_passed_over() {
        let heights = [3.0, 1.0, 0.0, 1.0, 0.5, 6.0, 5.5, 7.0, 2.0, 2.5, 1.0, 4.0];
        assert_eq!(turning_points(&heights, 2.0, true), [2, 7, 10, 11, 14]);
        assert_eq!(turning_points(&heights, 4.0, true), [2, 7, 14]);
        assert_eq!(turning_points(&heights, 2.0, false), [0, 2, 7, 10, 11]);
        assert!(turning_points(&heights, 8.0, true).is_empty());
        assert!(turning_points(&[1.0; 5], 0.1, true).is_empty());
        assert_eq!(turning_points(&[0.0, 1.0, 2.0, 3.0], 1.0, false), [0, 3]);
        assert_eq!(turning_points(&[3.0, 2.0, 0.0, 0.0], 1.0, false), [0, 3]);
    }

    #[test]
    fn profiles_run_downwind() {
        let lattice =
            Lattice::plane([4, 3], 1.0, Connectivity::Four, [Boundary::Periodic, Boundary::Open]);
        let lattice = lattice.unwrap();
        let surface: Vec<f64> = (0..12).map(f64::from).collect();
        let heights =
            |towards, profile| Profiles::new(&lattice, towards).heights(&surface, profile);
        assert_eq!(heights(0.0, 1), [4.0, 5.0, 6.0, 7.0]);
        assert_eq!(heights(180.0, 1), [7.0, 6.0, 5.0, 4.0]);
        assert_eq!(heights(90.0, 1), [9.0, 5.0, 1.0]);
        assert_eq!(heights(-80.0, 3), [3.0, 7.0, 11.0]);
        assert!(Profiles::new(&lattice, 20.0).is_cyclic);
        assert!(Profiles::new(&lattice, 70.0).sides_meet);
    }
}
