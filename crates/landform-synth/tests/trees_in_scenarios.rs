//! Construction trees as scenario files write them.

use std::path::Path;
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;

/// What the reader of scenarios says to a tree; nothing to a good one.
fn messages(tree: &str) -> String {
    let mut registry = Registry::new();
    landform_synth::register(&mut registry);
    let text = format!(
        "(title: \"tree\", domain: Grid(), stages: [],\n\
         initial: [(field: \"bed\", from: ConstructionTree(\nof: {tree}))])"
    );
    let source = ScenarioSource::from_text("tree.ron", &text, Path::new(""));
    source.parse(&Arc::new(registry)).err().unwrap_or_default()
}

#[test]
fn trees_are_read_and_checked_in_every_node() {
    let good = "Replace(
        ground: Blend([
            Noise(amplitude_m: 80.0, octaves: 4),
            Weigh(of: Disc(center_m: (900.0, 800.0), noise: (hurst: 0.9)), weight: 3.0),
            Deform(of: Bell(), by: Canyonism(low_m: 0.0, high_m: 90.0)),
            Deform(of: Plane(), by: Through([(0.0, 1.0), (1.0, 3.0)])),
        ]),
        by: Warp(
            of: Place(of: Curve(points_m: [(0, 0, 9), (500, 20, 3)]), at_m: (10, 20), turn_deg: 5),
            by: (amplitude_m: 50.0),
        ),
    )";
    assert_eq!(messages(good), "");
    let found = messages(&good.replace("weight: 3.0", "weight: -3.0"));
    assert!(found.contains("ground[1].weight: -3 is out of range"), "{found}");
    assert!(found.contains("tree.ron:6:") && found.contains("at least 0"), "{found}");
    let found = messages(&good.replace("hurst: 0.9", "hurst: 9.0"));
    assert!(found.contains("hurst: 9 is out of range"), "{found}");
    let found = messages(&good.replace("Bell()", "Bel()"));
    assert!(found.contains("Bel") && found.contains("Bell"), "{found}");
    let found = messages(&good.replace("turn_deg", "turn"));
    assert!(found.contains("turn") && found.contains("turn_deg"), "{found}");
}

#[test]
fn trees_that_are_nested_too_deep_are_refused() {
    for levels in [200, 10_000] {
        let tree = format!("{}Plane(){}", "Weigh(of: ".repeat(levels), ")".repeat(levels));
        let found = messages(&tree);
        assert!(found.contains("brackets are nested too deep"), "{found}");
        let tree = format!("{}Plane(){}", "Blend([".repeat(levels), "])".repeat(levels));
        assert!(messages(&tree).contains("brackets are nested too deep"));
    }
}
