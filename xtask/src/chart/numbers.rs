//! Small statistics, and numbers out of reports.

use anyhow::{Context, Result};
use serde_json::Value;

/// A curve in the plane or in space, point by point.
pub type Path<const D: usize = 2> = Vec<[f64; D]>;

/// The middle value; the mean of the two middle ones where their number is even.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |index: usize| sorted.get(index).copied().unwrap_or(f64::NAN);
    0.5 * (at(sorted.len().saturating_sub(1) / 2) + at(sorted.len() / 2))
}

/// The largest value; not a number where one is not.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, value: f64| if value <= most { most } else { value };
    values.into_iter().fold(0.0, larger)
}

/// Largest size so far of a curve over time, at about a hundred points.
pub fn peaks(curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let every = (curve.len() / 100).max(1);
    let mut largest = 0.0_f64;
    let so_far = curve.iter().map(|(time, value)| {
        largest = largest.max(value.abs());
        (*time, largest)
    });
    so_far.skip(every).step_by(every).collect()
}

/// Distance between two points.
pub fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    let sides = a.iter().zip(&b).map(|(a, b)| a - b);
    sides.fold(0.0, f64::hypot)
}

/// Largest distance between two curves.
pub fn largest_distance<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| distance(*a, *b)))
}

/// Reads a number of a report.
///
/// # Errors
/// The value is no number.
pub fn number(value: &Value) -> Result<f64> {
    let message = || format!("expected a number, found {value}");
    value.as_f64().with_context(message)
}

/// Reads the numbers of a list. Without a list there are none.
///
/// # Errors
/// An entry is no number.
pub fn numbers(value: &Value) -> Result<Vec<f64>> {
    value.as_array().into_iter().flatten().map(number).collect()
}

/// Reads a text of a report.
///
/// # Errors
/// The value is no text.
pub fn text(value: &Value) -> Result<&str> {
    let message = || format!("expected a text, found {value}");
    value.as_str().with_context(message)
}

/// Reads a curve of a report: rows of time and position.
///
/// # Errors
/// A row has another form.
pub fn path<const D: usize>(value: &Value) -> Result<Path<D>> {
    let rows = value.as_array().context("expected a path")?;
    let row = |row: &Value| {
        let mut place = [0.0; D];
        for (k, part) in place.iter_mut().enumerate() {
            *part = number(&row[k + 1])?;
        }
        Ok(place)
    };
    rows.iter().map(row).collect()
}

/// Returns the medians of numbers over several reports.
///
/// # Errors
/// A number is missing.
pub fn medians<const N: usize>(reports: &[Value], keys: [&str; N]) -> Result<[f64; N]> {
    let mut found = [0.0; N];
    for (middle, key) in found.iter_mut().zip(keys) {
        let numbers = reports.iter().map(|report| number(&report[key]));
        *middle = median(&numbers.collect::<Result<Vec<_>>>()?);
    }
    Ok(found)
}
