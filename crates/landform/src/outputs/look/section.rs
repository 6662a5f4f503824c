//! A section: ground and water along a line across the map.

use landform_sim::parameters::Problem;
use landform_view::plot::{Area, Axis, Figure, Line, Panel, Point, Series};
use landform_view::{HeightField, ViewError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::profile::{Profile, ground_areas, water_areas};
use super::subject::{Subject, WaterDepths, water_of};

/// Ground and water along a straight line across the map, with axes in metres. The ground is filled,
/// water is blue, and the title says by how much heights are exaggerated.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Section {
    /// Where the line begins: share of the way from the western to the eastern nodes, and from the
    /// southern to the northern ones.
    pub from: [f64; 2],
    /// Where it ends, likewise.
    pub to: [f64; 2],
    /// Width and height of the plot.
    #[schemars(extend("x-unit" = "pixels"))]
    pub size: (usize, usize),
    /// Factor of heights; without it the largest round one that fits the plot.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub vertical_exaggeration: Option<f64>,
    /// Lowest and highest height that is drawn; those along the line when missing. Where a plot has
    /// room for more, it shows more.
    #[schemars(extend("x-unit" = "m"))]
    pub range_m: Option<(f64, f64)>,
    /// Elevation of a water surface; none when missing.
    #[schemars(extend("x-unit" = "m"))]
    pub water_level_m: Option<f64>,
    /// Water of a field of depths over the heights; none when missing.
    pub water: Option<WaterDepths>,
}

impl Default for Section {
    fn default() -> Self {
        Self {
            from: [0.0, 0.5],
            to: [1.0, 0.5],
            size: (1024, 448),
            vertical_exaggeration: None,
            range_m: None,
            water_level_m: None,
            water: None,
        }
    }
}

/// Pixels for each unit of the plot: its letters are as large as those of other looks.
const PIXELS_PER_UNIT: f64 = 1.5;
/// Share of a panel that axes, numbers and title leave to its plot, across and down: a little less
/// than they do, so that a plot of the chosen exaggeration always fits.
const ROOM: [f64; 2] = [0.84, 0.72];
/// Exaggerations that are round, times powers of ten.
const ROUND: [f64; 7] = [7.0, 5.0, 4.0, 3.0, 2.0, 1.5, 1.0];
/// Colour of the ground.
const EARTH: [u8; 3] = [201, 178, 143];
/// Colour of water.
const BLUE: [u8; 3] = [116, 169, 207];
/// Number of the dark colour among those of series.
const DARK: usize = 6;

impl Section {
    /// Refuses lines that are none.
    pub(super) fn check(&self) -> Result<(), Problem> {
        for (name, place) in [("look.from", self.from), ("look.to", self.to)] {
            if !place.iter().all(|share| (0.0..=1.0).contains(share)) {
                let message = format!("{place:?} lies outside the map");
                return Err(Problem::new(name, message, "two shares from 0 to 1"));
            }
        }
        if self.from == self.to {
            return Err(Problem::new("look.to", "the line has no length", "another place"));
        }
        match self.range_m {
            Some((low, high)) if !(low < high && (high - low).is_finite()) => {
                let message = format!("heights from {low} to {high} m");
                Err(Problem::new("look.range_m", message, "a lower and a higher height"))
            }
            _ => Ok(()),
        }
    }

    /// The plot of a field of `[columns, rows]` nodes, `spacing_m` apart.
    pub(super) fn figure(
        &self,
        size: [usize; 2],
        spacing_m: f64,
        subject: &Subject,
    ) -> Result<Figure, ViewError> {
        let profile = self.profile(size, spacing_m, subject)?;
        let (range, exaggeration) = self.scale(&profile);
        let line = profile.distances_m.iter().zip(&profile.heights_m);
        let line = line.map(|(&x, &height)| Point::new(x, height)).collect();
        let ground = Series {
            line: Some(Line::Solid),
            colour: Some(DARK),
            width: Some(1.0),
            ..Series::new("", line)
        };
        let areas = |found: Vec<Vec<[f64; 2]>>, colour| {
            found.into_iter().map(move |corners| Area { corners, colour })
        };
        let ground_areas = areas(ground_areas(&profile, range[0]), EARTH);
        let axis = |label: &str, range| Axis { range: Some(range), ..Axis::linear(label) };
        let panel = Panel {
            title: Self::title(exaggeration),
            x: axis("distance (m)", [0.0, profile.length_m()]),
            y: axis("height (m)", range),
            areas: ground_areas.chain(areas(water_areas(&profile), BLUE)).collect(),
            series: vec![ground],
            exaggeration: Some(exaggeration),
            ..Panel::default()
        };
        let (width, height) = self.size;
        Ok(Figure {
            panels: vec![panel],
            columns: 1,
            panel_size: [width, height].map(|side| side as f64 / PIXELS_PER_UNIT),
            pixels_per_unit: PIXELS_PER_UNIT,
            ..Figure::default()
        })
    }

    /// What the plot says in numbers.
    pub(super) fn numbers(
        &self,
        size: [usize; 2],
        spacing_m: f64,
        values: &[f64],
    ) -> Option<String> {
        let subject = Subject { values: values.to_vec(), ..Subject::default() };
        let bare = Self { water: None, water_level_m: None, ..self.clone() };
        let profile = bare.profile(size, spacing_m, &subject).ok()?;
        Some(Self::title(bare.scale(&profile).1))
    }

    fn title(exaggeration: f64) -> String {
        match exaggeration {
            1.0 => "true to scale".to_owned(),
            times => format!("heights exaggerated {times} times"),
        }
    }

    /// Heights and water levels along the line.
    fn profile(
        &self,
        [width, height]: [usize; 2],
        spacing_m: f64,
        subject: &Subject,
    ) -> Result<Profile, ViewError> {
        let Subject { values, outside, .. } = subject;
        let bare = HeightField::new(width, height, spacing_m, values)?;
        let field = subject.water.as_deref().map_or(Ok(bare), |depths| bare.with_water(depths))?;
        let water = water_of(self.water_level_m, self.water.as_ref());
        let mut levels = water.map(|water| water.surface_heights(&field)).transpose()?;
        let mut heights = values.clone();
        outside.blank(&mut heights);
        if let Some(levels) = &mut levels {
            outside.blank(levels);
        }
        let ends = [self.from, self.to]
            .map(|[east, north]| [east * (width - 1) as f64, (1.0 - north) * (height - 1) as f64]);
        Ok(Profile::along(ends, [width, height], spacing_m, &heights, levels.as_deref()))
    }

    /// The range of heights and the exaggeration.
    fn scale(&self, profile: &Profile) -> ([f64; 2], f64) {
        let room = [self.size.0 as f64 * ROOM[0], self.size.1 as f64 * ROOM[1]];
        let room_aspect = room[1] / room[0];
        let [low, high] = self.range_m.map_or_else(|| profile.range(), <[f64; 2]>::from);
        let length = profile.length_m();
        let exaggeration = self.vertical_exaggeration.unwrap_or_else(|| {
            let most = room_aspect * length / (high - low);
            let power = 10_f64.powf(most.log10().floor());
            // Rounding may leave a power that is a little too large.
            let round = ROUND.iter().map(|step| step * power).find(|&round| round <= most);
            round.unwrap_or(power)
        });
        let missing = room_aspect * length / exaggeration - (high - low);
        let more = 0.5 * missing.max(0.0);
        ([low - more, high + more], exaggeration)
    }
}
