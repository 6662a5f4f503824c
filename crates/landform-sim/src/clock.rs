//! Where the run stands.

use bevy_ecs::resource::Resource;

/// Iterations done so far and the seed of the run.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clock {
    /// Iterations done in all stages: the key of random numbers.
    pub tick: u64,
    /// Iterations done in the present stage.
    pub iteration: u64,
    /// Number of the present stage, from zero.
    pub stage: usize,
    /// Seed of the run.
    pub seed: u64,
}
