//! The Abelian sandpile: nanoseconds a toppling.
//!
//! Grains fall on random sites of a pile in its critical state. `naive` is the textbook's way,
//! written here: a list of sites to look at, neighbours by coordinates, nothing counted but the
//! topplings. The pile of the library also counts area and duration of every avalanche, and what
//! falls over each border. Both must topple equally often, or the program ends with an error.

mod measure;

use landform::dunes::sandpile::AbelianSandpile;
use landform::sim::random::RandomStream;
use measure::{Effort, pairs, table};

fn main() {
    table("Sandpile", |effort| {
        let mut sides = vec![64, 256];
        if effort == Effort::Full {
            sides.push(1024);
        }
        for side in sides {
            topplings(effort, side);
        }
    });
}

fn topplings(effort: Effort, side: usize) {
    // More than a pile can hold: what is left after relaxing is a critical state.
    let full = vec![4; side * side];
    let (mut pile, _) = AbelianSandpile::with_grains([side, side], &full).expect("a pile");
    let mut naive = Naive { side, grains: pile.grains(), waiting: Vec::new() };
    let stream = RandomStream::new(1, "grains");
    let grains = if effort == Effort::Quick { 2_000 } else { 20_000 * 64 / side as u64 };
    let [mut from, mut naive_from] = [0; 2];
    let [mut toppled, mut naive_toppled] = [0; 2];
    let work = || {
        let sum = (from..from + grains).map(|n| pile.add_at_random(&stream, n).size).sum::<u64>();
        from += grains;
        toppled += sum;
        sum as usize
    };
    let naive_work = || {
        let numbers = naive_from..naive_from + grains;
        let sum = numbers.map(|n| naive.add_at_random(&stream, n)).sum::<u64>();
        naive_from += grains;
        naive_toppled += sum;
        sum as usize
    };
    let pair = pairs(effort.rounds(10), work, naive_work);
    assert_eq!(toppled, naive_toppled, "both piles topple equally often");
    pair.print(&format!("toppling {side}x{side}"), "naive", "25 ns");
}

/// The sandpile as one would write it first.
struct Naive {
    side: usize,
    grains: Vec<u32>,
    waiting: Vec<[usize; 2]>,
}

impl Naive {
    /// Adds a grain at the site where the library's pile adds its grain of that number; gives the
    /// number of topplings.
    fn add_at_random(&mut self, stream: &RandomStream, number: u64) -> u64 {
        let words = stream.block(number, 0, 0);
        let pick = |word: u32| ((u64::from(word) * self.side as u64) >> 32) as usize;
        let site = [pick(words[0]), pick(words[1])];
        self.grains[site[0] + self.side * site[1]] += 1;
        self.waiting.push(site);
        self.relax()
    }

    fn relax(&mut self) -> u64 {
        let mut topplings = 0;
        while let Some([x, y]) = self.waiting.pop() {
            if self.grains[x + self.side * y] < 4 {
                continue;
            }
            self.grains[x + self.side * y] -= 4;
            topplings += 1;
            self.waiting.push([x, y]);
            for [x, y] in [[x.wrapping_sub(1), y], [x + 1, y], [x, y.wrapping_sub(1)], [x, y + 1]] {
                if x < self.side && y < self.side {
                    self.grains[x + self.side * y] += 1;
                    self.waiting.push([x, y]);
                }
            }
        }
        topplings
    }
}
