//! Wind-blown dunes against published and measured laws.
//!
//! The canonical set of Werner (1995) and Momiji (2000): nodes three slab heights apart, hops
//! of five nodes, 0.6 and 0.4 to stay on sand and on bare ground, a shadow of 15 degrees,
//! repose at a step of two slabs.

use landform_dunes::dunes::{
    AvalancheSettings, DuneSettings, Engine, Rose, Shadow, ShadowSettings, TransportSettings, Wind,
    bare_percent, crest_orientation, crossing_spacing_m, reference,
};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_sim::random::{RandomStream, unit};
use std::f64::consts::TAU;

/// A torus of nodes three slab heights (3 m) apart.
fn torus(size: [usize; 2], connectivity: Connectivity) -> Lattice {
    Lattice::plane(size, 3.0, connectivity, [Boundary::Periodic; 2]).unwrap()
}

fn canonical(rose: Rose) -> DuneSettings {
    let transport = TransportSettings { slab_m: 1.0, hop_m: 15.0, ..Default::default() };
    let repose_deg = (2.0_f64 / 3.0).atan().to_degrees();
    let avalanche = AvalancheSettings { repose_deg, ..Default::default() };
    DuneSettings { rose, transport, avalanche }
}

fn steady(towards_deg: f64) -> Rose {
    Rose { winds: vec![Wind::steady(towards_deg)] }
}

const SHADOW: ShadowSettings = ShadowSettings { angle_deg: 15.0, reach_m: None };

/// Whole slabs spread at random, `mean` of them on average.
fn noise(lattice: &Lattice, mean: u32, seed: u64) -> Vec<f64> {
    let random = RandomStream::new(seed, "sand");
    let slabs = |node| unit(random.block(0, node, 0)[0]) * f64::from(2 * mean + 1);
    (0..lattice.node_count()).map(|node| slabs(node).floor()).collect()
}

/// Ticks `from..to` of wind over a flat hard bed.
fn blow(lattice: &Lattice, settings: DuneSettings, sand: &mut [f64], ticks: std::ops::Range<u64>) {
    let mut engine = Engine::new(lattice.clone(), settings, 3).unwrap();
    let mut shadow = Shadow::new(SHADOW).unwrap();
    let bed = vec![0.0; sand.len()];
    for tick in ticks {
        engine.tick(&bed, sand, tick, &mut shadow).unwrap();
    }
}

fn spread(sand: &[f64]) -> f64 {
    let mean = sand.iter().sum::<f64>() / sand.len() as f64;
    (sand.iter().map(|sand| (sand - mean).powi(2)).sum::<f64>() / sand.len() as f64).sqrt()
}

/// A ridge across the wind with sides of one in three, `height` slabs at the crest.
fn ridge(lattice: &Lattice, height: f64) -> Vec<f64> {
    let away = |node: usize| (node % lattice.width()) as f64 - lattice.width() as f64 / 4.0;
    (0..lattice.node_count()).map(|node| (height - away(node).abs()).max(0.0).floor()).collect()
}

/// Mean column of the sand on the ring of columns, as an angle.
fn mean_angle(lattice: &Lattice, sand: &[f64]) -> f64 {
    let turn = TAU / lattice.width() as f64;
    let [x, y] = sand.iter().enumerate().fold([0.0; 2], |[x, y], (node, sand)| {
        let angle = turn * (node % lattice.width()) as f64;
        [x + sand * angle.cos(), y + sand * angle.sin()]
    });
    y.atan2(x)
}

/// Height of the profile averaged along the crest, in slabs.
fn crest(lattice: &Lattice, sand: &[f64]) -> f64 {
    let rows = lattice.height();
    let column = |x: usize| (0..rows).map(|row| sand[x + row * lattice.width()]).sum::<f64>();
    (0..lattice.width()).map(column).fold(0.0, f64::max) / rows as f64
}

/// Ticks until `ridge` has its shape, then the mean height of its crest in slabs and its
/// drift in nodes a tick over 200 more.
fn drift(height: f64) -> (f64, f64) {
    let lattice = torus([384, 24], Connectivity::Four);
    let mut sand = ridge(&lattice, height);
    blow(&lattice, canonical(steady(0.0)), &mut sand, 0..150);
    let (mut turned, mut heights) = (0.0, 0.0);
    for part in 0..10 {
        let before = mean_angle(&lattice, &sand);
        let first = 150 + 20 * part;
        blow(&lattice, canonical(steady(0.0)), &mut sand, first..first + 20);
        turned += (mean_angle(&lattice, &sand) - before).rem_euclid(TAU);
        heights += crest(&lattice, &sand) / 10.0;
    }
    (heights, turned / TAU * lattice.width() as f64 / 200.0)
}

