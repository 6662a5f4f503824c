//! Depths and levels as whole numbers of a small unit.
//!
//! Whole numbers add up to the same sum in any order, so water is conserved exactly, any number of
//! threads gives the same bits, and a lake at rest stays at rest: its levels are equal, not nearly
//! so. A `f64` of metres holds a whole number of units exactly.

/// Metres in a unit: 2^-32, a quarter of a nanometre.
pub const UNIT_M: f64 = 1.0 / UNITS_A_METRE;

/// Units in a metre.
const UNITS_A_METRE: f64 = 4_294_967_296.0;

/// Largest elevation and depth in metres, 2^18: sums over all neighbours then fit 64 bits with room
/// to spare, and single values are exact in `f64`.
pub const MOST_M: f64 = 262_144.0;

/// The whole number of units nearest to so many metres; halves go away from zero.
#[inline]
pub fn units(metres: f64) -> i64 {
    let units = metres * UNITS_A_METRE;
    (units + 0.5_f64.copysign(units)) as i64
}

/// Units in metres.
#[inline]
pub fn metres(units: i64) -> f64 {
    units as f64 * UNIT_M
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn units_survive_the_way_through_metres(count in -(1_i64 << 50)..(1 << 50)) {
            prop_assert_eq!(units(metres(count)), count);
        }

        #[test]
        fn metres_are_met_to_half_a_unit(length in -MOST_M..MOST_M) {
            prop_assert!((metres(units(length)) - length).abs() <= 0.5 * UNIT_M);
        }
    }
}
