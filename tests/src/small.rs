//! A small scenario that uses every kind of output.

/// Runs in well under a second.
pub const SMALL: &str = r#"(
    title: "Small dunes",
    seed: 3,
    domain: Grid(size: (48, 32), spacing_m: 10.0, boundary: (Periodic, Periodic)),
    initial: [
        (field: "sand", from: WhiteNoise(mean_m: 20.0, amplitude_m: 5.0)),
    ],
    stages: [
        (name: "wind", processes: [Dunes(slab_m: 3.0, wind_strength_m: 50.0)], stop: Iterations(6)),
        (name: "smooth", processes: [Smoothing()], stop: Iterations(2)),
    ],
    metrics: [FieldStatistic(field: "sand", statistic: Maximum), DuneActivity()],
    outputs: [
        Picture(file: "map.png"),
        Picture(file: "view.png", look: Perspective(size: (96, 64))),
        Panels(file: "panels.png"),
        Animation(file: "growth.apng", every: 2),
        FieldFile(file: "surface.tif"),
        Mesh(file: "surface.glb"),
    ],
)
"#;

/// [`SMALL`] with `from`, which must stand in it once, replaced by `to`.
pub fn changed(from: &str, to: &str) -> String {
    assert_eq!(SMALL.matches(from).count(), 1, "`{from}` stands once in the small scenario");
    SMALL.replacen(from, to, 1)
}
