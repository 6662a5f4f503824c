//! Mesh files hold the vertices and triangles that they were given, in the axes they promise.

#[expect(dead_code, reason = "not every test counts files")]
mod support;

use std::fs;

use landform_io::mesh::height_mesh;
use landform_io::{Body, IfExists, Mesh, Metadata, Raster, write_mesh, write_meshes};
use serde_json::Value;
use support::Scratch;

/// A roof of 3 x 2 nodes, 10 m apart; the ridge runs north-south.
fn roof() -> Mesh {
    let raster = Raster::local(3, 2, 10.0, vec![0.0, 5.0, 0.0, 1.0, 6.0, 1.0]);
    let mut mesh = height_mesh(&raster, 10.0).unwrap();
    mesh.colours = vec![[255, 0, 188]; 6];
    mesh
}

fn written(name: &str, mesh: &Mesh) -> Vec<u8> {
    let folder = Scratch::new("mesh_files");
    let metadata = Metadata { seed: Some(7), unit: Some("m".into()), ..Metadata::default() };
    write_mesh(folder.path(name), mesh, &metadata, IfExists::Refuse).unwrap();
    fs::read(folder.path(name)).unwrap()
}

fn single(bytes: &[u8], at: usize) -> f32 {
    f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn word(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

/// The text after the header, and the header's lines.
fn ply(bytes: &[u8]) -> (&[u8], Vec<&str>) {
    let mark = b"end_header\n";
    let end = bytes.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len();
    (&bytes[end..], std::str::from_utf8(&bytes[..end]).unwrap().lines().collect())
}

#[test]
fn obj_has_vertices_colours_and_faces_from_one() {
    let bytes = written("a.obj", &roof());
    let text = String::from_utf8(bytes).unwrap();
    let lines = |start: &'static str| text.lines().filter(move |line| line.starts_with(start));
    assert_eq!(lines("# ").collect::<Vec<_>>()[1..], ["# unit: m", "# seed: 7"]);
    assert_eq!(lines("v ").next(), Some("v 0 10 0 1.0000 0.0000 0.7373"));
    assert_eq!(lines("v ").count(), 6);
    assert_eq!(lines("vt ").next_back(), Some("vt 1 0"));
    assert_eq!(lines("f ").next(), Some("f 1/1/1 4/4/4 5/5/5"));
    assert_eq!(lines("f ").count(), 4);
}

#[test]
fn ply_has_the_length_and_numbers_of_its_header() {
    let bytes = written("a.ply", &roof());
    let (body, header) = ply(&bytes);
    assert!(header.contains(&"element vertex 6") && header.contains(&"element face 4"));
    assert!(header.contains(&"comment seed: 7"));
    let vertex = 4 * (3 + 3 + 2) + 3;
    assert_eq!(body.len(), 6 * vertex + 4 * (1 + 3 * 4));
    assert_eq!([0, 4, 8].map(|at| single(body, vertex + at)), [10.0, 10.0, 5.0]);
    assert_eq!(body[vertex - 3..vertex], [255, 0, 188]);
    let face = &body[6 * vertex..];
    assert_eq!((face[0], word(face, 1), word(face, 5), word(face, 9)), (3, 0, 3, 4));
}

#[test]
fn stl_has_fifty_bytes_a_triangle() {
    let mesh = roof();
    let bytes = written("a.stl", &mesh);
    assert!(!bytes.starts_with(b"solid"));
    assert!(String::from_utf8_lossy(&bytes[..80]).contains("seed: 7"));
    assert_eq!(word(&bytes, 80), 4);
    assert_eq!(bytes.len(), 84 + 4 * 50);
    // The first triangle joins (0, 10, 0), (0, 0, 1) and (10, 0, 6): normal (-5, 1, 10).
    let length = 126.0_f32.sqrt();
    for (axis, part) in [-5.0, 1.0, 10.0].into_iter().enumerate() {
        assert!((single(&bytes, 84 + 4 * axis) - part / length).abs() < 1e-6);
    }
    assert_eq!([0, 4, 8].map(|at| single(&bytes, 96 + at)), [0.0, 10.0, 0.0]);
}

/// The JSON and the binary chunk of a GLB file, after a check of all lengths.
fn glb(bytes: &[u8]) -> (Value, &[u8]) {
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(bytes, 4), word(bytes, 8)), (2, bytes.len()));
    let text = word(bytes, 12);
    assert_eq!((text % 4, &bytes[16..20]), (0, &b"JSON"[..]));
    let binary = 20 + text;
    assert_eq!(word(bytes, binary), bytes.len() - binary - 8);
    assert_eq!(&bytes[binary + 4..binary + 8], b"BIN\0");
    (serde_json::from_slice(&bytes[20..binary]).unwrap(), &bytes[binary + 8..])
}

