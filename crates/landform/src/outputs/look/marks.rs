//! Signs of where water comes in and goes out of caves.

use landform_caves::CavePlaces;
use landform_view::mark::Mark;

/// The sources and sinks with their signs, in metres.
pub(super) fn of(places: &CavePlaces) -> Vec<(Mark, [f64; 3])> {
    let sources = places.sources.iter().map(|&at| (Mark::Source, at));
    sources.chain(places.sinks.iter().map(|&at| (Mark::Sink, at))).collect()
}

/// The way out of a block at a place: up where nothing else is nearer, or below a top that is at most
/// `near_m` away; else through the side or the floor that is.
pub(super) fn way_out(at: [f64; 3], top: [f64; 3], near_m: f64, inside: [f64; 3]) -> [f64; 3] {
    if top[2] - at[2] <= near_m {
        return [0.0, 0.0, 1.0];
    }
    for axis in [0, 1, 2] {
        let mut way = [0.0; 3];
        if at[axis] <= near_m {
            way[axis] = -1.0;
            return way;
        }
        if top[axis] - at[axis] <= near_m {
            way[axis] = 1.0;
            return way;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_lead_out_through_the_nearest_side() {
        let top = [10.0, 20.0, 5.0];
        let way = |at| way_out(at, top, 1.0, [0.0; 3]);
        assert_eq!(way([0.5, 19.5, 4.5]), [0.0, 0.0, 1.0]);
        assert_eq!(way([0.5, 10.0, 2.0]), [-1.0, 0.0, 0.0]);
        assert_eq!(way([5.0, 19.5, 2.0]), [0.0, 1.0, 0.0]);
        assert_eq!(way([5.0, 10.0, 0.5]), [0.0, 0.0, -1.0]);
        assert_eq!(way([5.0, 10.0, 2.5]), [0.0; 3]);
    }
}
