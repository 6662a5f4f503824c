//! The agents of a run as a picture of the graph.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_sim::agent::GroupUse;
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::output::{Moment, Output, OutputFile, Sink, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::MOST_PIXELS;
use landform_view::graph::{GraphNode, graph_picture};
use landform_view::montage::{MontageOptions, Panel, Row, panels};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::look::{picture_text, problem, write_picture};
use super::map_place::check_plane;

/// The graph with its agents, before the first iteration and at the end of each stage, side by
/// side (thesis, figure 4.9): a disc a node in the colour of the group that stands there, and a
/// ring round the nodes that are not the same in all panels. For small lattices.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AgentMap {
    /// File name below the output folder.
    pub file: PathBuf,
    /// The groups that are drawn. Where several stand, the first of them shows.
    #[schemars(length(min = 1))]
    pub groups: Vec<DrawnGroup>,
    /// Red, green and blue of nodes without an agent of these groups.
    pub elsewhere: [u8; 3],
    /// Another colour for those where a field is low: the sea, say.
    pub low: Option<LowNodes>,
    /// Whether the state before the first iteration is drawn; agents that a process puts out
    /// when it begins are not there yet.
    pub initial_state: bool,
    /// Texts below the panels, in order; stage names where they are missing.
    pub captions: Vec<String>,
    /// Pixels between two nodes.
    #[schemars(range(min = 4.0, max = 400.0), extend("x-unit" = "pixels"))]
    pub pixels_per_node: f64,
}

/// A group of agents as it is drawn.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DrawnGroup {
    /// Name of the group.
    pub group: String,
    /// Red, green and blue.
    pub colour: [u8; 3],
    /// Whether discs are filled.
    pub filled: bool,
}

/// Nodes where a field is below a level.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LowNodes {
    /// Name of the field.
    pub field: String,
    /// The level, in the unit of the field.
    pub level: f64,
    /// Red, green and blue.
    pub colour: [u8; 3],
}

impl Default for LowNodes {
    fn default() -> Self {
        Self { field: "land".to_owned(), level: 0.5, colour: [60, 110, 200] }
    }
}

impl Default for DrawnGroup {
    fn default() -> Self {
        Self { group: String::new(), colour: [0, 90, 181], filled: true }
    }
}

impl Default for AgentMap {
    fn default() -> Self {
        Self {
            file: "agents.png".into(),
            groups: Vec::new(),
            elsewhere: [90, 160, 70],
            low: None,
            initial_state: true,
            captions: Vec::new(),
            pixels_per_node: 48.0,
        }
    }
}

impl Output for AgentMap {
    const NAME: &'static str = "AgentMap";

    fn groups(&self) -> Vec<GroupUse> {
        let used = |drawn: &DrawnGroup| GroupUse { group: drawn.group.clone(), quantity: None };
        self.groups.iter().map(used).collect()
    }

    fn fields(&self) -> Vec<String> {
        self.low.iter().map(|low| low.field.clone()).collect()
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["png"])?;
        if self.groups.len() > MOST_GROUPS {
            let message = format!("{} groups are named", self.groups.len());
            return Err(Problem::new("groups", message, format!("at most {MOST_GROUPS}")));
        }
        check_plane(lattice)?;
        let pixels = lattice.node_count() as f64 * self.pixels_per_node.powi(2);
        if !(1.0..=0.25 * MOST_PIXELS as f64).contains(&pixels) {
            let message = format!("each panel would have {pixels:.0} pixels");
            let expected = format!("at most {}", MOST_PIXELS / 4);
            return Err(Problem::new("pixels_per_node", message, expected)
                .help("choose fewer pixels a node; large maps of agents are an `AgentTable`"));
        }
        Ok(())
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(MapSink { settings: self.clone(), states: Vec::new() })
    }
}

/// Groups that can be told apart.
const MOST_GROUPS: usize = 100;

/// What shows at nodes without an agent, and at those of them where the field is low. Groups are
/// numbered from 2.
const ELSEWHERE: u8 = 0;
const LOW: u8 = 1;

/// A state of the run: its name, and the number of what shows at each node.
type State = (String, Vec<u8>);

/// The states seen so far; what changes is known at the end.
struct MapSink {
    settings: AgentMap,
    states: Vec<State>,
}

