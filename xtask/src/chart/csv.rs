//! The CSV files of charts.

use std::fmt::Display;
use std::path::PathBuf;

use anyhow::{Context, Result};

use crate::process::{prepared, shown};

use super::bench::Bench;

/// A file in the making.
pub struct Csv {
    path: PathBuf,
    text: String,
}

impl Csv {
    /// A file by its name without ending, and its columns.
    pub fn new(bench: &Bench, name: &str, header: &str) -> Self {
        Self {
            path: bench.output(&format!("{name}.csv")),
            text: format!("{header}\n"),
        }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: &[&dyn Display]) {
        let cells: Vec<String> = cells.iter().map(ToString::to_string).collect();
        self.texts(&cells);
    }

    /// Adds a row of texts.
    pub fn texts(&mut self, cells: &[String]) {
        let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
        self.text += &(cells.join(",") + "\n");
    }

    /// Writes the file.
    pub fn save(self) -> Result<()> {
        let place = shown(&self.path);
        std::fs::write(prepared(&self.path)?, self.text)
            .with_context(|| format!("cannot write {place}"))
    }
}

fn quoted(cell: &str) -> String {
    match cell.contains([',', '"']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

/// A measured number with five digits; empty where there is none.
pub fn digits(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        Some(value) if !value.is_nan() => format!("{value:.4e}"),
        _ => String::new(),
    }
}
