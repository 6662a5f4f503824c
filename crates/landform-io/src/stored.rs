//! Values as the numbers that a file stores.

use std::borrow::Cow;

use crate::{Encoding, Fault, Raster, SampleType};

/// The numbers to store for a raster, and how to read them back.
pub(crate) struct Stored<'a> {
    pub numbers: Cow<'a, [f64]>,
    pub encoding: Encoding,
}

/// Values at or beyond this cannot be kept in a single.
const LARGEST_SINGLE: f64 = f32::MAX as f64;

/// The numbers of `raster` for a sample type, with `value = offset + scale * number`. Missing
/// cells get the raster's own no-data value; else NaN in floating point, or the least whole
/// number that is free.
pub(crate) fn stored(
    raster: &Raster,
    sample: SampleType,
    [scale, offset]: [f64; 2],
) -> Result<Stored<'_>, Fault> {
    raster.check_size()?;
    if !(scale.is_finite() && scale != 0.0 && offset.is_finite()) {
        let problem = format!("scale {scale} and offset {offset}");
        let advice = "give a finite scale that is not zero and a finite offset";
        return Err(Fault::new(problem, "stored numbers that can be read back", advice));
    }
    let range = sample.integer_range();
    let bounds = range.unwrap_or(match sample {
        SampleType::F32 => [-LARGEST_SINGLE, LARGEST_SINGLE],
        _ => [-f64::MAX, f64::MAX],
    });
    let plain = scale == 1.0 && offset == 0.0;
    let number = |value: f64| match (plain, range.is_some()) {
        (true, false) => value,
        (_, false) => (value - offset) / scale,
        (_, true) => ((value - offset) / scale).round(),
    };
    check_bounds(raster, bounds, number)?;
    let mark = mark(raster, range, number)?;
    let encoding = Encoding { scale, offset, no_data: mark };
    if plain && range.is_none() && mark.is_none() {
        return Ok(Stored { numbers: Cow::Borrowed(&raster.values), encoding });
    }
    let mark = mark.unwrap_or(f64::NAN);
    let numbers = raster.values.iter().map(|&v| if v.is_nan() { mark } else { number(v) });
    Ok(Stored { numbers: Cow::Owned(numbers.collect()), encoding })
}

fn check_bounds(
    raster: &Raster,
    [least, most]: [f64; 2],
    number: impl Fn(f64) -> f64,
) -> Result<(), Fault> {
    let outside = |&value: &f64| {
        !value.is_nan() && !(value.is_finite() && (least..=most).contains(&number(value)))
    };
    let Some(cell) = raster.values.iter().position(|value| outside(value)) else {
        return Ok(());
    };
    let value = raster.values[cell];
    let problem = format!("the value {value} would be stored as {}", number(value));
    let advice = "choose a wider sample type, or another scale and offset";
    Err(Fault::new(problem, format!("{least}..{most}"), advice).at(raster.place(cell)))
}

/// The stored number of missing cells; `None` for NaN, or when nothing is missing.
fn mark(
    raster: &Raster,
    range: Option<[f64; 2]>,
    number: impl Fn(f64) -> f64,
) -> Result<Option<f64>, Fault> {
    let missing = raster.values.iter().any(|value| value.is_nan());
    let taken = |mark: f64| raster.values.iter().any(|&value| number(value) == mark);
    let fits = |mark: f64| match range {
        None => mark.is_finite(),
        Some([least, most]) => (least..=most).contains(&mark) && mark.fract() == 0.0,
    };
    let own = raster.no_data.filter(|&mark| fits(mark) && !(missing && taken(mark)));
    if own.is_some() || !missing {
        return Ok(own);
    }
    let Some([least, most]) = range else { return Ok(None) };
    let free = [least, most, -9999.0].into_iter().find(|&mark| fits(mark) && !taken(mark));
    free.map(Some).ok_or_else(|| {
        let problem = "all candidates for the no-data number occur as values";
        Fault::new(problem, "a free number", "choose a wider sample type, or set `no_data`")
    })
}
