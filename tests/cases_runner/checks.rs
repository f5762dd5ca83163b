//! The claims, checked against a simulation. One function a kind; `tests/fmpy/claims.py` has its twin.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::Measured;
use super::claim::{Claim, Critical, Drift, Given, Kind, Order, Series, Values};
use super::records::{Demand, Record};
use super::run::{Method, SAME_TIME};

/// Below this relative error the order of convergence drowns in roundoff.
const ROUNDOFF: f64 = 1e-10;
/// Steps that a root search may take.
const MOST_SECANTS: usize = 40;

/// Where a claim is checked.
pub struct Place<'a> {
    /// The folder of its case.
    pub folder: &'a Path,
    /// The scene that it is about.
    pub scene: &'a Path,
    /// Integrator that takes the steps.
    pub method: &'a Method,
}

/// Checks one claim of the case in a folder, on the run `record` if the claim needs one.
///
/// # Errors
/// A claim that could not be measured, in words.
pub fn check(claim: &Claim, at: &Place, record: Option<&Record>) -> Result<Measured, String> {
    let run = || record.ok_or_else(|| "expected a run, found none".to_owned());
    match &claim.kind {
        Kind::Series(series) => check_series(series, at.folder, run()?),
        Kind::Values(values) => check_values(values, run()?),
        Kind::Order(order) => check_order(order, at, &claim.values),
        Kind::Critical(critical) => check_critical(critical, at, &claim.values),
        Kind::Drift(drift) => check_drift(drift, run()?),
    }
}

fn measured(what: String, found: f64, allowed: f64, failure: String) -> Measured {
    // NaN must fail.
    let holds = found <= allowed;
    Measured {
        what,
        found,
        allowed: format!("<= {allowed:.3e}"),
        failure: (!holds).then_some(failure),
    }
}

fn check_series(series: &Series, folder: &Path, record: &Record) -> Result<Measured, String> {
    let (times, columns) = read_reference(&folder.join(&series.reference), &series.columns)?;
    let found = record.until(series.stop_time, series.columns.keys())?;
    let allowed = allowances(series, &columns);
    let mut errors: Vec<(f64, f64, f64, f64, String)> = Vec::new();
    let mut points = 0;
    for (row, t) in times.iter().enumerate() {
        let same = |(time, _): &&(f64, Vec<f64>)| (time - t).abs() <= SAME_TIME * time.max(1.0);
        let Some((time, values)) = found.iter().find(same) else {
            continue;
        };
        points += 1;
        let differences = values.iter().zip(&columns).map(|(v, c)| v - c[row]);
        if series.distance {
            let names: Vec<&str> = series.columns.keys().map(String::as_str).collect();
            let error = differences.map(|d| d * d).sum::<f64>().sqrt();
            let most = allowed.iter().copied().fold(0.0, f64::max);
            errors.push((share(error, most), error, most, *time, names.join(" and ")));
        } else {
            let names = series.columns.keys().zip(&allowed);
            errors.extend(differences.zip(names).map(|(d, (name, allowed))| {
                let error = d.abs();
                (share(error, *allowed), error, *allowed, *time, name.clone())
            }));
        }
    }
    if points < 2 {
        return Err(format!(
            "{}: expected at least two communication points of the run, found {points}",
            series.reference
        ));
    }
    // In the order of total_cmp a NaN without its sign is above all numbers.
    let worst = errors.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, error, allowed, time, name)) = worst else {
        return Err("columns: expected at least one, found none".into());
    };
    let failure =
        format!("{name} at t = {time}: {error:.3e} from the reference, allowed {allowed:.3e}");
    Ok(measured(name, error, allowed, failure))
}

/// What every column may be off: `relative` is of its largest entry, or of `scale` if that is more.
fn allowances(series: &Series, columns: &[Vec<f64>]) -> Vec<f64> {
    let largest = |column: &Vec<f64>| column.iter().fold(series.scale, |l, v| l.max(v.abs()));
    columns
        .iter()
        .map(|column| series.absolute.max(series.relative * largest(column)))
        .collect()
}

