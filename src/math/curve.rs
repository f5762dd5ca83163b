//! A cubic curve through points that is monotone where they are: it neither overshoots nor has a kink. It goes on straight outside.
//!
//! Source: F. N. Fritsch, J. Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM Journal on Scientific and
//! Statistical Computing 5 (1984) 300-304; slopes at the ends by three points as in C. Moler, Numerical Computing with MATLAB (2004),
//! section 3.6.

use super::function::SplineTable;
use super::jet::Number;

/// Bisections towards a zero of the curve.
const BISECTIONS: usize = 60;

/// A curve through points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Points with their slopes.
    table: SplineTable,
    /// Integrals from the zero of the curve to the points, `[points]`.
    integrals: Vec<f64>,
}

impl Curve {
    /// Builds the curve through points `[x, y]`.
    ///
    /// # Errors
    /// Fewer than two points, arguments that do not increase, numbers that are not finite.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, String> {
        if points.len() < 2 {
            return Err(format!(
                "expected two points or more, found {}",
                points.len()
            ));
        }
        let mut table = SplineTable::increasing(points, "points in increasing order")?;
        table.slopes = slopes(&table.times, &table.values);
        let mut curve = Self {
            table,
            integrals: vec![0.0],
        };
        for i in 1..points.len() {
            let whole = curve.integrals[i - 1] + curve.piece_integral(i - 1, 1.0);
            curve.integrals.push(whole);
        }
        let start = curve.zero().map_or(0.0, |zero| curve.integral_at(zero));
        curve.integrals.iter_mut().for_each(|of| *of -= start);
        Ok(curve)
    }

    /// Value at `x`.
    pub fn value<N: Number>(&self, x: N) -> N {
        x.map(|x| self.table.spline(x)[0], |x| self.table.spline(x))
    }

    /// Integral up to `x`, from the first zero of the curve between its points, or else from the first point.
    pub fn integral<N: Number>(&self, x: N) -> N {
        x.map(
            |x| self.integral_at(x),
            |x| {
                let [value, slope, _] = self.table.spline(x);
                [self.integral_at(x), value, slope]
            },
        )
    }

    /// Slope at `x`.
    pub fn slope(&self, x: f64) -> f64 {
        self.table.spline(x)[1]
    }

    /// Returns the largest slope by size at the points.
    pub fn steepest(&self) -> f64 {
        self.table
            .slopes
            .iter()
            .fold(0.0, |most, of| most.max(of.abs()))
    }

    /// Integral from the start of piece `i` to the place `s` in it.
    fn piece_integral(&self, i: usize, s: f64) -> f64 {
        let (step, [a, b, c]) = self.table.cubic(i);
        step * s * (self.table.values[i] + s * (a / 2.0 + s * (b / 3.0 + s * c / 4.0)))
    }

    fn integral_at(&self, x: f64) -> f64 {
        let SplineTable {
            times,
            values,
            slopes,
        } = &self.table;
        match self.table.piece(x) {
            Ok(i) => {
                let s = (x - times[i]) / (times[i + 1] - times[i]);
                self.integrals[i] + self.piece_integral(i, s)
            }
            Err(end) => {
                let way = x - times[end];
                self.integrals[end] + way * (values[end] + 0.5 * slopes[end] * way)
            }
        }
    }

    /// Returns the first zero between the points.
    fn zero(&self) -> Option<f64> {
        let SplineTable { times, values, .. } = &self.table;
        let mut pieces = values.windows(2);
        let i = pieces.position(|pair| pair[0] * pair[1] <= 0.0)?;
        if values[i] == 0.0 {
            return Some(times[i]);
        }
        let (mut below, mut above) = (times[i], times[i + 1]);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (below + above);
            if self.value(middle) * values[i] > 0.0 {
                below = middle;
            } else {
                above = middle;
            }
        }
        Some(above)
    }
}

