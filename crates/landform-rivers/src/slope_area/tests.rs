//! Tests of the kernels: a plane with a known answer, a reference, what must hold at rest.

use landform_analysis::grid::Grid;
use landform_analysis::hydrology::{Depressions, FlowDirections};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{Generator, SpectralFbm};

use super::{Event, Pits, drain, unstable_sites};

/// A fractional Brownian surface on a square grid with 10 m cells.
fn fbm(side: usize, seed: u64) -> (Grid, Vec<f64>) {
    let lattice =
        Lattice::plane([side; 2], 10.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
    let surface = SpectralFbm { amplitude_m: 40.0, ..Default::default() };
    (Grid::new([side; 2], [10.0; 2]).unwrap(), surface.generate(&lattice, seed).unwrap())
}

/// An iteration; returns the number of its events.
fn iterate(grid: &Grid, heights: &mut [f64], pits: Pits, threshold_m: f64) -> usize {
    let (surface, directions) = drain(grid, heights, pits).unwrap();
    let cells = directions.contributing_cells();
    let events = unstable_sites(&surface, &directions, &cells, threshold_m);
    for &Event { site, height } in &events {
        assert!(height < heights[site], "sites are lowered only");
        heights[site] = height;
    }
    events.len()
}

/// Erodes until nothing happens.
fn rest(grid: &Grid, heights: &mut [f64], pits: Pits, threshold_m: f64) -> usize {
    let mut iterations = 0;
    while iterate(grid, heights, pits, threshold_m) > 0 {
        iterations += 1;
        assert!(iterations < 20_000, "the terrain does not come to rest");
    }
    iterations
}

/// A plane that falls to the west drains along its rows: the k-th site from the east drains k
/// cells, so its slope at rest is threshold / sqrt(k a), and heights are sums of those.
#[test]
fn a_steep_plane_comes_to_rest_at_the_slopes_of_the_threshold() {
    let [columns, rows] = [40, 5];
    for cell in [[10.0, 10.0], [4.0, 9.0]] {
        let grid = Grid::new([columns, rows], cell).unwrap();
        let mut heights: Vec<f64> =
            (0..columns * rows).map(|site| 30.0 * (site % columns) as f64).collect();
        rest(&grid, &mut heights, Pits::End, 2.0);
        for row in 0..rows {
            let mut expected = 0.0;
            for column in 0..columns {
                let found = heights[column + columns * row];
                assert!((found - expected).abs() < 1e-9, "{column} {row}: {found} {expected}");
                let area = (columns - column - 1) as f64 * grid.cell_area();
                expected += cell[0] * 2.0 / area.sqrt();
            }
        }
    }
}

/// The definition, site by site: slopes over all neighbours, areas by following all water.
fn by_definition(grid: &Grid, heights: &[f64], threshold_m: f64) -> Vec<Event> {
    let distance = |from: usize, to: usize| {
        let [a, b] = [from, to].map(|site| grid.position(site));
        let side = |axis: usize| a[axis].abs_diff(b[axis]) as f64 * grid.cell_size()[axis];
        side(0).hypot(side(1))
    };
    let slope = |from: usize, to: usize| (heights[from] - heights[to]) / distance(from, to);
    let next = |site: usize| {
        let lower = grid.neighbours(site).map(|(_, to)| to).filter(|&to| slope(site, to) > 0.0);
        lower.reduce(|best, to| if slope(site, to) > slope(site, best) { to } else { best })
    };
    let mut area = vec![0.0; heights.len()];
    for source in 0..heights.len() {
        let mut site = Some(source);
        while let Some(here) = site {
            area[here] += grid.cell_area();
            site = next(here);
        }
    }
    let event = |site: usize| {
        let to = next(site)?;
        let stress = area[site].sqrt() * slope(site, to);
        let height = heights[to] + distance(site, to) * threshold_m / area[site].sqrt();
        (stress > threshold_m).then_some(Event { site, height })
    };
    (0..heights.len()).filter_map(event).collect()
}

#[test]
fn the_kernel_finds_the_sites_of_the_definition() {
    let (grid, heights) = fbm(48, 3);
    for threshold_m in [0.5, 5.0, 20.0] {
        let directions = FlowDirections::steepest(&grid, &heights).unwrap();
        let cells = directions.contributing_cells();
        let found = unstable_sites(&heights, &directions, &cells, threshold_m);
        let expected = by_definition(&grid, &heights, threshold_m);
        assert!(!found.is_empty() && found.len() == expected.len(), "threshold {threshold_m}");
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found.site, expected.site);
            assert!((found.height - expected.height).abs() < 1e-9, "{found:?} {expected:?}");
        }
    }
}

/// Figure 4.25: rivers end in local minima, which keep their height.
#[test]
fn minima_keep_their_height_and_no_site_is_left_above_the_threshold() {
    let (grid, start) = fbm(64, 1);
    let mut heights = start.clone();
    rest(&grid, &mut heights, Pits::End, 1.0);
    let before = FlowDirections::steepest(&grid, &start).unwrap();
    let after = FlowDirections::steepest(&grid, &heights).unwrap();
    let pits = |directions: &FlowDirections| {
        (0..start.len()).filter(|&site| directions.receiver(site).is_none()).collect::<Vec<_>>()
    };
    let [first, last] = [pits(&before), pits(&after)];
    assert!(last.len() < first.len(), "rivers capture others: {} {}", last.len(), first.len());
    assert!(last.iter().all(|site| first.contains(site) && heights[*site] == start[*site]));
    assert!(by_definition(&grid, &heights, 1.0 + 1e-9).is_empty());
    assert!(heights.iter().zip(&start).all(|(after, before)| after <= before));
}

#[test]
fn lakes_drain_when_rivers_flow_on() {
    let (grid, start) = fbm(64, 2);
    let mut heights = start.clone();
    rest(&grid, &mut heights, Pits::Spill, 1.0);
    let [before, after] =
        [&start, &heights].map(|heights| Depressions::new(&grid, heights).unwrap());
    assert!(before.area_percent > 5.0 && after.area_percent < 0.5 * before.area_percent);
    let mut ended = start;
    rest(&grid, &mut ended, Pits::End, 1.0);
    let ended = Depressions::new(&grid, &ended).unwrap();
    assert!(after.area_percent < 0.5 * ended.area_percent, "{after:?} {ended:?}");
}
