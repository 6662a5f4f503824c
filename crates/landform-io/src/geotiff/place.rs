//! The georeference as tags: pixel scale, tie point, transformation and GeoKeys.

use crate::georeference::GeoKeys;
use crate::{CoordinateKind, CoordinateSystem, Fault, Georeference, Registration};

/// What the tags say, as far as they are there.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tags {
    /// 33550: cell size along x, y, z.
    pub pixel_scale: Vec<f64>,
    /// 33922: six numbers for each point: column, row, layer, x, y, z.
    pub tie_points: Vec<f64>,
    /// 34264: sixteen numbers by rows.
    pub transformation: Vec<f64>,
    /// 34735, 34736 and 34737.
    pub keys: GeoKeys,
}

const MODEL_TYPE: u16 = 1024;
const RASTER_TYPE: u16 = 1025;
const CITATIONS: [u16; 3] = [1026, 2049, 3073];
const GEOGRAPHIC_SYSTEM: u16 = 2048;
const PROJECTED_SYSTEM: u16 = 3072;
const LINEAR_UNIT: u16 = 3076;
const LINEAR_UNIT_SIZE: u16 = 3077;
const POINT: u16 = 2;
const METRE: u16 = 9001;
/// The value of a key that is described by other keys.
const USER_DEFINED: u16 = 32767;

impl Tags {
    /// The georeference; `None` when no tag places the raster.
    pub fn georeference(self) -> Result<Option<Georeference>, Fault> {
        let Some([x, y, size_x, size_y]) = self.corner()? else { return Ok(None) };
        if !(size_x > 0.0 && size_y > 0.0 && [x, y, size_x, size_y].iter().all(|v| v.is_finite())) {
            let problem = format!("cells of {size_x} x {size_y} at {x}, {y}");
            let advice = "correct the pixel scale and the tie point";
            return Err(Fault::new(problem, "positive finite sizes and a finite place", advice));
        }
        let registration = match self.keys.short(RASTER_TYPE) {
            Some(POINT) => Registration::Point,
            _ => Registration::Area,
        };
        let shift = if registration == Registration::Point { 0.5 } else { 0.0 };
        Ok(Some(Georeference {
            west: x - shift * size_x,
            north: y + shift * size_y,
            cell_size: [size_x, size_y],
            registration,
            coordinate_system: self.keys.coordinate_system(),
        }))
    }

    /// x and y at raster position (0, 0), and the cell size.
    fn corner(&self) -> Result<Option<[f64; 4]>, Fault> {
        let unrotated = |problem: &str| {
            let advice = "warp the raster to a north-up grid, for example with gdalwarp";
            Fault::new(problem, "rows that run east and columns that run south", advice)
        };
        if let [a, b, c, x, d, e, f, y, ..] = self.transformation[..] {
            if [b, c, d, f].iter().any(|&term| term != 0.0) || e >= 0.0 {
                return Err(unrotated("the transformation rotates or flips the raster"));
            }
            return Ok(Some([x, y, a, -e]));
        }
        match (&self.pixel_scale[..], &self.tie_points[..]) {
            ([size_x, size_y, ..], [column, row, _, x, y, _, ..]) => {
                Ok(Some([x - column * size_x, y + row * size_y, *size_x, *size_y]))
            }
            ([], [_, _, _, _, _, _, ..]) => Err(unrotated("the raster has ground control points")),
            _ => Ok(None),
        }
    }

    /// The tags of a georeference.
    pub fn of(place: &Georeference) -> Self {
        let [size_x, size_y] = place.cell_size;
        let shift = if place.registration == Registration::Point { 0.5 } else { 0.0 };
        let x = place.west + shift * size_x;
        let y = place.north - shift * size_y;
        let own = place.coordinate_system.keys.clone();
        Self {
            pixel_scale: vec![size_x, size_y, 0.0],
            tie_points: vec![0.0, 0.0, 0.0, x, y, 0.0],
            transformation: Vec::new(),
            keys: own.map_or_else(|| GeoKeys::of(place), GeoKeys::in_ascii),
        }
    }
}

impl GeoKeys {
    fn entries(&self) -> impl Iterator<Item = &[u16; 4]> {
        // The first four numbers are the version and the count.
        self.directory.as_chunks().0.iter().skip(1)
    }

