//! Bodies that are put together: surfaces, tubes, arrows.

use glam::DVec3;

use super::Body;

/// Sides of a tube or an arrow.
const SIDES: usize = 12;

/// Parts of a body with their colours, in metres.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    paint: Vec<Option<[u8; 3]>>,
}

impl Parts {
    /// All parts as one body.
    pub fn body(&self) -> Body<'_> {
        Body { positions: &self.positions, triangles: &self.triangles, paint: &self.paint }
    }

    /// Adds a surface: vertices, each with its colour or with none for that of its height, and
    /// triangles of them.
    pub fn add_surface(
        &mut self,
        vertices: impl IntoIterator<Item = ([f64; 3], Option<[u8; 3]>)>,
        triangles: &[[u32; 3]],
    ) {
        let first = self.positions.len() as u32;
        for (position, colour) in vertices {
            self.positions.push(position);
            self.paint.push(colour);
        }
        self.triangles.extend(triangles.iter().map(|of| of.map(|vertex| first + vertex)));
    }

    /// Adds a tube with pointed ends between two places, each with its colour.
    pub fn add_tube(
        &mut self,
        ends: [[f64; 3]; 2],
        radius_m: f64,
        [from, to]: [Option<[u8; 3]>; 2],
    ) {
        let length_m = DVec3::from_array(ends[0]).distance(DVec3::from_array(ends[1]));
        let profile = [
            ([-radius_m, 0.0], from),
            ([0.0, radius_m], from),
            ([length_m, radius_m], to),
            ([length_m + radius_m, 0.0], to),
        ];
        self.turn(ends, &profile);
    }

    /// Adds an arrow from its tail to its point, whose shaft has that radius.
    pub fn add_arrow(&mut self, ends: [[f64; 3]; 2], radius_m: f64, colour: [u8; 3]) {
        let length_m = DVec3::from_array(ends[0]).distance(DVec3::from_array(ends[1]));
        let neck = length_m - (6.0 * radius_m).min(0.7 * length_m);
        let profile = [
            [0.0, 0.0],
            [0.0, radius_m],
            [neck, radius_m],
            [neck, 2.6 * radius_m],
            [length_m, 0.0],
        ];
        self.turn(ends, &profile.map(|point| (point, Some(colour))));
    }

    /// Turns a profile, distances along the axis and from it, around the axis.
    fn turn(&mut self, ends: [[f64; 3]; 2], profile: &[([f64; 2], Option<[u8; 3]>)]) {
        let [from, to] = ends.map(DVec3::from_array);
        let along = (to - from).normalize_or(DVec3::Z);
        let across = along.any_orthonormal_vector();
        let third = along.cross(across);
        let ring = |&([at, radius], colour): &([f64; 2], Option<[u8; 3]>)| {
            (0..SIDES).map(move |side| {
                let (sin, cos) = (side as f64 * std::f64::consts::TAU / SIDES as f64).sin_cos();
                let place = from + along * at + (across * cos + third * sin) * radius;
                (place.to_array(), colour)
            })
        };
        let vertex = |ring: usize, side: usize| (ring * SIDES + side % SIDES) as u32;
        let quad = |number: usize| {
            let (ring, side) = (number / SIDES, number % SIDES);
            let [a, b] = [side, side + 1].map(|side| vertex(ring, side));
            let [c, d] = [side + 1, side].map(|side| vertex(ring + 1, side));
            [[a, b, c], [a, c, d]]
        };
        let triangles: Vec<[u32; 3]> = (0..(profile.len() - 1) * SIDES).flat_map(quad).collect();
        self.add_surface(profile.iter().flat_map(ring), &triangles);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume that triangles enclose, positive if they face outwards.
    fn volume(body: &Body<'_>) -> f64 {
        let corner = |vertex: u32| DVec3::from_array(body.positions[vertex as usize]);
        body.triangles
            .iter()
            .map(|of| of.map(corner))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum()
    }

    /// A twelve-sided prism has 12 / 2 sin 30 degrees = 3 of a squared radius as its base; two
    /// pyramids on it have a third of that and of their height each.
    #[test]
    fn tubes_and_arrows_face_outwards_and_have_their_volume() {
        let mut tube = Parts::default();
        tube.add_tube([[1.0, 2.0, 3.0], [1.0, 7.0, 3.0]], 0.5, [None; 2]);
        let expected = 3.0 * 0.25 * (5.0 + 2.0 * 0.5 / 3.0);
        assert!((volume(&tube.body()) - expected).abs() < 1e-9, "{}", volume(&tube.body()));
        let mut arrow = Parts::default();
        arrow.add_arrow([[0.0, 0.0, 9.0], [4.0, 0.0, 9.0]], 0.1, [1, 2, 3]);
        let expected = 3.0 * 0.01 * (3.4 + 2.6 * 2.6 * 0.6 / 3.0);
        assert!((volume(&arrow.body()) - expected).abs() < 1e-9, "{}", volume(&arrow.body()));
        assert!(arrow.body().paint.iter().all(|&colour| colour == Some([1, 2, 3])));
    }
}
