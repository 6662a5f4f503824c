//! Names with their unit, as they stand beside axes.

/// Endings of names and how their unit is written.
const UNITS: [(&str, &str); 14] = [
    ("_m_per_s", "m/s"),
    ("_per_m", "1/m"),
    ("_per_iteration", "per iteration"),
    ("_m2", "m²"),
    ("_m3", "m³"),
    ("_km", "km"),
    ("_m", "m"),
    ("_deg", "°"),
    ("_percent", "%"),
    ("_nodes", "nodes"),
    ("_s", "s"),
    ("_a", "a"),
    ("_iterations", "iterations"),
    ("_cells", "cells"),
];

/// The label of an axis for a parameter or metric whose name carries its unit.
///
/// ```
/// use landform_view::plot::label;
///
/// assert_eq!(label("crest_spacing_m"), "crest spacing (m)");
/// assert_eq!(label("hops_per_lift"), "hops per lift");
/// ```
pub fn label(name: &str) -> String {
    let unit = UNITS.iter().find_map(|&(ending, unit)| {
        let stem = name.strip_suffix(ending).filter(|stem| !stem.is_empty())?;
        Some((stem, unit))
    });
    match unit {
        Some((stem, unit)) => format!("{} ({unit})", stem.replace('_', " ")),
        None => name.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_unit_counts() {
        for (name, expected) in [
            ("slab_m", "slab (m)"),
            ("migration_m_per_iteration", "migration m (per iteration)"),
            ("diffusivity_m2", "diffusivity (m²)"),
            ("repose_deg", "repose (°)"),
            ("_m", " m"),
            ("", ""),
        ] {
            assert_eq!(label(name), expected);
        }
    }
}
