//! `landform analyze` of caves: surveys, volumes, and what is neither.

use landform::io::{IfExists, Metadata, SampleType, npy};
use landform_tests::{Program, Scratch};
use serde_json::Value;

fn object(scratch: &Scratch, line: &str) -> Value {
    let program = Program::within(scratch.folder()).line(&format!("analyze --json {line}"));
    serde_json::from_str(&program.run().good()).expect("JSON")
}

#[test]
fn a_survey_is_measured_and_drawn() {
    let scratch = Scratch::new("survey");
    // A square with a tail; the splay does not count.
    scratch.write(
        "a_stations.csv",
        "station,x,y,z\nA,0,0,0\nB,10,0,0\nC,10,10,0\nD,0,10,0\nE,-5,0,0\n",
    );
    scratch.write("a_legs.csv", "from,to,splay\nA,B,0\nB,C,0\nC,D,0\nD,A,0\nA,E,0\nE,C,1\n");
    let found = object(&scratch, "a_legs.csv");
    assert_eq!(found["kind"], "cave survey");
    assert_eq!((&found["stations"], &found["legs"]), (&5.into(), &5.into()));
    assert_eq!(found["shape"]["length_m"], 45.0);
    assert_eq!(found["shape"]["cyclomatic_number"], 1);
    assert!(found["indices"].is_null());
    let within = &found["observed"][1];
    assert_eq!((&within["name"], &within["value"]), (&"mean_branch_length_m".into(), &22.5.into()));
    assert_eq!(within["within"], true);
    let said = Program::within(scratch.folder()).line("analyze a_legs.csv -o out").run().good();
    assert!(
        said.contains("5 stations, 5 legs, 45 m") && said.contains("in 31 caves, within"),
        "{said}"
    );
    assert!(scratch.path("out/a_legs.png").is_file() && scratch.path("out/a_legs.svg").is_file());
}

#[test]
fn a_volume_is_measured_from_a_least_value() {
    let scratch = Scratch::new("voxels");
    // A gallery 3 voxels wide and high in rock of porosity 0.1.
    let values: Vec<f64> = (0..8 * 9 * 40)
        .map(|voxel| {
            let [y, z] = [voxel / 40 % 9, voxel / 360];
            if (3..6).contains(&y) && (2..5).contains(&z) { 0.8 } else { 0.1 }
        })
        .collect();
    let path = scratch.path("rock.npy");
    let (metadata, shape) = (Metadata::default(), [8, 9, 40]);
    npy::write_array(&path, &shape, &values, &metadata, SampleType::F64, IfExists::Refuse)
        .expect("written");
    let found = object(&scratch, "rock.npy --spacing-m 0.5");
    assert_eq!(found["kind"], "cave voxels");
    assert_eq!(found["indices"]["totals"]["volume_m3"], 45.0);
    assert_eq!(found["indices"]["totals"]["field_m2"], 30.0);
    assert_eq!(found["indices"]["porosity_percent"], 100.0);
    let length = found["shape"]["length_m"].as_f64().expect("a length");
    assert!((17.5..=20.0).contains(&length), "{length}");
    let program = Program::within(scratch.folder()).line("analyze rock.npy --at-least 0.9");
    let said = program.run().refused();
    assert!(said.contains("no leg with a length") && said.contains("--at-least"), "{said}");
}
