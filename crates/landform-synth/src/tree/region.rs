//! Parts of the plane that bounds are asked for.

/// A rectangle of the map, in metres east and north; it may be without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Region {
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Region {
    /// The whole plane.
    pub const EVERYWHERE: Self = Self { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };

    /// The square around a disc.
    pub fn around([x, y]: [f64; 2], radius: f64) -> Self {
        Self { low: [x, y], high: [x, y] }.grown(radius)
    }

    /// Whether nothing lies in it.
    pub fn is_empty(&self) -> bool {
        self.low[0] > self.high[0] || self.low[1] > self.high[1]
    }

    /// What both have in common; empty if that is nothing.
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].max(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].min(other.high[axis])),
        }
    }

    /// The smallest rectangle around both.
    pub fn hull(&self, other: &Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// The rectangle with a margin on every side.
    pub fn grown(&self, margin: f64) -> Self {
        Self { low: self.low.map(|x| x - margin), high: self.high.map(|x| x + margin) }
    }

    /// The smallest rectangle around where a linear map, given by its rows, takes this one.
    pub fn turned(&self, rows: [[f64; 2]; 2]) -> Self {
        // Whichever end of an axis makes the sum least; an axis that counts nothing adds nothing.
        let end = |row: [f64; 2], least: bool| -> f64 {
            let part = |axis: usize| match row[axis] {
                0.0 => 0.0,
                factor if (factor > 0.0) == least => factor * self.low[axis],
                factor => factor * self.high[axis],
            };
            part(0) + part(1)
        };
        Self { low: rows.map(|row| end(row, true)), high: rows.map(|row| end(row, false)) }
    }

    /// The rectangle moved.
    pub fn moved(&self, by: [f64; 2]) -> Self {
        Self {
            low: [self.low[0] + by[0], self.low[1] + by[1]],
            high: [self.high[0] + by[0], self.high[1] + by[1]],
        }
    }
}
