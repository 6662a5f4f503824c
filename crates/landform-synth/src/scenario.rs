//! The generators as initial conditions of scenarios.

use landform_sim::initial::InitialContext;
use landform_sim::parameters::Problem;
use landform_sim::registry::Registry;

use crate::{
    Aggregate, Cone, ConstructionTree, Dendrite, Dendry, Faulting, FractalNoise, GaussianHill,
    Generator, ImplicitVolume, LSystem, Mask, MidpointDisplacement, Ramp, Ridge, Sinusoid,
    SmoothNoise, SpectralFbm, SynthError, Uniform, WhiteNoise,
};

/// Makes scenarios know the generators by their names.
macro_rules! scenario_names {
    ($($generator:ident),*) => {
        $(impl landform_sim::initial::InitialCondition for $generator {
            const NAME: &'static str = stringify!($generator);

            fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
                self.generate(&context.domain.lattice, context.seed).map_err(refusal)
            }
        })*

        /// Registers the initial conditions of this crate.
        pub fn register(registry: &mut Registry) {
            registry$(.initial::<$generator>())*;
            // These read files, for which they want the folder of the scenario.
            registry.initial::<ConstructionTree>().initial::<Mask>().initial::<Dendry>();
            registry.initial::<ImplicitVolume>().initial::<Dendrite>();
        }
    };
}

scenario_names!(
    Uniform,
    WhiteNoise,
    SmoothNoise,
    SpectralFbm,
    FractalNoise,
    MidpointDisplacement,
    Faulting,
    Ramp,
    Sinusoid,
    Ridge,
    Cone,
    GaussianHill,
    Aggregate,
    LSystem
);

/// A refusal by a generator, at the parameter it is about.
pub(crate) fn refusal(error: SynthError) -> Problem {
    Problem::new(error.parameter(), error.to_string(), "").code(error.code())
}
