//! The neighbourhood in which an event makes further ones likelier: a disc around it.

use landform_graph::Lattice;
use rayon::prelude::*;

use super::SandpileError;

/// All nodes within a radius, measured in the plane and alike in all directions (thesis,
/// definition 8).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Disc {
    /// Columns that the disc reaches to either side, for rows -R to R from its centre.
    half_widths: Vec<usize>,
}

impl Disc {
    /// The disc of `radius_m` metres on a 2-D lattice.
    ///
    /// Refused if the radius is not a number, or so large that the disc would reach a node
    /// twice around a periodic axis.
    pub fn new(lattice: &Lattice, radius_m: f64) -> Result<Self, SandpileError> {
        if lattice.depth() != 1 {
            return Err(SandpileError::Volume { layers: lattice.depth() });
        }
        let radius = radius_m / lattice.spacing();
        let around = |axis: usize| 2.0 * radius.floor() + 1.0 > lattice.size()[axis] as f64;
        if !(0.0..=1e4).contains(&radius) || around(0) || around(1) {
            return Err(SandpileError::Parameter {
                parameter: "radius_m",
                value: radius_m,
                expected: "from 0 to half the width and height of the lattice, at most 10000 \
                           spacings",
            });
        }
        let reach = radius.floor() as i64;
        let half_width = |row: i64| (radius * radius - (row * row) as f64).max(0.0).sqrt() as usize;
        Ok(Self { half_widths: (-reach..=reach).map(half_width).collect() })
    }

    /// Number of nodes in the disc.
    pub fn area(&self) -> usize {
        self.half_widths.iter().map(|half| 2 * half + 1).sum()
    }

    /// Adds to each node of `counts` the number of events in the disc around it. `events` holds
    /// one number a node; discs are cut at open borders and go round periodic axes.
    ///
    /// Running sums along the rows make the cost one subtraction a row of the disc and node.
    pub fn add_events(&self, lattice: &Lattice, events: &[u8], counts: &mut [u32]) {
        let [width, height, _] = lattice.size();
        let reach = self.half_widths.len() / 2;
        let stride = width + 2 * reach + 1;
        let mut sums = vec![0_u32; stride * height];
        sums.par_chunks_mut(stride).zip(events.par_chunks(width)).for_each(|(sums, events)| {
            running_sums(events, reach, lattice.is_periodic(0), sums);
        });
        counts.par_chunks_mut(width).enumerate().for_each(|(row, counts)| {
            for (index, &half) in self.half_widths.iter().enumerate() {
                let step = index as isize - reach as isize;
                let Some(node) = lattice.offset([0, row, 0], [0, step, 0]) else { continue };
                let line = &sums[node / width * stride..][..stride];
                let ends = &line[reach + half + 1..][..width];
                let starts = &line[reach - half..][..width];
                for ((count, end), start) in counts.iter_mut().zip(ends).zip(starts) {
                    *count += end - start;
                }
            }
        });
    }
}

/// Sums of the events of a row before each column, from `reach` columns before its first to
/// `reach` after its last: those beyond the row are 0 or, on a `periodic` axis, its other end.
fn running_sums(events: &[u8], reach: usize, periodic: bool, sums: &mut [u32]) {
    let width = events.len();
    let mut sum = 0;
    for (column, entry) in sums.iter_mut().enumerate() {
        *entry = sum;
        let inside = (reach..reach + width).contains(&column);
        if inside || periodic {
            sum += u32::from(events[(column + width - reach % width) % width]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    fn lattice(size: [usize; 2], boundary: [Boundary; 2]) -> Lattice {
        Lattice::plane(size, 2.0, Connectivity::Eight, boundary).unwrap()
    }

    /// The readable reference of [`Disc::add_events`]: every pair of nodes.
    fn count_pairs(lattice: &Lattice, radius_m: f64, events: &[u8]) -> Vec<u32> {
        let distance = |axis: usize, a: usize, b: usize| {
            let apart = a.abs_diff(b);
            match lattice.is_periodic(axis) {
                true => apart.min(lattice.size()[axis] - apart) as f64 * 2.0,
                false => apart as f64 * 2.0,
            }
        };
        let near = |a: usize, b: usize| {
            let [[ax, ay, _], [bx, by, _]] = [lattice.coordinates(a), lattice.coordinates(b)];
            distance(0, ax, bx).hypot(distance(1, ay, by)) <= radius_m
        };
        (0..events.len())
            .map(|node| {
                let inside = (0..events.len()).filter(|&other| near(node, other));
                inside.map(|other| u32::from(events[other])).sum()
            })
            .collect()
    }

    #[test]
    fn running_sums_agree_with_all_pairs() {
        let [open, periodic] = [Boundary::Open, Boundary::Periodic];
        for boundary in [[open, open], [periodic, open], [open, periodic], [periodic, periodic]] {
            let lattice = lattice([13, 11], boundary);
            let events: Vec<u8> = (0..143).map(|node| (node * node % 7 == 1) as u8).collect();
            for radius_m in [0.0, 1.9, 2.0, 2.9, 5.0, 7.3, 10.0] {
                let disc = Disc::new(&lattice, radius_m).unwrap();
                let mut counts = vec![0; 143];
                disc.add_events(&lattice, &events, &mut counts);
                assert_eq!(counts, count_pairs(&lattice, radius_m, &events), "{radius_m}");
            }
        }
    }

    #[test]
    fn the_area_is_that_of_a_whole_disc() {
        let disc = |radius_m| Disc::new(&lattice([21, 21], [Boundary::Periodic; 2]), radius_m);
        assert_eq!(disc(0.0).unwrap().area(), 1);
        assert_eq!(disc(2.0).unwrap().area(), 5);
        assert_eq!(disc(3.0).unwrap().area(), 9);
        assert_eq!(disc(20.0).unwrap().area(), 317);
        for refused in [-1.0, 22.0, f64::NAN, f64::INFINITY] {
            assert!(disc(refused).is_err(), "{refused}");
        }
    }
}