impl Sink for MapSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        let name = match moment {
            Moment::Start if !self.settings.initial_state => return Ok(Vec::new()),
            Moment::Start => "initial",
            Moment::StageEnd => snapshot.stage_name(),
            Moment::Iteration => return Ok(Vec::new()),
            Moment::End => return self.draw(snapshot, folder),
        };
        self.states.push((name.to_owned(), self.settings.shown(snapshot)?));
        Ok(Vec::new())
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        let names: Vec<&String> = self.states.iter().map(|(name, _)| name).collect();
        to.value("names", &names);
        for (index, (_, shown)) in self.states.iter().enumerate() {
            to.array(&index.to_string(), shown);
        }
        Ok(())
    }

    fn restore(
        &mut self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        _: &Path,
    ) -> Result<(), Damage> {
        let names: Vec<String> = from.value("names")?;
        let nodes = snapshot.lattice().node_count();
        let state = |(index, name): (usize, String)| {
            Ok((name, from.array_of(&index.to_string(), nodes)?.to_vec()))
        };
        self.states = names.into_iter().enumerate().map(state).collect::<Result<_, Damage>>()?;
        Ok(())
    }
}

impl AgentMap {
    /// The number of what shows at each node.
    fn shown(&self, snapshot: &Snapshot<'_>) -> Result<Vec<u8>, Problem> {
        let mut shown = vec![ELSEWHERE; snapshot.lattice().node_count()];
        if let Some(low) = &self.low {
            let (values, _) = field_file::values(snapshot, &low.field)?;
            let marked = shown.iter_mut().zip(values);
            marked.for_each(|(shown, value)| *shown = if value < low.level { LOW } else { *shown });
        }
        for (index, drawn) in self.groups.iter().enumerate().rev() {
            let group = snapshot.group(&drawn.group);
            let group = group
                .map_err(|error| Problem::new("groups", error.to_string(), "a group of the run"))?;
            let number = LOW + 1 + index as u8;
            group.members().iter().for_each(|member| shown[member.node] = number);
        }
        Ok(shown)
    }

    /// Colour of what shows, and whether discs are filled with it.
    fn paint(&self, shown: u8) -> ([u8; 3], bool) {
        let group = usize::from(shown).checked_sub(usize::from(LOW) + 1);
        match (group.and_then(|at| self.groups.get(at)), &self.low) {
            (Some(drawn), _) => (drawn.colour, drawn.filled),
            (None, Some(low)) if shown == LOW => (low.colour, true),
            _ => (self.elsewhere, true),
        }
    }
}

impl MapSink {
    fn draw(&self, snapshot: &Snapshot<'_>, folder: &Path) -> Result<Vec<OutputFile>, Problem> {
        let lattice = snapshot.lattice();
        let edges = edges(lattice);
        let changes = |node: usize| {
            self.states.windows(2).any(|states| states[0].1[node] != states[1].1[node])
        };
        let ringed: Vec<bool> = (0..lattice.node_count()).map(changes).collect();
        let panel = |(index, (name, shown)): (usize, &State)| {
            let nodes: Vec<GraphNode> = (0..lattice.node_count())
                .map(|node| self.node(lattice, node, shown[node], ringed[node]))
                .collect();
            let image = graph_picture(&nodes, &edges, self.settings.pixels_per_node);
            let caption = self.settings.captions.get(index).unwrap_or(name).clone();
            image.map(|image| Panel { image, caption }).map_err(|error| problem(&error))
        };
        let drawn = self.states.iter().enumerate().map(panel).collect::<Result<_, _>>()?;
        let rows = [Row { heading: String::new(), panels: drawn }];
        let figure = panels(&rows, &MontageOptions::default()).map_err(|error| problem(&error))?;
        let path = below(folder, &self.settings.file)?;
        write_picture(&figure, &path, &picture_text(snapshot, "agents"))?;
        Ok(vec![OutputFile { file: self.settings.file.clone(), kind: "picture".to_owned() }])
    }

    fn node(&self, lattice: &Lattice, node: usize, shown: u8, ringed: bool) -> GraphNode {
        let [column, row, _] = lattice.coordinates(node);
        let (colour, filled) = self.settings.paint(shown);
        GraphNode { place: [column as f64, row as f64], colour, filled, ringed }
    }
}

/// The edges of a lattice but for those that go round a periodic axis.
fn edges(lattice: &Lattice) -> Vec<[usize; 2]> {
    let near = |node: usize, other: usize| {
        let [here, there] = [node, other].map(|node| lattice.coordinates(node));
        (0..2).all(|axis| here[axis].abs_diff(there[axis]) <= 1)
    };
    let of = |node: usize| {
        let later = lattice.neighbours(node).map(|edge| edge.node).filter(move |&to| to > node);
        later.filter(move |&to| near(node, to)).map(move |to| [node, to])
    };
    (0..lattice.node_count()).flat_map(of).collect()
}
