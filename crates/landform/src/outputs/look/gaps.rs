//! Nodes outside the map in pictures.

use std::borrow::Cow;

use landform_sim::outside::Outside;
use landform_view::Image;

/// Colour of a map where it has ended.
const PAPER: [u8; 3] = [255; 3];

/// Paints the nodes outside a map of `size` nodes white.
pub(super) fn paint(outside: &Outside, [width, height]: [usize; 2], map: &mut Image) {
    if outside.is_empty() {
        return;
    }
    let mut is_outside = vec![false; width * height];
    outside.nodes().for_each(|node| is_outside[node] = true);
    let (columns, rows) = (map.width, map.height);
    for (pixel, colour) in map.rgb.iter_mut().enumerate() {
        let [column, row] = [pixel % columns * width / columns, pixel / columns * height / rows];
        if is_outside[column + width * row] {
            *colour = PAPER;
        }
    }
}

/// Heights that end at the edge of the map in a cliff down to the lowest of them.
pub(super) fn cut_off<'v>(outside: &Outside, values: &'v [f64]) -> Cow<'v, [f64]> {
    if outside.is_empty() {
        return Cow::Borrowed(values);
    }
    let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
    let mut cut = values.to_vec();
    outside.nodes().for_each(|node| cut[node] = lowest);
    Cow::Owned(cut)
}

/// Values that are missing outside the map.
pub(super) fn blank<'v>(outside: &Outside, values: &'v [f64]) -> Cow<'v, [f64]> {
    if outside.is_empty() {
        return Cow::Borrowed(values);
    }
    let mut left = values.to_vec();
    outside.blank(&mut left);
    Cow::Owned(left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use landform_graph::{Boundary, Connectivity, Lattice};

    #[test]
    fn what_lies_outside_is_paper_a_cliff_or_nothing() {
        let open = [Boundary::Open; 2];
        let lattice = Lattice::plane([2, 1], 1.0, Connectivity::Four, open).unwrap();
        let outside = Outside::new(&lattice, &[false, true]);
        let mut map = Image::filled(6, 3, [9; 3]).unwrap();
        paint(&outside, [2, 1], &mut map);
        assert_eq!(map.rgb[..6], [[9; 3], [9; 3], [9; 3], PAPER, PAPER, PAPER]);
        assert_eq!(*cut_off(&outside, &[5.0, 7.0]), [5.0, 5.0]);
        assert!(blank(&outside, &[5.0, 7.0])[1].is_nan());
        paint(&Outside::default(), [2, 1], &mut map);
        assert_eq!(map.rgb[0], [9; 3]);
    }
}
