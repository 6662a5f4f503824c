//! The engine: what one iteration does to a coast.

use landform_graph::Lattice;

use super::error::check_length;
use super::marks::Marks;
use super::sea::Sea;
use super::watch::Watch;
use super::wear::WeakeningDisc;
use super::{CoastError, CoastSettings, Shore};

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
/// Memory: 8 bytes a node, 4 more for a perimeter within a radius, 2 bits for a contiguous one;
/// and 40 bytes a coast node, some 90 for a contiguous perimeter.
///
/// Cost of an iteration: in proportion to the nodes that fall, and to the coast nodes within the
/// radius around them; with wear, to all coast nodes.
#[derive(Clone, Debug)]
pub struct Coast {
    settings: CoastSettings,
    sea: Sea,
    shore: Shore,
    marks: Marks,
    watch: Watch,
    disc: WeakeningDisc,
    touched: Vec<u32>,
    events: Events,
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
        let sea = Sea::new(lattice, &settings);
        let mut coast = Self {
            shore: Shore::new(lattice, land),
            marks: Marks::new(nodes),
            watch: Watch::new(lattice, settings.perimeter, &sea),
            sea,
            disc: WeakeningDisc::new(lattice, settings.wear.as_ref()),
            touched: Vec::new(),
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
                self.mark(node, resistance[node], exposure);
                let length = i32::from(self.shore.length(node));
                self.watch.touched(node, self.shore.place(node), length);
            }
        }
        self.watch.refresh(&self.shore, &mut self.marks);
    }

    /// Gives a node of the coast the strength of its exposure: `true` when it is new there.
    fn mark(&mut self, node: usize, resistance: f64, exposure: (u32, u32)) -> bool {
        let strength = self.settings.weakening.strength(resistance, exposure);
        let is_new = self.marks.set(node, resistance, strength);
        // Rock that wears changes everywhere: there is nothing to watch.
        if self.settings.wear.is_none() {
            self.watch.strength(&self.sea, &self.shore, &mut self.marks, node);
        }
        is_new
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
        self.marks.slot(node).map(|slot| self.marks.strengths[slot])
    }

    /// Force of the sea at a coast node; `initial` is the shore at the beginning in parts
    /// ([`Shore::total`]), which only a force by the whole perimeter depends on.
    pub fn force(&self, node: usize, initial: u64) -> f64 {
        let Self { watch, sea, shore, marks, .. } = self;
        sea.force(node, watch.perimeter(sea, shore, marks, node, initial))
    }

    /// Multiplies the force of the sea that the settings say, everywhere and from now on: to move
    /// a coast that is stuck (thesis, listing 4.1). 1 at the beginning.
    pub fn press(&mut self, pressure: f64) {
        let before = std::mem::replace(&mut self.sea.pressure, pressure);
        if before != pressure && self.settings.wear.is_none() {
            self.watch.pressure(&self.sea, &self.shore, &mut self.marks);
        }
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
            None => {
                let Self { watch, sea, shore, marks, events, .. } = self;
                watch.take_weak(sea, shore, marks, initial, &mut events.eroded);
            }
            Some(wear) => self.wear_down(resistance, wear.rate, initial),
        }
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
        Ok(self.give_way(land, resistance))
    }

    /// The nodes that were found fall, and all that follows from it.
    fn give_way(&mut self, land: &mut [u8], resistance: &mut [f64]) -> &Events {
        self.events.exposed.clear();
        self.events.measured.clear();
        self.events.eroded.sort_unstable();
        self.events.eroded.dedup();
        self.erode(land, resistance);
        self.follow(resistance);
        self.watch.refresh(&self.shore, &mut self.marks);
        &self.events
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
        let Self { shore, marks, watch, sea, events, touched, disc, .. } = self;
        for &node in &events.eroded {
            let node = node as usize;
            land[node] = 0;
            resistance[node] = 0.0;
            let (limit, places) = marks.remove(node);
            watch.fallen(node, shore.place(node), shore.drown(node), limit, places);
        }
        for &node in &events.eroded {
            shore.surround(node as usize, |other| touched.push(other as u32));
        }
        if disc.is_empty() {
            return;
        }
        let lattice = shore.lattice().clone();
        for &node in &events.eroded {
            let node = node as usize;
            disc.each(&lattice, shore.place(node), |other, falloff| {
                if land[other] > 0 {
                    let left = resistance[other] - sea.rules.of(node).weakening * falloff;
                    resistance[other] = left.max(0.0);
                    if marks.contains(other) && shore.touch(other) {
                        touched.push(other as u32);
                    }
                }
            });
        }
    }

    /// Brings marks, lengths and strengths up to date around what happened.
    fn follow(&mut self, resistance: &[f64]) {
        let mut touched = std::mem::take(&mut self.touched);
        for node in touched.drain(..) {
            let node = node as usize;
            let at = self.shore.place(node);
            let change = self.shore.measure(node, at);
            self.watch.touched(node, at, change);
            let exposure = self.shore.exposure_at(node, at);
            if exposure.0 > 0 {
                // Rock that does not wear is as the coast found it.
                let slot = self.marks.slot(node).filter(|_| self.settings.wear.is_none());
                let u = slot.map_or_else(|| resistance[node], |slot| self.marks.resistances[slot]);
                let is_new = self.mark(node, u, exposure);
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
}
