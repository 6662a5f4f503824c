//! What happened while a cave grew: which sources drain, and which took the water of others.

use landform_graph::Lattice;
use serde::{Deserialize, Serialize};

use crate::courses::{CourseScale, courses};
use crate::passages::Passages;

/// What happened to a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CaveEventKind {
    /// Passages joined it with another source; neither drained then.
    Link,
    /// Passages led it to a sink on a course of its own.
    Breakthrough,
    /// Passages led it into the course of another source, whose tributary it became.
    Capture,
    /// Its course goes up after it came down, when it comes to drain.
    PhreaticLoop,
}

/// An event in the growth of a cave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaveEvent {
    /// Iteration of the stage, from 1.
    pub iteration: u64,
    /// What happened.
    pub kind: CaveEventKind,
    /// Number of the source that it happened to.
    pub source: u32,
    /// Number of the other source, of a link or a capture.
    pub other: Option<u32>,
    /// Voxel where the course meets the other, ends, or turns up; of a link one of the passages.
    pub node: u32,
    /// How far the course from the source to the sink goes up, or how far the loop does, in metres; 0
    /// for a link.
    pub rise_m: f64,
    /// Length of that course in metres, 0 for a link.
    pub length_m: f64,
}

/// The events so far, and which sources drain.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CaveRecord {
    /// Sources that drain, in the order in which they came to.
    pub drained: Vec<u32>,
    /// Pairs of sources that passages joined before they drained.
    linked: Vec<(u32, u32)>,
    /// What happened, in order.
    pub events: Vec<CaveEvent>,
}

impl CaveRecord {
    /// Looks for what the latest iteration joined. `sources` are the voxels of each source.
    pub fn survey(
        &mut self,
        lattice: &Lattice,
        (passages, pressure): (&mut Passages, &[f64]),
        (sources, sinks): (&[Vec<usize>], &[usize]),
        scale: CourseScale,
        iteration: u64,
    ) {
        let mut systems_of = |nodes: &[usize]| -> Vec<usize> {
            let mut systems: Vec<usize> =
                nodes.iter().filter_map(|&node| passages.system(node)).collect();
            systems.sort_unstable();
            systems.dedup();
            systems
        };
        let at_sinks = systems_of(sinks);
        let of_sources: Vec<Vec<usize>> = sources.iter().map(|nodes| systems_of(nodes)).collect();
        let drains = |systems: &[usize]| systems.iter().any(|system| at_sinks.contains(system));
        let known = self.drained.len();
        for (source, systems) in of_sources.iter().enumerate() {
            if drains(systems) && !self.drained.contains(&(source as u32)) {
                self.drained.push(source as u32);
            }
        }
        if self.drained.len() > known {
            self.tell_drained(lattice, pressure, sources, scale, (known, iteration));
        }
        for (source, systems) in of_sources.iter().enumerate().filter(|(_, of)| !drains(of)) {
            for (other, others) in of_sources.iter().enumerate().take(source) {
                let pair = (source as u32, other as u32);
                let shared = systems.iter().find(|system| others.contains(system));
                if let Some(&system) = shared.filter(|_| !self.linked.contains(&pair)) {
                    self.linked.push(pair);
                    self.events.push(CaveEvent {
                        iteration,
                        kind: CaveEventKind::Link,
                        source: pair.0,
                        other: Some(pair.1),
                        node: system as u32,
                        rise_m: 0.0,
                        length_m: 0.0,
                    });
                }
            }
        }
    }

    /// Adds the events of the sources that drain since there were `known`, with the loops of their
    /// courses.
    fn tell_drained(
        &mut self,
        lattice: &Lattice,
        pressure: &[f64],
        sources: &[Vec<usize>],
        scale: CourseScale,
        (known, iteration): (usize, u64),
    ) {
        let starts = starts(&self.drained, sources, pressure);
        for course in &courses(lattice, pressure, &starts, scale)[known..] {
            let end = course.trail[course.trail.len() - 1];
            let kind = match course.joins {
                Some(_) => CaveEventKind::Capture,
                None => CaveEventKind::Breakthrough,
            };
            self.events.push(CaveEvent {
                iteration,
                kind,
                source: course.source,
                other: course.joins.map(|joins| joins.0),
                node: course.joins.map_or(end, |joins| joins.1) as u32,
                rise_m: course.climb_m(),
                length_m: course.length_m,
            });
            self.events.extend(course.loops.iter().map(|up| CaveEvent {
                iteration,
                kind: CaveEventKind::PhreaticLoop,
                source: course.source,
                other: None,
                node: up.foot as u32,
                rise_m: up.rise_m,
                length_m: course.length_m,
            }));
        }
    }

    /// Number of events of a kind.
    pub fn count(&self, kind: CaveEventKind) -> usize {
        self.events.iter().filter(|event| event.kind == kind).count()
    }
}

/// Where the courses of sources begin: at the voxel of each with the lowest pressure.
pub fn starts(numbers: &[u32], sources: &[Vec<usize>], pressure: &[f64]) -> Vec<(u32, usize)> {
    let lowest = |nodes: &Vec<usize>| {
        nodes.iter().copied().reduce(|a, b| if pressure[b] < pressure[a] { b } else { a })
    };
    let start = |&number: &u32| Some((number, lowest(sources.get(number as usize)?)?));
    numbers.iter().filter_map(start).collect()
}
