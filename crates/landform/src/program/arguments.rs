//! What may be typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use landform_analysis::ScaleRange;

/// Agents that erode landforms: run scenarios, look at the results.
#[derive(Parser)]
#[command(name = "landform", version, arg_required_else_help = true, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "Examples:
  landform run scenarios/gallery/dunes.ron
  landform run scenarios/gallery/dunes.ron -o out/windy --seed 7 --set stages[0].processes.Dunes.wind_strength_m=200
  landform run scenarios/gallery/dunes.ron -o out/dunes --resume
  landform run scenarios/gallery/dunes_on_dem.ron --set domain.path=my_dem.tif
  landform describe Dunes
  landform export out/dunes --field surface --to dunes.tif
  landform view out/dunes -o dunes.png --look perspective --bearing 120
  landform analyze dem.tif
  landform sweep scenarios/tutorial/slab.sweep.ron -o out/slab";

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Run a scenario: pictures, rasters, series and report.json go into a folder
    Run(RunArguments),
    /// Read and check scenarios without running them
    Check(CheckArguments),
    /// List what scenarios may name
    List {
        /// Only this kind
        #[arg(value_enum)]
        kind: Option<KindName>,
    },
    /// Explain a process, domain, initial condition, metric or output with all its parameters
    Describe {
        /// Its name
        name: String,
        /// Print a JSON schema instead
        #[arg(long)]
        json: bool,
    },
    /// Explain the code of a message: what it means, what causes it, what to do
    #[command(after_help = "Examples:\n  landform explain L0201\n  landform explain")]
    Explain {
        /// The code, as `error[L0201]` shows it; all with their titles without it
        code: Option<String>,
    },
    /// Print the JSON schema of whole scenarios, for editors
    #[command(after_help = "Example:\n  landform schema > scenario.schema.json")]
    Schema,
    /// Write a field of a finished run as a raster or a mesh
    #[command(
        after_help = "The extension of FILE chooses the format: .npy .tif .asc .png (16-bit \
        grey) .raw (32-bit floats), .exr (when built with the feature exr), .obj .ply .glb .stl (meshes)\n\nExample:\n  \
        landform export out/dunes --field surface --to dunes.glb"
    )]
    Export(ExportArguments),
    /// Draw a field of a finished run, or a raster file
    #[command(after_help = "Examples:\n  landform view out/dunes -o dunes.png\n  \
        landform view dem.tif -o dem.png --look perspective --colours batlow")]
    View(ViewArguments),
    /// Measure rasters, lines and caves: spectra, hypsometry, fractal dimensions, slopes, drainage
    #[command(after_help = "Examples:\n  landform analyze dem.tif\n  \
        landform analyze dem.tif -o out/dem\n  \
        landform analyze coast.csv --rulers 2km..100km\n  \
        landform analyze --json dem.tif > dem.json\n\n\
        With --json one file gives an object, several give an array in their order.")]
    Analyze(AnalyzeArguments),
    /// Run figures and tables of the thesis over several seeds: our numbers beside the thesis'
    #[command(after_help = "Example:\n  landform reproduce table_4_1 -o out/table")]
    Reproduce(ReproduceArguments),
    /// Run a scenario many times, over parameters and seeds
    #[command(after_help = "Called again with the same folder, a sweep that was stopped goes on: \
        runs that are done stay.\n\nExamples:\n  \
        landform sweep scenarios/tutorial/slab.sweep.ron --dry-run\n  \
        landform sweep scenarios/tutorial/slab.sweep.ron -o out/slab --jobs 2\n  \
        landform collect out/slab\n\n\
        On a cluster, as one of ten jobs of an array: \
        landform sweep S.sweep.ron -o DIR --index $SLURM_ARRAY_TASK_ID/10")]
    Sweep(SweepArguments),
    /// Gather the runs of a sweep into its table, contact sheet and plots
    #[command(after_help = "Works while the sweep runs, and after the last share of a cluster's \
        array of jobs.")]
    Collect {
        /// Output folder of the sweep
        folder: PathBuf,
    },
    /// Print a completion script for a shell
    #[command(
        after_help = "Example:\n  landform completions bash > ~/.local/share/bash-completion/completions/landform"
    )]
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

