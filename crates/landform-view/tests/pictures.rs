//! Pictures of terrain whose look is known beforehand.

use landform_view::montage::{MontageOptions, Panel, Row, panels};
use landform_view::perspective::{PerspectiveOptions, Surroundings, camera, render};
use landform_view::relief::{ReliefOptions, shaded_relief};
use landform_view::{ColourMap, Ground, HeightField, Image, Light, ViewError, Water, flat};

fn ground(name: &str) -> Ground {
    Ground::new(ColourMap::named(name).unwrap())
}

fn heights(width: usize, height: usize, at: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    (0..width * height).map(|node| at((node % width) as f64, (node / width) as f64)).collect()
}

fn hills(width: usize, height: usize) -> Vec<f64> {
    heights(width, height, |x, y| 6.0 * ((x / 6.0).sin() + (y / 9.0 + x / 17.0).cos()))
}

/// White light from the west at `altitude_deg` and nothing else.
fn bare_sun(altitude_deg: f64) -> Light {
    Light {
        bearing_deg: 270.0,
        altitude_deg,
        sun_colour: [255; 3],
        sun: 1.0,
        sky: 0.0,
        spread: 0.0,
        ..Light::map()
    }
}

/// Lambert's law: a plane that faces the sun has the colours of its map, a level one those
/// times the sine of the sun's altitude (in linear light).
#[test]
fn planes_have_the_brightness_of_lamberts_law() {
    let (width, height) = (24, 16);
    let mut options = ReliefOptions::new(Ground { range_m: Some([1e8, 1e9]), ..ground("lajolla") });
    options.ground.colours = ColourMap::named("sand").unwrap();
    options.light = bare_sun(60.0);
    let own = options.ground.colours.colour(0.0);
    // Falling west by tan 30 degrees, the plane faces a sun 60 degrees high in the west.
    let slope = 30_f64.to_radians().tan();
    let facing = heights(width, height, |x, _| slope * x);
    let level = vec![0.0; width * height];
    let linear = |value: u8| ((f64::from(value) / 255.0 + 0.055) / 1.055).powf(2.4);
    for (plane, share) in [(facing, 1.0), (level, 60_f64.to_radians().sin())] {
        let field = HeightField::new(width, height, 1.0, &plane).unwrap();
        let image = shaded_relief(&field, &options).unwrap();
        for pixel in &image.rgb {
            for (&found, &own) in pixel.iter().zip(&own) {
                let expected = (1.055 * (linear(own) * share).powf(1.0 / 2.4) - 0.055) * 255.0;
                assert!((f64::from(found) - expected).abs() <= 1.01, "{found} not {expected}");
            }
        }
    }
}

#[test]
fn reliefs_have_the_size_asked_for() {
    let values = hills(40, 30);
    let field = HeightField::new(40, 30, 5.0, &values).unwrap();
    for (scale, size) in [(1.0, (40, 30)), (3.0, (120, 90)), (0.5, (20, 15)), (1.5, (60, 45))] {
        let options =
            ReliefOptions { pixels_per_node: scale, ..ReliefOptions::new(ground("batlow")) };
        let image = shaded_relief(&field, &options).unwrap();
        assert_eq!((image.width, image.height, image.rgb.len()), (size.0, size.1, size.0 * size.1));
    }
}

/// Water covers exactly the nodes below its level.
#[test]
fn water_covers_what_lies_below_it() {
    let values = hills(40, 30);
    let field = HeightField::new(40, 30, 5.0, &values).unwrap();
    let dry = ReliefOptions::new(ground("lajolla"));
    let wet = ReliefOptions { water: Some(Water::at(1.0, 2.0)), ..dry.clone() };
    let (dry, wet) = (shaded_relief(&field, &dry).unwrap(), shaded_relief(&field, &wet).unwrap());
    for ((dry, wet), &height) in dry.rgb.iter().zip(&wet.rgb).zip(&values) {
        assert_eq!(dry == wet, height >= 1.0, "height {height}");
    }
}

fn small(surroundings: Surroundings) -> PerspectiveOptions {
    PerspectiveOptions { size: [96, 64], surroundings, ..PerspectiveOptions::new(ground("sand")) }
}

