//! The coast against what percolation theory knows.

use landform_analysis::{LevelSetEdge, Polyline, ScaleRange, divider_dimension, level_sets};
use landform_coast::coast::{Coast, CoastSettings, Front, Perimeter, Weakening, islands};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;

/// A strip of land with the sea in the south, periodic from west to east.
struct Strip {
    lattice: Lattice,
    land: Vec<u8>,
}

impl Strip {
    fn new(size: [usize; 2], connectivity: Connectivity) -> Self {
        let boundary = [Boundary::Periodic, Boundary::Open];
        let lattice = Lattice::plane(size, 1.0, connectivity, boundary).unwrap();
        let inland = lattice.node_count() - size[0];
        let land = (0..lattice.node_count()).map(|node| u8::from(node < inland)).collect();
        Self { lattice, land }
    }

    /// Lets the sea erode rock until the coast rests.
    fn erode(&mut self, settings: CoastSettings, mut rock: Vec<f64>) {
        let mut coast = Coast::new(&self.lattice, settings, &self.land, &rock).unwrap();
        let initial = coast.shore().total();
        while !coast.step(&mut self.land, &mut rock, initial).unwrap().eroded.is_empty() {}
    }

    /// Land without its islands.
    fn mainland(&self) -> Vec<u8> {
        let islands = islands(&self.lattice, &self.land);
        let mut mainland = vec![0; self.land.len()];
        let largest = islands.iter().max_by_key(|island| island.nodes.len()).unwrap();
        largest.nodes.iter().for_each(|&node| mainland[node as usize] = 1);
        mainland
    }

    /// Nodes with the number of their row, from the south.
    fn rows(&self) -> impl Iterator<Item = (usize, usize)> {
        let [width, height, _] = self.lattice.size();
        (0..self.land.len()).map(move |node| (node, height - 1 - node / width))
    }
}

/// Random numbers from 0 to 1, one a node.
fn noise(lattice: &Lattice, seed: u64) -> Vec<f64> {
    let random = RandomStream::new(seed, "rock");
    (0..lattice.node_count()).map(|node| random.unit(0, node, 0)).collect()
}

/// The percolation threshold and the front of gradient percolation: the share p of weak rock sinks from row
/// to row by `1 / height`.
fn front(connectivity: Connectivity, width: usize, height: f64, seed: u64) -> (f64, Front) {
    // Enough rows on either side of the threshold that the front never meets the ends: a fjord that
    // came through would cut the mainland in two.
    let middle = match connectivity {
        Connectivity::FourEight => 0.5,
        Connectivity::Eight => 0.407,
        _ => 0.593,
    };
    let first = (middle + 0.3_f64).min(1.0);
    let mut strip = Strip::new([width, (0.9 * height) as usize], connectivity);
    let share = |row: usize| first - row as f64 / height;
    let mut rock = noise(&strip.lattice, seed);
    // Rock falls where its random number is below p.
    strip.rows().for_each(|(node, row)| rock[node] += 1.0 - share(row));
    let settings = CoastSettings {
        force: 1.0,
        attenuation: 0.0,
        perimeter: Perimeter::Whole,
        weakening: Weakening::None,
        ..CoastSettings::default()
    };
    strip.erode(settings, rock);
    let front = Front::new(&strip.lattice, &strip.land).unwrap();
    (first - front.reach / height, front)
}

/// Slope of the least-squares line.
fn slope(points: &[[f64; 2]]) -> f64 {
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let product: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    product / points.iter().map(|point| (point[0] - x).powi(2)).sum::<f64>()
}

/// Sapoval, Rosso and Gouyet (1985); Grossman and Aharony (1987): in a gradient of concentration
/// the front has a width, a shore and an accessible shore that grow as powers of 1 / gradient,
/// exactly 4/7, 3/7 and 4/21.
#[test]
fn fronts_in_a_gradient_have_the_exponents_of_percolation() {
    // Of a single seed the shore's exponent scatters by 0.02 to 0.03.
    const SEEDS: u64 = 4;
    let heights = [64.0, 128.0, 256.0, 512.0, 1024.0];
    let seeds =
        |height: f64| (0..SEEDS).map(move |seed| front(Connectivity::Four, 4096, height, seed).1);
    let fronts: Vec<Front> = heights.iter().flat_map(|&height| seeds(height)).collect();
    let exponent = |of: fn(&Front) -> f64| {
        let points: Vec<[f64; 2]> = heights
            .iter()
            .zip(fronts.chunks(SEEDS as usize))
            .map(|(height, fronts)| [height.ln(), fronts.iter().map(of).sum::<f64>().ln()])
            .collect();
        slope(&points)
    };
    let found =
        [exponent(|front| front.width), exponent(|f| f.shore), exponent(|f| f.accessible_shore)];
    let expected = [4.0 / 7.0, 3.0 / 7.0, 4.0 / 21.0];
    println!("width, hull, accessible: {found:.3?}, exactly {expected:.3?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 0.03, "{found} {expected}");
    }
}

/// The threshold of site percolation on the square lattice with four neighbours is 0.592746, with
/// eight one less that; on the 4-8 mesh, whose faces are triangles, it is 1/2.
#[test]
fn without_weakening_the_sea_stops_at_the_percolation_threshold() {
    for (connectivity, threshold) in [
        (Connectivity::Four, 0.592_746),
        (Connectivity::FourEight, 0.5),
        (Connectivity::Eight, 0.407_254),
    ] {
        let found = front(connectivity, 2048, 1024.0, 1).0;
        println!("{connectivity:?}: {found:.4}, exactly {threshold}");
        assert!((found - threshold).abs() < 0.006, "{connectivity:?}: {found}");
    }
}

/// Dimension of the longest shore of a strip at rest under a force that the whole shore weakens
/// a little, by dividers from 4 to 64 spacings.
fn dimension_at_rest(size: [usize; 2], seed: u64) -> f64 {
    let mut strip = Strip::new(size, Connectivity::Four);
    let rock = noise(&strip.lattice, seed);
    let settings = CoastSettings {
        force: 0.55,
        attenuation: 0.001,
        perimeter: Perimeter::Whole,
        weakening: Weakening::Power,
        ..CoastSettings::default()
    };
    strip.erode(settings, rock);
    let mainland: Vec<f64> = strip.mainland().iter().map(|&land| f64::from(land)).collect();
    let lines = level_sets(&mainland, size, 0.5, LevelSetEdge::End).unwrap();
    let longest = lines.iter().max_by_key(|line| line.points.len()).unwrap();
    let line: Polyline = longest.polyline([1.0; 2]).unwrap();
    let range = ScaleRange::new(4.0, 64.0).unwrap();
    divider_dimension(&[line], &range).unwrap().dimension
}

/// Sapoval, Baldassarri and Gabrielli (2004): under a force that the whole shore weakens a little
/// the coast comes to rest with a fractal dimension of 4/3, however large the map.
#[test]
fn coasts_at_rest_have_a_dimension_of_four_thirds() {
    for (size, seed) in [
        ([1024, 1024], 1),
        ([1024, 1024], 2),
        ([2048, 1024], 1),
        ([2048, 1024], 2),
        ([4096, 1024], 1),
    ] {
        let dimension = dimension_at_rest(size, seed);
        println!("{size:?}: dimension {dimension:.3}");
        assert!((dimension - 4.0 / 3.0).abs() < 0.05, "{size:?}: {dimension}");
    }
}
