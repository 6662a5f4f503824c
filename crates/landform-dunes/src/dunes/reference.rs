//! The dune model word for word: serial, slow and short, for reading and for tests.
//!
//! [`tick`] is Werner's model told plainly: nodes are polled one by one in random order, each
//! slab settles before the next is lifted, and a node looks upwind whenever shelter matters. The
//! [`Engine`](super::Engine) polls a quarter of the nodes at once instead; its dunes are the
//! same in the mean, not slab by slab. [`shadow`] and [`settle`] are the references of
//! [`cast_shadow`](super::cast_shadow) and of the engine's avalanches, which give their bits.

use landform_graph::Lattice;
use landform_sim::random::{RandomStream, unit};

use super::avalanche::{Family, Layers, Part, SlideRule, families};
use super::error::DuneError;
use super::{AvalancheSettings, Axis, DuneSettings, ShadowSettings, WindLine};

/// Whether `node` of a surface lies in shadow: looks upwind node by node.
///
/// `height` gives the surface at a node in metres.
pub fn is_shaded(
    lattice: &Lattice,
    height: impl Fn(usize) -> f64,
    wind: &WindLine,
    settings: &ShadowSettings,
    node: usize,
) -> bool {
    let place = lattice.coordinates(node);
    let axis = usize::from(wind.axis() == Axis::Rows);
    let count = lattice.size()[axis];
    let [place_along, sign] = match wind.is_forward() {
        true => [place[axis] as isize, 1],
        false => [(count - 1 - place[axis]) as isize, -1],
    };
    let length = wind.step_length() * lattice.spacing();
    let drop = settings.angle_deg.to_radians().tan() * length;
    let reach = settings.reach_m.map_or(count, |reach| count.min((reach / length + 1e-9) as usize));
    // Tilted by the drop of the shadow, the edge of the shadow is level.
    let here = height(node) + place_along as f64 * drop;
    for back in 1..=reach as isize {
        let across = wind.shift(place_along - back) - wind.shift(place_along);
        let mut step = [across, across, 0];
        step[axis] = -sign * back;
        let Some(upwind) = lattice.offset(place, step) else { return false };
        if height(upwind) + (place_along - back) as f64 * drop > here {
            return true;
        }
    }
    false
}

/// Marks the shaded nodes of `surface` (metres) by looking upwind from each.
pub fn shadow(
    lattice: &Lattice,
    surface: &[f64],
    wind: &WindLine,
    settings: &ShadowSettings,
    shaded: &mut [bool],
) {
    for (node, shaded) in shaded.iter_mut().enumerate() {
        *shaded = is_shaded(lattice, |node| surface[node], wind, settings, node);
    }
}

/// Lets sand come to rest by rounds over every edge; gives the number of rounds.
///
/// `bed` and `sand` in metres; `slab_m` at most tan(repose) times the spacing, else the slides
/// may never end and only the allowed number of sweeps stops them.
pub fn settle(
    lattice: &Lattice,
    settings: &AvalancheSettings,
    slab_m: f64,
    bed: &[f64],
    sand: &mut [f64],
) -> u32 {
    let mut surface: Vec<f64> = bed.iter().zip(&*sand).map(|(bed, sand)| bed + sand).collect();
    let families = families(lattice, settings.repose(), slab_m);
    let mut layers = Layers { bed, sand, surface: &mut surface };
    for round in 1..=settings.most_sweeps {
        let mut moved = false;
        for family in &families {
            for node in 0..lattice.node_count() {
                if let Some(end) = edge(lattice, family, node) {
                    moved |= family.rule.slide(&mut layers, node, end) > 0.0;
                }
            }
        }
        if !moved {
            return round;
        }
    }
    settings.most_sweeps
}

/// The node that the edge of a family from `node` ends in, if it has one there.
fn edge(lattice: &Lattice, family: &Family, node: usize) -> Option<usize> {
    let place = lattice.coordinates(node);
    let [column, row, _] = place;
    if family.even_nodes && (column + row) % 2 == 1 {
        return None;
    }
    let along = family.rows;
    let part = match place[along] {
        last if last + 1 == lattice.size()[along] => Part::Closing,
        even if even % 2 == 0 => Part::Even,
        _ => Part::Odd,
    };
    let step = [family.columns, family.rows as isize, 0];
    (part == family.part).then(|| lattice.offset(place, step)).flatten()
}

