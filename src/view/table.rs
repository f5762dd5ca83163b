//! A table of outputs, as `flexbody simulate` writes it, without its scene.

use super::numbers::{Numbers, list, quoted};
use super::symbols::SymbolTable;

/// Outputs at times.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputTable {
    names: Vec<String>,
    times: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

impl OutputTable {
    /// Reads a CSV file: a line of names, `time` first, then numbers.
    ///
    /// # Errors
    /// No column `time`, a row of another length, a field that is no number, times that go back.
    pub fn from_csv(text: &str) -> Result<Self, String> {
        let mut lines = text.trim_start_matches('\u{feff}').lines();
        let names: Vec<String> = lines
            .next()
            .unwrap_or_default()
            .split(',')
            .map(|name| name.trim().to_owned())
            .collect();
        if names[0] != "time" {
            return Err(format!(
                "line 1: expected a first column `time`, found `{}`",
                names[0]
            ));
        }
        let mut table = Self {
            names: names[1..].to_vec(),
            times: Vec::new(),
            rows: Vec::new(),
        };
        for (number, line) in lines
            .enumerate()
            .filter(|(_, line)| !line.trim().is_empty())
        {
            let number = number + 2;
            let fields = line.split(',').map(|field| {
                let field = field.trim();
                field
                    .parse::<f64>()
                    .map_err(|_| format!("line {number}: expected a number, found `{field}`"))
            });
            let fields = fields.collect::<Result<Vec<f64>, String>>()?;
            if fields.len() != names.len() {
                return Err(format!(
                    "line {number}: expected {} numbers, found {}",
                    names.len(),
                    fields.len()
                ));
            }
            if table.times.last().is_some_and(|last| fields[0] < *last) {
                return Err(format!(
                    "line {number}: expected a time that does not go back, found {} s",
                    fields[0]
                ));
            }
            table.times.push(fields[0]);
            table.rows.push(fields[1..].to_vec());
        }
        if table.times.is_empty() {
            return Err("expected a row of numbers below the names, found none".into());
        }
        Ok(table)
    }

    /// Header and numbers of a page: markers with positions as points, and curves.
    pub(super) fn header(&self, title: &str) -> (String, String) {
        let mut numbers = Numbers::default();
        let times: Vec<Vec<f64>> = self.times.iter().map(|time| vec![*time]).collect();
        let (times, table) = (numbers.exact(&times), numbers.exact(&self.rows));
        let positions = self
            .names
            .iter()
            .filter_map(|name| name.strip_suffix(".position[1]"));
        let markers: Vec<(&str, Vec<usize>)> = positions
            .map(|of| {
                let column = |axis| {
                    self.names
                        .iter()
                        .position(|name| *name == format!("{of}.position[{axis}]"))
                };
                (of, (1..=3).map_while(column).collect())
            })
            .collect();
        let dimension = if markers.iter().any(|(_, columns)| columns.len() > 2) {
            3
        } else {
            2
        };
        let markers = list(&markers, |(name, columns)| {
            let name = quoted(name);
            format!("{{\"name\":{name},\"label\":{name},\"columns\":{columns:?}}}")
        });
        let outputs = list(&self.names, |name| {
            format!("{{\"name\":{},\"unit\":\"\"}}", quoted(name))
        });
        let (tracks, encoded) = numbers.finish();
        let header = format!(
            "{{\"name\":{},\"dimension\":{dimension},\"gravity\":[0,0],\"times\":{times},\"row_times\":{times},\"table\":{table},\
             \"bodies\":[],\"markers\":{markers},\"marks\":[],\"actions\":[],\"outputs\":{outputs},\"tracks\":[{tracks}],{}}}",
            quoted(title),
            SymbolTable::default().finish()
        );
        (header, encoded)
    }
}
