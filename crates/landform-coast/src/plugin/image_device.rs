//! Where image coasts are computed: the processor, or a graphics processor.

use landform_sim::parameters::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

#[cfg(feature = "gpu")]
use crate::image::GpuCoast;
use crate::image::{ImageCoast, ImageCoastSettings};

/// What computes an image coast. The land is the same, bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum CoastDevice {
    /// The processor, on all threads of the run.
    #[default]
    Processor,
    /// A graphics processor: the best that Vulkan, Metal, DirectX 12 or OpenGL offers, one in
    /// software if there is no other. For programs that are built with `--features gpu`.
    Graphics,
}

impl CoastDevice {
    /// Bytes a node that a coast takes of the memory of the processor. Devices in software have
    /// their own memory there too.
    pub(super) fn bytes_per_node(self) -> usize {
        match self {
            Self::Processor => 3,
            Self::Graphics => 28,
        }
    }

    /// Refuses a device that is not there, and an image of `size` that it cannot hold.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(unused_variables, reason = "without a device no image is too large for it")
    )]
    pub(super) fn check(self, size: [usize; 2]) -> Result<(), Problem> {
        match self {
            Self::Processor => Ok(()),
            #[cfg(feature = "gpu")]
            Self::Graphics => GpuCoast::check(size).map_err(|error| refusal(error.to_string(), "")),
            #[cfg(not(feature = "gpu"))]
            Self::Graphics => {
                let message = "this program was built without graphics processors";
                Err(refusal(message.to_owned(), "build it with `--features gpu`, or "))
            }
        }
    }
}

/// A refusal of the device; `help` goes before what helps in any case.
fn refusal(message: String, help: &str) -> Problem {
    let help = format!("{help}say `device: Processor`, which gives the same land");
    Problem::new("device", message, "").help(help)
}

/// An image coast on its device.
pub(super) enum DeviceCoast {
    /// On the processor.
    Processor(ImageCoast),
    /// On a graphics processor.
    #[cfg(feature = "gpu")]
    Graphics(Box<GpuCoast>),
}

impl DeviceCoast {
    /// A coast on a `device`; says why that is impossible.
    pub(super) fn new(
        device: CoastDevice,
        size: [usize; 2],
        settings: ImageCoastSettings,
        resistance: &[f64],
    ) -> Result<Self, String> {
        match device {
            CoastDevice::Processor => ImageCoast::new(size, settings, resistance)
                .map(Self::Processor)
                .map_err(|error| error.to_string()),
            #[cfg(feature = "gpu")]
            CoastDevice::Graphics => GpuCoast::new(size, settings, resistance)
                .map(|coast| Self::Graphics(Box::new(coast)))
                .map_err(|error| error.to_string()),
            #[cfg(not(feature = "gpu"))]
            CoastDevice::Graphics => Err(format!("{device:?} is not in this program")),
        }
    }

    /// Name of a device that the scenario does not tell.
    pub(super) fn device(&self) -> Option<&str> {
        match self {
            Self::Processor(_) => None,
            #[cfg(feature = "gpu")]
            Self::Graphics(coast) => Some(coast.device()),
        }
    }

