//! Dimensions and hypsometry of shapes for which they are known, and of measured shores.

use landform_analysis::{
    HypsometricCurve, HypsometricForm, HypsometricStage, Hypsometry, LevelSetEdge, Polyline,
    ScaleRange, box_dimension, divider_dimension, level_sets, perimeter_dimension,
    variogram_dimension,
};
use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::{AmplitudeLaw, Generator, SpectralFbm};

/// A curve whose pieces are replaced, `level` times, by a chain of smaller ones: each by its
/// turn in degrees, all of `length` of the former.
fn chain(turns_deg: &[f64], length: f64, level: u32) -> Polyline {
    fn draw(
        at: &mut [f64; 2],
        heading: f64,
        size: f64,
        level: u32,
        rule: (&[f64], f64),
        out: &mut Vec<[f64; 2]>,
    ) {
        if level == 0 {
            *at = [at[0] + size * heading.cos(), at[1] + size * heading.sin()];
            return out.push(*at);
        }
        for turn in rule.0 {
            draw(at, heading + turn.to_radians(), size * rule.1, level - 1, rule, out);
        }
    }
    let mut points = vec![[0.0, 0.0]];
    draw(&mut [0.0, 0.0], 0.3, 1000.0, level, (turns_deg, length), &mut points);
    Polyline::planar(&points).unwrap()
}

const KOCH: [f64; 4] = [0.0, 60.0, -60.0, 0.0];

/// Koch 1904: ln 4 / ln 3 = 1.2619. The quadric curve of eight pieces: 1.5.
#[test]
fn koch_curves_have_their_dimension() {
    let quadric = [0.0, 90.0, 0.0, -90.0, -90.0, 0.0, 90.0, 0.0];
    for (name, curve, expected, range, slack) in [
        ("Koch", chain(&KOCH, 1.0 / 3.0, 8), 4.0_f64.ln() / 3.0_f64.ln(), [0.7, 56.7], [0.02; 2]),
        ("quadric", chain(&quadric, 0.25, 6), 1.5, [1.0, 64.0], [0.03, 0.05]),
        ("line", chain(&[0.0; 4], 0.25, 5), 1.0, [1.0, 64.0], [1e-9, 0.02]),
    ] {
        let range = ScaleRange::new(range[0], range[1]).unwrap();
        let curve = [curve];
        let divider = divider_dimension(&curve, &range).unwrap();
        let boxes = box_dimension(&curve, &range).unwrap();
        println!(
            "{name} {expected:.4}: divider {:.4} +- {:.4}, boxes {:.4} +- {:.4}",
            divider.dimension, divider.error, boxes.dimension, boxes.error
        );
        assert!((divider.dimension - expected).abs() <= slack[0], "{name}");
        assert!((boxes.dimension - expected).abs() <= slack[1], "{name}");
    }
}

/// Cantor's set: ln 2 / ln 3 = 0.6309. Sierpinski's gasket: ln 3 / ln 2 = 1.5850.
#[test]
fn dusts_and_gaskets_have_their_dimension() {
    let speck = |x: f64, y: f64, size: f64| Polyline::planar(&[[x, y], [x + size, y]]).unwrap();
    let cantor: Vec<Polyline> = (0..1_u32 << 10)
        .map(|bits| {
            let x: f64 =
                (0..10).map(|k| f64::from((bits >> k) & 1) * 2.0 / 3.0_f64.powi(k + 1)).sum();
            speck(1000.0 * x, 0.0, 1000.0 / 3.0_f64.powi(10))
        })
        .collect();
    let gasket: Vec<Polyline> = (0..3_u32.pow(9))
        .map(|digits| {
            let [mut x, mut y] = [0.0; 2];
            for k in 0..9 {
                let half = 500.0 / f64::from(1_u32 << k);
                match digits / 3_u32.pow(k) % 3 {
                    1 => x += half,
                    2 => [x, y] = [x + 0.5 * half, y + 0.75_f64.sqrt() * half],
                    _ => {}
                }
            }
            speck(x, y, 1e-3)
        })
        .collect();
    for (name, set, expected, range) in [
        ("Cantor", cantor, 2.0_f64.ln() / 3.0_f64.ln(), [0.1, 72.9]),
        ("gasket", gasket, 3.0_f64.ln() / 2.0_f64.ln(), [8.0, 64.0]),
    ] {
        let range = ScaleRange::new(range[0], range[1]).unwrap();
        let boxes = box_dimension(&set, &range).unwrap();
        println!("{name} {expected:.4}: boxes {:.4} +- {:.4}", boxes.dimension, boxes.error);
        assert!((boxes.dimension - expected).abs() < 0.02, "{name}: {}", boxes.dimension);
    }
}