/// Ridges drift by flux over height: c = 8.5 / (h + 3.7) nodes a tick, measured with two other
/// engines; Momiji and Warren (2000) give the law 1/h.
#[test]
fn ridges_drift_the_slower_the_higher_they_are() {
    for height in [12.0, 24.0, 40.0] {
        let (height, drift) = drift(height);
        let law = 8.5 / (height + 3.7);
        assert!((drift / law - 1.0).abs() < 0.06, "{height} slabs: {drift}, expected {law}");
    }
}

/// Below a least size the wind carries a dune away (Kroy, Sauermann and Herrmann 2002).
#[test]
fn low_ridges_disperse_and_higher_ones_survive() {
    let after = |height: f64| {
        let lattice = torus([256, 48], Connectivity::Four);
        let mut sand = ridge(&lattice, height);
        blow(&lattice, canonical(steady(0.0)), &mut sand, 0..300);
        crest(&lattice, &sand)
    };
    let [low, high] = [6.0, 12.0].map(after);
    assert!(low < 1.0, "the low ridge is {low} slabs high");
    assert!(high > 8.0, "the high ridge is {high} slabs high");
}

/// Wavelength in nodes.
fn wavelength(lattice: &Lattice, sand: &[f64]) -> f64 {
    crossing_spacing_m(lattice, sand, 0.0).unwrap().unwrap() / lattice.spacing()
}

/// Dunes merge: 37 nodes after 121 ticks and 61.8 after 457, a growth exponent of 0.3 to 0.4,
/// measured with another engine over four runs.
#[test]
fn wavelengths_grow_at_the_measured_rate() {
    let lattice = torus([1024, 128], Connectivity::Four);
    let mut sand = noise(&lattice, 10, 1);
    let mut from = 0;
    let [early, late] = [121, 457].map(|to| {
        blow(&lattice, canonical(steady(0.0)), &mut sand, from..to);
        from = to;
        wavelength(&lattice, &sand)
    });
    assert!((early - 37.0).abs() < 2.0, "{early} nodes after 121 ticks");
    assert!((late - 61.8).abs() < 5.0, "{late} nodes after 457 ticks");
    let exponent = (late / early).ln() / (457.0_f64 / 121.0).ln();
    assert!((0.30..0.44).contains(&exponent), "growth exponent {exponent}");
}

/// Four sub-steps with a quarter of the nodes each stand for polling one by one. Over ten
/// starts on 512x96 nodes the engine's heights spread 3.4 % wider than the serial model's, at
/// wavelengths 0.9 % shorter; of single runs the spread varies by 2 %.
#[test]
fn the_engine_agrees_with_the_serial_model() {
    let lattice = torus([256, 96], Connectivity::Four);
    let settings = canonical(steady(0.0));
    let bed = vec![0.0; lattice.node_count()];
    let mut lengths = [0.0; 2];
    let mut spreads = [0.0; 2];
    for seed in 1..=4 {
        let mut start = noise(&lattice, 10, seed);
        Engine::new(lattice.clone(), settings.clone(), 3)
            .unwrap()
            .settle(&bed, &mut start)
            .unwrap();
        let [mut engine, mut serial] = [start.clone(), start];
        blow(&lattice, settings.clone(), &mut engine, 0..121);
        for tick in 0..121 {
            let seed = (seed + 4, tick);
            reference::tick(&lattice, &settings, &SHADOW, seed, &bed, &mut serial).unwrap();
        }
        assert_eq!(engine.iter().sum::<f64>(), serial.iter().sum::<f64>());
        for (model, sand) in [&engine, &serial].into_iter().enumerate() {
            lengths[model] += wavelength(&lattice, sand) / 4.0;
            spreads[model] += spread(sand) / 4.0;
        }
    }
    assert!((lengths[0] / lengths[1] - 1.0).abs() < 0.05, "wavelengths {lengths:?}");
    assert!((spreads[0] / spreads[1] - 1.0).abs() < 0.05, "standard deviations {spreads:?}");
}

