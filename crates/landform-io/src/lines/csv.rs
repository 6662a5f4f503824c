//! Lines as rows of points.

use super::{LineCoordinates, LineFile, check_point};
use crate::{Fault, Place};

/// Which column holds what.
struct Columns {
    coordinates: LineCoordinates,
    first: usize,
    second: usize,
    line: Option<usize>,
}

/// Reads rows of points below a heading.
pub(super) fn parse(text: &str) -> Result<LineFile, Fault> {
    let mut rows = (1_u64..).zip(text.lines()).filter(|(_, row)| !row.trim().is_empty());
    let Some((number, heading)) = rows.next() else {
        return Err(Fault::new("the file is empty", "a heading such as lon,lat", "check it"));
    };
    let columns = columns(heading).map_err(|fault| fault.at(Place::Line(number)))?;
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut name = None;
    for (number, row) in rows {
        let cells: Vec<&str> = row.split(',').map(trimmed).collect();
        let point = point(&cells, &columns).map_err(|fault| fault.at(Place::Line(number)))?;
        let row_name = columns.line.map(|column| cells.get(column).copied().unwrap_or_default());
        match lines.last_mut() {
            Some(line) if name == row_name => line.push(point),
            _ => lines.push(vec![point]),
        }
        name = row_name;
    }
    Ok(LineFile { coordinates: columns.coordinates, lines })
}

fn trimmed(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

fn columns(heading: &str) -> Result<Columns, Fault> {
    let names: Vec<String> =
        heading.split(',').map(|name| trimmed(name).to_ascii_lowercase()).collect();
    let find = |name: &str| names.iter().position(|found| found == name);
    let line = find("line");
    for (x, y, coordinates) in
        [("lon", "lat", LineCoordinates::Geographic), ("x", "y", LineCoordinates::Planar)]
    {
        if let [Some(first), Some(second)] = [find(x), find(y)] {
            return Ok(Columns { coordinates, first, second, line });
        }
    }
    let shown: String = heading.chars().take(60).collect();
    let problem = format!("the heading is {shown:?}");
    let expected = "columns lon and lat (degrees) or x and y (metres), separated by commas";
    Err(Fault::new(problem, expected, "add or rename the columns"))
}

fn point(cells: &[&str], columns: &Columns) -> Result<[f64; 2], Fault> {
    let number = |column: usize| {
        let Some(cell) = cells.get(column) else {
            let problem = format!("the row has {} columns", cells.len());
            let expected = format!("at least {}", column + 1);
            return Err(Fault::new(problem, expected, "complete or remove the row"));
        };
        cell.parse::<f64>().map_err(|_| {
            let shown: String = cell.chars().take(40).collect();
            let advice = "write decimals with a point, and remove rows without a point";
            Fault::new(format!("{shown:?} is not a number"), "a number", advice)
        })
    };
    check_point([number(columns.first)?, number(columns.second)?], columns.coordinates)
}
