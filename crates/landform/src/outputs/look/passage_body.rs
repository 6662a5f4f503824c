//! Passages as a body: their surface or tubes, colours by a field, arrows at sources and sinks.

use landform_analysis::caves::CaveNetwork;
use landform_analysis::voxels::{Surface, VoxelSet, smooth_surface};
use landform_graph::Lattice;
use landform_view::body::Parts;
use landform_view::mark::Mark;
use landform_view::{ColourMap, flat};

use super::{Passages, Subject, marks};

/// Length of an arrow and radius of its shaft, as shares of the block's diagonal.
const ARROW: [f64; 2] = [0.11, 0.0065];

/// Lowest and highest corner of what holds a block and the arrows at its sides.
pub(super) fn frame(top: [f64; 3]) -> [[f64; 3]; 2] {
    let length_m = ARROW[0] * diagonal(top);
    let [x, y, z] = top;
    let half = 0.5 * length_m;
    [[-half, -half, 0.0], [x + half, y + half, z + length_m]]
}

fn diagonal(top: [f64; 3]) -> f64 {
    top[0].hypot(top[1]).hypot(top[2])
}

/// The body of the passages that a look shows.
pub(super) fn parts(
    look: &Passages,
    lattice: &Lattice,
    subject: &Subject,
    map: ColourMap,
) -> Parts {
    let whole = VoxelSet::at_least(lattice.size(), &subject.values, look.at_least);
    let set = look.thinned.map_or(whole.clone(), |thinned| thinned.of(&whole));
    let paint = Paint::new(look, lattice, &set, subject, map);
    let mut parts = Parts::default();
    match look.tube_radius_m {
        Some(radius_m) => add_tubes(&mut parts, &set, lattice.spacing(), radius_m, &paint),
        None => {
            let surface = smooth_surface(&set, look.smoothing);
            // Walls of voxels as they are have edges: each has its own normals.
            let surface = if look.smoothing == 0 { faceted(&surface) } else { surface };
            let Surface { positions, triangles } = surface;
            let spacing_m = lattice.spacing();
            let vertices = positions.iter().map(|&at| (at.map(|at| at * spacing_m), paint.at(at)));
            parts.add_surface(vertices, &triangles);
        }
    }
    if look.marks {
        add_arrows(&mut parts, lattice, subject);
    }
    parts
}

/// A surface whose triangles share no vertices.
fn faceted(surface: &Surface) -> Surface {
    let corners = surface.triangles.iter().flatten();
    let count = surface.triangles.len() as u32;
    Surface {
        positions: corners.map(|&vertex| surface.positions[vertex as usize]).collect(),
        triangles: (0..count).map(|number| [0, 1, 2].map(|corner| 3 * number + corner)).collect(),
    }
}

/// Tubes from voxel to voxel.
fn add_tubes(parts: &mut Parts, set: &VoxelSet, spacing_m: f64, radius_m: f64, paint: &Paint<'_>) {
    let Ok(network) = CaveNetwork::of_centreline(set, spacing_m) else { return };
    for leg in network.legs() {
        let ends = leg.map(|station| network.stations()[station]);
        let colours = ends.map(|end| paint.at(end.map(|at| at / spacing_m)));
        parts.add_tube(ends, radius_m, colours);
    }
}

fn add_arrows(parts: &mut Parts, lattice: &Lattice, subject: &Subject) {
    let spacing_m = lattice.spacing();
    let top = lattice.size().map(|voxels| voxels as f64 * spacing_m);
    let [length_m, radius_m] = ARROW.map(|share| share * diagonal(top));
    for (mark, at) in marks::of(&subject.places) {
        let inside = match mark {
            Mark::Source => [0.0, 0.0, 1.0],
            Mark::Sink => [0.0, 0.0, -1.0],
        };
        let way = marks::way_out(at, top, spacing_m, inside);
        let outer = [0, 1, 2].map(|axis| at[axis] + way[axis] * length_m);
        let ends = if mark == Mark::Source { [outer, at] } else { [at, outer] };
        parts.add_arrow(ends, radius_m, mark.colour());
    }
}

/// Colours of passages by a field.
struct Paint<'a> {
    set: &'a VoxelSet,
    values: Option<&'a [f64]>,
    map: ColourMap,
    range: [f64; 2],
}

impl<'a> Paint<'a> {
    fn new(
        look: &Passages,
        lattice: &Lattice,
        set: &'a VoxelSet,
        subject: &'a Subject,
        map: ColourMap,
    ) -> Self {
        let values = subject.paint.as_deref();
        let of_passages = || -> Vec<f64> {
            let values = values.unwrap_or_default();
            set.iter().filter_map(|voxel| values.get(lattice.node(voxel)).copied()).collect()
        };
        let range = match look.range {
            Some((low, high)) => [low, high],
            None => flat::finite_range(&of_passages()),
        };
        Self { set, values, map, range }
    }

