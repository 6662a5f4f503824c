//! Rivers and lakes as lines and areas.

use std::fs;

use landform::io::read_raster;
use landform_tests::{Program, Scratch, repository};
use serde_json::Value;

/// A valley that falls to the south, with a lake in a bowl of the plain beside it; no water moves.
const STILL: &str = r#"(
    title: "Valley and lake",
    seed: 1,
    domain: Raster(path: "bed.asc", connectivity: Eight),
    initial: [
        (field: "bed", from: DomainRaster()),
        (field: "water", from: RasterFile(path: "water.asc")),
    ],
    stages: [(name: "still", processes: [WaterColumn(rain_m: 0.0, sweeps: 1, loss: 0.0)], stop: Iterations(1))],
    outputs: [
        RiverLines(file: "rivers.geojson", water: "water", flow: "flow", channel_nodes: 40),
        RiverLines(file: "dry.csv", channel_nodes: 40),
        LakeOutlines(file: "lakes.geojson"),
        Mesh(file: "valley.obj", field: "bed", water: (field: "water")),
        Picture(file: "section.svg", field: "bed", look: Section(
            from: (0.0, 0.5862), to: (1.0, 0.5862), water: (field: "water"),
        )),
        Picture(file: "section.png", field: "bed", look: Section(
            from: (0.0, 0.5862), to: (1.0, 0.5862), water: (field: "water"),
        )),
    ],
)"#;

/// A raster of 40 by 30 nodes, 20 m apart.
fn raster(value: impl Fn(usize, usize) -> f64) -> String {
    let head = "ncols 40\nnrows 30\nxllcorner 1000\nyllcorner 500\ncellsize 20\n";
    let row = |y: usize| (0..40).map(|x| format!("{} ", value(x, y))).collect::<String>() + "\n";
    head.to_owned() + &(0..30).map(row).collect::<String>()
}

fn run() -> Scratch {
    let scratch = Scratch::new("rivers");
    // A ring-shaped lake of 7 by 7 nodes round an island of 3 by 3, in a plain that falls south.
    let ring = |x: usize, y: usize| {
        let [dx, dy] = [x.abs_diff(25), y.abs_diff(12)];
        (dx.max(dy) <= 3 && dx.max(dy) >= 2).then_some(())
    };
    let plain = |y: usize| 100.0 - y as f64;
    let bed = |x: usize, y: usize| match ring(x, y) {
        Some(()) => 60.0,
        None if x <= 10 => plain(y) - 20.0 + 4.0 * x.abs_diff(5) as f64,
        None => plain(y),
    };
    let water = |x: usize, y: usize| if ring(x, y).is_some() { 5.0 } else { 0.0 };
    scratch.write("bed.asc", raster(bed));
    scratch.write("water.asc", raster(water));
    scratch.write("still.ron", STILL);
    Program::within(scratch.folder()).line("run still.ron -o o --quiet").run().good();
    scratch
}

fn features(scratch: &Scratch, file: &str) -> Vec<Value> {
    let text = fs::read_to_string(scratch.path("o").join(file)).expect("a file");
    let json: Value = serde_json::from_str(&text).expect("JSON");
    json["features"].as_array().expect("features").clone()
}

/// Twice the area within a ring, above 0 counter-clockwise.
fn twice_area(ring: &Value) -> f64 {
    let points: Vec<[f64; 2]> = serde_json::from_value(ring.clone()).expect("points");
    points.windows(2).map(|pair| pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1]).sum()
}

#[test]
fn a_lake_is_an_area_with_its_island_as_a_hole() {
    let scratch = run();
    let lakes = features(&scratch, "lakes.geojson");
    assert_eq!(lakes.len(), 1);
    let known = &lakes[0]["properties"];
    // 49 nodes less the nine of the island, of 400 m2.
    assert_eq!(known["area_m2"], 16_000.0);
    assert_eq!(known["volume_m3"], 80_000.0);
    assert_eq!([&known["level_m"], &known["depth_m"]], [65.0, 5.0]);
    let areas = lakes[0]["geometry"]["coordinates"].as_array().expect("areas");
    assert_eq!(areas.len(), 1);
    let rings = areas[0].as_array().expect("rings");
    // Corners are cut by an eighth of a node each.
    assert_eq!(
        rings.iter().map(twice_area).collect::<Vec<_>>(),
        [2.0 * 400.0 * (49.0 - 0.5), -2.0 * 400.0 * (9.0 - 0.5),]
    );
    let first: [f64; 2] = serde_json::from_value(rings[0][0].clone()).expect("a point");
    assert!((1420.0..1600.0).contains(&first[0]) && (760.0..1000.0).contains(&first[1]));
}

