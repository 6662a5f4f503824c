//! What all benchmarks share: pairs of timings taken alternately, and a table of their ratios.
//!
//! Times are CPU times of one thread, and both sides of a pair run right after one another, so
//! that other programs on the machine disturb the ratio little. Nothing fails for being slow:
//! the column `reach` says what the figure beside it should come to, for a person to judge.
//!
//! `cargo bench -p landform-tests` runs all benchmarks, `--bench NAME` one of them; after `--`,
//! `--quick` takes smaller and fewer measurements, `--full` adds the largest ones.

use cpu_time::ThreadTime;

/// How much to measure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// A few seconds, to see that everything runs.
    Quick,
    /// Less than a minute.
    Normal,
    /// As long as the largest cases take.
    Full,
}

impl Effort {
    /// The number of rounds: a fifth of `normal`, and at least one, when it has to be quick.
    pub fn rounds(self, normal: usize) -> usize {
        if self == Self::Quick { normal.div_ceil(5) } else { normal }
    }
}

/// Prints a title and the head of the table, then measures on a single thread.
pub fn table(title: &str, measure: impl FnOnce(Effort) + Send) {
    let has = |flag: &str| std::env::args().any(|argument| argument == flag);
    let effort = match (has("--quick"), has("--full")) {
        (true, _) => Effort::Quick,
        (_, true) => Effort::Full,
        _ => Effort::Normal,
    };
    println!("\n{title}");
    println!("{:<50} {:>9}  {:<34} {:>9} {:>8}  reach", "", "ns", "against", "ns", "ratio");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    // Kernels that use threads then stay on this one, whose time is taken.
    pool.expect("a thread can be started").install(|| measure(effort));
}

/// Medians of pairs of timings.
#[derive(Clone, Copy)]
pub struct Pair {
    /// Nanoseconds a unit of work of either side.
    pub ns: [f64; 2],
    /// The first over the second.
    pub ratio: f64,
}

impl Pair {
    /// Medians of pairs of nanoseconds.
    pub fn of(pairs: &[[f64; 2]]) -> Self {
        let median_of = |figure: fn(&[f64; 2]) -> f64| median(pairs.iter().map(figure).collect());
        let ratio = median_of(|pair| pair[0] / pair[1]);
        Self { ns: [median_of(|pair| pair[0]), median_of(|pair| pair[1])], ratio }
    }

    /// Prints a line of the table: what was timed, against what, and what it should come to.
    pub fn print(&self, name: &str, against: &str, reach: &str) {
        let [first, second] = self.ns;
        println!(
            "{name:<50} {first:>9.2}  {against:<34} {second:>9.2} {:>8.3}  {reach}",
            self.ratio
        );
    }
}

/// Times two kinds of work alternately, `rounds` times after one round for warming up. Each
/// does its work and returns how many units it was.
pub fn pairs(
    rounds: usize,
    mut first: impl FnMut() -> usize,
    mut second: impl FnMut() -> usize,
) -> Pair {
    let times: Vec<[f64; 2]> =
        (0..=rounds).map(|_| [time(&mut first), time(&mut second)]).collect();
    Pair::of(&times[1..])
}

/// Nanoseconds a unit of some work.
pub fn time(work: &mut dyn FnMut() -> usize) -> f64 {
    let start = ThreadTime::now();
    let units = work();
    start.elapsed().as_nanos() as f64 / units as f64
}

/// The value in the middle.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
