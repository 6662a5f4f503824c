//! The network of passages as a surveyor draws it, without what is smaller than a passage is wide.

use super::of_voxels::cave_line;
use super::passage::passage_width;
use super::{Branch, CaveNetwork, CaveNetworkError};
use crate::voxels::VoxelSet;

impl CaveNetwork {
    /// The network of the passages of a set of voxels: that of its
    /// [centreline](crate::voxels::centreline), as a surveyor draws it. Voxels with many open sides are
    /// thinned away first, which leaves fewer lines to bumps of the walls than side by side in turn.
    ///
    /// Thinning keeps a line to bumps of a wall, and makes several junctions where wide passages
    /// meet. A surveyor goes on where there is a passage, and sets one station in a crossing. So a
    /// branch with an open end goes if it is no longer than the passage that it leaves is wide; and two
    /// junctions that are no farther apart than that, or whose voxels touch, become one. The shortest
    /// goes first, as each may make one way of two. What is left of vugs, voids apart from the rest that
    /// are no longer than the widest passage is wide, goes too.
    ///
    /// Positions are those of [`CaveNetwork::of_centreline`].
    ///
    /// # Errors
    /// [`CaveNetworkError::Empty`] of a set without passages.
    pub fn of_passages(cave: &VoxelSet, spacing_m: f64) -> Result<Self, CaveNetworkError> {
        let mut network = Self::of_centreline(&cave_line(cave), spacing_m)?;
        let touching_m = 3.0_f64.sqrt() * spacing_m;
        let width = |at: [f64; 3]| passage_width(cave, at, spacing_m).max(touching_m);
        loop {
            if let Some(fewer) = network.without_spurs(width) {
                network = fewer;
            } else if let Some(fewer) = network.with_crossings_joined(width) {
                network = fewer;
            } else {
                return Ok(network.without_vugs(width));
            }
        }
    }

    /// The network without parts that are no longer than its widest passage is wide; the longest stays.
    fn without_vugs(&self, width_m: impl Fn([f64; 3]) -> f64) -> Self {
        let widest_m = self.stations().iter().map(|&at| width_m(at)).fold(0.0, f64::max);
        let parts = self.parts();
        let mut part_of = vec![0; self.stations().len()];
        for (number, part) in parts.iter().enumerate() {
            part.iter().for_each(|&station| part_of[station] = number);
        }
        let mut length_m = vec![0.0; parts.len()];
        for &[from, to] in self.legs() {
            length_m[part_of[from]] += self.distance_m(from, to);
        }
        let longest_m = length_m.iter().copied().fold(0.0, f64::max);
        let is_kept = |leg: &&[usize; 2]| {
            let length_m = length_m[part_of[leg[0]]];
            length_m > widest_m || length_m == longest_m
        };
        let legs: Vec<[usize; 2]> = self.legs().iter().filter(is_kept).copied().collect();
        self.with_legs(&legs)
    }

    /// The network without the shortest spur of each junction; none if there are no spurs.
    fn without_spurs(&self, width_m: impl Fn([f64; 3]) -> f64) -> Option<Self> {
        let mut shortest: Vec<Option<Branch>> = vec![None; self.stations().len()];
        for branch in self.branches() {
            let Some(junction) = self.open_from(&branch) else { continue };
            let most = match &shortest[junction] {
                Some(spur) => spur.length_m,
                None => width_m(self.stations()[junction]),
            };
            if branch.length_m <= most {
                shortest[junction] = Some(branch);
            }
        }
        let gone = Legs::of(shortest.iter().flatten());
        let legs: Vec<[usize; 2]> = gone.others(self.legs());
        (!gone.0.is_empty()).then(|| self.with_legs(&legs))
    }

