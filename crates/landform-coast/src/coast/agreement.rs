//! The fast coast and the literal one do the same.

use landform_graph::{Boundary, Connectivity, Lattice};
use proptest::prelude::*;

use super::reference;
use super::testing::{any_land, any_lattice, any_resistance};
use super::{Coast, CoastError, CoastSettings, MapSide, Perimeter, Place, Region, Weakening, Wear};

/// Any law of force; radii are not those of any two nodes, where rounding would decide.
fn any_settings() -> impl Strategy<Value = CoastSettings> {
    let perimeter = prop_oneof![
        Just(Perimeter::Whole),
        (3.1_f64..21.0).prop_map(|radius_m| Perimeter::Near { radius_m }),
        (3.1_f64..21.0).prop_map(|radius_m| Perimeter::Contiguous { radius_m }),
    ];
    let weakening =
        prop_oneof![Just(Weakening::None), Just(Weakening::Share), Just(Weakening::Power)];
    let wear =
        proptest::option::of(
            (0.01_f64..1.0, 0.0_f64..0.3, 0.5_f64..7.0)
                .prop_map(|(rate, weakening, radius_m)| Wear { rate, weakening, radius_m }),
        );
    let regions = prop_oneof![
        Just(Vec::new()),
        Just(vec![Region {
            place: Place::Sides(vec![MapSide::North, MapSide::East]),
            force: Some(0.4),
            attenuation: None,
            weakening: Some(0.2),
        }]),
        Just(vec![Region {
            place: Place::Numbered(2),
            force: Some(0.3),
            attenuation: Some(0.3),
            weakening: None,
        }]),
    ];
    let numbers = (0.2_f64..0.9, 0.0_f64..0.4);
    (numbers, perimeter, weakening, wear, regions).prop_map(
        |((force, attenuation), perimeter, weakening, wear, regions)| CoastSettings {
            force,
            attenuation,
            perimeter,
            weakening,
            wear,
            regions,
            region_map: Vec::new(),
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_same_nodes_fall(lattice in any_lattice(), settings in any_settings(), seed in 0_u64..) {
        let mut land = any_land(&lattice, seed);
        let mut rock = any_resistance(&lattice, seed);
        let nodes = 0..lattice.node_count();
        let region_map = nodes.map(|node| (node % 7 / 2) as u8).collect();
        let settings = CoastSettings { region_map, ..settings };
        let mut coast = Coast::new(&lattice, settings.clone(), &land, &rock).unwrap();
        let initial = coast.shore().total();
        let (mut slow_land, mut slow_rock) = (land.clone(), rock.clone());
        for iteration in 0..12 {
            let slow =
                reference::step(&lattice, &settings, &mut slow_land, &mut slow_rock, initial)
                    .unwrap();
            let events = coast.step(&mut land, &mut rock, initial).unwrap();
            let fast: Vec<usize> = events.eroded.iter().map(|&node| node as usize).collect();
            prop_assert_eq!(fast, slow, "iteration {}", iteration);
            prop_assert_eq!(&land, &slow_land);
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(&rock), bits(&slow_rock));
            for node in 0..land.len() {
                let is_coast = reference::is_coast(&lattice, &land, node);
                prop_assert_eq!(coast.is_coast(node), is_coast);
                let length = reference::shore_length(&lattice, &land, node);
                prop_assert_eq!(u64::from(coast.shore().length(node)), length);
            }
        }
    }

    #[test]
    fn a_coast_made_anew_goes_on_alike(
        lattice in any_lattice(),
        settings in any_settings(),
        seed in 0_u64..,
    ) {
        let mut land = any_land(&lattice, seed);
        let mut rock = any_resistance(&lattice, seed);
        let mut coast = Coast::new(&lattice, settings.clone(), &land, &rock).unwrap();
        let initial = coast.shore().total();
        for _ in 0..8 {
            let again = Coast::new(&lattice, settings.clone(), &land, &rock);
            let mut others = (land.clone(), rock.clone());
            let events = coast.step(&mut land, &mut rock, initial).unwrap();
            let mut again = again.unwrap();
            let same = again.step(&mut others.0, &mut others.1, initial).unwrap();
            prop_assert_eq!(&events.eroded, &same.eroded);
            prop_assert_eq!(&land, &others.0);
            prop_assert_eq!(&rock, &others.1);
            let forces = |coast: &Coast| -> Vec<u64> {
                let nodes = coast.nodes().into_iter();
                nodes.map(|node| coast.force(node, initial).to_bits()).collect()
            };
            prop_assert_eq!(forces(&coast), forces(&again));
        }
    }
}

/// A long coast of random rock that erodes here and there, and what a coast made anew does at each
/// iteration; sometimes the force changes, or nodes fall that withstood it.
fn goes_on_alike(connectivity: Connectivity, perimeter: Perimeter) {
    let boundary = [Boundary::Periodic, Boundary::Open];
    let lattice = Lattice::plane([150, 90], 1.0, connectivity, boundary).unwrap();
    let mut land: Vec<u8> = (0..13_500).map(|node| u8::from(node >= 1500)).collect();
    let mut rock = any_resistance(&lattice, 3);
    let settings = CoastSettings { force: 0.45, attenuation: 0.2, perimeter, ..Default::default() };
    let mut coast = Coast::new(&lattice, settings.clone(), &land, &rock).unwrap();
    let initial = coast.shore().total();
    let (mut rests, mut iterations) = (0, 0);
    while rests < 4 {
        let mut again = Coast::new(&lattice, settings.clone(), &land, &rock).unwrap();
        // The sea rises a little whenever the coast rests, and falls again.
        let pressure = if iterations % 3 == 0 { 1.0 } else { 1.0 + 0.02 * f64::from(rests) };
        coast.press(pressure);
        again.press(pressure);
        let mut others = (land.clone(), rock.clone());
        let anew = again.step(&mut others.0, &mut others.1, initial).unwrap();
        let events = coast.step(&mut land, &mut rock, initial).unwrap();
        assert_eq!(events.eroded, anew.eroded, "{perimeter:?}, iteration {iterations}");
        rests += i32::from(events.eroded.is_empty());
        iterations += 1;
        if iterations % 7 == 0 {
            let nodes: Vec<u32> = coast.nodes().iter().step_by(40).map(|&n| n as u32).collect();
            coast.fell(&nodes, &mut land, &mut rock).unwrap();
        }
    }
    assert!(iterations > 10, "{iterations}");
}

/// Most of a large map is passed over when only a few nodes change.
#[test]
fn what_no_change_concerns_is_passed_over_rightly() {
    let perimeters = [
        Perimeter::Whole,
        Perimeter::Near { radius_m: 6.2 },
        Perimeter::Contiguous { radius_m: 6.2 },
        // Nodes that fall together are one change within so large a radius.
        Perimeter::Contiguous { radius_m: 37.3 },
    ];
    for connectivity in [Connectivity::FourEight, Connectivity::Four, Connectivity::Eight] {
        perimeters.iter().for_each(|&perimeter| goes_on_alike(connectivity, perimeter));
    }
}

/// Figure 4.9 of the thesis: a coast node of the 4-8 mesh falls; it leaves an artifact, and its
/// neighbours that were inland become the coast.
#[test]
fn one_event_on_the_mesh() {
    let lattice =
        Lattice::plane([7, 6], 1.0, Connectivity::FourEight, [Boundary::Open; 2]).unwrap();
    let mut land: Vec<u8> = (0..42).map(|node| u8::from(node >= 14)).collect();
    // (4, 2) has eight neighbours, three of them at sea.
    let weak = lattice.node([4, 2, 0]);
    let mut rock = vec![1.0; 42];
    rock[weak] = 0.1;
    let settings = CoastSettings { force: 0.2, attenuation: 0.0, ..CoastSettings::default() };
    let mut coast = Coast::new(&lattice, settings, &land, &rock).unwrap();
    let row = |y: usize| (0..7).map(move |x| x + 7 * y);
    assert_eq!(coast.nodes(), row(2).collect::<Vec<_>>());
    assert_eq!(coast.strength(weak), Some(0.1 * (1.0 - 3.0 / 8.0)));
    let events = coast.step(&mut land, &mut rock, 1).unwrap().clone();
    assert_eq!(events.eroded, [weak as u32]);
    assert_eq!(events.exposed.len(), 3, "the three neighbours inland");
    let mut expected: Vec<usize> = row(2).filter(|&node| node != weak).collect();
    expected.extend([3, 4, 5].map(|x| lattice.node([x, 3, 0])));
    assert_eq!(coast.nodes(), expected);
    assert!(coast.step(&mut land, &mut rock, 1).unwrap().eroded.is_empty());
    assert!(coast.step(&mut land, &mut rock, 1).unwrap().measured.is_empty());
}

/// On a straight coast the local perimeter is 1, whatever the radius and the search.
#[test]
fn a_straight_coast_weakens_the_sea_once() {
    let boundary = [Boundary::Periodic, Boundary::Open];
    let lattice = Lattice::plane([64, 16], 10.0, Connectivity::FourEight, boundary).unwrap();
    let land: Vec<u8> = (0..1024).map(|node| u8::from(node >= 512)).collect();
    let rock = vec![1.0; 1024];
    for radius_m in [40.0, 70.0, 200.0] {
        for perimeter in [Perimeter::Near { radius_m }, Perimeter::Contiguous { radius_m }] {
            let settings =
                CoastSettings { force: 1.0, attenuation: 1.0, perimeter, ..Default::default() };
            let coast = Coast::new(&lattice, settings, &land, &rock).unwrap();
            // The disc holds 2R + 1 nodes of the shore.
            let expected = (2.0 * radius_m + 10.0) / (2.0 * radius_m);
            let force = coast.force(600 - 600 % 64 + 5 - 64, 1);
            assert_eq!(force, 1.0 / (1.0 + expected), "{perimeter:?}");
        }
    }
}

#[test]
fn bad_settings_and_fields_are_refused() {
    let lattice = Lattice::plane([8, 8], 10.0, Connectivity::Four, [Boundary::Open; 2]).unwrap();
    let land: Vec<u8> = (0..64).map(|node| u8::from(node >= 32)).collect();
    let rock = vec![0.5; 64];
    let refused = |change: fn(&mut CoastSettings)| {
        let mut settings = CoastSettings::default();
        change(&mut settings);
        Coast::new(&lattice, settings, &land, &rock).unwrap_err()
    };
    let ranges: [fn(&mut CoastSettings); 8] = [
        |settings| settings.force = f64::NAN,
        |settings| settings.attenuation = -1.0,
        |settings| settings.perimeter = Perimeter::Near { radius_m: 10.0 },
        |settings| settings.perimeter = Perimeter::Contiguous { radius_m: f64::INFINITY },
        |settings| settings.wear = Some(Wear { radius_m: 0.0, ..Wear::default() }),
        |settings| settings.wear = Some(Wear { radius_m: 1e6, ..Wear::default() }),
        |settings| settings.wear = Some(Wear { weakening: f64::NAN, ..Wear::default() }),
        |settings| {
            let corners = vec![[0.0, 0.0], [1.0, f64::NAN], [1.0, 1.0]];
            settings.regions = vec![Region { place: Place::Polygon(corners), ..Region::default() }];
        },
    ];
    for change in ranges {
        let error = refused(change);
        assert!(matches!(error, CoastError::Range { .. }), "{error}");
    }
    let empty = refused(|settings| settings.regions = vec![Region::default()]);
    assert_eq!(empty, CoastError::EmptyRegion(0));
    let many = refused(|settings| settings.regions = vec![Region::default(); 300]);
    assert_eq!(many, CoastError::TooManyRegions(300));
    let dry = Coast::new(&lattice, CoastSettings::default(), &[1; 64], &rock).unwrap();
    let error = dry.require_coast(&[1; 64]).unwrap_err();
    assert_eq!(error, CoastError::NoCoast { land: 64, nodes: 64 });
    let error = Coast::new(&lattice, CoastSettings::default(), &land, &[0.0; 3]).unwrap_err();
    assert_eq!(error, CoastError::Length { name: "resistance", found: 3, expected: 64 });
}
