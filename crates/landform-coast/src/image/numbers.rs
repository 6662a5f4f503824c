//! The arithmetic of image coasts, in whole numbers of at most 32 bits.
//!
//! | quantity | steps to 1 |
//! |---|---|
//! | resistance | 65535 |
//! | length of shore over the side of a tile | 65536, up to 128 |
//! | attenuation g | 4096, below 16 |
//! | 1 + g L | 4096 |
//! | force, strength | 524288 |
//!
//! The shader `coast.wgsl` holds the same formulas.

use crate::coast::Weakening;

/// Largest length of shore that is told apart from longer ones.
const LONGEST: u32 = (128 << 16) - 1;

/// Half of the square root of 2 in steps of 1/65536: the shore that cuts a corner of a square.
const CORNER: u32 = 46341;

/// A resistance of 0 to 1 in steps.
pub fn resistance(u: f64) -> u16 {
    (u.clamp(0.0, 1.0) * 65535.0).round() as u16
}

/// Straight and corner-cutting pieces of shore in a square of 2 x 2 pixels, whose values are 1 on
/// land and 0 at sea: north-west, north-east, south-west and south-east (figure B.2).
#[inline]
pub fn shore_pieces([nw, ne, sw, se]: [u8; 4]) -> [u32; 2] {
    match nw + ne + sw + se {
        1 | 3 => [0, 1],
        2 if nw == se => [0, 2],
        2 => [1, 0],
        _ => [0, 0],
    }
}

/// Length of shore of a tile over its side, from its straight and corner-cutting pieces.
pub fn tile_length([straight, corners]: [u32; 2], side: u32) -> u32 {
    let over_side = |count: u32, length: u32| count / side * length + count % side * length / side;
    (over_side(straight, 1 << 16) + over_side(corners, CORNER)).min(LONGEST)
}

/// Where a pixel lies between the middles of tiles: the tile before it and how far, in 256ths,
/// it is on the way to the next; beyond the outermost middles it has their tile.
pub fn between_tiles(pixel: u32, side: u32, tiles: u32) -> [u32; 2] {
    let after = 2 * pixel + 1;
    if after < side {
        return [0, 0];
    }
    let (tile, way) = ((after - side) / (2 * side), (after - side) % (2 * side));
    match tile + 1 < tiles {
        true => [tile, way * 128 / side],
        false => [tiles - 1, 0],
    }
}

/// A length some 256ths of the way from one to another.
#[inline]
pub fn blend(from: u32, to: u32, way: u32) -> u32 {
    (from * (256 - way) + to * way) >> 8
}

/// Force of the sea on a length of shore: f / (1 + g L), with f in steps of 2^-31 and g in steps
/// of 1/4096.
#[inline]
pub fn force(f: u32, g: u32, length: u32) -> u32 {
    let divisor = 4096 + g * (length >> 16) + ((g * (length & 0xffff)) >> 16);
    f / divisor
}

/// What is left of a resistance when `exposed` of four sides lie at sea.
#[inline]
pub fn strength(weakening: Weakening, resistance: u16, exposed: u32) -> u32 {
    let u = u32::from(resistance);
    match weakening {
        Weakening::None => 8 * u,
        Weakening::Share => 2 * u * (4 - exposed),
        Weakening::Power => 8 * (1..exposed).fold(u, |power, _| (power * u) >> 16),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_those_of_marching_squares() {
        for case in 0..16_u8 {
            let pixels = [0, 1, 2, 3].map(|bit| case >> bit & 1);
            let [straight, corners] = shore_pieces(pixels);
            let expected = match case {
                0 | 15 => [0, 0],
                // Two beside each other: along an edge of the square.
                0b0011 | 0b1100 | 0b0101 | 0b1010 => [1, 0],
                0b0110 | 0b1001 => [0, 2],
                _ => [0, 1],
            };
            assert_eq!([straight, corners], expected, "{case:04b}");
        }
    }

    /// Whole numbers follow the formula of real ones to a few of their steps.
    #[test]
    fn forces_follow_equation_4_2() {
        for [f0, g] in [[0.5, 0.23], [0.5, 0.147], [1.9, 15.9], [0.01, 0.0]] {
            let (f, steps) = ((f0 * 2_f64.powi(31)) as u32, (g * 4096.0_f64).round() as u32);
            for length in [0.0, 0.3, 1.0, 2.1, 40.0, 127.9] {
                let found = f64::from(force(f, steps, (length * 65536.0) as u32)) / 524_288.0;
                let exact = f0 / (1.0 + g * length);
                assert!((found - exact).abs() < 1e-3 * exact + 4e-6, "{found} for {exact}");
            }
        }
    }

    #[test]
    fn tiles_measure_their_shore() {
        // A straight coast across a tile.
        assert_eq!(tile_length([64, 0], 64), 1 << 16);
        let diagonal = f64::from(tile_length([0, 128], 64)) / 65536.0;
        assert!((diagonal - 2.0_f64.sqrt()).abs() < 1e-4);
        // Nothing overflows, even where every square is full of shore.
        let side = 16384;
        assert_eq!(tile_length([0, 2 * side * side], side), LONGEST);
        assert_eq!(tile_length([side * side, 0], side), LONGEST);
    }

    #[test]
    fn pixels_lie_between_the_middles_of_tiles() {
        assert_eq!(between_tiles(0, 8, 4), [0, 0]);
        assert_eq!(between_tiles(3, 8, 4), [0, 0]);
        assert_eq!(between_tiles(4, 8, 4), [0, 16]);
        assert_eq!(between_tiles(11, 8, 4), [0, 240]);
        assert_eq!(between_tiles(12, 8, 4), [1, 16]);
        assert_eq!(between_tiles(27, 8, 4), [2, 240]);
        assert_eq!(between_tiles(28, 8, 4), [3, 0]);
        assert_eq!(between_tiles(31, 8, 4), [3, 0]);
        assert_eq!(between_tiles(5, 8, 1), [0, 0]);
        assert_eq!(blend(100, 200, 128), 150);
        assert_eq!(blend(LONGEST, LONGEST, 255), LONGEST);
    }

    #[test]
    fn exposure_weakens() {
        let u = resistance(0.5);
        let share = |exposed| f64::from(strength(Weakening::Share, u, exposed)) / 524_288.0;
        assert!((share(1) - 0.375).abs() < 1e-4 && share(4) == 0.0);
        let power = |exposed| f64::from(strength(Weakening::Power, u, exposed)) / 524_288.0;
        assert!((power(1) - 0.5).abs() < 1e-4 && (power(3) - 0.125).abs() < 1e-4);
        assert_eq!(strength(Weakening::None, u, 4), 8 * u32::from(u));
    }
}
