//! Initial conditions: noise, ramps, hills and waves on a lattice.
