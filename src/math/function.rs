//! Functions of time with their first two derivatives: constants, expressions, tables.

use super::expression::Expression;

/// A function of time (s). Evaluating it allocates nothing.
#[derive(Clone, Debug)]
pub enum Function {
    /// Constant value.
    Constant(f64),
    /// An expression in `t`.
    Expression(Box<Expression>),
    /// Straight from point to point.
    Linear(SplineTable),
    /// A cubic spline through the points, straight outside.
    Spline(SplineTable),
}

/// Points of a function of time and its slopes.
#[derive(Clone, Debug, PartialEq)]
pub struct SplineTable {
    /// Times, s, increasing.
    pub(super) times: Vec<f64>,
    pub(super) values: Vec<f64>,
    /// Rates at the points; of splines only.
    pub(super) slopes: Vec<f64>,
}

impl Function {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self::Constant(value)
    }

    /// The time itself.
    pub fn time() -> Self {
        Self::Expression(Box::new(Expression::time()))
    }

    /// An expression in `t`, e.g. `0.1*sin(2*PI*t)`; [`Expression`] says what it may hold.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn expression(text: &str) -> Result<Self, String> {
        Self::of(Expression::new(text)?)
    }

    /// An expression in `t` and in coordinates of a body, at this place of it.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn at(text: &str, place: &[(&'static str, f64)]) -> Result<Self, String> {
        Self::of(Expression::at(text, place)?).map_err(|told| {
            let place = place
                .iter()
                .map(|(name, value)| format!("{name} = {value}"));
            format!("{told} at {}", place.collect::<Vec<_>>().join(", "))
        })
    }

    /// Whether it is the same at all times.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    /// Whether a text is an expression in these coordinates of a body, with or without `t`, and not one in `t` alone.
    pub fn varies(text: &str, coordinates: &[&'static str]) -> bool {
        let middle: Vec<_> = coordinates.iter().map(|name| (*name, 0.5)).collect();
        Expression::new(text).is_err() && Expression::at(text, &middle).is_ok()
    }

    fn of(expression: Expression) -> Result<Self, String> {
        Ok(match expression.constant() {
            Some(value) if value.is_finite() => Self::Constant(value),
            Some(value) => return Err(format!("expected a finite number, found {value}")),
            None => Self::Expression(Box::new(expression)),
        })
    }

    /// Straight lines through points `[t, y]`; the end values are held outside.
    ///
    /// # Errors
    /// No point, times that do not increase, numbers that are not finite.
    pub fn linear(points: &[[f64; 2]]) -> Result<Self, String> {
        SplineTable::new(points).map(Self::Linear)
    }

    /// The cubic spline through points `[t, y]` with these slopes at its ends, with which it goes on
    /// straight outside. Its second derivative jumps at the ends only.
    ///
    /// # Errors
    /// No point, or one only where slopes are not zero; times that do not increase, numbers that are not
    /// finite.
    pub fn spline(points: &[[f64; 2]], ends: [f64; 2]) -> Result<Self, String> {
        let mut table = SplineTable::new(points)?;
        if points.len() < 2 && ends != [0.0; 2] {
            return Err("expected at least two points between two slopes, found one".into());
        }
        table.slopes = clamped_slopes(&table.times, &table.values, ends);
        Ok(Self::Spline(table))
    }

    /// Value at a time.
    pub fn value(&self, t: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Expression(expression) => expression.value(t),
            Self::Linear(_) | Self::Spline(_) => self.derivatives(t)[0],
        }
    }

    /// Value, first and second derivative at a time; at a kink or jump, those after it.
    pub fn derivatives(&self, t: f64) -> [f64; 3] {
        match self {
            Self::Constant(value) => [*value, 0.0, 0.0],
            Self::Expression(expression) => expression.derivatives(t),
            Self::Linear(table) => table.linear(t),
            Self::Spline(table) => table.spline(t),
        }
    }

    /// Value and first four derivatives at a time; at a kink or jump, those after it.
    pub fn orders(&self, t: f64) -> [f64; 5] {
        let [value, first, second] = match self {
            Self::Expression(expression) => return expression.orders(t),
            _ => self.derivatives(t),
        };
        let third = match self {
            Self::Spline(table) => table.third(t),
            _ => 0.0,
        };
        [value, first, second, third, 0.0]
    }

    /// The first time after `from`, `until` at the latest, at which the function or one of its derivatives has
    /// a kink or a jump. Allocates nothing, and follows from its arguments alone.
    pub fn next_break(&self, from: f64, until: f64) -> Option<f64> {
        match self {
            Self::Constant(_) => None,
            Self::Expression(expression) => expression.next_break(from, until),
            Self::Linear(table) | Self::Spline(table) => {
                let after = table.times.partition_point(|time| *time <= from);
                let next = table.times.get(after).copied();
                next.filter(|time| *time <= until)
            }
        }
    }

    /// Whether it holds sines, cosines or tangents.
    pub fn is_periodic(&self) -> bool {
        matches!(self, Self::Expression(expression) if expression.is_periodic())
    }

    /// Most periods that a wave in it goes through from one time to another. Allocates nothing.
    pub fn periods(&self, from: f64, until: f64) -> f64 {
        match self {
            Self::Expression(expression) => expression.periods(from, until),
            Self::Constant(_) | Self::Linear(_) | Self::Spline(_) => 0.0,
        }
    }

    /// Whether it may have kinks or jumps.
    pub fn has_breaks(&self) -> bool {
        match self {
            Self::Constant(_) => false,
            Self::Expression(expression) => expression.has_breaks(),
            Self::Linear(_) | Self::Spline(_) => true,
        }
    }
}

