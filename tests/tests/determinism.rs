//! Same bits: a scenario and a seed give the same fields on any number of threads, today and
//! tomorrow.
//!
//! [`GOLDEN`] holds a hash of the final fields of a small run of every process. It may be minted
//! anew only when a process is meant to give other results, and the commit that does it says
//! why; a faster kernel is no reason. `LANDFORM_MINT=1 cargo test -p landform-tests --test
//! determinism minted -- --nocapture` prints the hashes of all cases as they stand below, and
//! says which are new. The hashes were made on x86-64 Linux. Processes call tangents and
//! logarithms of the system's library, so another system may round differently.

use std::collections::BTreeSet;

use landform_tests::{Run, bits_of, fnv};

/// A small run of a process.
struct Case {
    /// Process at work, with its parameters.
    process: &'static str,
    /// How its fields are filled.
    initial: &'static [&'static str],
    /// Connectivity and boundary of the domain.
    domain: (&'static str, &'static str),
    /// Hash of all fields and of the series.
    golden: u64,
}

const SAND: &str = "(field: \"sand\", from: WhiteNoise(mean_m: 12.0, amplitude_m: 12.0))";
const HILLS: &str = "(field: \"bed\", from: SmoothNoise(standard_deviation_m: 8.0))";
const LAKE: &str = "(field: \"water\", from: WhiteNoise(mean_m: 3.0, amplitude_m: 3.0))";
const FLOW: &str = "(field: \"flow\", from: WhiteNoise(mean_m: 1.0, amplitude_m: 1.0))";
const ROCK: &str = "(field: \"resistance\", from: WhiteNoise(mean_m: 0.5, amplitude_m: 0.5))";
const SQUARE: &str = "(field: \"land\", from: StartingLand())";
const STRIP: &str = "(field: \"land\", from: StartingLand(shape: Strip))";
const SPECKS: &str = "(field: \"land\", from: WhiteNoise(mean_m: 0.5, amplitude_m: 0.9))";
const LEVELS: &str = "(field: \"level_set\", from: SmoothNoise(mean_m: 5.0))";
const ON_LEVEL: &str = "(field: \"on_level_set\", from: WhiteNoise(mean_m: 0.3, amplitude_m: 0.3))";
const PORES: &str = "(field: \"porosity\", from: WhiteNoise(mean_m: 0.3, amplitude_m: 0.2))";
const DENDRITE: &str = "(field: \"bed\", from: Dendrite(endpoints: Random(count: 30), \
     rounds: (count: 3, cost: 0.3), former_paths: 0.3, refinement: (parts: 3), scale: 9.0))";
const AGGREGATE: &str =
    "(field: \"bed\", combine: Add, from: Aggregate(particles: 300, sticking: 0.5, scale: 5.0))";
const PLANT: &str = "(field: \"bed\", combine: Add, from: LSystem(derivations: 3, scale: 3.0))";
const SETTLED: &str = "(field: \"arrival\", from: Aggregate(particles: 2000, show: Tree))";
const RISE: &str = "(field: \"uplift\", from: WhiteNoise(mean_m: 1e-3, amplitude_m: 1e-3))";
const VALLEYS: &str = "(field: \"bed\", from: Dendry(control: Noise(wavelength_m: 900.0), \
     cell_m: 200.0, shows: Terrain()))";
const HALLS: &str = "(field: \"porosity\", from: ImplicitVolume(outside: 0.1, inside: 0.4, \
     of: Rough(of: Union(width_m: 2.0, of: [Ball(center_m: (6.0, 8.0, 4.0), radius_m: 3.0), \
     Tube(points_m: [(6.0, 8.0, 4.0, 2.0), (20.0, 6.0, 3.0, 1.5)])]))))";
const TORUS: (&str, &str) = ("FourEight", "(Periodic, Periodic)");
const TORUS_OF_EIGHT: (&str, &str) = ("Eight", "(Periodic, Periodic)");
const ISLAND: (&str, &str) = ("FourEight", "(Open, Open)");
const BELT: (&str, &str) = ("Eight", "(Open, Periodic)");
const PLATE: (&str, &str) = ("Eight", "(Open, Open)");
const TRAY: (&str, &str) = ("Four", "(Open, Open)");
const BLOCK: (&str, &str) = ("TwentySix", "(Open, Open, Open)");

