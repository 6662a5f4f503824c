//! Heights along a line, and the areas below and above them.

/// Heights of the ground and levels of the water along a line, NaN where there are none.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Profile {
    /// Distances from the beginning, in metres.
    pub distances_m: Vec<f64>,
    /// Heights of the ground.
    pub heights_m: Vec<f64>,
    /// Heights of the water's surface, below the ground beside a shore.
    pub levels_m: Vec<f64>,
}

impl Profile {
    /// The profile between two places, columns and rows of a grid of nodes, about a point a node.
    /// Between nodes, values are interpolated bilinearly; a line along a row or a column takes those
    /// of the nodes as they are. `values` and `levels` hold one a node.
    pub fn along(
        [from, to]: [[f64; 2]; 2],
        size: [usize; 2],
        spacing_m: f64,
        values: &[f64],
        levels: Option<&[f64]>,
    ) -> Self {
        let way = [to[0] - from[0], to[1] - from[1]];
        let steps = (way[0].abs().max(way[1].abs()).round() as usize).max(1);
        let length_m = way[0].hypot(way[1]) * spacing_m;
        let share = |step: usize| step as f64 / steps as f64;
        let at = |step: usize| [0, 1].map(|axis| from[axis] + share(step) * way[axis]);
        let sample = |values: &[f64]| -> Vec<f64> {
            (0..=steps).map(|step| interpolated(values, size, at(step))).collect()
        };
        Self {
            distances_m: (0..=steps).map(|step| share(step) * length_m).collect(),
            heights_m: sample(values),
            levels_m: levels.map_or_else(|| vec![f64::NAN; steps + 1], sample),
        }
    }

    /// Length of the line.
    pub fn length_m(&self) -> f64 {
        self.distances_m.last().copied().unwrap_or_default()
    }

    /// Lowest and highest of ground and water, with a margin; something sensible for level ground.
    pub fn range(&self) -> [f64; 2] {
        /// Share of the range that is left free at either end.
        const MARGIN: f64 = 0.08;
        let water =
            self.levels_m.iter().zip(&self.heights_m).filter(|(level, ground)| level > ground);
        let all = self.heights_m.iter().chain(water.map(|(level, _)| level));
        let known = all.filter(|height| !height.is_nan());
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = known.fold(start, |[low, high], &at| [low.min(at), high.max(at)]);
        if low > high {
            return [0.0, 1.0];
        }
        let margin = (MARGIN * (high - low)).max(1e-3 * self.length_m());
        [low - margin, high + margin]
    }
}

/// The value at a column and a row, between the four nodes around it; NaN where one of those that
/// count has none.
fn interpolated(values: &[f64], [width, height]: [usize; 2], [column, row]: [f64; 2]) -> f64 {
    let corner = |at: f64, size: usize| {
        let first = (at.floor().max(0.0) as usize).min(size - 1);
        [(first, 1.0 - (at - first as f64)), ((first + 1).min(size - 1), at - first as f64)]
    };
    let mut sum = 0.0;
    for (y, down) in corner(row, height) {
        for (x, across) in corner(column, width) {
            // A node without weight may have no value.
            if across * down > 0.0 {
                sum += across * down * values[x + width * y];
            }
        }
    }
    sum
}

/// The ground down to `floor_m`, as polygons of distance and height: one for each piece of the line
/// that has data.
pub(super) fn ground_areas(profile: &Profile, floor_m: f64) -> Vec<Vec<[f64; 2]>> {
    let points: Vec<[f64; 2]> =
        profile.distances_m.iter().zip(&profile.heights_m).map(|(&x, &z)| [x, z]).collect();
    let pieces = points.split(|[_, height]| height.is_nan()).filter(|piece| piece.len() > 1);
    let area = |piece: &[[f64; 2]]| {
        let ends = [piece[piece.len() - 1][0], piece[0][0]].map(|x| [x, floor_m]);
        piece.iter().copied().chain(ends).collect()
    };
    pieces.map(area).collect()
}

/// The water between the ground and its surface, as polygons: one for each piece of the line under
/// water, from shore to shore.
pub(super) fn water_areas(profile: &Profile) -> Vec<Vec<[f64; 2]>> {
    let points = with_shores(profile);
    let wet = |point: &[f64; 3]| point[2] >= point[1];
    let pieces = points.chunk_by(|a, b| wet(a) && wet(b));
    let deep = |piece: &&[[f64; 3]]| piece.iter().any(|point| point[2] > point[1]);
    let area = |piece: &[[f64; 3]]| {
        let surface = piece.iter().map(|&[x, _, level]| [x, level]);
        let ground = piece.iter().rev().map(|&[x, height, _]| [x, height]);
        surface.chain(ground).collect()
    };
    pieces.filter(|piece| piece.len() > 1).filter(deep).map(area).collect()
}

