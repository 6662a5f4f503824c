//! How much memory a run may take.

/// Share of the free memory that a run may take.
const SHARE: f64 = 0.8;

/// What is assumed where the system does not say how much memory is free.
const ASSUMED_BYTES: u64 = 8 << 30;

/// The limit in bytes: what was asked for, or most of what is free.
pub(super) fn limit(asked_gib: Option<f64>) -> Result<u64, String> {
    match asked_gib {
        Some(gib) if gib > 0.0 && gib.is_finite() => Ok((gib * (1_u64 << 30) as f64) as u64),
        Some(gib) => Err(format!("--memory-limit-gib is {gib}; it must be a positive number")),
        None => Ok(free_bytes().map_or(ASSUMED_BYTES, |free| (free as f64 * SHARE) as u64)),
    }
}

/// Free memory where the kernel tells it in `/proc`.
fn free_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib * 1024)
}