const fn case(
    process: &'static str,
    initial: &'static [&'static str],
    domain: (&'static str, &'static str),
    golden: u64,
) -> Case {
    Case { process, initial, domain, golden }
}

const GOLDEN: &[Case] = &[
    case("CoastErosion(force: 0.6)", &[SQUARE, ROCK], TRAY, 0x9da8_2f69_80f4_223b),
    case(
        "CoastErosion(force: 0.6, perimeter: Near(radius_m: 95.0), weakening: Power)",
        &[STRIP, ROCK],
        BELT,
        0xfeba_1c1a_0d24_7420,
    ),
    case(
        "CoastErosion(force: 0.5, perimeter: Contiguous(radius_m: 95.0), wear: (rate: 0.1))",
        &[SQUARE, ROCK],
        ISLAND,
        0x802b_c416_9420_caa1,
    ),
    case(
        "CoastErosion(regions: [(place: Sides([North]), force: 0.8)])",
        &[SPECKS, ROCK],
        TORUS,
        0x8093_8c13_4a9d_31ac,
    ),
    case(
        "IslandInterior(threshold_nodes: 3, perimeter: Near(radius_m: 95.0))",
        &[SQUARE, ROCK],
        TRAY,
        0xa018_c4ed_55e7_7037,
    ),
    case("LevelSetHeights(interval_m: 4.0)", &[LEVELS, ON_LEVEL], ISLAND, 0x8f04_6db4_f34f_7bda),
    case(
        "LevelSetHeights(interpolation: Hermite)",
        &[LEVELS, ON_LEVEL],
        TORUS,
        0x32db_658e_7b1a_f56d,
    ),
    case(
        "LevelSetHeights(interpolation: Contours, sea_floor: (slope: 0.2))",
        &[LEVELS, ON_LEVEL],
        TORUS,
        0xcabd_6b5f_9f85_0383,
    ),
    case("ImageCoastErosion(force: 0.6, offset: 1)", &[SQUARE, ROCK], TRAY, 0x5149_35a8_0c19_5827),
    case("IslandPruning(least_shore_m: 60.0)", &[SPECKS], TORUS, 0xdeff_f79d_c663_68ea),
    case("Dunes(slab_m: 3.0)", &[SAND, HILLS], TORUS, 0x3ddd_f41e_73f4_22fd),
    case("Dunes(slab_m: 3.0)", &[SAND, HILLS], ISLAND, 0x6525_e358_f4f4_b4d9),
    case("Dunes(slab_m: 3.0, feed_slabs: 7.5)", &[SAND, HILLS], BELT, 0x9a5d_4b34_83ea_50c7),
    case(
        "Dunes(slab_m: 1.0, refinement: (coarse_ticks: 2, phases: 2))",
        &[SAND],
        TORUS,
        0x8e3a_3af4_bc08_bc66,
    ),
    case("Dunes(slab_m: 3.0, shelter: Protection())", &[SAND, HILLS], TORUS, 0x0875_0507_fc87_802f),
    case(
        "Dunes(slab_m: 3.0, shelter: Protection())",
        &[SAND, HILLS],
        ISLAND,
        0x596a_f54f_9c3a_a568,
    ),
    case("Smoothing()", &[SAND, HILLS], TORUS, 0xe6cf_7890_9ecf_a18c),
    case("Smoothing()", &[SAND, HILLS], ISLAND, 0xdaa2_23b5_567a_9555),
    case("Smoothing()", &[SAND, DENDRITE, AGGREGATE, PLANT], ISLAND, 0x914f_60da_7bbe_c464),
    case("Aggregation(drifters: 400)", &[SETTLED], PLATE, 0x7a5b_0c47_578a_d12b),
    case("Aggregation(drifters: 400, sticking: 0.3)", &[SETTLED], BLOCK, 0xd06e_8c24_5287_0a92),
    case("SandLike()", &[SAND], TORUS, 0xb63f_87de_60c5_daa4),
    case("SandLike()", &[SAND], ISLAND, 0x739b_63a3_f864_88c9),
    case("CorrosionLike()", &[HILLS], TORUS, 0x07ae_c067_db3e_bdd2),
    case("CorrosionLike()", &[HILLS], ISLAND, 0x9d43_6ba6_df1b_bfec),
    case("Sandpile(grains_per_iteration: 20000)", &[], TRAY, 0xd84c_59f0_e8a4_5331),
    case("RicePile(grains_per_iteration: 300)", &[], TRAY, 0xe0a2_5ccd_733d_1f49),
    case("SlidingSlabs(grains_per_iteration: 3000)", &[], BELT, 0x3618_1dfe_c6b7_e65b),
    case("SlopeAreaErosion()", &[HILLS], PLATE, 0xc78e_4962_62ff_bfaa),
    case("SlopeAreaErosion(pits: Spill)", &[HILLS], PLATE, 0xad69_a2e1_f4c9_0ed2),
    case("SlopeAreaErosion()", &[VALLEYS], PLATE, 0x67e3_48b5_ff11_3df6),
    case("WaterColumn(sweeps: 3)", &[HILLS, LAKE], PLATE, 0x77c8_c178_8373_962c),
    case("WaterColumn(algorithm: UniformAverage)", &[HILLS, LAKE], TORUS, 0x4c65_decd_baac_1242),
    case(
        "WaterColumn(algorithm: WeightedAverage, outlets: [East])",
        &[HILLS, LAKE],
        BELT,
        0x2bd0_2e8e_229e_e714,
    ),
    case("WaterColumn(algorithm: Hydrostatic())", &[HILLS, LAKE], ISLAND, 0x82b6_0a96_5e1c_1209),
    case("WaterColumn(), HydraulicErosion()", &[HILLS, LAKE], PLATE, 0x8c9e_9989_1257_8a5f),
    case("AreaMapErosion()", &[HILLS], PLATE, 0x83e3_302c_0d21_90ed),
    case("StreamPowerErosion(step_yr: 1000.0)", &[HILLS], PLATE, 0x10a1_c0ef_ed6d_4c1e),
    case(
        "StreamPowerErosion(slope_exponent: 2.0, sea_level_m: 0.0, base_level: [])",
        &[HILLS, RISE],
        TORUS_OF_EIGHT,
        0x771e_b72c_3186_1a03,
    ),
    case(
        "HydraulicErosion(diffusion: Everywhere, diffusion_m2: 0.5, uplift_m: 0.1)",
        &[HILLS, FLOW],
        TORUS,
        0x414d_8710_a785_5d8e,
    ),
    case("Protochannels()", &[PORES], PLATE, 0x7453_e4d6_30ec_67da),
    case("Protochannels(protosinks: 20)", &[PORES], BLOCK, 0x9f5d_923a_f63b_92b3),
    case("CaveGrowth(sweeps: 5)", &[PORES], PLATE, 0x4619_abf7_e1dc_0bc8),
    case("CaveGrowth(sweeps: 5, channel_rate_per_m: 0.1)", &[PORES], BLOCK, 0x46d7_50eb_7483_6759),
    case("CaveGrowth(sweeps: 3, motion: Falling)", &[PORES], BLOCK, 0xa546_8256_9933_d2a6),
    case("CaveGrowth(sweeps: 5)", &[HALLS], BLOCK, 0x997a_4ec9_9298_beaf),
    case("Life()", &[], BELT, 0xbe7f_83e9_99e2_6c6e),
    case("LivingCells()", &[], BELT, 0x3f4e_48ab_0242_4563),
    case("Pipes()", &[HILLS, LAKE], ISLAND, 0x6a15_acb4_bd24_52f0),
    case("Trails(walkers: 500)", &[HILLS], ISLAND, 0x4d6b_83ea_c61a_c0e9),
    case("ForestFire(growth: 0.01, lightning: 0.001)", &[], ISLAND, 0x6e18_8e9e_b651_7e2c),
];

