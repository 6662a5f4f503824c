//! Fields as bits, for comparisons that allow no rounding.

/// FNV-1a hash of bytes (Fowler, Noll, Vo; 64 bits).
pub fn fnv(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The hash of the bits of a field.
pub fn bits_of(values: &[f64]) -> u64 {
    fnv(values.iter().flat_map(|value| value.to_bits().to_le_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        assert_eq!(fnv([]), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv(*b"foobar"), 0x8594_4171_f739_67e8);
        assert_ne!(bits_of(&[0.0]), bits_of(&[-0.0]));
    }
}
