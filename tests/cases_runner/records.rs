//! Runs that claims share: all that they ask for, at every communication point.

use std::collections::BTreeMap;
use std::path::Path;

use super::claim::{Claim, Given, Kind};
use super::run::{Method, Run, SAME_TIME};

/// Demands of a claim on a run.
pub struct Demand<'a> {
    /// Last communication point, s.
    pub stop_time: f64,
    /// Time between communication points, s.
    pub step: f64,
    /// Names of variables.
    pub names: Vec<&'a String>,
}

/// Variables at every communication point of a run.
pub struct Record {
    rows: Vec<(f64, BTreeMap<String, f64>)>,
    /// Variables that cannot be read, and why.
    unknown: BTreeMap<String, String>,
    /// Why the run ended early, if it did.
    failure: Option<String>,
}

impl<'a> Demand<'a> {
    /// Returns the demands of a claim, if one run decides it.
    pub fn of(claim: &'a Claim) -> Option<Self> {
        let (stop_time, step, names) = match &claim.kind {
            Kind::Series(c) => (c.stop_time, Some(c.step), c.columns.keys().collect()),
            Kind::Values(c) => (c.time, c.step, c.values.keys().collect()),
            Kind::Drift(c) => {
                let names = c.sum.iter().chain(&c.less).collect();
                (c.stop_time, Some(c.step), names)
            }
            Kind::Order(_) | Kind::Critical(_) => return None,
        };
        let step = step.unwrap_or(stop_time.max(1.0));
        Some(Self {
            stop_time,
            step,
            names,
        })
    }

    /// Whether one run can serve both: the communication points of one are the first of the other.
    pub fn shares(&self, other: &Self) -> bool {
        let whole = |demand: &Self| {
            let steps = demand.stop_time / demand.step;
            (steps - steps.round()).abs() <= SAME_TIME * steps
        };
        self.step == other.step
            && (self.stop_time == other.stop_time || whole(self) && whole(other))
    }

    /// Asks for what the other asks for as well.
    pub fn join(&mut self, other: Self) {
        self.stop_time = self.stop_time.max(other.stop_time);
        self.names.extend(other.names);
    }

    /// Runs the scene as far as the claims demand.
    ///
    /// # Errors
    /// A run that does not start, in words.
    pub fn record(&self, scene: &Path, given: &Given, method: &Method) -> Result<Record, String> {
        let mut run = Run::start(scene, given, method)?;
        let mut record = Record {
            rows: Vec::new(),
            unknown: BTreeMap::new(),
            failure: None,
        };
        record.add(&mut run, 0.0, &self.names);
        if self.stop_time > 0.0 {
            let end = run.steps(self.stop_time, self.step, |run, time| {
                record.add(run, time, &self.names);
                Ok(())
            });
            record.failure = end.err();
        }
        Ok(record)
    }
}

impl Record {
    fn add(&mut self, run: &mut Run, time: f64, names: &[&String]) {
        let mut row = BTreeMap::new();
        for name in names {
            match run.get([*name]) {
                Ok(values) => row.extend(values.first().map(|value| ((*name).clone(), *value))),
                Err(error) => _ = self.unknown.insert((*name).clone(), error),
            }
        }
        self.rows.push((time, row));
    }

    /// Returns the times up to `stop_time` with the values of variables, in order.
    ///
    /// # Errors
    /// A run that ended before, or a variable that was not recorded, in words.
    pub fn until<'a>(
        &self,
        stop_time: f64,
        names: impl IntoIterator<Item = &'a String> + Clone,
    ) -> Result<Vec<(f64, Vec<f64>)>, String> {
        if let Some(error) = names.clone().into_iter().find_map(|n| self.unknown.get(n)) {
            return Err(error.clone());
        }
        let mut found = Vec::new();
        for (time, row) in &self.rows {
            if *time > stop_time * (1.0 + SAME_TIME) {
                return Ok(found);
            }
            // What was not asked for is NaN, and no claim holds for that.
            let value = |name: &String| row.get(name).copied().unwrap_or(f64::NAN);
            found.push((*time, names.clone().into_iter().map(value).collect()));
        }
        let last = found.last().map_or(0.0, |(time, _)| *time);
        match &self.failure {
            Some(failure) if last < stop_time * (1.0 - SAME_TIME) => Err(failure.clone()),
            _ => Ok(found),
        }
    }
}
