//! The numbers of a dune model, with their units, ranges and sources.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Rose;
use super::error::{DuneError, check};

/// How slabs of sand travel (Werner 1995; thesis, section 4.1.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TransportSettings {
    /// Height of a slab in metres. Higher slabs build dunes in fewer ticks but coarser. At
    /// most the highest stable step, tan(repose) times the spacing. Default 5 (thesis).
    pub slab_m: f64,
    /// Length of a hop in metres, the thesis' wind strength; one node at least. Default 140.
    pub hop_m: f64,
    /// Probability that a slab landing on sand in the wind stays, in (0, 1]. Default 0.6.
    pub deposit_on_sand: f64,
    /// Probability that a slab landing on bare ground in the wind stays, in (0, 1]. Ground
    /// is bare where less than a slab lies. Default 0.4 (Werner 1995).
    pub deposit_on_bare: f64,
    /// Whether the wind lifts slabs from sheltered nodes too, as Werner had it. Default no.
    pub lift_in_shelter: bool,
    /// Number of hops after which a slab stays wherever it is. Default 1000.
    pub most_hops: u32,
    /// Slabs a tick that enter over the open borders that the wind blows in over. Default 0.
    pub feed_slabs_per_tick: f64,
}

impl Default for TransportSettings {
    fn default() -> Self {
        Self {
            slab_m: 5.0,
            hop_m: 140.0,
            deposit_on_sand: 0.6,
            deposit_on_bare: 0.4,
            lift_in_shelter: false,
            most_hops: 1000,
            feed_slabs_per_tick: 0.0,
        }
    }
}

impl TransportSettings {
    /// Checks ranges.
    ///
    /// # Errors
    /// [`DuneError::Range`] names the first setting out of range.
    pub fn validate(&self) -> Result<(), DuneError> {
        check_slab(self.slab_m)?;
        let hop = self.hop_m;
        check((0.0..=1e9).contains(&hop), "hop_m", hop, "between 0 and 1e9")?;
        for (name, value) in
            [("deposit_on_sand", self.deposit_on_sand), ("deposit_on_bare", self.deposit_on_bare)]
        {
            check(value > 0.0 && value <= 1.0, name, value, "above 0 and at most 1")?;
        }
        let hops = self.most_hops;
        check((1..=1_000_000).contains(&hops), "most_hops", hops.into(), "between 1 and 1000000")?;
        let feed = self.feed_slabs_per_tick;
        check((0.0..=1e9).contains(&feed), "feed_slabs_per_tick", feed, "between 0 and 1e9")
    }
}

/// Checks the height of a slab alone.
fn check_slab(slab_m: f64) -> Result<(), DuneError> {
    let valid = (1e-9..=1e9).contains(&slab_m);
    check(valid, "slab_m", slab_m, "between 1e-9 and 1e9 metres")
}

/// When sand slides down (thesis, section 2.3.1: 33 degrees for dry sand).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AvalancheSettings {
    /// Steepest slope of sand at rest, degrees in (0, 90), along every edge of the lattice.
    /// On a lattice without diagonals, a slope across both axes may reach
    /// atan(sqrt(2) tan(repose)): 42.6 degrees for 33. Default 33.
    pub repose_deg: f64,
    /// Number of sweeps over the bands of the lattice after which a pass gives up, and of slides
    /// for each node of a band in one sweep. Default 100000; a pass needs a few.
    pub most_sweeps: u32,
}

impl Default for AvalancheSettings {
    fn default() -> Self {
        Self { repose_deg: 33.0, most_sweeps: 100_000 }
    }
}

impl AvalancheSettings {
    /// Checks ranges.
    ///
    /// # Errors
    /// [`DuneError::Range`] names the first setting out of range.
    pub fn validate(&self) -> Result<(), DuneError> {
        let repose = self.repose_deg;
        check(repose > 0.0 && repose < 90.0, "repose_deg", repose, "between 0 and 90, exclusive")?;
        check(self.most_sweeps > 0, "most_sweeps", 0.0, "at least 1")
    }

    /// Tangent of the angle of repose.
    pub fn repose(&self) -> f64 {
        self.repose_deg.to_radians().tan()
    }
}

/// All the settings of the engine but the kind of shelter.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DuneSettings {
    /// The winds.
    pub rose: Rose,
    /// How slabs travel.
    pub transport: TransportSettings,
    /// When sand slides.
    pub avalanche: AvalancheSettings,
}

impl DuneSettings {
    /// Checks every range, and that the settings suit the lattice.
    ///
    /// # Errors
    /// See [`DuneError`].
    pub fn validate(&self, lattice: &Lattice) -> Result<(), DuneError> {
        if lattice.connectivity().is_volume() {
            return Err(DuneError::Volume(lattice.connectivity()));
        }
        self.rose.validate()?;
        self.transport.validate()?;
        self.avalanche.validate()?;
        self.validate_slab(lattice, self.transport.slab_m)?;
        let feed = self.transport.feed_slabs_per_tick;
        if feed > 0.0 && lattice.is_periodic(0) && lattice.is_periodic(1) {
            return Err(DuneError::NoInlet(feed));
        }
        Ok(())
    }

    /// Checks the height of a slab against the highest stable step between nodes.
    ///
    /// # Errors
    /// [`DuneError::SlabTooHigh`], [`DuneError::Range`].
    pub fn validate_slab(&self, lattice: &Lattice, slab_m: f64) -> Result<(), DuneError> {
        check_slab(slab_m)?;
        let step_m = self.avalanche.repose() * lattice.spacing();
        if slab_m > step_m { Err(DuneError::SlabTooHigh { slab_m, step_m }) } else { Ok(()) }
    }
}
