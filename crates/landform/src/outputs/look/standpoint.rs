//! Where to stand in passages.

use landform_analysis::voxels::{Rule, Turns, VoxelSet, centreline};

/// A place in passages and a bearing, in voxels: x east, y north, z up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Standpoint {
    pub eye: [f64; 3],
    pub bearing_deg: f64,
}

/// Directions that are tried around the compass.
const BEARINGS: usize = 36;

/// Voxels beyond which a view is as good as one without end.
const FAR: f64 = 30.0;

impl Standpoint {
    /// The place itself if it is in a passage, or the middle of the nearest voxel of one, and the
    /// bearing of the longest view from it; nothing where there are no passages.
    pub fn near(set: &VoxelSet, wanted: [f64; 3]) -> Option<Self> {
        let away = |voxel: &[usize; 3]| -> f64 {
            let middle = middle(set, *voxel);
            (0..3).map(|axis| (middle[axis] - wanted[axis]).powi(2)).sum()
        };
        let voxel = set.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
        let eye = if is_open(set, wanted) { wanted } else { middle(set, voxel) };
        let (bearing_deg, _) = longest_view(set, eye);
        Some(Self { eye, bearing_deg })
    }

    /// Where on the centreline, above a height if there is such a place, passages are wide and the
    /// view is long.
    pub fn with_a_view(set: &VoxelSet, above: f64) -> Option<Self> {
        let line: Vec<[f64; 3]> = centreline(set, Turns::Sides, Rule::Supported)
            .iter()
            .map(|voxel| middle(set, voxel))
            .collect();
        let dry: Vec<[f64; 3]> = line.iter().copied().filter(|eye| eye[2] > above).collect();
        let mut best = None;
        for eye in if dry.is_empty() { line } else { dry } {
            let (bearing_deg, view) = longest_view(set, eye);
            let worth = view * room(set, eye);
            if best.is_none_or(|(most, _)| worth > most) {
                best = Some((worth, Self { eye, bearing_deg }));
            }
        }
        best.map(|(_, standpoint)| standpoint)
    }
}

/// The middle of a voxel; rows run south.
fn middle(set: &VoxelSet, [column, row, layer]: [usize; 3]) -> [f64; 3] {
    let [_, height, _] = set.size();
    [column as f64 + 0.5, height as f64 - row as f64 - 0.5, layer as f64 + 0.5]
}

fn is_open(set: &VoxelSet, [x, y, z]: [f64; 3]) -> bool {
    let [_, height, _] = set.size();
    set.holds([x, height as f64 - y, z].map(|at| at.floor() as isize))
}

/// Bearing and length of the longest level view. Its length is the mean of that straight ahead and
/// those a little beside, above and below it, so that a gap in a wall is no view.
fn longest_view(set: &VoxelSet, eye: [f64; 3]) -> (f64, f64) {
    const BESIDE: [[f64; 2]; 5] =
        [[0.0, 0.0], [12.0, 0.0], [-12.0, 0.0], [0.0, 10.0], [0.0, -10.0]];
    let mut longest = (0.0, 0.0);
    for number in 0..BEARINGS {
        let bearing_deg = number as f64 * 360.0 / BEARINGS as f64;
        let view = |[aside, up]: [f64; 2]| view(set, eye, bearing_deg + aside, up);
        let mean = BESIDE.map(view).iter().sum::<f64>() / BESIDE.len() as f64;
        if mean > longest.1 {
            longest = (bearing_deg, mean);
        }
    }
    longest
}

/// Distance to the rock along a bearing and an altitude.
fn view(set: &VoxelSet, eye: [f64; 3], bearing_deg: f64, altitude_deg: f64) -> f64 {
    const STEP: f64 = 0.5;
    let (east, north) = bearing_deg.to_radians().sin_cos();
    let (up, level) = altitude_deg.to_radians().sin_cos();
    let way = [east * level, north * level, up];
    let mut view = 0.0;
    while view < FAR && is_open(set, [0, 1, 2].map(|axis| eye[axis] + view * way[axis])) {
        view += STEP;
    }
    view
}

/// Distance to the nearest rock, along axes and diagonals.
fn room(set: &VoxelSet, eye: [f64; 3]) -> f64 {
    let ways = (0..27).map(|number| [number % 3, number / 3 % 3, number / 9].map(|at| at - 1));
    let free = |way: [i32; 3]| {
        let length = f64::from(way.iter().map(|at| at * at).sum::<i32>()).sqrt();
        let open = |step: &i32| {
            is_open(set, [0, 1, 2].map(|axis| eye[axis] + f64::from(way[axis] * step)))
        };
        (1..=FAR as i32).take_while(open).count() as f64 * length + 0.5
    };
    ways.filter(|way| *way != [0; 3]).map(free).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hall five wide with a passage that goes off to the east, under layers of rock.
    fn hall() -> VoxelSet {
        VoxelSet::new([40, 20, 9], |[x, y, z]| {
            let hall = (2..7).contains(&x) && (6..11).contains(&y) && (1..6).contains(&z);
            hall || ((7..38).contains(&x) && (7..10).contains(&y) && (2..5).contains(&z))
        })
    }

    #[test]
    fn the_eye_stands_where_it_sees_far_and_moves_out_of_rock() {
        let found = Standpoint::with_a_view(&hall(), 0.0).unwrap();
        assert!(is_open(&hall(), found.eye), "{found:?}");
        assert!(found.eye[0] < 9.0 || found.eye[0] > 35.0, "at an end: {found:?}");
        assert!([90.0, 270.0].contains(&found.bearing_deg), "along the passage: {found:?}");
        let in_rock = Standpoint::near(&hall(), [20.0, 1.0, 8.0]).unwrap();
        // Rows 7 to 9 of 20 are 10 to 13 from the south.
        assert_eq!(in_rock.eye[1..], [10.5, 4.5]);
        let inside = Standpoint::near(&hall(), [20.2, 11.0, 3.0]).unwrap();
        assert_eq!(inside.eye, [20.2, 11.0, 3.0]);
        assert!([80.0, 90.0, 270.0, 280.0].contains(&inside.bearing_deg), "{inside:?}");
        let none = VoxelSet::empty([3; 3]);
        assert_eq!(Standpoint::near(&none, [1.0; 3]), None);
        assert_eq!(Standpoint::with_a_view(&none, 0.0), None);
        let high = Standpoint::with_a_view(&hall(), 100.0);
        assert!(high.is_some(), "under water if there is nothing above it");
    }
}
