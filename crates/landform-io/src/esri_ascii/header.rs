//! The header of a grid.

use std::io::{self, Read};

use super::tokens::{Token, Tokens};
use crate::{Fault, Georeference, Place, Registration};

/// What went wrong: the system, or the text.
pub(super) enum Failure {
    System(io::Error),
    Content(Fault),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Self {
        Self::Content(fault)
    }
}

/// What a header says, and the first number of the rows, which ends it.
#[derive(Debug)]
pub(super) struct Header {
    pub columns: u64,
    pub rows: u64,
    pub no_data: Option<f64>,
    pub georeference: Georeference,
    pub first: Option<f64>,
}

/// The key words and their numbers, each with its line.
#[derive(Default)]
struct Entries(Vec<(String, f64, u64)>);

const KEYS: [&str; 10] = [
    "ncols",
    "nrows",
    "xllcorner",
    "xllcenter",
    "yllcorner",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
];

/// Reads key words until a number stands where a key word should.
pub(super) fn read<R: Read>(tokens: &mut Tokens<R>) -> Result<Header, Failure> {
    let mut entries = Entries::default();
    let first = loop {
        let Some(Token { text, line }) = tokens.next()? else { break None };
        let word = String::from_utf8_lossy(&text[..text.len().min(40)]).to_lowercase();
        if !word.starts_with(|letter: char| letter.is_ascii_alphabetic()) || word == "nan" {
            break Some(number(text, line)?);
        }
        let key = KEYS.into_iter().find(|&key| word == key || word == key.replace("cent", "centr"));
        let Some(key) = key else {
            let problem = format!("the word {word:?} is no key of the header");
            let advice = "correct or remove the line";
            let expected = format!("one of {}", KEYS.join(", "));
            return Err(Fault::new(problem, expected, advice).at(Place::Line(line)).into());
        };
        if entries.get(key).is_some() {
            let problem = format!("{key} is given twice");
            let fault = Fault::new(problem, "each key once", "remove one of the lines");
            return Err(fault.at(Place::Line(line)).into());
        }
        let Some(token) = tokens.next()? else {
            let problem = format!("the text ends after {key}");
            return Err(cut_off(problem, "its number", tokens.line()).into());
        };
        let value = number(token.text, token.line)?;
        entries.0.push((key.into(), value, token.line));
    };
    Ok(entries.header(first)?)
}

/// A fault that says that the text stops too early.
pub(super) fn cut_off(problem: String, expected: impl Into<String>, line: u64) -> Fault {
    let advice = "the file is cut off: fetch or write it again";
    Fault::new(problem, expected, advice).at(Place::Line(line))
}

/// A number as text, with a point for the decimals.
pub(super) fn number(text: &[u8], line: u64) -> Result<f64, Fault> {
    let parsed = std::str::from_utf8(text).ok().and_then(|text| text.parse().ok());
    parsed.ok_or_else(|| {
        let word = String::from_utf8_lossy(&text[..text.len().min(40)]).into_owned();
        let advice = match word.contains(',') {
            true => "write decimals with a point and separate numbers by spaces",
            false => "correct the text",
        };
        Fault::new(format!("{word:?} is not a number"), "a number", advice).at(Place::Line(line))
    })
}

impl Entries {
    fn get(&self, key: &str) -> Option<(f64, u64)> {
        self.0.iter().find(|entry| entry.0 == key).map(|entry| (entry.1, entry.2))
    }

    fn header(&self, first: Option<f64>) -> Result<Header, Fault> {
        let [columns, rows] = [self.count("ncols")?, self.count("nrows")?];
        let cell_size = match self.get("cellsize") {
            Some(_) => [self.length("cellsize")?; 2],
            None => match (self.get("dx"), self.get("dy")) {
                (Some(_), Some(_)) => [self.length("dx")?, self.length("dy")?],
                _ => return Err(missing("cellsize")),
            },
        };
        let (west, west_centre) = self.origin("xllcorner", "xllcenter", cell_size[0])?;
        let (south, south_centre) = self.origin("yllcorner", "yllcenter", cell_size[1])?;
        let registration = match west_centre && south_centre {
            true => Registration::Point,
            false => Registration::Area,
        };
        let georeference = Georeference {
            west,
            north: south + rows as f64 * cell_size[1],
            cell_size,
            registration,
            coordinate_system: Default::default(),
        };
        let no_data = self.get("nodata_value").map(|(value, _)| value);
        Ok(Header { columns, rows, no_data, georeference, first })
    }

    /// A whole number of at least one.
    fn count(&self, key: &str) -> Result<u64, Fault> {
        let (value, line) = self.get(key).ok_or_else(|| missing(key))?;
        if value >= 1.0 && value.fract() == 0.0 && value < 1e18 {
            return Ok(value as u64);
        }
        let problem = format!("{key} is {value}");
        let fault = Fault::new(problem, "a whole number of at least 1", "correct the header");
        Err(fault.at(Place::Line(line)))
    }

    /// A positive finite length.
    fn length(&self, key: &str) -> Result<f64, Fault> {
        let (value, line) = self.get(key).ok_or_else(|| missing(key))?;
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        let problem = format!("{key} is {value}");
        let fault = Fault::new(problem, "a positive finite length", "correct the header");
        Err(fault.at(Place::Line(line)))
    }

    /// The outer edge along one axis, and whether the centre of the cell was given.
    fn origin(&self, corner: &str, centre: &str, size: f64) -> Result<(f64, bool), Fault> {
        let (value, line, is_centre) = match (self.get(corner), self.get(centre)) {
            (Some((value, line)), None) => (value, line, false),
            (None, Some((value, line))) => (value - 0.5 * size, line, true),
            (None, None) => return Err(missing(corner)),
            (Some(_), Some((_, line))) => {
                let problem = format!("both {corner} and {centre} are given");
                let fault = Fault::new(problem, "one of them", "remove one of the lines");
                return Err(fault.at(Place::Line(line)));
            }
        };
        if value.is_finite() {
            return Ok((value, is_centre));
        }
        let fault = Fault::new(format!("{corner} is {value}"), "a finite number", "correct it");
        Err(fault.at(Place::Line(line)))
    }
}

fn missing(key: &str) -> Fault {
    let expected = "ncols, nrows, xllcorner, yllcorner and cellsize before the numbers";
    Fault::new(format!("the header has no {key}"), expected, "add the line")
}