/// An error as a share of what is allowed: nothing off by nothing is perfect, not 0 / 0.
fn share(error: f64, allowed: f64) -> f64 {
    if error <= allowed && allowed == 0.0 {
        0.0
    } else {
        (error / allowed).abs()
    }
}

fn check_values(values: &Values, record: &Record) -> Result<Measured, String> {
    if values.time > 0.0 && values.step.is_none() {
        return Err("step: expected one with a time, found nothing".into());
    }
    let found = record.until(values.time, values.values.keys())?.pop();
    let found = found.map_or_else(Vec::new, |(_, found)| found);
    let mut worst: Option<(f64, Measured)> = None;
    for ((name, wanted), value) in values.values.iter().zip(found) {
        let allowed = values.relative * values.scale.max(wanted.abs());
        let error = (value - wanted).abs();
        let failure = format!(
            "{name}: expected {wanted}, found {value}; {error:.3e} apart, allowed {allowed:.3e}"
        );
        let share = share(error, allowed);
        let measured = measured(name.clone(), error, allowed, failure);
        if worst
            .as_ref()
            .is_none_or(|(s, _)| share.total_cmp(s).is_gt())
        {
            worst = Some((share, measured));
        }
    }
    worst
        .map(|(_, measured)| measured)
        .ok_or_else(|| "values: expected at least one, found none".into())
}

fn check_order(order: &Order, at: &Place, given: &Given) -> Result<Measured, String> {
    let mut errors = Vec::new();
    for number in &order.over {
        let mut start = given.clone();
        start.set.insert(order.vary.clone(), *number);
        let value = value_at(at, &start, order.time, order.step, &order.variable)?;
        let scale = if order.value == 0.0 {
            1.0
        } else {
            order.value.abs()
        };
        errors.push((value - order.value).abs() / scale);
    }
    let listed: Vec<String> = order
        .over
        .iter()
        .zip(&errors)
        .map(|(n, e)| format!("{n}: {e:.3e}"))
        .collect();
    let listed = listed.join(", ");
    let pairs = errors.windows(2).zip(order.over.windows(2));
    let mut observed = pairs
        .filter(|(e, _)| e[0].min(e[1]) > ROUNDOFF && e.iter().all(|e| e.is_finite()))
        .map(|(e, n)| (e[0] / e[1]).ln() / (n[1] / n[0]).ln());
    let Some(found) = observed.next_back() else {
        return Err(format!("no two errors above roundoff in a row; {listed}"));
    };
    let low = order.order - order.within;
    let high = if order.at_least {
        f64::INFINITY
    } else {
        order.order + order.within
    };
    let holds = (low..=high).contains(&found);
    let failure = format!(
        "expected an order from {low} to {high}, found {found:.3}; relative errors {listed}"
    );
    Ok(Measured {
        what: format!("order of {}", order.variable),
        found,
        allowed: format!("{low:.2} to {high:.2}"),
        failure: (!holds).then_some(failure),
    })
}

fn check_critical(critical: &Critical, at: &Place, given: &Given) -> Result<Measured, String> {
    let indicator = |start: f64| {
        let mut changed = given.clone();
        changed.set.insert(critical.vary.clone(), start);
        let frequency = value_at(at, &changed, 0.0, None, &critical.indicator)?;
        // The eigenvalue itself crosses zero smoothly; its signed root does not.
        Ok(frequency * frequency.abs())
    };
    let scale = critical.value.abs();
    let found = vanishing(
        indicator,
        critical.between,
        0.01 * critical.relative * scale,
    )?;
    let error = (found - critical.value).abs() / scale;
    let failure = format!(
        "{} vanishes at {} = {found}, expected {} to {} relative",
        critical.indicator, critical.vary, critical.value, critical.relative
    );
    let what = format!("critical {}", critical.vary);
    Ok(measured(what, error, critical.relative, failure))
}

