//! The largest flow to protosinks, and the channels that follow it.

use landform_graph::max_flow::{Terminal, maximum_flow};
use landform_graph::{Edge, Lattice};

use super::zones::{Seed, Zones};
use crate::CaveError;

/// Units of flow in a porosity of 1: so many that poor rock too lets one pass to each of many protosinks.
const UNITS: f64 = 1e6;

/// Porosity below which rock is as dear to pass as with it.
const DENSE: f64 = 1e-3;

/// A system of protochannels.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    /// Number of channels through each voxel: how many protosinks drain it.
    pub channels: Vec<u32>,
    /// The channels, each from its source to its protosink.
    pub paths: Vec<Vec<usize>>,
    /// Protosinks that flow cannot reach: behind rock without pores.
    pub missed: usize,
    /// The largest flow, in millionths of the porosity of a voxel.
    pub flow: u64,
}

/// Protochannels from the `seeds` of sources to the `sinks` on the boundaries of their zones.
///
/// The flow between two voxels of a zone is limited by the lesser porosity, by which its way is also
/// judged: an edge costs its length over that, so flow keeps to good rock. Every protosink takes
/// at most an even share of what its source can give: without that limit the few nearest would take
/// all. Every one gets a unit before any gets its share, so that those which are cheap to reach leave
/// some to those behind poor rock, and channels grow to all. From each protosink a channel then goes back up the flow, to the neighbour from which most
/// comes, until it meets its source. Two channels that meet go on as one, so the channels of a source
/// are a tree (thesis, section 5.2.1: following the flow from the sinks makes branches, from the source
/// a mass).
///
/// `sinks` are pairs of a voxel and the number of the source in whose zone it lies.
///
/// # Errors
/// [`CaveError::Flow`] if a voxel is named twice or does not exist.
pub fn protochannels(
    lattice: &Lattice,
    porosity: &[f64],
    zones: &Zones,
    seeds: &[Seed],
    sinks: &[(usize, u32)],
) -> Result<Network, CaveError> {
    let units: Vec<u32> =
        porosity.iter().map(|porosity| (porosity.clamp(0.0, 1.0) * UNITS).ceil() as u32).collect();
    let capacity = |from: usize, edge: &Edge| match zones.owner[from] == zones.owner[edge.node] {
        true => units[from].min(units[edge.node]),
        false => 0,
    };
    let ease: Vec<f64> = porosity.iter().map(|porosity| porosity.clamp(DENSE, 1.0)).collect();
    let lengths = lattice.edge_lengths().map(|length| length / lattice.spacing());
    let cost = |from: usize, edge: &Edge| {
        let axes = edge.step.iter().filter(|along| **along != 0).count();
        lengths[axes - 1] / ease[from].min(ease[edge.node])
    };
    let is_seed = |node: usize| seeds.iter().any(|seed| seed.node == node);
    // What flows between voxels of a source does not leave it.
    let leaving = |node: usize| -> u64 {
        let out = lattice.neighbours(node).filter(|edge| !is_seed(edge.node));
        out.map(|edge| u64::from(capacity(node, &edge))).sum()
    };
    let sources: Vec<Terminal> =
        seeds.iter().map(|seed| Terminal { node: seed.node, most: leaving(seed.node) }).collect();
    let share = |owner: u32| {
        let of_source = seeds.iter().zip(&sources).filter(|(seed, _)| seed.source == owner);
        let given: u64 = of_source.map(|(_, terminal)| terminal.most).sum();
        let takers = sinks.iter().filter(|sink| sink.1 == owner).count() as u64;
        (given / takers.max(1)).max(1)
    };
    let terminals: Vec<Terminal> =
        sinks.iter().map(|&(node, owner)| Terminal { node, most: share(owner) }).collect();
    let mut largest = maximum_flow(lattice, capacity, cost, &sources, &terminals)?;
    let reached = terminals.iter().zip(&largest.taken).filter(|(_, taken)| **taken > 0);
    let reached: Vec<usize> = reached.map(|(sink, _)| sink.node).collect();
    let mut channels = vec![0; lattice.node_count()];
    let mut walk = Walk { lattice, flow: &mut largest.flow, walk_of: vec![0; channels.len()] };
    let mut paths = Vec::with_capacity(reached.len());
    for (number, &sink) in reached.iter().enumerate() {
        let path = walk.upstream(sink, number as u32 + 1, is_seed);
        path.iter().for_each(|&node| channels[node] += 1);
        paths.push(path);
    }
    Ok(Network { channels, paths, missed: terminals.len() - reached.len(), flow: largest.value })
}

