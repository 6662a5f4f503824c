//! Terrain around the tree: hillslopes that rise from it.

use super::cell::Point;

/// How the ground rises from the tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hillslope {
    /// Tangent of the slope at the highest ground.
    pub steepest: f64,
    /// How soon slopes grow from the lowest ground to the highest; 0 for slopes alike.
    pub power: f64,
    /// Heights in metres of the lowest and the highest ground.
    pub relief: [f64; 2],
}

impl Hillslope {
    /// The level whose key points carry heights: three finer than the finest of the tree.
    pub fn level(levels: u32) -> u32 {
        levels + 2
    }

    /// Height at some distance from the tree, which has a height itself, all in metres (equations
    /// 4 and 7 of the paper).
    pub fn height(&self, distance: f64, tree: f64) -> f64 {
        let [low, high] = self.relief;
        let share = if high > low { ((tree - low) / (high - low)).clamp(0.0, 1.0) } else { 1.0 };
        let smooth = share * share * (3.0 - 2.0 * share);
        tree + self.steepest * smooth.powf(self.power) * distance
    }

    /// Weight of the height at a key point of level `level` for a point: `(1 - r^2)^3`, with the
    /// distance r in units of two cells (equation 6 of the paper).
    #[inline(always)]
    pub fn weight(level: u32, point: Point, key: Point) -> f64 {
        let scale = f64::from(1_u32 << level) / 2.0;
        let [east, north] = [0, 1].map(|axis| (point[axis] - key[axis]) * scale);
        let left = 1.0 - (east * east + north * north);
        let left = if left > 0.0 { left } else { 0.0 };
        left * left * left
    }
}
