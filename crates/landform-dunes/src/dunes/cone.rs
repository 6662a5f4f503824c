//! The cone downwind of a node, as the spans of rows that it covers.
//!
//! A node contributes to the protection of the nodes in a cone downwind of it (thesis, section
//! 4.1.2). The cone is as long as the search radius and as wide as the wind varies. On a
//! lattice it is a set of displacements, the same for every node; a displacement `d` belongs
//! to it when `|d|` is at most the reach and the angle between `d` and the mean wind at most the
//! spread. Displacements within half a node of the axis belong to it too, so that the cone of
//! a steady oblique wind is an unbroken line. The node itself is not in its cone.

use landform_graph::Lattice;

use super::error::{DuneError, check};

/// Displacements in one row of a cone: `first..=last` columns, `row` rows on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    /// Rows from the apex, southward.
    pub row: isize,
    /// Fewest columns from the apex, eastward.
    pub first: isize,
    /// Most columns from the apex.
    pub last: isize,
}

/// The displacements of a cone.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cone {
    /// Rows of the cone from north to south.
    pub spans: Vec<Span>,
    /// Number of displacements.
    pub nodes: usize,
}

impl Cone {
    /// The cone of a wind that blows to `towards_deg` (counter-clockwise from east) and varies
    /// by `spread_deg` to either side, `reach_m` metres long.
    ///
    /// # Errors
    /// [`DuneError::Range`] for a cone wider than a half turn, shorter than one node or so
    /// long that it would meet itself on a periodic axis.
    pub fn new(
        lattice: &Lattice,
        towards_deg: f64,
        spread_deg: f64,
        reach_m: f64,
    ) -> Result<Self, DuneError> {
        let spread_fits = (0.0..=90.0).contains(&spread_deg);
        check(spread_fits, "spread_deg", spread_deg, "between 0 and 90 for a cone of protection")?;
        check(towards_deg.is_finite(), "towards_deg", towards_deg, "a finite angle")?;
        let reach = reach_m / lattice.spacing();
        check(reach >= 1.0, "protection reach_m", reach_m, "at least the spacing")?;
        let longest = lattice.width().max(lattice.height()) as f64;
        let shorter = "shorter than the lattice, and the cone narrower";
        check(reach <= longest, "protection reach_m", reach_m, shorter)?;
        let cone = Self::covering(towards_deg.to_radians(), spread_deg.to_radians(), reach);
        let [columns, rows] = cone.extent();
        let fits = (columns <= lattice.width() || !lattice.is_periodic(0))
            && (rows <= lattice.height() || !lattice.is_periodic(1));
        check(fits, "protection reach_m", reach_m, shorter)?;
        Ok(cone)
    }

    /// The cone, `reach` nodes long, of a wind to `angle` radians.
    fn covering(angle: f64, spread: f64, reach: f64) -> Self {
        let most = reach.ceil() as isize;
        let mut spans: Vec<Span> = Vec::new();
        for row in -most..=most {
            for column in -most..=most {
                if !covers(angle, spread, reach, [column, row]) {
                    continue;
                }
                match spans.last_mut() {
                    Some(span) if span.row == row && span.last == column - 1 => span.last = column,
                    _ => spans.push(Span { row, first: column, last: column }),
                }
            }
        }
        let nodes = spans.iter().map(|span| (span.last - span.first + 1) as usize).sum();
        Self { spans, nodes }
    }

    /// Number of columns and rows that the cone and its apex take up.
    fn extent(&self) -> [usize; 2] {
        let [west, east] = self.margins();
        let south = self.spans.iter().map(|span| span.row).max().unwrap_or(0).max(0);
        let north = self.spans.iter().map(|span| -span.row).max().unwrap_or(0).max(0);
        [west + east + 1, (south + north) as usize + 1]
    }

    /// Columns that the cone reaches to the west and to the east of its apex.
    pub fn margins(&self) -> [usize; 2] {
        let west = self.spans.iter().map(|span| -span.first).max().unwrap_or(0).max(0);
        let east = self.spans.iter().map(|span| span.last).max().unwrap_or(0).max(0);
        [west as usize, east as usize]
    }
}

/// Whether a displacement of columns and rows lies in the cone: the definition.
pub(super) fn covers(angle: f64, spread: f64, reach: f64, [column, row]: [isize; 2]) -> bool {
    // Rounding must not decide about nodes exactly on the rim.
    const RIM: f64 = 1e-9;
    let [east, north] = [column as f64, -row as f64];
    let [along, across] =
        [east * angle.cos() + north * angle.sin(), north * angle.cos() - east * angle.sin()];
    let inside = across.atan2(along).abs() <= spread + RIM || (across.abs() <= 0.5 && along > 0.0);
    [column, row] != [0, 0] && east.hypot(north) <= reach + RIM && inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn cone(angle_deg: f64, spread_deg: f64, reach: f64) -> Cone {
        Cone::covering(angle_deg.to_radians(), spread_deg.to_radians(), reach)
    }

    fn displacements(cone: &Cone) -> BTreeSet<[isize; 2]> {
        let columns =
            |span: &Span| (span.first..=span.last).map(|column| [column, span.row]).collect();
        cone.spans.iter().flat_map(|span| -> Vec<_> { columns(span) }).collect()
    }

    #[test]
    fn the_cone_of_the_thesis_has_36_nodes() {
        // Twelve nodes long, 15 degrees to either side; the rim cuts the corners off.
        let cone = cone(0.0, 15.0, 12.0);
        let span = |row, first, last| Span { row, first, last };
        let wanted =
            [span(-2, 8, 11), span(-1, 4, 11), span(0, 1, 12), span(1, 4, 11), span(2, 8, 11)];
        assert_eq!(cone.spans, wanted);
        assert_eq!(cone.nodes, 36);
        assert_eq!(cone.margins(), [0, 12]);
        assert_eq!(cone.extent(), [13, 5]);
    }

    #[test]
    fn quarter_turns_turn_the_cone() {
        for turns in 1..4 {
            let turned = (0..turns).fold(displacements(&cone(10.0, 20.0, 9.0)), |cone, _| {
                cone.into_iter().map(|[column, row]| [row, -column]).collect()
            });
            let angle = 10.0 + 90.0 * f64::from(turns);
            assert_eq!(displacements(&cone(angle, 20.0, 9.0)), turned);
        }
    }

    #[test]
    fn a_steady_oblique_wind_has_an_unbroken_line() {
        let line = displacements(&cone(27.0, 0.0, 20.0));
        for &[column, row] in &line {
            let nearer = [[1, 0], [0, -1], [1, -1]].map(|[x, y]| [column - x, row - y]);
            assert!(nearer.iter().any(|place| *place == [0, 0] || line.contains(place)));
        }
        assert!(line.iter().any(|&[column, _]| column == 17));
    }
}
