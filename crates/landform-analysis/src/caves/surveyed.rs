//! The network of passages as a surveyor draws it, without what is smaller than a passage is wide.

use super::passage::passage_width;
use super::{Branch, CaveNetwork, CaveNetworkError};
use crate::voxels::{Rule, Turns, VoxelSet, centreline};

impl CaveNetwork {
    /// The network of the passages of a set of voxels: that of its [centreline], as a surveyor draws
    /// it.
    ///
    /// Thinning keeps a line to every bump of a wall, and makes several junctions where wide passages
    /// meet. A surveyor goes on where there is a passage, and sets one station in a crossing. So a
    /// branch with an open end goes if it is no longer than the passage that it leaves is wide; and two
    /// junctions that are no farther apart than that become one. The shortest goes first, as each may
    /// make one way of two.
    ///
    /// Positions are those of [`CaveNetwork::of_centreline`].
    ///
    /// # Errors
    /// [`CaveNetworkError::Empty`] of a set without passages.
    pub fn of_passages(cave: &VoxelSet, spacing_m: f64) -> Result<Self, CaveNetworkError> {
        let line = centreline(cave, Turns::Sides, Rule::Supported);
        let mut network = Self::of_centreline(&line, spacing_m)?;
        let width = |at: [f64; 3]| passage_width(cave, at, spacing_m);
        loop {
            if let Some(fewer) = network.without_spurs(width) {
                network = fewer;
            } else if let Some(fewer) = network.with_crossings_joined(width) {
                network = fewer;
            } else {
                return Ok(network);
            }
        }
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
        let line = centreline(&gallery(true), Turns::Sides, Rule::Supported);
        let thin = CaveNetwork::of_centreline(&line, 0.5).unwrap();
        assert!(thin.branches().len() > 10, "{}", thin.branches().len());
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
        let line = centreline(&set, Turns::Sides, Rule::Supported);
        let thin = CaveNetwork::of_centreline(&line, 1.0).unwrap();
        let network = CaveNetwork::of_passages(&set, 1.0).unwrap();
        assert!(thin.branches().len() > 4, "{}", thin.branches().len());
        assert_eq!((network.branches().len(), network.cyclomatic_number()), (4, 0));
        let arms = network.length_m() / 4.0;
        assert!((22.0..32.0).contains(&arms), "{arms}");
    }
}
