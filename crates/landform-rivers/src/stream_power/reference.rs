//! Everything by definition, over the neighbours of a lattice, for tests.

use landform_graph::Lattice;

use super::StreamPowerErosion;

/// The least level, over all ways from a node to an outlet, of the highest node of the way: by sweeps
/// until nothing changes.
pub(super) fn levels(lattice: &Lattice, heights: &[f64], outlets: &[usize]) -> Vec<f64> {
    let mut levels = vec![f64::INFINITY; heights.len()];
    outlets.iter().for_each(|&node| levels[node] = heights[node]);
    loop {
        let before = levels.clone();
        for node in (0..heights.len()).filter(|node| !outlets.contains(node)) {
            let lowest = lattice.neighbours(node).map(|edge| levels[edge.node]);
            let lowest = lowest.fold(f64::INFINITY, f64::min);
            levels[node] = levels[node].min(lowest.max(heights[node]));
        }
        if levels == before {
            return levels;
        }
    }
}

/// Direction of the steepest descent, the first of several; none where no neighbour is lower.
pub(super) fn steepest(lattice: &Lattice, heights: &[f64], node: usize) -> Option<u8> {
    let mut best = (0.0, None);
    for edge in lattice.neighbours(node) {
        let slope = (heights[node] - heights[edge.node]) * edge.distance.recip();
        if slope > best.0 {
            best = (slope, Some(edge.direction));
        }
    }
    best.1
}

/// Steps of each node over its level to a node with a lower neighbour or an outlet, by sweeps.
pub(super) fn steps_over_flats(lattice: &Lattice, levels: &[f64], outlets: &[usize]) -> Vec<usize> {
    let drained =
        |node: usize| outlets.contains(&node) || steepest(lattice, levels, node).is_some();
    let mut steps: Vec<usize> =
        (0..levels.len()).map(|node| if drained(node) { 0 } else { usize::MAX }).collect();
    loop {
        let before = steps.clone();
        for node in 0..levels.len() {
            let level = lattice.neighbours(node).filter(|edge| levels[edge.node] == levels[node]);
            let least = level.map(|edge| before[edge.node]).min().unwrap_or(usize::MAX);
            steps[node] = steps[node].min(least.saturating_add(1));
        }
        if steps == before {
            return steps;
        }
    }
}

/// Height above the node that takes the water at the end of a step, for a node that was `height` above
/// it: the root of `x + K A^m dt (x / d)^n = height` by bisection.
pub(super) fn remains(settings: &StreamPowerErosion, [height, area_m2, length_m]: [f64; 3]) -> f64 {
    let strength =
        settings.erodibility_m_per_yr * settings.step_yr * area_m2.powf(settings.area_exponent);
    let [mut low, mut high] = [0.0, height];
    for _ in 0..200 {
        let x = 0.5 * (low + high);
        let too_much = x + strength * (x / length_m).powf(settings.slope_exponent) > height;
        *(if too_much { &mut high } else { &mut low }) = x;
    }
    0.5 * (low + high)
}

/// A step of creep, node by node: `share` of the squared spacing, walls mirror.
pub(super) fn creep(lattice: &Lattice, heights: &[f64], fixed: &[usize], share: f64) -> Vec<f64> {
    const STEPS: [[isize; 2]; 8] =
        [[1, 0], [0, -1], [-1, 0], [0, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]];
    let [width, height] = [lattice.width() as isize, lattice.height() as isize];
    let along = |at: isize, axis: usize, size: isize| match lattice.is_periodic(axis) {
        true => at.rem_euclid(size),
        false => at.clamp(0, size - 1),
    };
    let after = |node: usize| {
        if fixed.contains(&node) {
            return heights[node];
        }
        let [x, y, _] = lattice.coordinates(node).map(|at| at as isize);
        let around = STEPS.map(|[east, south]| {
            let [x, y] = [along(x + east, 0, width), along(y + south, 1, height)];
            heights[(x + width * y) as usize]
        });
        heights[node] + share * crate::erosion::compact_laplacian(heights[node], &around)
    };
    (0..heights.len()).map(after).collect()
}