fn check_drift(drift: &Drift, record: &Record) -> Result<Measured, String> {
    if drift.after >= drift.stop_time {
        return Err(format!(
            "after: expected a time before {}, found {}",
            drift.stop_time, drift.after
        ));
    }
    let rows = record.until(drift.stop_time, drift.sum.iter().chain(&drift.less))?;
    let (mut start, mut largest, mut when) = (f64::NAN, 0.0, 0.0);
    for (time, values) in rows {
        let (plus, minus) = values.split_at(drift.sum.len());
        let total = plus.iter().sum::<f64>() - minus.iter().sum::<f64>();
        let change = (total - start).abs();
        if time <= drift.after * (1.0 + SAME_TIME) {
            start = total;
        } else if change.total_cmp(&largest).is_gt() {
            (largest, when) = (change, time);
        }
    }
    let mut what = drift.sum.join(" + ");
    for name in &drift.less {
        what = format!("{what} - {name}");
    }
    let failure = format!(
        "{what} drifts by {largest:.3e} (t = {when}), allowed {}; {:.3e} of the scale",
        drift.absolute,
        largest / drift.scale
    );
    Ok(measured(what, largest, drift.absolute, failure))
}

/// Value of a variable at a time.
fn value_at(
    at: &Place,
    given: &Given,
    time: f64,
    step: Option<f64>,
    name: &String,
) -> Result<f64, String> {
    if time > 0.0 && step.is_none() {
        return Err("step: expected one with a time, found nothing".into());
    }
    let demand = Demand {
        stop_time: time,
        step: step.unwrap_or(1.0),
        names: vec![name],
    };
    let mut rows = demand
        .record(at.scene, given, at.method)?
        .until(time, [name])?;
    let last = rows.pop().and_then(|(_, values)| values.first().copied());
    last.ok_or_else(|| format!("{name}: expected a value, found none"))
}

/// Where a function that is positive from the first place on falls to zero, seen from there only: beyond, what is
/// found in equilibrium is another branch. Secants through points that stay short of where the last one ends.
fn vanishing(
    function: impl Fn(f64) -> Result<f64, String>,
    [from, to]: [f64; 2],
    tolerance: f64,
) -> Result<f64, String> {
    let (mut a, mut b) = (from, from + 0.1 * (to - from));
    let (mut at_a, mut at_b) = (function(a)?, function(b)?);
    let mut before = f64::INFINITY;
    for _ in 0..MOST_SECANTS {
        let end = b - at_b * (b - a) / (at_b - at_a);
        if !(at_b > 0.0 && (end - from) * (to - end) >= 0.0) {
            return Err(format!(
                "expected a fall to zero between {from} and {to}, found {at_a:e} at {a} and {at_b:e} at {b}"
            ));
        }
        if (end - before).abs() <= tolerance {
            return Ok(end);
        }
        before = end;
        (a, at_a) = (b, at_b);
        b += 0.9 * (end - b);
        at_b = function(b)?;
    }
    Err(format!("expected a fall to zero, found {at_b:e} at {b}"))
}

/// Times and the wanted columns of a CSV file.
fn read_reference(
    path: &Path,
    columns: &BTreeMap<String, String>,
) -> Result<(Vec<f64>, Vec<Vec<f64>>), String> {
    let at = |message: String| format!("{}: {message}", path.display());
    let text = fs::read_to_string(path).map_err(|error| at(error.to_string()))?;
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let header: Vec<&str> = lines
        .next()
        .unwrap_or_default()
        .split(',')
        .map(str::trim)
        .collect();
    let place = |name: &str| {
        let found = header.iter().position(|h| *h == name);
        found.ok_or_else(|| {
            at(format!(
                "expected a column \"{name}\", found {}",
                header.join(", ")
            ))
        })
    };
    let time = place("t")?;
    let places = columns
        .values()
        .map(|name| place(name))
        .collect::<Result<Vec<_>, _>>()?;
    let (mut times, mut values) = (Vec::new(), vec![Vec::new(); places.len()]);
    for line in lines {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let number = |place: usize| {
            let cell = cells.get(place).copied().unwrap_or_default();
            let wrong = |_| at(format!("expected a number, found \"{cell}\" in \"{line}\""));
            cell.parse::<f64>().map_err(wrong)
        };
        times.push(number(time)?);
        for (values, place) in values.iter_mut().zip(&places) {
            values.push(number(*place)?);
        }
    }
    Ok((times, values))
}
