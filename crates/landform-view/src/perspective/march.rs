//! First hits of rays on a surface.

use rayon::prelude::*;

use crate::surface::Surface;

/// How far a ray is pushed over the edge between two cells, in cells.
const NUDGE: f64 = 1e-7;

/// Most steps of a ray for each column and row of the surface. Grazing rays over endless ground
/// need a few dozen; the limit ends rays that rounding has brought to a stand.
const STEPS: usize = 256;

/// A ray over a surface: column, row and height at its start and their change a metre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// Column and row in nodes, height in metres above the datum.
    pub(crate) origin: [f64; 3],
    /// Change of them over a metre of the ray.
    pub(crate) step: [f64; 3],
}

impl Ray {
    /// Column, row and height after `distance` metres.
    #[inline]
    pub(crate) fn at(&self, distance: f64) -> [f64; 3] {
        std::array::from_fn(|axis| self.origin[axis] + self.step[axis] * distance)
    }

    /// The part of `range`, in metres, in which a coordinate lies between two values.
    pub(crate) fn clip(&self, axis: usize, low: f64, high: f64, range: [f64; 2]) -> [f64; 2] {
        let (start, step) = (self.origin[axis], self.step[axis]);
        if step == 0.0 {
            return if start >= low && start <= high { range } else { [1.0, 0.0] };
        }
        let [one, other] = [(low - start) / step, (high - start) / step];
        [range[0].max(one.min(other)), range[1].min(one.max(other))]
    }
}

/// Greatest heights of the cells between the nodes of a surface, and of 2 x 2, 4 x 4, ... of
/// them: a ray above such a maximum passes all of those cells in one step (maximum mip maps;
/// Tevs, Ihrke and Seidel 2008, <https://doi.org/10.1145/1342250.1342279>).
pub(crate) struct Marcher<'a> {
    surface: &'a Surface,
    levels: Vec<Maxima>,
}

struct Maxima {
    columns: usize,
    rows: usize,
    heights: Vec<f32>,
}

impl<'a> Marcher<'a> {
    /// Prepares a surface.
    pub(crate) fn new(surface: &'a Surface) -> Self {
        let edge = usize::from(!surface.periodic);
        let (columns, rows) = (surface.columns - edge, surface.rows - edge);
        let cell = |column: usize, row: usize| {
            let corners = surface.corners(column as isize, row as isize);
            corners.into_iter().fold(f32::NEG_INFINITY, f32::max)
        };
        let mut levels = vec![Maxima::of(columns, rows, cell)];
        while let Some(last) = levels.last().filter(|last| last.columns.max(last.rows) > 1) {
            let coarser = last.coarser();
            levels.push(coarser);
        }
        Self { surface, levels }
    }

    /// Distance in metres, within `range`, at which a ray first is on or below the surface;
    /// the whole range must lie over the surface unless that is periodic.
    pub(crate) fn hit(&self, ray: &Ray, range: [f64; 2]) -> Option<f64> {
        let top = self.levels.len() - 1;
        let speed = ray.step[0].abs().max(ray.step[1].abs());
        let nudge = if speed > 0.0 { NUDGE / speed } else { f64::INFINITY };
        let [mut from, end] = range;
        let mut level = top;
        let budget = STEPS * (self.levels[0].columns + self.levels[0].rows + 16);
        for _ in 0..budget {
            if from > end {
                break;
            }
            let cell = self.cell(ray, from);
            let exit = self.exit(ray, cell, level).max(from).min(end);
            let lowest = ray.at(from)[2].min(ray.at(exit)[2]);
            if lowest <= f64::from(self.maximum(cell, level)) {
                if level > 0 {
                    level -= 1;
                    continue;
                }
                if let Some(distance) = self.patch(ray, cell, [from, exit]) {
                    return Some(distance);
                }
            }
            // Far away the nudge would be lost in rounding, and the march would stand still.
            from = exit + nudge.max(exit * 4e-15);
            level = (level + 1).min(top);
        }
        None
    }

    /// Cell below the ray; its column and row may lie in a repetition of the surface.
    fn cell(&self, ray: &Ray, distance: f64) -> [isize; 2] {
        let [column, row, _] = ray.at(distance);
        let cell = [column.floor() as isize, row.floor() as isize];
        if self.surface.periodic {
            return cell;
        }
        let last = [self.levels[0].columns, self.levels[0].rows].map(|size| size as isize - 1);
        [cell[0].clamp(0, last[0]), cell[1].clamp(0, last[1])]
    }