fn block() -> Surroundings {
    Surroundings::Block { depth_m: None, colour: [120, 100, 80] }
}

/// A lone spire stands in the picture where the camera says.
#[test]
fn a_spire_appears_where_its_tip_projects() {
    let (width, height) = (65, 65);
    let spire = heights(width, height, |x, y| if (x, y) == (20.0, 40.0) { 30.0 } else { 0.0 });
    let field = HeightField::new(width, height, 1.0, &spire).unwrap();
    let sky = [[0, 0, 255]; 2];
    let options =
        PerspectiveOptions { pitch_deg: 4.0, sky, haze: 0.0, size: [480, 320], ..small(block()) };
    let image = render(&field, &options).unwrap();
    let camera = camera(&field, &options).unwrap();
    let tip = glam::DVec3::new(20.0, (height - 1 - 40) as f64, 30.0);
    let [column, row] = camera.project(tip).unwrap();
    let is_sky = |column: usize, row: usize| image.pixel(column, row)[0] < 20;
    let first = (0..image.height).find(|&row| !is_sky(column as usize, row)).unwrap() as f64;
    assert!((first - row).abs() <= 3.0, "the tip is at row {first} instead of {row}");
    let beside = (0..image.width).filter(|&x| !is_sky(x, first as usize + 1));
    assert!(beside.into_iter().all(|x| (x as f64 - column).abs() <= 3.0));
}

#[test]
fn the_whole_block_is_in_the_picture() {
    let values = hills(48, 32);
    let field = HeightField::new(48, 32, 5.0, &values).unwrap();
    let sky = [[0, 0, 255]; 2];
    for (bearing_deg, pitch_deg) in [(30.0, 32.0), (200.0, 70.0), (90.0, 8.0)] {
        let options =
            PerspectiveOptions { bearing_deg, pitch_deg, sky, haze: 0.0, ..small(block()) };
        let image = render(&field, &options).unwrap();
        let is_sky = |pixel: [u8; 3]| pixel[2] == 255 && pixel[0] < 2;
        let edge =
            (0..96).flat_map(|x| [(x, 0), (x, 63)]).chain((0..64).flat_map(|y| [(0, y), (95, y)]));
        assert!(edge.into_iter().all(|(x, y)| is_sky(image.pixel(x, y))), "{bearing_deg}");
        let filled = image.rgb.iter().filter(|pixel| !is_sky(**pixel)).count();
        assert!(filled * 4 > image.rgb.len(), "only {filled} pixels show the block");
    }
}

#[test]
fn endless_ground_fills_the_picture_below_the_horizon() {
    let values = heights(64, 64, |x, _| 2.0 * (x / 64.0 * std::f64::consts::TAU).sin());
    let field = HeightField::new(64, 64, 1.0, &values).unwrap();
    let sky = [[0, 0, 255]; 2];
    let options =
        PerspectiveOptions { pitch_deg: 30.0, sky, haze: 0.0, ..small(Surroundings::Repeat) };
    let image = render(&field, &options).unwrap();
    assert!(image.rgb.iter().all(|pixel| pixel[0] > 20), "no hole in the ground");
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let values = hills(48, 32);
    let field = HeightField::new(48, 32, 5.0, &values).unwrap();
    let water = Some(Water::at(-2.0, 2.0));
    let draw = |threads: usize| -> Vec<Image> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let relief = ReliefOptions {
                pixels_per_node: 2.0,
                smoothing_nodes: 0.8,
                ..ReliefOptions::new(ground("batlow"))
            };
            let views = [block(), Surroundings::Repeat].map(|around| PerspectiveOptions {
                water,
                smoothing_nodes: 0.8,
                ..small(around)
            });
            let mut images = vec![shaded_relief(&field, &relief).unwrap()];
            images.extend(views.map(|options| render(&field, &options).unwrap()));
            images
        })
    };
    let one = draw(1);
    assert!(one == draw(2) && one == draw(8));
}

