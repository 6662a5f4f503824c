//! Shape of a cave network in numbers (Collon et al. 2017).

use serde::Serialize;

use super::CaveNetwork;
use super::paths::{components, steps_and_betweenness};
use super::reduced::reduced;

/// Geometry and topology of a network. Numbers that it does not have are `None`: of a network with one
/// branch, say, the variation of lengths.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NetworkShape {
    /// Length of all legs in metres.
    pub length_m: f64,
    /// Number of branches: ways without junctions.
    pub branches: usize,
    /// Mean length of branches in metres.
    pub mean_branch_length_m: f64,
    /// Standard deviation of the lengths of branches over their mean.
    pub variation_of_length: Option<f64>,
    /// Entropy of the lengths of branches in ten classes up to the longest, 1 if all are as frequent.
    pub length_entropy: f64,
    /// Mean of length over distance of the ends of branches, loops left out.
    pub tortuosity: Option<f64>,
    /// Entropy of the directions of legs on the map in classes of 10 degrees, weighted by length.
    pub orientation_entropy: f64,
    /// Mean number of branches at a node of the reduced graph.
    pub mean_degree: f64,
    /// Standard deviation of these numbers over their mean.
    pub variation_of_degree: Option<f64>,
    /// Correlation of these numbers at both ends of branches.
    pub correlation_of_degree: Option<f64>,
    /// Mean number of branches on the shortest way between two nodes of a part.
    pub average_shortest_path: f64,
    /// How much more shortest ways pass the busiest node than the others, 0 to 1.
    pub central_point_dominance: Option<f64>,
    /// Independent loops.
    pub cyclomatic_number: usize,
    /// Separate parts.
    pub components: usize,
}

/// The range of a number over the 31 surveyed caves of Collon et al. 2017 (corrected 2021).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observed {
    /// Name of the number, as the field of [`NetworkShape`].
    pub name: &'static str,
    /// Least and greatest value.
    pub range: [f64; 2],
    /// Whether it is one of the eight that the authors recommend.
    pub recommended: bool,
}

/// What surveyed caves have.
pub const OBSERVED: [Observed; 10] = [
    observed("orientation_entropy", [0.746, 0.997], true),
    // 8.5 in the table; Monachou, which has the least, has 8.46.
    observed("mean_branch_length_m", [8.46, 332.0], true),
    observed("variation_of_length", [0.90, 2.56], true),
    observed("length_entropy", [0.070, 0.667], true),
    observed("tortuosity", [1.12, 1.54], false),
    observed("mean_degree", [1.75, 2.57], true),
    observed("variation_of_degree", [0.35, 0.60], false),
    observed("correlation_of_degree", [-0.556, -0.150], true),
    observed("average_shortest_path", [2.3, 55.7], true),
    observed("central_point_dominance", [0.02, 0.57], true),
];

const fn observed(name: &'static str, range: [f64; 2], recommended: bool) -> Observed {
    Observed { name, range, recommended }
}

impl NetworkShape {
    /// Measures a network.
    pub fn of(network: &CaveNetwork) -> Self {
        let branches = network.branches();
        let lengths: Vec<f64> = branches.iter().map(|branch| branch.length_m).collect();
        let ratios = branches.iter().filter_map(|branch| {
            let [first, .., last] = branch.stations[..] else { return None };
            let straight = network.distance_m(first, last);
            (straight > 0.0).then(|| branch.length_m / straight)
        });
        let ratios: Vec<f64> = ratios.collect();
        let graph = reduced(network);
        let degrees: Vec<f64> = graph.iter().map(|list| list.len() as f64).collect();
        let (steps, betweenness) = steps_and_betweenness(&graph);
        Self {
            length_m: network.length_m(),
            branches: branches.len(),
            mean_branch_length_m: mean(&lengths),
            variation_of_length: variation(&lengths),
            length_entropy: length_entropy(&lengths),
            tortuosity: (!ratios.is_empty()).then(|| mean(&ratios)),
            orientation_entropy: orientation_entropy(network),
            mean_degree: mean(&degrees),
            variation_of_degree: variation(&degrees),
            correlation_of_degree: correlation(&graph),
            average_shortest_path: average_shortest_path(&graph, &steps),
            central_point_dominance: dominance(&betweenness),
            cyclomatic_number: network.cyclomatic_number(),
            components: network.component_count(),
        }
    }