/// Slopes at the points: weighted harmonic means of those of both pieces, zero where these have different signs.
fn slopes(arguments: &[f64], values: &[f64]) -> Vec<f64> {
    let pieces = arguments.len() - 1;
    let steps: Vec<f64> = (0..pieces)
        .map(|i| arguments[i + 1] - arguments[i])
        .collect();
    let rises: Vec<f64> = (0..pieces)
        .map(|i| (values[i + 1] - values[i]) / steps[i])
        .collect();
    if pieces == 1 {
        return vec![rises[0]; 2];
    }
    let inner = |i: usize| {
        let ([h, k], [p, q]) = ([steps[i - 1], steps[i]], [rises[i - 1], rises[i]]);
        if p * q <= 0.0 {
            return 0.0;
        }
        let (v, w) = (2.0 * k + h, k + 2.0 * h);
        (v + w) / (v / p + w / q)
    };
    let end = |[h, k]: [f64; 2], [p, q]: [f64; 2]| {
        let slope = ((2.0 * h + k) * p - h * q) / (h + k);
        if slope * p <= 0.0 {
            0.0
        } else if p * q <= 0.0 && slope.abs() > 3.0 * p.abs() {
            3.0 * p
        } else {
            slope
        }
    };
    let last = pieces - 1;
    let mut slopes = vec![end([steps[0], steps[1]], [rises[0], rises[1]])];
    slopes.extend((1..pieces).map(inner));
    slopes.push(end(
        [steps[last], steps[last - 1]],
        [rises[last], rises[last - 1]],
    ));
    slopes
}

#[cfg(test)]
mod tests {
    use super::Curve;

    const POINTS: [[f64; 2]; 6] = [
        [0.2, -50.0],
        [0.5, -10.0],
        [0.6, 0.0],
        [1.0, 15.0],
        [1.1, 12.0],
        [1.6, 90.0],
    ];

    /// Arguments, values and slopes of `scipy.interpolate.PchipInterpolator` (SciPy 1.17.1) through these points.
    const REFERENCE: [(f64, f64, f64); 9] = [
        (0.2, -50.0, 158.33333333333331),
        (0.3, -35.07321274763136, 140.5684754521964),
        (0.55, -4.354651162790692, 107.09302325581397),
        (0.75, 8.261718750000002, 48.046875),
        (0.9, 13.781250000000004, 23.437499999999993),
        (1.05, 13.5, -44.99999999999996),
        (1.3, 24.527999999999995, 125.11999999999996),
        (1.5, 61.98399999999997, 249.27999999999994),
        (1.599999999, 89.99999968899996, 310.9999993839999),
    ];

    /// Values and slopes of `scipy.interpolate.PchipInterpolator` through the same points.
    #[test]
    fn a_curve_is_that_of_scipy() {
        let curve = Curve::new(&POINTS).expect("a curve");
        for (x, value, slope) in REFERENCE {
            assert!((curve.value(x) - value).abs() < 1e-12 * 90.0, "{x}");
            assert!((curve.slope(x) - slope).abs() < 1e-11 * 300.0, "{x}");
        }
    }

    #[test]
    fn an_integral_has_the_curve_as_its_slope_and_begins_at_its_zero() {
        let curve = Curve::new(&POINTS).expect("a curve");
        assert_eq!(curve.integral(0.6), 0.0);
        for x in [-0.1, 0.3, 0.55, 0.8, 1.05, 1.4, 1.9] {
            let slope = (curve.integral(x + 1e-5) - curve.integral(x - 1e-5)) / 2e-5;
            assert!((slope - curve.value(x)).abs() < 1e-6, "{x}");
        }
        let straight = Curve::new(&[[1.0, -2.0], [3.0, 6.0]]).expect("a curve");
        for x in [-1.0, 1.2, 1.5, 2.0, 3.0, 5.0] {
            assert!((straight.value(x) - 4.0 * (x - 1.5)).abs() < 1e-13);
            assert!((straight.integral(x) - 2.0 * (x - 1.5) * (x - 1.5)).abs() < 1e-12);
        }
    }

    #[test]
    fn points_that_make_no_curve_are_refused() {
        for (points, told) in [
            (vec![[0.0, 1.0]], "two points"),
            (vec![[0.0, 1.0], [0.0, 2.0]], "increasing"),
            (vec![[0.0, 1.0], [1.0, f64::NAN]], "finite"),
        ] {
            let error = Curve::new(&points).expect_err("no curve");
            assert!(error.contains(told), "{error}");
        }
    }
}
