//! The models in Mesa, which is called as a program of its own.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::model::{Model, Timed};

/// Runs `mesa_models.py`; `None` when there is no environment with Mesa. `kind` is `layer` or
/// `agents`.
pub fn run(model: Model, kind: &str, start: &[u8], side: usize, steps: usize) -> Option<Timed> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = folder.join("venv/bin/python");
    if !python.exists() {
        println!("Mesa, {kind}: left out, for there is no {}", python.display());
        return None;
    }
    let cells = std::env::temp_dir().join(format!("landform_peers_{}.bin", std::process::id()));
    fs::write(&cells, start).expect("the folder for temporary files can be written");
    let output = Command::new(python)
        .arg(folder.join("mesa_models.py"))
        .args([format!("{model:?}").as_str(), kind, &side.to_string(), &steps.to_string()])
        .arg(&cells)
        .output()
        .expect("Python starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let nanoseconds = String::from_utf8_lossy(&output.stdout)
        .split_whitespace()
        .map(|time| time.parse().expect("nanoseconds"))
        .collect();
    let end = fs::read(&cells).expect("the cells at the end");
    fs::remove_file(&cells).expect("a file of our own");
    Some(Timed { nanoseconds, cells: end })
}
