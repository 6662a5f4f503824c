//! The output `Figure`: panels of chosen fields and states.

use landform::view::Image;
use landform_tests::{Program, SMALL, Scratch};

/// The small scenario with other outputs.
fn scenario(outputs: &str) -> String {
    let end = SMALL.find("outputs:").expect("outputs");
    format!("{}outputs: [{outputs}])", &SMALL[..end])
}

/// A picture that a run left.
fn picture_of(scratch: &Scratch, file: &str) -> Image {
    Image::read_png(&scratch.path("o").join(file)).expect("a picture").0
}

/// The panel of a figure at a place.
fn cut(figure: &Image, [left, top]: [usize; 2], [width, height]: [usize; 2]) -> Vec<[u8; 3]> {
    let row = |row: usize| &figure.rgb[(top + row) * figure.width + left..][..width];
    (0..height).flat_map(row).copied().collect()
}

#[test]
fn panels_show_the_states_that_are_named() {
    let scratch = Scratch::new("figure");
    let flat = "field: \"sand\", look: Flat(bar: false)";
    let panels = format!("panels: [({flat}), (at: \"smooth\", {flat}), (at: \"wind\", {flat})]");
    scratch.write(
        "f.ron",
        scenario(&format!(
            "Figure(file: \"own.png\", columns: 2, same_colours: false, {panels}),
             Figure(file: \"same.png\", columns: 2, {panels}),
             Picture(file: \"start.png\", when: Start, {flat}), Picture(file: \"end.png\", {flat})"
        )),
    );
    Program::within(scratch.folder()).line("run f.ron -o o").run().good();
    let [own, same, start, end] =
        ["own.png", "same.png", "start.png", "end.png"].map(|file| picture_of(&scratch, file));
    let size = [start.width, start.height];
    assert_eq!(size, [96, 64]);
    let places = [[16, 16], [16 + 96 + 16, 16]];
    assert_eq!(cut(&own, places[0], size), start.rgb);
    assert_eq!(cut(&own, places[1], size), end.rgb);
    assert_eq!([own.width, own.height], [same.width, same.height]);
    // White noise has the wider range: its colours stay, those of the smooth sand change.
    assert_ne!(cut(&same, places[1], size), end.rgb);
}

#[test]
fn two_hypsometric_curves_share_a_panel() {
    let scratch = Scratch::new("figure_curves");
    let panel = |file: &str, since: &str| {
        format!(
            "Figure(file: \"{file}\", panels: [(at: \"smooth\", {since} look: Hypsometry(), \
             caption: \"curve\")])"
        )
    };
    let outputs = [("one.png", ""), ("two.png", "since: \"initial\",")];
    let outputs = outputs.map(|(file, since)| panel(file, since)).join(", ");
    scratch.write("f.ron", scenario(&outputs));
    Program::within(scratch.folder()).line("run f.ron -o o").run().good();
    let [one, two] = ["one.png", "two.png"].map(|file| picture_of(&scratch, file));
    assert_ne!(one.rgb, two.rgb);
}

#[test]
fn figures_that_cannot_be_drawn_are_refused() {
    for (panel, parts) in [
        ("(at: \"smoth\")", &["no stage is called `smoth`", "did you mean \"smooth\"?"][..]),
        ("(since: \"wind\")", &["outputs[0].panels[0].since", "the look Hypsometry"]),
        ("(since: \"winds\", look: Hypsometry())", &["no stage is called `winds`"]),
        ("(field: \"sans\")", &["no field is called `sans`"]),
        ("(look: Flat(colours: \"none\"))", &["outputs[0].panels[0].look"]),
        ("", &["panels"]),
    ] {
        let scratch = Scratch::new("figure_bad");
        scratch.write("f.ron", scenario(&format!("Figure(panels: [{panel}])")));
        let message = Program::within(scratch.folder()).line("run f.ron -o o").run().refused();
        for part in parts {
            assert!(message.contains(part), "{panel}: no `{part}` in\n{message}");
        }
        assert_eq!(scratch.names(), ["f.ron"]);
    }
}
