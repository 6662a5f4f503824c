//! One figure of chosen panels: this field of that state, drawn so.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::output::{Moment, Output, OutputFile, Sink, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::montage::{MontageOptions, Panel, Row, panels};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::look::{Curve, Look, Subject, picture_text, problem, write_picture};

/// Name of the state before the first iteration.
const INITIAL: &str = "initial";

/// One figure of chosen panels, each a field of a state of the run. [`super::Panels`] draws the same of every
/// state.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Figure {
    /// File name below the output folder.
    pub file: PathBuf,
    /// The panels, row by row.
    #[schemars(length(min = 1))]
    pub panels: Vec<FigurePanel>,
    /// Panels in a row; all in one row when 0.
    #[schemars(range(max = 64))]
    pub columns: usize,
    /// Whether panels of one field share its range of colours, from the lowest to the highest
    /// value of all states that are drawn.
    pub same_colours: bool,
}

impl Default for Figure {
    fn default() -> Self {
        let panels = vec![FigurePanel::default()];
        Self { file: "figure.png".into(), panels, columns: 0, same_colours: true }
    }
}

/// A panel of a [`Figure`].
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FigurePanel {
    /// The state that it shows: the name of a stage, as it ended, or `initial`.
    pub at: String,
    /// Iterations of that stage after which it is shown; its end when missing, or when it ends sooner.
    #[schemars(range(min = 1))]
    pub after: Option<u64>,
    /// For the look `Hypsometry`: a state whose curve is drawn too, thinner than that of `at`.
    pub since: Option<String>,
    /// Name of the field.
    pub field: String,
    /// How it is drawn.
    pub look: Look,
    /// Text below it; the name of the state when empty. Below a spectrum or a hypsometric curve
    /// its numbers follow.
    pub caption: String,
}

impl Default for FigurePanel {
    fn default() -> Self {
        Self {
            at: INITIAL.to_owned(),
            after: None,
            since: None,
            field: "surface".to_owned(),
            look: Look::default(),
            caption: String::new(),
        }
    }
}

impl FigurePanel {
    /// The states that it shows, with the iterations of their stage: `at`, and `since` if there is
    /// one.
    fn states(&self) -> impl Iterator<Item = State<'_>> {
        let since = self.since.as_deref().map(|name| (name, None));
        [Some((self.at.as_str(), self.after)), since].into_iter().flatten()
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if self.since.is_some() && !matches!(self.look, Look::Hypsometry(_)) {
            let message = "a look that shows one state is given two";
            return Err(Problem::new("since", message, "nothing, or the look Hypsometry"));
        }
        if self.after.is_some() && self.at == INITIAL {
            let message = "there are iterations after the state before the first one";
            return Err(Problem::new("after", message, "nothing, or a stage as `at`"));
        }
        self.look.validate(lattice)
    }
}

/// A state of the run: its name, and the iterations of its stage if it is not the end.
type State<'a> = (&'a str, Option<u64>);

impl Output for Figure {
    const NAME: &'static str = "Figure";

    fn fields(&self) -> Vec<String> {
        self.panels.iter().flat_map(|panel| panel.look.fields(&panel.field)).collect()
    }

    fn stages(&self) -> Vec<String> {
        let states = self.panels.iter().flat_map(FigurePanel::states);
        states.filter(|(name, _)| *name != INITIAL).map(|(name, _)| name.to_owned()).collect()
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["png"])?;
        for (index, panel) in self.panels.iter().enumerate() {
            panel.validate(lattice).map_err(|problem| {
                let parameter = format!("panels[{index}].{}", problem.parameter);
                Problem { parameter, ..problem }
            })?;
        }
        Ok(())
    }

    fn open(&self) -> Box<dyn Sink> {
        let seen = vec![[None, None]; self.panels.len()];
        Box::new(FigureSink { settings: self.clone(), seen })
    }
}

/// What each panel shows, as far as it was seen: the state `at`, the state `since`.
struct FigureSink {
    settings: Figure,
    seen: Vec<[Option<Subject>; 2]>,
}