    /// The network with junctions joined in their middle that lie within the width of a passage of each
    /// other, each with one other at most; none if there are none.
    fn with_crossings_joined(&self, width_m: impl Fn([f64; 3]) -> f64) -> Option<Self> {
        let is_junction = |station: usize| self.neighbours(station).len() > 2;
        let mut links = self.branches();
        links.retain(|link| {
            let [from, to] = ends(link);
            let wide = [from, to].map(|end| width_m(self.stations()[end]));
            from != to
                && [from, to].into_iter().all(is_junction)
                && link.length_m <= wide[0].max(wide[1])
        });
        // Stable, so that links of one length stay in the order of their stations.
        links.sort_by(|a, b| a.length_m.total_cmp(&b.length_m));
        let mut stations = self.stations().to_vec();
        let mut stands_for: Vec<usize> = (0..stations.len()).collect();
        let mut is_joined = vec![false; stations.len()];
        links.retain(|link| {
            let [from, to] = ends(link);
            let is_free = !is_joined[from] && !is_joined[to];
            if is_free {
                [is_joined[from], is_joined[to]] = [true; 2];
                let middle =
                    [0, 1, 2].map(|axis| stations[from][axis].midpoint(stations[to][axis]));
                stations[from] = middle;
                stands_for[to] = from;
            }
            is_free
        });
        let kept = Legs::of(&links).others(self.legs());
        let legs: Vec<[usize; 2]> = kept.iter().map(|leg| leg.map(|end| stands_for[end])).collect();
        let joined = Self::new(stations, &legs).ok().filter(|_| !links.is_empty())?;
        Some(joined.with_legs(joined.legs()))
    }

    /// The junction from which a branch leads to an open end.
    fn open_from(&self, branch: &Branch) -> Option<usize> {
        let ends = ends(branch);
        match ends.map(|end| self.neighbours(end).len()) {
            [1, others] if others > 2 => Some(ends[1]),
            [others, 1] if others > 2 => Some(ends[0]),
            _ => None,
        }
    }
}

/// First and last station of a branch.
fn ends(branch: &Branch) -> [usize; 2] {
    [branch.stations[0], branch.stations[branch.stations.len() - 1]]
}

/// Legs in order.
struct Legs(Vec<[usize; 2]>);