impl SplineTable {
    fn new(points: &[[f64; 2]]) -> Result<Self, String> {
        if points.is_empty() {
            return Err("expected at least one point [t, y], found none".into());
        }
        Self::increasing(points, "increasing times")
    }

    /// Points without slopes, whose order is `wanted`.
    ///
    /// # Errors
    /// Numbers that are not finite, or arguments that do not increase.
    pub(super) fn increasing(points: &[[f64; 2]], wanted: &str) -> Result<Self, String> {
        if let Some(number) = points.iter().flatten().find(|number| !number.is_finite()) {
            return Err(format!("expected finite numbers, found {number}"));
        }
        if let Some(pair) = points.windows(2).find(|pair| pair[1][0] <= pair[0][0]) {
            let (before, after) = (pair[0][0], pair[1][0]);
            return Err(format!("expected {wanted}, found {after} after {before}"));
        }
        Ok(Self {
            times: points.iter().map(|point| point[0]).collect(),
            values: points.iter().map(|point| point[1]).collect(),
            slopes: Vec::new(),
        })
    }

    /// Returns the index of the piece that holds a time.
    ///
    /// # Errors
    /// Outside, the index of the point next to it.
    pub(super) fn piece(&self, t: f64) -> Result<usize, usize> {
        let after = self.times.partition_point(|time| *time <= t);
        if after == 0 {
            Err(0)
        } else if after == self.times.len() {
            Err(after - 1)
        } else {
            Ok(after - 1)
        }
    }

    fn linear(&self, t: f64) -> [f64; 3] {
        match self.piece(t) {
            Err(end) => [self.values[end], 0.0, 0.0],
            Ok(i) => {
                let rate =
                    (self.values[i + 1] - self.values[i]) / (self.times[i + 1] - self.times[i]);
                [self.values[i] + rate * (t - self.times[i]), rate, 0.0]
            }
        }
    }

    /// Step, and `a`, `b`, `c` of `y = y_i + a s + b s^2 + c s^3` with `s` from 0 to 1 on piece `i`.
    pub(super) fn cubic(&self, i: usize) -> (f64, [f64; 3]) {
        let step = self.times[i + 1] - self.times[i];
        let rise = self.values[i + 1] - self.values[i];
        let slopes = [i, i + 1].map(|i| step * self.slopes[i]);
        (step, hermite(rise, slopes))
    }

    /// Third derivative of a spline.
    fn third(&self, t: f64) -> f64 {
        self.piece(t).map_or(0.0, |i| {
            let (step, [_, _, cube]) = self.cubic(i);
            6.0 * cube / (step * step * step)
        })
    }