/// Distance, ground and water level of the points of a profile, and of the shores between them,
/// where both heights are the same.
fn with_shores(profile: &Profile) -> Vec<[f64; 3]> {
    let Profile { distances_m, heights_m, levels_m } = profile;
    let point = |index: usize| [distances_m[index], heights_m[index], levels_m[index]];
    let mut points = Vec::with_capacity(distances_m.len());
    for index in 0..distances_m.len() {
        if let Some(before) = index.checked_sub(1).map(point) {
            let here = point(index);
            let [depth_before, depth] = [before, here].map(|[_, height, level]| level - height);
            if depth_before * depth < 0.0 {
                let share = depth_before / (depth_before - depth);
                let between = |axis: usize| before[axis] + share * (here[axis] - before[axis]);
                points.push([between(0), between(1), between(1)]);
            }
        }
        points.push(point(index));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 5 x 3 nodes, 10 m apart: a valley between 4 m and 8 m with a lake at 2 m.
    fn valley() -> ([f64; 15], [f64; 15]) {
        let (none, row) = (f64::NAN, [4.0, 0.0, 0.0, 4.0, 8.0]);
        let levels = [2.0, 2.0, 2.0, 2.0, none];
        (
            std::array::from_fn(|node| row[node % 5] + (node / 5) as f64),
            std::array::from_fn(|node| levels[node % 5]),
        )
    }

    #[test]
    fn a_line_along_a_row_takes_its_nodes() {
        let (heights, levels) = valley();
        let ends = [[0.0, 1.0], [4.0, 1.0]];
        let profile = Profile::along(ends, [5, 3], 10.0, &heights, Some(&levels));
        assert_eq!(profile.distances_m, [0.0, 10.0, 20.0, 30.0, 40.0]);
        assert_eq!(profile.heights_m, heights[5..10]);
        assert_eq!(profile.levels_m[..4], levels[5..9]);
        assert!(profile.levels_m[4].is_nan());
        let [low, high] = profile.range();
        assert!(low < 1.0 && high > 9.0);
    }

    #[test]
    fn a_slanting_line_lies_on_a_plane() {
        // Twice the column and three times the row.
        let plane: Vec<f64> =
            (0..20).map(|n| 2.0 * (n % 5) as f64 + 3.0 * (n / 5) as f64).collect();
        let profile = Profile::along([[0.5, 3.0], [4.0, 0.25]], [5, 4], 2.0, &plane, None);
        assert_eq!(profile.heights_m.len(), 5);
        for (step, height) in profile.heights_m.iter().enumerate() {
            let share = step as f64 / 4.0;
            let expected = 2.0 * (0.5 + 3.5 * share) + 3.0 * (3.0 - 2.75 * share);
            assert!((height - expected).abs() < 1e-12, "{height}, not {expected}");
        }
        assert!((profile.length_m() - 2.0 * 3.5_f64.hypot(2.75)).abs() < 1e-12);
        assert!(profile.levels_m.iter().all(|level| level.is_nan()));
    }

    #[test]
    fn a_lake_lies_between_its_shores() {
        let (heights, levels) = valley();
        let profile =
            Profile::along([[0.0, 0.0], [4.0, 0.0]], [5, 3], 10.0, &heights, Some(&levels));
        let lakes = water_areas(&profile);
        // Its shores lie half-way between 4 m and 0 m.
        let expected = [[5.0, 2.0], [10.0, 2.0], [20.0, 2.0], [25.0, 2.0]];
        assert_eq!(lakes.len(), 1);
        assert_eq!(lakes[0][..4], expected);
        assert_eq!(lakes[0][4..], [[25.0, 2.0], [20.0, 0.0], [10.0, 0.0], [5.0, 2.0]]);
        assert_eq!(ground_areas(&profile, -1.0)[0].len(), 5 + 2);
    }

    #[test]
    fn missing_ground_parts_the_line() {
        let mut heights = [1.0; 7];
        heights[3] = f64::NAN;
        let profile = Profile::along([[0.0, 0.0], [6.0, 0.0]], [7, 1], 1.0, &heights, None);
        let areas = ground_areas(&profile, 0.0);
        assert_eq!(areas.len(), 2);
        assert_eq!(areas[1], [[4.0, 1.0], [5.0, 1.0], [6.0, 1.0], [6.0, 0.0], [4.0, 0.0]]);
        assert!(water_areas(&profile).is_empty());
    }
}
