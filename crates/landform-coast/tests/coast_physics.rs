//! The coast against what percolation theory knows.

use landform_analysis::{LevelSetEdge, Polyline, ScaleRange, divider_dimension, level_sets};
use landform_coast::coast::{Coast, CoastSettings, Perimeter, Shore, Weakening, islands, spacings};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::RandomStream;

/// A strip of land with the sea in the north, periodic from west to east.
struct Strip {
    lattice: Lattice,
    land: Vec<u8>,
}

impl Strip {
    fn new(size: [usize; 2], connectivity: Connectivity) -> Self {
        let boundary = [Boundary::Periodic, Boundary::Open];
        let lattice = Lattice::plane(size, 1.0, connectivity, boundary).unwrap();
        let land = (0..lattice.node_count()).map(|node| u8::from(node >= size[0])).collect();
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

    fn rows(&self) -> impl Iterator<Item = (usize, usize)> {
        let width = self.lattice.width();
        (0..self.land.len()).map(move |node| (node, node / width))
    }
}

/// Random numbers from 0 to 1, one a node.
fn noise(lattice: &Lattice, seed: u64) -> Vec<f64> {
    let random = RandomStream::new(seed, "rock");
    (0..lattice.node_count()).map(|node| random.unit(0, node, 0)).collect()
}

/// A front of gradient percolation: the share p of weak rock sinks from row to row by `1 / height`.
struct Front {
    /// Mean of p over the shore of the mainland: the percolation threshold.
    threshold: f64,
    /// Standard deviation of its rows.
    width: f64,
    /// Shore of the mainland.
    hull: f64,
    /// Shore that the sea reaches through more than the narrowest gates.
    accessible: f64,
}

fn front(connectivity: Connectivity, width: usize, height: f64, seed: u64) -> Front {
    // Enough rows on either side of the threshold that the front never meets the ends.
    let middle = match connectivity {
        Connectivity::FourEight => 0.5,
        Connectivity::Eight => 0.407,
        _ => 0.593,
    };
    let first = (middle + 0.3_f64).min(1.0);
    let mut strip = Strip::new([width, (0.6 * height) as usize], connectivity);
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
    let mainland = strip.mainland();
    let shore = Shore::new(&strip.lattice, &mainland);
    let total = shore.total() as f64;
    let moment = |of: &dyn Fn(usize) -> f64| {
        let weighted = strip.rows().map(|(node, row)| f64::from(shore.length(node)) * of(row));
        weighted.sum::<f64>() / total
    };
    let mean = moment(&|row| row as f64);
    Front {
        threshold: moment(&share),
        width: moment(&|row| (row as f64 - mean).powi(2)).sqrt(),
        hull: spacings(shore.total()),
        accessible: accessible(&strip.lattice, &mainland),
    }
}

/// Border of the sea that stays one node away from land and is joined to the north.
fn accessible(lattice: &Lattice, mainland: &[u8]) -> f64 {
    let [width, height, _] = lattice.size();
    let clear = |node: usize| {
        let [x, y] = [node % width, node / width];
        (-1..=1).all(|south: isize| {
            (-1..=1).all(|east: isize| {
                lattice.offset([x, y, 0], [east, south, 0]).is_none_or(|other| mainland[other] == 0)
            })
        })
    };
    let sides = Lattice::plane(
        [width, height],
        1.0,
        Connectivity::Four,
        [Boundary::Periodic, Boundary::Open],
    );
    let sides = sides.unwrap();
    let mut search = landform_graph::BreadthFirst::new();
    let north: Vec<usize> = (0..width).filter(|&node| clear(node)).collect();
    let reach = landform_graph::Reach::UNLIMITED;
    let sea = search.collect(&sides, &north, reach, |_, edge| clear(edge.node));
    let mut land = vec![1; mainland.len()];
    sea.iter().for_each(|visit| land[visit.node] = 0);
    spacings(Shore::new(&sides, &land).total())
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
    let heights = [64.0, 128.0, 256.0, 512.0, 1024.0];
    let fronts: Vec<Front> = heights
        .iter()
        .flat_map(|&height| (0..2).map(move |seed| front(Connectivity::Four, 4096, height, seed)))
        .collect();
    let exponent = |of: fn(&Front) -> f64| {
        let points: Vec<[f64; 2]> = heights
            .iter()
            .zip(fronts.chunks(2))
            .map(|(height, pair)| [height.ln(), pair.iter().map(of).sum::<f64>().ln()])
            .collect();
        slope(&points)
    };
    let found = [exponent(|front| front.width), exponent(|f| f.hull), exponent(|f| f.accessible)];
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
        let found = front(connectivity, 2048, 1024.0, 1).threshold;
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