impl Case {
    /// Name of the process.
    fn name(&self) -> &'static str {
        self.process.split('(').next().unwrap_or_default()
    }

    /// A scenario on a grid or a volume that is neither square nor a multiple of the usual chunks.
    fn scenario(&self, seed: u64) -> String {
        let (connectivity, boundary) = self.domain;
        let process = self.process;
        let initial = self.initial.join(", ");
        let domain = match connectivity {
            "TwentySix" => "Volume(size: (25, 17, 9)",
            _ => "Grid(size: (150, 84)",
        };
        format!(
            r#"(
                title: "same bits",
                seed: {seed},
                domain: {domain}, connectivity: {connectivity}, boundary: {boundary}),
                initial: [{initial}],
                stages: [(processes: [{process}], stop: Iterations(6))],
                metrics: [FieldStatistic(field: "{}", statistic: StandardDeviation)],
            )"#,
            self.measured()
        )
    }

    /// A field that the process has.
    fn measured(&self) -> &'static str {
        match self.name() {
            "CoastErosion" | "IslandPruning" | "IslandInterior" | "ImageCoastErosion" => "land",
            "LevelSetHeights" => "bed",
            "Sandpile" | "RicePile" | "SlidingSlabs" => "grains",
            "Life" => "alive",
            "LivingCells" => "cells",
            "ForestFire" => "forest",
            "Pipes" => "water",
            "Trails" => "wear",
            "Aggregation" => "arrival",
            "SlopeAreaErosion" => "drainage_area",
            "WaterColumn" => "water",
            "Protochannels" | "CaveGrowth" => "porosity",
            _ => "surface",
        }
    }
}

