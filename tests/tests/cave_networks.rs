//! Surveyed caves against another program's numbers.
//!
//! The numbers are those of karstnet 1.2.5 for the same files. The caves lie in `shared/data/cave`
//! beside the checkout or below `LANDFORM_DATA`; without them the test says so and does nothing.

use std::fs;
use std::path::{Path, PathBuf};

use landform::analysis::caves::{CaveNetwork, NetworkShape};
use landform_tests::repository;

fn folder() -> Option<PathBuf> {
    let beside = || repository().parent().map(|parent| parent.join("shared/data"));
    let data = std::env::var_os("LANDFORM_DATA").map(PathBuf::from).or_else(beside)?;
    Some(data.join("cave")).filter(|folder| folder.is_dir())
}

/// The numbers of each row of a CSV file after its first.
fn rows(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).expect("the file is there");
    let row = |line: &str| line.split(',').map(|cell| cell.parse().expect("a number")).collect();
    text.lines().skip(1).map(row).collect()
}

fn network(folder: &Path, name: &str) -> CaveNetwork {
    let nodes = rows(&folder.join(format!("{name}_nodes.csv")));
    let stations = nodes.iter().map(|row| [row[1], row[2], row[3]]).collect();
    let number = |id: f64| nodes.iter().position(|row| row[0] == id).expect("a node");
    let links = rows(&folder.join(format!("{name}_links.csv")));
    let legs: Vec<[usize; 2]> = links.iter().map(|row| [number(row[0]), number(row[1])]).collect();
    CaveNetwork::new(stations, &legs).expect("a network")
}

#[test]
fn surveyed_networks_have_the_numbers_of_karstnet() {
    let Some(folder) = folder() else {
        println!("no real caves: LANDFORM_DATA is not set and ../shared/data/cave does not exist");
        return;
    };
    // Mean length, variation, entropy of lengths; tortuosity, entropy of directions; shortest path,
    // dominance, degree, its variation and its correlation.
    let expected = [
        (
            "sakany",
            [
                20.70591, 0.914918, 0.377037, 1.400936, 0.992488, 12.618906, 0.267674, 2.395349,
                0.470807, -0.168030,
            ],
        ),
        (
            "monachou",
            [
                8.464088, 0.903295, 0.551023, 1.243212, 0.984878, 7.581013, 0.403962, 2.175,
                0.500321, -0.249738,
            ],
        ),
    ];
    for (name, expected) in expected {
        let shape = NetworkShape::of(&network(&folder, name));
        let found = [
            Some(shape.mean_branch_length_m),
            shape.variation_of_length,
            Some(shape.length_entropy),
            shape.tortuosity,
            Some(shape.orientation_entropy),
            Some(shape.average_shortest_path),
            shape.central_point_dominance,
            Some(shape.mean_degree),
            shape.variation_of_degree,
            shape.correlation_of_degree,
        ];
        for (number, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            let found = found.expect("a number");
            assert!(
                (found - expected).abs() < 2e-6 * expected.abs().max(1.0),
                "{name} {number}: {found} for {expected}"
            );
        }
    }
}
