//! The Abelian sandpile against Dhar's exact results.

use landform_dunes::sandpile::{AbelianSandpile, exact, is_recurrent};
use landform_sim::random::RandomStream;

/// A pile brought to its critical state and the number of grains that this took.
fn critical(side: usize, stream: &RandomStream) -> (AbelianSandpile, u64) {
    // From a full pile few grains are needed: what is too much falls off at once.
    let full = vec![3; side * side];
    let (mut pile, _) = AbelianSandpile::with_grains([side, side], &full).unwrap();
    let transient = (4 * side * side) as u64;
    for grain in 0..transient {
        pile.add_at_random(stream, grain);
    }
    (pile, transient)
}

#[test]
fn the_mean_avalanche_is_the_exact_one() {
    for (side, grains) in [(16, 400_000), (32, 400_000), (64, 400_000)] {
        let stream = RandomStream::new(11, "grains");
        let (mut pile, start) = critical(side, &stream);
        let total: u64 =
            (start..start + grains).map(|grain| pile.add_at_random(&stream, grain).size).sum();
        let [mean, expected] = [total as f64 / grains as f64, exact::mean_avalanche_size(side)];
        println!("side {side}: {mean:.3}, exact {expected:.3}");
        assert!((mean / expected - 1.0).abs() < 0.005, "side {side}: {mean}, exact {expected}");
        assert_eq!(pile.ledger().imbalance(), 0);
    }
}

/// Density and height probabilities in the middle half, away from the borders.
#[test]
fn sites_hold_as_many_grains_as_theory_says() {
    let side = 128;
    let stream = RandomStream::new(5, "grains");
    let (mut pile, start) = critical(side, &stream);
    let mut counts = [0_u64; 4];
    let grains = 30_000;
    for grain in start..start + grains {
        pile.add_at_random(&stream, grain);
        if grain % 100 == 0 {
            let held = pile.grains();
            for row in side / 4..3 * side / 4 {
                let line = &held[side * row + side / 4..side * row + 3 * side / 4];
                line.iter().for_each(|&grains| counts[grains as usize] += 1);
            }
        }
    }
    let sites = counts.iter().sum::<u64>() as f64;
    let shares = counts.map(|count| count as f64 / sites);
    let mean: f64 = (0..4).map(|grains| grains as f64 * shares[grains]).sum();
    println!("mean {mean:.4}, exact {}; shares {shares:.4?}", exact::MEAN_GRAINS);
    assert!((mean - exact::MEAN_GRAINS).abs() < 0.003, "{mean}");
    for (share, expected) in shares.into_iter().zip(exact::GRAIN_PROBABILITIES) {
        assert!((share - expected).abs() < 0.002, "{share}, exact {expected}");
    }
}

#[test]
fn the_critical_state_recurs() {
    let stream = RandomStream::new(3, "grains");
    let (mut pile, start) = critical(20, &stream);
    for grain in start..start + 500 {
        let avalanche = pile.add_at_random(&stream, grain);
        assert!(avalanche.area <= avalanche.size && avalanche.duration <= avalanche.size);
        assert!(is_recurrent([20, 20], &pile.grains()));
    }
    assert!(!is_recurrent([20, 20], &AbelianSandpile::new([20, 20]).unwrap().grains()));
}
