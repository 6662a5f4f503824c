//! Rasters and meshes, in and out.
