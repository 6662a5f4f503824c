//! Pictures and animations of terrain.
