//! Protection: shelter from the wind without a test of visibility (thesis, section 4.1.2).
//!
//! Every node contributes to the protection of the nodes in a cone downwind of it. Deposition
//! raises the protection of that cone, erosion lowers it, and a protected node loses no sand to
//! the wind. One moved slab thus changes the chances of every later event in two cones, which is
//! the avalanching that the thesis puts in the place of shadows; and as the cone covers the
//! whole range of the winds, no groove along single wind directions comes of it.
//!
//! The thesis does not say what a contribution weighs, from which level it counts, nor whether
//! a node's own height matters. Here each node of the cone weighs the same, and a node `v` with
//! `n` nodes in the cone upwind is protected when
//!
//! ```text
//! (1/n) sum of h(u) over the cone upwind  >  m + w (h(v) - m)
//! ```
//!
//! `h` height of the surface, `m` its mean over the lattice, `w` the weight of the own height.
//! `w = 0` is the thesis' reading (what is above the mean protects, the own height is of no
//! account): steep dunes, whose crests count as protected as well. `w = 1` compares a node with
//! what lies upwind alone, so it does not care for the mean level and suits a bed that slopes;
//! it makes dunes no steeper than those by shadow. The measurements
//! behind this are in the book, page "Calibration of the dunes".
//!
//! The state is kept up to date from event to event in whole quanta of height and equals the
//! state computed afresh, bit for bit (`protection_by_definition` is that reference).
//!
//! Limits: heights that would overflow a sum (130 km for the cone of the thesis at a spacing of
//! 10 m) count as the highest that fits. Nothing protects from beyond an open border.

use landform_graph::Lattice;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cone::Cone;
use super::cone_sums::ConeSums;
use super::error::{DuneError, check, check_length};
use super::{Exposure, Rose, Shelter};

/// The shape of the cone of protection and the level that it is compared with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProtectionSettings {
    /// Length of the cone in metres, the thesis' search radius; at least the spacing.
    /// Default 120.
    pub reach_m: f64,
    /// Weight `w` of a node's own height, in [0, 1]. Default 0.
    pub own_weight: f64,
}

impl Default for ProtectionSettings {
    fn default() -> Self {
        Self { reach_m: 120.0, own_weight: 0.0 }
    }
}

/// Shelter by protection: one cone for each wind of the rose, as wide as the wind's spread.
///
/// The shelter in a sub-step is that of the wind whose mean direction is nearest to the
/// direction that blows.
///
/// ```
/// use landform_dunes::dunes::{Protection, ProtectionSettings, Rose};
/// use landform_graph::{Boundary, Connectivity, Lattice};
///
/// let boundary = [Boundary::Periodic; 2];
/// let lattice = Lattice::plane([64, 32], 10.0, Connectivity::FourEight, boundary)?;
/// let mut protection = Protection::new(ProtectionSettings::default(), &Rose::default(), &lattice)?;
/// let mut surface = vec![20.0; 64 * 32];
/// surface[64 * 16 + 8] = 25.0;
/// protection.update(0, &surface)?;
/// let mut sheltered = vec![false; 64 * 32];
/// protection.mark(0, &mut sheltered);
/// // The mound protects its cone: two nodes downwind lie in it, two upwind do not.
/// assert!(sheltered[64 * 16 + 10] && !sheltered[64 * 16 + 6]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Protection {
    settings: ProtectionSettings,
    cones: Vec<WindCone>,
    node_count: usize,
}

/// The sums for the cone of one wind.
#[derive(Clone, Debug)]
struct WindCone {
    /// Mean direction that the wind blows to, radians.
    angle: f64,
    sums: ConeSums,
}

impl Protection {
    /// Protection on `lattice` in the winds of `rose`, with a surface of height zero so far.
    ///
    /// # Errors
    /// [`DuneError::Range`] for settings out of range, a spread of more than 90 degrees, or a
    /// cone that does not fit in the lattice; [`DuneError::Volume`]; see [`Rose::validate`].
    pub fn new(
        settings: ProtectionSettings,
        rose: &Rose,
        lattice: &Lattice,
    ) -> Result<Self, DuneError> {
        if lattice.connectivity().is_volume() {
            return Err(DuneError::Volume(lattice.connectivity()));
        }
        rose.validate()?;
        let weight = settings.own_weight;
        check((0.0..=1.0).contains(&weight), "own_weight", weight, "between 0 and 1")?;
        let blowing = rose.winds.iter().filter(|wind| wind.weight > 0.0);
        let cones = blowing.map(|wind| {
            // One direction only is no range of winds, whatever its spread says.
            let spread_deg = if wind.directions > 1 { wind.spread_deg } else { 0.0 };
            let cone = Cone::new(lattice, wind.towards_deg, spread_deg, settings.reach_m)?;
            let sums = ConeSums::new(lattice, cone);
            Ok(WindCone { angle: wind.towards_deg.to_radians(), sums })
        });
        let cones = cones.collect::<Result<Vec<_>, DuneError>>()?;
        Ok(Self { settings, cones, node_count: lattice.node_count() })
    }

