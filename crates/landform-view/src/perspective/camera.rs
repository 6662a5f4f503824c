//! The camera of perspective views.

use glam::DVec3;

/// A pinhole camera: positions in metres, x east, y north, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub position: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// Half of the picture's width over the distance to the picture plane.
    half_width: f64,
    size: [f64; 2],
}

impl Camera {
    /// A camera at `position` that looks towards a compass bearing, `pitch_deg` below the
    /// horizon, with a horizontal field of view over a picture of `size = [width, height]`.
    pub fn new(
        position: DVec3,
        bearing_deg: f64,
        pitch_deg: f64,
        field_of_view_deg: f64,
        size: [usize; 2],
    ) -> Self {
        let (sin, cos) = bearing_deg.to_radians().sin_cos();
        let (down, level) = pitch_deg.to_radians().sin_cos();
        let forward = DVec3::new(sin * level, cos * level, -down);
        let right = DVec3::new(cos, -sin, 0.0);
        let up = right.cross(forward);
        let half_width = (field_of_view_deg.to_radians() / 2.0).tan();
        let size = size.map(|pixels| pixels as f64);
        Self { position, forward, right, up, half_width, size }
    }

    /// Unit direction of the ray through a place of the picture: column and row in pixels from
    /// its top left corner, pixel centres at halves.
    pub fn ray(&self, column: f64, row: f64) -> DVec3 {
        let scale = 2.0 * self.half_width / self.size[0];
        let x = (column - self.size[0] / 2.0) * scale;
        let y = (self.size[1] / 2.0 - row) * scale;
        (self.forward + self.right * x + self.up * y).normalize()
    }

    /// Column and row of the picture, in pixels, at which a point appears; nothing for points
    /// that are not in front of the camera.
    pub fn project(&self, point: DVec3) -> Option<[f64; 2]> {
        let offset = point - self.position;
        let depth = offset.dot(self.forward);
        let scale = self.size[0] / (2.0 * self.half_width * depth);
        let column = self.size[0] / 2.0 + offset.dot(self.right) * scale;
        let row = self.size[1] / 2.0 - offset.dot(self.up) * scale;
        (depth > 0.0).then_some([column, row])
    }

    /// Distance of a point along the camera's axis, in metres.
    pub(crate) fn depth(&self, point: DVec3) -> f64 {
        (point - self.position).dot(self.forward)
    }

    /// An offset in metres to the right, up and ahead of the camera.
    pub(crate) fn turned(&self, [right, up, ahead]: [f64; 3]) -> DVec3 {
        self.right * right + self.up * up + self.forward * ahead
    }

    /// Angle between the rays of neighbouring pixels in the middle, in radians.
    pub(crate) fn pixel_angle(&self) -> f64 {
        2.0 * self.half_width / self.size[0]
    }

    /// This camera moved so that all the points fill the picture as far as `margin`, the free
    /// share of it on each side, allows.
    pub(crate) fn framing(mut self, points: &[DVec3], margin: f64) -> Self {
        const ROUNDS: usize = 24;
        let room = [1.0, self.size[1] / self.size[0]].map(|part| part * (1.0 - 2.0 * margin));
        let mut target = points.iter().sum::<DVec3>() / points.len() as f64;
        for _ in 0..ROUNDS {
            let distance = points.iter().map(|&point| self.least_distance(point - target, room));
            let distance = distance.fold(f64::MIN_POSITIVE, f64::max);
            self.position = target - self.forward * distance;
            let shift = self.off_centre(points) * distance * self.half_width;
            target += shift;
        }
        self
    }

    /// Least distance to a target from which a point beside it is inside the picture.
    fn least_distance(&self, offset: DVec3, room: [f64; 2]) -> f64 {
        let depth = offset.dot(self.forward);
        let across = offset.dot(self.right).abs() / (self.half_width * room[0]);
        let along = offset.dot(self.up).abs() / (self.half_width * room[1]);
        across.max(along) - depth
    }

    /// Where the middle of the points' frame lies, in half picture widths from the centre.
    fn off_centre(&self, points: &[DVec3]) -> DVec3 {
        let places: Vec<[f64; 2]> = points.iter().filter_map(|&p| self.project(p)).collect();
        let middle = |axis: usize| {
            let values = places.iter().map(|place| place[axis]);
            let high = values.clone().fold(f64::NEG_INFINITY, f64::max);
            let low = values.fold(f64::INFINITY, f64::min);
            (high + low) / 2.0 - self.size[axis] / 2.0
        };
        (self.right * middle(0) - self.up * middle(1)) * (2.0 / self.size[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looking north from the origin with a right angle of view: a point as far east as north
    /// is on the right edge, one half as high as far is a quarter of the width above the middle.
    #[test]
    fn known_points_appear_where_they_should() {
        let camera = Camera::new(DVec3::ZERO, 0.0, 0.0, 90.0, [200, 100]);
        let place = |x, y, z| camera.project(DVec3::new(x, y, z)).unwrap();
        for (found, expected) in [
            (place(0.0, 5.0, 0.0), [100.0, 50.0]),
            (place(3.0, 3.0, 0.0), [200.0, 50.0]),
            (place(0.0, 4.0, 2.0), [100.0, 0.0]),
            (place(-4.0, 4.0, -2.0), [0.0, 100.0]),
        ] {
            assert!((found[0] - expected[0]).abs() < 1e-9, "{found:?} {expected:?}");
            assert!((found[1] - expected[1]).abs() < 1e-9, "{found:?} {expected:?}");
        }
        assert_eq!(camera.project(DVec3::new(0.0, -1.0, 0.0)), None);
    }

    #[test]
    fn rays_go_to_the_points_they_show() {
        for (bearing, pitch) in [(30.0, 32.0), (200.0, 0.0), (90.0, 90.0)] {
            let camera = Camera::new(DVec3::new(5.0, -7.0, 40.0), bearing, pitch, 35.0, [320, 240]);
            let point = camera.position + camera.ray(123.5, 77.25) * 80.0;
            let place = camera.project(point).unwrap();
            assert!((place[0] - 123.5).abs() < 1e-9 && (place[1] - 77.25).abs() < 1e-9);
        }
    }

    /// Everything is inside, and on two opposite sides it reaches the margin.
    #[test]
    fn framing_fills_the_picture() {
        let corner = |i: usize| {
            let part = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { 0.0 };
            DVec3::new(300.0 * part(0), 100.0 * part(1), 20.0 * part(2))
        };
        let points: Vec<DVec3> = (0..8).map(corner).collect();
        for (bearing, pitch) in [(30.0, 32.0), (0.0, 10.0), (135.0, 80.0)] {
            let camera = Camera::new(DVec3::ZERO, bearing, pitch, 30.0, [400, 300]);
            let camera = camera.framing(&points, 0.05);
            let places: Vec<[f64; 2]> = points.iter().filter_map(|&p| camera.project(p)).collect();
            assert_eq!(places.len(), 8);
            let range = |axis: usize| {
                let values = places.iter().map(|place| place[axis]);
                (values.clone().fold(f64::MAX, f64::min), values.fold(f64::MIN, f64::max))
            };
            let ((left, right), (top, foot)) = (range(0), range(1));
            assert!(left > 19.0 && right < 381.0 && top > 14.0 && foot < 286.0);
            assert!((left - 20.0).abs() < 1.0 || (top - 15.0).abs() < 1.0, "{left} {top}");
        }
    }
}