impl Legs {
    /// Those of branches.
    fn of<'a>(branches: impl IntoIterator<Item = &'a Branch>) -> Self {
        let sorted = |leg: &[usize]| [leg[0].min(leg[1]), leg[0].max(leg[1])];
        let of_branch = |branch: &'a Branch| branch.stations.windows(2).map(sorted);
        let mut legs: Vec<[usize; 2]> = branches.into_iter().flat_map(of_branch).collect();
        legs.sort_unstable();
        Self(legs)
    }

    /// Those of a list that are not among these.
    fn others(&self, legs: &[[usize; 2]]) -> Vec<[usize; 2]> {
        legs.iter().filter(|leg| self.0.binary_search(leg).is_err()).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gallery 5 voxels wide and high with bumps on its walls, a niche, and a side passage.
    fn gallery(with_bumps: bool) -> VoxelSet {
        VoxelSet::new([60, 40, 9], |[x, y, z]| {
            let gallery = (2..58).contains(&x) && (2..7).contains(&y) && (2..7).contains(&z);
            let bump = x % 7 == 3 && x > 5 && x < 55 && (y == 7 || y == 1) && z == 4;
            let niche = (20..22).contains(&x) && (7..10).contains(&y) && z == 4;
            let side = (30..33).contains(&x) && (7..38).contains(&y) && (3..6).contains(&z);
            gallery || side || (with_bumps && (bump || niche))
        })
    }

    #[test]
    fn bumps_and_niches_are_no_passages() {
        let rough = CaveNetwork::of_passages(&gallery(true), 0.5).unwrap();
        let thin = CaveNetwork::of_centreline(&cave_line(&gallery(true)), 0.5).unwrap();
        assert!(thin.branches().len() > 3, "{}", thin.branches().len());
        // Two arms of the gallery and the side passage.
        assert_eq!(rough.branches().len(), 3);
        let smooth = CaveNetwork::of_passages(&gallery(false), 0.5).unwrap();
        assert_eq!(smooth.branches().len(), 3);
        let change = (rough.length_m() / smooth.length_m() - 1.0).abs();
        assert!(change < 0.1, "{change}");
    }

    /// Two wide galleries that cross aslant are one crossing of four branches.
    #[test]
    fn a_crossing_is_one_junction() {
        let set = VoxelSet::new([60, 60, 9], |[x, y, z]| {
            let (x, y) = (x as f64 - 30.0, y as f64 - 30.0);
            let within = x.hypot(y) < 28.0 && (2..7).contains(&z);
            let across = |turn: f64| (x * turn.sin() - y * turn.cos()).abs() < 3.0;
            within && (across(0.3) || across(1.4))
        });
        let thin = CaveNetwork::of_centreline(&cave_line(&set), 1.0).unwrap();
        let network = CaveNetwork::of_passages(&set, 1.0).unwrap();
        assert!(thin.branches().len() > 4, "{}", thin.branches().len());
        assert_eq!((network.branches().len(), network.cyclomatic_number()), (4, 0));
        let arms = network.length_m() / 4.0;
        assert!((22.0..32.0).contains(&arms), "{arms}");
    }

    #[test]
    fn voids_apart_are_no_caves_unless_they_are_long() {
        let cave = |with_voids: bool| {
            VoxelSet::new([60, 40, 9], |[x, y, z]| {
                let gallery = (2..58).contains(&x) && (2..7).contains(&y) && (2..7).contains(&z);
                let vug = (10..14).contains(&x) && y == 20 && z == 3;
                let second = (10..40).contains(&x) && y == 30 && z == 3;
                gallery || second || (with_voids && vug)
            })
        };
        let networks =
            [false, true].map(|voids| CaveNetwork::of_passages(&cave(voids), 1.0).unwrap());
        assert_eq!(networks[0], networks[1]);
        assert_eq!(networks[0].component_count(), 2);
        let alone = VoxelSet::new([9, 9, 9], |[x, y, z]| x < 3 && y == 4 && z == 4);
        assert_eq!(CaveNetwork::of_passages(&alone, 1.0).unwrap().length_m(), 2.0);
    }

    /// A number from 0 to 1 (SplitMix64).
    fn share(seed: u64, number: usize) -> f64 {
        let mut bits = (seed << 32 | number as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ bits >> 31) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(from: [f64; 3], to: [f64; 3], along: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| from[axis] + along * (to[axis] - from[axis]))
    }

    fn distance(from: [f64; 3], to: [f64; 3]) -> f64 {
        (0..3).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt()
    }

    /// Distance from a line, by points along it.
    fn off_line(at: [f64; 3], [from, to]: [[f64; 3]; 2]) -> f64 {
        let points = (0..=60).map(|step| between(from, to, f64::from(step) / 60.0));
        points.map(|point| distance(at, point)).fold(f64::INFINITY, f64::min)
    }

    /// A crooked passage with side passages, all with rough walls; also the number of their branches and
    /// the length of their middle lines.
    fn rough_cave(seed: u64) -> (VoxelSet, usize, f64) {
        let off = |number: usize, most: f64| most * (share(seed, number) - 0.5);
        let bend =
            |at: usize| [6.0 + 12.0 * at as f64, 30.0 + off(at, 8.0), 12.0 + off(10 + at, 8.0)];
        let mut lines: Vec<[[f64; 3]; 2]> = (0..6).map(|at| [bend(at), bend(at + 1)]).collect();
        let sides = 2 + seed as usize % 4;
        lines.extend((0..sides).map(|side| {
            let (north, long) =
                (if side % 2 == 0 { 1.0 } else { -1.0 }, 18.0 + off(20 + side, 12.0));
            let way = [off(30 + side, 1.2), north, off(40 + side, 0.4)];
            let from = bend(side + 1);
            [from, [0, 1, 2].map(|axis| from[axis] + long * way[axis])]
        }));
        let size = [84, 60, 26];
        let radius = 2.2 + off(60, 2.0);
        let set = VoxelSet::new(size, |[x, y, z]| {
            let reach = radius + off(100 + x + size[0] * (y + size[1] * z), 1.0);
            lines.iter().any(|&line| off_line([x as f64, y as f64, z as f64], line) <= reach)
        });
        (set, 1 + 2 * sides, lines.iter().map(|&[from, to]| distance(from, to)).sum())
    }

    /// With voxels thinned side by side in turn, as listing A.5 has it, lines are a third longer.
    #[test]
    fn rough_walls_are_no_passages() {
        let (mut off, mut length): (f64, f64) = (0.0, 0.0);
        for seed in 0..10 {
            let (cave, branches, length_m) = rough_cave(seed);
            let network = CaveNetwork::of_passages(&cave, 1.0).unwrap().resampled(1.0);
            off += (network.branches().len() as f64 / branches as f64 - 1.0).abs() / 10.0;
            length += network.length_m() / length_m / 10.0;
        }
        assert!(off < 0.15, "{off}");
        assert!((length - 1.0).abs() < 0.05, "{length}");
    }
}
