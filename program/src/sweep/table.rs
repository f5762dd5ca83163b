//! Results as Parquet, in the order of runs.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Result};
use packing::shown;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::journal::Journal;
use super::{Common, Outcome};

/// Values, about, that are held in memory before they are written.
const HELD: usize = 1 << 21;

/// A column.
enum Column {
    Whole(Vec<i64>),
    Real(Vec<f64>),
    /// A value or nothing.
    Sparse(Vec<Option<f64>>),
    Text(Vec<Option<String>>),
}

/// Writes a row for every run. Returns how many failed, which was the first, and why.
pub fn write(
    common: &Common,
    journal: &mut Journal,
    path: &Path,
) -> Result<Option<(usize, usize, String)>> {
    let mut names = vec!["run".to_owned()];
    names.extend(common.axes.names().into_iter().map(String::from));
    for name in &common.names {
        names.extend(["final", "min", "max"].map(|which| format!("{name}.{which}")));
    }
    names.extend(["warnings".into(), "error".into()]);
    let (inputs, outputs) = (common.varied.len(), common.names.len());
    let empty = || {
        let mut columns = vec![Column::Whole(Vec::new())];
        columns.extend((0..inputs).map(|_| Column::Real(Vec::new())));
        columns.extend((0..3 * outputs).map(|_| Column::Sparse(Vec::new())));
        columns.extend((0..2).map(|_| Column::Text(Vec::new())));
        columns
    };
    let mut file = Parquet::create(path, &names, &empty())?;
    let mut failed: Option<(usize, usize, String)> = None;
    let count = common.axes.count();
    let rows = (HELD / names.len()).max(1);
    for first in (0..count).step_by(rows) {
        let mut columns = empty();
        for run in first..(first + rows).min(count) {
            let outcome = journal.outcome(run)?;
            let (finished, error) = match outcome {
                Outcome::Finished(finished) => (Some(finished), None),
                Outcome::Failed(reason) => (None, Some(reason)),
            };
            if let Some(reason) = &error {
                let (number, _, _) = failed.get_or_insert_with(|| (0, run, reason.clone()));
                *number += 1;
            }
            let mut cells = columns.iter_mut();
            let mut next = || cells.next().context("a column for every value");
            next()?.push_whole(run);
            for value in common.axes.values(run) {
                next()?.push(Some(value));
            }
            for output in 0..outputs {
                let summary = finished.as_ref().map(|run| &run.summaries[output]);
                next()?.push(summary.map(|summary| summary.last));
                next()?.push(summary.map(|summary| summary.least));
                next()?.push(summary.map(|summary| summary.largest));
            }
            let warnings = finished.map(|run| run.warnings.join("; "));
            next()?.push_text(warnings.filter(|text| !text.is_empty()));
            next()?.push_text(error);
        }
        file.write(&columns)?;
    }
    file.finish()?;
    Ok(failed)
}

/// Writes a row for every run and communication point.
pub fn write_series(common: &Common, journal: &mut Journal, path: &Path) -> Result<()> {
    let mut names = vec!["run".to_owned(), "time".to_owned()];
    names.extend(common.names.iter().cloned());
    let empty = || {
        let mut columns = vec![Column::Whole(Vec::new())];
        columns.extend((1..names.len()).map(|_| Column::Real(Vec::new())));
        columns
    };
    let mut file = Parquet::create(path, &names, &empty())?;
    let (mut columns, mut held) = (empty(), 0);
    for run in 0..common.axes.count() {
        let Outcome::Finished(finished) = journal.outcome(run)? else {
            continue;
        };
        let Some((times, values)) = finished.series else {
            continue;
        };
        for (time, row) in times.iter().zip(&values) {
            columns[0].push_whole(run);
            columns[1].push(Some(*time));
            for (column, value) in columns[2..].iter_mut().zip(row) {
                column.push(Some(*value));
            }
        }
        held += times.len() * names.len();
        if held > HELD {
            file.write(&columns)?;
            (columns, held) = (empty(), 0);
        }
    }
    file.write(&columns)?;
    file.finish()
}

impl Column {
    fn push_whole(&mut self, value: usize) {
        if let Self::Whole(values) = self {
            values.push(value as i64);
        }
    }

    fn push(&mut self, value: Option<f64>) {
        match self {
            Self::Real(values) => values.push(value.unwrap_or(f64::NAN)),
            Self::Sparse(values) => values.push(value),
            _ => (),
        }
    }

    fn push_text(&mut self, value: Option<String>) {
        if let Self::Text(values) = self {
            values.push(value);
        }
    }

    fn physical(&self) -> Physical {
        match self {
            Self::Whole(_) => Physical::INT64,
            Self::Real(_) | Self::Sparse(_) => Physical::DOUBLE,
            Self::Text(_) => Physical::BYTE_ARRAY,
        }
    }
}

/// A file that grows by groups of rows, under another name until it is whole.
struct Parquet<'a> {
    writer: SerializedFileWriter<File>,
    path: &'a Path,
    partial: std::path::PathBuf,
}

impl<'a> Parquet<'a> {
    fn create(path: &'a Path, names: &[String], columns: &[Column]) -> Result<Self> {
        let mut fields = Vec::new();
        for (name, column) in names.iter().zip(columns) {
            let repetition = match column {
                Column::Whole(_) | Column::Real(_) => Repetition::REQUIRED,
                Column::Sparse(_) | Column::Text(_) => Repetition::OPTIONAL,
            };
            let text = matches!(column, Column::Text(_)).then_some(LogicalType::String);
            let field = Type::primitive_type_builder(name, column.physical());
            let field = field.with_repetition(repetition).with_logical_type(text);
            fields.push(Arc::new(field.build()?));
        }
        let schema = Type::group_type_builder("sweep")
            .with_fields(fields)
            .build()?;
        let properties = WriterProperties::builder().set_compression(Compression::SNAPPY);
        let partial = packing::partial(path);
        let file = File::create(&partial);
        let file = file.with_context(|| format!("cannot write {}", shown(path)))?;
        Ok(Self {
            writer: SerializedFileWriter::new(
                file,
                Arc::new(schema),
                Arc::new(properties.build()),
            )?,
            path,
            partial,
        })
    }

    fn write(&mut self, columns: &[Column]) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for column in columns {
            let mut writer = group.next_column()?.context("a column too many")?;
            match column {
                Column::Whole(values) => {
                    writer
                        .typed::<Int64Type>()
                        .write_batch(values, None, None)?;
                }
                Column::Real(values) => {
                    writer
                        .typed::<DoubleType>()
                        .write_batch(values, None, None)?;
                }
                Column::Sparse(cells) => {
                    let values: Vec<f64> = cells.iter().flatten().copied().collect();
                    let levels: Vec<i16> = cells.iter().map(|cell| cell.is_some().into()).collect();
                    let typed = writer.typed::<DoubleType>();
                    typed.write_batch(&values, Some(&levels), None)?;
                }
                Column::Text(cells) => {
                    let values = cells.iter().flatten();
                    let values: Vec<ByteArray> = values.map(|text| text.as_str().into()).collect();
                    let levels: Vec<i16> = cells.iter().map(|cell| cell.is_some().into()).collect();
                    let typed = writer.typed::<ByteArrayType>();
                    typed.write_batch(&values, Some(&levels), None)?;
                }
            }
            writer.close()?;
        }
        group.close()?;
        Ok(())
    }

    fn finish(self) -> Result<()> {
        self.writer.close()?;
        let renamed = std::fs::rename(&self.partial, self.path);
        renamed.with_context(|| format!("cannot write {}", shown(self.path)))
    }
}
