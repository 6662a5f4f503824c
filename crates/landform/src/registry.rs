//! The built-in processes, initial conditions, metrics and outputs.

use landform_sim::metric::{AgentCount, AgentStatistic, FieldStatistic};
use landform_sim::registry::Registry;

use crate::{inputs, metrics, outputs};

/// A registry with everything that Landform offers.
pub fn registry() -> Registry {
    let mut registry = Registry::new();
    registry.domain::<inputs::RasterDomain>().domain::<inputs::ShorelineDomain>();
    registry
        .initial::<inputs::DomainRaster>()
        .initial::<inputs::RasterFile>()
        .initial::<inputs::LandAbove>()
        .initial::<inputs::HypsometricGround>();
    landform_synth::register(&mut registry);
    landform_caves::register(&mut registry);
    landform_coast::register(&mut registry);
    landform_dunes::register(&mut registry);
    landform_rivers::register(&mut registry);
    landform_lessons::register(&mut registry);
    registry
        .metric::<FieldStatistic>()
        .metric::<AgentCount>()
        .metric::<AgentStatistic>()
        .metric::<metrics::SpectralFalloff>()
        .metric::<metrics::Hypsometry>()
        .metric::<metrics::ShoreDimension>()
        .metric::<metrics::SideDimension>()
        .metric::<metrics::Creases>()
        .metric::<metrics::Depressions>()
        .metric::<metrics::Drainage>()
        .metric::<metrics::ValleyHeads>()
        .metric::<metrics::ValleySpacing>()
        .metric::<metrics::CaveShape>()
        .metric::<metrics::VoxelTopology>()
        .metric::<metrics::LineShape>()
        .metric::<metrics::BranchShape>()
        .metric::<metrics::VolumeSlope>();
    registry
        .output::<outputs::Picture>()
        .output::<outputs::Panels>()
        .output::<outputs::Figure>()
        .output::<outputs::Animation>()
        .output::<outputs::FieldFile>()
        .output::<outputs::FieldSeries>()
        .output::<outputs::AgentMap>()
        .output::<outputs::AgentTable>()
        .output::<outputs::LevelLines>()
        .output::<outputs::BranchLines>()
        .output::<outputs::BranchMesh>()
        .output::<outputs::RiverLines>()
        .output::<outputs::LakeOutlines>()
        .output::<outputs::CaptureTable>()
        .output::<outputs::CaveEventTable>()
        .output::<outputs::IslandTable>()
        .output::<outputs::Mesh>()
        .output::<outputs::VoxelMesh>()
        .output::<outputs::Centreline>();
    registry
}
