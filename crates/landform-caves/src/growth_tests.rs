//! Whole caves: what they must do and what they keep.

use super::*;
use crate::courses::{CourseScale, courses};
use crate::place::box_nodes;
use crate::record::{CaveEventKind, CaveRecord, starts};
use crate::rock::ChannelLines;
use landform_graph::{Boundary, Connectivity};
use landform_sim::checkpoint::Checkpoint;

fn law(rates: Rates, reach_m: f64) -> GrowthLaw {
    GrowthLaw {
        motion: Motion::Pressure {
            rates,
            exponent: 4,
            most: rates.rock_per_m * reach_m,
            fall: 0.5,
        },
        dissolution: Dissolution {
            rate: 0.15,
            contributed_weight: 0.25,
            exponent: 1.0,
            contributed_fraction: 0.1,
        },
        passage: 0.35,
        sweeps: 1,
    }
}

const CAVE: Rates = Rates { rock_per_m: 0.5, channel_per_m: 0.001 };

fn openings(sources: &[usize], sinks: &[usize]) -> Openings {
    Openings {
        sources: sources.iter().map(|&node| vec![node]).collect(),
        pressures: vec![1.0; sources.len()],
        strengths: vec![1.0; sources.len()],
        sinks: sinks.to_vec(),
    }
}

/// A cave and its fields.
struct Run {
    lattice: Lattice,
    growth: ChannelGrowth,
    water: PoreWater,
    porosity: Vec<f64>,
    pressure: Vec<f64>,
    record: CaveRecord,
}

const SCALE: CourseScale = CourseScale { least_rise_m: 2.0, apart_m: 8.0, near_m: 3.0 };

impl Run {
    fn new(lattice: Lattice, law: GrowthLaw, openings: Openings, porosity: Vec<f64>) -> Self {
        let mut growth = ChannelGrowth::new(&lattice, law, openings, &porosity).unwrap();
        let pressure = growth.first_pressure(&lattice, &porosity).unwrap();
        let water = PoreWater::dry(porosity.len());
        Self { lattice, growth, water, porosity, pressure, record: CaveRecord::default() }
    }

    /// Iterations with all that they keep; returns what they moved in all.
    fn run(&mut self, iterations: u64) -> Turnover {
        let Self { lattice, growth, water, porosity, pressure, record } = self;
        let mut all = Turnover::default();
        for iteration in 1..=iterations {
            let moved = growth.step(lattice, water, porosity, pressure).unwrap();
            all.fed += moved.fed;
            all.drained += moved.drained;
            all.dissolved += moved.dissolved;
            let (passages, openings) = growth.passages();
            let ends = (&openings.sources[..], &openings.sinks[..]);
            record.survey(lattice, (passages, pressure), ends, SCALE, iteration);
        }
        all
    }
}

fn block() -> Lattice {
    Lattice::volume([24, 16, 10], 1.0, Connectivity::Voxel26, [Boundary::Open; 3]).unwrap()
}

#[test]
fn a_channel_breaks_through_and_nothing_is_lost() {
    let lattice = block();
    let (source, sink) = (lattice.node([2, 8, 7]), lattice.node([23, 8, 2]));
    let rock = vec![0.15; lattice.node_count()];
    let mut run = Run::new(lattice, law(CAVE, 40.0), openings(&[source], &[sink]), rock.clone());
    let moved = run.run(200);
    assert_eq!(run.record.count(CaveEventKind::Breakthrough), 1, "{:?}", run.record);
    let water = run.water.total() as f64 / UNIT;
    assert_eq!(moved.fed - moved.drained, water);
    let grown: f64 = run.porosity.iter().zip(&rock).map(|(now, then)| now - then).sum();
    assert!((grown - moved.dissolved).abs() < 1e-9 * grown);
    assert!(run.porosity.iter().all(|porosity| (0.15..=1.0).contains(porosity)));
    // Fields that show the water hold what there is.
    assert!((run.water.content_shares().iter().sum::<f64>() - water).abs() < 1e-9);
    assert!(run.water.flow_shares().iter().all(|flow| *flow <= 1.0));
}

