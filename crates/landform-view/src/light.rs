//! Light: colours in linear light, the sun, and what falls on a slope.

use crate::ViewError;

/// Red, green and blue in linear light; 1 is white.
pub(crate) type Rgb = [f32; 3];

/// Linear light of an 8-bit sRGB value (IEC 61966-2-1).
pub(crate) fn decode(value: u8) -> f32 {
    let value = f32::from(value) / 255.0;
    match value <= 0.04045 {
        true => value / 12.92,
        false => ((value + 0.055) / 1.055).powf(2.4),
    }
}

/// sRGB value in [0, 255], not yet rounded, of a linear value.
fn encode(value: f32) -> f32 {
    let value = value.clamp(0.0, 1.0);
    255.0
        * match value <= 0.003_130_8 {
            true => value * 12.92,
            false => 1.055 * value.powf(1.0 / 2.4) - 0.055,
        }
}

/// The pixel of a linear colour. A 4 x 4 ordered dither hides the steps of 8 bits in skies and
/// on smooth slopes; it depends on the place of the pixel alone, so still pictures stay still.
pub(crate) fn quantise(colour: Rgb, column: usize, row: usize) -> [u8; 3] {
    const BAYER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
    let threshold = (f32::from(BAYER[row % 4][column % 4]) + 0.5) / 16.0;
    colour.map(|channel| (encode(channel) + threshold) as u8)
}

/// Linear mixture of two colours.
pub(crate) fn mix(first: Rgb, second: Rgb, share: f32) -> Rgb {
    std::array::from_fn(|channel| first[channel] + (second[channel] - first[channel]) * share)
}

/// Product of two colours, channel by channel.
pub(crate) fn tint(first: Rgb, second: Rgb) -> Rgb {
    std::array::from_fn(|channel| first[channel] * second[channel])
}

/// Compresses highlights: the identity up to 0.8, then a smooth approach to 1.
pub(crate) fn shoulder(colour: Rgb) -> Rgb {
    const KNEE: f32 = 0.8;
    colour.map(|channel| match channel <= KNEE {
        true => channel,
        false => 1.0 - (1.0 - KNEE) * (-(channel - KNEE) / (1.0 - KNEE)).exp(),
    })
}

/// 0 below the first edge, 1 above the second, smooth between (cubic).
pub(crate) fn smooth_step(low: f32, high: f32, value: f32) -> f32 {
    let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// What lights a scene: the sun, the sky, and the light that the ground throws back.
///
/// Colours are 8-bit sRGB, strengths are linear: a slope that faces the sun with nothing in
/// its way receives `sun + sky`, and a strength of 1 shows the colours of the map as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Compass bearing of the sun in degrees: clockwise from north, 270 is the west.
    pub bearing_deg: f64,
    /// Altitude of the sun above the horizon in degrees, from 0.1 to 90.
    pub altitude_deg: f64,
    /// Colour of the sun.
    pub sun_colour: [u8; 3],
    /// Strength of the sun.
    pub sun: f64,
    /// Half of the width of shadow edges in degrees; the true sun has 0.27.
    pub penumbra_deg: f64,
    /// How dark cast shadows are: 0 none, 1 no sun at all.
    pub shadow: f64,
    /// Colour of the sky's light.
    pub sky_colour: [u8; 3],
    /// Strength of the sky's light.
    pub sky: f64,
    /// How much of the sun comes from all sides instead of from its own bearing, from 0 to 1:
    /// slopes that face away stay readable (multidirectional hill shading, Mark 1992, USGS
    /// Open-File Report 92-422).
    pub spread: f64,
}

impl Light {
    /// Nearly white light from the north-west, as maps are shaded: a low sun from above left is
    /// what makes valleys look like valleys, and soft shadows leave the colours of the map legible.
    pub fn map() -> Self {
        Self {
            bearing_deg: 315.0,
            altitude_deg: 40.0,
            sun_colour: [255, 250, 240],
            sun: 0.95,
            penumbra_deg: 3.0,
            shadow: 0.6,
            sky_colour: [225, 236, 255],
            sky: 0.42,
            spread: 0.3,
        }
    }

    /// A warm low sun under a blue sky, for perspective views. Slip faces at the angle of repose
    /// (about 33 degrees) that face away from this sun lie in their own shadow.
    pub fn low_sun() -> Self {
        Self {
            bearing_deg: 290.0,
            altitude_deg: 28.0,
            sun_colour: [255, 232, 200],
            sun: 1.65,
            penumbra_deg: 0.8,
            shadow: 1.0,
            sky_colour: [150, 184, 250],
            sky: 0.5,
            spread: 0.0,
        }
    }

    /// Checks every range.
    pub(crate) fn check(&self) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        check("light.bearing_deg", self.bearing_deg, [-1e6, 1e6], "a bearing in degrees")?;
        check("light.altitude_deg", self.altitude_deg, [0.1, 90.0], "from 0.1 to 90")?;
        check("light.sun", self.sun, [0.0, 100.0], "from 0 to 100")?;
        check("light.penumbra_deg", self.penumbra_deg, [0.0, 45.0], "from 0 to 45")?;
        check("light.shadow", self.shadow, [0.0, 1.0], "from 0 to 1")?;
        check("light.sky", self.sky, [0.0, 100.0], "from 0 to 100")?;
        check("light.spread", self.spread, [0.0, 1.0], "from 0 to 1")
    }

    /// Unit vector towards the sun: east, north, up.
    pub(crate) fn direction(&self) -> [f64; 3] {
        direction(self.bearing_deg, self.altitude_deg)
    }
}

/// Unit vector of a compass bearing and an altitude: east, north, up.
pub(crate) fn direction(bearing_deg: f64, altitude_deg: f64) -> [f64; 3] {
    let (east, north) = bearing_deg.to_radians().sin_cos();
    let (up, level) = altitude_deg.to_radians().sin_cos();
    [east * level, north * level, up]
}
