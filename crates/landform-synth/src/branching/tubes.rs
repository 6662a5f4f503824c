//! Branching lines as swept tubes.

use super::Branching;
use crate::SynthError;

/// Radius below which tubes have none, as a share of the thickest.
const LEAST_SHARE: f64 = 1e-3;

/// Most vertices of a mesh.
const MOST_VERTICES: usize = 50_000_000;

/// Vertices in metres (x east, y north, z up) and triangles, counter-clockwise from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TubeMesh {
    /// Vertices.
    pub positions: Vec<[f64; 3]>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// The node of the branches that each vertex lies around.
    pub nodes: Vec<u32>,
}

/// Sweeps a polygon of `sides` corners along every branch. Each tube is closed at both ends: a
/// manifold of its own that begins inside the branch it leaves. Where tubes meet they intersect.
///
/// # Errors
/// [`SynthError::OutOfRange`] unless there are 3 to 64 sides, [`SynthError::TooLarge`], and
/// [`SynthError::Unusable`] if no branch has length and thickness.
pub fn tubes(branching: &Branching, sides: u32) -> Result<TubeMesh, SynthError> {
    crate::error::Checks("tubes").range("sides", f64::from(sides), 3.0..=64.0)?;
    let thickest = branching.radii.iter().copied().fold(0.0, f64::max);
    if branching.len().saturating_mul(sides as usize) > MOST_VERTICES {
        let what = "vertices of tubes";
        return Err(SynthError::TooLarge { generator: "tubes", what, most: MOST_VERTICES });
    }
    let mut mesh = TubeMesh::default();
    for branch in branching.branches() {
        sweep(branching, &branch, sides, thickest * LEAST_SHARE, &mut mesh);
    }
    if thickest == 0.0 || mesh.triangles.is_empty() {
        let problem = "no branch has length and thickness; give a width above 0".to_owned();
        return Err(SynthError::Unusable { generator: "tubes", parameter: "width", problem });
    }
    Ok(mesh)
}

/// Adds the tube of one branch.
fn sweep(branching: &Branching, branch: &[u32], sides: u32, least: f64, mesh: &mut TubeMesh) {
    let mut course: Vec<u32> = branch.to_vec();
    course.dedup_by_key(|node| branching.positions[*node as usize]);
    if course.len() < 2 {
        return;
    }
    let at = |number: usize| branching.positions[course[number] as usize];
    // A branch is as thick where it leaves another as at its own first node.
    let leaves = branching.parents[branch[1] as usize] == Some(branch[0])
        && branching.radii[branch[1] as usize] < branching.radii[branch[0] as usize];
    let first = mesh.positions.len() as u32;
    let mut normal = any_normal(unit(minus(at(1), at(0))));
    let last = course.len() - 1;
    for (number, &node) in course.iter().enumerate() {
        let before = unit(minus(at(number.max(1)), at(number.max(1) - 1)));
        let after = unit(minus(at((number + 1).min(last)), at((number + 1).min(last) - 1)));
        let tangent = match unit(plus(before, after)) {
            // A branch that turns straight back keeps the direction it came with.
            [0.0, 0.0, 0.0] => before,
            tangent => tangent,
        };
        normal = carried(normal, tangent);
        let other = cross(tangent, normal);
        let width_of = if number == 0 && leaves { course[1] } else { node };
        let radius = branching.radii[width_of as usize].max(least);
        for side in 0..sides {
            let (sine, cosine) =
                (f64::from(side) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
            let out = plus(scaled(normal, cosine * radius), scaled(other, sine * radius));
            mesh.positions.push(plus(at(number), out));
            mesh.nodes.push(node);
        }
    }
    close(mesh, first, course.len() as u32, sides);
    let ends = [(course[0], at(0)), (course[last], at(last))];
    for (node, end) in ends {
        mesh.positions.push(end);
        mesh.nodes.push(node);
    }
}

/// The triangles between rings, and the fans that close both ends around two vertices that follow.
fn close(mesh: &mut TubeMesh, first: u32, rings: u32, sides: u32) {
    let vertex = |ring: u32, side: u32| first + ring * sides + side % sides;
    let [start, end] = [first + rings * sides, first + rings * sides + 1];
    for side in 0..sides {
        for ring in 1..rings {
            let [a, b] = [vertex(ring - 1, side), vertex(ring - 1, side + 1)];
            let [c, d] = [vertex(ring, side), vertex(ring, side + 1)];
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
        mesh.triangles.push([start, vertex(0, side + 1), vertex(0, side)]);
        mesh.triangles.push([end, vertex(rings - 1, side), vertex(rings - 1, side + 1)]);
    }
}

/// A normal turned as little as possible to be across a new tangent.
fn carried(normal: [f64; 3], tangent: [f64; 3]) -> [f64; 3] {
    let along = dot(normal, tangent);
    match unit(minus(normal, scaled(tangent, along))) {
        [0.0, 0.0, 0.0] => any_normal(tangent),
        normal => normal,
    }
}

/// Some direction across another.
fn any_normal(tangent: [f64; 3]) -> [f64; 3] {
    let axis = if tangent[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    unit(cross(tangent, axis))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| a[axis] + b[axis])
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

fn scaled(a: [f64; 3], by: f64) -> [f64; 3] {
    a.map(|a| a * by)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction of a vector; none of no length, or one so short that it has no direction.
fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 1e-12 { scaled(a, length.recip()) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn volume(mesh: &TubeMesh) -> f64 {
        let corner = |vertex: u32| mesh.positions[vertex as usize];
        let six = |t: &[u32; 3]| dot(corner(t[0]), cross(corner(t[1]), corner(t[2])));
        mesh.triangles.iter().map(six).sum::<f64>() / 6.0
    }

    /// Every edge has one triangle on either side, and the volume is that of prisms.
    #[test]
    fn tubes_are_closed_and_point_outwards() {
        let mut branching = Branching::default();
        let root = branching.add([0.0; 3], None, 2.0);
        let bend = branching.add([0.0, 0.0, 30.0], Some(root), 2.0);
        branching.add([40.0, 0.0, 30.0], Some(bend), 1.0);
        branching.add([0.0, 0.0, 50.0], Some(bend), 2.0);
        branching.add([0.0, 9.0, 30.0], Some(bend), 0.0);
        let mesh = tubes(&branching, 8).unwrap();
        let mut edges = BTreeMap::new();
        for [a, b, c] in &mesh.triangles {
            for edge in [[a, b], [b, c], [c, a]] {
                *edges.entry(edge).or_insert(0) += 1;
            }
        }
        for (&[from, to], &count) in &edges {
            assert_eq!((count, edges.get(&[to, from])), (1, Some(&1)));
        }
        let mut straight = Branching::default();
        let root = straight.add([0.0; 3], None, 2.0);
        straight.add([3.0, 4.0, 12.0], Some(root), 2.0);
        let mesh = tubes(&straight, 8).unwrap();
        let octagon = 2.0 * 2.0_f64.sqrt() * 4.0;
        assert!((volume(&mesh) - octagon * 13.0).abs() < 1e-9);
    }

    #[test]
    fn what_has_no_body_is_refused() {
        let mut branching = Branching::default();
        assert!(tubes(&branching, 8).is_err());
        let root = branching.add([0.0; 3], None, 0.0);
        branching.add([1.0, 0.0, 0.0], Some(root), 0.0);
        assert!(tubes(&branching, 8).is_err());
        branching.radii[0] = 1.0;
        assert!(tubes(&branching, 8).is_ok() && tubes(&branching, 2).is_err());
    }
}
