//! Networks of stations and legs, as surveyors measure them.

use thiserror::Error;

/// Why stations and legs are no network.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CaveNetworkError {
    /// A leg names a station that there is not.
    #[error(
        "leg {leg} joins stations {ends:?}, but there are {stations}; legs name stations from 0"
    )]
    NoStation {
        /// Number of the leg.
        leg: usize,
        /// What it joins.
        ends: [usize; 2],
        /// Number of stations.
        stations: usize,
    },
    /// A coordinate is infinite, not a number, or beyond what lengths can be computed of.
    #[error("station {station} lies at {position:?}; coordinates must be finite and below 1e12 m")]
    Position {
        /// Number of the station.
        station: usize,
        /// Where it lies.
        position: [f64; 3],
    },
    /// No leg has a length.
    #[error("the network has no leg with a length; a cave needs one at least")]
    Empty,
}

/// Stations of a cave and the legs between them.
#[derive(Clone, Debug, PartialEq)]
pub struct CaveNetwork {
    stations: Vec<[f64; 3]>,
    legs: Vec<[usize; 2]>,
    /// Stations that a leg joins with each station, by station.
    neighbours: Vec<Vec<usize>>,
}

/// A way without junctions between two stations.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The stations from end to end; first and last are the same for a loop.
    pub stations: Vec<usize>,
    /// Length in metres.
    pub length_m: f64,
}

impl CaveNetwork {
    /// A network of stations at x (east), y (north), z (up) in metres, joined by legs.
    ///
    /// Legs without length and repeated ones are left out.
    ///
    /// # Errors
    /// [`CaveNetworkError`].
    pub fn new(stations: Vec<[f64; 3]>, legs: &[[usize; 2]]) -> Result<Self, CaveNetworkError> {
        const FARTHEST_M: f64 = 1e12;
        for (station, &position) in stations.iter().enumerate() {
            if !position.iter().all(|at| at.abs() < FARTHEST_M) {
                return Err(CaveNetworkError::Position { station, position });
            }
        }
        let count = stations.len();
        let mut kept: Vec<[usize; 2]> = Vec::with_capacity(legs.len());
        for (leg, &ends) in legs.iter().enumerate() {
            if ends.iter().any(|&end| end >= count) {
                return Err(CaveNetworkError::NoStation { leg, ends, stations: count });
            }
            if stations[ends[0]] != stations[ends[1]] {
                kept.push([ends[0].min(ends[1]), ends[0].max(ends[1])]);
            }
        }
        kept.sort_unstable();
        kept.dedup();
        if kept.is_empty() {
            return Err(CaveNetworkError::Empty);
        }
        let mut neighbours = vec![Vec::new(); count];
        for &[from, to] in &kept {
            neighbours[from].push(to);
            neighbours[to].push(from);
        }
        neighbours.iter_mut().for_each(|list| list.sort_unstable());
        Ok(Self { stations, legs: kept, neighbours })
    }

    /// Positions of the stations: x (east), y (north), z (up) in metres.
    pub fn stations(&self) -> &[[f64; 3]] {
        &self.stations
    }

    /// Pairs of stations that are joined, the lower number first, in order.
    pub fn legs(&self) -> &[[usize; 2]] {
        &self.legs
    }

    /// Stations that legs join with a station, in order.
    ///
    /// # Panics
    /// If there is no such station.
    pub fn neighbours(&self, station: usize) -> &[usize] {
        &self.neighbours[station]
    }

    /// Length between two stations in a straight line, in metres.
    ///
    /// # Panics
    /// If there is no such station.
    pub fn distance_m(&self, from: usize, to: usize) -> f64 {
        let steps = [0, 1, 2].map(|axis| self.stations[to][axis] - self.stations[from][axis]);
        steps[0].hypot(steps[1]).hypot(steps[2])
    }

    /// Length of all legs in metres.
    pub fn length_m(&self) -> f64 {
        self.legs.iter().map(|&[from, to]| self.distance_m(from, to)).sum()
    }

    /// Number of separate parts.
    pub fn component_count(&self) -> usize {
        self.anchors().len()
    }

    /// The first station of each separate part.
    pub fn anchors(&self) -> Vec<usize> {
        self.parts()
            .iter()
            .map(|part| part[0])
            .filter(|&first| !self.neighbours[first].is_empty())
            .collect()
    }

