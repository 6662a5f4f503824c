//! What every generator keeps: length, finite values, same bits on any threads, refusals.

use landform_graph::{Boundary, Connectivity, Lattice};
use landform_synth::*;
use serde_json::{Value, json};

/// Makes a generator from its parameters as a scenario file would.
fn parse(name: &str, parameters: Value) -> Result<Box<dyn Generator>, serde_json::Error> {
    Ok(match name {
        "Uniform" => Box::new(serde_json::from_value::<Uniform>(parameters)?),
        "WhiteNoise" => Box::new(serde_json::from_value::<WhiteNoise>(parameters)?),
        "SmoothNoise" => Box::new(serde_json::from_value::<SmoothNoise>(parameters)?),
        "Ramp" => Box::new(serde_json::from_value::<Ramp>(parameters)?),
        "Sinusoid" => Box::new(serde_json::from_value::<Sinusoid>(parameters)?),
        "Cone" => Box::new(serde_json::from_value::<Cone>(parameters)?),
        "GaussianHill" => Box::new(serde_json::from_value::<GaussianHill>(parameters)?),
        "Ridge" => Box::new(serde_json::from_value::<Ridge>(parameters)?),
        "FractalNoise" => Box::new(serde_json::from_value::<FractalNoise>(parameters)?),
        "MidpointDisplacement" => {
            Box::new(serde_json::from_value::<MidpointDisplacement>(parameters)?)
        }
        "Faulting" => Box::new(serde_json::from_value::<Faulting>(parameters)?),
        "ConstructionTree" => Box::new(serde_json::from_value::<ConstructionTree>(parameters)?),
        "Dendrite" => Box::new(serde_json::from_value::<Dendrite>(parameters)?),
        "Aggregate" => Box::new(serde_json::from_value::<Aggregate>(parameters)?),
        "LSystem" => Box::new(serde_json::from_value::<LSystem>(parameters)?),
        "Dendry" => Box::new(serde_json::from_value::<Dendry>(parameters)?),
        "ImplicitVolume" => Box::new(serde_json::from_value::<ImplicitVolume>(parameters)?),
        "Mask" => Box::new(serde_json::from_value::<Mask>(parameters)?),
        "SpectralFbm" => Box::new(serde_json::from_value::<SpectralFbm>(parameters)?),
        other => panic!("no generator {other}"),
    })
}

/// Name and schema of every generator.
fn generators() -> Vec<(&'static str, schemars::Schema)> {
    vec![
        ("Uniform", schemars::schema_for!(Uniform)),
        ("WhiteNoise", schemars::schema_for!(WhiteNoise)),
        ("SmoothNoise", schemars::schema_for!(SmoothNoise)),
        ("Ramp", schemars::schema_for!(Ramp)),
        ("Sinusoid", schemars::schema_for!(Sinusoid)),
        ("Cone", schemars::schema_for!(Cone)),
        ("GaussianHill", schemars::schema_for!(GaussianHill)),
        ("Ridge", schemars::schema_for!(Ridge)),
        ("FractalNoise", schemars::schema_for!(FractalNoise)),
        ("MidpointDisplacement", schemars::schema_for!(MidpointDisplacement)),
        ("Faulting", schemars::schema_for!(Faulting)),
        ("ConstructionTree", schemars::schema_for!(ConstructionTree)),
        ("Dendrite", schemars::schema_for!(Dendrite)),
        ("Aggregate", schemars::schema_for!(Aggregate)),
        ("LSystem", schemars::schema_for!(LSystem)),
        ("Dendry", schemars::schema_for!(Dendry)),
        ("ImplicitVolume", schemars::schema_for!(ImplicitVolume)),
        ("Mask", schemars::schema_for!(Mask)),
        ("SpectralFbm", schemars::schema_for!(SpectralFbm)),
    ]
}

fn plane(size: [usize; 2], boundary: Boundary) -> Lattice {
    Lattice::plane(size, 10.0, Connectivity::Eight, [boundary; 2]).unwrap()
}

fn lattices() -> Vec<Lattice> {
    let open = [Boundary::Open; 3];
    let volume = Lattice::volume([7, 5, 4], 10.0, Connectivity::Voxel26, open).unwrap();
    let mut all: Vec<Lattice> =
        [[70, 40], [9, 7], [1, 5], [1, 1]].map(|size| plane(size, Boundary::Open)).to_vec();
    all.extend([[40, 24], [9, 7], [3, 3]].map(|size| plane(size, Boundary::Periodic)));
    all.push(volume);
    all
}

/// A numeric parameter of a generator.
struct Number {
    name: String,
    /// Its limits in the schema.
    limits: [Value; 2],
    /// Values a little beyond them; for whole numbers only those that are not negative.
    beyond: Vec<Value>,
}

