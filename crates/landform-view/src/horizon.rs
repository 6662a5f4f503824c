//! How much of the sun and of the sky each node of a surface sees.

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
    let reach = (surface.highest - own) / lowest;
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
    if !surface.periodic && !(inside(column, surface.columns) && inside(row, surface.rows)) {
        return None;
    }
    let (west, north) = (column.floor(), row.floor());
    let (x, y) = (column - west, row - north);
    let (west, north) = (west as isize, north as isize);
    let top = surface.at(west, north) * (1.0 - x) + surface.at(west + 1, north) * x;
    let bottom = surface.at(west, north + 1) * (1.0 - x) + surface.at(west + 1, north + 1) * x;
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
        if !inside && !surface.periodic {
            break;
        }
        steepest = steepest.max((surface.at(x, y) - own) * probe.inverse);
    }
    steepest / surface.spacing as f32
}

/// View factor of one direction over the cosine of the slope: `rise` is the tangent of the
/// horizon's elevation and `towards` the slope of the ground in that direction.
fn view_share(rise: f32, towards: f32) -> f32 {
    let zenith = std::f32::consts::FRAC_PI_2 - rise.atan();
    let (sin, cos) = zenith.sin_cos();
    sin * sin - towards * (zenith - sin * cos)
}
