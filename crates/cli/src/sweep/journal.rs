//! What has been run, line by line as it comes, so that a sweep that was killed goes on where it was.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use fmu_package::{destination, shown};
use serde_json::Value;

use super::{Finished, Outcome, Series, Summary};

/// A file of one line for the sweep, then one for every run that is finished, in the order in which they were.
pub struct Journal {
    path: PathBuf,
    file: File,
    /// Where the line of every finished run begins.
    lines: Vec<Option<u64>>,
    /// Where the next line goes.
    end: u64,
}

impl Journal {
    /// Opens the journal of a sweep. It keeps the complete lines of a sweep that was stopped.
    ///
    /// # Errors
    /// A file that cannot be read or written.
    pub fn open(path: PathBuf, sweep: &Value, count: usize) -> Result<Self> {
        // A pipe would keep waiting.
        let path = destination(&path)?;
        let mut options = OpenOptions::new();
        let opened = options.read(true).write(true).create(true).truncate(false);
        let file = opened.open(&path);
        let file = file.with_context(|| format!("cannot write {}", shown(&path)))?;
        match file.try_lock() {
            // Where there are no locks, as on some network drives, nothing is known of others.
            Ok(()) | Err(TryLockError::Error(_)) => {}
            Err(TryLockError::WouldBlock) => bail!(
                "{}: expected runs of this sweep alone, found another sweep at work on them: wait for its end, or name another --output",
                shown(&path)
            ),
        }
        let mut journal = Self {
            path,
            file,
            lines: vec![None; count],
            end: 0,
        };
        let header = format!("{sweep}\n");
        let mut reader = BufReader::new(&journal.file);
        let mut line = String::new();
        let mut number = 0;
        // What a killed process left behind may end in the middle of a character.
        while read_line(&mut reader, &mut line).with_context(|| journal.place())? {
            match number {
                0 if line != header => bail!(
                    "{}: expected the runs of this very sweep, found another's: remove the file, or name another --output",
                    shown(&journal.path)
                ),
                0 => (),
                _ => {
                    let run = serde_json::from_str::<Value>(&line).ok();
                    let run = run.and_then(|run| run["run"].as_u64());
                    let Some(run) = run.filter(|run| (*run as usize) < count) else {
                        bail!(
                            "{}: line {}: no run of this sweep",
                            journal.place(),
                            number + 1
                        );
                    };
                    journal.lines[run as usize] = Some(journal.end);
                }
            }
            journal.end += line.len() as u64;
            number += 1;
        }
        journal.file.set_len(journal.end)?;
        if number == 0 {
            journal.append(&header)?;
        }
        Ok(journal)
    }

    fn place(&self) -> String {
        format!("cannot read {}", shown(&self.path))
    }

    /// Runs that are not finished, in order.
    pub fn missing(&self) -> Vec<usize> {
        let all = self.lines.iter().enumerate();
        all.filter(|(_, line)| line.is_none())
            .map(|(run, _)| run)
            .collect()
    }

    /// Adds a finished run.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn add(&mut self, run: usize, outcome: &Outcome) -> Result<()> {
        let at = self.end;
        self.append(&format!("{}\n", outcome.to_json(run)))?;
        self.lines[run] = Some(at);
        Ok(())
    }

    fn append(&mut self, line: &str) -> Result<()> {
        self.file.seek(SeekFrom::Start(self.end))?;
        let written = self.file.write_all(line.as_bytes());
        written.with_context(|| format!("cannot write {}", shown(&self.path)))?;
        self.end += line.len() as u64;
        Ok(())
    }

    /// Reads the outcome of a finished run.
    ///
    /// # Errors
    /// A run that is not finished, or a line that is damaged.
    pub fn outcome(&mut self, run: usize) -> Result<Outcome> {
        let at = self.lines[run].with_context(|| format!("run {run} is not finished"))?;
        self.file.seek(SeekFrom::Start(at))?;
        let mut line = String::new();
        BufReader::new(&self.file).read_line(&mut line)?;
        let found = serde_json::from_str(&line).ok();
        let found = found.and_then(|line: Value| Outcome::from_json(&line));
        found.with_context(|| format!("{}: run {run} is damaged", self.place()))
    }

    /// Removes the file after all results are written elsewhere.
    ///
    /// # Errors
    /// The file cannot be removed.
    pub fn remove(self) -> Result<()> {
        let removed = std::fs::remove_file(&self.path);
        removed.with_context(|| format!("cannot remove {}", shown(&self.path)))
    }

    /// Where that of a table is.
    pub fn beside(output: &Path) -> PathBuf {
        let mut name = output.file_name().unwrap_or_default().to_owned();
        name.push(".runs");
        output.with_file_name(name)
    }
}

/// Reads a whole line; nothing where there is none.
fn read_line(reader: &mut impl BufRead, line: &mut String) -> Result<bool> {
    let mut bytes = Vec::new();
    reader.read_until(b'\n', &mut bytes)?;
    line.clear();
    if bytes.last() != Some(&b'\n') {
        return Ok(false);
    }
    *line = String::from_utf8(bytes).context("expected UTF-8")?;
    Ok(true)
}

impl Outcome {
    fn to_json(&self, run: usize) -> Value {
        // What JSON has no number for is written as nothing.
        let mut line = serde_json::json!({ "run": run });
        match self {
            Self::Failed(reason) => line["error"] = reason.as_str().into(),
            Self::Finished(finished) => {
                let summaries = || finished.summaries.iter();
                let columns = |pick: fn(&Summary) -> f64| -> Value {
                    summaries()
                        .map(|summary| Value::from(pick(summary)))
                        .collect()
                };
                line["final"] = columns(|summary| summary.last);
                line["min"] = columns(|summary| summary.least);
                line["max"] = columns(|summary| summary.largest);
                line["warnings"] = finished.warnings.as_slice().into();
                if let Some((times, values)) = &finished.series {
                    line["times"] = times.as_slice().into();
                    line["values"] = values
                        .iter()
                        .map(|row| Value::from(row.as_slice()))
                        .collect();
                }
            }
        }
        line
    }

    fn from_json(line: &Value) -> Option<Self> {
        if let Some(reason) = line["error"].as_str() {
            return Some(Self::Failed(reason.to_owned()));
        }
        let [last, least, largest] = ["final", "min", "max"].map(|key| numbers(&line[key]));
        let summaries = last?.into_iter().zip(least?).zip(largest?);
        let summaries = summaries.map(|((last, least), largest)| Summary {
            last,
            least,
            largest,
        });
        Some(Self::Finished(Finished {
            summaries: summaries.collect(),
            warnings: texts(&line["warnings"])?,
            series: Series::from_json(line).map(|series| (series.times, series.values)),
        }))
    }
}

impl Series {
    /// From a line with `times` and `values`, and `warnings` where there are any.
    pub fn from_json(line: &Value) -> Option<Self> {
        let values = line["values"].as_array()?.iter().map(numbers);
        Some(Self {
            times: numbers(&line["times"])?,
            values: values.collect::<Option<_>>()?,
            warnings: texts(&line["warnings"]).unwrap_or_default(),
        })
    }
}

/// A list of numbers; nothing stands for what is none.
fn numbers(list: &Value) -> Option<Vec<f64>> {
    let list = list.as_array()?.iter();
    Some(
        list.map(|value| value.as_f64().unwrap_or(f64::NAN))
            .collect(),
    )
}

/// A list of texts.
fn texts(list: &Value) -> Option<Vec<String>> {
    let list = list.as_array()?.iter();
    list.map(|value| value.as_str().map(String::from)).collect()
}
