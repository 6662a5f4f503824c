//! Listing 4.1 of the thesis line by line: for reading, and to test [`super::Fronts`] against.

use std::collections::VecDeque;

use landform_graph::Lattice;

use super::{FrontFields, FrontSettings};
use crate::coast::reference::{is_coast, shore_length, step};
use crate::coast::{CoastError, CoastSettings};

/// Erodes the land until no front is left, and gives the number of the last level set. Fields are
/// as for [`super::Fronts::new`]; regions of the settings keep their own force when fronts are
/// stuck.
///
/// # Errors
/// See [`step`].
pub fn level_sets(
    lattice: &Lattice,
    coast: &CoastSettings,
    settings: FrontSettings,
    fields: &mut FrontFields<'_>,
) -> Result<u32, CoastError> {
    let initial = (0..fields.land.len()).map(|node| shore_length(lattice, fields.land, node)).sum();
    // Lines 1 and 2: what the mask has taken, and the first fronts.
    fields.band.fill(0);
    for (on_level, land) in fields.on_level.iter_mut().zip(&*fields.land) {
        *on_level = u8::from(*land == 0);
    }
    let (mut level, mut force) = (0, coast.force);
    mark(lattice, fields, level);
    // Line 3.
    while (0..fields.land.len()).any(|node| is_coast(lattice, fields.land, node)) {
        // Line 4.
        let pressed = CoastSettings { force, ..coast.clone() };
        let fallen = step(lattice, &pressed, fields.land, fields.resistance, initial)?;
        pass(&fallen, fields, level);
        // Lines 5 and 6.
        let distances = distances(lattice, fields, level);
        let fronts = (0..fields.land.len()).filter(|&node| is_coast(lattice, fields.land, node));
        let fronts: Vec<usize> = fronts.collect();
        let furthest = fronts.iter().map(|&node| distances[node]).max();
        // Line 7.
        if furthest.is_some_and(|furthest| furthest > settings.threshold) {
            // Lines 8 and 9.
            let left: Vec<usize> =
                fronts.into_iter().filter(|&node| distances[node] == 0).collect();
            for &node in &left {
                fields.land[node] = 0;
                fields.resistance[node] = 0.0;
            }
            pass(&left, fields, level);
            level += 1;
            mark(lattice, fields, level);
            force = coast.force;
        } else if fallen.is_empty() {
            // Line 11.
            force *= 1.0 + settings.raise;
        }
    }
    Ok(level)
}

/// The fronts become a level set.
fn mark(lattice: &Lattice, fields: &mut FrontFields<'_>, level: u32) {
    for node in 0..fields.land.len() {
        if is_coast(lattice, fields.land, node) {
            fields.band[node] = level;
            fields.on_level[node] = 1;
        }
    }
}

/// Nodes that fell lie above the last level set, or on one.
fn pass(fallen: &[usize], fields: &mut FrontFields<'_>, level: u32) {
    for &node in fallen.iter().filter(|&&node| fields.on_level[node] == 0) {
        fields.band[node] = level;
    }
}

/// Edges from the last level set to every node, over nodes that fell since and the fronts.
fn distances(lattice: &Lattice, fields: &FrontFields<'_>, level: u32) -> Vec<u32> {
    let mut distances = vec![u32::MAX; fields.land.len()];
    let mut queue = VecDeque::new();
    for (node, distance) in distances.iter_mut().enumerate() {
        if fields.on_level[node] > 0 && fields.band[node] == level {
            *distance = 0;
            queue.push_back(node);
        }
    }
    while let Some(node) = queue.pop_front() {
        for edge in lattice.neighbours(node) {
            let fell = fields.land[edge.node] == 0 && fields.band[edge.node] == level;
            let open = fell || is_coast(lattice, fields.land, edge.node);
            if open && distances[edge.node] == u32::MAX {
                distances[edge.node] = distances[node] + 1;
                queue.push_back(edge.node);
            }
        }
    }
    distances
}

#[cfg(test)]
mod tests {
    use super::super::Fronts;
    use super::super::testing::Terrain;
    use super::*;
    use crate::coast::Perimeter;
    use landform_graph::{Boundary, Connectivity};

    /// The same level sets on any lattice, for every perimeter and many thresholds, forces and
    /// patterns of sea, to the last node.
    #[test]
    fn fronts_leave_the_level_sets_of_the_listing() {
        let kinds = [Connectivity::FourEight, Connectivity::Four, Connectivity::Eight];
        let boundaries = [[Boundary::Open; 2], [Boundary::Periodic, Boundary::Open]];
        let radius_m = 7.0;
        let perimeters =
            [Perimeter::Whole, Perimeter::Near { radius_m }, Perimeter::Contiguous { radius_m }];
        let mut most_levels = 0;
        for case in 0..54 {
            let (kind, perimeter) = (kinds[case % 3], perimeters[case / 3 % 3]);
            let lattice = Lattice::plane([18, 14], 2.0, kind, boundaries[case % 2]).unwrap();
            let force = 0.2 + 0.1 * (case / 9) as f64;
            let coast = CoastSettings { force, attenuation: 0.2, perimeter, ..Default::default() };
            let raise = 0.02 * (1 + case / 9) as f64;
            let settings = FrontSettings { threshold: 1 + case as u32 % 5, raise };
            let [mut fast, mut literal] = [(); 2].map(|()| Terrain::new(&lattice, case as u64));
            let last = level_sets(&lattice, &coast, settings, &mut literal.fields()).unwrap();
            let mut fronts = Fronts::new(&lattice, coast, settings, &mut fast.fields()).unwrap();
            while fronts.step(&mut fast.fields(), |_, _| {}).unwrap() {}
            assert_eq!(fronts.record().level, last, "case {case}");
            assert_eq!(fast, literal, "case {case}");
            most_levels = most_levels.max(last);
        }
        assert!(most_levels >= 5, "{most_levels}");
    }
}
