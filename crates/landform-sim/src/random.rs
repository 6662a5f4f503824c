//! Random numbers that depend on where and when they are drawn, never on what was drawn before.
//!
//! Every number is a function of (seed, stream, iteration, node, index): nothing has to be
//! saved, and any order of visits on any number of threads gives the same numbers. The
//! generator is Philox4x32-10 (Salmon, Moraes, Dror and Shaw 2011, "Parallel random numbers:
//! as easy as 1, 2, 3").

use std::convert::Infallible;

use rand::rand_core::TryRng;

/// The Philox4x32-10 bijection: four random words from a counter and a key.
#[inline]
pub fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    const MULTIPLIERS: [u64; 2] = [0xD251_1F53, 0xCD9E_8D57];
    const KEY_STEPS: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
    for _ in 0..10 {
        let low = MULTIPLIERS[0] * u64::from(counter[0]);
        let high = MULTIPLIERS[1] * u64::from(counter[2]);
        counter = [
            (high >> 32) as u32 ^ counter[1] ^ key[0],
            high as u32,
            (low >> 32) as u32 ^ counter[3] ^ key[1],
            low as u32,
        ];
        key = [key[0].wrapping_add(KEY_STEPS[0]), key[1].wrapping_add(KEY_STEPS[1])];
    }
    counter
}

/// A random word as a number in [0, 1).
#[inline]
pub fn unit(word: u32) -> f64 {
    f64::from(word) * (1.0 / 4_294_967_296.0)
}

/// A named source of random numbers, independent of every other name and seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RandomStream {
    key: [u32; 2],
}

impl RandomStream {
    /// The stream `name` of the run's `seed`. Use one name for each kind of decision.
    pub fn new(seed: u64, name: &str) -> Self {
        let hash = name.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
        });
        let [low, high] = [hash as u32, (hash >> 32) as u32];
        let mixed = philox([low, high, 0, 0], [seed as u32, (seed >> 32) as u32]);
        Self { key: [mixed[0], mixed[1]] }
    }

    /// Four random words for a node at an iteration; `index` numbers further blocks.
    #[inline]
    pub fn block(&self, iteration: u64, node: usize, index: u32) -> [u32; 4] {
        let counter = [node as u32, iteration as u32, (iteration >> 32) as u32, index];
        philox(counter, self.key)
    }

    /// A number in [0, 1) for a node at an iteration; `index` numbers further ones.
    #[inline]
    pub fn unit(&self, iteration: u64, node: usize, index: u32) -> f64 {
        unit(self.block(iteration, node, index)[0])
    }

    /// A generator for all the numbers that one node draws at one iteration. It works with
    /// every method of `rand::RngExt` and every distribution of `rand_distr`.
    pub fn at(&self, iteration: u64, node: usize) -> NodeRandom {
        NodeRandom { stream: *self, iteration, node, index: 0, words: [0; 4], used: 4 }
    }
}

/// The random numbers of one node at one iteration: see [`RandomStream::at`].
#[derive(Clone, Debug)]
pub struct NodeRandom {
    stream: RandomStream,
    iteration: u64,
    node: usize,
    index: u32,
    words: [u32; 4],
    used: usize,
}

impl TryRng for NodeRandom {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        if self.used == 4 {
            self.words = self.stream.block(self.iteration, self.node, self.index);
            self.index += 1;
            self.used = 0;
        }
        self.used += 1;
        Ok(self.words[self.used - 1])
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let low = u64::from(self.try_next_u32()?);
        Ok(low | u64::from(self.try_next_u32()?) << 32)
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for chunk in bytes.chunks_mut(4) {
            let word = self.try_next_u32()?.to_le_bytes();
            chunk.copy_from_slice(&word[..chunk.len()]);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;

    /// Known answers published with Random123.
    #[test]
    fn philox_gives_the_published_answers() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_E8D5, 0xE169_C58D, 0xBC57_AC4C, 0x9B00_DBD8]);
        let ones = u32::MAX;
        assert_eq!(
            philox([ones; 4], [ones; 2]),
            [0x408F_276D, 0x41C8_3B0E, 0xA20B_C7C6, 0x6D54_51FD]
        );
    }

    #[test]
    fn streams_nodes_and_iterations_differ() {
        let stream = RandomStream::new(7, "lift");
        let first = stream.block(3, 11, 0);
        assert_eq!(first, RandomStream::new(7, "lift").block(3, 11, 0));
        assert_ne!(first, RandomStream::new(8, "lift").block(3, 11, 0));
        assert_ne!(first, RandomStream::new(7, "land").block(3, 11, 0));
        assert_ne!(first, stream.block(4, 11, 0));
        assert_ne!(first, stream.block(3, 12, 0));
    }

    #[test]
    fn numbers_are_spread_evenly() {
        let stream = RandomStream::new(1, "spread");
        let mean = (0..10_000).map(|node| stream.at(0, node).random::<f64>()).sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01, "mean {mean}");
    }
}
