//! A turtle that draws what letters say.

use super::NAME;
use crate::SynthError;
use crate::branching::Branching;

/// Most places that a turtle remembers at a time.
const MOST_REMEMBERED: usize = 1_000_000;

/// Where a turtle begins and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turtle {
    /// Where it begins, in metres.
    pub start: [f64; 3],
    /// Whether it begins heading up, its left to the west; else it heads north, its left west.
    pub upwards: bool,
    /// Angle of turns in degrees.
    pub angle_deg: f64,
    /// Length of a step in metres.
    pub step: f64,
    /// Factor of the length of steps at `"`.
    pub step_factor: f64,
}

impl Default for Turtle {
    fn default() -> Self {
        Self { start: [0.0; 3], upwards: false, angle_deg: 90.0, step: 1.0, step_factor: 1.0 }
    }
}

/// A turtle at work.
#[derive(Clone, Copy)]
struct State {
    position: [f64; 3],
    heading: [f64; 3],
    left: [f64; 3],
    up: [f64; 3],
    step: f64,
    /// Node that it stands at, if a line leads there.
    node: Option<u32>,
}

/// The lines that a turtle draws; a table of its letters is with [`super::LSystem`].
///
/// # Errors
/// [`SynthError::Unusable`] if brackets do not match or the turtle runs out of numbers, and
/// [`SynthError::TooLarge`] for brackets nested a million deep.
pub fn walk(letters: &str, turtle: &Turtle) -> Result<Branching, SynthError> {
    let mut branching = Branching::default();
    let mut state = State {
        position: turtle.start,
        heading: if turtle.upwards { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] },
        left: [-1.0, 0.0, 0.0],
        up: if turtle.upwards { [0.0, -1.0, 0.0] } else { [0.0, 0.0, 1.0] },
        step: turtle.step,
        node: None,
    };
    let mut remembered = Vec::new();
    let angle = turtle.angle_deg.to_radians();
    for letter in letters.chars() {
        match letter {
            'F' | 'G' => state.draw(&mut branching)?,
            'f' => state.step_ahead()?,
            '+' => turn(&mut state.heading, &mut state.left, angle),
            '-' => turn(&mut state.heading, &mut state.left, -angle),
            '&' => turn(&mut state.heading, &mut state.up, -angle),
            '^' => turn(&mut state.heading, &mut state.up, angle),
            '\\' => turn(&mut state.left, &mut state.up, angle),
            '/' => turn(&mut state.left, &mut state.up, -angle),
            '|' => turn(&mut state.heading, &mut state.left, std::f64::consts::PI),
            '"' => state.step *= turtle.step_factor,
            '[' if remembered.len() == MOST_REMEMBERED => {
                let what = "brackets within each other";
                return Err(SynthError::TooLarge { generator: NAME, what, most: MOST_REMEMBERED });
            }
            '[' => {
                // All branches of a place join the same node.
                state.node.get_or_insert_with(|| branching.add(state.position, None, 0.0));
                remembered.push(state);
            }
            ']' => {
                state = remembered
                    .pop()
                    .ok_or_else(|| unusable("there is a ] without a [ before it"))?;
            }
            _ => {}
        }
    }
    match remembered.is_empty() {
        true => Ok(branching),
        false => Err(unusable("there is a [ without a ] after it")),
    }
}

impl State {
    fn step_ahead(&mut self) -> Result<(), SynthError> {
        self.position = [0, 1, 2].map(|axis| self.position[axis] + self.step * self.heading[axis]);
        self.node = None;
        // Far beyond any lattice, and small enough for squares.
        match self.position.iter().all(|at| at.abs() < 1e100) {
            true => Ok(()),
            false => Err(unusable("the turtle runs beyond all bounds; take a smaller step_factor")),
        }
    }

    fn draw(&mut self, branching: &mut Branching) -> Result<(), SynthError> {
        let from = self.node.unwrap_or_else(|| branching.add(self.position, None, 0.0));
        self.step_ahead()?;
        self.node = Some(branching.add(self.position, Some(from), 0.0));
        Ok(())
    }
}

/// Turns two directions about the third, the first one towards the second.
fn turn(first: &mut [f64; 3], second: &mut [f64; 3], angle: f64) {
    let (sine, cosine) = angle.sin_cos();
    let (a, b) = (*first, *second);
    *first = [0, 1, 2].map(|axis| cosine * a[axis] + sine * b[axis]);
    *second = [0, 1, 2].map(|axis| cosine * b[axis] - sine * a[axis]);
}

fn unusable(problem: &str) -> SynthError {
    let problem = problem.to_owned();
    SynthError::Unusable { generator: NAME, parameter: "axiom", problem }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end(letters: &str) -> [f64; 3] {
        let drawn = walk(letters, &Turtle::default()).unwrap();
        drawn.positions[drawn.len() - 1].map(|x| (x * 1e9).round() / 1e9 + 0.0)
    }

    #[test]
    fn turns_go_where_the_table_says() {
        assert_eq!(end("F"), [0.0, 1.0, 0.0]);
        assert_eq!(end("+F"), [-1.0, 0.0, 0.0]);
        assert_eq!(end("-F"), [1.0, 0.0, 0.0]);
        assert_eq!(end("^F"), [0.0, 0.0, 1.0]);
        assert_eq!(end("&F"), [0.0, 0.0, -1.0]);
        assert_eq!(end("|F"), [0.0, -1.0, 0.0]);
        // Rolled to the left, left is down: the turtle lies on its left side.
        assert_eq!(end("/+F"), [0.0, 0.0, -1.0]);
        assert_eq!(end("\\+F"), [0.0, 0.0, 1.0]);
        assert_eq!(end("F[+F]F"), [0.0, 2.0, 0.0]);
        assert_eq!(end("fF"), [0.0, 2.0, 0.0]);
    }

    #[test]
    fn brackets_make_branches_of_one_node() {
        let drawn = walk("F[+F][-F]F", &Turtle::default()).unwrap();
        assert_eq!(drawn.parents, [None, Some(0), Some(1), Some(1), Some(1)]);
        let apart = walk("FfF", &Turtle::default()).unwrap();
        assert_eq!(apart.parents, [None, Some(0), None, Some(2)]);
        assert!(walk("[", &Turtle::default()).is_err());
        assert!(walk("F]", &Turtle::default()).is_err());
        let growing = Turtle { step_factor: 100.0, ..Turtle::default() };
        assert!(walk(&"\"F".repeat(200), &growing).is_err());
    }
}
