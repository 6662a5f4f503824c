//! Random walks outside of an aggregate: directions, and returns from far away.

use std::f64::consts::{PI, TAU};

use landform_sim::random::NodeRandom;
use rand::RngExt;

/// A random direction.
#[inline]
pub(super) fn direction<const D: usize>(random: &mut NodeRandom) -> [f64; D] {
    let (sine, cosine) = (TAU * unit(random)).sin_cos();
    let mut direction = [0.0; D];
    // In 2-D a direction is an angle, in 3-D a height is evenly spread over the sphere.
    let flat = match D {
        3 => {
            let up = 2.0 * unit(random) - 1.0;
            direction[D - 1] = up;
            (1.0 - up * up).sqrt()
        }
        _ => 1.0,
    };
    direction[0] = flat * cosine;
    direction[1] = flat * sine;
    direction
}

/// A number in (0, 1), of 32 random bits.
#[inline]
fn unit(random: &mut NodeRandom) -> f64 {
    (f64::from(random.random::<u32>()) + 0.5) / 4_294_967_296.0
}

/// Where a walker far from a circle or sphere of some radius around the origin meets it: exact, by
/// the Poisson kernel. In 3-D it may never come back: none.
pub(super) fn return_to_sphere<const D: usize>(
    place: [f64; D],
    radius: f64,
    random: &mut NodeRandom,
) -> Option<[f64; D]> {
    let far = place.iter().map(|x| x * x).sum::<f64>().sqrt();
    let cosine = match D {
        3 => {
            if unit(random) * far > radius {
                return None;
            }
            // Where it meets, the reciprocal of its way is evenly spread.
            let [least, most] = [1.0 / (far + radius), 1.0 / (far - radius)];
            let way = 1.0 / (least + unit(random) * (most - least));
            ((far * far + radius * radius - way * way) / (2.0 * far * radius)).clamp(-1.0, 1.0)
        }
        _ => {
            let spread = (far - radius) / (far + radius);
            let half = (spread * (PI * (unit(random) - 0.5)).tan()).atan();
            let [x, y] = [place[0], place[1]].map(|x| x / far * radius);
            let (sine, cosine) = (2.0 * half).sin_cos();
            let mut met = [0.0; D];
            met[0] = x * cosine - y * sine;
            met[1] = x * sine + y * cosine;
            return Some(met);
        }
    };
    let axis: [f64; D] = place.map(|x| x / far);
    let across = across(axis, random);
    let sine = (1.0 - cosine * cosine).sqrt();
    Some(std::array::from_fn(|n| radius * (cosine * axis[n] + sine * across[n])))
}

/// A random direction across an axis.
fn across<const D: usize>(axis: [f64; D], random: &mut NodeRandom) -> [f64; D] {
    loop {
        let trial = direction::<D>(random);
        let along: f64 = (0..D).map(|n| trial[n] * axis[n]).sum();
        let rest: [f64; D] = std::array::from_fn(|n| trial[n] - along * axis[n]);
        let length = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 1e-3 {
            return rest.map(|x| x / length);
        }
    }
}

/// Where a walker at some height above a line (2-D) or plane (3-D), which lies across the last axis,
/// meets it: exact, by the Poisson kernel of the half-space. `fall` is the height above it.
pub(super) fn return_to_floor<const D: usize>(
    mut place: [f64; D],
    fall: f64,
    random: &mut NodeRandom,
) -> [f64; D] {
    place[D - 1] -= fall;
    match D {
        3 => {
            let rest = 1.0 - unit(random);
            let way = fall * (1.0 / (rest * rest) - 1.0).sqrt();
            let (sine, cosine) = (TAU * unit(random)).sin_cos();
            place[0] += way * cosine;
            place[1] += way * sine;
        }
        _ => place[0] += fall * (PI * (unit(random) - 0.5)).tan(),
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_sim::random::RandomStream;

    /// Share of the returns that lie on the near half, against the share that the kernel gives.
    #[test]
    fn walkers_return_as_the_poisson_kernel_says() {
        let draws = 40_000;
        let mut random = RandomStream::new(1, "returns").at(0, 0);
        let (radius, far) = (3.0, 5.0);
        let near = |met: f64| u32::from(met > 0.0);
        let in_2d: u32 = (0..draws)
            .map(|_| near(return_to_sphere([far, 0.0], radius, &mut random).expect("it does")[0]))
            .sum();
        // The kernel over half a circle: 1/2 + (2/pi) atan(radius / far).
        let expected = 0.5 + 2.0 / PI * (radius / far).atan();
        assert!((f64::from(in_2d) / f64::from(draws) - expected).abs() < 0.01);
        let met: Vec<_> = (0..draws)
            .filter_map(|_| return_to_sphere([0.0, far, 0.0], radius, &mut random))
            .collect();
        assert!((met.len() as f64 / f64::from(draws) - radius / far).abs() < 0.01);
        let share = met.iter().map(|met| f64::from(near(met[1]))).sum::<f64>() / met.len() as f64;
        let reciprocal = |way: f64| 1.0 / way;
        let [least, middle, most] = [far + radius, far.hypot(radius), far - radius].map(reciprocal);
        assert!((share - (most - middle) / (most - least)).abs() < 0.01, "{share}");
        assert!(
            met.iter().all(|met| {
                (met.iter().map(|x| x * x).sum::<f64>().sqrt() - radius).abs() < 1e-9
            })
        );
    }

    /// Half of the walkers that fall from a height come down within it (2-D), or within the
    /// square root of three times it (3-D).
    #[test]
    fn walkers_fall_as_the_half_space_says() {
        let draws = 40_000;
        let mut random = RandomStream::new(1, "falls").at(0, 0);
        let mut share = |way: &mut dyn FnMut(&mut NodeRandom) -> f64, within: f64| {
            let count = (0..draws).filter(|_| way(&mut random) < within).count();
            count as f64 / f64::from(draws)
        };
        let in_2d = share(&mut |random| return_to_floor([0.0, 4.0], 4.0, random)[0].abs(), 4.0);
        let in_3d = share(
            &mut |random| {
                let [x, y, z] = return_to_floor([0.0, 0.0, 4.0], 4.0, random);
                assert_eq!(z, 0.0);
                x.hypot(y)
            },
            4.0 * 3.0_f64.sqrt(),
        );
        assert!((in_2d - 0.5).abs() < 0.01 && (in_3d - 0.5).abs() < 0.01, "{in_2d} {in_3d}");
    }
}
