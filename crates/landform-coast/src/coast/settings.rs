//! The numbers of a coast model, with their ranges and sources.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::CoastError;
use super::error::{check, check_length};
use super::regions::{Region, check_regions};

/// Which part of the shore weakens the sea.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Perimeter {
    /// The whole of it, beside its length at the beginning: F = f / (1 + g L / L(0))
    /// (thesis, equation 2.8; Sapoval, Baldassarri and Gabrielli 2004).
    #[default]
    Whole,
    /// All shore within a radius, beside that of a straight coast: F = f / (1 + g L / 2R)
    /// (thesis, equation 4.2, non-contiguous search).
    Near {
        /// The radius R.
        #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, table 4.4"))]
        radius_m: f64,
    },
    /// The shore that hangs together with a place within a radius, beside a straight coast
    /// (thesis, equation 4.2, contiguous search).
    Contiguous {
        /// The radius R.
        #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, table 4.4"))]
        radius_m: f64,
    },
}

impl Perimeter {
    /// The radius of a local perimeter in metres.
    pub fn radius_m(self) -> Option<f64> {
        match self {
            Self::Whole => None,
            Self::Near { radius_m } | Self::Contiguous { radius_m } => Some(radius_m),
        }
    }
}

/// How rock resists the less, the more of it the sea has laid bare.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Weakening {
    /// Not at all: r = u. What is left then is invasion percolation below a threshold.
    None,
    /// By the share of neighbours that are sea: r = u (1 - k / n), with n the neighbours that
    /// the lattice gives an inner node (4 or 8).
    #[default]
    Share,
    /// By their number, gently for hard rock: r = u^k.
    Power,
}

impl Weakening {
    /// What is left of the resistance `u` of a node with `exposed` of `degree` neighbours at sea.
    #[inline]
    pub fn strength(self, u: f64, (exposed, degree): (u32, u32)) -> f64 {
        match self {
            Self::None => u,
            Self::Share => u * (1.0 - f64::from(exposed) / f64::from(degree)),
            Self::Power => u.powi(exposed as i32),
        }
    }
}

/// Wear: rock that gives way in time, and weakens the rock around it when it falls (thesis,
/// section 4.2.3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Wear {
    /// Share k of the force that a coast node which withstands it loses of its material at each
    /// iteration. With 1 rock falls after the force has added up to it; far below 1 the sea
    /// weathers a coast slowly that falls in bursts, and coasts are more folded.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-source" = "thesis 4.2.3: 1"))]
    pub rate: f64,
    /// Material a that a node that falls takes from itself, less and less from others up to
    /// `radius_m`.
    #[schemars(range(min = 0.0, max = 1e6), extend("x-source" = "thesis, table 4.5"))]
    pub weakening: f64,
    /// Distance R_a at which weakening ends.
    #[schemars(range(min = 1e-6, max = 1e9), extend("x-unit" = "m", "x-source" = "thesis, table 4.5"))]
    pub radius_m: f64,
}

impl Default for Wear {
    fn default() -> Self {
        Self { rate: 1.0, weakening: 0.1, radius_m: 25.0 }
    }
}

/// All the settings of a coast.
#[derive(Clone, Debug, PartialEq)]
pub struct CoastSettings {
    /// Force of the sea f on a coast of no length.
    pub force: f64,
    /// How strongly shore weakens the sea: g.
    pub attenuation: f64,
    /// Which shore does.
    pub perimeter: Perimeter,
    /// How exposure weakens rock.
    pub weakening: Weakening,
    /// Whether rock wears, and how.
    pub wear: Option<Wear>,
    /// Parts of the map with numbers of their own.
    pub regions: Vec<Region>,
    /// A number a node, for regions of the kind `Numbered`; 0 everywhere when empty.
    pub region_map: Vec<u8>,
}

impl Default for CoastSettings {
    /// The first coast of figure 4.4 of the thesis.
    fn default() -> Self {
        Self {
            force: 0.495,
            attenuation: 0.18,
            perimeter: Perimeter::Whole,
            weakening: Weakening::Share,
            wear: None,
            regions: Vec::new(),
            region_map: Vec::new(),
        }
    }
}

/// Least and most spacings in a radius of perimeters: below, the shore beside a node would lie
/// beyond it; above, sums would not fit their numbers.
const RADIUS: std::ops::RangeInclusive<f64> = 1.5..=950.0;

/// Most spacings in a radius of weakening, which costs its square at each event.
const MOST_WEAKENING: f64 = 64.0;

impl CoastSettings {
    /// Checks every range, and that the settings suit the lattice.
    ///
    /// # Errors
    /// See [`CoastError`].
    pub fn validate(&self, lattice: &Lattice) -> Result<(), CoastError> {
        if lattice.connectivity().is_volume() {
            return Err(CoastError::Volume(lattice.connectivity()));
        }
        if lattice.node_count() > (u32::MAX / 4) as usize {
            return Err(CoastError::TooLarge(lattice.node_count()));
        }
        check_force(self.force, self.attenuation)?;
        let spacing = lattice.spacing();
        if let Some(radius_m) = self.perimeter.radius_m() {
            let expected = format!(
                "between {} and {} m with this spacing (a larger one is `perimeter: Whole`)",
                RADIUS.start() * spacing,
                RADIUS.end() * spacing
            );
            check(RADIUS.contains(&(radius_m / spacing)), "radius_m", radius_m, &expected)?;
        }
        if let Some(wear) = &self.wear {
            check((0.0..=1e6).contains(&wear.rate), "rate", wear.rate, "between 0 and 1e6")?;
            check_weakening(wear.weakening)?;
            let expected = format!("above 0 and at most {} m", MOST_WEAKENING * spacing);
            let radius = wear.radius_m;
            check(
                radius > 0.0 && radius <= MOST_WEAKENING * spacing,
                "radius_m",
                radius,
                &expected,
            )?;
        }
        if !self.region_map.is_empty() {
            check_length("coast_region", self.region_map.len(), lattice.node_count())?;
        }
        check_regions(&self.regions)
    }
}

/// Checks the two numbers of a force.
pub(super) fn check_force(force: f64, attenuation: f64) -> Result<(), CoastError> {
    check((0.0..=1e6).contains(&force), "force", force, "between 0 and 1e6")?;
    check((0.0..=1e6).contains(&attenuation), "attenuation", attenuation, "between 0 and 1e6")
}

/// Checks the material that an event takes.
pub(super) fn check_weakening(weakening: f64) -> Result<(), CoastError> {
    check((0.0..=1e6).contains(&weakening), "weakening", weakening, "between 0 and 1e6")
}