    /// Number of winds with a cone.
    pub fn wind_count(&self) -> usize {
        self.cones.len()
    }

    /// Records erosion or deposition at one node, whose surface is now `height_m` metres high.
    /// Cost: the nodes of a cone, for each wind. Nodes outside the lattice are ignored.
    pub fn set_height(&mut self, node: usize, height_m: f64) {
        if node < self.node_count {
            self.cones.iter_mut().for_each(|cone| cone.sums.set_height(node, height_m));
        }
    }

    /// Brings the protection from wind number `wind` up to date with a surface (metres, one
    /// value a node). Cost: what changed, and at most about 3 ns a node for the thesis' cone.
    ///
    /// # Errors
    /// [`DuneError::Length`] when the surface has not one value a node.
    pub fn update(&mut self, wind: usize, surface: &[f64]) -> Result<(), DuneError> {
        check_length("surface", surface.len(), self.node_count)?;
        if let Some(cone) = self.cones.get_mut(wind) {
            cone.sums.update(surface);
        }
        Ok(())
    }

    /// Sets `sheltered` (one value a node) to the nodes protected from wind number `wind`.
    pub fn mark(&self, wind: usize, sheltered: &mut [bool]) {
        match self.cones.get(wind) {
            Some(cone) if sheltered.len() == self.node_count => {
                cone.sums.mark(self.settings.own_weight, sheltered);
            }
            _ => sheltered.fill(false),
        }
    }

    /// Number of the wind whose mean direction is nearest to `angle` radians; the first of
    /// equally near ones.
    pub fn nearest_wind(&self, angle: f64) -> usize {
        let nearness = |cone: &WindCone| (cone.angle - angle).cos();
        let mut nearest = 0;
        for (number, cone) in self.cones.iter().enumerate() {
            if nearness(cone) > nearness(&self.cones[nearest]) {
                nearest = number;
            }
        }
        nearest
    }
}

