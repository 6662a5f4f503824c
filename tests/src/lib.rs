//! Helpers shared by the tests of the whole of Landform.
