use super::*;
use landform_graph::marching::Relaxation;
use landform_graph::{Boundary, Connectivity};

fn plane(side: usize, connectivity: Connectivity) -> Lattice {
    Lattice::plane([side; 2], 1.0, connectivity, [Boundary::Open; 2]).unwrap()
}

fn fractal() -> Dendrite {
    Dendrite {
        endpoints: Endpoints::ByCost { count: 12, cost: 0.7, spread: 0.1 },
        rounds: Rounds { count: 4, ..Rounds::default() },
        ..Dendrite::default()
    }
}

fn grown(form: &Dendrite, lattice: &Lattice) -> Grown {
    form.grow(Path::new(""), lattice, 5).unwrap()
}

/// Parents come first, are neighbours, and no node is taken twice: a forest.
fn is_forest(grown: &Grown, lattice: &Lattice) {
    let mut taken = vec![false; lattice.node_count()];
    for (number, (&node, parent)) in grown.nodes.iter().zip(&grown.parents).enumerate() {
        assert!(!std::mem::replace(&mut taken[node], true));
        let Some(parent) = parent.map(|parent| parent as usize) else { continue };
        assert!(parent < number);
        assert!(lattice.neighbours(node).any(|edge| edge.node == grown.nodes[parent]));
    }
}

#[test]
fn dendrites_are_forests_on_all_lattices() {
    let volume = Lattice::volume([20; 3], 1.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap();
    let four = plane(60, Connectivity::Four);
    for lattice in
        [four, plane(60, Connectivity::FourEight), plane(60, Connectivity::Eight), volume]
    {
        for former_paths in [0.0, 0.3, 1.0] {
            let two = vec![[0.2, 0.2, 0.0], [0.8, 0.7, 0.5]];
            let form = Dendrite { generators: two, former_paths, ..fractal() };
            let grown = grown(&form, &lattice);
            is_forest(&grown, &lattice);
            assert_eq!(grown.parents.iter().filter(|parent| parent.is_none()).count(), 2);
            assert!(grown.endpoints > 12 && grown.rounds.iter().max() == Some(&3));
        }
    }
}

/// Every path of the first round is a cheapest one from its end to the generator.
#[test]
fn paths_are_cheapest_paths() {
    let lattice = plane(50, Connectivity::Eight);
    let form = Dendrite { endpoints: Endpoints::Random { count: 40 }, ..Dendrite::default() };
    let grown = grown(&form, &lattice);
    let table = form.weights.table(&lattice, None, 5).unwrap();
    let mut costs = vec![f64::INFINITY; lattice.node_count()];
    let root = grown.nodes[0];
    costs[root] = 0.0;
    least_costs(&lattice, &table, 50.0, &[root], &mut costs, &mut Relaxation::new()).unwrap();
    for (number, &node) in grown.nodes.iter().enumerate().skip(1) {
        let parent = grown.nodes[grown.parents[number].unwrap() as usize];
        let edge = lattice.neighbours(node).find(|edge| edge.node == parent).unwrap();
        assert_eq!(
            costs[parent] + table.weight(parent, &reverse(&lattice, node, &edge)),
            costs[node]
        );
    }
}

fn reverse(lattice: &Lattice, node: usize, edge: &landform_graph::Edge) -> landform_graph::Edge {
    lattice.neighbours(edge.node).find(|back| back.node == node).unwrap()
}

/// Paths wind more where weights differ more (figure 4.4 of Xu 2008).
#[test]
fn tortuosity_grows_with_the_exponent() {
    for connectivity in [Connectivity::Four, Connectivity::Eight] {
        let lattice = plane(200, connectivity);
        let tortuosity = |exponent: f64| {
            let weights = EdgeWeights { exponent, range: 30.0, ..EdgeWeights::default() };
            let endpoints = Endpoints::Random { count: 60 };
            let form = Dendrite { weights, endpoints, ..Dendrite::default() };
            form.branching(Path::new(""), &lattice, 1).unwrap().tortuosity()
        };
        let winding = [0.0, 1.0, 4.0, 8.0].map(tortuosity);
        assert!(winding.windows(2).all(|pair| pair[1] > pair[0]), "{winding:?}");
    }
}

/// A bias towards the west draws the nodes of the dendrite there.
#[test]
fn branches_turn_towards_cheap_places() {
    let lattice = plane(81, Connectivity::Eight);
    let west = |cheap: CheapPlace| {
        let biases = vec![WeightBias { cheap, strength: 20.0 }];
        let weights = EdgeWeights { biases, ..EdgeWeights::default() };
        let listed = [0.1, 0.3, 0.5, 0.7, 0.9].map(|north| [0.5, north, 0.0]).to_vec();
        let generators = vec![[0.5, 0.0, 0.0]];
        let form = Dendrite {
            weights,
            generators,
            endpoints: Endpoints::Listed(listed),
            ..Dendrite::default()
        };
        let grown = grown(&form, &lattice);
        let columns = grown.nodes.iter().map(|&node| lattice.coordinates(node)[0] as f64);
        columns.sum::<f64>() / grown.nodes.len() as f64
    };
    let [to_west, to_east] = [CheapPlace::West, CheapPlace::East].map(west);
    assert!(to_west < 35.0 && to_east > 45.0, "{to_west} {to_east}");
}

/// Later paths share the routes of earlier ones where these are cheaper.
#[test]
fn cheap_former_paths_are_shared() {
    let lattice = plane(120, Connectivity::Eight);
    let nodes = |former_paths: f64| {
        let rounds = Rounds { count: 3, cost: 0.4, ..Rounds::default() };
        grown(&Dendrite { former_paths, rounds, ..fractal() }, &lattice).nodes.len()
    };
    let [dear, cheap, free] = [1.0, 0.3, 0.0].map(nodes);
    let least = dear / 20;
    assert!(dear > cheap + least && dear > free + least, "{dear} {cheap} {free}");
}

#[test]
fn nothing_grows_outside_of_the_mask() {
    let lattice = plane(60, Connectivity::Eight);
    let ring = vec![[10.0, 10.0], [50.0, 10.0], [30.0, 55.0]];
    let mask = Mask { of: crate::MaskSource::Rings(vec![ring]), ..Mask::default() };
    let biases = vec![WeightBias { cheap: CheapPlace::Core, strength: 5.0 }];
    let weights = EdgeWeights { biases, ..EdgeWeights::default() };
    let form = Dendrite { within: Some(mask.clone()), weights, ..fractal() };
    let grown = grown(&form, &lattice);
    is_forest(&grown, &lattice);
    let values = mask.generate(&lattice, 0).unwrap();
    assert!(grown.nodes.len() > 100 && grown.nodes.iter().all(|&node| values[node] >= 0.5));
}

/// Refined paths are a forest of as many tips, pass the sub-lattices of the old nodes, and wind more.
#[test]
fn refined_paths_keep_to_their_sub_lattices() {
    let volume = Lattice::volume([12; 3], 2.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap();
    for lattice in [plane(40, Connectivity::Four), plane(40, Connectivity::Eight), volume] {
        let rough = Dendrite { endpoints: Endpoints::Random { count: 12 }, ..Dendrite::default() };
        let fine = Dendrite { refinement: Refined { parts: 7, faith: 0.6 }, ..rough.clone() };
        let [old, new] =
            [rough, fine].map(|form| form.branching(Path::new(""), &lattice, 2).unwrap());
        let tips = |lines: &Branching| lines.branches().len();
        assert_eq!(tips(&old), tips(&new));
        assert!(new.len() > 4 * old.len());
        let half = 0.5 * lattice.spacing() + 1e-9;
        for position in &new.positions {
            let is_home = |node: &[f64; 3]| (0..3).all(|n| (node[n] - position[n]).abs() < half);
            assert!(old.positions.iter().any(is_home), "{position:?}");
        }
        let longest = (0..new.len()).map(|node| new.piece_m(node)).fold(0.0, f64::max);
        assert!(longest < lattice.spacing() / 7.0 * 1.75);
    }
}

#[test]
fn light_is_full_on_branches_and_fades() {
    let lattice = plane(80, Connectivity::Eight);
    let width = BranchWidth::Taper { root_m: 4.0, tip_m: 1.0, share: 0.5 };
    let form = Dendrite { width, show: DendriteShown::Intensity, ..fractal() };
    let light = form.generate(&lattice, 5).unwrap();
    assert!(grown(&form, &lattice).nodes.iter().all(|&node| light[node] == 1.0));
    let thin = Dendrite { width: BranchWidth::Even { radius_m: 0.5 }, ..form.clone() };
    let thin = thin.generate(&lattice, 5).unwrap();
    assert!(thin.iter().sum::<f64>() < light.iter().sum::<f64>());
    assert!(light.iter().all(|light| (0.0..=1.0).contains(light)) && light.contains(&0.0));
}

#[test]
fn what_means_nothing_is_refused() {
    let lattice = plane(20, Connectivity::Four);
    let refused = |change: fn(&mut Dendrite)| {
        let mut form = fractal();
        change(&mut form);
        form.generate(&lattice, 1).unwrap_err().to_string()
    };
    assert!(refused(|form| form.generators.clear()).contains("generators"));
    assert!(refused(|form| form.generators[0][1] = f64::NAN).contains("generators"));
    assert!(refused(|form| form.refinement.parts = 4).contains("odd"));
    assert!(refused(|form| form.weights.exponent = 9.0).contains("range^exponent"));
    assert!(refused(|form| form.former_paths = -0.1).contains("former_paths"));
    assert!(refused(|form| form.rounds.attenuation = 0.0).contains("attenuation"));
    let far = vec![vec![[1e3, 1e3], [2e3, 1e3], [1e3, 2e3]]];
    let nowhere = Mask { of: crate::MaskSource::Rings(far), ..Mask::default() };
    let form = Dendrite { within: Some(nowhere), ..fractal() };
    assert!(form.generate(&lattice, 1).unwrap_err().to_string().contains("nothing may grow"));
}

#[test]
fn tiny_lattices_do_no_harm() {
    for side in [1, 2] {
        let form =
            Dendrite { rounds: Rounds { count: 3, ..Rounds::default() }, ..Dendrite::default() };
        assert!(form.generate(&plane(side, Connectivity::Eight), 1).is_ok());
    }
}
