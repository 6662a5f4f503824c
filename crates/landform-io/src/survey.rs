//! Cave surveys as tables: stations and legs.
//!
//! - Legs by their ends: a heading with `x1`, `y1`, `z1`, `x2`, `y2`, `z2` in metres; ends at the same
//!   place are one station.
//! - Legs by names: a heading with `from` and `to`; the stations stand in a file beside it, whose name
//!   has `nodes` or `stations` where the file's has `links`, `legs` or `shots`, with `x`, `y`, `z` and
//!   the name in a column `node`, `station` or `id`.
//!
//! Legs are left out that a column `splay` marks with anything but 0, or a column `flags` as `SPLAY`,
//! `DUPLICATE` or `SURFACE`. Other columns are passed over.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::lines::text;
use crate::{Fault, IoError, Place, ReadLimits};

/// Stations and legs of a cave.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurveyFile {
    /// x (east), y (north), z (up) in metres.
    pub stations: Vec<[f64; 3]>,
    /// Numbers of the stations that a leg joins.
    pub legs: Vec<[usize; 2]>,
}

const ENDS: [&str; 6] = ["x1", "y1", "z1", "x2", "y2", "z2"];

/// Whether a CSV file has the heading of a survey.
pub fn is_survey(path: &Path) -> bool {
    let heading = |text: String| text.lines().next().map(names).unwrap_or_default();
    let names = text(path).map(heading).unwrap_or_default();
    let has = |name: &&str| names.iter().any(|found| found == name);
    ENDS.iter().all(has) || ["from", "to"].iter().all(has)
}

/// Reads a survey. `limits` bounds the number of legs and of stations.
///
/// # Errors
/// [`IoError`]: no such file, unknown columns, text that is no number, names without a station, or no
/// legs at all.
pub fn read_survey(path: &Path, limits: &ReadLimits) -> Result<SurveyFile, IoError> {
    let table = Table::read(path, limits)?;
    let survey = match ENDS.map(|name| table.column(&[name])) {
        [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] => {
            by_ends(&table, [[a, b, c], [d, e, f]])
        }
        _ => by_names(&table, limits),
    }?;
    match survey.legs.is_empty() {
        false => Ok(survey),
        true => {
            let fault =
                Fault::new("the survey has no legs", "a row for each leg", "check the flags");
            Err(fault.reading(path))
        }
    }
}

fn by_ends(table: &Table, columns: [[usize; 3]; 2]) -> Result<SurveyFile, IoError> {
    let mut survey = SurveyFile::default();
    let mut numbers = BTreeMap::new();
    for row in table.legs() {
        let mut leg = [0; 2];
        for (end, columns) in leg.iter_mut().zip(columns) {
            let place = table.place(row, columns)?;
            *end = *numbers.entry(place.map(f64::to_bits)).or_insert_with(|| {
                survey.stations.push(place);
                survey.stations.len() - 1
            });
        }
        survey.legs.push(leg);
    }
    Ok(survey)
}

fn by_names(table: &Table, limits: &ReadLimits) -> Result<SurveyFile, IoError> {
    let [from, to] = [table.need(&["from"])?, table.need(&["to"])?];
    let beside = Table::read(&table.beside()?, limits)?;
    let name = beside.need(&["node", "station", "id"])?;
    let place = [beside.need(&["x"])?, beside.need(&["y"])?, beside.need(&["z"])?];
    let mut survey = SurveyFile::default();
    let mut numbers = BTreeMap::new();
    for row in &beside.rows {
        numbers.insert(beside.cell(row, name)?, survey.stations.len());
        survey.stations.push(beside.place(row, place)?);
    }
    for row in table.legs() {
        let mut leg = [0; 2];
        for (end, column) in leg.iter_mut().zip([from, to]) {
            let name = table.cell(row, column)?;
            *end = *numbers.get(name).ok_or_else(|| {
                let problem = format!("no station is called `{name}`");
                let expected = format!("a name in {}", beside.path.display());
                table.wrong(row, Fault::new(problem, expected, "correct the name"))
            })?;
        }
        survey.legs.push(leg);
    }
    Ok(survey)
}

/// A row of cells and its line in the file.
type Row = (u64, Vec<String>);

/// A table with a heading.
struct Table {
    path: PathBuf,
    names: Vec<String>,
    rows: Vec<Row>,
}

impl Table {
    fn read(path: &Path, limits: &ReadLimits) -> Result<Self, IoError> {
        let text = text(path)?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let mut lines = (1_u64..).zip(text.lines()).filter(|(_, row)| !row.trim().is_empty());
        let names = lines.next().map(|(_, heading)| names(heading)).unwrap_or_default();
        let cells = |row: &str| row.split(',').map(|cell| trimmed(cell).to_owned()).collect();
        let rows: Vec<Row> = lines.map(|(number, row)| (number, cells(row))).collect();
        limits.cells(path, &[rows.len() as u64])?;
        Ok(Self { path: path.to_owned(), names, rows })
    }

    /// The rows of legs that count.
    fn legs(&self) -> impl Iterator<Item = &Row> {
        let [splay, flags] = [self.column(&["splay"]), self.column(&["flags"])];
        let text = |row: &Row, column: Option<usize>| {
            column.and_then(|column| row.1.get(column)).map(|cell| cell.to_ascii_uppercase())
        };
        self.rows.iter().filter(move |row| {
            let splay = text(row, splay).is_some_and(|cell| !["", "0"].contains(&cell.as_str()));
            let flags = text(row, flags).unwrap_or_default();
            !splay && !["SPLAY", "DUPLICATE", "SURFACE"].iter().any(|flag| flags.contains(flag))
        })
    }