#[test]
fn rivers_flow_into_one_another_and_out_of_the_map() {
    let scratch = run();
    let rivers = features(&scratch, "rivers.geojson");
    let number = |river: &Value, name: &str| river["properties"][name].as_f64().expect("a number");
    let trunk = rivers.iter().max_by(|a, b| number(a, "area_m2").total_cmp(&number(b, "area_m2")));
    let trunk = trunk.expect("a river");
    assert_eq!(number(trunk, "into"), 0.0);
    // The valley's axis is the sixth column.
    let line: Vec<[f64; 2]> =
        serde_json::from_value(trunk["geometry"]["coordinates"].clone()).expect("points");
    assert!(line.iter().all(|point| point[0] == 1110.0), "{line:?}");
    assert_eq!(line.last(), Some(&[1110.0, 510.0]));
    assert_eq!(number(trunk, "width_m"), 20.0 * line.len() as f64 / (line.len() - 1) as f64);
    for river in &rivers {
        let into = number(river, "into");
        let below = rivers.iter().find(|other| number(other, "river") == into);
        assert!(
            into == 0.0 || below.is_some_and(|b| number(b, "area_m2") > number(river, "area_m2"))
        );
        assert!(number(river, "order") >= 1.0 && river["properties"]["discharge_m3"].is_number());
    }
    let dry = fs::read_to_string(scratch.path("o/dry.csv")).expect("a table");
    assert_eq!(
        dry.lines().next(),
        Some("line,river,into,order,length_m,area_m2,width_m,depth_m,x,y")
    );
}

/// Rough ground has junctions on its edge too.
#[test]
fn every_river_flows_into_one_of_the_file_or_leaves() {
    let scratch = Scratch::new("rivers");
    scratch.write(
        "rough.ron",
        r#"(
        title: "Rough ground",
        seed: 3,
        domain: Grid(size: (60, 50), spacing_m: 10.0, connectivity: Eight),
        initial: [(field: "bed", from: WhiteNoise(amplitude_m: 5.0))],
        stages: [],
        outputs: [RiverLines(file: "rivers.geojson", channel_nodes: 4)],
    )"#,
    );
    Program::within(scratch.folder()).line("run rough.ron -o o --quiet").run().good();
    let rivers = features(&scratch, "rivers.geojson");
    let numbers = |name: &str| -> Vec<u64> {
        let number = |river: &Value| river["properties"][name].as_f64().expect("a number") as u64;
        rivers.iter().map(number).collect()
    };
    let (own, into) = (numbers("river"), numbers("into"));
    assert!(own.len() > 100);
    assert!(into.iter().all(|into| *into == 0 || own.contains(into)));
    // Where one link ends the next begins.
    for (river, into) in rivers.iter().zip(&into) {
        let points = |river: &Value| river["geometry"]["coordinates"].as_array().cloned();
        let end = points(river).and_then(|points| points.last().cloned());
        if let Some(next) = own.iter().position(|own| own == into) {
            assert_eq!(end, points(&rivers[next]).and_then(|points| points.first().cloned()));
        }
    }
}

/// A slope that runs on below a sea: rain leaves the land for it, and its floor stays.
#[test]
fn water_that_reaches_the_sea_is_gone_and_its_floor_stays() {
    let scratch = Scratch::new("sea");
    let slope = "initial: [(field: \"bed\", from: Ramp(tilt_deg: 10.0, uphill_deg: 90.0)), \
                 (field: \"bed\", combine: Add, from: Uniform(value: -20.0))]";
    scratch.write(
        "sea.ron",
        format!(
            "(title: \"Sea\", seed: 1, domain: Grid(size: (24, 40), spacing_m: 10.0, \
         connectivity: Eight), {slope}, stages: [(name: \"rain\", processes: [\
         WaterColumn(sea_level_m: 0.0, outlets: [], loss: 0.0), \
         HydraulicErosion(sea_level_m: 0.0)], stop: Iterations(30))], \
         outputs: [FieldFile(file: \"start.npy\", field: \"bed\", when: Start)])"
        ),
    );
    Program::within(scratch.folder()).line("run sea.ron -o o --quiet").run().good();
    let field = |file: &str| read_raster(scratch.path("o").join(file)).expect("a field").values;
    let (start, bed, water) =
        (field("start.npy"), field("fields/bed.npy"), field("fields/water.npy"));
    let at_sea = |node: &usize| start[*node] < 0.0;
    assert!((0..960).filter(at_sea).count() > 100);
    for node in 0..960 {
        if at_sea(&node) {
            assert_eq!((bed[node], water[node]), (start[node], 0.0));
        } else {
            assert!(bed[node] >= 0.0);
        }
    }
    assert!(bed.iter().zip(&start).any(|(bed, start)| bed < start), "land is eroded");
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let account = &report["ledger"]["accounts"]["water"];
    let [rain, sea] = [&account["entered"]["rain"], &account["left"]["sea"]]
        .map(|amount| amount.as_f64().expect("a volume"));
    let held = 100.0 * water.iter().sum::<f64>();
    assert!(sea > 0.5 * rain, "{account}");
    assert!((rain - sea - held).abs() < 1e-9 * rain, "{account}");
}

