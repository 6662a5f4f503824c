//! Zones of rock that sources claim.

use landform_graph::Lattice;
use landform_graph::marching::Front;

use crate::CaveError;
use crate::error::check_range;
use crate::place::separation;

use super::straight::straight_distances;

/// Owner of voxels that no source claims.
pub const NO_SOURCE: u32 = u32::MAX;

/// A voxel of a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seed {
    /// The voxel.
    pub node: usize,
    /// Number of the source.
    pub source: u32,
    /// Pressure of the source, more than 0.
    pub pressure: f64,
}

/// Which source claims each voxel, and how far it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Zones {
    /// Number of the source, [`NO_SOURCE`] where none reaches.
    pub owner: Vec<u32>,
    /// Distance in metres to the nearest voxel of that source, times the largest pressure of all
    /// sources over the pressure of this one; infinite where none reaches.
    pub distance: Vec<f64>,
}

/// Zones of pressure by fast marching (thesis, listing 5.1): every voxel belongs to the source with
/// the least distance weighted by pressure, among those whose zone reaches it.
///
/// `open` tells which voxels water may enter; zones go round the others, distances are straight. Zones
/// of two sources meet on the sphere of Apollonius, of which the weaker source is inside.
///
/// # Errors
/// [`CaveError::NoSource`] without seeds; [`CaveError::OutOfRange`] for a pressure that is not
/// positive; [`CaveError::March`] for a seed outside the lattice.
pub fn pressure_zones(
    lattice: &Lattice,
    open: impl Fn(usize) -> bool,
    seeds: &[Seed],
) -> Result<Zones, CaveError> {
    let max_pressure = largest_pressure(seeds)?;
    let nodes = lattice.node_count();
    // Number of the seed of each voxel.
    let mut nearest = vec![u32::MAX; nodes];
    let mut distance = vec![f64::INFINITY; nodes];
    for (number, seed) in seeds.iter().enumerate() {
        if let Some(nearest) = nearest.get_mut(seed.node) {
            *nearest = number as u32;
            distance[seed.node] = 0.0;
        }
    }
    let starts: Vec<(usize, f64)> = seeds.iter().map(|seed| (seed.node, 0.0)).collect();
    Front::new().march(lattice, &starts, |from, edge| {
        let seed = &seeds[nearest[from] as usize];
        let weight = max_pressure / seed.pressure;
        let new_distance = weight * separation(lattice, edge.node, seed.node);
        (open(edge.node) && new_distance < distance[edge.node]).then(|| {
            distance[edge.node] = new_distance;
            nearest[edge.node] = nearest[from];
            new_distance
        })
    })?;
    let source = |seed: u32| seeds.get(seed as usize).map_or(NO_SOURCE, |seed| seed.source);
    Ok(Zones { owner: nearest.into_iter().map(source).collect(), distance })
}

/// The distances of [`pressure_zones`] without the owners, the same bits in less time: where there are few
/// seeds and no rock to go round, that of looking at every seed from every voxel.
///
/// # Errors
/// As [`pressure_zones`].
pub fn weighted_distances(
    lattice: &Lattice,
    open: impl Fn(usize) -> bool,
    seeds: &[Seed],
) -> Result<Vec<f64>, CaveError> {
    let max_pressure = largest_pressure(seeds)?;
    match straight_distances(lattice, &open, seeds, max_pressure) {
        Some(distances) => Ok(distances),
        None => pressure_zones(lattice, open, seeds).map(|zones| zones.distance),
    }
}