/// One tick of Werner's model: every node is polled once, in random order.
///
/// Werner drew each node anew, so that some are polled twice and some not at all in a tick;
/// that lifts a tenth fewer slabs from nearly flat sand and hardly matters later.
///
/// `bed` and `sand` in metres, one value a node; `seed` and `iteration` give the random
/// numbers. Every poll draws a wind of its own. Slabs that leave over an open border are lost;
/// sand is not fed in. Returns the number of slabs lifted.
///
/// # Errors
/// See [`DuneSettings::validate`].
pub fn tick(
    lattice: &Lattice,
    settings: &DuneSettings,
    shadow: &ShadowSettings,
    (seed, iteration): (u64, u64),
    bed: &[f64],
    sand: &mut [f64],
) -> Result<u64, DuneError> {
    settings.validate(lattice)?;
    let directions = settings.rose.directions()?;
    let slab = settings.transport.slab_m;
    let random = RandomStream::new(seed, "dunes reference");
    let mut lifts = 0;
    let mut order: Vec<usize> = (0..lattice.node_count()).collect();
    order.sort_by_key(|&node| random.block(iteration, node, 0)[0]);
    for node in order {
        let [direction, phase, along, across] = random.block(iteration, node, 1).map(unit);
        let wind = WindLine::new(directions.draw(direction), phase);
        let mut werner = Werner { lattice, settings, shadow, bed, sand, wind: &wind };
        let lifted = werner.sand[node] >= slab
            && (settings.transport.lift_in_shelter || !werner.is_sheltered(node));
        if !lifted {
            continue;
        }
        lifts += 1;
        werner.sand[node] -= slab;
        werner.fill_from_above(node);
        let hop = wind.jump(settings.transport.hop_m / lattice.spacing(), [along, across]);
        let chance = |hop: u32| unit(random.block(iteration, node, 2 + hop)[0]);
        if let Some(landed) = werner.fly(node, hop, chance) {
            werner.sand[landed] += slab;
            werner.let_slide(landed);
        }
    }
    Ok(lifts)
}

/// The sand and all that decides where a slab goes.
struct Werner<'a> {
    lattice: &'a Lattice,
    settings: &'a DuneSettings,
    shadow: &'a ShadowSettings,
    bed: &'a [f64],
    sand: &'a mut [f64],
    wind: &'a WindLine,
}

impl Werner<'_> {
    fn height(&self, node: usize) -> f64 {
        self.bed[node] + self.sand[node]
    }

    fn is_sheltered(&self, node: usize) -> bool {
        is_shaded(self.lattice, |node| self.height(node), self.wind, self.shadow, node)
    }

    /// Hops from `node` until the slab stays; `None` when it leaves the lattice.
    fn fly(&self, mut node: usize, hop: [isize; 2], chance: impl Fn(u32) -> f64) -> Option<usize> {
        let transport = &self.settings.transport;
        for number in 0..transport.most_hops {
            let place = self.lattice.coordinates(node);
            node = self.lattice.offset(place, [hop[0], hop[1], 0])?;
            let stays = match self.sand[node] >= transport.slab_m {
                true => transport.deposit_on_sand,
                false => transport.deposit_on_bare,
            };
            if chance(number) < stays || self.is_sheltered(node) {
                break;
            }
        }
        Some(node)
    }

    /// After a deposit: the slab slides down the steepest slope until it can rest.
    fn let_slide(&mut self, mut node: usize) {
        while let Some(lower) = self.steepest(node, |step| step) {
            self.sand[node] -= self.settings.transport.slab_m;
            self.sand[lower] += self.settings.transport.slab_m;
            node = lower;
        }
    }

    /// After a loss: slabs slide in from the steepest slope above, and in turn from above that.
    fn fill_from_above(&mut self, mut node: usize) {
        while let Some(upper) = self.steepest(node, |step| -step) {
            self.sand[upper] -= self.settings.transport.slab_m;
            self.sand[node] += self.settings.transport.slab_m;
            node = upper;
        }
    }

    /// The neighbour over the steepest edge that is steeper than repose and whose upper node
    /// holds a slab. `fall` turns the step down to the neighbour into the fall that counts.
    fn steepest(&self, node: usize, fall: impl Fn(f64) -> f64) -> Option<usize> {
        let repose = self.settings.avalanche.repose();
        let slab = self.settings.transport.slab_m;
        let mut found = (0.0, None);
        for edge in self.lattice.neighbours(node) {
            let step = self.height(node) - self.height(edge.node);
            let upper = if step > 0.0 { node } else { edge.node };
            let rule = SlideRule::new(repose, edge.distance, slab);
            let slope = fall(step) / edge.distance;
            if fall(step) > rule.trigger() && slope > found.0 && self.sand[upper] >= slab {
                found = (slope, Some(edge.node));
            }
        }
        found.1
    }
}
