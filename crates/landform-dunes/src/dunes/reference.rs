//! The dune model word for word: slow, serial and short.
