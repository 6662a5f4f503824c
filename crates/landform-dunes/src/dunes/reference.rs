//! The dune model word for word: serial, slow and short, for reading and for tests.
//!
//! [`tick`] is Werner's model told plainly: nodes are polled one by one in random order, each
//! slab settles before the next is lifted, and a node looks upwind whenever shelter matters. The
//! [`Engine`](super::Engine) polls a quarter of the nodes at once instead; its dunes are the
//! same in the mean, not slab by slab. [`shadow`] and [`settle`] are the references of
//! [`cast_shadow`](super::cast_shadow) and of the engine's avalanches, which give their bits.

use landform_graph::{Connectivity, Lattice};
use landform_sim::random::{RandomStream, unit};

use super::avalanche::{BAND, Layers};
use super::error::DuneError;
use super::stencil::{STEPS, SlideRule, TOLERANCE, first_look};
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

/// Lets sand come to rest, looking at every edge of every node again and again.
///
/// `bed` and `sand` in metres; `slab_m` at most tan(repose) times the spacing, else the slides
/// may never end and only the allowed number of sweeps stops them.
pub fn settle(
    lattice: &Lattice,
    settings: &AvalancheSettings,
    slab_m: f64,
    bed: &[f64],
    sand: &mut [f64],
) {
    let mut surface: Vec<f64> = bed.iter().zip(&*sand).map(|(bed, sand)| bed + sand).collect();
    let layers = Layers { bed, sand, surface: &mut surface };
    let mut slope = Slope { lattice, repose: settings.repose(), slab_m, layers, rows: Vec::new() };
    let height = lattice.height();
    let from = |first: usize| (first..height).step_by(BAND);
    let bands = from(0).chain(from(BAND / 2)).map(|row| (row..height.min(row + BAND)).collect());
    let mut bands: Vec<Vec<usize>> = bands.collect();
    if lattice.is_periodic(1) {
        let count = BAND.min(height);
        bands.push((0..count).map(|row| (height - count / 2 + row) % height).collect());
    }
    for _ in 0..settings.most_sweeps {
        let mut slides = 0;
        for band in &bands {
            slope.rows.clone_from(band);
            slides += slope.settle();
        }
        if slides == 0 {
            return;
        }
    }
}

/// Rows of a lattice that come to rest together.
struct Slope<'a> {
    lattice: &'a Lattice,
    repose: f64,
    slab_m: f64,
    layers: Layers<'a>,
    rows: Vec<usize>,
}

impl Slope<'_> {
    /// Lets the sand of the rows come to rest; gives the number of slides.
    fn settle(&mut self) -> u64 {
        let mut slides = 0;
        for row in self.rows.clone() {
            let mut unstable = Vec::new();
            for k in [0, 3, 6, 7] {
                for column in self.columns(k) {
                    let node = self.lattice.node([column, row, 0]);
                    let Some(end) = self.neighbour(node, k) else { continue };
                    for (upper, lower) in [(node, end), (end, node)] {
                        let step = self.layers.surface[upper] - self.layers.surface[lower];
                        if step > self.rule(k).trigger() {
                            unstable.push(upper);
                        }
                    }
                }
            }
            while let Some(node) = unstable.pop() {
                slides += self.follow(node, &mut unstable);
            }
        }
        slides
    }

    /// Columns from west to east; those that an edge in direction `k` leaves over the border
    /// come last.
    fn columns(&self, k: usize) -> impl Iterator<Item = usize> + use<> {
        let width = self.lattice.width();
        let first = usize::from(STEPS[k][0] < 0);
        (first..width).chain(0..first)
    }

    /// Lets sand slide from a node, follows it down until it rests, and lists where else sand
    /// may slide now.
    fn follow(&mut self, mut node: usize, unstable: &mut Vec<usize>) -> u64 {
        let mut slides = 0;
        while let Some((k, lower, step)) = self.steepest(node) {
            self.rule(k).slide(&mut self.layers, node, lower, step);
            slides += 1;
            unstable.extend(self.steepest(node).map(|_| node));
            for k in 0..8 {
                let above = self.neighbour(node, k);
                unstable.extend(above.filter(|&above| self.slope(above, node, k) > 0.0));
            }
            node = lower;
        }
        slides
    }

    /// Direction, neighbour and step of the steepest edge that sand slides down.
    fn steepest(&self, node: usize) -> Option<(usize, usize, f64)> {
        let [column, row, _] = self.lattice.coordinates(node);
        let count = if self.lattice.connectivity() == Connectivity::Four { 4 } else { 8 };
        let mut found = (0.0, None);
        for turn in 0..count {
            let k = (first_look(column, row) + turn) % count;
            let Some(lower) = self.neighbour(node, k) else { continue };
            let slope = self.slope(node, lower, k);
            if slope > found.0 && self.layers.sand[node] > 0.0 {
                let step = self.layers.surface[node] - self.layers.surface[lower];
                found = (slope, Some((k, lower, step)));
            }
        }
        found.1
    }

    /// Slope down an edge in direction `k`; zero where it is not too steep.
    fn slope(&self, upper: usize, lower: usize, k: usize) -> f64 {
        let step = self.layers.surface[upper] - self.layers.surface[lower];
        let slope = step * (1.0 / self.length(k));
        if slope > self.repose + TOLERANCE { slope } else { 0.0 }
    }

    /// The neighbour of a node in direction `k`, if it has one in these rows.
    fn neighbour(&self, node: usize, k: usize) -> Option<usize> {
        let [columns, rows] = STEPS[k];
        let place = self.lattice.coordinates(node);
        let end = self.lattice.offset(place, [columns, rows, 0])?;
        let at = |row: usize| self.rows.iter().position(|&known| known == row);
        let [from, to] = [at(place[1])?, at(self.lattice.coordinates(end)[1])?];
        let is_next = from as isize + rows == to as isize;
        (is_next && self.lattice.neighbours(node).any(|edge| edge.node == end)).then_some(end)
    }

    fn length(&self, k: usize) -> f64 {
        let [columns, rows] = STEPS[k];
        self.lattice.step_length([columns as i8, rows as i8, 0])
    }

    fn rule(&self, k: usize) -> SlideRule {
        SlideRule::new(self.repose, self.length(k), self.slab_m)
    }
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
