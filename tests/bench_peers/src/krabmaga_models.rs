//! The models in krABMaga: one stepper over its grid of numbers, and an agent for each cell.

use krabmaga::engine::agent::Agent;
use krabmaga::engine::fields::dense_number_grid_2d::DenseNumberGrid2D;
use krabmaga::engine::fields::field::Field;
use krabmaga::engine::location::Int2D;
use krabmaga::engine::schedule::Schedule;
use krabmaga::engine::state::State;

use crate::model::{Model, Timed, timed};

/// Cells in a grid with two buffers: all read the old one and write the new one.
struct Cells {
    model: Model,
    side: usize,
    grid: DenseNumberGrid2D<u8>,
}

fn place([x, y]: [usize; 2]) -> Int2D {
    Int2D { x: x as i32, y: y as i32 }
}

impl Cells {
    fn new(model: Model, start: &[u8], side: usize) -> Self {
        let cells = Self { model, side, grid: DenseNumberGrid2D::new(side as i32, side as i32) };
        for (node, &cell) in start.iter().enumerate() {
            cells.grid.set_value_location(cell, &place([node % side, node / side]));
        }
        cells
    }

    /// Reads a cell and its neighbours and writes the cell.
    fn advance(&self, at: [usize; 2]) {
        let read = |at| self.grid.get_value(&place(at)).unwrap_or(0);
        let next = match (self.model, read(at)) {
            // Only trees look around.
            (Model::Fire, 0 | 2) => 0,
            (_, cell) => self.model.next(cell, self.model.around(at, self.side).map(read)),
        };
        self.grid.set_value_location(next, &place(at));
    }
}

impl State for Cells {
    /// Nothing: the schedule updates the grid before its first step.
    fn init(&mut self, _: &mut Schedule) {}

    fn as_any(&self) -> &dyn std::any::Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn std::any::Any {
        self
    }

    fn as_state(&self) -> &dyn State {
        self
    }

    fn as_state_mut(&mut self) -> &mut dyn State {
        self
    }

    fn reset(&mut self) {}

    fn update(&mut self, _: u64) {
        self.grid.lazy_update();
    }
}

fn cells_of(state: &mut dyn State) -> &Cells {
    state.as_any().downcast_ref().expect("the cells are the state")
}

/// Steps over the whole grid.
#[derive(Clone)]
struct Stepper;

impl Agent for Stepper {
    fn step(&mut self, state: &mut dyn State) {
        let cells = cells_of(state);
        for x in 0..cells.side {
            for y in 0..cells.side {
                cells.advance([x, y]);
            }
        }
    }
}

/// A cell that steps for itself.
#[derive(Clone)]
struct Cell([usize; 2]);

impl Agent for Cell {
    fn step(&mut self, state: &mut dyn State) {
        cells_of(state).advance(self.0);
    }
}

/// One scheduled agent steps over the grid.
pub fn on_a_grid(model: Model, start: &[u8], side: usize, steps: usize) -> Timed {
    run(model, start, side, steps, |schedule| {
        schedule.schedule_repeating(Box::new(Stepper), 0.0, 0);
    })
}

/// Every cell that can ever change is a scheduled agent: all of the Game of Life, the trees of
/// the forest.
pub fn as_agents(model: Model, start: &[u8], side: usize, steps: usize) -> Timed {
    run(model, start, side, steps, |schedule| {
        for (node, _) in start.iter().enumerate().filter(|(_, cell)| model.wraps() || **cell > 0) {
            schedule.schedule_repeating(Box::new(Cell([node % side, node / side])), 0.0, 0);
        }
    })
}

fn run(
    model: Model,
    start: &[u8],
    side: usize,
    steps: usize,
    fill: impl FnOnce(&mut Schedule),
) -> Timed {
    let mut state = Cells::new(model, start, side);
    let mut schedule = Schedule::new();
    fill(&mut schedule);
    let nanoseconds = timed(steps, || schedule.step(&mut state));
    let cell = |node| state.grid.get_value(&place([node % side, node / side])).unwrap_or(0);
    Timed { nanoseconds, cells: (0..side * side).map(cell).collect() }
}