#[derive(Args)]
pub(crate) struct RunArguments {
    /// The scenario file (*.ron)
    pub scenario: PathBuf,
    /// Output folder; without it a new one below ./out, named after the scenario
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Seed of all random numbers, instead of the scenario's
    #[arg(long)]
    pub seed: Option<u64>,
    /// Number of threads; all cores without it. The results are the same for any number
    #[arg(long)]
    pub threads: Option<usize>,
    /// Replace a value of the scenario, as often as needed: `stages[0].processes.Dunes.slab_m=2.5`
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Write into an existing folder; files of the same names are replaced
    #[arg(long)]
    pub force: bool,
    /// Go on with the run in the folder of -o, which was interrupted or killed
    #[arg(long, requires = "output", conflicts_with = "force")]
    pub resume: bool,
    /// How often a checkpoint is written to resume from: every 90s, 10min, 2h or 500it
    /// (iterations of a stage); 0 for only when the run is interrupted
    #[arg(long, value_name = "INTERVAL", default_value = "5min", value_parser = Interval::parse)]
    pub checkpoint_every: Interval,
    /// Largest memory that the run may need; without it most of what is free
    #[arg(long, value_name = "GIB")]
    pub memory_limit_gib: Option<f64>,
    /// No progress bar
    #[arg(long)]
    pub quiet: bool,
}

/// How often something happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Interval {
    /// Never by itself.
    Never,
    /// After so many seconds.
    Seconds(f64),
    /// After so many iterations of a stage.
    Iterations(u64),
}

impl Interval {
    /// Reads `90s`, `10min`, `2h`, `500it` or `0`.
    fn parse(text: &str) -> Result<Self, String> {
        let digits = text.find(|letter: char| letter.is_ascii_alphabetic()).unwrap_or(text.len());
        let (number, unit) = text.split_at(digits);
        let number = number.trim();
        let count = number.parse().ok().filter(|&count: &u64| count > 0);
        let size = number.parse().ok().filter(|size: &f64| size.is_finite() && *size >= 0.0);
        let seconds = |factor: f64| size.map(|size| Self::Seconds(size * factor));
        let interval = match unit {
            _ if size == Some(0.0) => Some(Self::Never),
            "s" => seconds(1.0),
            "min" => seconds(60.0),
            "h" => seconds(3600.0),
            "it" => count.map(Self::Iterations),
            _ => None,
        };
        interval.ok_or_else(|| "write it as 90s, 10min, 2h, 500it or 0".to_owned())
    }
}

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Scenario files, and sweep files (*.sweep.ron)
    #[arg(required = true)]
    pub scenarios: Vec<PathBuf>,
    /// Replace a value in each of them
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Print what is wrong as a JSON list on standard output, for editors
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub(crate) struct SweepArguments {
    /// The sweep file (*.sweep.ron)
    pub sweep: PathBuf,
    /// Output folder; without it a new one below ./out, named after the sweep
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// List the runs and what they need, and stop
    #[arg(long)]
    pub dry_run: bool,
    /// Most runs at a time; without it one for each thread. Results are the same for any number
    #[arg(long)]
    pub jobs: Option<usize>,
    /// Number of threads for all runs together; all cores without it
    #[arg(long)]
    pub threads: Option<usize>,
    /// Only the I-th of N shares of the runs, counted from 1
    #[arg(long, value_name = "I/N")]
    pub index: Option<String>,
    /// Largest memory of the runs that go on at a time; without it most of what is free
    #[arg(long, value_name = "GIB")]
    pub memory_limit_gib: Option<f64>,
    /// Largest size of the final fields of all runs on the disk
    #[arg(long, value_name = "GIB", default_value_t = 50.0)]
    pub disk_limit_gib: f64,
    /// No progress bar
    #[arg(long)]
    pub quiet: bool,
}

#[derive(Clone, Copy, ValueEnum, PartialEq, Eq)]
pub(crate) enum KindName {
    Domains,
    Initial,
    Processes,
    Metrics,
    Outputs,
}

