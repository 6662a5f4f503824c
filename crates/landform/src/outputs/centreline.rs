//! The centreline of the passages of a volume as a cave survey.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use landform_analysis::caves::{CaveNetwork, PassageSize};
use landform_analysis::voxels::VoxelSet;
use landform_io::{IfExists, write_atomically};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use crate::explain::file_problem;

/// The centreline of the voxels of a volume that are at least a value as a survey, with the distances
/// to the walls at each station: Survex (`.svx`), Therion (`.th`), or a table of legs (`.csv`).
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Centreline {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// Voxels of at least this value are passages.
    pub at_least: f64,
    /// Stations stand so that no voxel of the centreline lies farther than this off the legs; a voxel
    /// when missing.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-unit" = "m"))]
    pub tolerance_m: Option<f64>,
    /// When it is written.
    pub when: When,
}

impl Default for Centreline {
    fn default() -> Self {
        Self {
            file: "centreline.svx".into(),
            field: "porosity".to_owned(),
            at_least: 0.5,
            tolerance_m: None,
            when: When::End,
        }
    }
}

impl FileOutput for Centreline {
    const NAME: &'static str = "Centreline";
    const KIND: &'static str = "survey";
    const EXTENSIONS: &'static [&'static str] = &["svx", "th", "csv"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (values, _) = field_file::values(snapshot, &self.field)?;
        let lattice = snapshot.lattice();
        let spacing_m = lattice.spacing();
        let set = VoxelSet::at_least(lattice.size(), &values, self.at_least);
        // A volume without passages is a survey without legs.
        let network = CaveNetwork::of_passages(&set, spacing_m)
            .ok()
            .map(|network| network.resampled(self.tolerance_m.unwrap_or(spacing_m)));
        let sizes = network.as_ref().map(|network| network.passage_sizes(&set, spacing_m));
        let survey = Survey {
            title: snapshot.title(),
            network: network.as_ref(),
            sizes: sizes.as_deref().unwrap_or_default(),
        };
        write_atomically(path, IfExists::Replace, |file| match path.extension() {
            Some(extension) if extension.eq_ignore_ascii_case("svx") => survey.survex(file),
            Some(extension) if extension.eq_ignore_ascii_case("th") => survey.therion(file),
            _ => survey.table(file),
        })
        .map_err(|error| file_problem("file", &error))
    }
}

/// Stations are numbered from 1.
struct Survey<'a> {
    title: &'a str,
    network: Option<&'a CaveNetwork>,
    sizes: &'a [PassageSize],
}

impl Survey<'_> {
    /// Title without what would end it or begin a comment.
    fn title(&self) -> String {
        self.title.chars().filter(|&letter| letter != '"' && !letter.is_control()).collect()
    }

    fn legs(&self, out: &mut impl Write) -> io::Result<()> {
        let Some(network) = self.network else { return Ok(()) };
        for &[from, to] in network.legs() {
            let [a, b] = [from, to].map(|station| network.stations()[station]);
            let [x, y, z] = [0, 1, 2].map(|axis| b[axis] - a[axis]);
            writeln!(out, "{} {} {x:.3} {y:.3} {z:.3}", from + 1, to + 1)?;
        }
        Ok(())
    }

    fn walls(&self, out: &mut impl Write) -> io::Result<()> {
        for (station, size) in self.sizes.iter().enumerate() {
            let PassageSize { left_m, right_m, up_m, down_m } = size;
            writeln!(out, "{} {left_m:.2} {right_m:.2} {up_m:.2} {down_m:.2}", station + 1)?;
        }
        Ok(())
    }

    /// Places of the first stations of the separate parts, in lines that begin with a word.
    fn fixed(&self, out: &mut impl Write, word: &str) -> io::Result<()> {
        let Some(network) = self.network else { return Ok(()) };
        for station in network.anchors() {
            let [x, y, z] = network.stations()[station];
            writeln!(out, "{word} {} {x:.3} {y:.3} {z:.3}", station + 1)?;
        }
        Ok(())
    }

    fn survex(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "*begin cave\n*title \"{}\"", self.title())?;
        self.fixed(out, "*fix")?;
        writeln!(out, "*data cartesian from to dx dy dz")?;
        self.legs(out)?;
        writeln!(out, "*data passage station left right up down")?;
        self.walls(out)?;
        writeln!(out, "*end cave")
    }

    fn therion(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "encoding utf-8\nsurvey cave -title \"{}\"\ncentreline", self.title())?;
        self.fixed(out, "fix")?;
        writeln!(out, "data cartesian from to easting northing altitude")?;
        self.legs(out)?;
        writeln!(out, "data dimensions station left right up down")?;
        self.walls(out)?;
        writeln!(out, "endcentreline\nendsurvey")
    }

    fn table(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "from,to,x1,y1,z1,x2,y2,z2")?;
        let Some(network) = self.network else { return Ok(()) };
        for &[from, to] in network.legs() {
            let [a, b] = [from, to].map(|station| network.stations()[station]);
            writeln!(
                out,
                "{},{},{},{},{},{},{},{}",
                from + 1,
                to + 1,
                a[0],
                a[1],
                a[2],
                b[0],
                b[1],
                b[2]
            )?;
        }
        Ok(())
    }
}
