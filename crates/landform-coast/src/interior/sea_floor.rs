//! The floor of the sea round an island.

use landform_graph::Lattice;
use landform_graph::marching::{FastMarching, MarchOptions};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LevelSets, LevelSetsError};

/// How the floor of the sea falls away from the coast: with a slope at the shore, down to a depth
/// far out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SeaFloor {
    /// Fall over distance at the shore.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub slope: f64,
    /// Depth that the floor comes near far from all shores.
    #[schemars(range(min = 1e-9, max = 1e9), extend("x-unit" = "m"))]
    pub depth_m: f64,
}

impl Default for SeaFloor {
    /// A shelf of one in ten, 60 m deep.
    fn default() -> Self {
        Self { slope: 0.1, depth_m: 60.0 }
    }
}

impl SeaFloor {
    /// Whether slope and depth make a floor.
    pub fn is_valid(&self) -> bool {
        (0.0..=1000.0).contains(&self.slope) && (1e-9..=1e9).contains(&self.depth_m)
    }

    /// Height of the floor (metres below 0) at a distance from the shore: `-d (1 - exp(-s x / d))`
    /// with slope `s`, depth `d` and distance `x`.
    pub fn height_m(&self, distance_m: f64) -> f64 {
        self.depth_m * (-self.slope * distance_m / self.depth_m).exp_m1()
    }
}

/// Lowers the nodes of level set 0 (the sea, at 0 m) in `heights`, one value a node in metres, to
/// the floor of the sea. Those right beside higher land, the beach, stay where they are.
///
/// # Errors
/// See [`LevelSetsError`].
pub fn lay_sea_floor(
    lattice: &Lattice,
    levels: &LevelSets<'_>,
    floor: SeaFloor,
    heights: &mut [f64],
) -> Result<(), LevelSetsError> {
    levels.check(lattice)?;
    levels.check_heights(heights)?;
    let is_land = |node: &usize| levels.band[*node] > 0 || levels.on_level[*node] == 0;
    let land: Vec<usize> = (0..heights.len()).filter(is_land).collect();
    let mut march = FastMarching::new();
    let distances = march.distance(lattice, &land, MarchOptions::default())?.time;
    for (node, height) in heights.iter_mut().enumerate().filter(|(node, _)| !is_land(node)) {
        *height = floor.height_m((distances[node] - lattice.spacing()).max(0.0));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::testing::Cone;
    use super::*;

    #[test]
    fn the_floor_falls_with_its_slope_and_levels_off() {
        let floor = SeaFloor { slope: 0.2, depth_m: 50.0 };
        assert_eq!(floor.height_m(0.0), 0.0);
        assert!((floor.height_m(1e-3) + 2e-4).abs() < 1e-8);
        assert!((floor.height_m(250.0) + 50.0 * (1.0 - (-1.0_f64).exp())).abs() < 1e-12);
        assert_eq!(floor.height_m(f64::INFINITY), -50.0);
    }

    /// Round a circular island, depth follows from the distance to its middle alone.
    #[test]
    fn the_sea_round_a_cone_has_round_depths() {
        let cone = Cone::new(121, 10);
        let levels = cone.levels();
        let mut heights = vec![7.0; 121 * 121];
        let floor = SeaFloor { slope: 0.5, depth_m: 20.0 };
        lay_sea_floor(&cone.lattice, &levels, floor, &mut heights).unwrap();
        for (node, &height) in heights.iter().enumerate() {
            let [x, y, _] = cone.lattice.coordinates(node);
            let radius = (x as f64 - 60.0).hypot(y as f64 - 60.0);
            if levels.band[node] > 0 {
                assert_eq!(height, 7.0);
            } else {
                let exact = floor.height_m((radius - 51.0).max(0.0));
                assert!((height - exact).abs() < 0.6, "{height} for {exact} at {radius}");
            }
        }
    }

    #[test]
    fn no_land_is_no_shore() {
        let cone = Cone::new(9, 2);
        let (band, on_level) = (vec![0; 81], vec![1; 81]);
        let levels = LevelSets { band: &band, on_level: &on_level, interval_m: 1.0 };
        let mut heights = vec![0.0; 81];
        lay_sea_floor(&cone.lattice, &levels, SeaFloor::default(), &mut heights).unwrap();
        assert!(heights.iter().all(|&height| height == -60.0));
        let short = lay_sea_floor(&cone.lattice, &levels, SeaFloor::default(), &mut []);
        assert!(matches!(short, Err(LevelSetsError::Length { field: "heights", .. })));
    }
}