#[derive(Args)]
pub(crate) struct ExportArguments {
    /// Output folder of a run
    pub folder: PathBuf,
    /// Name of the field
    #[arg(long)]
    pub field: String,
    /// File to write
    #[arg(long, value_name = "FILE")]
    pub to: PathBuf,
    /// Name of the field of water depths whose surface goes into a mesh beside the ground (`water`)
    #[arg(long)]
    pub depths: Option<String>,
    /// Replace the file if it is there
    #[arg(long)]
    pub force: bool,
}

#[derive(Args)]
pub(crate) struct ReproduceArguments {
    /// Target files, or their names below scenarios/thesis (table_4_1) or scenarios (dendry/table_1, or
    /// physics for a whole folder)
    #[arg(required_unless_present_any = ["all", "chapter"])]
    pub figures: Vec<String>,
    /// All figures and tables, and all target files of other folders of scenarios
    #[arg(long)]
    pub all: bool,
    /// Those of a chapter or an appendix: 4, B
    #[arg(long, value_name = "CHAPTER", conflicts_with = "all")]
    pub chapter: Option<String>,
    /// One seed of each, for a first look
    #[arg(long, conflicts_with_all = ["seeds", "full"])]
    pub quick: bool,
    /// As many seeds as the files say; so it is without this, too
    #[arg(long, conflicts_with = "seeds")]
    pub full: bool,
    /// Runs at once; as many as there are processors without it
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Go on in a folder where an earlier call was ended: what is done there is kept
    #[arg(long, requires = "output")]
    pub resume: bool,
    /// Output folder; without it a new one below ./out
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Number of seeds, instead of the file's
    #[arg(long)]
    pub seeds: Option<u64>,
    /// Folder of the elevation data that figures of real ground need; without it their numbers are
    /// absent
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Write into an existing folder; files of the same names are replaced
    #[arg(long)]
    pub force: bool,
}

#[derive(Args)]
pub(crate) struct AnalyzeArguments {
    /// Rasters (.tif, .asc, .npy, grey .png), lines (.csv, .geojson), and caves: surveys (.csv) and
    /// volumes (.npy with three axes)
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
    /// Rulers of dividers and sides of boxes, for lines: 2km..100km or 500m..20km
    #[arg(long, value_name = "FROM..TO")]
    pub rulers: Option<ScaleRange>,
    /// Folder for a figure (PNG and SVG) and the JSON of each file
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Write into an existing folder; files of the same names are replaced
    #[arg(long, requires = "output")]
    pub force: bool,
    /// Least value of the passages of a volume
    #[arg(long, value_name = "VALUE", default_value_t = 0.5)]
    pub at_least: f64,
    /// Side of the cells in metres, for rasters that do not say it or say something else
    #[arg(long, value_name = "METRES")]
    pub spacing_m: Option<f64>,
    /// Largest memory that a file may need; without it most of what is free
    #[arg(long, value_name = "GIB")]
    pub memory_limit_gib: Option<f64>,
}

#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum LookName {
    Relief,
    Perspective,
    Flat,
}

#[derive(Args)]
pub(crate) struct ViewArguments {
    /// Output folder of a run, or a raster file
    pub source: PathBuf,
    /// Picture to write (*.png)
    #[arg(short, long)]
    pub output: PathBuf,
    /// Name of the field, when the source is a folder
    #[arg(long, default_value = "surface")]
    pub field: String,
    /// How it is drawn
    #[arg(long, value_enum, default_value = "relief")]
    pub look: LookName,
    /// Name of the colour map
    #[arg(long)]
    pub colours: Option<String>,
    /// Compass bearing towards which the camera looks, in degrees
    #[arg(long)]
    pub bearing: Option<f64>,
    /// How far the camera looks down, in degrees
    #[arg(long)]
    pub pitch: Option<f64>,
    /// Nearer to the middle of the field
    #[arg(long)]
    pub zoom: Option<f64>,
    /// Factor of heights
    #[arg(long)]
    pub exaggeration: Option<f64>,
    /// Elevation of a water surface in metres
    #[arg(long)]
    pub water: Option<f64>,
    /// Name of the field of water depths that is drawn over the heights (`water`)
    #[arg(long)]
    pub depths: Option<String>,
    /// Replace the picture if it is there
    #[arg(long)]
    pub force: bool,
}
