//! An animation of a field.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_sim::checkpoint::{self, Damage, Loader, Saver};
use landform_sim::output::{Moment, Output, OutputFile, Sink, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::animation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::look::{Look, Subject, picture_text, problem};

/// An animation of a field: APNG (`.png`, `.apng`) or GIF, a frame every so many iterations.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Animation {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// How it is drawn. Without a range the colours follow each frame's own heights.
    pub look: Look,
    /// Iterations between two frames.
    #[schemars(range(min = 1))]
    pub every: u64,
    /// How long each frame stays.
    #[schemars(range(min = 10, max = 60000), extend("x-unit" = "ms"))]
    pub delay_ms: u32,
}

impl Default for Animation {
    fn default() -> Self {
        Self {
            file: "animation.apng".into(),
            field: "surface".to_owned(),
            look: Look::default(),
            every: 1,
            delay_ms: 100,
        }
    }
}

impl Output for Animation {
    const NAME: &'static str = "Animation";

    fn fields(&self) -> Vec<String> {
        self.look.fields(&self.field)
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["png", "apng", "gif"])?;
        self.look.validate(lattice)
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(AnimationSink { settings: self.clone(), encoder: None })
    }
}

struct AnimationSink {
    settings: Animation,
    encoder: Option<animation::Animation>,
}

impl Sink for AnimationSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        match moment {
            Moment::Start => {
                self.encoder = Some(self.open(snapshot, folder)?);
                self.frame(snapshot)?;
            }
            Moment::Iteration if snapshot.clock().tick.is_multiple_of(self.settings.every) => {
                self.frame(snapshot)?;
            }
            Moment::Iteration | Moment::StageEnd => {}
            Moment::End => {
                let Some(encoder) = self.encoder.take() else { return Ok(Vec::new()) };
                encoder.finish().map_err(|error| problem(&error))?;
                let file = self.settings.file.clone();
                return Ok(vec![OutputFile { file, kind: "animation".to_owned() }]);
            }
        }
        Ok(Vec::new())
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        let mark = self.encoder.as_mut().map(animation::Animation::mark).transpose();
        let mark = mark.map_err(|error| problem(&error))?.unwrap_or_default();
        to.value("frames", &(mark.frames, mark.size, mark.length, mark.checksum));
        Ok(())
    }

    fn restore(
        &mut self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<(), Damage> {
        let (frames, size, length, checksum) = from.value("frames")?;
        let mark = animation::Mark { frames, size, length, checksum };
        let refuse = |message: String| from.refuse("frames", message);
        let mut encoder = self.open(snapshot, folder).map_err(|error| refuse(error.to_string()))?;
        encoder.resume(mark).map_err(|error| refuse(error.to_string()))?;
        self.encoder = Some(encoder);
        Ok(())
    }
}

impl AnimationSink {
    /// The animation without frames. Until it is finished they lie beside the checkpoint.
    fn open(
        &self,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<animation::Animation, Problem> {
        let Animation { file, field, delay_ms, .. } = &self.settings;
        let path = below(folder, file)?;
        let part = below(&folder.join(checkpoint::FOLDER), file)?;
        let text = picture_text(snapshot, field);
        let text: Vec<_> = text.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
        animation::Animation::create(&path, &part, *delay_ms, &text)
            .map_err(|error| problem(&error))
    }

    fn frame(&mut self, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let Animation { field, look, .. } = &self.settings;
        let image = look.draw(snapshot.lattice(), &Subject::of(snapshot, field, look)?);
        let image = image.map_err(|error| problem(&error))?;
        match &mut self.encoder {
            Some(encoder) => encoder.add(&image).map_err(|error| problem(&error)),
            None => Ok(()),
        }
    }
}
