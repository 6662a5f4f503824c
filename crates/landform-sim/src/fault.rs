//! How a system says that it cannot go on.

use bevy_ecs::resource::Resource;

/// The first fault that a system of the present turn raised. The run stops after the turn and
/// names the process and the iteration.
#[derive(Resource, Clone, Debug, Default)]
pub struct Fault(Option<String>);

impl Fault {
    /// Stops the run. `message` says what happened, with values, and what to do.
    pub fn raise(&mut self, message: impl Into<String>) {
        self.0.get_or_insert_with(|| message.into());
    }

    pub(crate) fn take(&mut self) -> Option<String> {
        self.0.take()
    }
}
