//! Values as the numbers that a file stores.

use std::borrow::Cow;

use crate::{Encoding, Fault, Raster, SampleType};

/// The numbers to store for a raster, and how to read them back.
#[derive(Debug)]
pub(crate) struct Stored<'a> {
    pub numbers: Cow<'a, [f64]>,
    pub encoding: Encoding,
}

/// The numbers of `raster` for a sample type, with `value = offset + scale * number`. Missing
/// cells get the raster's own no-data number if it fits and is free, else the first free one
/// of `marks`.
pub(crate) fn stored<'a>(
    raster: &'a Raster,
    sample: SampleType,
    [scale, offset]: [f64; 2],
    marks: &[f64],
) -> Result<Stored<'a>, Fault> {
    raster.check_size()?;
    if !(scale.is_finite() && scale != 0.0 && offset.is_finite()) {
        let problem = format!("scale {scale} and offset {offset}");
        let advice = "give a finite scale that is not zero and a finite offset";
        return Err(Fault::new(problem, "stored numbers that can be read back", advice));
    }
    let plain = scale == 1.0 && offset == 0.0;
    let number = |value: f64| match plain {
        true => sample.nearest(value),
        false => sample.nearest((value - offset) / scale),
    };
    check_range(raster, sample, number)?;
    let no_data = mark(raster, sample, marks, number)?;
    let encoding = Encoding { scale, offset, no_data };
    if plain && sample == SampleType::F64 && no_data.is_none() {
        return Ok(Stored { numbers: Cow::Borrowed(&raster.values), encoding });
    }
    let mark = no_data.unwrap_or(f64::NAN);
    let numbers = raster.values.iter().map(|&v| if v.is_nan() { mark } else { number(v) });
    Ok(Stored { numbers: Cow::Owned(numbers.collect()), encoding })
}

fn check_range(
    raster: &Raster,
    sample: SampleType,
    number: impl Fn(f64) -> f64,
) -> Result<(), Fault> {
    let [least, most] = sample.range();
    let fits = |value: f64| value.is_finite() && (least..=most).contains(&number(value));
    let outside = |&value: &f64| !(value.is_nan() || fits(value));
    let Some(cell) = raster.values.iter().position(outside) else { return Ok(()) };
    let value = raster.values[cell];
    let problem = format!("the value {value} would be stored as {}", number(value));
    let advice = "choose a wider sample type, or another scale and offset";
    Err(Fault::new(problem, format!("{least:?}..{most:?}"), advice).at(raster.place(cell)))
}

/// The stored number of missing cells; `None` for NaN, or when nothing is missing.
fn mark(
    raster: &Raster,
    sample: SampleType,
    marks: &[f64],
    number: impl Fn(f64) -> f64,
) -> Result<Option<f64>, Fault> {
    let [least, most] = sample.range();
    let usable = |&mark: &f64| {
        let fits = (least..=most).contains(&mark) && sample.nearest(mark) == mark;
        fits && !raster.values.iter().any(|&value| number(value) == mark)
    };
    let own = raster.no_data.filter(usable);
    if own.is_some() || raster.missing_count() == 0 {
        return Ok(own);
    }
    match marks.iter().copied().find(|mark| mark.is_nan() || usable(mark)) {
        Some(mark) => Ok(Some(mark).filter(|mark| !mark.is_nan())),
        None => {
            let problem = format!("cells are missing, and all of {marks:?} occur as values");
            let advice = "set `no_data` to a number that does not occur";
            Err(Fault::new(problem, "a free number for missing cells", advice))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster(values: &[f64], no_data: Option<f64>) -> Raster {
        let values = values.to_vec();
        Raster { width: values.len(), height: 1, values, no_data, georeference: None }
    }

    #[test]
    fn numbers_are_scaled_rounded_and_read_back() {
        let field = raster(&[-1.0, 0.24, 0.26, f64::NAN], Some(-5.0));
        let stored = stored(&field, SampleType::I16, [0.5, 1.0], &[-9.0]).unwrap();
        assert_eq!(*stored.numbers, [-4.0, -2.0, -1.0, -5.0]);
        let mut values = stored.numbers.into_owned();
        stored.encoding.decode(&mut values);
        assert_eq!(values[..3], [-1.0, 0.0, 0.5]);
        assert!(values[3].is_nan());
    }

    #[test]
    fn a_mark_never_hides_a_value() {
        let taken = raster(&[-9_999.000_01, f64::NAN], Some(-9999.0));
        let mark = |sample, marks: &[f64]| {
            stored(&taken, sample, [1.0, 0.0], marks).map(|stored| stored.encoding.no_data)
        };
        // In a double the value differs from the mark, in a single it does not.
        assert_eq!(mark(SampleType::F64, &[f64::NAN]), Ok(Some(-9999.0)));
        assert_eq!(mark(SampleType::F32, &[f64::NAN]), Ok(None));
        assert_eq!(mark(SampleType::I16, &[-9999.0, 7.0]), Ok(Some(7.0)));
        let message = mark(SampleType::I16, &[-9999.0]).unwrap_err().to_string();
        assert!(message.contains("occur as values"), "{message}");
    }

    #[test]
    fn values_that_do_not_fit_are_named() {
        for (values, sample) in [
            ([0.0, 40_000.0], SampleType::I16),
            ([0.0, 1e39], SampleType::F32),
            ([0.0, f64::INFINITY], SampleType::F64),
            ([0.0, -1.0], SampleType::U8),
        ] {
            let field = raster(&values, None);
            let message = stored(&field, sample, [1.0, 0.0], &[]).unwrap_err().to_string();
            assert!(message.contains("column 1, row 0"), "{message}");
            assert!(message.contains("wider sample type"), "{message}");
        }
    }
}
