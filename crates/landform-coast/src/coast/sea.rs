//! The force of the sea.

use landform_graph::Lattice;

use super::regions::Rules;
use super::withstood::least_withstood;
use super::{CoastSettings, PARTS, spacings};

/// The force of the sea at the places of a map, by the perimeter there (equations 2.8 and 4.2).
#[derive(Clone, Debug)]
pub(super) struct Sea {
    pub(super) rules: Rules,
    /// What the force is multiplied with.
    pub(super) pressure: f64,
    spacing_m: f64,
    /// Length of a straight coast across the disc.
    across_m: f64,
}

impl Sea {
    /// The sea of checked settings.
    pub(super) fn new(lattice: &Lattice, settings: &CoastSettings) -> Self {
        let radius_m = settings.perimeter.radius_m().unwrap_or(1.0);
        Self {
            rules: Rules::new(lattice, settings),
            pressure: 1.0,
            spacing_m: lattice.spacing(),
            across_m: 2.0 * radius_m,
        }
    }

    /// Force at a node by its perimeter, as a multiple of its measure.
    #[inline]
    pub(super) fn force(&self, node: usize, perimeter: f64) -> f64 {
        self.pressure * self.rules.of(node).force_at(perimeter)
    }

    /// A local perimeter in parts as a multiple of a straight coast across the disc.
    #[inline]
    pub(super) fn local(&self, parts: u64) -> f64 {
        spacings(parts) * self.spacing_m / self.across_m
    }

    /// Whether a node of a strength may fall: no perimeter raises the force above that of none.
    #[inline]
    pub(super) fn can_fell(&self, node: usize, strength: f64) -> bool {
        strength < self.pressure * self.rules.of(node).force
    }

    /// The least local perimeter in parts with which a node of a strength stands.
    pub(super) fn least_perimeter(&self, node: usize, strength: f64) -> i32 {
        let falls = |parts: i32| strength < self.force(node, self.local(parts as u64));
        let rule = self.rules.of(node);
        let perimeter = (self.pressure * rule.force / strength - 1.0) / rule.attenuation;
        let guess = perimeter * self.across_m / self.spacing_m * f64::from(PARTS);
        least_withstood(falls, guess.ceil())
    }
}