/// Figure 4.14 at half its size: what the metric counts, the table lists.
#[test]
fn captures_are_counted_and_listed() {
    let scratch = Scratch::new("captures");
    let scenario = repository().join("scenarios/thesis/fig_4_14.ron");
    let run = Program::within(scratch.folder()).args(["run", "-o", "o", "--quiet"]);
    let small = ["--set", "domain.size=(64, 64)", "--set", "metrics[2].channel_nodes=40"];
    let listed = ["--set", "outputs[1].channel_nodes=40"];
    run.args([scenario]).args(small).args(listed).run().good();
    let report = fs::read_to_string(scratch.path("o/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let counted = report["metrics"]["captures"].as_f64().expect("a number");
    let table = fs::read_to_string(scratch.path("o/captures.csv")).expect("a table");
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("iteration,x,y,area_m2,from,to"));
    let rows: Vec<Vec<f64>> = rows
        .map(|row| row.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    assert!(counted > 0.0);
    assert_eq!(rows.len() as f64, counted);
    for row in &rows {
        assert!(row[0] % 10.0 == 0.0 && row[3] >= 4000.0 && row[4] != row[5], "{row:?}");
    }
}

/// The ring-shaped lake lies at 65 m in a plain some 23 m above it.
#[test]
fn the_water_of_a_mesh_ends_below_its_shores() {
    let scratch = run();
    let text = fs::read_to_string(scratch.path("o/valley.obj")).expect("a mesh");
    let (_, water) = text.split_once("\no water\n").expect("water");
    let numbers = |line: &str| -> Vec<f64> {
        line.split_whitespace().skip(1).map(|word| word.parse().expect("a number")).collect()
    };
    let vertices: Vec<Vec<f64>> =
        water.lines().filter(|line| line.starts_with("v ")).map(numbers).collect();
    // The lake, a ring of nodes round it and one within it, without the middle of its island.
    assert_eq!(vertices.len(), 40 + 32 + 8);
    assert!(vertices.iter().all(|vertex| vertex[2] == 65.0));
    let nearest = vertices.iter().map(|vertex| (vertex[0] - 500.0).hypot(vertex[1] - 340.0));
    assert_eq!(nearest.fold(f64::INFINITY, f64::min), 20.0);
    let faces: Vec<Vec<usize>> = water
        .lines()
        .filter_map(|line| line.strip_prefix("f "))
        .map(|line| {
            line.split(' ').map(|word| word.split('/').next().unwrap().parse().unwrap()).collect()
        })
        .collect();
    // Four triangles meet in the middle of the island.
    assert_eq!(faces.len(), 2 * 8 * 8 - 4);
    for face in faces {
        let corners = face.iter().map(|vertex| &vertices[vertex - 1 - 40 * 30]);
        let [a, b, c]: [&Vec<f64>; 3] = corners.collect::<Vec<_>>().try_into().expect("a triangle");
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        assert_eq!(doubled, 400.0, "faces look up and have an area");
    }
}

#[test]
fn a_section_crosses_the_lake_on_both_sides_of_its_island() {
    let scratch = run();
    let text = fs::read_to_string(scratch.path("o/section.svg")).expect("a plot");
    assert_eq!(text.matches("fill=\"#74a9cf\"").count(), 2, "{text}");
    assert!(text.contains("distance (m)") && text.contains("height (m)"));
    assert!(text.contains("heights exaggerated 7 times"), "{text}");
    assert!(fs::metadata(scratch.path("o/section.png")).is_ok_and(|file| file.len() > 1000));
    let told = Program::within(scratch.folder())
        .line("run still.ron -o p --quiet --set outputs[4].look=Relief()")
        .run()
        .refused();
    assert!(told.contains("only plots can be written as SVG"), "{told}");
}
