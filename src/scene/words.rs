//! Numbers, names and values in words, as pages show them. What is written as in the scene stands between backticks.

use super::description::Value;
use super::resolved::{Ends, JointCoordinate};

/// The shortest text that reads back as the same number, with an exponent where plain digits would
/// be long.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-4..1e7).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Text of a number to four digits, as many as a computed mass or length is read with.
pub fn rounded(value: f64) -> String {
    format!("{value:.3e}")
        .parse()
        .map_or_else(|_| number(value), number)
}

/// A name or an expression as it is written in the scene.
pub fn code(text: &str) -> String {
    format!("`{text}`")
}

/// A point or a direction, with as many components as there are dimensions.
pub fn vector(dimension: usize, point: [f64; 3]) -> String {
    let components: Vec<String> = point[..dimension].iter().map(|c| number(*c)).collect();
    format!("({})", components.join(", "))
}

/// Values that may change in time, one after the other.
pub fn values(values: &[Value]) -> String {
    values.iter().map(value).collect::<Vec<_>>().join(", ")
}

/// A value that may change in time.
pub fn value(value: &Value) -> String {
    value_over(value, " s")
}

/// A value that may change with what has this unit, which a space precedes where there is one.
pub fn value_over(value: &Value, unit: &str) -> String {
    match value {
        Value::Number(value) => number(*value),
        Value::Expression(text) => code(text),
        Value::Table(table) => {
            let points = &table.table;
            let times = points.first().zip(points.last());
            let [from, to] = times.map_or([0.0; 2], |(a, b)| [a[0], b[0]]);
            let (from, to) = (number(from), number(to));
            let count = points.len();
            format!("table of {count} points from {from}{unit} to {to}{unit}")
        }
    }
}

/// A number with words around it, where one is given.
pub fn given(before: &str, value: Option<f64>, unit: &str) -> String {
    value.map_or(String::new(), |value| {
        format!("{before} {} {unit}", number(value))
    })
}

/// Names of both ends.
pub fn ends(ends: &Ends<'_>) -> String {
    format!("{}, {}", code(ends.first_name()), code(ends.second.name))
}

/// The point of the ground, where one is given.
pub fn at_point(dimension: usize, ends: &Ends<'_>) -> String {
    let point = ends.point();
    point.map_or(String::new(), |point| {
        format!(" at {}", vector(dimension, point))
    })
}

/// A coordinate of a joint.
pub fn coordinate(of: &JointCoordinate<'_>) -> String {
    let what = if of.is_angle() {
        "angle of"
    } else {
        "displacement of"
    };
    format!("{what} {}", code(of.name()))
}

#[cfg(test)]
mod tests {
    use super::{number, rounded};

    #[test]
    fn computed_numbers_are_rounded_to_four_digits() {
        let pairs = [
            (12.566_370_6, "12.57"),
            (0.1 + 0.2, "0.3"),
            (2.1e11, "2.1e11"),
            (0.0, "0"),
        ];
        for (value, text) in pairs {
            assert_eq!(rounded(value), text);
        }
    }

    #[test]
    fn numbers_read_back_as_they_were() {
        for value in [0.0, -9.81, 1.215e-8, 7e5, 2.1e11, 0.1 + 0.2, 1e-4, -1e300] {
            assert_eq!(number(value).parse(), Ok(value));
        }
        assert_eq!(number(1.215e-8), "1.215e-8");
        assert_eq!(number(700_000.0), "700000");
    }
}