impl Shelter for Protection {
    fn shelter(&mut self, exposure: &Exposure<'_>, sheltered: &mut [bool]) {
        let wind = self.nearest_wind(exposure.wind.angle());
        if self.update(wind, exposure.surface).is_ok() {
            self.mark(wind, sheltered);
        } else {
            sheltered.fill(false);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dunes::{Wind, protection_by_definition};
    use landform_graph::{Boundary, Connectivity};
    use landform_sim::random::{RandomStream, unit};

    fn lattice(size: [usize; 2], boundary: [Boundary; 2]) -> Lattice {
        Lattice::plane(size, 10.0, Connectivity::FourEight, boundary).unwrap()
    }

    fn noise(lattice: &Lattice, seed: u64) -> Vec<f64> {
        let stream = RandomStream::new(seed, "surface");
        let height = |node| 40.0 * unit(stream.block(0, node, 0)[0]) - 10.0;
        (0..lattice.node_count()).map(height).collect()
    }

    fn rose(towards_deg: f64, spread_deg: f64) -> Rose {
        let directions = if spread_deg > 0.0 { 3 } else { 1 };
        Rose { winds: vec![Wind { towards_deg, spread_deg, directions, ..Wind::default() }] }
    }

    fn marks(protection: &Protection, lattice: &Lattice) -> Vec<bool> {
        let mut sheltered = vec![false; lattice.node_count()];
        protection.mark(0, &mut sheltered);
        sheltered
    }

    #[test]
    fn update_gives_what_the_definition_says() {
        use Boundary::{Open, Periodic};
        for boundary in [[Periodic; 2], [Open, Periodic], [Open; 2]] {
            let lattice = lattice([46, 40], boundary);
            let surface = noise(&lattice, 3);
            for (towards, spread) in [(0.0, 15.0), (90.0, 15.0), (200.0, 30.0), (-35.0, 0.0)] {
                for own_weight in [0.0, 0.3, 1.0] {
                    let settings = ProtectionSettings { own_weight, ..Default::default() };
                    let rose = rose(towards, spread);
                    let mut protection =
                        Protection::new(settings.clone(), &rose, &lattice).unwrap();
                    protection.update(0, &surface).unwrap();
                    let wanted =
                        protection_by_definition(&lattice, &surface, &settings, towards, spread);
                    assert_eq!(marks(&protection, &lattice), wanted.unwrap());
                }
            }
        }
    }

    #[test]
    fn events_keep_the_sums_that_a_fresh_start_finds() {
        let lattice = lattice([64, 48], [Boundary::Periodic, Boundary::Open]);
        let settings = ProtectionSettings::default();
        let mut surface = noise(&lattice, 5);
        let mut by_event = Protection::new(settings.clone(), &rose(20.0, 15.0), &lattice).unwrap();
        by_event.update(0, &surface).unwrap();
        let mut by_update = by_event.clone();
        let stream = RandomStream::new(9, "events");
        // Few, then many changes at a time: both ways through `update`.
        for (round, events) in [3_usize, 40, 3000, 7, 5000].into_iter().enumerate() {
            for event in 0..events {
                let [place, change, ..] = stream.block(round as u64, event, 0);
                let node = place as usize % surface.len();
                surface[node] += 10.0 * unit(change) - 5.0;
                by_event.set_height(node, surface[node]);
            }
            by_update.update(0, &surface).unwrap();
            let mut fresh = Protection::new(settings.clone(), &rose(20.0, 15.0), &lattice).unwrap();
            fresh.update(0, &surface).unwrap();
            for kept in [&by_event, &by_update] {
                assert_eq!(kept.cones[0].sums.heights(), fresh.cones[0].sums.heights());
                assert_eq!(kept.cones[0].sums.sums(), fresh.cones[0].sums.sums());
                assert_eq!(marks(kept, &lattice), marks(&fresh, &lattice));
            }
        }
    }

    #[test]
    fn deposition_protects_the_cone_and_erosion_exposes_it() {
        let lattice = lattice([64, 32], [Boundary::Periodic; 2]);
        let mut protection =
            Protection::new(ProtectionSettings::default(), &rose(0.0, 15.0), &lattice).unwrap();
        let apex = lattice.node([20, 16, 0]);
        assert!(!marks(&protection, &lattice).contains(&true), "flat ground protects nothing");
        protection.set_height(apex, 5.0);
        let protected = marks(&protection, &lattice);
        assert_eq!(protected.iter().filter(|&&is| is).count(), 36);
        assert!(!protected[apex] && protected[lattice.node([32, 16, 0])]);
        protection.set_height(apex, -5.0);
        let protected = marks(&protection, &lattice);
        assert!(!protected[lattice.node([32, 16, 0])] && protected[apex]);
        protection.set_height(apex, 0.0);
        assert!(!marks(&protection, &lattice).contains(&true));
    }

    #[test]
    fn a_level_surface_protects_nothing_at_any_height_or_weight() {
        let lattice = lattice([40, 40], [Boundary::Open; 2]);
        for own_weight in [0.0, 0.37, 1.0] {
            let settings = ProtectionSettings { own_weight, ..Default::default() };
            let mut protection = Protection::new(settings, &rose(10.0, 15.0), &lattice).unwrap();
            protection.update(0, &vec![1234.567; 1600]).unwrap();
            assert!(!marks(&protection, &lattice).contains(&true));
        }
    }

    #[test]
    fn threads_do_not_change_a_bit() {
        let lattice = lattice([256, 128], [Boundary::Periodic; 2]);
        let surface = noise(&lattice, 11);
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut protection =
                    Protection::new(ProtectionSettings::default(), &rose(7.0, 15.0), &lattice)
                        .unwrap();
                protection.update(0, &surface).unwrap();
                (protection.cones[0].sums.sums().to_vec(), marks(&protection, &lattice))
            })
        };
        let one = on(1);
        assert!(one == on(2) && one == on(8));
    }

    #[test]
    fn wild_heights_stay_in_range() {
        let lattice = lattice([40, 40], [Boundary::Periodic; 2]);
        let mut surface = noise(&lattice, 2);
        surface[..5].copy_from_slice(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300]);
        let mut protection =
            Protection::new(ProtectionSettings::default(), &rose(0.0, 15.0), &lattice).unwrap();
        protection.update(0, &surface).unwrap();
        surface.fill(f64::INFINITY);
        protection.update(0, &surface).unwrap();
        surface.fill(0.0);
        protection.update(0, &surface).unwrap();
        assert!(protection.cones[0].sums.sums().iter().all(|&sum| sum == 0));
    }

    #[test]
    fn cones_that_do_not_fit_are_refused() {
        let lattice = lattice([40, 30], [Boundary::Periodic; 2]);
        let build = |reach_m, towards, spread| {
            let settings = ProtectionSettings { reach_m, ..Default::default() };
            Protection::new(settings, &rose(towards, spread), &lattice).map(|_| ())
        };
        assert!(build(120.0, 0.0, 15.0).is_ok());
        for (reach, towards, spread) in [
            (5.0, 0.0, 15.0),
            (f64::NAN, 0.0, 15.0),
            (350.0, 90.0, 15.0),
            (1e9, 0.0, 0.0),
            (390.0, 0.0, 89.0),
            (90.0, 0.0, 120.0),
        ] {
            let error = build(reach, towards, spread).unwrap_err();
            assert!(error.to_string().contains("must be"), "{error}");
        }
    }

    #[test]
    fn each_wind_has_its_cone() {
        let lattice = lattice([64, 64], [Boundary::Periodic; 2]);
        let winds = [0.0, 90.0].map(|towards_deg| Wind { towards_deg, ..Wind::default() });
        let rose = Rose { winds: winds.to_vec() };
        let protection = Protection::new(ProtectionSettings::default(), &rose, &lattice).unwrap();
        assert_eq!(protection.wind_count(), 2);
        assert_eq!(protection.nearest_wind(0.2), 0);
        assert_eq!(protection.nearest_wind(1.4), 1);
        assert_eq!(protection.nearest_wind(-6.2), 0);
    }
}
