//! Two passages that cross, the upper one from west to east.

use super::*;

/// A box with its triangles outwards.
fn cuboid(low: [f64; 3], high: [f64; 3], positions: &mut Vec<[f64; 3]>) -> Vec<[u32; 3]> {
    let first = positions.len() as u32;
    positions.extend((0..8_usize).map(|corner| {
        [0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] })
    }));
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves.map(|of: [u32; 3]| of.map(|vertex| first + vertex)).collect()
}

fn crossing() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut positions = Vec::new();
    let mut triangles = cuboid([2.0, 14.0, 14.0], [38.0, 18.0, 18.0], &mut positions);
    triangles.extend(cuboid([18.0, 2.0, 2.0], [22.0, 28.0, 6.0], &mut positions));
    (positions, triangles)
}

fn options(views: &[CaveView]) -> CaveMapOptions {
    CaveMapOptions {
        views: views.to_vec(),
        pixels_per_m: 5.0,
        colours: ColourMap::named("batlow").unwrap(),
        block: [[0.0; 3], [40.0, 30.0, 20.0]],
        step_m: 1.5,
        marks: Vec::new(),
        words: vec!["62 m long".to_owned()],
    }
}

#[test]
fn walls_are_lines_and_hidden_walls_dashes() {
    let (positions, triangles) = crossing();
    let body = Body { positions: &positions, triangles: &triangles, paint: &[] };
    let plan = walls::draw(&body, CaveView::Plan, &options(&[CaveView::Plan])).unwrap();
    let at = |x: f64, y: f64| {
        let [column, row] = plan.place([x, y, 0.0], 5.0);
        plan.image.pixel(column as usize, row as usize)
    };
    assert_eq!(at(10.0, 22.0), [255; 3], "rock");
    assert_eq!(at(10.0, 14.05), [25; 3], "the southern wall of the upper passage");
    assert_eq!(at(18.05, 8.0), [25; 3], "the western wall of the lower one");
    let upper = at(10.0, 16.0);
    assert!(upper != [255; 3] && upper != at(20.0, 8.0), "tints differ by height");
    // Below the upper passage the wall of the lower one is dashed: ink on some of its pixels only.
    let wall: Vec<[u8; 3]> = (0..16).map(|k| at(18.05, 14.6 + 0.18 * f64::from(k))).collect();
    let dark = wall.iter().filter(|pixel| pixel[0] < 130).count();
    assert!((3..=13).contains(&dark), "{dark} of 16: {wall:?}");
}

#[test]
fn elevations_show_what_is_nearer_to_the_viewer() {
    let (positions, triangles) = crossing();
    let body = Body { positions: &positions, triangles: &triangles, paint: &[] };
    let seen = |view: CaveView, at: [f64; 3]| {
        let drawn = walls::draw(&body, view, &options(&[view])).unwrap();
        let [column, row] = drawn.place(at, 5.0);
        drawn.image.pixel(column as usize, row as usize)
    };
    assert_ne!(seen(CaveView::FromSouth, [10.0, 0.0, 16.0]), [255; 3]);
    assert_ne!(seen(CaveView::FromSouth, [20.0, 0.0, 4.0]), [255; 3]);
    assert_eq!(seen(CaveView::FromSouth, [10.0, 0.0, 4.0]), [255; 3]);
    assert_ne!(seen(CaveView::FromEast, [0.0, 8.0, 4.0]), [255; 3]);
    assert_eq!(seen(CaveView::FromEast, [0.0, 8.0, 16.0]), [255; 3]);
}

#[test]
fn a_sheet_has_signs_and_the_same_bytes_every_time() {
    let (positions, triangles) = crossing();
    let body = Body { positions: &positions, triangles: &triangles, paint: &[] };
    let views = [CaveView::Plan, CaveView::FromSouth, CaveView::FromEast];
    let bare = draw(&body, &options(&views)).unwrap();
    let marks = vec![(Mark::Source, [3.0, 16.0, 18.0]), (Mark::Sink, [20.0, 2.0, 4.0])];
    let marked = CaveMapOptions { marks, ..options(&views) };
    let sheet = draw(&body, &marked).unwrap();
    let count = |image: &Image, mark: Mark| {
        image.rgb.iter().filter(|&&pixel| pixel == mark.colour()).count()
    };
    for mark in [Mark::Source, Mark::Sink] {
        // In each view and beside them.
        assert_eq!(count(&bare, mark), 0);
        assert!(count(&sheet, mark) > 4 * 60, "{}", count(&sheet, mark));
    }
    assert_eq!(sheet, draw(&body, &marked).unwrap());
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let body = Body { positions: &[], triangles: &[], paint: &[] };
    let said = |options: CaveMapOptions| draw(&body, &options).unwrap_err().to_string();
    assert!(said(options(&[])).contains("views"));
    let plan = || options(&[CaveView::Plan]);
    assert!(said(CaveMapOptions { pixels_per_m: 0.0, ..plan() }).contains("pixels_per_m"));
    assert!(said(CaveMapOptions { pixels_per_m: 1e6, ..plan() }).contains("pixels"));
    assert!(said(CaveMapOptions { block: [[0.0; 3]; 2], ..plan() }).contains("block"));
    draw(&body, &plan()).unwrap();
}
