//! Protochannels: the vestigial channels from which caves grow (thesis, section 5.2.1).
//!
//! Before a channel breaks through to a sink, water creeps through pores. Every source claims the
//! rock around it in proportion to its pressure ([`pressure_zones`]); on the boundary of its zone lie
//! protosinks ([`protosinks`]), and the largest flow to them through the rock shows where
//! protochannels form ([`protochannels`]).

mod channels;
mod protosinks;
mod straight;
mod zones;

pub use channels::{Network, protochannels};
pub use protosinks::{Preference, protosinks};
pub use zones::{NO_SOURCE, Seed, Zones, pressure_zones, weighted_distances};
