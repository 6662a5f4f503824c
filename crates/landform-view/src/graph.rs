//! Pictures of graphs: nodes as discs, edges as lines.

use crate::plot::drawing::{Drawing, Place, Shape};
use crate::{Image, ViewError};

/// A node as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GraphNode {
    /// Columns from the west and rows from the north, in spacings.
    pub place: [f64; 2],
    /// Colour of its outline.
    pub colour: [u8; 3],
    /// Whether the disc is filled with that colour; white when not.
    pub filled: bool,
    /// Whether a black ring is drawn round it.
    pub ringed: bool,
}

/// Radius of nodes and of rings round them, in spacings.
const RADIUS: f64 = 0.2;
const RING: f64 = 0.32;

/// Grey of edges.
const EDGE: [u8; 3] = [170, 170, 170];

/// Draws nodes and the edges between them, given by the numbers of their ends.
///
/// # Errors
/// [`ViewError::TooSmall`] without a node and [`ViewError::TooLarge`] for pictures that are too
/// large.
pub fn graph_picture(
    nodes: &[GraphNode],
    edges: &[[usize; 2]],
    pixels_per_spacing: f64,
) -> Result<Image, ViewError> {
    let far = |axis: usize| nodes.iter().map(|node| node.place[axis]).fold(0.0, f64::max);
    let size = [0, 1].map(|axis| far(axis) + 1.0);
    ViewError::check_size(
        "a graph",
        size.map(|spacings| (spacings * pixels_per_spacing) as usize),
        1,
    )?;
    let place = |at: [f64; 2]| -> Place { at.map(|spacings| (spacings + 0.5) as f32) };
    let mut page = Drawing { size: size.map(|side| side as f32), ..Drawing::default() };
    for &[from, to] in edges {
        page.line(place(nodes[from].place), place(nodes[to].place), 0.03, EDGE);
    }
    for node in nodes {
        let (inner, centre) = (if node.filled { node.colour } else { [255; 3] }, node.place);
        page.add(Shape::Fill {
            corners: circle(centre, RADIUS).map(place).collect(),
            colour: inner,
        });
        outline(&mut page, circle(centre, RADIUS).map(place), 0.06, node.colour);
        if node.ringed {
            outline(&mut page, circle(centre, RING).map(place), 0.05, [0; 3]);
        }
    }
    page.image(pixels_per_spacing as f32)
}

fn outline(page: &mut Drawing, places: impl Iterator<Item = Place>, width: f32, colour: [u8; 3]) {
    page.add(Shape::Stroke { places: places.collect(), width, dashes: &[], colour });
}

/// Points round a circle, the last one the first.
fn circle([x, y]: [f64; 2], radius: f64) -> impl Iterator<Item = [f64; 2]> {
    const SIDES: u32 = 40;
    (0..=SIDES).map(move |step| {
        let (sine, cosine) = (f64::from(step) * std::f64::consts::TAU / f64::from(SIDES)).sin_cos();
        [x + radius * cosine, y + radius * sine]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_edges_and_rings_are_where_they_belong() {
        let node = |column: f64, filled: bool, ringed: bool| GraphNode {
            place: [column, 0.0],
            colour: [0, 0, 200],
            filled,
            ringed,
        };
        let nodes = [node(0.0, true, false), node(1.0, false, true)];
        let image = graph_picture(&nodes, &[[0, 1]], 100.0).unwrap();
        assert_eq!([image.width, image.height], [200, 100]);
        assert_eq!(image.pixel(50, 50), [0, 0, 200], "the filled node");
        assert_eq!(image.pixel(150, 50), [255; 3], "the other one");
        assert_eq!(image.pixel(130, 50), [0, 0, 200], "its outline");
        assert_eq!(image.pixel(150, 50 - 32), [0; 3], "its ring");
        assert_eq!(image.pixel(100, 50), EDGE);
        assert_eq!(image.pixel(100, 20), [255; 3]);
    }
}