    fn column(&self, names: &[&str]) -> Option<usize> {
        names.iter().find_map(|name| self.names.iter().position(|found| found == name))
    }

    fn need(&self, names: &[&str]) -> Result<usize, IoError> {
        self.column(names).ok_or_else(|| {
            let problem = format!("no column is called {}", names.join(" or "));
            let advice = "add or rename the columns";
            Fault::new(problem, "a survey: see the book on caves", advice)
                .at(Place::Line(1))
                .reading(&self.path)
        })
    }

    /// The file of the stations of these legs.
    fn beside(&self) -> Result<PathBuf, IoError> {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let words = ["links", "legs", "shots"].iter().filter(|word| name.contains(**word));
        let mut candidates = words
            .flat_map(|word| ["nodes", "stations"].map(|other| name.replace(word, other)))
            .map(|name| self.path.with_file_name(name));
        candidates.find(|path| path.is_file()).ok_or_else(|| {
            let expected = "a file of the same name with `nodes` or `stations` for `links`, `legs` \
                or `shots`";
            let fault =
                Fault::new("the legs name stations, whose file is not there", expected, "add it");
            fault.reading(&self.path)
        })
    }

    fn cell<'a>(&self, row: &'a Row, column: usize) -> Result<&'a str, IoError> {
        row.1.get(column).map(String::as_str).ok_or_else(|| {
            let problem = format!("the row has {} columns", row.1.len());
            let expected = format!("at least {}", column + 1);
            self.wrong(row, Fault::new(problem, expected, "complete or remove the row"))
        })
    }

    fn place(&self, row: &Row, columns: [usize; 3]) -> Result<[f64; 3], IoError> {
        let mut place = [0.0; 3];
        for (at, column) in place.iter_mut().zip(columns) {
            let cell = self.cell(row, column)?;
            let number = cell.parse::<f64>().ok().filter(|number| number.abs() < 1e12);
            *at = number.ok_or_else(|| {
                let shown: String = cell.chars().take(40).collect();
                let expected = "a number of metres below 1e12";
                let problem = format!("{shown:?} is no coordinate");
                self.wrong(row, Fault::new(problem, expected, "write decimals with a point"))
            })?;
        }
        Ok(place)
    }

    fn wrong(&self, row: &Row, fault: Fault) -> IoError {
        fault.at(Place::Line(row.0)).reading(&self.path)
    }
}

fn names(heading: &str) -> Vec<String> {
    let heading = heading.strip_prefix('\u{feff}').unwrap_or(heading);
    heading.split(',').map(|name| trimmed(name).to_ascii_lowercase()).collect()
}

fn trimmed(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scratch::Scratch;

    fn read(folder: &Scratch, name: &str) -> Result<SurveyFile, String> {
        read_survey(&folder.path(name), &ReadLimits::default()).map_err(|error| error.to_string())
    }

    #[test]
    fn legs_by_ends_and_by_names_are_the_same_survey() {
        let folder = Scratch::new("survey");
        let ends = "x1,y1,z1,x2,y2,z2,flags\n0,0,0,1,0,0,\n1,0,0,1,2,0,DUPLICATE\n1,0,0,1,2,-3,\n";
        std::fs::write(folder.path("a.csv"), ends).unwrap();
        std::fs::write(folder.path("b_links.csv"), "from,to,splay\nA,B,0\nB,C,0\nB,A,1\n").unwrap();
        std::fs::write(folder.path("b_nodes.csv"), "node,x,y,z\nA,0,0,0\nB,1,0,0\nC,1,2,-3\n")
            .unwrap();
        let survey = read(&folder, "a.csv").unwrap();
        assert_eq!(survey.stations, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 2.0, -3.0]]);
        assert_eq!(survey.legs, [[0, 1], [1, 2]]);
        assert_eq!(read(&folder, "b_links.csv").unwrap(), survey);
        assert!(is_survey(&folder.path("a.csv")) && is_survey(&folder.path("b_links.csv")));
        assert!(!is_survey(&folder.path("b_nodes.csv")) && !is_survey(&folder.path("none.csv")));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let folder = Scratch::new("survey_wrong");
        std::fs::write(folder.path("c_legs.csv"), "from,to\nA,B\nA,Q\n").unwrap();
        let said = |name: &str| read(&folder, name).unwrap_err();
        assert!(said("c_legs.csv").contains("whose file is not there"));
        std::fs::write(folder.path("c_stations.csv"), "station,x,y,z\nA,0,0,0\nB,1,0,zero\n")
            .unwrap();
        assert!(said("c_legs.csv").contains("\"zero\" is no coordinate"));
        std::fs::write(folder.path("c_stations.csv"), "station,x,y,z\nA,0,0,0\nB,1,0,0\n").unwrap();
        let message = said("c_legs.csv");
        assert!(
            message.contains("no station is called `Q`") && message.contains("line 3"),
            "{message}"
        );
        std::fs::write(folder.path("d.csv"), "x1,y1,z1,x2,y2,z2\n").unwrap();
        assert!(said("d.csv").contains("no legs"));
        std::fs::write(folder.path("e.csv"), "a,b\n1,2\n").unwrap();
        assert!(said("e.csv").contains("no column is called from"));
    }
}
