//! Coasts of mixed kinds: numbers that differ from one part of the map to another.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::CoastError;
use super::settings::{check_force, check_weakening};
use super::{CoastSettings, Wear};

/// A side of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum MapSide {
    /// The quarter east of both diagonals of the map.
    East,
    /// The quarter north of both.
    North,
    /// The quarter west of both.
    West,
    /// The quarter south of both.
    South,
}

impl MapSide {
    /// The side of the point with these shares of the width from west to east and of the height
    /// from south to north.
    pub fn of([east, north]: [f64; 2]) -> Self {
        let (x, y) = (east - 0.5, north - 0.5);
        match (x.abs() >= y.abs(), x >= 0.0, y >= 0.0) {
            (true, true, _) => Self::East,
            (true, false, _) => Self::West,
            (false, _, true) => Self::North,
            (false, _, false) => Self::South,
        }
    }
}

/// A part of the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Place {
    /// Quarters of the map between its diagonals (thesis, figure 4.7).
    Sides(Vec<MapSide>),
    /// What lies within a polygon (even-odd rule), by the shares of the width from west to east
    /// and of the height from south to north of its corners.
    Polygon(Vec<[f64; 2]>),
    /// The nodes where the field `coast_region` has this number: any shape that an initial
    /// condition can draw.
    Numbered(u8),
}

impl Default for Place {
    fn default() -> Self {
        Self::Sides(Vec::new())
    }
}

impl Place {
    /// Whether the point with these shares of width and height, whose node has a number on the
    /// map of regions, lies in it.
    fn contains(&self, [east, north]: [f64; 2], number: u8) -> bool {
        match self {
            Self::Numbered(wanted) => *wanted == number,
            Self::Sides(sides) => sides.contains(&MapSide::of([east, north])),
            Self::Polygon(corners) => {
                let mut previous = corners.last().copied().unwrap_or_default();
                let mut inside = false;
                for &[x, y] in corners {
                    let across = (y > north) != (previous[1] > north);
                    let at = x + (north - y) / (previous[1] - y) * (previous[0] - x);
                    inside ^= across && east < at;
                    previous = [x, y];
                }
                inside
            }
        }
    }

    fn is_empty(&self) -> bool {
        match self {
            Self::Sides(sides) => sides.is_empty(),
            Self::Polygon(corners) => corners.len() < 3,
            Self::Numbered(_) => false,
        }
    }

    /// Whether it is found on the map of regions.
    pub(crate) fn is_numbered(&self) -> bool {
        matches!(self, Self::Numbered(_))
    }
}

/// A part of the map where the coast has numbers of its own (thesis, section 4.2.4). What is
/// missing is as everywhere else. Where regions overlap, the last one holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Region {
    /// Where.
    pub place: Place,
    /// Force of the sea f.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub force: Option<f64>,
    /// Attenuation g of the force.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub attenuation: Option<f64>,
    /// Material a that an event takes, where the process has `wear`.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub weakening: Option<f64>,
}

/// The numbers that may differ between regions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rule {
    pub(super) force: f64,
    pub(super) attenuation: f64,
    pub(super) weakening: f64,
}

impl Rule {
    /// The force on a coast of a perimeter, as a multiple of its measure (equations 2.8, 4.2).
    #[inline]
    pub(super) fn force_at(&self, perimeter: f64) -> f64 {
        self.force / (1.0 + self.attenuation * perimeter)
    }
}

/// Which rule holds at which node.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    rules: Vec<Rule>,
    /// Number of the rule of each node; empty when there is one rule only.
    numbers: Vec<u8>,
}

impl Rules {
    /// The rules of checked settings.
    pub(super) fn new(lattice: &Lattice, settings: &CoastSettings) -> Self {
        let weakening = settings.wear.map_or(0.0, |wear: Wear| wear.weakening);
        let base = Rule { force: settings.force, attenuation: settings.attenuation, weakening };
        let rule = |region: &Region| Rule {
            force: region.force.unwrap_or(base.force),
            attenuation: region.attenuation.unwrap_or(base.attenuation),
            weakening: region.weakening.unwrap_or(base.weakening),
        };
        let rules = [base].into_iter().chain(settings.regions.iter().map(rule)).collect();
        let number = |node: usize| {
            let [x, y, _] = lattice.coordinates(node);
            let [width, height, _] = lattice.size().map(|nodes| nodes as f64);
            let point = [(x as f64 + 0.5) / width, 1.0 - (y as f64 + 0.5) / height];
            let own = settings.region_map.get(node).copied().unwrap_or_default();
            let holds = |region: &Region| region.place.contains(point, own);
            let last = settings.regions.iter().rposition(holds);
            last.map_or(0, |index| index as u8 + 1)
        };
        let nodes = if settings.regions.is_empty() { 0 } else { lattice.node_count() };
        Self { rules, numbers: (0..nodes).map(number).collect() }
    }

    /// All rules.
    pub(super) fn all(&self) -> &[Rule] {
        &self.rules
    }

    /// Number of the rule of a node.
    #[inline]
    pub(super) fn number(&self, node: usize) -> usize {
        self.numbers.get(node).map_or(0, |&number| usize::from(number))
    }

    /// The rule of a node.
    #[inline]
    pub(super) fn of(&self, node: usize) -> &Rule {
        &self.rules[self.number(node)]
    }
}

/// Checks ranges, and that every region names some part of the map.
pub(super) fn check_regions(regions: &[Region]) -> Result<(), CoastError> {
    if regions.len() > 254 {
        return Err(CoastError::TooManyRegions(regions.len()));
    }
    for (index, region) in regions.iter().enumerate() {
        if region.place.is_empty() {
            return Err(CoastError::EmptyRegion(index));
        }
        check_force(region.force.unwrap_or(0.0), region.attenuation.unwrap_or(0.0))?;
        check_weakening(region.weakening.unwrap_or(0.0))?;
        if let Place::Polygon(corners) = &region.place {
            let found = corners.iter().flatten().find(|share| !(-1.0..=2.0).contains(*share));
            super::error::check(
                found.is_none(),
                "polygon",
                found.copied().unwrap_or_default(),
                "made of shares between -1 and 2",
            )?;
        }
    }
    Ok(())
}