    /// One iteration on `land`. Returns the number of nodes that fell, or why that is unknown.
    pub(super) fn step(&mut self, land: &mut [u8]) -> Result<usize, String> {
        match self {
            Self::Processor(coast) => coast.step(land).map_err(|error| error.to_string()),
            #[cfg(feature = "gpu")]
            Self::Graphics(coast) => coast.step(land).map_err(|error| error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    #[cfg(not(feature = "gpu"))]
    fn a_program_without_graphics_processors_says_how_to_build_one_with_them() {
        use super::CoastDevice;
        let refused = CoastDevice::Graphics.check([64, 64]).unwrap_err();
        assert_eq!(refused.parameter, "device");
        assert!(refused.help.contains("--features gpu"), "{refused}");
        assert!(CoastDevice::Processor.check([64, 64]).is_ok());
    }

    #[cfg(feature = "gpu")]
    mod runs {
        use std::cell::RefCell;
        use std::ops::ControlFlow;
        use std::path::Path;
        use std::rc::Rc;
        use std::sync::Arc;

        use landform_sim::checkpoint::Checkpoint;
        use landform_sim::prelude::*;
        use landform_sim::scenario::ScenarioSource;
        use landform_sim::simulation::{Keeper, Limits, Progress, Report, Simulation};
        use schemars::JsonSchema;
        use serde::{Deserialize, Serialize};

        use crate::image::testing::device;

        /// A run with a checkpoint after each iteration.
        struct All(Rc<RefCell<Vec<Checkpoint<'static>>>>);

        impl Keeper for All {
            fn is_due(&mut self, _: &Progress<'_>) -> bool {
                true
            }

            fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String> {
                self.0.borrow_mut().push(checkpoint.into_owned());
                Ok(())
            }
        }

        /// Rock at random.
        #[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
        struct RandomRock {}

        impl InitialCondition for RandomRock {
            const NAME: &'static str = "RandomRock";

            fn values(&self, context: &InitialContext<'_>) -> Result<Vec<f64>, Problem> {
                let random = RandomStream::new(3, "rock");
                let nodes = 0..context.domain.lattice.node_count();
                Ok(nodes.map(|node| random.unit(0, node, 0)).collect())
            }
        }

        fn simulation(device: &str) -> Simulation {
            let text = format!(
                "(title: \"coast\", seed: 3, domain: Grid(size: (64, 48), connectivity: Four),
                  initial: [
                      (field: \"land\", from: StartingLand(margin: 0.1)),
                      (field: \"resistance\", from: RandomRock()),
                  ],
                  stages: [
                      (name: \"coast\", processes: [
                          ImageCoastErosion(force: 0.6, attenuation: 0.3, device: {device}),
                      ], stop: Iterations(9)),
                      (name: \"pruned\", processes: [
                          ImageCoastErosion(force: 0.9, device: {device}),
                          IslandPruning(least_shore_m: 500.0),
                      ], stop: Iterations(9)),
                  ],
                  metrics: [ImageCoastActivity(), Islands()])"
            );
            let mut registry = Registry::new();
            crate::register(&mut registry);
            registry.initial::<RandomRock>();
            let source = ScenarioSource::from_text("coast.ron", &text, Path::new(""));
            let scenario = source.parse(&Arc::new(registry)).expect("a good scenario");
            Simulation::new(scenario, Path::new(""), Limits::default()).expect("it fits")
        }

        /// Everything in the checkpoints of a run, and its report without times.
        fn run(mut simulation: Simulation) -> (Vec<Checkpoint<'static>>, Report) {
            let all = Rc::default();
            simulation.keep_checkpoints(Box::new(All(Rc::clone(&all))));
            let mut report = Report::default();
            let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
            simulation.run(Path::new(""), &mut hook, &mut report).expect("a run");
            report.seconds = 0.0;
            report.stages.iter_mut().for_each(|stage| stage.seconds = 0.0);
            let checkpoints = all.borrow().clone();
            (checkpoints, report)
        }

        #[test]
        fn a_device_gives_every_iteration_of_the_processor_and_goes_on_from_any() {
            if device().is_none() {
                return;
            }
            let (here, expected) = run(simulation("Processor"));
            let (there, mut report) = run(simulation("Graphics"));
            assert!(expected.notes.is_empty() && report.notes.len() == 1, "{:?}", report.notes);
            assert!(report.notes[0].starts_with("ImageCoastErosion runs on "), "{report:?}");
            let land =
                |checkpoint: &Checkpoint<'_>| checkpoint.arrays["fields/land"].bytes().to_vec();
            let lands: Vec<_> = here.iter().map(land).collect();
            assert_eq!(lands, there.iter().map(land).collect::<Vec<_>>());
            assert!(lands.windows(2).filter(|pair| pair[0] != pair[1]).count() > 5);
            for checkpoint in there.into_iter().skip(1).step_by(4) {
                let mut resumed = simulation("Graphics");
                resumed.resume(checkpoint, Path::new("")).expect("it fits");
                let (rest, report) = run(resumed);
                assert_eq!(rest.last().map(land), here.last().map(land));
                assert_eq!(report.metrics, expected.metrics);
            }
            report.notes.clear();
            assert_eq!(report, expected);
        }
    }
}
