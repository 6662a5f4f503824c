//! Water that flows through pipes between columns (thesis, listing 4.3; O'Brien and Hodgins 1995;
//! Šťava et al. 2008).
//!
//! A pipe joins every two neighbours. The difference of levels at its ends accelerates the water in
//! it, and friction slows it down; steps are explicit, flows first, then levels:
//!
//! ```text
//! dQ/dt = c a g (H - H') / l        Q: flow, m³/s; c a: cross-section, m²; l: length, m
//! ```
//!
//! A node never gives more than it has: where outflows are larger they are scaled back together.
//! Both ends of a pipe hold its flow, with opposite signs, to the last bit; what runs through in a
//! step is rounded down to whole units, the same at both ends.

use landform_graph::Lattice;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::columns::{Columns, ROWS};
use super::units::UNIT_M;
use crate::RiverError;
use crate::error::check_length;
use crate::frame::Frame;

/// Acceleration of gravity, m/s².
const GRAVITY: f64 = 9.81;

/// Numbers of pipes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PipeSettings {
    /// Time that a sweep stands for.
    #[schemars(range(min = 1e-6, max = 1e6), extend("x-unit" = "s", "x-source" = "thesis 4.4.3: 0.2, as 1 leaves spikes"))]
    pub step_s: f64,
    /// Cross-section of a pipe as a share of the area of a node.
    #[schemars(range(min = 1e-6, max = 1.0))]
    pub cross_section: f64,
    /// Share of the flow that friction leaves after a second.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub persistence: f64,
}

impl Default for PipeSettings {
    fn default() -> Self {
        Self { step_s: 0.2, cross_section: 0.1, persistence: 0.9 }
    }
}

impl PipeSettings {
    /// Checks that steps are stable: the fastest oscillation, of neighbours against each other,
    /// must be seen twice.
    ///
    /// # Errors
    /// [`RiverError::Unstable`].
    pub fn check(&self, lattice: &Lattice) -> Result<(), RiverError> {
        let squared = self.cross_section * GRAVITY * lattice.directions() as f64;
        let most_s = (2.0 * lattice.spacing() / squared).sqrt();
        let step_s = self.step_s;
        if step_s <= most_s { Ok(()) } else { Err(RiverError::Unstable { step_s, most_s }) }
    }
}

/// Pipes of a lattice and the memory of their steps.
pub(super) struct Pipes {
    directions: usize,
    /// Flow of a pipe that a unit of difference in level adds, by direction, m³/s.
    push: [f64; 8],
    /// Flow that friction leaves after a step, as a share.
    persistence: f64,
    /// Units of depth that a flow of 1 m³/s moves in a step.
    moved: f64,
    /// Part of the outflows that a node's water suffices for, framed.
    part: Vec<f64>,
    /// Change of level, framed.
    change: Vec<i64>,
}

impl Pipes {
    pub(super) fn new(lattice: &Lattice, settings: PipeSettings) -> Result<Self, RiverError> {
        settings.check(lattice)?;
        let frame = Frame::new(lattice)?;
        let area = lattice.spacing().powi(2);
        let push = |direction: usize| {
            let length = lattice.edge_lengths()[usize::from(direction >= 4)];
            settings.step_s * settings.cross_section * area * GRAVITY * UNIT_M / length
        };
        Ok(Self {
            directions: lattice.directions(),
            push: std::array::from_fn(push),
            persistence: settings.persistence.powf(settings.step_s),
            moved: settings.step_s / area / UNIT_M,
            part: vec![1.0; frame.len()],
            change: vec![0; frame.len()],
        })
    }

    /// A step: flows by slot ([`Lattice::slots`]), then levels.
    pub(super) fn step(
        &mut self,
        columns: &mut Columns,
        flows: &mut [f64],
    ) -> Result<(), RiverError> {
        let Frame { width, height, .. } = columns.frame;
        check_length("pipe_flow", flows.len(), width * height * self.directions)?;
        match self.directions {
            4 => self.flow::<4>(columns, flows),
            _ => self.flow::<8>(columns, flows),
        }
        self.shift(columns);
        columns.wrap();
        Ok(())
    }

    fn flow<const DEGREE: usize>(&mut self, columns: &mut Columns, flows: &mut [f64]) {
        self.accelerate::<DEGREE>(columns, flows);
        columns.frame.wrap(&mut self.part);
        self.run::<DEGREE>(columns, flows);
    }

