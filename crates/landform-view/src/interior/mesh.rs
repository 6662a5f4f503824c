//! Rays against many triangles, which cubes of a grid hold.

use glam::DVec3;

use super::noise::octaves;

/// Most cubes of the grid.
const MOST_CELLS: f64 = 8_388_608.0;

/// The walls around a space, made ready for rays.
pub(super) struct Mesh {
    /// Positions of the vertices in metres.
    pub positions: Vec<DVec3>,
    /// Normals of the vertices, into the space that the walls enclose.
    pub normals: Vec<DVec3>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    low: DVec3,
    cell_m: f64,
    cells: [usize; 3],
    /// Where the triangles of each cube begin in `members`, and where those of the last one end.
    starts: Vec<u32>,
    members: Vec<u32>,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Number of the triangle.
    pub triangle: usize,
    /// Distance from the origin of the ray, in lengths of its direction.
    pub distance: f64,
    /// Weights of the second and the third vertex.
    pub weights: [f64; 2],
}

impl Mesh {
    /// The walls that triangles, counter-clockwise seen from outside, make; vertices are moved by
    /// noise of `roughness_m` across the wall.
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]], roughness_m: f64) -> Self {
        let mut positions: Vec<DVec3> = positions.iter().copied().map(DVec3::from_array).collect();
        let mut inwards = normals(&positions, triangles);
        if roughness_m > 0.0 {
            for (position, normal) in positions.iter_mut().zip(&inwards) {
                // Bumps several times as wide as they are high.
                *position += *normal * roughness_m * octaves(1, *position / (6.0 * roughness_m), 3);
            }
            inwards = normals(&positions, triangles);
        }
        let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let mut mesh = Self {
            positions,
            normals: inwards,
            triangles: triangles.to_vec(),
            low,
            cell_m: 1.0,
            cells: [0; 3],
            starts: vec![0],
            members: Vec::new(),
        };
        if !mesh.triangles.is_empty() {
            mesh.fill_grid(high - low);
        }
        mesh
    }

    /// Sorts the triangles into cubes about twice as wide as they are.
    fn fill_grid(&mut self, size: DVec3) {
        let edge = |&[a, b, _]: &[u32; 3]| self.position(a).distance(self.position(b));
        let mean = self.triangles.iter().map(edge).sum::<f64>() / self.triangles.len() as f64;
        let room = (size.x.max(mean) * size.y.max(mean) * size.z.max(mean) / MOST_CELLS).cbrt();
        self.cell_m = (2.0 * mean).max(room).max(f64::MIN_POSITIVE);
        self.cells = [0, 1, 2].map(|axis| (size[axis] / self.cell_m) as usize + 1);
        let mut counts = vec![0_u32; self.cells.iter().product::<usize>() + 1];
        for triangle in 0..self.triangles.len() {
            self.touched(triangle).for_each(|cell| counts[cell + 1] += 1);
        }
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        let mut members = vec![0; counts[counts.len() - 1] as usize];
        let mut next = counts.clone();
        for triangle in 0..self.triangles.len() {
            for cell in self.touched(triangle) {
                members[next[cell] as usize] = triangle as u32;
                next[cell] += 1;
            }
        }
        (self.starts, self.members) = (counts, members);
    }

    /// The cubes that the box around a triangle touches.
    fn touched(&self, triangle: usize) -> impl Iterator<Item = usize> + use<> {
        let [a, b, c] = self.corners(triangle);
        let [low, high] = [self.cell_of(a.min(b).min(c)), self.cell_of(a.max(b).max(c))];
        let [columns, rows, _] = self.cells;
        (low[2]..=high[2]).flat_map(move |layer| {
            (low[1]..=high[1]).flat_map(move |row| {
                (low[0]..=high[0]).map(move |column| column + columns * (row + rows * layer))
            })
        })
    }

    fn cell_of(&self, place: DVec3) -> [usize; 3] {
        let at = (place - self.low) / self.cell_m;
        // Casts keep what is below 0 at 0.
        [0, 1, 2].map(|axis| (at[axis] as usize).min(self.cells[axis] - 1))
    }

    fn position(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|vertex| self.position(vertex))
    }

    /// The first triangle that a ray meets no farther than `farthest`, of several at one distance
    /// the one with the lowest number.
    pub fn nearest(&self, origin: DVec3, direction: DVec3, farthest: f64) -> Option<Hit> {
        let inverse = direction.recip();
        let [enter, leave] = self.clip(origin, inverse, farthest)?;
        let mut cell = self.cell_of(origin + direction * enter);
        // How far along the ray it leaves the cube across each axis.
        let side = |axis: usize, cell: usize| {
            let plane = (cell + usize::from(direction[axis] > 0.0)) as f64;
            let way = (self.low[axis] + plane * self.cell_m - origin[axis]) * inverse[axis];
            if direction[axis] == 0.0 { f64::INFINITY } else { way }
        };
        let mut best: Option<Hit> = None;
        loop {
            let [columns, rows, _] = self.cells;
            let index = cell[0] + columns * (cell[1] + rows * cell[2]);
            let members = self.starts[index] as usize..self.starts[index + 1] as usize;
            for &triangle in &self.members[members] {
                if let Some(hit) = self.meet(triangle as usize, origin, direction)
                    && hit.distance <= farthest
                    && best.is_none_or(|best| hit.is_before(&best))
                {
                    best = Some(hit);
                }
            }
            let exits = [0, 1, 2].map(|axis| side(axis, cell[axis]));
            let axis = if exits[0] <= exits[1] { 0 } else { 1 };
            let axis = if exits[axis] <= exits[2] { axis } else { 2 };
            if exits[axis] > leave || best.is_some_and(|best| best.distance < exits[axis]) {
                return best;
            }
            let on = cell[axis].checked_add_signed(if direction[axis] > 0.0 { 1 } else { -1 });
            match on.filter(|&on| on < self.cells[axis]) {
                Some(on) => cell[axis] = on,
                None => return best,
            }
        }
    }

    /// Where a ray enters and leaves the box around all triangles.
    fn clip(&self, origin: DVec3, inverse: DVec3, farthest: f64) -> Option<[f64; 2]> {
        if self.triangles.is_empty() {
            return None;
        }
        let size = DVec3::from_array(self.cells.map(|cells| cells as f64)) * self.cell_m;
        let (mut enter, mut leave) = (0.0_f64, farthest);
        for axis in 0..3 {
            let first = (self.low[axis] - origin[axis]) * inverse[axis];
            let last = (self.low[axis] + size[axis] - origin[axis]) * inverse[axis];
            // Along a plane both are infinite or no numbers, which `max` and `min` leave out.
            enter = enter.max(first.min(last));
            leave = leave.min(first.max(last));
        }
        (enter <= leave).then_some([enter, leave])
    }

    /// Where a ray meets a triangle, if it does (Möller and Trumbore 1997).
    fn meet(&self, triangle: usize, origin: DVec3, direction: DVec3) -> Option<Hit> {
        /// Rays that pass between two triangles, by rounding alone, meet both.
        const SLACK: f64 = -1e-9;
        let [a, b, c] = self.corners(triangle);
        let [along, up] = [b - a, c - a];
        let across = direction.cross(up);
        let volume = along.dot(across);
        if volume == 0.0 {
            return None;
        }
        let from = origin - a;
        let second = from.dot(across) / volume;
        let over = from.cross(along);
        let third = direction.dot(over) / volume;
        let distance = up.dot(over) / volume;
        let is_inside = second >= SLACK && third >= SLACK && second + third <= 1.0 - SLACK;
        let hit = Hit { triangle, distance, weights: [second, third] };
        (is_inside && distance > 0.0).then_some(hit)
    }
}