    /// The number of a name in [`OBSERVED`], if it has one.
    pub fn value(&self, name: &str) -> Option<f64> {
        match name {
            "orientation_entropy" => Some(self.orientation_entropy),
            "mean_branch_length_m" => Some(self.mean_branch_length_m),
            "variation_of_length" => self.variation_of_length,
            "length_entropy" => Some(self.length_entropy),
            "tortuosity" => self.tortuosity,
            "mean_degree" => Some(self.mean_degree),
            "variation_of_degree" => self.variation_of_degree,
            "correlation_of_degree" => self.correlation_of_degree,
            "average_shortest_path" => Some(self.average_shortest_path),
            "central_point_dominance" => self.central_point_dominance,
            _ => None,
        }
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard deviation, of a sample, over the mean.
fn variation(values: &[f64]) -> Option<f64> {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt() / mean)
}

/// Entropy of weights in classes, to the base of their number.
fn entropy(classes: &[f64]) -> f64 {
    let sum: f64 = classes.iter().sum();
    let shares = classes.iter().filter(|&&weight| weight > 0.0).map(|weight| weight / sum);
    -shares.map(|share| share * share.ln()).sum::<f64>() / (classes.len() as f64).ln()
}

fn length_entropy(lengths: &[f64]) -> f64 {
    let longest = lengths.iter().fold(0.0, |longest: f64, &length| longest.max(length));
    let mut classes = [0.0; 10];
    for length in lengths {
        let class = (length / longest * classes.len() as f64) as usize;
        classes[class.min(classes.len() - 1)] += 1.0;
    }
    // Of several classes with one member there is an uncertainty of 0, not of -0.
    entropy(&classes).max(0.0)
}

fn orientation_entropy(network: &CaveNetwork) -> f64 {
    let mut classes = [0.0; 18];
    for &[from, to] in network.legs() {
        let [from, to] = [from, to].map(|station| network.stations()[station]);
        let [east, north] = [to[0] - from[0], to[1] - from[1]];
        let azimuth = east.atan2(north).to_degrees().rem_euclid(180.0);
        let class = (azimuth / 180.0 * classes.len() as f64) as usize;
        classes[class.min(classes.len() - 1)] += east.hypot(north);
    }
    if classes.iter().all(|&weight| weight == 0.0) { 0.0 } else { entropy(&classes).max(0.0) }
}

/// Pearson's correlation of the degrees at both ends of edges.
fn correlation(graph: &[Vec<usize>]) -> Option<f64> {
    let degree = |node: usize| graph[node].len() as f64;
    let ends =
        graph.iter().enumerate().flat_map(|(from, list)| list.iter().map(move |&to| (from, to)));
    let ends: Vec<[f64; 2]> = ends.map(|(from, to)| [degree(from), degree(to)]).collect();
    // Each edge counts both ways, so both ends have the same mean.
    let mean = ends.iter().map(|pair| pair[0]).sum::<f64>() / ends.len() as f64;
    let square: f64 = ends.iter().map(|pair| (pair[0] - mean).powi(2)).sum();
    let product: f64 = ends.iter().map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum();
    (square > 0.0).then(|| product / square)
}

/// Mean over the parts, weighted by their numbers of nodes.
fn average_shortest_path(graph: &[Vec<usize>], steps: &[u64]) -> f64 {
    let parts = components(graph);
    let weighted = parts.iter().filter(|part| part.len() > 1).map(|part| {
        let sum: u64 = part.iter().map(|&node| steps[node]).sum();
        sum as f64 / (part.len() - 1) as f64
    });
    weighted.sum::<f64>() / graph.len() as f64
}

/// Mean difference from the largest betweenness, as a share of the pairs of other nodes.
fn dominance(betweenness: &[f64]) -> Option<f64> {
    let count = betweenness.len() as f64;
    let most = betweenness.iter().fold(0.0, |most: f64, &value| most.max(value));
    let pairs = (count - 1.0) * (count - 2.0) / 2.0;
    let sum: f64 = betweenness.iter().map(|value| most - value).sum();
    (betweenness.len() > 2).then(|| sum / pairs / (count - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A star of four branches of lengths 1 to 4, the last one bent.
    #[test]
    fn a_star_has_the_numbers_of_a_star() {
        let stations = vec![
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [-2.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [0.0, -2.0, 0.0],
            [0.0, -2.0, 2.0],
        ];
        let network = CaveNetwork::new(stations, &[[0, 1], [0, 2], [0, 3], [0, 4], [4, 5]]);
        let shape = NetworkShape::of(&network.unwrap());
        assert_eq!((shape.branches, shape.length_m, shape.mean_branch_length_m), (4, 10.0, 2.5));
        let variation = shape.variation_of_length.unwrap();
        assert!((variation - (5.0_f64 / 3.0).sqrt() / 2.5).abs() < 1e-12);
        assert!((shape.length_entropy - 4.0_f64.ln() / 10.0_f64.ln()).abs() < 1e-12);
        let tortuosity = shape.tortuosity.unwrap();
        assert!((tortuosity - (3.0 + 2.0_f64.sqrt()) / 4.0).abs() < 1e-12);
        // North and south have 5 m, east and west 3 m; the vertical leg has none.
        let [a, b] = [5.0_f64 / 8.0, 3.0 / 8.0];
        let entropy = -(a * a.ln() + b * b.ln()) / 18.0_f64.ln();
        assert!((shape.orientation_entropy - entropy).abs() < 1e-12);
        assert_eq!((shape.mean_degree, shape.correlation_of_degree), (1.6, Some(-1.0)));
        assert_eq!(shape.average_shortest_path, 1.6);
        assert_eq!(shape.central_point_dominance, Some(1.0));
        assert_eq!((shape.cyclomatic_number, shape.components), (0, 1));
    }
}
