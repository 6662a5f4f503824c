//! The courses that water takes from sources to sinks, and how they join.

use landform_graph::{BreadthFirst, Lattice, Reach};
use serde::{Deserialize, Serialize};

use crate::place::{height, separation};

/// The way of a source's water down the pressure.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Number of the source.
    pub source: u32,
    /// Voxels from the source to where pressure ends: a sink, or a hollow of the pressure.
    pub trail: Vec<usize>,
    /// The course that it joins, and the voxel where: what it is a tributary of.
    pub joins: Option<(u32, usize)>,
    /// 0 for a course of its own, one more than that of the course it joins.
    pub order: u32,
    /// Phreatic loops: where the course goes up after it came down.
    pub loops: Vec<PhreaticLoop>,
    /// Its length in metres.
    pub length_m: f64,
}

/// A rise of a course that came down before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhreaticLoop {
    /// The lowest voxel, where it turns up.
    pub foot: usize,
    /// How far it rises, in metres.
    pub rise_m: f64,
}

impl Course {
    /// All of its rises in metres.
    pub fn climb_m(&self) -> f64 {
        // Not the -0 of an empty sum.
        self.loops.iter().map(|up| up.rise_m).fold(0.0, |sum, rise_m| sum + rise_m)
    }
}

/// What counts when courses are compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CourseScale {
    /// Rise that makes a phreatic loop, in metres.
    pub least_rise_m: f64,
    /// Courses that meet only within this distance from their end, in metres, do not join.
    pub apart_m: f64,
    /// Courses that come as close as this, in metres, have met: they run in one passage.
    pub near_m: f64,
}

/// Voxels from `start` down the pressure, each the lowest neighbour of the one before, to a voxel
/// without a lower neighbour.
pub fn trail(lattice: &Lattice, pressure: &[f64], start: usize) -> Vec<usize> {
    let mut trail = vec![start];
    let mut node = start;
    loop {
        let lower = |a: usize, b: usize| if pressure[b] < pressure[a] { b } else { a };
        let lowest = lattice.neighbours(node).map(|edge| edge.node).fold(node, lower);
        if lowest == node {
            return trail;
        }
        trail.push(lowest);
        node = lowest;
    }
}

/// The courses of sources, given as pairs of number and voxel in the order in which they drained. A
/// course joins the earlier one to whose trail it comes near first.
pub fn courses(
    lattice: &Lattice,
    pressure: &[f64],
    sources: &[(u32, usize)],
    scale: CourseScale,
) -> Vec<Course> {
    let mut courses: Vec<Course> = Vec::with_capacity(sources.len());
    // Voxels near the trails so far, with a course and a place along it, in order.
    let mut near: Vec<(usize, usize, usize)> = Vec::new();
    let mut search = BreadthFirst::new();
    for &(source, start) in sources {
        let trail = trail(lattice, pressure, start);
        let meeting = trail.iter().find_map(|node| {
            let at = near.partition_point(|entry| entry.0 < *node);
            near.get(at).filter(|entry| entry.0 == *node).copied()
        });
        let joined = meeting.filter(|&(_, other, place)| {
            length(lattice, &courses[other].trail[place..]) > scale.apart_m
        });
        for (place, &node) in trail.iter().enumerate() {
            let around = search.collect(lattice, &[node], Reach::metres(scale.near_m), |_, _| true);
            near.extend(around.iter().map(|visit| (visit.node, courses.len(), place)));
        }
        near.sort_unstable();
        near.dedup_by_key(|entry| entry.0);
        courses.push(Course {
            source,
            joins: joined.map(|(node, other, _)| (courses[other].source, node)),
            order: joined.map_or(0, |(_, other, _)| courses[other].order + 1),
            loops: rises(lattice, &trail, scale.least_rise_m),
            length_m: length(lattice, &trail),
            trail,
        });
    }
    courses
}

fn length(lattice: &Lattice, trail: &[usize]) -> f64 {
    trail.windows(2).map(|step| separation(lattice, step[0], step[1])).sum()
}

/// The rises of at least `least_m` that a trail has after it fell.
fn rises(lattice: &Lattice, trail: &[usize], least_m: f64) -> Vec<PhreaticLoop> {
    let mut rises: Vec<PhreaticLoop> = Vec::new();
    let mut rising = false;
    let mut foot = trail[0];
    for &node in trail {
        let here = height(lattice, node);
        let up = here - height(lattice, foot);
        match rises.last_mut().filter(|_| rising) {
            Some(last) => {
                last.rise_m = last.rise_m.max(up);
                if last.rise_m - up >= least_m {
                    (rising, foot) = (false, node);
                }
            }
            None if up >= least_m => {
                rising = true;
                rises.push(PhreaticLoop { foot, rise_m: up });
            }
            None if up <= 0.0 => foot = node,
            None => {}
        }
    }
    rises
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};

    const SCALE: CourseScale = CourseScale { least_rise_m: 2.0, apart_m: 3.0, near_m: 1.0 };

    /// A section whose pressure is 9 but along ways that fall to a sink.
    fn section(ways: &[&[[usize; 2]]]) -> (Lattice, Vec<f64>) {
        let lattice =
            Lattice::plane([20, 12], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let mut pressure = vec![9.0; 240];
        for way in ways {
            for (place, &[x, y]) in way.iter().rev().enumerate() {
                let node = lattice.node([x, y, 0]);
                pressure[node] = f64::min(pressure[node], 0.01 * place as f64);
            }
        }
        (lattice, pressure)
    }

    #[test]
    fn a_course_that_meets_another_is_its_tributary() {
        let main: Vec<[usize; 2]> = (2..18).map(|x| [x, 6]).collect();
        let mut side: Vec<[usize; 2]> = (0..6).map(|y| [8, y]).collect();
        side.extend((8..18).map(|x| [x, 6]));
        let mut late: Vec<[usize; 2]> = (0..6).map(|y| [16, y]).collect();
        late.extend((16..18).map(|x| [x, 6]));
        let (lattice, pressure) = section(&[&main, &side, &late]);
        let at = |[x, y]: [usize; 2]| lattice.node([x, y, 0]);
        let sources = [(0, at(main[0])), (1, at(side[0])), (2, at(late[0]))];
        let courses = courses(&lattice, &pressure, &sources, SCALE);
        assert_eq!((courses[0].joins, courses[0].order), (None, 0));
        assert_eq!((courses[1].joins.map(|joins| joins.0), courses[1].order), (Some(0), 1));
        // The last meets the others only at the sink.
        assert_eq!((courses[2].joins, courses[2].order), (None, 0));
        assert_eq!(courses[0].length_m, 15.0);
        assert_eq!(courses[0].loops, []);
    }

    #[test]
    fn a_course_that_rises_after_it_fell_has_loops() {
        let mut way: Vec<[usize; 2]> = (0..9).map(|y| [1, y]).collect();
        way.extend((2..6).rev().map(|y| [4, y + 3]));
        way.insert(9, [2, 8]);
        way.insert(10, [3, 8]);
        way.extend([[5, 5], [6, 4], [7, 5], [8, 6], [9, 7], [10, 8], [11, 9], [12, 8], [13, 9]]);
        let (lattice, pressure) = section(&[&way]);
        let start = lattice.node([1, 0, 0]);
        let course = &courses(&lattice, &pressure, &[(0, start)], SCALE)[0];
        // Down 8, up 4, down 5; the last rise of 1 is too small.
        let expected = PhreaticLoop { foot: lattice.node([3, 8, 0]), rise_m: 4.0 };
        assert_eq!((course.loops.as_slice(), course.climb_m()), (&[expected][..], 4.0));
    }
}