impl Hit {
    fn is_before(&self, other: &Self) -> bool {
        (self.distance, self.triangle) < (other.distance, other.triangle)
    }
}

/// Normals of the vertices, into the space: means of their triangles, by area.
fn normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        let normal = (c - a).cross(b - a);
        triangle.iter().for_each(|&vertex| sums[vertex as usize] += normal);
    }
    sums.into_iter().map(DVec3::normalize_or_zero).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sphere of triangles with bumps, and rays from inside and outside: every triangle is tried.
    #[test]
    fn the_grid_finds_what_trying_every_triangle_finds() {
        let ring = |of: usize| of as f64 * std::f64::consts::TAU / 24.0;
        let place = |row: usize, column: usize| {
            let (sin, cos) = (ring(row) / 2.0).sin_cos();
            let radius = 5.0 + 0.8 * (3.0 * ring(column)).sin() * sin;
            let (north, east) = ring(column).sin_cos();
            [radius * sin * east, radius * sin * north, radius * cos]
        };
        let positions: Vec<[f64; 3]> =
            (0..25 * 24).map(|number| place(number / 24, number % 24)).collect();
        let vertex = |row: usize, column: usize| (24 * row + column % 24) as u32;
        let triangles: Vec<[u32; 3]> = (0..24 * 24)
            .flat_map(|number| {
                let (row, column) = (number / 24, number % 24);
                let [a, b] = [vertex(row, column), vertex(row + 1, column)];
                let [c, d] = [vertex(row + 1, column + 1), vertex(row, column + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let mesh = Mesh::new(&positions, &triangles, 0.1);
        let mut hits = 0;
        for number in 0..2000 {
            let turn = |step: f64| (f64::from(number) * step).sin();
            let origin = DVec3::new(turn(1.3), turn(2.1), turn(0.7)) * 8.0;
            let to = DVec3::new(turn(3.7), turn(5.1), turn(4.3)) * 4.0;
            let direction = (to - origin).normalize();
            let all = (0..mesh.triangles.len()).filter_map(|t| mesh.meet(t, origin, direction));
            let expected = all.reduce(|a, b| if b.is_before(&a) { b } else { a });
            assert_eq!(mesh.nearest(origin, direction, 1e3), expected, "ray {number}");
            hits += usize::from(expected.is_some());
        }
        assert!(hits > 1500, "{hits}");
        let along = DVec3::new(0.0, 0.0, 1.0);
        let hit = mesh.nearest(DVec3::new(0.3, 0.2, 0.0), along, 1e3).unwrap();
        assert!((hit.distance - 5.0).abs() < 0.3, "a ray along an axis: {hit:?}");
        assert_eq!(mesh.nearest(DVec3::ZERO, along, 2.0), None, "no farther than asked");
    }
}
