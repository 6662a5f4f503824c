//! Trees that are refused.

use super::*;

pub(super) fn refusal(node: Node) -> String {
    let tree = ConstructionTree { ground_m: 0.0, of: node };
    tree.terrain(SPACING, 0).unwrap_err().to_string()
}

#[test]
fn bad_trees_are_refused_where_they_are_bad() {
    let curve = |points_m: Vec<[f64; 3]>, profile_m: Vec<[f64; 2]>| {
        Node::Curve(Curve { points_m, profile_m, reach_m: 10.0 })
    };
    let ends = vec![[0.0; 3], [9.0, 0.0, 0.0]];
    let hidden = |node: Node| onto(Node::Carve, level(0.0), Node::Blend(vec![level(1.0), node]));
    for (node, message) in [
        (hidden(disc(0.0, 0.0, -1.0, 0.0)), "of.by[1]: ConstructionTree: radius_m is -1"),
        (hidden(disc(f64::NAN, 0.0, 1.0, 0.0)), "of.by[1]: ConstructionTree: center_m is NaN"),
        (curve(vec![], vec![]), "of: ConstructionTree: points_m: 0 points"),
        (curve(vec![[1.0; 3]], vec![]), "points_m: 1 points; a curve takes at least two"),
        (curve(vec![[1.0; 3]; 3], vec![]), "points_m: all points are at one place"),
        (curve(ends.clone(), vec![[2.0, 0.0], [2.0, 1.0]]), "profile_m: 2 follows 2"),
        (curve(ends, vec![[f64::NAN, 0.0], [2.0, 1.0]]), "profile_m: 2 follows NaN"),
        (Node::Blend(vec![]), "of: ConstructionTree: Blend([]) blends nothing"),
        (
            Node::Disc(Disc {
                noise: Some(FractalNoise { wavelength_m: 1.0, ..noise() }),
                ..Default::default()
            }),
            "of.noise: FractalNoise: wavelength_m is 1; it must be from 10",
        ),
        (
            Node::Deform(Deform {
                of: Box::new(level(0.0)),
                by: VerticalMap::Through(vec![[1.0, 1.0]]),
            }),
            "by: 1 points; there must be at least 2",
        ),
        (
            Node::Deform(Deform {
                of: Box::new(level(0.0)),
                by: VerticalMap::Glaciation(SelectiveScaling {
                    low_m: 9.0,
                    high_m: 1.0,
                    exponent: 2.0,
                }),
            }),
            "high_m is 1",
        ),
        (Node::Blend(vec![level(0.0); 10_000]), "more than 10000 nodes"),
        (curve(vec![[0.0; 3]; 100_001], vec![]), "more than 100000 points of curves and masks"),
    ] {
        let refused = refusal(node);
        assert!(refused.contains(message), "{refused}\n{message}");
    }
}

#[test]
fn deep_trees_are_refused() {
    let mut node = level(0.0);
    for _ in 0..10_000 {
        node = Node::Weigh(Weigh { of: Box::new(node), weight: 1.0, mask: None });
    }
    assert!(refusal(node).contains("more than 50 levels"));
    let mut node = level(0.0);
    for _ in 0..49 {
        node = onto(Node::Carve, node, level(1.0));
    }
    let tree = ConstructionTree { ground_m: 0.0, of: node };
    assert_eq!(tree.terrain(1.0, 0).unwrap().bounds().slope, 0.0);
}

#[test]
fn periodic_axes_and_volumes_are_refused() {
    let tree = ConstructionTree::default();
    let periodic =
        Lattice::plane([8; 2], 1.0, Connectivity::Eight, [Boundary::Open, Boundary::Periodic]);
    let refused = tree.generate(&periodic.unwrap(), 0).unwrap_err().to_string();
    assert!(refused.contains("periodic y axis"), "{refused}");
    let open = [Boundary::Open; 3];
    let volume = Lattice::volume([4; 3], 1.0, Connectivity::Voxel26, open).unwrap();
    assert!(tree.generate(&volume, 0).is_err());
}