impl Sink for FigureSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        match moment {
            Moment::Start => self.look_at((INITIAL, None), snapshot)?,
            Moment::StageEnd => self.look_at((snapshot.stage_name(), None), snapshot)?,
            Moment::Iteration => {
                let done = snapshot.clock().iteration;
                self.look_at((snapshot.stage_name(), Some(done)), snapshot)?;
            }
            Moment::End => return self.draw(snapshot, folder),
        }
        Ok(Vec::new())
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        let places = |panel: usize| [0, 1].map(|state| (panel, state));
        let places = (0..self.seen.len()).flat_map(places);
        let seen: Vec<(usize, usize)> =
            places.filter(|&(panel, state)| self.seen[panel][state].is_some()).collect();
        to.value("seen", &seen);
        for (panel, states) in self.seen.iter().enumerate() {
            for (state, subject) in states.iter().enumerate() {
                if let Some(subject) = subject {
                    subject.save(&array_name(panel, state), to);
                }
            }
        }
        Ok(())
    }

    fn restore(
        &mut self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        _: &Path,
    ) -> Result<(), Damage> {
        let seen: Vec<(usize, usize)> = from.value("seen")?;
        for (index, state) in seen {
            let places = self.seen.get_mut(index).and_then(|states| states.get_mut(state));
            let (Some(place), Some(panel)) = (places, self.settings.panels.get(index)) else {
                continue;
            };
            let name = array_name(index, state);
            *place = Some(Subject::restore(&name, from, snapshot, &panel.field, &panel.look)?);
        }
        Ok(())
    }
}

/// Name of the values of a panel in checkpoints.
fn array_name(panel: usize, state: usize) -> String {
    format!("{panel}-{state}")
}

impl FigureSink {
    /// Keeps what the panels show of a state. At the end of a stage, panels that wait for a later
    /// iteration of it get that.
    fn look_at(&mut self, state: State<'_>, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        for (panel, seen) in self.settings.panels.iter().zip(&mut self.seen) {
            for (wanted, seen) in panel.states().zip(seen) {
                let ended_sooner = wanted.0 == state.0 && state.1.is_none() && seen.is_none();
                if wanted == state || ended_sooner {
                    *seen = Some(Subject::of(snapshot, &panel.field, &panel.look)?);
                }
            }
        }
        Ok(())
    }

    fn draw(&self, snapshot: &Snapshot<'_>, folder: &Path) -> Result<Vec<OutputFile>, Problem> {
        let settings = &self.settings;
        let drawn = (0..settings.panels.len()).map(|index| self.panel(snapshot.lattice(), index));
        let drawn: Vec<Panel> = drawn.collect::<Result<_, _>>()?;
        let columns = if settings.columns == 0 { drawn.len() } else { settings.columns };
        let rows: Vec<Row> = drawn
            .chunks(columns.max(1))
            .map(|row| Row { heading: String::new(), panels: row.to_vec() })
            .collect();
        let figure = panels(&rows, &MontageOptions::default()).map_err(|error| problem(&error))?;
        let path = below(folder, &settings.file)?;
        let field = settings.panels.first().map_or("", |panel| panel.field.as_str());
        write_picture(&figure, &path, &picture_text(snapshot, field))?;
        Ok(vec![OutputFile { file: settings.file.clone(), kind: "picture".to_owned() }])
    }

    /// A panel with its caption.
    fn panel(&self, lattice: &Lattice, index: usize) -> Result<Panel, Problem> {
        let panel = &self.settings.panels[index];
        let [Some(now), before] = &self.seen[index] else {
            let after =
                panel.after.map_or_else(String::new, |count| format!(" after {count} iterations"));
            let message = format!("the run did not come to `{}`{after}", panel.at);
            return Err(Problem::new("panels", message, "a stage of the run, or `initial`"));
        };
        let (image, numbers) = match (&panel.look, &panel.since, before) {
            (Look::Hypsometry(curve), Some(since), Some(before)) => {
                let states = [(since.as_str(), &before.values), (panel.at.as_str(), &now.values)];
                let states = states.map(|(name, values)| (name, values.as_slice()));
                (curve.draw_change(states), Curve::numbers_of_change(states.map(|state| state.1)))
            }
            _ => {
                let look = self.coloured(panel);
                (look.draw(lattice, now), look.numbers(lattice, &now.values))
            }
        };
        let caption = if panel.caption.is_empty() { &panel.at } else { &panel.caption };
        let numbers = numbers.map_or_else(String::new, |numbers| format!(": {numbers}"));
        let image = image.map_err(|error| problem(&error))?;
        Ok(Panel { image, caption: format!("{caption}{numbers}") })
    }

    /// The look of a panel with the range of its field over all panels, unless it has one or
    /// panels keep their own.
    fn coloured(&self, panel: &FigurePanel) -> Look {
        if !self.settings.same_colours || panel.look.range().is_some() {
            return panel.look.clone();
        }
        let same = |(other, _): &(&FigurePanel, _)| other.field == panel.field;
        let seen = self.settings.panels.iter().zip(&self.seen).filter(same);
        let ranges = seen.flat_map(|(_, states)| states).flatten();
        let ranges = ranges.map(|subject| landform_view::flat::finite_range(&subject.values));
        let whole = ranges.reduce(|[low, high], next| [low.min(next[0]), high.max(next[1])]);
        let whole = whole.map(|[low, high]| (low, high));
        whole.map_or_else(|| panel.look.clone(), |range| panel.look.clone().with_range(range))
    }
}
