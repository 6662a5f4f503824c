//! What a process tells the person who runs it.

use bevy_ecs::resource::Resource;

/// Notes of processes on what no parameter tells: the device that one runs on, say.
///
/// A run tells each of them once, when it comes up, and lists them in its report. They are no part
/// of its results: two runs of the same scenario may differ in them.
#[derive(Resource, Clone, Debug, Default)]
pub struct Notes(Vec<String>);

impl Notes {
    /// Tells `note`, unless that was done already.
    pub fn tell(&mut self, note: impl Into<String>) {
        let note = note.into();
        if !self.0.contains(&note) {
            self.0.push(note);
        }
    }

    /// All notes, in the order in which they came up.
    pub fn all(&self) -> &[String] {
        &self.0
    }
}