/// Numeric parameters of a generator.
fn numbers(schema: &schemars::Schema) -> Vec<Number> {
    let number = |(name, spec): (&String, &Value)| {
        let limits = [spec.get("minimum")?.clone(), spec.get("maximum")?.clone()];
        let beyond = match (spec["type"] == "integer", limits[0].as_f64()?, limits[1].as_f64()?) {
            (true, least, most) => [least as i64 - 1, most as i64 + 1]
                .into_iter()
                .filter(|n| *n >= 0)
                .map(Value::from)
                .collect(),
            (false, least, most) => {
                let step = (most - least) * 1e-3;
                vec![json!(least - step), json!(most + step)]
            }
        };
        Some(Number { name: name.clone(), limits, beyond })
    };
    schema.as_value()["properties"].as_object().unwrap().iter().filter_map(number).collect()
}

#[test]
fn every_parameter_is_documented() {
    for (name, schema) in generators() {
        assert!(schema.get("description").is_some(), "{name}");
        for (parameter, spec) in schema.as_value()["properties"].as_object().unwrap() {
            assert!(spec.get("description").is_some(), "{name}.{parameter}");
            assert!(spec.get("default").is_some(), "{name}.{parameter}");
            assert_eq!(parameter.ends_with("_m"), spec["x-unit"] == "m", "{name}.{parameter}");
            assert_eq!(parameter.ends_with("_deg"), spec["x-unit"] == "deg", "{name}.{parameter}");
        }
    }
}

#[test]
fn same_bits_on_any_number_of_threads() {
    let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let [one, two, eight] = [on(1), on(2), on(8)];
    for (name, _) in generators() {
        let generator = parse(name, json!({})).unwrap();
        for lattice in lattices() {
            let bits = |seed| {
                let field = generator.generate(&lattice, seed);
                field.map(|field| field.into_iter().map(f64::to_bits).collect::<Vec<u64>>())
            };
            let alone = one.install(|| bits(5));
            assert_eq!(alone, two.install(|| bits(5)), "{name}");
            assert_eq!(alone, eight.install(|| bits(5)), "{name}");
        }
    }
}

#[test]
fn only_random_fields_depend_on_the_seed() {
    let lattice = plane([40, 24], Boundary::Open);
    for (name, _) in generators() {
        let generator = parse(name, json!({})).unwrap();
        let [first, second] = [1, 2].map(|seed| generator.generate(&lattice, seed).unwrap());
        let even = [
            "Uniform",
            "Ramp",
            "Sinusoid",
            "Cone",
            "GaussianHill",
            "Ridge",
            "ConstructionTree",
            "ImplicitVolume",
            "LSystem",
            "Mask",
        ];
        assert_eq!(first == second, even.contains(&name), "{name}");
    }
}

/// Every number is tried at both ends of the range that the schema states: the field is finite
/// and of the right length, or refused for its lattice and not for its range.
#[test]
fn accepted_parameters_give_finite_fields() {
    let surfaces = [
        "SpectralFbm",
        "FractalNoise",
        "MidpointDisplacement",
        "Faulting",
        "ConstructionTree",
        "Dendry",
    ];
    let unclosed = [
        "Ramp",
        "Sinusoid",
        "MidpointDisplacement",
        "Faulting",
        "ConstructionTree",
        "Dendry",
        "ImplicitVolume",
        "Mask",
        // These refuse too small particles and too long strings.
        "Aggregate",
        "LSystem",
    ];
    let mut fields = 0;
    for (name, schema) in generators() {
        for Number { name: parameter, limits, .. } in numbers(&schema) {
            for value in limits {
                let generator = parse(name, json!({ parameter.clone(): value })).unwrap();
                for lattice in lattices() {
                    match generator.generate(&lattice, 3) {
                        Ok(field) => {
                            assert_eq!(field.len(), lattice.node_count());
                            assert!(field.iter().all(|v| v.is_finite()), "{name}.{parameter}");
                            fields += 1;
                        }
                        Err(SynthError::OutOfRange { parameter, value, least, most, .. }) => {
                            let of_lattice = match parameter {
                                "correlation_length_m" | "wavelength_m" | "cell_m" => value < least,
                                "levels" => value > most,
                                _ => false,
                            };
                            assert!(of_lattice, "{name}.{parameter}");
                        }
                        Err(SynthError::Volume { .. }) => assert!(surfaces.contains(&name)),
                        Err(refusal) => {
                            assert!(unclosed.contains(&name), "{refusal}");
                        }
                    }
                }
            }
        }
    }
    assert!(fields > 300, "{fields} fields");
}

#[test]
fn values_beyond_the_stated_range_are_refused() {
    let lattice = plane([40, 24], Boundary::Open);
    for (name, schema) in generators() {
        for Number { name: parameter, beyond, .. } in numbers(&schema) {
            for value in beyond {
                let generator = parse(name, json!({ parameter.clone(): value })).unwrap();
                let refused = generator.generate(&lattice, 3).unwrap_err();
                assert!(refused.to_string().contains(&parameter), "{name}: {refused}");
            }
        }
    }
    let absent = WhiteNoise { mean_m: f64::NAN, ..Default::default() };
    assert!(absent.generate(&lattice, 0).is_err());
}

#[test]
fn unknown_parameters_are_refused() {
    for (name, _) in generators() {
        let refused = parse(name, json!({ "amplitued_m": 1.0 })).map(|_| ()).unwrap_err();
        assert!(refused.to_string().contains("amplitued_m"), "{name}");
    }
}
