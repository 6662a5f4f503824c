//! Landforms blended by their weights.

use super::Bounds;
use super::bounds::times;
use super::region::Region;
use super::surface::{Samples, Surface};

/// The weighted mean of several surfaces.
#[derive(Debug)]
pub(super) struct BlendSurface {
    /// One or more.
    pub children: Vec<Box<dyn Surface>>,
}

impl BlendSurface {
    /// The children that have weight in a region.
    fn within(&self, region: &Region) -> impl Iterator<Item = &dyn Surface> {
        let meets = |child: &&dyn Surface| !child.support().intersection(region).is_empty();
        self.children.iter().map(|child| &**child).filter(meets)
    }
}

impl Surface for BlendSurface {
    fn sample(&self, points: &[[f64; 2]]) -> Samples {
        let mut total = Samples::none(points.len());
        for child in &self.children {
            let child = child.sample(points);
            for (number, (&height, &weight)) in
                child.elevation.iter().zip(&child.weight).enumerate()
            {
                total.elevation[number] += weight * height;
                total.weight[number] += weight;
            }
        }
        for (height, &weight) in total.elevation.iter_mut().zip(&total.weight) {
            // The mean of nothing is 0.
            *height = if weight > 0.0 { *height / weight } else { 0.0 };
        }
        total
    }

    fn support(&self) -> Region {
        let mut supports = self.children.iter().map(|child| child.support());
        let first = supports.next().unwrap_or(Region::EVERYWHERE);
        supports.fold(first, |hull, support| hull.hull(&support))
    }

    fn range(&self, region: &Region) -> [f64; 2] {
        hull(self.within(region).map(|child| child.range(region)))
    }

    fn bounds(&self, region: &Region) -> Bounds {
        let children: Vec<Bounds> = self.within(region).map(|child| child.bounds(region)).collect();
        if children.is_empty() { Bounds::NOTHING } else { blended(&children) }
    }
}

/// The range that holds all of several.
fn hull(ranges: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let joined = |[low, high]: [f64; 2], range: [f64; 2]| [low.min(range[0]), high.max(range[1])];
    ranges.reduce(joined).unwrap_or_default()
}

/// Bounds of a blend. The slope of `sum(a h) / sum(a)` has two parts: the mean of the slopes,
/// and `sum((h_i - h) grad a_i) / a`, the change from one surface to another.
fn blended(children: &[Bounds]) -> Bounds {
    let sum = |of: &dyn Fn(&Bounds) -> f64| children.iter().map(of).sum::<f64>();
    let most = |of: &dyn Fn(&Bounds) -> f64| children.iter().map(of).fold(0.0, f64::max);
    let [low, high] = hull(children.iter().map(|child| child.elevation_m));
    let weight = [0, 1].map(|end| sum(&|child| child.weight[end]));
    let weight_slope = sum(&|child| child.weight_slope);

    let difference = |child: &Bounds| (child.elevation_m[1] - low).max(high - child.elevation_m[0]);
    let one_by_one = sum(&|child| times(difference(child), child.weight_slope));
    // The differences of n numbers from their mean add up to n - 1 times their spread at most.
    let spread = (children.len() as f64 - 1.0) * most(&|child| child.weight_slope);
    let change = one_by_one.min(times(spread, high - low));

    let steepest = most(&|child| child.slope);
    // Weights above 1 count more than the faded slope knows.
    let faded = sum(&|child| times(child.weight[1].max(1.0), child.faded_slope));
    let slope = match weight[0] {
        0.0 if change == 0.0 => steepest,
        0.0 => f64::INFINITY,
        least => steepest.min(faded / least) + change / least,
    };
    let faded_change = change * (1.0 / weight[0]).min(1.0);
    let faded_slope = times(steepest, weight[1].min(1.0)).min(faded) + faded_change;
    Bounds {
        elevation_m: [low, high],
        weight,
        slope,
        faded_slope: faded_slope.min(times(slope, weight[1].min(1.0))),
        weight_slope,
    }
}
