//! The engine: what one iteration does to a coast.

use landform_graph::Lattice;

use super::arcs::Arcs;
use super::disc_sums::DiscSums;
use super::error::check_length;
use super::regions::Rules;
use super::shore::spacings;
use super::wear::WeakeningDisc;
use super::{CoastError, CoastSettings, Perimeter, Shore};

/// What one iteration did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Events {
    /// Nodes that fell to the sea, in node order.
    pub eroded: Vec<u32>,
    /// Land nodes that now belong to the coast and did not before.
    pub exposed: Vec<u32>,
    /// Coast nodes whose shore has changed its length, the new ones among them.
    pub measured: Vec<u32>,
}

/// A coast that erodes (thesis, section 4.2).
///
/// Land nodes beside the sea, over the edges of the lattice, are the coast. Each has a
/// resistance u, and exposure leaves a strength r(u) of it. In one iteration all coast nodes
/// whose strength is below the force of the sea at their place fall together, and the land
/// behind them becomes the coast. The force sinks as the shore grows longer.
///
/// With [`super::Wear`] a resistance is an amount of material. It shrinks by a share of the force
/// where the coast withstands it, and around each node that falls.
///
/// Everything here follows from settings, land and resistance: a coast made anew goes on alike.
///
/// Memory: 12 bytes a node, 8 more for a perimeter within a radius, 16 for a contiguous one.
#[derive(Clone, Debug)]
pub struct Coast {
    settings: CoastSettings,
    rules: Rules,
    /// What the force is multiplied with.
    pressure: f64,
    /// Whether that has changed since the last iteration, or more than one iteration has: then
    /// every coast node may fall.
    pressed: bool,
    shore: Shore,
    marks: Marks,
    local: Local,
    disc: WeakeningDisc,
    touched: Vec<u32>,
    is_touched: Vec<bool>,
    events: Events,
}

/// How the perimeter at a place is found.
#[derive(Clone, Debug)]
enum Local {
    Whole,
    Near(DiscSums),
    Contiguous(Box<Arcs>),
}

/// The coast nodes, in an order that depends on history, and their strengths.
#[derive(Clone, Debug)]
struct Marks {
    nodes: Vec<u32>,
    strengths: Vec<f64>,
    /// Place of each node among the nodes of the coast.
    slots: Vec<u32>,
}

/// The slot of a node that does not belong to the coast.
const NO_SLOT: u32 = u32::MAX;

impl Marks {
    fn contains(&self, node: usize) -> bool {
        self.slots[node] != NO_SLOT
    }

    /// Sets the strength of a node, which joins the coast when it was not there: `true` then.
    fn set(&mut self, node: usize, strength: f64) -> bool {
        if self.contains(node) {
            self.strengths[self.slots[node] as usize] = strength;
            return false;
        }
        self.slots[node] = self.nodes.len() as u32;
        self.nodes.push(node as u32);
        self.strengths.push(strength);
        true
    }

    fn remove(&mut self, node: usize) {
        let slot = std::mem::replace(&mut self.slots[node], NO_SLOT) as usize;
        self.nodes.swap_remove(slot);
        self.strengths.swap_remove(slot);
        if let Some(&moved) = self.nodes.get(slot) {
            self.slots[moved as usize] = slot as u32;
        }
    }
}

impl Coast {
    /// The coast of `land`, whose values are zero at sea and others on land; `resistance` has
    /// one number a node.
    ///
    /// # Errors
    /// See [`CoastSettings::validate`]; [`CoastError::Length`].
    pub fn new(
        lattice: &Lattice,
        settings: CoastSettings,
        land: &[u8],
        resistance: &[f64],
    ) -> Result<Self, CoastError> {
        settings.validate(lattice)?;
        let nodes = lattice.node_count();
        check_length("land", land.len(), nodes)?;
        check_length("resistance", resistance.len(), nodes)?;
        let spacing = lattice.spacing();
        let local = match settings.perimeter {
            Perimeter::Whole => Local::Whole,
            Perimeter::Near { radius_m } => Local::Near(DiscSums::new(lattice, radius_m / spacing)),
            Perimeter::Contiguous { radius_m } => {
                Local::Contiguous(Box::new(Arcs::new(lattice, radius_m / spacing)))
            }
        };
        let mut coast = Self {
            rules: Rules::new(lattice, &settings),
            pressure: 1.0,
            pressed: false,
            shore: Shore::new(lattice, land),
            marks: Marks { nodes: Vec::new(), strengths: Vec::new(), slots: vec![NO_SLOT; nodes] },
            local,
            disc: WeakeningDisc::new(lattice, settings.wear.as_ref()),
            touched: Vec::new(),
            is_touched: vec![false; nodes],
            events: Events::default(),
            settings,
        };
        coast.mark_all(land, resistance);
        Ok(coast)
    }