/// East, north, up becomes x, -z, y; bounds are those of the stored numbers.
#[test]
fn glb_is_y_up_with_bounds_and_linear_colours() {
    let bytes = written("a.glb", &roof());
    let (document, binary) = glb(&bytes);
    assert_eq!(document["asset"]["extras"]["seed"], "7");
    let attributes = &document["meshes"][0]["primitives"][0]["attributes"];
    let part = |name: &str| {
        let number = attributes[name].as_u64().unwrap() as usize;
        let start = document["bufferViews"][number]["byteOffset"].as_u64().unwrap();
        (&document["accessors"][number], &binary[start as usize..])
    };
    let (accessor, positions) = part("POSITION");
    assert_eq!(accessor["min"], serde_json::json!([0.0, 0.0, -10.0]));
    assert_eq!(accessor["max"], serde_json::json!([20.0, 6.0, -0.0]));
    assert_eq!([12, 16, 20].map(|at| single(positions, at)), [10.0, 5.0, -10.0]);
    let (_, normals) = part("NORMAL");
    assert!((0..6).all(|vertex| single(normals, 12 * vertex + 4) > 0.7));
    let (accessor, colours) = part("COLOR_0");
    assert_eq!(
        (accessor["type"].as_str(), accessor["normalized"].as_bool()),
        (Some("VEC4"), Some(true))
    );
    // sRGB 188 of 255 is half the light, within one part in three hundred.
    let parts = colours.as_chunks().0[..4].iter().map(|bytes| u16::from_le_bytes(*bytes));
    let parts: Vec<u16> = parts.collect();
    assert_eq!((parts[0], parts[1], parts[3]), (65535, 0, 65535));
    assert!((f64::from(parts[2]) / 65535.0 - 0.5).abs() < 0.004, "{parts:?}");
    let sum: u64 =
        (0..5).map(|view| document["bufferViews"][view]["byteLength"].as_u64().unwrap()).sum();
    assert_eq!(sum as usize, binary.len());
}

#[test]
fn bare_meshes_have_no_empty_lists() {
    let roof = roof();
    let bare = Mesh { positions: roof.positions, triangles: roof.triangles, ..Mesh::default() };
    let bytes = written("a.glb", &bare);
    let (document, _) = glb(&bytes);
    assert_eq!(document["accessors"].as_array().unwrap().len(), 2);
    let bytes = written("a.ply", &bare);
    assert_eq!(ply(&bytes).0.len(), 6 * 12 + 4 * 13);
    let text = String::from_utf8(written("a.obj", &bare)).unwrap();
    assert_eq!(text.lines().last(), Some("f 5 6 3"));
}

/// The roof, and a pond that is half clear.
fn roof_and_pond(name: &str) -> Vec<u8> {
    let raster = Raster::local(2, 2, 10.0, vec![3.0; 4]);
    let mut pond = height_mesh(&raster, 10.0).unwrap();
    pond.colours = vec![[0, 0, 255]; 4];
    pond.opacities = vec![128; 4];
    let folder = Scratch::new("mesh_files");
    let bodies = [Body { name: "ground", mesh: &roof() }, Body { name: "water", mesh: &pond }];
    write_meshes(folder.path(name), &bodies, &Metadata::default(), IfExists::Refuse).unwrap();
    fs::read(folder.path(name)).unwrap()
}

#[test]
fn meshes_of_one_file_keep_their_names_and_numbers() {
    let text = String::from_utf8(roof_and_pond("a.obj")).unwrap();
    let (ground, water) = text.split_once("o water\n").unwrap();
    assert!(ground.contains("\no ground\nv 0 10 0 "));
    assert_eq!(ground.lines().last(), Some("f 5/5/5 6/6/6 3/3/3"));
    assert!(water.ends_with("f 7/7/7 9/9/9 10/10/10\nf 7/7/7 10/10/10 8/8/8\n"), "{water}");
    let bytes = roof_and_pond("a.ply");
    let (body, header) = ply(&bytes);
    assert!(header.contains(&"element vertex 10") && header.contains(&"element face 6"));
    assert!(header.contains(&"property uchar alpha"));
    let vertex = 4 * (3 + 3 + 2) + 4;
    assert_eq!([body[vertex - 1], body[7 * vertex - 1]], [255, 128]);
    let face = &body[10 * vertex + 4 * 13..];
    assert_eq!((face[0], word(face, 1), word(face, 5), word(face, 9)), (3, 6, 8, 9));
    let bytes = roof_and_pond("a.stl");
    assert_eq!((word(&bytes, 80), bytes.len()), (6, 84 + 6 * 50));
}

#[test]
fn translucent_meshes_blend_and_opaque_ones_do_not() {
    let bytes = roof_and_pond("a.glb");
    let (document, binary) = glb(&bytes);
    let names: Vec<&str> =
        document["nodes"].as_array().unwrap().iter().map(|n| n["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["ground", "water"]);
    assert_eq!(document["scenes"][0]["nodes"], serde_json::json!([0, 1]));
    assert_eq!(document["materials"][0].get("alphaMode"), None);
    assert_eq!(document["materials"][1]["alphaMode"], "BLEND");
    let water = &document["meshes"][1]["primitives"][0];
    assert_eq!(water["material"], 1);
    let part = |number: &Value| {
        let view = &document["bufferViews"][number.as_u64().unwrap() as usize];
        let [start, length] =
            ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
        &binary[start..start + length]
    };
    // Numbers of vertices begin anew with each mesh.
    let indices = part(&water["indices"]);
    let indices: Vec<usize> = (0..6).map(|at| word(indices, 4 * at)).collect();
    assert_eq!(indices, [0, 2, 3, 0, 3, 1]);
    let alpha = &part(&water["attributes"]["COLOR_0"])[6..8];
    assert_eq!(u16::from_le_bytes(alpha.try_into().unwrap()), 128 * 257);
    let alpha = &part(&document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"])[6..8];
    assert_eq!(alpha, [255, 255]);
}
