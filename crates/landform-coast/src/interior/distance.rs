//! How far the level sets below and above a node are.

use landform_graph::marching::Front;
use landform_graph::{Connectivity, Edge, Lattice};

use super::{LevelSets, LevelSetsError};

/// Which level set is looked for: of a node on a level set itself, the one before or after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Below,
    Above,
}

/// What a node learns from a neighbour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Link {
    /// The neighbour is on the level set looked for, or beyond it.
    Source,
    /// The neighbour knows the way.
    Way,
}

/// The nearest node of the level set on one side of every node, reached without crossing
/// another level set.
pub(super) struct Nearest {
    /// Distance in metres; infinite where there is none.
    pub distance: Vec<f64>,
    /// That node; the node itself where there is none.
    pub source: Vec<u32>,
}

impl Nearest {
    /// Finds the nearest nodes.
    ///
    /// In the order of distance, each node takes over the source of a neighbour if that is the
    /// nearest that it knows. Distances are straight: exact where the straight way does not leave
    /// the band, but for a few nodes to which none of their neighbours can tell their source.
    pub fn new(
        lattice: &Lattice,
        levels: &LevelSets<'_>,
        side: Side,
    ) -> Result<Self, LevelSetsError> {
        let ([width, height, _], [across, down, _]) = (lattice.size(), lattice.boundary());
        let (size, boundary) = ([width, height], [across, down]);
        let eight = Lattice::plane(size, lattice.spacing(), Connectivity::Eight, boundary)?;
        let mut search = Search::new(&eight, levels, side);
        let starts = search.starts();
        Front::new().march(&eight, &starts, |from, edge| search.pass_on(from, edge))?;
        Ok(search.nearest)
    }
}

/// State of the search.
struct Search<'a> {
    lattice: &'a Lattice,
    levels: &'a LevelSets<'a>,
    side: Side,
    nearest: Nearest,
    /// Spacings east and south from the source to each node.
    way: Vec<[f64; 2]>,
}

impl<'a> Search<'a> {
    fn new(lattice: &'a Lattice, levels: &'a LevelSets<'a>, side: Side) -> Self {
        let nodes = lattice.node_count();
        let nearest =
            Nearest { distance: vec![f64::INFINITY; nodes], source: (0..nodes as u32).collect() };
        Self { lattice, levels, side, nearest, way: vec![[0.0; 2]; nodes] }
    }

    fn link(&self, from: usize, to: usize) -> Option<Link> {
        let [from, to] = [from, to].map(|node| self.levels.rank(node));
        let (nearer, further) = match self.side {
            Side::Below => (from, to),
            Side::Above => (to, from),
        };
        let between = from % 2 == 1;
        match (nearer < further, between) {
            (true, true) if further == nearer + 1 => Some(Link::Way),
            (true, _) => Some(Link::Source),
            (false, true) if nearer == further => Some(Link::Way),
            _ => None,
        }
    }

    /// Nodes beside a source, with their distances.
    fn starts(&mut self) -> Vec<(usize, f64)> {
        for node in 0..self.lattice.node_count() {
            for edge in self.lattice.neighbours(node) {
                if self.link(edge.node, node) == Some(Link::Source) {
                    let way = [-edge.step[0], -edge.step[1]].map(f64::from);
                    self.offer(node, edge.node as u32, way);
                }
            }
        }
        let distances = self.nearest.distance.iter().copied().enumerate();
        distances.filter(|(_, distance)| distance.is_finite()).collect()
    }

    /// Tells a neighbour the way, and returns when it is due if it takes it.
    fn pass_on(&mut self, from: usize, edge: &Edge) -> Option<f64> {
        if self.link(from, edge.node) != Some(Link::Way) {
            return None;
        }
        let [east, south] = self.way[from];
        let way = [east + f64::from(edge.step[0]), south + f64::from(edge.step[1])];
        let taken = self.offer(edge.node, self.nearest.source[from], way);
        taken.then(|| self.nearest.distance[edge.node])
    }

    /// Whether a node takes a source because it is nearer than what it knows.
    fn offer(&mut self, node: usize, source: u32, way: [f64; 2]) -> bool {
        let distance = self.lattice.spacing() * way[0].hypot(way[1]);
        let nearer = distance < self.nearest.distance[node];
        if nearer {
            self.nearest.distance[node] = distance;
            self.nearest.source[node] = source;
            self.way[node] = way;
        }
        nearer
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Cone, random_levels};
    use super::*;

    /// Rings round a centre: distances along the radius.
    #[test]
    fn distances_between_rings_are_those_along_the_radius() {
        let cone = Cone::new(81, 10);
        let levels = cone.levels();
        let [below, above] = [Side::Below, Side::Above]
            .map(|side| Nearest::new(&cone.lattice, &levels, side).unwrap().distance);
        for node in 0..cone.lattice.node_count() {
            let inner = levels.band[node] > 0 && above[node].is_finite();
            if inner && levels.on_level[node] == 0 {
                let sum = below[node] + above[node];
                assert!((8.4..11.7).contains(&sum), "{sum} at {node}");
            }
        }
    }

    /// The plain search: every pair of nodes.
    #[test]
    fn open_bands_have_the_distances_of_all_pairs() {
        let cone = Cone::new(41, 8);
        let levels = cone.levels();
        let found = Nearest::new(&cone.lattice, &levels, Side::Below).unwrap();
        let lattice = &cone.lattice;
        for node in 0..lattice.node_count() {
            // Rings are seen from outside without a bend.
            if levels.on_level[node] > 0 || levels.band[node] == 0 {
                continue;
            }
            let on_ring = |other: &usize| {
                levels.on_level[*other] > 0 && levels.band[*other] == levels.band[node]
            };
            let place = lattice.position(node);
            let all = (0..lattice.node_count()).filter(on_ring);
            let least = all.map(|other| lattice.position(other).distance(place));
            let least = least.fold(f64::INFINITY, f64::min);
            assert!((found.distance[node] - least).abs() < 0.35, "{node}");
            assert!(found.distance[node] >= least - 1e-12);
        }
    }

    #[test]
    fn no_way_crosses_a_level_set() {
        let (lattice, band, on_level) = random_levels([40, 30], 3);
        let levels = LevelSets { band: &band, on_level: &on_level, interval_m: 1.0 };
        let found = Nearest::new(&lattice, &levels, Side::Below).unwrap();
        for node in 0..lattice.node_count() {
            if found.distance[node].is_finite() {
                let source = found.source[node] as usize;
                assert!(levels.rank(source) < levels.rank(node));
            }
        }
    }
}