/// Dunes grown from `mean` slabs of noise.
fn grow(winds: Vec<Wind>, mean: u32, ticks: u64) -> (Lattice, Vec<f64>) {
    let lattice = torus([192, 192], Connectivity::Eight);
    let mut sand = noise(&lattice, mean, 1);
    blow(&lattice, canonical(Rose { winds }), &mut sand, 0..ticks);
    (lattice, sand)
}

/// Sand supply and the variety of winds separate the kinds of dunes (Wasson and Hyde 1983).
#[test]
fn supply_and_winds_make_the_kind_of_dune() {
    let bare = |sand: &[f64]| bare_percent(sand, 1.0).unwrap();
    let (_, barchans) = grow(vec![Wind::steady(0.0)], 1, 300);
    assert!(bare(&barchans) > 65.0, "{} % bare between barchans", bare(&barchans));
    let (lattice, transverse) = grow(vec![Wind::steady(0.0)], 10, 300);
    let ridges = crest_orientation(&lattice, &transverse).unwrap().unwrap();
    assert!((ridges.towards_deg - 90.0).abs() < 15.0, "{ridges:?}");
    assert!(ridges.coherence > 0.7 && bare(&transverse) < 45.0, "{ridges:?}");
    let winds = (0..5).map(|number| Wind::steady(72.0 * f64::from(number))).collect();
    let (lattice, stars) = grow(winds, 10, 300);
    let arms = crest_orientation(&lattice, &stars).unwrap().unwrap();
    assert!(arms.coherence < 0.25, "{arms:?}");
}

/// Slopes at repose over six nodes lie in the lee, not all of them: without a wind that is
/// faster over crests, windward sides may be steep too (Momiji and Warren 2000).
#[test]
fn slip_faces_lie_in_the_lee() {
    let (lattice, sand) = grow(vec![Wind::steady(0.0)], 10, 300);
    let steep = |sign: f64| {
        let fall = |node: usize| {
            let beyond = lattice.offset(lattice.coordinates(node), [6, 0, 0]).unwrap();
            sign * (sand[node] - sand[beyond])
        };
        (0..sand.len()).filter(|&node| fall(node) >= 11.0).count()
    };
    let [lee, windward] = [steep(1.0), steep(-1.0)];
    assert!(lee > 3 * windward, "{lee} steep slopes in the lee, {windward} in the wind");
}

/// A pile on bare ground becomes a barchan: its flanks overtake its middle.
#[test]
fn the_horns_of_a_barchan_point_downwind() {
    let lattice = torus([256, 128], Connectivity::Eight);
    let mut sand: Vec<f64> = (0..256 * 128)
        .map(|node| {
            let [x, y, _] = lattice.coordinates(node).map(|place| place as f64);
            ((36.0 - (x - 64.0).hypot(y - 64.0)) / 1.5).max(0.0).floor()
        })
        .collect();
    blow(&lattice, canonical(steady(0.0)), &mut sand, 0..150);
    // Mean column of the sand of some rows, as nodes downwind of that of all sand.
    let ahead = |rows: std::ops::Range<usize>| {
        let part: Vec<f64> = sand
            .iter()
            .enumerate()
            .map(|(n, s)| if rows.contains(&(n / 256)) { *s } else { 0.0 })
            .collect();
        let angle = mean_angle(&lattice, &part) - mean_angle(&lattice, &sand);
        ((angle + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0) / TAU * 256.0
    };
    let [middle, north, south] = [56..72, 34..46, 82..94].map(ahead);
    assert!(north > middle + 3.0 && south > middle + 3.0, "{north} {middle} {south}");
}

/// Two winds make one crest across both when they differ by less than 90 degrees, else along
/// their mean (Rubin and Hunter 1987; Gadal et al. 2019).
#[test]
fn two_winds_turn_crests_when_they_differ_by_more_than_a_right_angle() {
    for (half, expected) in [(30.0, 90.0), (60.0, 0.0)] {
        let (lattice, sand) = grow(vec![Wind::steady(half), Wind::steady(-half)], 10, 300);
        let crests = crest_orientation(&lattice, &sand).unwrap().unwrap();
        let off = (crests.towards_deg - expected + 90.0).rem_euclid(180.0) - 90.0;
        assert!(off.abs() < 12.0 && crests.coherence > 0.6, "winds +-{half}: {crests:?}");
    }
}
