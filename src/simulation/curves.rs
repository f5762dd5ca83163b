//! Curves through the rows of a table of inputs, and the rates of prescribed motions that follow from them.

use super::signals::{SignalError, Signals, wrong};
use super::variables::{DrivePart, Variable};
use super::{Error, Simulation};
use crate::math::function::Function;
use crate::math::rotation::{Quaternion, inverse, product};
use crate::scene::Interpolation;

/// Curves through the rows, column by column. Rows between two jumps lie on one smooth curve.
#[derive(Clone, Debug)]
pub(super) enum Curves {
    /// Straight from row to row.
    Linear,
    /// Cubic splines: the first row of each smooth part, and a spline for every column.
    Spline(Vec<(usize, Vec<Function>)>),
}

impl Curves {
    /// Builds curves of an interpolation through rows at these times, s.
    ///
    /// # Errors
    /// Rows through which no curve goes, in words.
    pub(super) fn new(
        interpolation: Interpolation,
        times: &[f64],
        rows: &[Vec<f64>],
    ) -> Result<Self, String> {
        if interpolation == Interpolation::Linear {
            return Ok(Self::Linear);
        }
        let jumps = (1..times.len()).filter(|&row| times[row] == times[row - 1]);
        let firsts: Vec<usize> = std::iter::once(0).chain(jumps).collect();
        let ends = firsts[1..].iter().copied().chain([times.len()]);
        let part = |(first, end): (usize, usize)| {
            let spline = |column: usize| {
                let points: Vec<[f64; 2]> = (first..end)
                    .map(|row| [times[row], rows[row][column]])
                    .collect();
                smooth(&points)
            };
            let splines: Result<_, String> = (0..rows[first].len()).map(spline).collect();
            Ok((first, splines?))
        };
        let parts: Result<_, String> = firsts.iter().copied().zip(ends).map(part).collect();
        Ok(Self::Spline(parts?))
    }
}

/// The spline whose slopes at the ends are those of cubics through the four points there.
fn smooth(points: &[[f64; 2]]) -> Result<Function, String> {
    let few = points.len().min(4);
    let last: Vec<[f64; 2]> = points.iter().rev().take(few).copied().collect();
    Function::spline(points, [end_slope(&points[..few]), end_slope(&last)])
}

/// Slope at the first point of the polynomial through all, by divided differences.
fn end_slope(points: &[[f64; 2]]) -> f64 {
    let mut differences: Vec<f64> = points.iter().map(|point| point[1]).collect();
    let (mut slope, mut factor) = (0.0, 1.0);
    for order in 1..points.len() {
        for k in 0..points.len() - order {
            let span = points[k + order][0] - points[k][0];
            differences[k] = (differences[k + 1] - differences[k]) / span;
        }
        slope += factor * differences[0];
        factor *= points[0][0] - points[order][0];
    }
    slope
}

/// An input of a prescribed motion that has no column, and follows from those that have.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Implied {
    /// Index among the variables.
    pub(super) input: usize,
    from: From,
}

#[derive(Clone, Debug, PartialEq)]
enum From {
    /// The derivative of this order (1 or 2) of a column.
    Column(usize, usize),
    /// A component of the angular velocity (order 1) or acceleration (2) of a quaternion, whose parts are these variables.
    Quaternion([usize; 4], usize, usize),
}

/// The inputs that follow from the columns of a table, whose inputs these are.
///
/// # Errors
/// A rate of a prescribed motion without its value.
pub(super) fn implied(
    inputs: &[usize],
    variables: &[Variable],
) -> Result<Vec<Implied>, SignalError> {
    let column = |index: usize| inputs.iter().position(|&input| input == index);
    let parts = |first: usize, order: usize| {
        let with = move |part: DrivePart| part.first() == first && part.order() == order;
        let all = variables.iter().enumerate();
        all.filter(move |(_, variable)| variable.drive.is_some_and(with))
            .map(|(index, _)| index)
    };
    let mut found = Vec::new();
    for (index, variable) in variables.iter().enumerate() {
        let Some(drive) = variable.drive else {
            continue;
        };
        let (first, order) = (drive.first(), drive.order());
        let has_value = parts(first, 0).any(|value| column(value).is_some());
        if column(index).is_some() && !has_value && variable.coupling.is_none() {
            let value = parts(first, 0).next().map_or("", |i| &variables[i].name);
            return wrong(format!(
                "column {}: expected a column {value} beside it, whose rate it is, found none",
                variable.name
            ));
        }
        if order == 0 || column(index).is_some() {
            continue;
        }
        let of_order = |order: usize| match drive {
            DrivePart::Coordinate { .. } => parts(first, order).next(),
            DrivePart::Orientation { component, .. } => parts(first, order).nth(component),
        };
        // The nearest derivative below that has a column; of a quaternion all parts count.
        let lowest = usize::from(matches!(drive, DrivePart::Orientation { .. }));
        let below = (lowest..order).rev().find_map(|below| {
            let column = of_order(below).and_then(column)?;
            Some(From::Column(column, order - below))
        });
        let from = below.or_else(|| match drive {
            DrivePart::Orientation { component, .. } if has_value => {
                let mut quaternion = [0; 4];
                for (place, part) in quaternion.iter_mut().zip(parts(first, 0)) {
                    *place = part;
                }
                Some(From::Quaternion(quaternion, order, component))
            }
            _ => None,
        });
        found.extend(from.map(|from| Implied { input: index, from }));
    }
    Ok(found)
}

