//! Everything in a folder, to compare what two runs left.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

/// The files below a folder by their paths, with `/`; of `report.json` everything but times.
pub fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    collect(folder, "", &mut files);
    files
}

fn collect(folder: &Path, prefix: &str, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let entry = entry.expect("an entry");
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type().expect("a type").is_dir() {
            collect(&entry.path(), &format!("{name}/"), files);
            continue;
        }
        let bytes = fs::read(entry.path()).expect("a file");
        let bytes = if name == "report.json" { without_times(&bytes) } else { bytes };
        files.insert(name, bytes);
    }
}

fn without_times(report: &[u8]) -> Vec<u8> {
    let mut report: Value = serde_json::from_slice(report).expect("a report");
    report["seconds"] = Value::Null;
    for stage in report["stages"].as_array_mut().expect("stages") {
        stage["seconds"] = Value::Null;
    }
    report.to_string().into_bytes()
}

/// The names of files that are not the same in both folders.
pub fn differences(
    one: &BTreeMap<String, Vec<u8>>,
    two: &BTreeMap<String, Vec<u8>>,
) -> Vec<String> {
    let names = one.keys().chain(two.keys());
    let mut different: Vec<String> =
        names.filter(|name| one.get(*name) != two.get(*name)).cloned().collect();
    different.sort();
    different.dedup();
    different
}
