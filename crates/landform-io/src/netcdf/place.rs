//! Coordinates of nodes, with the attributes of the CF conventions.

use super::layout::{Axis, Variable};
use crate::georeference::CoordinateKind;
use crate::{CoordinateSystem, Georeference};

/// The axes `y` (from the north) and `x` of a raster of `size` columns and rows, with the
/// coordinates of the middle of each cell, and the variable of its coordinate system if it is
/// a known one.
pub fn axes(place: &Georeference, size: [usize; 2]) -> ([Axis; 2], Option<Variable>) {
    let [columns, rows] = size;
    let [wide, high] = place.cell_size;
    let x = (0..columns).map(|column| place.west + (column as f64 + 0.5) * wide);
    let y = (0..rows).map(|row| place.north - (row as f64 + 0.5) * high);
    let [x_variable, y_variable] = variables(place, size);
    let axes = [
        Axis { variable: y_variable.text("axis", "Y"), values: y.collect() },
        Axis { variable: x_variable.text("axis", "X"), values: x.collect() },
    ];
    (axes, system(&place.coordinate_system))
}

fn variables(place: &Georeference, size: [usize; 2]) -> [Variable; 2] {
    let [x, y] = ["x", "y"].map(Variable::new);
    if place.is_geographic(size) {
        return [
            x.text("standard_name", "longitude").text("units", "degrees_east"),
            y.text("standard_name", "latitude").text("units", "degrees_north"),
        ];
    }
    let unit = match place.coordinate_system.kind {
        CoordinateKind::Projected { metres_per_unit } if metres_per_unit != 1.0 => {
            format!("{metres_per_unit} m")
        }
        _ => "m".to_owned(),
    };
    let [x, y] = match is_known(&place.coordinate_system) {
        true => [
            x.text("standard_name", "projection_x_coordinate"),
            y.text("standard_name", "projection_y_coordinate"),
        ],
        false => [
            x.text("long_name", "distance from the western border"),
            y.text("long_name", "distance from the southern border"),
        ],
    };
    [x.text("units", &unit), y.text("units", &unit)]
}

fn is_known(system: &CoordinateSystem) -> bool {
    system.epsg.is_some() || system.text.is_some()
}

/// The coordinate system as GDAL and its descendants look for it.
fn system(system: &CoordinateSystem) -> Option<Variable> {
    let code = system.epsg.map(|epsg| format!("EPSG:{epsg}"));
    let text = system.text.clone().or(code.clone())?;
    let variable = Variable::new("crs").text("spatial_ref", &text);
    Some(variable.text("epsg_code", &code.unwrap_or_default()))
}