    /// Distance at which the ray leaves the group of cells of a level around a cell.
    fn exit(&self, ray: &Ray, cell: [isize; 2], level: usize) -> f64 {
        let sizes = [self.levels[0].columns, self.levels[0].rows];
        let mut exit = f64::INFINITY;
        for axis in 0..2 {
            let size = sizes[axis] as isize;
            let local = cell[axis].rem_euclid(size);
            let first = (local >> level) << level;
            let last = (first + (1 << level)).min(size);
            let step = ray.step[axis];
            let edge = if step > 0.0 { last } else { first } + cell[axis] - local;
            if step != 0.0 {
                exit = exit.min((edge as f64 - ray.origin[axis]) / step);
            }
        }
        exit
    }

    /// Greatest height of the group of cells of a level around a cell.
    fn maximum(&self, cell: [isize; 2], level: usize) -> f32 {
        let maxima = &self.levels[level];
        let [column, row] = self.local(cell);
        maxima.heights[(column >> level) + maxima.columns * (row >> level)]
    }

    /// Column and row of a cell within the surface.
    fn local(&self, cell: [isize; 2]) -> [usize; 2] {
        let sizes = [self.levels[0].columns, self.levels[0].rows];
        std::array::from_fn(|axis| cell[axis].rem_euclid(sizes[axis] as isize) as usize)
    }

    /// First distance in a range at which the ray is on or below the bilinear patch of a cell.
    fn patch(&self, ray: &Ray, cell: [isize; 2], [from, exit]: [f64; 2]) -> Option<f64> {
        let [column, row] = self.local(cell);
        let [a, east, south, both] =
            self.surface.corners(column as isize, row as isize).map(f64::from);
        let (b, c, d) = (east - a, south - a, a + both - east - south);
        let [x, y, z] = ray.at(from);
        let (u, v) = (x - cell[0] as f64, y - cell[1] as f64);
        let [du, dv, dz] = ray.step;
        // Height of the ray above the patch: constant + linear * s + square * s^2.
        let constant = z - (a + b * u + c * v + d * u * v);
        let linear = dz - b * du - c * dv - d * (u * dv + v * du);
        let square = -d * du * dv;
        let crossing = first_crossing(constant, linear, square)?;
        (crossing <= exit - from).then_some(from + crossing)
    }
}

impl Maxima {
    /// Maxima of a grid of cells, computed row by row.
    fn of(columns: usize, rows: usize, value: impl Fn(usize, usize) -> f32 + Sync) -> Self {
        let mut heights = vec![0.0; columns * rows];
        heights.par_chunks_mut(columns).enumerate().for_each(|(row, line)| {
            line.iter_mut().enumerate().for_each(|(column, height)| *height = value(column, row));
        });
        Self { columns, rows, heights }
    }

    /// Maxima of 2 x 2 of these cells; the last ones may be fewer.
    fn coarser(&self) -> Self {
        Self::of(self.columns.div_ceil(2), self.rows.div_ceil(2), |column, row| {
            let across = 2 * column..(2 * column + 2).min(self.columns);
            let down = 2 * row..(2 * row + 2).min(self.rows);
            let lines = down.map(|line| &self.heights[line * self.columns..][across.clone()]);
            lines.flatten().copied().fold(f32::NEG_INFINITY, f32::max)
        })
    }
}