    /// Colour at a position in voxels: that of the nearest voxel of the set around it.
    fn at(&self, position: [f64; 3]) -> Option<[u8; 3]> {
        let values = self.values?;
        let [width, height, _] = self.set.size();
        // Rows run south.
        let place = [position[0], height as f64 - position[1], position[2]];
        let corner = place.map(|at| (at - 0.5).floor() as isize);
        let around = (0..8_isize).map(|k| [k & 1, k >> 1 & 1, k >> 2]);
        let voxels = around.map(|step| [0, 1, 2].map(|axis| corner[axis] + step[axis]));
        let away = |voxel: [isize; 3]| -> f64 {
            (0..3).map(|axis| (voxel[axis] as f64 + 0.5 - place[axis]).powi(2)).sum()
        };
        let nearest = voxels
            .filter(|&voxel| self.set.holds(voxel))
            .reduce(|a, b| if away(b) < away(a) { b } else { a })?;
        let [column, row, layer] = nearest.map(|at| at as usize);
        let value = *values.get(column + width * (row + height * layer))?;
        let [low, high] = self.range;
        let share = if high == low { 0.5 } else { (value - low) / (high - low) };
        Some(self.map.colour(share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_caves::CavePlaces;
    use landform_graph::{Boundary, Connectivity};

    /// Three voxels in a row that touch at corners only, and their numbers as a second field.
    fn diagonal_channel() -> (Lattice, Subject) {
        let open = [Boundary::Open; 3];
        let lattice = Lattice::volume([5, 5, 5], 2.0, Connectivity::Voxel26, open).unwrap();
        let mut subject = Subject { values: vec![0.0; 125], ..Subject::default() };
        let mut numbers = vec![0.0; 125];
        for step in 1..4 {
            let node = lattice.node([step, step, step]);
            subject.values[node] = 1.0;
            numbers[node] = step as f64;
        }
        subject.paint = Some(numbers);
        (lattice, subject)
    }

    #[test]
    fn tubes_run_through_corners_and_take_the_colours_of_their_voxels() {
        let (lattice, subject) = diagonal_channel();
        let map = ColourMap::named("batlow").unwrap();
        let look = Passages {
            at_least: 1.0,
            tube_radius_m: Some(0.5),
            colour_by: Some("numbers".to_owned()),
            ..Passages::default()
        };
        let parts = super::parts(&look, &lattice, &subject, map);
        let body = parts.body();
        let count =
            |share: f64| body.paint.iter().filter(|&&at| at == Some(map.colour(share))).count();
        // Two tubes of four rings of twelve; the middle voxel has an end of both.
        assert_eq!(body.positions.len(), 2 * 48);
        assert_eq!([0.0, 0.5, 1.0].map(count), [24, 48, 24]);
        // Row 1 is the second from the north: y from 6 to 8 m of 10.
        let lowest = body.positions.iter().map(|at| at[2]).fold(f64::MAX, f64::min);
        let north = body.positions.iter().map(|at| at[1]).fold(f64::MIN, f64::max);
        assert!((2.4..3.0).contains(&lowest) && (7.0..7.6).contains(&north), "{lowest} {north}");
    }

    #[test]
    fn arrows_point_at_sources_and_away_from_sinks() {
        let (lattice, mut subject) = diagonal_channel();
        subject.values.fill(0.0);
        subject.places =
            CavePlaces { sources: vec![[5.0, 5.0, 9.0]], sinks: vec![[9.0, 5.0, 5.0]] };
        let map = ColourMap::named("batlow").unwrap();
        let parts = super::parts(&Passages::default(), &lattice, &subject, map);
        let body = parts.body();
        let extreme = |mark: Mark, axis: usize| {
            let of = body.positions.iter().zip(body.paint);
            of.filter(|(_, paint)| **paint == Some(mark.colour()))
                .map(|(at, _)| at[axis])
                .fold(f64::MIN, f64::max)
        };
        let length_m = 0.11 * 300_f64.sqrt();
        assert!((extreme(Mark::Source, 2) - (9.0 + length_m)).abs() < 1e-9);
        assert!((extreme(Mark::Sink, 0) - (9.0 + length_m)).abs() < 1e-9);
        let frame = frame([10.0; 3]);
        assert!(frame[1][2] > 9.0 + length_m);
        let bare = Passages { marks: false, ..Passages::default() };
        assert!(super::parts(&bare, &lattice, &subject, map).body().positions.is_empty());
    }
}