    /// The stations of each separate part; those without legs are parts of their own.
    pub(super) fn parts(&self) -> Vec<Vec<usize>> {
        super::paths::components(&self.neighbours)
    }

    /// Loops that are independent of each other: legs less stations plus parts.
    pub fn cyclomatic_number(&self) -> usize {
        let used = self.neighbours.iter().filter(|list| !list.is_empty()).count();
        self.legs.len() + self.component_count() - used
    }

    /// All ways without junctions: between ends and junctions, and loops without either, in the order
    /// of the stations where they begin.
    pub fn branches(&self) -> Vec<Branch> {
        let mut walked = Walked { network: self, legs: vec![false; self.legs.len()] };
        let mut branches = Vec::new();
        let is_knot = |station: &usize| ![0, 2].contains(&self.neighbours[*station].len());
        for station in (0..self.stations.len()).filter(is_knot) {
            for &next in &self.neighbours[station] {
                branches.extend(walked.branch(station, next));
            }
        }
        // What is left are loops on which no junction lies.
        for &[from, to] in &self.legs {
            branches.extend(walked.branch(from, to));
        }
        branches
    }

    /// The same network with fewer stations: those of branches from which no other lies farther than
    /// `tolerance_m` off the straight legs (Douglas and Peucker), as a surveyor would set them.
    /// Every loop keeps three stations.
    #[must_use]
    pub fn resampled(&self, tolerance_m: f64) -> Self {
        let mut kept: Vec<[usize; 2]> = Vec::new();
        for branch in self.branches() {
            let stations = branch.stations;
            let mut stays = vec![false; stations.len()];
            let last = stations.len() - 1;
            // Loops, and branches that may share both ends, need stations in between.
            let cuts = match stations.len() {
                3.. if stations[0] == stations[last] => {
                    vec![0, last.div_ceil(3), (2 * last).div_ceil(3), last]
                }
                3.. if self.joins_junctions(&stations) => vec![0, last / 2, last],
                _ => vec![0, last],
            };
            let spans = cuts.windows(2).map(|cut| [cut[0], cut[1]]);
            for [from, to] in spans {
                (stays[from], stays[to]) = (true, true);
                self.keep_far(&stations, [from, to], tolerance_m, &mut stays);
            }
            let left: Vec<usize> =
                stations.iter().zip(&stays).filter(|(_, stays)| **stays).map(|(&s, _)| s).collect();
            kept.extend(left.windows(2).map(|leg| [leg[0], leg[1]]));
        }
        self.with_legs(&kept)
    }

    /// Whether a branch runs from junction to junction, so that another one may do so too.
    fn joins_junctions(&self, stations: &[usize]) -> bool {
        let ends = [stations[0], stations[stations.len() - 1]];
        ends.iter().all(|&end| self.neighbours[end].len() > 2)
    }

    /// Marks the stations of a span that must stay.
    fn keep_far(&self, stations: &[usize], span: [usize; 2], tolerance_m: f64, stays: &mut [bool]) {
        let mut open = vec![span];
        while let Some([from, to]) = open.pop() {
            let off = |index: usize| {
                let [a, b, p] = [from, to, index].map(|index| self.stations[stations[index]]);
                distance_to_leg(p, a, b)
            };
            let farthest = (from + 1..to).map(|index| (off(index), index));
            let farthest = farthest.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            if let Some((_, index)) = farthest.filter(|(distance, _)| *distance > tolerance_m) {
                stays[index] = true;
                open.extend([[from, index], [index, to]]);
            }
        }
    }

    /// The network of other legs between its stations, without stations that are not used.
    pub(super) fn with_legs(&self, legs: &[[usize; 2]]) -> Self {
        let mut number = vec![usize::MAX; self.stations.len()];
        legs.iter().flatten().for_each(|&station| number[station] = 0);
        let mut stations = Vec::new();
        for (station, number) in number.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
            *number = stations.len();
            stations.push(self.stations[station]);
        }
        let legs: Vec<[usize; 2]> = legs.iter().map(|leg| leg.map(|end| number[end])).collect();
        // Stations are those of this network, so nothing can be refused.
        Self::new(stations, &legs).unwrap_or_else(|_| self.clone())
    }
}

/// Legs that belong to a branch already.
struct Walked<'a> {
    network: &'a CaveNetwork,
    legs: Vec<bool>,
}

