//! The CSV files of charts.

use std::fmt::Display;
use std::path::PathBuf;

use anyhow::{Context, Result};
use fmu_package::{prepared, shown};

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

    /// Adds a row. Numbers have five digits but for whole ones, what is no number is empty.
    pub fn row(&mut self, cells: &[&dyn Display]) {
        let cells: Vec<String> = cells.iter().map(|cell| field(&cell.to_string())).collect();
        self.text += &(cells.join(",") + "\n");
    }

    /// Writes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(self) -> Result<()> {
        let place = shown(&self.path);
        std::fs::write(prepared(&self.path)?, self.text)
            .with_context(|| format!("cannot write {place}"))
    }
}

fn field(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(value) if value.is_nan() => String::new(),
        Ok(value) if value.is_finite() && value.fract() != 0.0 => {
            let rounded = format!("{value:.4e}").parse().unwrap_or(value);
            if (1e-2..1e5).contains(&value.abs()) {
                rounded.to_string()
            } else {
                format!("{rounded:e}")
            }
        }
        Err(_) if text.contains([',', '"']) => format!("\"{}\"", text.replace('"', "\"\"")),
        _ => text.to_owned(),
    }
}
