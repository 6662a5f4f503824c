//! How much of the sun and of the sky each node of a surface sees.
//!
//! Both are horizons: the steepest rise of the terrain in a direction. Towards the sun every node
//! on the way counts and the result decides sharp shadows; of the sky sixteen directions and a
//! few distances are enough, because its light changes slowly from node to node. The sky is
//! probed to ninety nodes of the surface, so only what is near takes light away.

use rayon::prelude::*;

use crate::light::{Light, smooth_step};
use crate::surface::Surface;

/// Number of directions in which the sky is probed.
const SKY_DIRECTIONS: usize = 16;

/// Distances, in nodes, at which the horizon of the sky is probed.
const SKY_DISTANCES: [f64; 11] = [1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 18.0, 27.0, 40.0, 60.0, 90.0];

/// Share of the sun's disc that each node sees over the terrain towards it, from 0 to 1.
///
/// Each node looks along the ground towards the sun, one node spacing at a time, and keeps the
/// steepest rise; the disc is as high as twice the penumbra.
pub(crate) fn sun_visibility(surface: &Surface, light: &Light) -> Vec<f32> {
    let (sin, cos) = light.bearing_deg.to_radians().sin_cos();
    let altitude = light.altitude_deg.to_radians() as f32;
    let penumbra = (light.penumbra_deg.max(0.05).to_radians() as f32).min(0.9 * altitude);
    let lowest = (altitude - penumbra).tan() * surface.spacing as f32;
    let mut seen = vec![1.0; surface.columns * surface.rows];
    seen.par_chunks_mut(surface.columns).enumerate().for_each(|(row, line)| {
        for (column, seen) in line.iter_mut().enumerate() {
            let rise = steepest_rise(surface, [column, row], [sin as f32, -cos as f32], lowest);
            let horizon = (rise / surface.spacing as f32).atan();
            *seen = smooth_step(-penumbra, penumbra, altitude - horizon);
        }
    });
    seen
}

/// Steepest rise per node spacing from a node along a direction, looking only for rises of at
/// least `lowest`.
fn steepest_rise(surface: &Surface, node: [usize; 2], step: [f32; 2], lowest: f32) -> f32 {
    let own = surface.heights[node[0] + surface.columns * node[1]];
    // Endless ground is looked over for its own length at most.
    let reach = ((surface.highest - own) / lowest).min((surface.columns + surface.rows) as f32);
    let mut rise = lowest * 0.999;
    let mut distance = 1.0;
    while distance <= reach && rise * distance <= surface.highest - own {
        let column = node[0] as f32 + step[0] * distance;
        let row = node[1] as f32 + step[1] * distance;
        let Some(height) = interpolate(surface, column, row) else { break };
        rise = rise.max((height - own) / distance);
        distance += 1.0;
    }
    rise
}

/// Height between nodes, bilinear; nothing beyond open edges.
fn interpolate(surface: &Surface, column: f32, row: f32) -> Option<f32> {
    let inside = |place: f32, size: usize| place >= 0.0 && place <= (size - 1) as f32;
    let known = inside(column, surface.columns) && inside(row, surface.rows);
    if !(known || surface.periodic) {
        return None;
    }
    let (west, north) = (column.floor(), row.floor());
    let (x, y) = (column - west, row - north);
    let [a, b, c, d] = surface.corners(west as isize, north as isize);
    let (top, bottom) = (a * (1.0 - x) + b * x, c * (1.0 - x) + d * x);
    Some(top * (1.0 - y) + bottom * y)
}

/// Share of the sky's light that each node receives, from 0 to 1, counted over the hemisphere
/// with the cosine to the slope's normal: 1 on a plain, 1/2 at the foot of a high wall.
///
/// The horizon angles of sixteen directions enter the view factor of Dozier and Frew (1990,
/// "Rapid calculation of terrain parameters for radiation modeling from digital elevation
/// data", IEEE Transactions on Geoscience and Remote Sensing 28, equation 7b).
pub(crate) fn sky_view(surface: &Surface) -> Vec<f32> {
    let probes: Vec<Vec<Probe>> = (0..SKY_DIRECTIONS).map(probes).collect();
    let mut seen = vec![1.0; surface.columns * surface.rows];
    seen.par_chunks_mut(surface.columns).enumerate().for_each(|(row, line)| {
        for (column, seen) in line.iter_mut().enumerate() {
            let [east, north] = surface.slope(column, row);
            let sum: f32 = probes
                .iter()
                .map(|probes| {
                    let towards = east * probes[0].east + north * probes[0].north;
                    let rise = probed_rise(surface, [column, row], probes).max(towards).max(0.0);
                    view_share(rise, towards)
                })
                .sum();
            let upright = 1.0 / (1.0 + east * east + north * north).sqrt();
            *seen = (upright * sum / SKY_DIRECTIONS as f32).clamp(0.0, 1.0);
        }
    });
    seen
}

/// A node to look at from another one.
struct Probe {
    column: isize,
    row: isize,
    /// One over the distance in nodes.
    inverse: f32,
    east: f32,
    north: f32,
}

/// The nodes to look at in one of the sky's directions, from near to far. They lie at whole
/// columns and rows, with their true distances, so that no height is interpolated.
fn probes(direction: usize) -> Vec<Probe> {
    let angle = (direction as f64 + 0.5) / SKY_DIRECTIONS as f64 * std::f64::consts::TAU;
    let (sin, cos) = angle.sin_cos();
    let probe = |&distance: &f64| {
        let (column, row) = ((cos * distance).round(), (-sin * distance).round());
        Probe {
            column: column as isize,
            row: row as isize,
            inverse: 1.0 / column.hypot(row) as f32,
            east: cos as f32,
            north: sin as f32,
        }
    };
    SKY_DISTANCES.iter().map(probe).collect()
}