/// Walks up a flow.
struct Walk<'a> {
    lattice: &'a Lattice,
    flow: &'a mut [i32],
    /// Number of the last walk that passed each voxel.
    walk_of: Vec<u32>,
}

impl Walk<'_> {
    /// The way from the source down to `sink`. Flow that runs in a circle on the way is taken out.
    fn upstream(
        &mut self,
        sink: usize,
        number: u32,
        is_source: impl Fn(usize) -> bool,
    ) -> Vec<usize> {
        let mut path = vec![sink];
        let mut node = sink;
        self.walk_of[node] = number;
        // As much comes into every voxel as leaves it, so a walk ends at a source.
        while let Some(from) = self.feeder(node).filter(|_| !is_source(node)) {
            if self.walk_of[from] == number {
                let first = path.iter().position(|&passed| passed == from).unwrap_or(0);
                self.take_out(&path[first..]);
                for &node in &path[first + 1..] {
                    self.walk_of[node] = 0;
                }
                path.truncate(first + 1);
            } else {
                path.push(from);
                self.walk_of[from] = number;
            }
            node = from;
        }
        path.reverse();
        path
    }

    /// The neighbour from which most flow comes, the first among equals.
    fn feeder(&self, node: usize) -> Option<usize> {
        let coming = |edge: Edge| (-self.flow[self.lattice.slot(node, &edge)], edge.node);
        let coming = self.lattice.neighbours(node).map(coming).filter(|(flow, _)| *flow > 0);
        coming.reduce(|most, other| if other.0 > most.0 { other } else { most }).map(|most| most.1)
    }

    /// Takes out the flow round a circle, given against the flow: each voxel is fed by the next, the
    /// last by the first.
    fn take_out(&mut self, circle: &[usize]) {
        let next = |at: usize| circle[(at + 1) % circle.len()];
        let slots: Vec<[usize; 2]> = (0..circle.len())
            .filter_map(|at| {
                let edge =
                    self.lattice.neighbours(circle[at]).find(|edge| edge.node == next(at))?;
                Some([self.lattice.slot(circle[at], &edge), self.lattice.reverse_slot(&edge)])
            })
            .collect();
        let least = slots.iter().map(|slot| self.flow[slot[1]]).min().unwrap_or(0);
        for [coming, going] in slots {
            self.flow[coming] += least;
            self.flow[going] -= least;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Preference, pressure_zones, protosinks};
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use landform_sim::random::RandomStream;
    use landform_synth::{Generator, SmoothNoise};

    fn rock(lattice: &Lattice) -> Vec<f64> {
        let noise = SmoothNoise {
            mean_m: 0.15,
            standard_deviation_m: 0.04,
            correlation_length_m: 4.0,
            ..SmoothNoise::default()
        };
        let field = noise.generate(lattice, 3).unwrap();
        field.into_iter().map(|porosity| porosity.clamp(0.02, 0.3)).collect()
    }

    fn network(cone: Option<Preference>) -> (Lattice, Network, Vec<Seed>, Vec<(usize, u32)>) {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([40, 40, 20], 1.0, Connectivity::Voxel26, open).unwrap();
        let porosity = rock(&lattice);
        let seed = |at, source| Seed { node: lattice.node(at), source, pressure: 1.0 };
        let seeds = vec![seed([10, 10, 10], 0), seed([11, 10, 10], 0), seed([30, 28, 12], 1)];
        let zones = pressure_zones(&lattice, |_| true, &seeds).unwrap();
        let random = RandomStream::new(1, "protosinks");
        let of = |source, near| {
            let limits = (40, f64::INFINITY);
            let chosen = protosinks(
                &lattice,
                &zones,
                (source, near),
                limits,
                cone.as_ref(),
                |_| true,
                &random,
            );
            chosen.into_iter().map(move |node| (node, source))
        };
        let sinks: Vec<_> = of(0, seeds[0].node).chain(of(1, seeds[2].node)).collect();
        let network = protochannels(&lattice, &porosity, &zones, &seeds, &sinks).unwrap();
        (lattice, network, seeds, sinks)
    }

    /// The band of figure 5.5: connected, branching, no clumps.
    #[test]
    fn protochannels_are_trees_that_reach_nearly_all_protosinks() {
        let (lattice, network, seeds, sinks) = network(None);
        assert_eq!(network.paths.len() + network.missed, sinks.len());
        assert!(network.missed * 20 <= sinks.len(), "{} of {} missed", network.missed, sinks.len());
        for path in &network.paths {
            assert!(seeds.iter().any(|seed| seed.node == path[0]));
            assert!(
                path.windows(2)
                    .all(|step| { lattice.neighbours(step[0]).any(|edge| edge.node == step[1]) })
            );
        }
        // One way up from each voxel: channels that met have not parted.
        let mut above = vec![None; lattice.node_count()];
        for step in network.paths.iter().flat_map(|path| path.windows(2)) {
            let known = above[step[1]].get_or_insert(step[0]);
            assert_eq!(*known, step[0]);
        }
        let branches = network.channels.iter().filter(|&&channels| channels > 1).count();
        assert!(branches > 40, "{branches} shared voxels");
        let taken = network.channels.iter().filter(|&&channels| channels > 0).count();
        let steps: usize = network.paths.iter().map(|path| path.len() - 1).sum();
        assert!(taken < steps, "channels share their way");
    }

    /// A source of many voxels gives every protosink a large share, of which rock with next to no pores
    /// lets little pass.
    #[test]
    fn large_sources_reach_protosinks_in_poor_rock() {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([30, 30, 15], 1.0, Connectivity::Voxel26, open).unwrap();
        let poor = |node: usize| lattice.coordinates(node)[0] > 18;
        let porosity: Vec<f64> = rock(&lattice)
            .into_iter()
            .enumerate()
            .map(|(node, porosity)| if poor(node) { 5e-5 } else { porosity })
            .collect();
        let seeds: Vec<Seed> = crate::place::box_nodes(&lattice, [0.2, 0.5, 0.5], [4.0; 3])
            .unwrap()
            .into_iter()
            .map(|node| Seed { node, source: 0, pressure: 1.0 })
            .collect();
        let zones = pressure_zones(&lattice, |_| true, &seeds).unwrap();
        let random = RandomStream::new(1, "protosinks");
        let limits = (120, f64::INFINITY);
        let near = (0, seeds[0].node);
        let sinks = protosinks(&lattice, &zones, near, limits, None, |_| true, &random);
        let behind = sinks.iter().filter(|&&sink| poor(sink)).count();
        assert!(behind > 30, "{behind}");
        let sinks: Vec<(usize, u32)> = sinks.into_iter().map(|sink| (sink, 0)).collect();
        let network = protochannels(&lattice, &porosity, &zones, &seeds, &sinks).unwrap();
        assert_eq!((network.missed, network.paths.len()), (0, 120));
    }

    #[test]
    fn clustered_protosinks_lead_channels_in_one_direction() {
        let west = Preference { azimuth_deg: 180.0, rise_deg: 0.0, spread_deg: 40.0 };
        let (lattice, network, seeds, _) = network(Some(west));
        assert!(!network.paths.is_empty());
        for path in &network.paths {
            let ends = [path[0], path[path.len() - 1]].map(|node| lattice.position(node).x);
            assert!(ends[1] < ends[0] || path.len() == 1, "{ends:?}");
        }
        assert_eq!(seeds.len(), 3);
    }
}
