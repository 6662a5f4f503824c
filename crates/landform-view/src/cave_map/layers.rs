//! The surfaces of passages that a viewer sees along an axis.

use glam::DVec3;

use super::CaveView;
use crate::body::Body;

/// Where there is no surface.
pub(super) const NONE: f32 = f32::NEG_INFINITY;

/// The surfaces that face the viewer at every sample.
pub(super) struct Layers {
    /// Samples in a row, and rows.
    pub size: [usize; 2],
    /// Of the nearest surface and of the next one behind it: how near they are to the viewer, in
    /// metres along the axis.
    pub near_m: Vec<[f32; 2]>,
    /// Height and steepness of the nearest surface: metres, and the share of its normal that is
    /// towards the viewer.
    pub top: Vec<[f32; 2]>,
}

impl Layers {
    /// Looks at a body from the view, `scale` samples a metre, from the place that is seen at the
    /// upper left.
    pub fn of(
        body: &Body<'_>,
        view: CaveView,
        (corner, scale): ([f64; 2], f64),
        size: [usize; 2],
    ) -> Self {
        let count = size[0] * size[1];
        let mut layers = Self { size, near_m: vec![[NONE; 2]; count], top: vec![[0.0; 2]; count] };
        let normals = normals(body, view);
        let seen: Vec<[f64; 3]> = body
            .positions
            .iter()
            .map(|&position| {
                let [right, up, near] = view.seen(position);
                [(right - corner[0]) * scale, (corner[1] - up) * scale, near]
            })
            .collect();
        for triangle in body.triangles {
            let of = triangle.map(|vertex| vertex as usize);
            let heights = of.map(|vertex| body.positions[vertex][2]);
            layers.fill(of.map(|vertex| seen[vertex]), heights, of.map(|vertex| normals[vertex]));
        }
        layers
    }

    /// Puts a triangle that faces the viewer into the samples whose middle it covers. Seen places are
    /// columns, rows and nearness.
    fn fill(&mut self, [a, b, c]: [[f64; 3]; 3], heights: [f64; 3], facing: [f64; 3]) {
        // Rows run down, so what faces the viewer turns clockwise.
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area >= 0.0 {
            return;
        }
        let size = self.size;
        let range = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
            let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
            let last = high.floor().min(size[axis] as f64 - 1.0);
            low.ceil().max(0.0) as usize..if last < 0.0 { 0 } else { last as usize + 1 }
        };
        for row in range(1) {
            for column in range(0) {
                let [x, y] = [column as f64 + 0.5, row as f64 + 0.5];
                let weight = |from: [f64; 3], to: [f64; 3]| {
                    ((to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0])) / area
                };
                let weights = [weight(b, c), weight(c, a), weight(a, b)];
                if weights.iter().any(|&weight| weight < 0.0) {
                    continue;
                }
                let mean = |of: [f64; 3]| {
                    (of[0] * weights[0] + of[1] * weights[1] + of[2] * weights[2]) as f32
                };
                let index = column + size[0] * row;
                self.put(index, mean([a[2], b[2], c[2]]), [mean(heights), mean(facing)]);
            }
        }
    }

    /// Keeps the two nearest. A place on the edge of two triangles belongs to both, and counts once.
    fn put(&mut self, index: usize, near: f32, top: [f32; 2]) {
        let [first, second] = &mut self.near_m[index];
        if near == *first || near == *second {
            return;
        }
        if near > *first {
            (*second, *first) = (*first, near);
            self.top[index] = top;
        } else if near > *second {
            *second = near;
        }
    }
}

/// The share of each vertex' normal that is towards the viewer.
fn normals(body: &Body<'_>, view: CaveView) -> Vec<f64> {
    let towards = match view {
        CaveView::Plan => DVec3::Z,
        CaveView::FromSouth => DVec3::NEG_Y,
        CaveView::FromEast => DVec3::X,
    };
    let mut sums = vec![DVec3::ZERO; body.positions.len()];
    for triangle in body.triangles {
        let [a, b, c] = triangle.map(|vertex| DVec3::from_array(body.positions[vertex as usize]));
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|&vertex| sums[vertex as usize] += normal);
    }
    sums.into_iter().map(|sum| sum.normalize_or_zero().dot(towards)).collect()
}