impl Walked<'_> {
    /// The branch that begins with the leg between two stations, if no other has it.
    fn branch(&mut self, start: usize, next: usize) -> Option<Branch> {
        let network = self.network;
        let mut stations = vec![start];
        let (mut from, mut to) = (start, next);
        let mut length_m = 0.0;
        loop {
            let leg = [from.min(to), from.max(to)];
            let index = network.legs.binary_search(&leg).ok()?;
            if std::mem::replace(&mut self.legs[index], true) {
                // A loop that came back to where it began.
                break;
            }
            stations.push(to);
            length_m += network.distance_m(from, to);
            match network.neighbours[to][..] {
                [one, other] if to != start => {
                    (from, to) = (to, if one == from { other } else { one })
                }
                _ => break,
            }
        }
        (stations.len() > 1).then_some(Branch { stations, length_m })
    }
}

/// Distance of a point from a straight leg.
fn distance_to_leg(point: [f64; 3], from: [f64; 3], to: [f64; 3]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|axis| a[axis] - b[axis]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [along, off] = [minus(to, from), minus(point, from)];
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(off, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let rest = [0, 1, 2].map(|axis| off[axis] - share * along[axis]);
    dot(rest, rest).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ladder of two rungs with a tail, and a ring apart.
    fn ladder() -> CaveNetwork {
        let at = |x: i32, y: i32| [f64::from(x), f64::from(y), 0.0];
        let stations = vec![
            at(0, 0),
            at(2, 0),
            at(2, 1),
            at(0, 1),
            at(-3, 0),
            at(-6, 0),
            at(10, 0),
            at(11, 0),
            at(11, 1),
            at(10, 1),
        ];
        let legs = [
            [0, 1],
            [1, 2],
            [2, 3],
            [3, 0],
            [4, 0],
            [5, 4],
            [6, 7],
            [7, 8],
            [8, 9],
            [9, 6],
            [1, 0],
        ];
        CaveNetwork::new(stations, &legs).unwrap()
    }

    #[test]
    fn branches_run_from_knot_to_knot() {
        let network = ladder();
        let branches = network.branches();
        let stations: Vec<&[usize]> = branches.iter().map(|branch| &branch.stations[..]).collect();
        assert_eq!(stations, [&[0, 1, 2, 3, 0][..], &[0, 4, 5], &[6, 7, 8, 9, 6]]);
        let lengths: Vec<f64> = branches.iter().map(|branch| branch.length_m).collect();
        assert_eq!(lengths, [6.0, 6.0, 4.0]);
        assert_eq!((network.length_m(), network.component_count()), (16.0, 2));
        assert_eq!(network.cyclomatic_number(), 2);
    }

    #[test]
    fn resampling_straightens_and_keeps_loops() {
        let network = ladder().resampled(1e9);
        assert_eq!((network.component_count(), network.cyclomatic_number()), (2, 2));
        assert!(network.stations().len() <= 7 && network.legs().len() <= 7);
        // Rings of every size stay rings.
        for count in 3..12 {
            let corner = |at: usize| {
                let angle = at as f64 * std::f64::consts::TAU / count as f64;
                [angle.cos(), angle.sin(), 0.0]
            };
            let legs: Vec<[usize; 2]> = (0..count).map(|at| [at, (at + 1) % count]).collect();
            let ring = CaveNetwork::new((0..count).map(corner).collect(), &legs).unwrap();
            let few = ring.resampled(1e9);
            assert_eq!((few.cyclomatic_number(), few.legs().len()), (1, 3), "{count}");
        }
        let same = ladder().resampled(0.1);
        assert!((same.length_m() - 16.0).abs() < 1e-12);
        // The tail is straight: one leg is enough.
        assert_eq!(same.legs().len(), 9);
    }

    #[test]
    fn bad_networks_are_refused() {
        let stations = vec![[0.0; 3], [1.0, 0.0, 0.0]];
        let said = |stations: &[[f64; 3]], legs: &[[usize; 2]]| {
            CaveNetwork::new(stations.to_vec(), legs).unwrap_err().to_string()
        };
        assert!(said(&stations, &[[0, 2]]).contains("leg 0 joins stations [0, 2]"));
        assert!(said(&stations, &[[1, 1]]).contains("no leg with a length"));
        assert!(said(&[[f64::NAN, 0.0, 0.0]], &[]).contains("station 0 lies at"));
    }
}