/// A circle takes 2 pi r / (2 r asin(ruler / 2 r)) steps of a ruler, a little more than its
/// circumference over the ruler.
#[test]
fn steps_round_a_circle_are_counted_in_parts() {
    let angle = |k: u32| f64::from(k % 36_000) / 36_000.0 * std::f64::consts::TAU;
    let points: Vec<[f64; 2]> =
        (0..=36_000).map(|k| [500.0 * angle(k).cos(), 500.0 * angle(k).sin()]).collect();
    let circle = Polyline::planar(&points).unwrap();
    assert!(circle.is_closed());
    let range = ScaleRange::new(10.0, 100.0).unwrap();
    let divider = divider_dimension(&[circle], &range).unwrap();
    for point in &divider.scales {
        let exact = std::f64::consts::TAU / (2.0 * (point.scale_m / 1000.0).asin());
        // The last step in part is measured along its chord.
        assert!((point.measure - exact).abs() < 1e-2, "{point:?} {exact}");
    }
    assert!((divider.dimension - 1.0).abs() < 0.005);
}

/// Target 2.2: level sets of fractional Brownian surfaces, all islands together, D = 2 - H.
#[test]
fn fbm_coasts_have_dimension_2_minus_h() {
    let lattice =
        Lattice::plane([1024; 2], 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap();
    for hurst in [0.3, 0.5, 0.7, 0.9] {
        let [mut perimeter, mut surface] = [0.0; 2];
        let seeds = 3;
        for seed in 0..seeds {
            let amplitude_law = AmplitudeLaw::ComplexGaussian;
            let generator = SpectralFbm { hurst, amplitude_law, ..Default::default() };
            let heights = generator.generate(&lattice, seed).unwrap();
            let land: Vec<bool> = heights.iter().map(|&height| height >= 0.0).collect();
            let share = 1.0 / seeds as f64;
            perimeter += share * perimeter_dimension(&land, [1024; 2], 1.0).unwrap().dimension;
            surface +=
                share * variogram_dimension(&heights, [1024; 2], [1.0; 2]).unwrap().dimension;
        }
        println!("H {hurst}: perimeter {perimeter:.3}, variogram {surface:.3} - 1");
        assert!((perimeter - (2.0 - hurst)).abs() < 0.10, "H {hurst}: {perimeter}");
        assert!((surface - (3.0 - hurst)).abs() < 0.12, "H {hurst}: {surface}");
    }
}

/// "The hypsometric curve of fBm exhibits features appropriate for terrains in erosion
/// equilibrium" (thesis, section 4.3.2): so does the mean integral. The curve of a single surface,
/// made by a few long waves, may have more inflections and be unusual.
#[test]
fn fbm_has_the_integral_of_equilibrium_and_its_coast_encloses_the_land() {
    let lattice =
        Lattice::plane([256; 2], 1.0, Connectivity::Eight, [Boundary::Periodic; 2]).unwrap();
    let seeds = 6;
    let mut integral = 0.0;
    for seed in 0..seeds {
        let surface = SpectralFbm { hurst: 0.8, ..Default::default() };
        let heights = surface.generate(&lattice, seed).unwrap();
        let found = Hypsometry::new(&HypsometricCurve::new(&heights).unwrap());
        println!("seed {seed}: {found:?}");
        integral += found.integral / seeds as f64;
        let coasts = level_sets(&heights, [256; 2], 0.0, LevelSetEdge::Close).unwrap();
        let land = coasts.iter().map(|coast| coast.area()).sum::<f64>();
        let cells = heights.iter().filter(|&&height| height >= 0.0).count() as f64;
        assert!((land / cells - 1.0).abs() < 0.05, "{land} {cells}");
    }
    let stage = HypsometricStage::new(HypsometricForm::ConcaveConvex, integral);
    assert_eq!(stage, HypsometricStage::Equilibrium, "{integral}");
}
