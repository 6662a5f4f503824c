//! Panels side by side: a field at the start and at the end of each stage, as in a figure.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::output::{Moment, Output, OutputFile, Sink, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::montage::{MontageOptions, Panel, Row, panels};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::look::{Look, Subject, picture_text, problem, write_picture};

/// One figure of panels side by side: a field before the first iteration and at the end of each
/// stage, all in the same colours.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Panels {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// How it is drawn: a panel a look for each state.
    #[schemars(length(min = 1))]
    pub looks: Vec<Look>,
    /// Names of the fields that the looks draw, in their order; `field` where they are missing.
    pub fields: Vec<String>,
    /// Whether the state before the first iteration is drawn.
    pub initial_state: bool,
    /// Texts below the panels, in order; stage names where they are missing. Below a spectrum
    /// or a hypsometric curve its numbers follow.
    pub captions: Vec<String>,
    /// Whether all panels share the range of colours of the last one.
    pub same_colours: bool,
}

impl Default for Panels {
    fn default() -> Self {
        Self {
            file: "panels.png".into(),
            field: "surface".to_owned(),
            looks: vec![Look::default()],
            fields: Vec::new(),
            initial_state: true,
            captions: Vec::new(),
            same_colours: true,
        }
    }
}

impl Output for Panels {
    const NAME: &'static str = "Panels";

    fn fields(&self) -> Vec<String> {
        let of = |(index, look): (usize, &Look)| look.fields(self.field_of(index));
        self.looks.iter().enumerate().flat_map(of).collect()
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["png"])?;
        if self.fields.len() > self.looks.len() {
            let message = format!("{} fields for {} looks", self.fields.len(), self.looks.len());
            return Err(Problem::new("fields", message, "at most one a look"));
        }
        self.looks.iter().try_for_each(|look| look.validate(lattice))
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(PanelSink { settings: self.clone(), states: Vec::new() })
    }
}

impl Panels {
    /// Name of the field that a look draws.
    fn field_of(&self, look: usize) -> &str {
        self.fields.get(look).unwrap_or(&self.field)
    }
}

/// A state of the run: its name and what each look draws of it.
type State = (String, Vec<Subject>);

/// The states seen so far; they are drawn together because they may share colours.
struct PanelSink {
    settings: Panels,
    states: Vec<State>,
}

impl Sink for PanelSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        match moment {
            Moment::Start if !self.settings.initial_state => Ok(Vec::new()),
            Moment::Start | Moment::StageEnd => {
                let looks = 0..self.settings.looks.len();
                let subjects = looks.map(|look| {
                    let field = self.settings.field_of(look);
                    Subject::of(snapshot, field, &self.settings.looks[look])
                });
                let name = match moment {
                    Moment::Start => "initial",
                    _ => snapshot.stage_name(),
                };
                self.states.push((name.to_owned(), subjects.collect::<Result<_, _>>()?));
                Ok(Vec::new())
            }
            Moment::Iteration => Ok(Vec::new()),
            Moment::End => self.draw(snapshot, folder),
        }
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        let names: Vec<&String> = self.states.iter().map(|(name, _)| name).collect();
        to.value("names", &names);
        for (index, (_, looks)) in self.states.iter().enumerate() {
            for (look, subject) in looks.iter().enumerate() {
                subject.save(&array_name(index, look), to);
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
        let names: Vec<String> = from.value("names")?;
        let state = |(index, name): (usize, String)| {
            let looks = 0..self.settings.looks.len();
            let subjects = looks.map(|look| self.stored(from, snapshot, [index, look]));
            Ok((name, subjects.collect::<Result<_, Damage>>()?))
        };
        self.states = names.into_iter().enumerate().map(state).collect::<Result<_, _>>()?;
        Ok(())
    }
}

/// Name of the values of a state and a look in checkpoints.
fn array_name(state: usize, look: usize) -> String {
    format!("{state}-{look}")
}

impl PanelSink {
    /// What a look draws of a state, from a checkpoint.
    fn stored(
        &self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        [state, look]: [usize; 2],
    ) -> Result<Subject, Damage> {
        let field = self.settings.field_of(look);
        let name = array_name(state, look);
        Subject::restore(&name, from, snapshot, field, &self.settings.looks[look])
    }

    fn draw(&self, snapshot: &Snapshot<'_>, folder: &Path) -> Result<Vec<OutputFile>, Problem> {
        let settings = &self.settings;
        let mut drawn = Vec::new();
        for state in &self.states {
            for look in 0..settings.looks.len() {
                drawn.push(self.panel(snapshot, state, look, drawn.len())?);
            }
        }
        let rows = [Row { heading: String::new(), panels: drawn }];
        let figure = panels(&rows, &MontageOptions::default()).map_err(|error| problem(&error))?;
        let path = below(folder, &settings.file)?;
        write_picture(&figure, &path, &picture_text(snapshot, &settings.field))?;
        Ok(vec![OutputFile { file: settings.file.clone(), kind: "picture".to_owned() }])
    }

    /// A panel, the `index`-th of all, with its caption.
    fn panel(
        &self,
        snapshot: &Snapshot<'_>,
        (name, subjects): &State,
        look: usize,
        index: usize,
    ) -> Result<Panel, Problem> {
        let settings = &self.settings;
        let (subject, drawn) = (&subjects[look], self.with_shared_colours(look));
        let image = drawn.draw(snapshot.lattice(), subject);
        let mut caption = settings.captions.get(index).unwrap_or(name).clone();
        if let Some(numbers) = drawn.numbers(snapshot.lattice(), &subject.values) {
            caption += &format!(": {numbers}");
        }
        Ok(Panel { image: image.map_err(|error| problem(&error))?, caption })
    }

    /// A look with the range of the last state, unless it has one or panels keep their own.
    fn with_shared_colours(&self, look: usize) -> Look {
        let chosen = &self.settings.looks[look];
        match (self.settings.same_colours, chosen.range(), self.states.last()) {
            (true, None, Some((_, last))) => {
                let [low, high] = landform_view::flat::finite_range(&last[look].values);
                chosen.clone().with_range((low, high))
            }
            _ => chosen.clone(),
        }
    }
}