/// Least `s >= 0` at which `constant + linear * s + square * s^2` is not positive.
fn first_crossing(constant: f64, linear: f64, square: f64) -> Option<f64> {
    if constant <= 0.0 {
        return Some(0.0);
    }
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant < 0.0 {
        return None;
    }
    // The stable form of the quadratic formula; it also covers a vanishing square.
    let sum = -0.5 * (linear + discriminant.sqrt().copysign(linear));
    let roots = [sum / square, constant / sum];
    roots.into_iter().filter(|root| *root >= 0.0 && root.is_finite()).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::HeightField;
    use crate::surface::Sampling;

    /// Reference: the first of the crossings with the patches of all cells.
    fn hit_of_all_cells(marcher: &Marcher<'_>, ray: &Ray, range: [f64; 2]) -> Option<f64> {
        let Maxima { columns, rows, .. } = marcher.levels[0];
        let cells = (0..columns * rows).map(|cell| [cell % columns, cell / columns]);
        let hits = cells.filter_map(|[column, row]| {
            let over = ray.clip(0, column as f64, column as f64 + 1.0, range);
            let over = ray.clip(1, row as f64, row as f64 + 1.0, over);
            let cell = [column as isize, row as isize];
            (over[0] <= over[1]).then(|| marcher.patch(ray, cell, over)).flatten()
        });
        hits.min_by(f64::total_cmp)
    }

    fn hills(periodic: bool) -> Surface {
        let (width, height) = (37, 23);
        let turn = std::f64::consts::TAU;
        let heights: Vec<f64> = (0..width * height)
            .map(|node| {
                let (x, y) = (node % width, node / width);
                let (x, y) = (x as f64 / width as f64 * turn, y as f64 / height as f64 * turn);
                6.0 * (2.0 * x).sin() + 5.0 * (3.0 * y + x).cos() + 0.1 * ((node * 7) % 13) as f64
            })
            .collect();
        let field = HeightField::new(width, height, 2.0, &heights).unwrap();
        let (origin, step, smoothing, exaggeration) = (0.0, 1.0, 0.0, 1.0);
        let size = [width, height];
        let sampling = Sampling { size, origin, step, periodic, smoothing, exaggeration };
        Surface::sample(&field, sampling).unwrap()
    }

    /// Rays from above towards scattered places, steep and grazing.
    fn rays() -> impl Iterator<Item = Ray> {
        (0..600_u32).map(|index| {
            let part = |prime: u32| f64::from(index * prime % 599) / 599.0;
            let origin = [36.0 * part(7), 22.0 * part(11), 24.0 + 30.0 * part(13)];
            let step = [part(17) - 0.5, part(19) - 0.5, -0.02 - part(23) * part(23)];
            Ray { origin, step }
        })
    }

    #[test]
    fn skipping_by_maxima_finds_the_same_hits_as_trying_every_cell() {
        let surface = hills(false);
        let marcher = Marcher::new(&surface);
        let mut hits = 0;
        for ray in rays() {
            let range = ray.clip(0, 0.0, 36.0, [0.0, 1e3]);
            let range = ray.clip(1, 0.0, 22.0, range);
            let (found, expected) =
                (marcher.hit(&ray, range), hit_of_all_cells(&marcher, &ray, range));
            hits += usize::from(found.is_some());
            match (found, expected) {
                (Some(found), Some(expected)) => assert!((found - expected).abs() < 1e-5),
                _ => assert_eq!(found.is_some(), expected.is_some(), "{ray:?}"),
            }
        }
        assert!((100..600).contains(&hits), "{hits} hits prove little");
    }

    /// Over endless ground a ray meets the same hills a period further on.
    #[test]
    fn endless_ground_repeats() {
        let surface = hills(true);
        let marcher = Marcher::new(&surface);
        for mut ray in rays() {
            let here = marcher.hit(&ray, [0.0, 1e4]).unwrap();
            ray.origin[0] -= 3.0 * 37.0;
            ray.origin[1] += 2.0 * 23.0;
            let there = marcher.hit(&ray, [0.0, 1e4]).unwrap();
            assert!((here - there).abs() < 1e-6, "{here} and {there}");
        }
    }

    #[test]
    fn vertical_rays_meet_the_height_below() {
        let surface = hills(false);
        let marcher = Marcher::new(&surface);
        let ray = Ray { origin: [8.0, 5.0, 100.0], step: [0.0, 0.0, -1.0] };
        let height = f64::from(surface.at(8, 5));
        let found = marcher.hit(&ray, [0.0, 1e3]).unwrap();
        assert!((found - (100.0 - height)).abs() < 1e-6);
    }

    #[test]
    fn first_crossings_are_those_of_the_quadratic_formula() {
        assert_eq!(first_crossing(-1.0, 5.0, 5.0), Some(0.0));
        assert_eq!(first_crossing(6.0, -5.0, 1.0), Some(2.0));
        assert_eq!(first_crossing(4.0, -2.0, 0.0), Some(2.0));
        assert_eq!(first_crossing(4.0, 2.0, 0.0), None);
        assert_eq!(first_crossing(5.0, 1.0, 1.0), None);
        assert_eq!(first_crossing(6.0, 1.0, -1.0), Some(3.0));
    }
}