    /// Refuses a coast without a node, on which nothing can happen.
    ///
    /// # Errors
    /// [`CoastError::NoCoast`].
    pub fn require_coast(&self, land: &[u8]) -> Result<(), CoastError> {
        if !self.marks.nodes.is_empty() {
            return Ok(());
        }
        let count = land.iter().filter(|&&land| land > 0).count();
        Err(CoastError::NoCoast { land: count, nodes: land.len() })
    }

    fn mark_all(&mut self, land: &[u8], resistance: &[f64]) {
        for node in (0..land.len()).filter(|&node| land[node] > 0) {
            let exposure = self.shore.exposure(node);
            if exposure.0 > 0 {
                let strength = self.settings.weakening.strength(resistance[node], exposure);
                self.marks.set(node, strength);
                if let Local::Near(sums) = &mut self.local {
                    sums.add(self.shore.place(node), i32::from(self.shore.length(node)));
                }
            }
        }
        self.refresh();
    }

    /// The shore.
    pub fn shore(&self) -> &Shore {
        &self.shore
    }

    /// Whether a node belongs to the coast.
    pub fn is_coast(&self, node: usize) -> bool {
        self.marks.contains(node)
    }

    /// The nodes of the coast in node order.
    pub fn nodes(&self) -> Vec<usize> {
        let mut nodes: Vec<usize> = self.marks.nodes.iter().map(|&node| node as usize).collect();
        nodes.sort_unstable();
        nodes
    }

    /// Strength of a coast node: what exposure leaves of its resistance.
    pub fn strength(&self, node: usize) -> Option<f64> {
        self.is_coast(node).then(|| self.marks.strengths[self.marks.slots[node] as usize])
    }

    /// The perimeter that weakens the sea at a coast node, as a multiple of its measure:
    /// `initial`, the whole shore at the beginning in parts, or a straight coast across the disc.
    #[inline]
    fn perimeter(&self, node: usize, initial: u64) -> f64 {
        let across = |parts: u64| {
            let radius_m = self.settings.perimeter.radius_m().unwrap_or(1.0);
            spacings(parts) * self.shore.lattice().spacing() / (2.0 * radius_m)
        };
        match &self.local {
            Local::Whole => self.shore.total() as f64 / initial as f64,
            Local::Near(sums) => across(u64::from(sums.sum(node))),
            Local::Contiguous(arcs) => across(arcs.length(&self.shore, node)),
        }
    }

    /// Force of the sea at a coast node; `initial` is the shore at the beginning in parts
    /// ([`Shore::total`]), which only a force by the whole perimeter depends on.
    pub fn force(&self, node: usize, initial: u64) -> f64 {
        self.pressure * self.rules.of(node).force_at(self.perimeter(node, initial))
    }

    /// Multiplies the force of the sea that the settings say, everywhere and from now on: to move
    /// a coast that is stuck (thesis, listing 4.1). 1 at the beginning.
    pub fn press(&mut self, pressure: f64) {
        self.pressed |= pressure != self.pressure;
        self.pressure = pressure;
    }

    /// One iteration; `land` and `resistance` are those of [`Coast::new`], as earlier iterations
    /// left them, and `initial` as for [`Coast::force`].
    ///
    /// # Errors
    /// [`CoastError::Length`].
    pub fn step(
        &mut self,
        land: &mut [u8],
        resistance: &mut [f64],
        initial: u64,
    ) -> Result<&Events, CoastError> {
        let nodes = self.shore.lattice().node_count();
        check_length("land", land.len(), nodes)?;
        check_length("resistance", resistance.len(), nodes)?;
        self.events.eroded.clear();
        match self.settings.wear {
            None => self.find_weak(initial),
            Some(wear) => self.wear_down(resistance, wear.rate, initial),
        }
        self.pressed = false;
        Ok(self.give_way(land, resistance))
    }

    /// Lets coast nodes fall that the sea would leave standing (thesis, listing 4.1); others among
    /// `nodes` are passed over. `land` and `resistance` are as for [`Coast::step`].
    ///
    /// # Errors
    /// [`CoastError::Length`].
    pub fn fell(
        &mut self,
        nodes: &[u32],
        land: &mut [u8],
        resistance: &mut [f64],
    ) -> Result<&Events, CoastError> {
        let count = self.shore.lattice().node_count();
        check_length("land", land.len(), count)?;
        check_length("resistance", resistance.len(), count)?;
        self.events.eroded.clear();
        let standing = |node: &u32| (*node as usize) < count && self.marks.contains(*node as usize);
        self.events.eroded.extend(nodes.iter().copied().filter(standing));
        // What an iteration changed just before is forgotten by the next change.
        self.pressed = true;
        Ok(self.give_way(land, resistance))
    }