/// The largest pressure of all seeds.
fn largest_pressure(seeds: &[Seed]) -> Result<f64, CaveError> {
    for seed in seeds {
        check_range("pressure", seed.pressure, [f64::MIN_POSITIVE, f64::MAX])?;
    }
    seeds.iter().map(|seed| seed.pressure).reduce(f64::max).ok_or(CaveError::NoSource)
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity};
    use landform_sim::random::RandomStream;
    use proptest::prelude::*;

    /// Least weighted distance by looking at every seed from every voxel.
    fn least_distances(lattice: &Lattice, seeds: &[Seed]) -> Vec<f64> {
        let most = largest_pressure(seeds).unwrap();
        let weighted =
            |node: usize, seed: &Seed| most / seed.pressure * separation(lattice, node, seed.node);
        let least =
            |node| seeds.iter().map(|seed| weighted(node, seed)).fold(f64::INFINITY, f64::min);
        (0..lattice.node_count()).map(least).collect()
    }

    fn block(size: [usize; 3]) -> Lattice {
        Lattice::volume(size, 1.5, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap()
    }

    proptest! {
        #[test]
        fn zones_are_those_of_brute_force(
            places in prop::collection::btree_set(0..2400_usize, 1..4),
            pressures in prop::collection::vec(0.5..2.0_f64, 4),
        ) {
            let lattice = block([20, 15, 8]);
            let seed = |(number, node): (usize, usize)| {
                Seed { node, source: number as u32, pressure: pressures[number] }
            };
            let seeds: Vec<Seed> = places.into_iter().enumerate().map(seed).collect();
            let zones = pressure_zones(&lattice, |_| true, &seeds).unwrap();
            let distances = weighted_distances(&lattice, |_| true, &seeds).unwrap();
            prop_assert_eq!(&distances, &zones.distance);
            let least = least_distances(&lattice, &seeds);
            let mut differ = 0;
            for (node, least) in least.into_iter().enumerate() {
                // A zone of the definition may have a part that others cut off from its source;
                // a front does not get there.
                prop_assert!(zones.distance[node] >= least);
                differ += usize::from(zones.distance[node] > least);
                prop_assert!(zones.owner[node] < 4);
            }
            prop_assert!(differ * 20 <= 2400, "{differ} voxels");
        }
    }

    /// Looking at every seed gives the distances of the front, bit for bit, or nothing.
    #[test]
    fn straight_distances_are_those_of_the_front() {
        let lattice = block([24, 18, 11]);
        let random = RandomStream::new(3, "zones");
        let mut given = 0;
        for round in 0..60 {
            let draw = |index: u32| random.unit(round, 0, index);
            let wall = 0.4 * draw(0);
            let open = |node: usize| random.unit(round, node, 9) > wall * draw(1);
            let seed = |number: u32| {
                let node = (draw(10 + number) * 2370.0) as usize;
                // Two neighbours belong to one source.
                let pressure = if number < 2 { 1.0 } else { 0.5 + draw(20 + number) };
                Seed { node, source: number.max(1), pressure }
            };
            let mut seeds: Vec<Seed> = (0..4).map(seed).collect();
            seeds[1].node = seeds[0].node + 1;
            let most = largest_pressure(&seeds).unwrap();
            if let Some(distances) = straight_distances(&lattice, open, &seeds, most) {
                given += 1;
                let zones = pressure_zones(&lattice, open, &seeds).unwrap();
                assert_eq!(distances, zones.distance, "{round}");
            }
        }
        assert!((20..60).contains(&given), "{given} of 60");
    }

    /// Figure 5.3: the zone of the weaker of two sources is the disc of Apollonius.
    #[test]
    fn two_zones_meet_on_the_circle_of_apollonius() {
        let lattice =
            Lattice::plane([201, 201], 0.5, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let seed = |x, source, pressure| Seed { node: lattice.node([x, 100, 0]), source, pressure };
        let (weak, strong) = (seed(80, 0, 1.0), seed(120, 1, 2.0));
        let zones = pressure_zones(&lattice, |_| true, &[weak, strong]).unwrap();
        // Distances 2 : 1, sources 20 m apart: the radius is 2 / (2² - 1) of that.
        let radius = 20.0 * 2.0 / 3.0;
        let area = zones.owner.iter().filter(|&&owner| owner == 0).count() as f64 * 0.25;
        let disc = std::f64::consts::PI * radius * radius;
        assert!((area / disc - 1.0).abs() < 0.01, "{area} m2 for {disc} m2");
        let even = pressure_zones(&lattice, |_| true, &[weak, Seed { pressure: 1.0, ..strong }]);
        let west = even.unwrap().owner.iter().filter(|&&owner| owner == 0).count();
        // The line between belongs to the first that comes.
        assert!((100 * 201..=101 * 201).contains(&west));
    }

    #[test]
    fn zones_go_round_what_is_closed() {
        let lattice =
            Lattice::plane([9, 3], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let seed = Seed { node: lattice.node([0, 1, 0]), source: 0, pressure: 1.0 };
        let wall = |node: usize| lattice.coordinates(node)[0] != 4;
        let zones = pressure_zones(&lattice, wall, &[seed]).unwrap();
        assert_eq!(zones.owner[lattice.node([3, 1, 0])], 0);
        assert_eq!(zones.owner[lattice.node([5, 1, 0])], NO_SOURCE);
        assert_eq!(pressure_zones(&lattice, wall, &[]), Err(CaveError::NoSource));
        let outside = pressure_zones(&lattice, wall, &[Seed { node: 99, ..seed }]);
        assert!(matches!(outside, Err(CaveError::March(_))));
        assert!(pressure_zones(&lattice, wall, &[Seed { pressure: 0.0, ..seed }]).is_err());
    }
}