    /// A key whose value stands in the directory itself.
    fn short(&self, key: u16) -> Option<u16> {
        self.entries().find(|entry| entry[0] == key && entry[1] == 0).map(|entry| entry[3])
    }

    fn double(&self, key: u16) -> Option<f64> {
        let entry = self.entries().find(|entry| entry[0] == key && entry[1] == 34736)?;
        self.doubles.get(usize::from(entry[3])).copied()
    }

    fn text(&self, key: u16) -> Option<&str> {
        let entry = self.entries().find(|entry| entry[0] == key && entry[1] == 34737)?;
        let [count, start] = [entry[2], entry[3]].map(usize::from);
        self.text.get(start..start + count).map(|text| text.trim_end_matches(['|', '\0']))
    }

    fn coordinate_system(self) -> CoordinateSystem {
        if self.directory.is_empty() {
            return CoordinateSystem::default();
        }
        let kind = match self.short(MODEL_TYPE) {
            Some(1) => CoordinateKind::Projected { metres_per_unit: self.metres_per_unit() },
            Some(2) => CoordinateKind::Geographic,
            _ => CoordinateKind::Unknown,
        };
        let system = match kind {
            CoordinateKind::Geographic => self.short(GEOGRAPHIC_SYSTEM),
            _ => self.short(PROJECTED_SYSTEM),
        };
        let epsg = system.filter(|&number| number != USER_DEFINED && number != 0);
        let text = CITATIONS.iter().find_map(|&key| self.text(key)).map(str::to_string);
        CoordinateSystem { kind, epsg, text, keys: Some(self) }
    }

    /// The linear unit: metre, foot, US survey foot, or a size given beside.
    fn metres_per_unit(&self) -> f64 {
        let size = match self.short(LINEAR_UNIT) {
            Some(9002) => Some(0.3048),
            Some(9003) => Some(1200.0 / 3937.0),
            Some(USER_DEFINED) => self.double(LINEAR_UNIT_SIZE),
            _ => None,
        };
        size.filter(|size| *size > 0.0 && size.is_finite()).unwrap_or(1.0)
    }

    /// The same keys with a text that a tag can hold. Keys point at bytes of the text, so each
    /// other byte becomes one letter.
    fn in_ascii(mut self) -> Self {
        let letter = |byte: u8| if byte.is_ascii() && byte != 0 { char::from(byte) } else { '?' };
        self.text = self.text.bytes().map(letter).collect();
        self
    }

    /// Keys for a system that comes from elsewhere.
    fn of(place: &Georeference) -> Self {
        let system = &place.coordinate_system;
        let (model, key) = match system.kind {
            CoordinateKind::Geographic => (Some(2), GEOGRAPHIC_SYSTEM),
            CoordinateKind::Projected { .. } => (Some(1), PROJECTED_SYSTEM),
            CoordinateKind::Unknown => (system.epsg.map(|_| 1), PROJECTED_SYSTEM),
        };
        let raster = if place.registration == Registration::Point { POINT } else { 1 };
        let mut entries: Vec<[u16; 4]> = Vec::new();
        entries.extend(model.map(|model| [MODEL_TYPE, 0, 1, model]));
        entries.push([RASTER_TYPE, 0, 1, raster]);
        let mut text = String::new();
        let citation = system.text.as_deref().filter(|text| text.is_ascii() && text.len() < 4096);
        if let Some(citation) = citation {
            text = format!("{}|", citation.replace('|', "/"));
            entries.push([CITATIONS[0], 34737, text.len() as u16, 0]);
        }
        entries.extend(model.map(|_| [key, 0, 1, system.epsg.unwrap_or(USER_DEFINED)]));
        let mut doubles = Vec::new();
        match system.kind {
            CoordinateKind::Projected { metres_per_unit: 1.0 } => {
                entries.push([LINEAR_UNIT, 0, 1, METRE]);
            }
            CoordinateKind::Projected { metres_per_unit } => {
                entries.push([LINEAR_UNIT, 0, 1, USER_DEFINED]);
                entries.push([LINEAR_UNIT_SIZE, 34736, 1, 0]);
                doubles.push(metres_per_unit);
            }
            CoordinateKind::Geographic | CoordinateKind::Unknown => {}
        }
        let header = [1, 1, 0, entries.len() as u16];
        let directory = std::iter::once(header).chain(entries).flatten().collect();
        Self { directory, doubles, text }
    }
}