    /// The nodes that were found fall, and all that follows from it.
    fn give_way(&mut self, land: &mut [u8], resistance: &mut [f64]) -> &Events {
        self.events.exposed.clear();
        self.events.measured.clear();
        self.events.eroded.sort_unstable();
        self.events.eroded.dedup();
        self.erode(land, resistance);
        self.follow(land, resistance);
        self.refresh();
        &self.events
    }

    /// Finds the coast nodes whose strength is below the force.
    fn find_weak(&mut self, initial: u64) {
        if let Local::Whole = self.local {
            let perimeter = self.shore.total() as f64 / initial as f64;
            let forces: Vec<f64> = self
                .rules
                .all()
                .iter()
                .map(|rule| self.pressure * rule.force_at(perimeter))
                .collect();
            for (&node, &strength) in self.marks.nodes.iter().zip(&self.marks.strengths) {
                if strength < forces[self.rules.number(node as usize)] {
                    self.events.eroded.push(node);
                }
            }
            return;
        }
        for (&node, &strength) in self.marks.nodes.iter().zip(&self.marks.strengths) {
            let rule = self.rules.of(node as usize);
            // No perimeter can raise the force above this.
            if strength < self.pressure * rule.force
                && (self.pressed || self.may_differ(node as usize))
                && strength < self.force(node as usize, initial)
            {
                self.events.eroded.push(node);
            }
        }
    }

    /// Whether a coast node may fall that withstood the sea in the iteration before.
    fn may_differ(&self, node: usize) -> bool {
        match &self.local {
            Local::Contiguous(arcs) => arcs.may_differ(self.shore.place(node)),
            _ => true,
        }
    }

    /// Finds the coast nodes whose strength is below the force, and wears the others.
    fn wear_down(&mut self, resistance: &mut [f64], rate: f64, initial: u64) {
        for slot in 0..self.marks.nodes.len() {
            let node = self.marks.nodes[slot] as usize;
            let force = self.force(node, initial);
            if self.marks.strengths[slot] < force {
                self.events.eroded.push(node as u32);
            } else {
                resistance[node] = (resistance[node] - rate * force).max(0.0);
                self.marks.strengths[slot] =
                    self.settings.weakening.strength(resistance[node], self.shore.exposure(node));
            }
        }
    }

    /// Gives the nodes that fall to the sea.
    fn erode(&mut self, land: &mut [u8], resistance: &mut [f64]) {
        let Self { shore, marks, events, touched, is_touched, rules, disc, .. } = self;
        let mut touch = |node: usize| {
            if !std::mem::replace(&mut is_touched[node], true) {
                touched.push(node as u32);
            }
        };
        for &node in &events.eroded {
            let node = node as usize;
            land[node] = 0;
            resistance[node] = 0.0;
            marks.remove(node);
            touch(node);
            shore.surround(node, &mut touch);
        }
        if disc.is_empty() {
            return;
        }
        for &node in &events.eroded {
            let node = node as usize;
            disc.each(shore.lattice(), shore.place(node), |other, falloff| {
                if land[other] > 0 {
                    let left = resistance[other] - rules.of(node).weakening * falloff;
                    resistance[other] = left.max(0.0);
                    if marks.contains(other) {
                        touch(other);
                    }
                }
            });
        }
    }

    /// Brings marks, lengths and strengths up to date around what happened.
    fn follow(&mut self, land: &[u8], resistance: &[f64]) {
        let mut touched = std::mem::take(&mut self.touched);
        if let Local::Contiguous(arcs) = &mut self.local {
            arcs.forget_changes();
            touched.iter().for_each(|&node| arcs.change(self.shore.place(node as usize)));
        }
        for node in touched.drain(..) {
            let node = node as usize;
            self.is_touched[node] = false;
            let is_land = land[node] > 0;
            let change = self.shore.measure(node, is_land);
            if let (Local::Near(sums), true) = (&mut self.local, change != 0) {
                sums.add(self.shore.place(node), change);
            }
            if !is_land {
                continue;
            }
            let exposure = self.shore.exposure(node);
            if exposure.0 > 0 {
                let strength = self.settings.weakening.strength(resistance[node], exposure);
                let is_new = self.marks.set(node, strength);
                if is_new {
                    self.events.exposed.push(node as u32);
                }
                if is_new || change != 0 {
                    self.events.measured.push(node as u32);
                }
            }
        }
        self.touched = touched;
    }

    /// Makes local perimeters follow the shore.
    fn refresh(&mut self) {
        match &mut self.local {
            Local::Whole => {}
            Local::Near(sums) => sums.refresh(),
            Local::Contiguous(arcs) => arcs.refresh(&self.shore, &self.marks.nodes),
        }
    }
}