    /// Hermite's cubic on the piece.
    pub(super) fn spline(&self, t: f64) -> [f64; 3] {
        let i = match self.piece(t) {
            Err(end) => {
                let (slope, way) = (self.slopes[end], t - self.times[end]);
                return [self.values[end] + slope * way, slope, 0.0];
            }
            Ok(i) => i,
        };
        let (step, [a, square, cube]) = self.cubic(i);
        let s = (t - self.times[i]) / step;
        [
            self.values[i] + s * (a + s * (square + s * cube)),
            (a + s * (2.0 * square + 3.0 * s * cube)) / step,
            (2.0 * square + 6.0 * s * cube) / (step * step),
        ]
    }
}

/// `a`, `b`, `c` of the cubic `a s + b s^2 + c s^3` that rises by so much from 0 to 1, with these slopes at both ends.
pub fn hermite(rise: f64, [a, b]: [f64; 2]) -> [f64; 3] {
    [a, 3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise]
}

/// Slopes of the cubic spline with these slopes at both ends: continuous second derivatives at the
/// inner points are a diagonally dominant tridiagonal system.
fn clamped_slopes(times: &[f64], values: &[f64], [first, last]: [f64; 2]) -> Vec<f64> {
    let n = times.len();
    let mut slopes = vec![0.0; n];
    (slopes[0], slopes[n - 1]) = (first, last);
    let mut above = vec![0.0; n];
    for i in 1..n.saturating_sub(1) {
        let (before, after) = (times[i] - times[i - 1], times[i + 1] - times[i]);
        let (p, q) = (1.0 / before, 1.0 / after);
        let right =
            3.0 * ((values[i] - values[i - 1]) * p * p + (values[i + 1] - values[i]) * q * q);
        let pivot = 2.0 * (p + q) - p * above[i - 1];
        above[i] = q / pivot;
        slopes[i] = (right - p * slopes[i - 1]) / pivot;
    }
    for i in (1..n.saturating_sub(1)).rev() {
        slopes[i] -= above[i] * slopes[i + 1];
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All kinks and jumps after `from`.
    fn breaks(f: &Function, from: f64, until: f64) -> Vec<f64> {
        let next = |t: &f64| f.next_break(*t, until);
        std::iter::successors(f.next_break(from, until), next).collect()
    }

    #[test]
    fn a_linear_table_goes_straight_and_holds_its_ends() {
        let f = Function::linear(&[[1.0, 2.0], [2.0, 4.0], [4.0, 0.0]]).expect("a table");
        assert_eq!(f.derivatives(0.0), [2.0, 0.0, 0.0]);
        assert_eq!(f.derivatives(1.5), [3.0, 2.0, 0.0]);
        assert_eq!(f.derivatives(3.0), [2.0, -2.0, 0.0]);
        assert_eq!(f.derivatives(2.0), [4.0, -2.0, 0.0]);
        assert_eq!(f.value(9.0), 0.0);
        assert_eq!(breaks(&f, 0.0, 9.0), [1.0, 2.0, 4.0]);
        assert_eq!(breaks(&f, 1.0, 3.0), [2.0]);
        let one = Function::linear(&[[1.0, 2.0]]).expect("a table");
        assert_eq!([one.value(0.0), one.value(1.0), one.value(2.0)], [2.0; 3]);
    }

    #[test]
    fn a_spline_is_smooth_and_starts_and_ends_at_rest() {
        let points = [[0.0, 0.0], [0.5, 1.0], [0.7, 1.1], [2.0, -1.0], [2.5, 0.5]];
        let f = Function::spline(&points, [0.0; 2]).expect("a table");
        for [t, y] in points {
            assert!((f.value(t) - y).abs() < 1e-14, "{t}");
        }
        assert_eq!(f.derivatives(0.0)[1], 0.0);
        assert!(f.derivatives(2.5 - 1e-9)[1].abs() < 1e-6);
        for t in [0.5, 0.7, 2.0] {
            let (before, after) = (f.derivatives(t - 1e-9), f.derivatives(t));
            for order in 0..3 {
                assert!((before[order] - after[order]).abs() < 1e-5, "{t} {order}");
            }
        }
        for t in [0.2, 0.6, 1.1, 2.3] {
            let h = 1e-4;
            let (y, before, after) = (f.derivatives(t), f.value(t - h), f.value(t + h));
            assert!(((after - before) / (2.0 * h) - y[1]).abs() < 1e-5);
            assert!(((after - 2.0 * y[0] + before) / (h * h) - y[2]).abs() < 1e-4);
        }
        // One cubic from rest to rest is the spline through its ends.
        let f = Function::spline(&[[1.0, 0.0], [3.0, 2.0]], [0.0; 2]).expect("a table");
        assert_eq!(f.derivatives(2.0), [1.0, 1.5, 0.0]);
        assert_eq!(f.derivatives(5.0), [2.0, 0.0, 0.0]);
    }

    /// A cubic is its own spline between the slopes that it has at its ends, and goes on straight.
    #[test]
    fn a_spline_has_the_slopes_that_it_is_given() {
        let cubic = |t: f64| [t * t * t - t, 3.0 * t * t - 1.0, 6.0 * t];
        let points = [-1.0, 0.5, 0.7, 2.0].map(|t| [t, cubic(t)[0]]);
        let f = Function::spline(&points, [cubic(-1.0)[1], cubic(2.0)[1]]).expect("a table");
        for t in [-1.0, -0.3, 0.6, 1.9] {
            for (found, wanted) in f.derivatives(t).into_iter().zip(cubic(t)) {
                assert!(
                    (found - wanted).abs() < 1e-13,
                    "{t}: {found}, expected {wanted}"
                );
            }
        }
        assert_eq!(f.derivatives(3.0), [17.0, 11.0, 0.0]);
        assert_eq!(f.derivatives(-2.0), [-2.0, 2.0, 0.0]);
        assert!(Function::spline(&points[..1], [0.0, 1.0]).is_err());
    }

    #[test]
    fn an_expression_without_time_is_a_constant() {
        let f = Function::expression("2*3").expect("an expression");
        assert!(matches!(f, Function::Constant(6.0)));
        let told = Function::expression("1/0").expect_err("not finite");
        assert_eq!(told, "expected a finite number, found inf");
        let f = Function::expression("t^2").expect("an expression");
        assert_eq!((f.value(3.0), f.derivatives(3.0)), (9.0, [9.0, 6.0, 2.0]));
        assert!(breaks(&f, 0.0, 9.0).is_empty());
    }

    #[test]
    fn an_expression_along_a_body_is_one_in_time_at_each_place() {
        let text = "5*sin(PI*s)*cos(3*t)+s^2";
        let at = |s: f64, t: f64| 5.0 * (std::f64::consts::PI * s).sin() * (3.0 * t).cos() + s * s;
        for s in [0.0, 0.3, 1.0] {
            let f = Function::at(text, &[("s", s)]).expect("an expression");
            assert!((f.value(0.7) - at(s, 0.7)).abs() < 1e-15);
        }
        let f = Function::at("3*s", &[("s", 0.5)]).expect("an expression");
        assert!(matches!(f, Function::Constant(1.5)));
        let told = Function::at("1/(s-0.5)", &[("s", 0.5)]).expect_err("a pole");
        assert_eq!(told, "expected a finite number, found inf at s = 0.5");
        let told = Function::at("3*q", &[("s", 0.5)]).expect_err("no name");
        assert!(told.starts_with("expected one of the names t, s, PI, E, sin"));
        assert!(Function::varies("s*t", &["s"]) && !Function::varies("t", &["s"]));
        assert!(!Function::varies("s*q", &["s"]));
        let f = Function::at("s1+10*s2", &[("s1", 0.3), ("s2", 0.7)]).expect("an expression");
        assert!((f.value(0.0) - 7.3).abs() < 1e-15 && Function::varies("s1", &["s1", "s2"]));
    }

    #[test]
    fn tables_say_what_is_wrong_with_them() {
        for (points, wanted) in [
            (&[][..], "at least one point"),
            (
                &[[0.0, 1.0], [0.0, 2.0]],
                "increasing times, found 0 after 0",
            ),
            (&[[0.0, f64::NAN]], "finite numbers"),
        ] {
            let told = Function::spline(points, [0.0; 2]).expect_err("no table");
            assert!(told.contains(wanted), "{told}");
        }
    }
}
