//! Dunes that the wind builds: slabs that hop downwind (thesis, section 4.1).
