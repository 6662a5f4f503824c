//! What anybody may hand to Landform: one function for each kind of input, which takes any bytes
//! and never panics unless Landform is at fault.
//!
//! The fuzzers of `tests/fuzz` call these functions with inputs that they find by coverage, and
//! the tests call them with [`mutated`] seeds: the same functions, the same seeds.

mod mutations;
mod rasters;
mod scenarios;

pub use mutations::mutated;

/// A kind of input.
pub struct Target {
    /// Name of the target, and of the fuzzer.
    pub name: &'static str,
    /// Reads the bytes, whatever they are, and says whether they were accepted. Panics only when
    /// Landform is at fault.
    pub try_out: fn(&[u8]) -> bool,
    /// Good inputs, each with a name, to start from.
    pub seeds: fn() -> Vec<(String, Vec<u8>)>,
    /// Words of the format, which luck alone would hardly find.
    pub words: fn() -> Vec<String>,
}

/// All kinds of input.
pub const TARGETS: &[Target] = &[
    Target {
        name: "scenario_text",
        try_out: scenarios::check,
        seeds: scenarios::seeds,
        words: scenarios::words,
    },
    Target {
        name: "scenario_run",
        try_out: scenarios::run,
        seeds: scenarios::small_seeds,
        words: scenarios::words,
    },
    Target {
        name: "geotiff",
        try_out: rasters::geotiff,
        seeds: rasters::geotiff_seeds,
        words: rasters::geotiff_words,
    },
    Target {
        name: "esri_ascii",
        try_out: rasters::esri_ascii,
        seeds: rasters::esri_ascii_seeds,
        words: rasters::text_words,
    },
    Target {
        name: "npy",
        try_out: rasters::npy,
        seeds: rasters::npy_seeds,
        words: rasters::npy_words,
    },
    Target {
        name: "png",
        try_out: rasters::png,
        seeds: rasters::png_seeds,
        words: rasters::png_words,
    },
    Target {
        name: "npz",
        try_out: rasters::npz,
        seeds: rasters::npz_seeds,
        words: rasters::npz_words,
    },
    Target {
        name: "sidecar",
        try_out: rasters::sidecar,
        seeds: rasters::sidecar_seeds,
        words: rasters::text_words,
    },
];

/// Tries out `bytes` on the target of this name.
///
/// # Panics
/// When there is no such target, or Landform is at fault.
pub fn try_out(target: &str, bytes: &[u8]) {
    let target = TARGETS.iter().find(|known| known.name == target).expect("a target of this name");
    let _ = (target.try_out)(bytes);
}
