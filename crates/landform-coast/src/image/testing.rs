//! Land for tests.

/// A block of land with a margin of sea, and rock at random.
pub(crate) fn island(size: [usize; 2], seed: u64) -> (Vec<u8>, Vec<f64>) {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / 2_f64.powi(53)
    };
    let [width, height] = size;
    let inland = |pixel: usize| {
        let [x, y] = [pixel % width, pixel / width];
        (2..width - 1).contains(&x) && (1..height - 2).contains(&y)
    };
    let land = (0..width * height).map(|pixel| u8::from(inland(pixel))).collect();
    (land, (0..width * height).map(|_| random()).collect())
}

/// A graphics processor for tests; without one a word that nothing was tested, and `None`.
#[cfg(feature = "gpu")]
pub(crate) fn device() -> Option<()> {
    match super::GpuCoast::check([64, 64]) {
        Err(error) => eprintln!("NOT TESTED: {error}"),
        Ok(()) => return Some(()),
    }
    None
}