    /// Levels drive flows; no node gives more than it has.
    fn accelerate<const DEGREE: usize>(&mut self, columns: &Columns, flows: &mut [f64]) {
        let Columns { frame, bed, level, .. } = columns;
        let Self { push, persistence, moved, ref mut part, .. } = *self;
        let rows = frame.rows_of(part).zip(flows.par_chunks_exact_mut(frame.width * DEGREE));
        rows.enumerate().with_min_len(ROWS).for_each(|(row, (part, flows))| {
            each_node::<DEGREE>(frame, row + 1, flows, |column, flows, pipes| {
                let at = (row + 1) * frame.stride + column;
                let around = frame.around(level, at);
                let mut leaving = 0;
                for k in 0..DEGREE {
                    if pipes[k] {
                        let fall = (level[at] - around[k]) as f64;
                        flows[k] = persistence * flows[k] + push[k] * fall;
                        leaving += most_units(flows[k], moved);
                    }
                }
                part[column] = part_of(level[at] - bed[at], leaving);
            });
        });
    }

    /// What leaves one node comes in at the other.
    fn run<const DEGREE: usize>(&mut self, columns: &mut Columns, flows: &mut [f64]) {
        let Columns { frame, received, .. } = columns;
        let frame = &*frame;
        let Self { moved, ref part, ref mut change, .. } = *self;
        let state = frame.rows_of(change).zip(frame.rows_of(received));
        let rows = state.zip(flows.par_chunks_exact_mut(frame.width * DEGREE));
        rows.enumerate().with_min_len(ROWS).for_each(|(row, ((change, received), flows))| {
            each_node::<DEGREE>(frame, row + 1, flows, |column, flows, pipes| {
                let at = (row + 1) * frame.stride + column;
                let around = frame.around(part, at);
                let (mut leaves, mut comes) = (0, 0);
                for k in 0..DEGREE {
                    if pipes[k] {
                        let out = flows[k] > 0.0;
                        flows[k] *= if out { part[at] } else { around[k] };
                        let amount = (flows[k] * moved) as i64;
                        leaves += amount.max(0);
                        comes -= amount.min(0);
                    }
                }
                received[column] += comes;
                change[column] = comes - leaves;
            });
        });
    }

    /// Levels change.
    fn shift(&mut self, columns: &mut Columns) {
        let Columns { frame, bed, level, wet, .. } = columns;
        let frame = &*frame;
        let rows = frame.rows_of(level).zip(wet.rows_mut().skip(1));
        rows.enumerate().with_min_len(ROWS).for_each(|(row, (level, wet))| {
            let first = (row + 1) * frame.stride;
            wet.fill(0);
            for column in 1..=frame.width {
                level[column] += self.change[first + column];
                let depth = level[column] - bed[first + column];
                wet[column / 64] |= u64::from(depth > 0) << (column % 64);
            }
        });
    }
}

/// Units of depth that a flow moves at most: rounded up, so that what is rounded down never adds up
/// to more.
#[inline(always)]
pub(super) fn most_units(flow: f64, moved: f64) -> i64 {
    if flow > 0.0 { (flow * moved) as i64 + 1 } else { 0 }
}

/// Part of the outflows, `leaving` in all, that a depth suffices for.
#[inline(always)]
pub(super) fn part_of(depth: i64, leaving: i64) -> f64 {
    match leaving > depth {
        true => depth as f64 / leaving as f64 * (1.0 - 4.0 * f64::EPSILON),
        false => 1.0,
    }
}

/// Calls `visit` for every node of a row with its column, its flows, and whether there is a pipe in
/// each direction.
#[inline(always)]
fn each_node<const DEGREE: usize>(
    frame: &Frame,
    row: usize,
    flows: &mut [f64],
    mut visit: impl FnMut(usize, &mut [f64; DEGREE], [bool; 8]),
) {
    let (flows, _) = flows.as_chunks_mut::<DEGREE>();
    let all_alike = frame.is_inner_row(row) && frame.degree(row, 0) == frame.degree(row, 1);
    for (column, flows) in (1..).zip(flows) {
        match all_alike && column > 1 && column < frame.width {
            true => visit(column, flows, [true; 8]),
            false => visit(column, flows, frame.pipes(row, column)),
        }
    }
}