impl Signals {
    /// Value and three derivatives of a column at a time, on the curve that begins at a row.
    fn orders(&self, column: usize, row: usize, time: f64) -> [f64; 4] {
        if let Curves::Spline(parts) = &self.curves {
            let part = parts.partition_point(|(first, _)| *first <= row) - 1;
            let [value, first, second, third, _] = parts[part].1[column].orders(time);
            return [value, first, second, third];
        }
        let next = (row + 1).min(self.times.len() - 1);
        let span = self.times[next] - self.times[row];
        let (from, to) = (self.rows[row][column], self.rows[next][column]);
        let slope = if span > 0.0 { (to - from) / span } else { 0.0 };
        [from + slope * (time - self.times[row]), slope, 0.0, 0.0]
    }

    /// Sets the inputs to their values at a time, and their derivatives to those that lead them to their values after `h`; the
    /// rates of prescribed motions without columns follow.
    ///
    /// # Errors
    /// As [`Simulation::set_real`].
    pub(super) fn apply(
        &self,
        simulation: &mut Simulation,
        [time, h]: [f64; 2],
        slack: f64,
    ) -> Result<(), Error> {
        let after = self.times.partition_point(|&at| at <= time + slack);
        let row = after.saturating_sub(1);
        for (column, &index) in self.inputs.iter().enumerate() {
            let [value, first, second, third] = self.orders(column, row, time);
            set(simulation, index, led(value, [first, second, third], h))?;
        }
        for implied in &self.implied {
            let told = match &implied.from {
                From::Column(column, order) => {
                    let orders = self.orders(*column, row, time);
                    let order = |more: usize| orders.get(order + more).copied().unwrap_or(0.0);
                    [order(0), order(1), order(2)]
                }
                From::Quaternion(parts, order, component) => {
                    let settings = parts.map(|part| simulation.setting(part));
                    let at = |time: f64| {
                        let rotating = self.rotating(parts, settings, row, time);
                        rotating[order - 1][*component]
                    };
                    let now = at(time);
                    let change = if h > 0.0 {
                        (at(time + h) - now) / h
                    } else {
                        0.0
                    };
                    [now, change, 0.0]
                }
            };
            set(simulation, implied.input, told)?;
        }
        Ok(())
    }

    /// Angular velocity and acceleration of a quaternion, of any length, on its curve; parts without a column keep what they are
    /// set to. With `p = q' q^-1`: `w = 2 vec p`, `w' = 2 vec(q'' q^-1) - 2 (scalar p) w`.
    fn rotating(
        &self,
        parts: &[usize; 4],
        settings: [f64; 4],
        row: usize,
        time: f64,
    ) -> [[f64; 3]; 2] {
        let mut q: [Quaternion; 3] = [settings, [0.0; 4], [0.0; 4]];
        for (k, part) in parts.iter().enumerate() {
            if let Some(column) = self.inputs.iter().position(|input| input == part) {
                let orders = self.orders(column, row, time);
                for (q, order) in q.iter_mut().zip(orders) {
                    q[k] = order;
                }
            }
        }
        let square: f64 = q[0].iter().map(|part| part * part).sum();
        if square == 0.0 {
            return [[0.0; 3]; 2];
        }
        let inverse = inverse(q[0]).map(|part| part / square);
        let [scalar, x, y, z] = product(&q[1], &inverse);
        let [_, u, v, w] = product(&q[2], &inverse);
        let velocity = [x, y, z].map(|part| 2.0 * part);
        let bend = [u, v, w];
        let second = std::array::from_fn(|k| 2.0 * (bend[k] - scalar * velocity[k]));
        [velocity, second]
    }
}

/// Sets an input and two derivatives of it.
fn set(
    simulation: &mut Simulation,
    index: usize,
    [value, first, second]: [f64; 3],
) -> Result<(), Error> {
    simulation.set_real(index, value)?;
    simulation.set_input_derivative(index, 1, first)?;
    simulation.set_input_derivative(index, 2, second)
}

/// Value and two derivatives of the parabola that has the value of a cubic at both ends of a time, and its slope at the last.
fn led(value: f64, [first, second, third]: [f64; 3], h: f64) -> [f64; 3] {
    let bend = h * third;
    [value, first - h * bend / 6.0, second + bend * (2.0 / 3.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_its_own_curve() {
        let cubic = |t: f64| 1.0 + t * (2.0 + t * (-3.0 + 0.5 * t));
        let points = [0.0, 0.3, 0.5, 1.2, 2.0].map(|t| [t, cubic(t)]);
        let curve = smooth(&points).expect("a curve");
        for t in [0.0, 0.1, 0.4, 1.0, 1.9] {
            let [value, first, second, third, _] = curve.orders(t);
            let rate = 2.0 + t * (-6.0 + 1.5 * t);
            assert!((value - cubic(t)).abs() < 1e-13, "{t}");
            assert!((first - rate).abs() < 1e-12, "{t}");
            assert!((second - (3.0 * t - 6.0)).abs() < 1e-11, "{t}");
            assert!((third - 3.0).abs() < 1e-10, "{t}");
        }
    }

    #[test]
    fn a_parabola_leads_to_the_end_of_a_cubic() {
        let (first, second, third, h) = (2.0, -6.0, 3.0, 0.3);
        let [value, rate, bend] = led(1.0, [first, second, third], h);
        let end = 1.0 + h * (first + h * (second / 2.0 + h * third / 6.0));
        let slope = first + h * (second + h * third / 2.0);
        assert!((value + h * (rate + h * bend / 2.0) - end).abs() < 1e-14);
        assert!((rate + h * bend - slope).abs() < 1e-14);
    }
}