/// The pressure that follows growth is that of the rock as it has become.
#[test]
fn pressure_after_growth_is_that_of_the_rock() {
    let lattice = block();
    let ends = openings(&[lattice.node([2, 3, 7])], &[lattice.node([23, 12, 2])]);
    let rock = vec![0.2; lattice.node_count()];
    let mut run = Run::new(lattice, law(CAVE, 40.0), ends.clone(), rock);
    run.run(120);
    assert!(run.growth.passages().0.voxels() > 20);
    let afresh = ChannelGrowth::new(&run.lattice, law(CAVE, 40.0), ends, &run.porosity);
    assert_eq!(afresh.unwrap().first_pressure(&run.lattice, &run.porosity).unwrap(), run.pressure);
}

/// A cave that is taken up from its fields and its water goes on as if it had not been interrupted.
#[test]
fn a_cave_goes_on_from_what_is_kept() {
    let lattice = block();
    let ends = openings(
        &[lattice.node([2, 3, 7]), lattice.node([8, 12, 8])],
        &[lattice.node([23, 12, 2])],
    );
    let rock = vec![0.2; lattice.node_count()];
    let mut whole = Run::new(lattice, law(CAVE, 40.0), ends.clone(), rock);
    whole.run(40);
    let mut checkpoint = Checkpoint::default();
    checkpoint.saver("state").keep("water", &whole.water);
    let water: PoreWater = checkpoint.loader("state").keep("water").unwrap();
    assert_eq!(water.content_shares(), whole.water.content_shares());
    assert_eq!(water.flow_shares(), whole.water.flow_shares());
    let lattice = whole.lattice.clone();
    let growth = ChannelGrowth::new(&lattice, law(CAVE, 40.0), ends, &whole.porosity).unwrap();
    let (porosity, pressure) = (whole.porosity.clone(), whole.pressure.clone());
    let record = whole.record.clone();
    let mut taken_up = Run { lattice, growth, water, porosity, pressure, record };
    whole.run(60);
    taken_up.run(60);
    assert_eq!(whole.porosity, taken_up.porosity);
    assert_eq!(whole.pressure, taken_up.pressure);
    assert_eq!(whole.record.drained, taken_up.record.drained);
}

/// Figures 5.6 and 5.7: with rock that resists, channels link up one after the other; with rock that
/// hardly does, all reach the sink by themselves. Scaled rates change nothing.
#[test]
fn resistance_decides_how_channels_link() {
    let own = |rates: Rates| {
        let lattice =
            Lattice::plane([96, 64], 1.0, Connectivity::Eight, [Boundary::Open; 2]).unwrap();
        let line = |top: f64, end: [f64; 2]| vec![[top, 1.0, 0.0], [end[0], end[1], 0.0]];
        let lines =
            vec![line(0.05, [0.44, 0.21]), line(0.41, [0.67, 0.34]), line(0.64, [0.8, 0.55])];
        let channels = ChannelLines { porosity: 0.4, lines, radius_m: 0.0 };
        let rock = channels.fill(&lattice).unwrap().into_iter().map(|porosity| porosity.max(0.15));
        let node = |east, north| box_nodes(&lattice, [east, north, 0.0], [0.0; 3]).unwrap()[0];
        let tops = [node(0.05, 1.0), node(0.41, 1.0), node(0.64, 1.0)];
        let ends = openings(&tops, &[node(1.0, 0.21)]);
        let mut law = law(rates, 120.0);
        if let Motion::Pressure { exponent, .. } = &mut law.motion {
            *exponent = 8;
        }
        let mut run = Run::new(lattice.clone(), law, ends, rock.collect());
        run.run(300);
        let starts = starts(&run.record.drained, &run.growth.openings().sources, &run.pressure);
        let courses = courses(&run.lattice, &run.pressure, &starts, SCALE);
        assert_eq!(courses.len(), 3, "{rates:?}: {:?}", run.record);
        assert!(
            courses.iter().all(|course| run.pressure[course.trail[course.trail.len() - 1]] == 0.0)
        );
        let own = courses.iter().filter(|course| course.joins.is_none()).count();
        let longest = courses.iter().map(|course| course.order + 1).max();
        (own, longest, courses.iter().map(|course| course.loops.len()).sum::<usize>())
    };
    let rates = |rock_per_m, channel_per_m| Rates { rock_per_m, channel_per_m };
    let (own_courses, longest, loops) = own(rates(0.05, 0.001));
    assert_eq!((own_courses, longest), (1, Some(3)));
    assert!(loops >= 2, "{loops} phreatic loops");
    assert_eq!(own(rates(0.0025, 0.001)), (3, Some(1), 0));
    assert_eq!(own(rates(0.05, 0.02)), (3, Some(1), 0));
}