#[test]
fn flat_fields_have_the_colours_of_their_values() {
    let map = ColourMap::named("viridis").unwrap();
    let values = [0.0, 1.0, f64::NAN, 0.5, 7.0, -7.0];
    let image = flat::colour_field(&values, 3, 2, map, Some([0.0, 1.0]), 2).unwrap();
    assert_eq!((image.width, image.height), (6, 4));
    let ends = [map.colour(0.0), map.colour(1.0)];
    assert_eq!(
        (image.pixel(1, 1), image.pixel(2, 0), image.pixel(2, 3)),
        (ends[0], ends[1], ends[1])
    );
    assert_eq!((image.pixel(5, 3), image.pixel(0, 2)), (ends[0], map.colour(0.5)));
    let [red, green, blue] = image.pixel(4, 0);
    assert!(red == green && green == blue, "NaN is grey");
    let bar =
        flat::ColourBar { colours: map, range: [0.0, 1.0], label: "share".into(), text_size: 12.0 };
    let with_bar = bar.beside(&flat::colour_field(&values, 3, 2, map, None, 50).unwrap()).unwrap();
    assert!(with_bar.width > 150 && with_bar.height == 100);
    assert_eq!(with_bar.pixel(25, 25), with_bar.pixel(2, 2));
}

#[test]
fn figures_keep_their_panels_whole_and_in_order() {
    let panel = |side: usize, colour: [u8; 3]| Panel {
        image: Image::filled(side, side, colour).unwrap(),
        caption: "some words about it".into(),
    };
    let rows = [
        Row {
            heading: "first".into(),
            panels: vec![panel(60, [250, 0, 0]), panel(90, [0, 250, 0])],
        },
        Row { heading: String::new(), panels: vec![panel(80, [0, 0, 250])] },
    ];
    let page = panels(&rows, &MontageOptions::default()).unwrap();
    assert_eq!(page.width, 3 * 16 + 80 + 90);
    for (side, colour) in [(60, [250, 0, 0]), (90, [0, 250, 0]), (80, [0, 0, 250])] {
        let count = page.rgb.iter().filter(|pixel| **pixel == colour).count();
        assert_eq!(count, side * side);
    }
    let first = |colour: [u8; 3]| page.rgb.iter().position(|pixel| *pixel == colour).unwrap();
    let (red, green, blue) = (first([250, 0, 0]), first([0, 250, 0]), first([0, 0, 250]));
    assert!(red % page.width < green % page.width && green < blue);
    let inked = page.rgb.iter().filter(|pixel| pixel.iter().all(|&part| part < 100)).count();
    assert!(inked > 200, "captions are written: {inked}");
    assert!(matches!(panels(&[], &MontageOptions::default()), Err(ViewError::TooSmall { .. })));
}

#[test]
fn bad_fields_are_refused_with_the_place() {
    let mut values = hills(10, 8);
    assert!(matches!(
        HeightField::new(10, 7, 1.0, &values),
        Err(ViewError::Length { found: 80, .. })
    ));
    assert!(matches!(HeightField::new(80, 1, 1.0, &values), Err(ViewError::TooSmall { .. })));
    for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(HeightField::new(10, 8, spacing, &values), Err(ViewError::Option { .. })));
    }
    for bad in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        values[37] = bad;
        let error = HeightField::new(10, 8, 1.0, &values).unwrap_err();
        assert!(error.to_string().contains("column 7, row 3"), "{error}");
    }
}

