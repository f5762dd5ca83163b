//! CSV files of numbers with a line of column names.

use std::path::Path;

use anyhow::{Context, Result, bail};
use fmu_package::shown;

/// A table of numbers with named columns.
pub struct Table {
    place: String,
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a CSV file.
    ///
    /// # Errors
    /// A file that cannot be read, or has fields that are no numbers.
    pub fn read(path: &Path) -> Result<Self> {
        let place = shown(path);
        let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {place}"))?;
        let mut lines = text.lines();
        let header = lines.next().unwrap_or_default();
        let names: Vec<String> = header.split(',').map(str::to_owned).collect();
        let mut rows = Vec::new();
        for (index, line) in lines.enumerate() {
            let row = line
                .split(',')
                .map(|field| field.trim().parse())
                .collect::<Result<Vec<f64>, _>>()
                .with_context(|| format!("{place}, line {}: expected numbers", index + 2))?;
            if row.len() != names.len() {
                bail!(
                    "{place}, line {}: expected {} numbers, found {}",
                    index + 2,
                    names.len(),
                    row.len()
                );
            }
            rows.push(row);
        }
        Ok(Self { place, names, rows })
    }

    /// Names of the columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// Returns a column by name.
    ///
    /// # Errors
    /// No column has this name.
    pub fn column(&self, name: &str) -> Result<Vec<f64>> {
        let Some(index) = self.names.iter().position(|known| known == name) else {
            bail!(
                "{}: expected a column {name:?}, found {}",
                self.place,
                self.names.join(", ")
            );
        };
        Ok(self.rows.iter().map(|row| row[index]).collect())
    }

    /// Returns a curve in the plane from its two columns.
    ///
    /// # Errors
    /// A column is missing.
    pub fn points(&self, x: &str, y: &str) -> Result<Vec<[f64; 2]>> {
        self.curve([x, y])
    }

    /// Returns a curve from its columns.
    ///
    /// # Errors
    /// A column is missing.
    pub fn curve<const D: usize>(&self, names: [&str; D]) -> Result<Vec<[f64; D]>> {
        let columns = names.map(|name| self.column(name));
        let columns = columns.into_iter().collect::<Result<Vec<_>>>()?;
        let row = |index: usize| std::array::from_fn(|k| columns[k][index]);
        Ok((0..self.rows.len()).map(row).collect())
    }

    /// Returns the path of a marker in the plane or in space.
    ///
    /// # Errors
    /// A column is missing.
    pub fn marker<const D: usize>(&self, name: &str) -> Result<Vec<[f64; D]>> {
        let names: [String; D] = std::array::from_fn(|k| format!("{name}.position[{}]", k + 1));
        self.curve(names.each_ref().map(String::as_str))
    }
}
