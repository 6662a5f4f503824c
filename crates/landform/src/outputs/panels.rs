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

use super::field_file;
use super::look::{Look, picture_text, problem, write_picture};

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
    /// Texts below the panels, in order; stage names where they are missing.
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
            captions: Vec::new(),
            same_colours: true,
        }
    }
}

impl Output for Panels {
    const NAME: &'static str = "Panels";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["png"])?;
        self.looks.iter().try_for_each(|look| look.validate(lattice))
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(PanelSink { settings: self.clone(), states: Vec::new() })
    }
}

/// The states seen so far; they are drawn together because they may share colours.
struct PanelSink {
    settings: Panels,
    states: Vec<(String, Vec<f64>)>,
}

impl Sink for PanelSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        match moment {
            Moment::Start | Moment::StageEnd => {
                let (values, _) = field_file::values(snapshot, &self.settings.field)?;
                let name = match moment {
                    Moment::Start => "initial",
                    _ => snapshot.stage_name(),
                };
                self.states.push((name.to_owned(), values));
                Ok(Vec::new())
            }
            Moment::Iteration => Ok(Vec::new()),
            Moment::End => self.draw(snapshot, folder),
        }
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        let names: Vec<&String> = self.states.iter().map(|(name, _)| name).collect();
        to.value("names", &names);
        for (index, (_, values)) in self.states.iter().enumerate() {
            to.array(&index.to_string(), values);
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
        self.states = names.into_iter().enumerate().map(state).collect::<Result<_, _>>()?;
        Ok(())
    }
}

impl PanelSink {
    fn draw(&self, snapshot: &Snapshot<'_>, folder: &Path) -> Result<Vec<OutputFile>, Problem> {
        let settings = &self.settings;
        let (_, entry) = field_file::values(snapshot, &settings.field)?;
        let mut row = Row { heading: String::new(), panels: Vec::new() };
        for (name, values) in &self.states {
            for look in &settings.looks {
                let look = self.with_shared_colours(look);
                let image = look.draw(snapshot.lattice(), values, entry.unit);
                let image = image.map_err(|error| problem(&error))?;
                let caption = settings.captions.get(row.panels.len()).unwrap_or(name).clone();
                row.panels.push(Panel { image, caption });
            }
        }
        let figure = panels(&[row], &MontageOptions::default()).map_err(|error| problem(&error))?;
        let path = below(folder, &settings.file)?;
        write_picture(&figure, &path, &picture_text(snapshot, &settings.field))?;
        Ok(vec![OutputFile { file: settings.file.clone(), kind: "picture".to_owned() }])
    }
    /// The look with the range of the last state, unless it has one or panels keep their own.
    fn with_shared_colours(&self, look: &Look) -> Look {
        match (self.settings.same_colours, look.range(), self.states.last()) {
            (true, None, Some((_, last))) => {
                let [low, high] = landform_view::flat::finite_range(last);
                look.clone().with_range((low, high))
            }
            _ => look.clone(),
        }
    }
}
