//! Gradient noise in space, for textures.

use glam::DVec3;

/// Directions to the middles of a cube's edges, four of them twice.
const GRADIENTS: [[f64; 3]; 16] = [
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 1.0],
    [0.0, -1.0, -1.0],
];

/// Perlin's noise with cubes of side 1 (Perlin 2002, "Improving noise"): about -1 to 1, 0 at the
/// corners of the cubes. Another `kind` is another noise.
pub(super) fn noise(kind: u32, place: DVec3) -> f64 {
    let cell = place.floor();
    let offset = place - cell;
    let fade = offset * offset * offset * (offset * (offset * 6.0 - 15.0) + 10.0);
    let mut sum = 0.0;
    for number in 0..8_u32 {
        let step = [number & 1, number >> 1 & 1, number >> 2];
        let at = [0, 1, 2].map(|axis| (cell[axis] as i64 + i64::from(step[axis])) as u32);
        let away = offset - DVec3::from_array(step.map(f64::from));
        let plane = DVec3::from_array(GRADIENTS[(hash(kind, at) >> 28) as usize]).dot(away);
        let weight = |axis: usize| if step[axis] == 1 { fade[axis] } else { 1.0 - fade[axis] };
        sum += weight(0) * weight(1) * weight(2) * plane;
    }
    sum
}

/// A sum of octaves of noise, each of half the amplitude and half the wavelength of the one before.
pub(super) fn octaves(kind: u32, place: DVec3, count: u32) -> f64 {
    let octave = |number: u32| {
        let scale = f64::from(1_u32 << number);
        noise(kind.wrapping_add(number.wrapping_mul(0x9E37)), place * scale) / scale
    };
    (0..count).map(octave).sum()
}

/// A number of a corner that looks random.
fn hash(kind: u32, [x, y, z]: [u32; 3]) -> u32 {
    let mut bits = kind.wrapping_mul(0x27D4_EB2F)
        ^ x.wrapping_mul(0x9E37_79B1)
        ^ y.wrapping_mul(0x85EB_CA77)
        ^ z.wrapping_mul(0xC2B2_AE3D);
    for (shift, factor) in [(15, 0x2C1B_3C6D), (12, 0x297A_2D39)] {
        bits = (bits ^ bits >> shift).wrapping_mul(factor);
    }
    bits ^ bits >> 15
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0 at corners; no value beyond 1.04, the largest of Perlin's noise; and it changes as little
    /// over a short way as a smooth function does.
    #[test]
    fn noise_is_smooth_and_bounded_and_varies() {
        let mut values = Vec::new();
        for step in 0..40_000 {
            let along = f64::from(step) * 0.01;
            let place = DVec3::new(along, 0.37 * along - 50.0, 7.0 - 0.21 * along);
            values.push(noise(3, place));
        }
        assert!(values.iter().all(|value| value.abs() < 1.04));
        assert!(values.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.03));
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let variance = values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64;
        assert!(mean.abs() < 0.03 && (0.04..0.12).contains(&variance), "{mean} {variance}");
        assert_eq!(noise(3, DVec3::new(-4.0, 17.0, 2.0)), 0.0);
        assert_ne!(noise(3, DVec3::splat(0.4)), noise(4, DVec3::splat(0.4)));
    }
}
