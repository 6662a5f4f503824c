//! Outputs that scenarios may name: pictures, animations, rasters, meshes, tables and series.

mod agent_map;
mod agent_table;
mod animation;
mod branch_lines;
mod branch_mesh;
mod branch_source;
mod capture_table;
mod cave_event_table;
mod centreline;
mod field_file;
mod field_series;
mod figure;
mod island_table;
mod lake_outlines;
mod level_lines;
mod look;
mod map_place;
mod mesh;
mod panels;
mod picture;
mod river_lines;
mod series_file;
mod voxel_mesh;

pub use agent_map::{AgentMap, DrawnGroup, LowNodes};
pub use agent_table::AgentTable;
pub use animation::Animation;
pub use branch_lines::BranchLines;
pub use branch_mesh::BranchMesh;
pub use branch_source::BranchSource;
pub use capture_table::CaptureTable;
pub use cave_event_table::CaveEventTable;
pub use centreline::Centreline;
pub use field_file::FieldFile;
pub use field_series::FieldSeries;
pub use figure::{Figure, FigurePanel};
pub use island_table::IslandTable;
pub use lake_outlines::LakeOutlines;
pub use landform_sim::output::When;
pub use level_lines::LevelLines;
pub use look::{
    CaveInterior, CaveLamp, CaveMap, CaveMapView, CaveRock, CaveWater, Cloud, CloudOpacity,
    Density, DensityAxes, Flat, Look, Perspective, Relief, Section, WaterDepths,
};
pub use mesh::Mesh;
pub use panels::Panels;
pub use picture::Picture;
pub use river_lines::RiverLines;
pub use series_file::SeriesFile;
pub use voxel_mesh::VoxelMesh;

pub(crate) use field_file::write_field;
pub(crate) use look::{Subject, water_of};
pub(crate) use mesh::{WaterOver, write_mesh};