/// A hash of the names and bits of all final fields and of the whole series.
fn hash(run: &Run) -> u64 {
    let fields = &run.fields;
    let parts = fields.iter().flat_map(|(name, values)| {
        name.bytes().chain(bits_of(values).to_le_bytes()).collect::<Vec<_>>()
    });
    fnv(parts.chain(run.series.to_csv().into_bytes()))
}

/// The hash of a run from beginning to end.
fn unbroken(case: &Case, seed: u64, threads: usize) -> u64 {
    hash(&Run::of(&case.scenario(seed), landform::registry(), threads))
}

#[test]
fn every_process_gives_the_same_bits_on_any_number_of_threads() {
    for case in GOLDEN {
        let [one, two, eight] = [1, 2, 8].map(|threads| unbroken(case, 5, threads));
        assert_eq!((one, one), (two, eight), "{} on {:?}", case.process, case.domain);
    }
}

#[test]
fn every_process_goes_on_from_a_checkpoint_with_the_same_bits() {
    for case in GOLDEN {
        let whole = unbroken(case, 5, 2);
        for (iteration, threads) in [(1, [8, 1]), (3, [1, 8])] {
            let broken = Run::broken(&case.scenario(5), landform::registry, iteration, threads);
            assert_eq!(hash(&broken), whole, "{} on {:?}", case.process, case.domain);
        }
    }
}

#[test]
fn the_bits_are_those_that_were_minted() {
    let mint = std::env::var_os("LANDFORM_MINT").is_some();
    let mut changed = String::new();
    for case in GOLDEN {
        let found = unbroken(case, 5, 2);
        if mint {
            let new = if found == case.golden { "" } else { " is new" };
            println!("{} on {:?}: {}{new}", case.process, case.domain, literal(found));
        }
        if found != case.golden {
            changed += &format!("{} on {:?}: {}\n", case.process, case.domain, literal(found));
        }
    }
    assert!(changed.is_empty() || mint, "other bits than before:\n{changed}");
}

/// A hash as [`GOLDEN`] writes it.
fn literal(hash: u64) -> String {
    let quarter = |shift: u32| format!("{:04x}", hash >> shift & 0xffff);
    format!("0x{}", [48, 32, 16, 0].map(quarter).join("_"))
}

#[test]
fn every_process_has_golden_bits() {
    let known: BTreeSet<_> = GOLDEN.iter().map(Case::name).collect();
    let registered: BTreeSet<_> = landform::registry().processes.names().into_iter().collect();
    assert_eq!(known, registered, "add a case to GOLDEN for each process");
}

#[test]
fn another_seed_gives_other_bits() {
    for case in GOLDEN {
        let [first, second] = [5, 6].map(|seed| unbroken(case, seed, 2));
        assert_ne!(first, second, "{}", case.process);
    }
}
