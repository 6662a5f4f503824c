//! Least squares fit of a straight line.

/// The line `y = intercept + slope x` with the smallest sum of squared residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    /// Value at x = 0.
    pub intercept: f64,
    /// Rise a unit of x.
    pub slope: f64,
    /// Standard error of the slope.
    pub slope_error: f64,
    /// Root mean square of the residuals.
    pub scatter: f64,
    /// Coefficient of determination; 0 when y does not vary.
    pub r_squared: f64,
}

impl Line {
    /// Fits a line through at least three `points`; `None` if there are fewer or all have the
    /// same x.
    pub fn through(points: &[[f64; 2]]) -> Option<Self> {
        let count = points.len() as f64;
        let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
        let [mean_x, mean_y] = [mean(0), mean(1)];
        let [mut xx, mut xy, mut yy] = [0.0; 3];
        for [x, y] in points {
            let [dx, dy] = [x - mean_x, y - mean_y];
            xx += dx * dx;
            xy += dx * dy;
            yy += dy * dy;
        }
        if points.len() < 3 || xx <= 0.0 {
            return None;
        }
        let slope = xy / xx;
        let residual = (yy - slope * xy).max(0.0);
        Some(Self {
            intercept: mean_y - slope * mean_x,
            slope,
            slope_error: (residual / (count - 2.0) / xx).sqrt(),
            scatter: (residual / count).sqrt(),
            r_squared: if yy > 0.0 { 1.0 - residual / yy } else { 0.0 },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Anscombe's first data set (1973): y = 3.00 + 0.500 x, standard error of the slope
    /// 0.118, R2 = 0.667.
    #[test]
    fn anscombes_line_is_found() {
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68];
        let points: Vec<[f64; 2]> = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
        let line = Line::through(&points).unwrap();
        assert!((line.intercept - 3.00).abs() < 5e-3, "{line:?}");
        assert!((line.slope - 0.500).abs() < 5e-4, "{line:?}");
        assert!((line.slope_error - 0.118).abs() < 5e-4, "{line:?}");
        assert!((line.r_squared - 0.667).abs() < 5e-4, "{line:?}");
    }

    #[test]
    fn degenerate_points_have_no_line() {
        assert_eq!(Line::through(&[[0.0, 0.0], [1.0, 1.0]]), None);
        assert_eq!(Line::through(&[[2.0, 0.0], [2.0, 1.0], [2.0, 5.0]]), None);
        assert_eq!(Line::through(&[[0.0, 3.0], [1.0, 3.0], [2.0, 3.0]]).unwrap().r_squared, 0.0);
    }
}
