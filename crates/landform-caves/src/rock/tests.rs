//! Rock where it is known what it must be.

use super::*;
use landform_graph::{Boundary, BreadthFirst, Connectivity, Reach};
use std::ops::ControlFlow;

fn block(size: [usize; 3], spacing: f64) -> Lattice {
    Lattice::volume(size, spacing, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap()
}

#[test]
fn level_planes_are_layers() {
    let lattice = block([6, 5, 12], 2.0);
    let planes = BeddingPlanes { heights_m: vec![4.0, 15.0], ..BeddingPlanes::default() };
    let porosity = planes.fill(&lattice).unwrap();
    for (node, porosity) in porosity.into_iter().enumerate() {
        let layer = lattice.coordinates(node)[2];
        // 15 m lies between two layers and belongs to one of them.
        let expected = if layer == 2 || layer == 8 { 0.3 } else { 0.0 };
        assert_eq!(porosity, expected, "layer {layer}");
    }
}

/// A plane of any dip is one connected sheet of about one voxel's thickness.
#[test]
fn inclined_planes_are_whole_and_thin() {
    let lattice = block([30, 30, 30], 1.0);
    for (dip_deg, dip_direction_deg) in [(20.0, 0.0), (35.0, 120.0), (60.0, -45.0), (90.0, 30.0)] {
        let planes = BeddingPlanes {
            heights_m: vec![14.5],
            dip_deg,
            dip_direction_deg,
            ..BeddingPlanes::default()
        };
        let porosity = planes.fill(&lattice).unwrap();
        let inside: Vec<usize> = (0..porosity.len()).filter(|&node| porosity[node] > 0.0).collect();
        let mut reached = 0;
        let filter = |_: usize, edge: &landform_graph::Edge| porosity[edge.node] > 0.0;
        BreadthFirst::new().search(&lattice, &inside[..1], Reach::UNLIMITED, filter, |_| {
            reached += 1;
            ControlFlow::<()>::Continue(())
        });
        assert_eq!(reached, inside.len(), "dip {dip_deg} is in pieces");
        let normal = across(dip_deg, dip_direction_deg);
        let expected = 900.0 / normal.abs().max_element();
        assert!((inside.len() as f64) < 1.5 * expected, "dip {dip_deg}: {} voxels", inside.len());
        // The plane goes down in its direction.
        let down = glam::DVec3::new(
            dip_direction_deg.to_radians().cos(),
            dip_direction_deg.to_radians().sin(),
            0.0,
        );
        let mean: f64 = inside
            .iter()
            .map(|&node| {
                let at = from_foot(&lattice, node);
                at.dot(down) * (at.z - 14.5)
            })
            .sum();
        assert!(mean < 0.0 || dip_deg == 90.0);
    }
}

#[test]
fn fractures_stand_at_their_distances() {
    let lattice = block([41, 9, 9], 1.0);
    let joints = FractureSet { spacing_m: 10.0, offset_m: 3.0, ..FractureSet::default() };
    let porosity = Fractures { sets: vec![joints] }.fill(&lattice, 1).unwrap();
    let columns: Vec<usize> =
        (0..41).filter(|&x| porosity[lattice.node([x, 4, 4])] > 0.0).collect();
    assert_eq!(columns, [3, 13, 23, 33]);
    let discs = FractureSet { extent_m: Some(2.0), ..joints };
    let discs = Fractures { sets: vec![discs] }.fill(&lattice, 1).unwrap();
    let count = |field: &[f64]| field.iter().filter(|value| **value > 0.0).count();
    assert!((0.3..0.95).contains(&(count(&discs) as f64 / count(&porosity) as f64)));
    assert!(discs.iter().zip(&porosity).all(|(disc, whole)| disc <= whole));
    let shifted = FractureSet { irregularity: 1.0, ..joints };
    let shifted = Fractures { sets: vec![shifted] }.fill(&lattice, 1).unwrap();
    assert!(shifted != porosity && count(&shifted) > 0);
}

#[test]
fn hard_regions_are_hardest_in_the_middle() {
    let lattice = block([21, 21, 21], 1.0);
    let ball = HardRegion { center: [0.5; 3], radius_m: 8.0 };
    let regions = HardRegions { regions: vec![ball], random: 0, core: 0.2, ..Default::default() };
    let factor = regions.fill(&lattice, 1).unwrap();
    let at = |x| factor[lattice.node([x, 10, 10])];
    assert_eq!([at(10), at(18), at(20)], [0.2, 1.0, 1.0]);
    assert!((at(14) - 0.6).abs() < 1e-12);
    let random = HardRegions { random: 5, ..regions.clone() };
    assert_eq!(random.fill(&lattice, 2), random.fill(&lattice, 2));
    assert!(random.fill(&lattice, 2) != random.fill(&lattice, 3));
    let refused = HardRegions { radius_m: (5.0, 4.0), ..regions };
    assert!(refused.fill(&lattice, 1).is_err());
}

#[test]
fn strata_lie_one_above_the_other() {
    let lattice = Lattice::plane([3, 10], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let stratum = |thickness_m, porosity| Stratum { thickness_m, porosity };
    let strata = Strata {
        strata: vec![stratum(3.0, 0.1), stratum(4.0, 0.2), stratum(1.0, 0.3)],
        ..Strata::default()
    };
    let porosity = strata.fill(&lattice).unwrap();
    // A plane is a section: the last row is the lowest.
    let column: Vec<f64> = (0..10).rev().map(|row| porosity[lattice.node([1, row, 0])]).collect();
    assert_eq!(column, [0.1, 0.1, 0.1, 0.2, 0.2, 0.2, 0.2, 0.3, 0.3, 0.3]);
}

#[test]
fn lines_are_whole_channels() {
    let lattice = block([21, 21, 21], 1.0);
    let lines = vec![vec![[0.1, 0.2, 1.0], [0.4, 0.9, 0.3], [0.9, 0.5, 0.0]]];
    let channel = ChannelLines { lines, ..ChannelLines::default() };
    let porosity = channel.fill(&lattice).unwrap();
    let inside: Vec<usize> = (0..porosity.len()).filter(|&node| porosity[node] > 0.0).collect();
    let filter = |_: usize, edge: &landform_graph::Edge| porosity[edge.node] > 0.0;
    let mut search = BreadthFirst::new();
    let reached = search.collect(&lattice, &inside[..1], Reach::UNLIMITED, filter).len();
    assert_eq!(reached, inside.len());
    assert!((25..120).contains(&inside.len()), "{} voxels", inside.len());
    let outside = ChannelLines { lines: vec![vec![[0.5, 0.5, 1.5]]], ..channel };
    assert!(outside.fill(&lattice).is_err());
}
