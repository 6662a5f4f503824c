//! How avalanches are spread over sizes.

use landform_sim::checkpoint::{Damage, Keep, Loader, Saver};

/// Counts of avalanches by their size, area or duration, in bins that double: 1, 2-3, 4-7 ...
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SizeStatistics {
    bins: [u64; 64],
    none: u64,
    total: u128,
    largest: u64,
}

impl Default for SizeStatistics {
    fn default() -> Self {
        Self { bins: [0; 64], none: 0, total: 0, largest: 0 }
    }
}

/// One bin of [`SizeStatistics`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeBin {
    /// Smallest size of the bin; the largest is one less than twice as much.
    pub smallest: u64,
    /// Number of avalanches.
    pub count: u64,
    /// Share of all avalanches, those of size 0 included, for each whole size in the bin.
    pub density: f64,
}

impl Keep for SizeStatistics {
    fn save<'a>(&'a self, to: &mut Saver<'_, 'a>) {
        to.array("bins", &self.bins);
        let total = [self.total as u64, (self.total >> 64) as u64];
        to.value("other", &(self.none, total, self.largest));
    }

    fn restore(from: &Loader<'_>) -> Result<Self, Damage> {
        let mut bins = [0; 64];
        bins.copy_from_slice(from.array_of("bins", 64)?);
        let (none, [low, high], largest): (u64, [u64; 2], u64) = from.value("other")?;
        Ok(Self { bins, none, total: u128::from(high) << 64 | u128::from(low), largest })
    }
}

impl SizeStatistics {
    /// Counts an avalanche; 0 is one that did not happen.
    pub fn record(&mut self, size: u64) {
        match size.checked_ilog2() {
            Some(bin) => self.bins[bin as usize] += 1,
            None => self.none += 1,
        }
        self.total += u128::from(size);
        self.largest = self.largest.max(size);
    }

    /// Number of avalanches, those of size 0 included.
    pub fn count(&self) -> u64 {
        self.none + self.bins.iter().sum::<u64>()
    }

    /// Share of the additions that set nothing off; 0 before the first.
    pub fn still_share(&self) -> f64 {
        self.none as f64 / self.count().max(1) as f64
    }

    /// Mean size, those of size 0 included; 0 before the first.
    pub fn mean(&self) -> f64 {
        self.total as f64 / self.count().max(1) as f64
    }

    /// Largest size.
    pub fn largest(&self) -> u64 {
        self.largest
    }

    /// Bins up to the largest size, without the avalanches of size 0.
    pub fn bins(&self) -> Vec<SizeBin> {
        let count = self.count().max(1) as f64;
        let used = self.largest.checked_ilog2().map_or(0, |bin| bin as usize + 1);
        let bin = |bin: usize| {
            let smallest = 1 << bin;
            let density = self.bins[bin] as f64 / count / smallest as f64;
            SizeBin { smallest, count: self.bins[bin], density }
        };
        (0..used).map(bin).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_counted_in_doubling_bins() {
        let mut sizes = SizeStatistics::default();
        assert_eq!((sizes.mean(), sizes.still_share(), sizes.bins()), (0.0, 0.0, vec![]));
        [0, 1, 2, 3, 4, 7, 8, 0].into_iter().for_each(|size| sizes.record(size));
        let counts: Vec<[u64; 2]> =
            sizes.bins().iter().map(|bin| [bin.smallest, bin.count]).collect();
        assert_eq!(counts, [[1, 1], [2, 2], [4, 2], [8, 1]]);
        assert_eq!(sizes.bins()[2].density, 2.0 / 8.0 / 4.0);
        assert_eq!((sizes.mean(), sizes.largest(), sizes.still_share()), (25.0 / 8.0, 8, 0.25));
        sizes.record(u64::MAX);
        assert_eq!(sizes.bins().len(), 64);
    }
}
