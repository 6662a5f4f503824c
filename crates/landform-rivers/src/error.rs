//! What can be wrong with rivers and their ground.

use landform_analysis::grid::GridError;
use landform_graph::Connectivity;
use thiserror::Error;

use crate::water::MOST_M;

/// Why water cannot flow, or erode.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RiverError {
    /// A field does not have one value a node.
    #[error("field {name} has {found} values; the lattice has {expected} nodes")]
    Length {
        /// Name of the field.
        name: &'static str,
        /// Number of values given.
        found: usize,
        /// Number of nodes of the lattice.
        expected: usize,
    },
    /// An elevation or a depth is no number, or too large to be counted in whole units.
    #[error(
        "field {name} is {value} at node {node}; it must be a number within {least} and {MOST_M} m"
    )]
    Value {
        /// Name of the field.
        name: &'static str,
        /// Value found.
        value: f64,
        /// The first node that has such a value.
        node: usize,
        /// Least value allowed.
        least: f64,
    },
    /// The lattice is a volume.
    #[error("rivers need a 2-D lattice, not {0:?}; use Eight, Four or FourEight")]
    Volume(Connectivity),
    /// Erosion needs too many steps an iteration to be stable.
    #[error(
        "with this spacing, diffusion of {diffusion_m2} m2 an iteration at the largest flow needs \
         {steps} steps; it must be at most {most_m2:.3} m2"
    )]
    Stiff {
        /// Diffusion asked for, at the largest flow.
        diffusion_m2: f64,
        /// Steps that it takes.
        steps: f64,
        /// Largest diffusion allowed.
        most_m2: f64,
    },
    /// An iteration of the area-map form takes too many steps to be stable.
    #[error(
        "an iteration of {step_yr} years is too long for this spacing; take at most {most_yr:.3}"
    )]
    LongStep {
        /// Years asked for.
        step_yr: f64,
        /// Most years.
        most_yr: f64,
    },
    /// The lattice does not suit routing by D8.
    #[error(
        "drainage areas need eight neighbours and open borders; the lattice joins {0:?}: write \
         `connectivity: Eight, boundary: (Open, Open)` in the domain"
    )]
    Unsuited(Connectivity),
    /// The lattice does not have the eight directions that rivers run in.
    #[error(
        "drainage areas need eight neighbours; the lattice joins {0:?}: write \
         `connectivity: Eight` in the domain"
    )]
    Directions(Connectivity),
    /// Water has no way out.
    #[error(
        "water cannot leave: there is no side of `base_level`, and no ground below a `sea_level_m`"
    )]
    NoOutlet,
    /// Water cannot be routed over the heights.
    #[error("{0}")]
    Routing(GridError),
    /// A place lies outside the lattice.
    #[error("the place {center:?} lies outside the domain; give two shares between 0 and 1")]
    Outside {
        /// Shares of the width and of the height.
        center: [f64; 2],
    },
    /// Water is to leave over a border that is none.
    #[error("water is to leave over the {border} border, but that axis is periodic")]
    NoBorder {
        /// Name of the border.
        border: &'static str,
    },
    /// The step is too long for pipes.
    #[error(
        "steps of {step_s} s are too long for stable flow; take at most {most_s:.3} s on this lattice"
    )]
    Unstable {
        /// Step asked for.
        step_s: f64,
        /// Longest stable step.
        most_s: f64,
    },
}

/// Checks that a field has one value a node.
pub(crate) fn check_length(
    name: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), RiverError> {
    if found == expected { Ok(()) } else { Err(RiverError::Length { name, found, expected }) }
}

/// Checks that all values lie between `least` and [`MOST_M`].
pub(crate) fn check_values(
    name: &'static str,
    values: &[f64],
    least: f64,
) -> Result<(), RiverError> {
    match values.iter().position(|value| !(least..=MOST_M).contains(value)) {
        Some(node) => Err(RiverError::Value { name, value: values[node], node, least }),
        None => Ok(()),
    }
}