/// Steepest rise, as a slope, from a node to its probes.
fn probed_rise(surface: &Surface, [column, row]: [usize; 2], probes: &[Probe]) -> f32 {
    let own = surface.heights[column + surface.columns * row];
    let mut steepest = f32::NEG_INFINITY;
    for probe in probes {
        let (x, y) = (column as isize + probe.column, row as isize + probe.row);
        let inside =
            x >= 0 && y >= 0 && (x as usize) < surface.columns && (y as usize) < surface.rows;
        let height = match inside {
            true => surface.heights[x as usize + surface.columns * y as usize],
            false if surface.periodic => surface.at(x, y),
            false => break,
        };
        steepest = steepest.max((height - own) * probe.inverse);
    }
    steepest / surface.spacing as f32
}

/// View factor of one direction over the cosine of the slope: `rise` is the tangent of the
/// horizon's elevation and `towards` the slope of the ground in that direction.
fn view_share(rise: f32, towards: f32) -> f32 {
    // Sine and cosine of the horizon's zenith angle from the tangent of its elevation.
    let sin = 1.0 / (1.0 + rise * rise).sqrt();
    let cos = rise * sin;
    let zenith = std::f32::consts::FRAC_PI_2 - rise.atan();
    sin * sin - towards * (zenith - sin * cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::HeightField;
    use crate::surface::Sampling;

    fn surface(size: usize, periodic: bool, height: impl Fn(f64, f64) -> f64) -> Surface {
        let heights: Vec<f64> =
            (0..size * size).map(|i| height((i % size) as f64, (i / size) as f64)).collect();
        let field = HeightField::new(size, size, 2.0, &heights).unwrap();
        let (origin, step, smoothing, exaggeration) = (0.0, 1.0, 0.0, 1.0);
        let size = [size, size];
        let sampling = Sampling { size, origin, step, periodic, smoothing, exaggeration };
        Surface::sample(&field, sampling).unwrap()
    }

    fn sun(bearing_deg: f64, altitude_deg: f64) -> Light {
        Light { bearing_deg, altitude_deg, penumbra_deg: 0.05, ..Light::map() }
    }

    /// The shadow of a cone of height h ends h / tan(altitude) from its axis.
    #[test]
    fn a_cone_throws_the_shadow_of_its_height() {
        let size = 121;
        let cone = |x: f64, y: f64| (30.0 - 2.0 * (x - 40.0).hypot(y - 60.0)).max(0.0);
        let surface = surface(size, false, cone);
        for altitude in [15.0_f64, 30.0] {
            let seen = sun_visibility(&surface, &sun(270.0, altitude));
            let row = &seen[60 * size..61 * size];
            let end = (42..size).find(|&column| row[column] > 0.5).unwrap() as f64;
            let expected = 40.0 + 30.0 / altitude.to_radians().tan() / 2.0;
            assert!((end - expected).abs() <= 1.0, "{altitude}: {end} instead of {expected}");
            assert!(row[..39].iter().all(|&seen| seen > 0.99), "the sunny side is lit");
        }
    }

    /// The march that gives up early against one that looks at everything.
    #[test]
    fn looking_only_as_far_as_needed_changes_nothing() {
        let hills = |x: f64, y: f64| 9.0 * ((x / 5.0).sin() + (y / 7.0).cos() * (x / 11.0).cos());
        let surface = surface(60, false, hills);
        let (step, lowest) = ([0.6, -0.8], 0.3);
        for node in 0..3600 {
            let (column, row) = (node % 60, node / 60);
            let own = surface.heights[node];
            let rises = (1..90).map_while(|distance| {
                let distance = distance as f32;
                let place = [column as f32 + step[0] * distance, row as f32 + step[1] * distance];
                Some((interpolate(&surface, place[0], place[1])? - own) / distance)
            });
            let full = rises.fold(lowest * 0.999, f32::max);
            assert_eq!(steepest_rise(&surface, [column, row], step, lowest), full, "node {node}");
        }
    }

    #[test]
    fn a_plain_sees_the_whole_sky_and_a_ramp_the_cosine_share() {
        assert!(sky_view(&surface(40, true, |_, _| 7.0)).iter().all(|&seen| seen == 1.0));
        // The upper hemisphere seen from an endless slope: (1 + cos) / 2.
        let ramp = surface(300, false, |x, _| 2.0 * x);
        let expected = (1.0 + 45_f32.to_radians().cos()) / 2.0;
        let seen = sky_view(&ramp)[150 + 300 * 150];
        assert!((seen - expected).abs() < 0.01, "{seen} instead of {expected}");
    }

    #[test]
    fn the_foot_of_a_high_wall_sees_half_of_the_sky() {
        let wall = surface(300, false, |x, _| if x < 150.0 { 0.0 } else { 4e4 });
        let seen = sky_view(&wall)[148 + 300 * 150];
        assert!((seen - 0.5).abs() < 0.01, "{seen}");
    }

    /// A field that repeats casts its shadows over the seam.
    #[test]
    fn shadows_continue_at_the_other_side() {
        let ridge = |x: f64, _: f64| if x > 56.0 { 10.0 } else { 0.0 };
        let (open, closed) = (surface(60, false, ridge), surface(60, true, ridge));
        let light = sun(270.0, 30.0);
        assert!(sun_visibility(&open, &light)[2 + 60 * 30] > 0.99);
        assert!(sun_visibility(&closed, &light)[2 + 60 * 30] < 0.01);
    }
}