#[test]
fn options_out_of_range_are_refused_by_name() {
    let values = hills(10, 8);
    let field = HeightField::new(10, 8, 1.0, &values).unwrap();
    let relief = |change: fn(&mut ReliefOptions)| {
        let mut options = ReliefOptions::new(ground("batlow"));
        change(&mut options);
        shaded_relief(&field, &options).unwrap_err().to_string()
    };
    assert!(relief(|o| o.vertical_exaggeration = f64::NAN).contains("vertical_exaggeration"));
    assert!(relief(|o| o.pixels_per_node = 0.0).contains("pixels_per_node"));
    assert!(relief(|o| o.pixels_per_node = 0.01).contains("0 x 0"));
    assert!(relief(|o| o.light.altitude_deg = -5.0).contains("altitude_deg"));
    assert!(relief(|o| o.ground.contour_m = Some(0.0)).contains("contour_m"));
    let view = |change: fn(&mut PerspectiveOptions)| {
        let mut options = small(block());
        change(&mut options);
        render(&field, &options).unwrap_err().to_string()
    };
    assert!(view(|o| o.size = [0, 5]).contains("0 x 5"));
    assert!(view(|o| o.size = [usize::MAX, 5]).contains("more than"));
    assert!(view(|o| o.supersampling = 0).contains("supersampling"));
    assert!(view(|o| o.pitch_deg = 91.0).contains("pitch_deg"));
    assert!(view(|o| o.zoom = 0.0).contains("zoom"));
    assert!(view(|o| o.water = Some(Water::at(1e9, 1.0))).contains("water"));
    assert!(view(|o| o.vertical_exaggeration = 1e6).contains("vertical_exaggeration"));
}

/// Extreme but allowed options end, whatever they show.
#[test]
fn extreme_options_come_to_an_end() {
    let values = hills(16, 12);
    let field = HeightField::new(16, 12, 1.0, &values).unwrap();
    let flat = vec![3.0; 4];
    let smallest = HeightField::new(2, 2, 1e-6, &flat).unwrap();
    for field in [field, smallest] {
        for around in [block(), Surroundings::Repeat] {
            for (pitch_deg, zoom, altitude_deg) in
                [(0.0, 1000.0, 0.1), (90.0, 0.01, 90.0), (0.0, 0.01, 0.1), (90.0, 1000.0, 45.0)]
            {
                let mut options = PerspectiveOptions { pitch_deg, zoom, ..small(around) };
                options.light.altitude_deg = altitude_deg;
                options.water = Some(Water::at(3.01, 1e-6));
                options.field_of_view_deg = 150.0;
                assert_eq!(render(&field, &options).unwrap().rgb.len(), 96 * 64);
            }
        }
    }
}

fn is_blue([red, _, blue]: [u8; 3]) -> bool {
    blue > red.saturating_add(12)
}

/// A ditch that runs down a slope of one in five, full to half its depth.
#[test]
fn rivers_run_down_slopes_between_their_banks() {
    let (width, height) = (60, 40);
    let ditch = |x: f64| (1.0 - (x - 30.0).abs() / 6.0).max(0.0);
    let bed = heights(width, height, |x, y| -0.2 * y - 4.0 * ditch(x));
    let depths = heights(width, height, |x, _| (4.0 * ditch(x) - 2.0).max(0.0));
    let dry = HeightField::new(width, height, 1.0, &bed).unwrap();
    let wet = dry.with_water(&depths).unwrap();
    let mut relief = ReliefOptions::new(ground("sand"));
    relief.water = Some(Water::new(0.3));
    let map = shaded_relief(&wet, &relief).unwrap();
    for row in 2..height - 2 {
        let blue: Vec<usize> =
            (0..width).filter(|&column| is_blue(map.pixel(column, row))).collect();
        assert_eq!((blue.first(), blue.last()), (Some(&28), Some(&32)), "row {row}");
    }
    let plain = ReliefOptions { water: None, ..relief.clone() };
    assert_eq!(shaded_relief(&dry, &relief).unwrap(), shaded_relief(&dry, &plain).unwrap());
    // A camera above sees nothing but the river change, in a strip down its middle.
    let mut view = PerspectiveOptions::new(ground("sand"));
    (view.size, view.pitch_deg, view.bearing_deg, view.haze) = ([300, 200], 90.0, 0.0, 0.0);
    view.water = Some(Water::new(0.3));
    let [image, bare] = [wet, dry].map(|field| render(&field, &view).unwrap());
    for row in [70, 100, 130] {
        let changed = |column: &usize| image.pixel(*column, row) != bare.pixel(*column, row);
        let strip: Vec<usize> = (0..300).filter(changed).collect();
        assert!(is_blue(image.pixel(150, row)), "row {row}");
        assert!((10..40).contains(&strip.len()), "row {row}: {strip:?}");
        assert!(strip[0] > 130 && strip[strip.len() - 1] < 170, "row {row}: {strip:?}");
    }
}
