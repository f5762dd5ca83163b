//! Results as Parquet, in the order of runs.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result, bail};
use fmu_package::shown;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::journal::Journal;
use super::{Common, Finished, Outcome};

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

/// Writes a row for every run, and one for every run and communication point to `series` where that is wanted. Returns how many runs
/// failed, which was the first, and why.
///
/// # Errors
/// A file that cannot be read or written.
pub fn write(
    common: &Common,
    journal: &mut Journal,
    path: &Path,
    series: Option<&Path>,
) -> Result<Option<(usize, usize, String)>> {
    let mut runs = Parquet::create(path, columns_of_runs(common))?;
    let points = series.map(|path| Parquet::create(path, columns_of_points(common)));
    let mut points = points.transpose()?;
    let mut failed: Option<(usize, usize, String)> = None;
    for run in 0..common.axes.count() {
        let (finished, error) = match journal.outcome(run)? {
            Outcome::Finished(finished) => (Some(finished), None),
            Outcome::Failed(reason) => (None, Some(reason)),
        };
        if let Some(reason) = &error {
            let (number, _, _) = failed.get_or_insert_with(|| (0, run, reason.clone()));
            *number += 1;
        }
        add_run(common, run, finished.as_ref(), error, &mut runs)?;
        let series = finished.and_then(|finished| finished.series);
        if let Some((points, (times, values))) = points.as_mut().zip(series) {
            for (time, row) in times.iter().zip(&values) {
                add_point(run, *time, row, points)?;
            }
        }
    }
    runs.finish()?;
    if let Some(points) = points {
        points.finish()?;
    }
    Ok(failed)
}

fn columns_of_runs(common: &Common) -> Vec<(String, Column)> {
    let mut columns = vec![("run".into(), Column::Whole(Vec::new()))];
    let inputs = common.axes.names().into_iter();
    columns.extend(inputs.map(|name| (name.into(), Column::Real(Vec::new()))));
    for name in &common.names {
        let titles = ["final", "min", "max"].map(|which| format!("{name}.{which}"));
        columns.extend(titles.map(|title| (title, Column::Sparse(Vec::new()))));
    }
    columns.extend(["warnings", "error"].map(|title| (title.into(), Column::Text(Vec::new()))));
    columns
}

fn columns_of_points(common: &Common) -> Vec<(String, Column)> {
    let mut columns = vec![("run".into(), Column::Whole(Vec::new()))];
    let names = ["time".to_owned()]
        .into_iter()
        .chain(common.names.iter().cloned());
    columns.extend(names.map(|name| (name, Column::Real(Vec::new()))));
    columns
}

fn add_run(
    common: &Common,
    run: usize,
    finished: Option<&Finished>,
    error: Option<String>,
    table: &mut Parquet,
) -> Result<()> {
    let mut cells = table.columns.iter_mut();
    let mut next = || cells.next().context("a column for every value");
    next()?.push_whole(run);
    for value in common.axes.values(run) {
        next()?.push(Some(value));
    }
    for output in 0..common.names.len() {
        let summary = finished.map(|run| &run.summaries[output]);
        next()?.push(summary.map(|summary| summary.last));
        next()?.push(summary.map(|summary| summary.least));
        next()?.push(summary.map(|summary| summary.largest));
    }
    let warnings = finished.map(|run| run.warnings.join("; "));
    next()?.push_text(warnings.filter(|text| !text.is_empty()));
    next()?.push_text(error);
    table.end_row()
}

fn add_point(run: usize, time: f64, row: &[f64], table: &mut Parquet) -> Result<()> {
    let [runs, times, outputs @ ..] = &mut table.columns[..] else {
        bail!("a column for every value");
    };
    runs.push_whole(run);
    times.push(Some(time));
    for (column, value) in outputs.iter_mut().zip(row) {
        column.push(Some(*value));
    }
    table.end_row()
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

    fn clear(&mut self) {
        match self {
            Self::Whole(values) => values.clear(),
            Self::Real(values) => values.clear(),
            Self::Sparse(cells) => cells.clear(),
            Self::Text(cells) => cells.clear(),
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
    partial: PathBuf,
    /// Rows that are held.
    columns: Vec<Column>,
    rows: usize,
}

impl<'a> Parquet<'a> {
    fn create(path: &'a Path, columns: Vec<(String, Column)>) -> Result<Self> {
        let mut fields = Vec::new();
        for (name, column) in &columns {
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
        let partial = fmu_package::partial(path);
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
            columns: columns.into_iter().map(|(_, column)| column).collect(),
            rows: 0,
        })
    }

    /// All columns have a value more.
    fn end_row(&mut self) -> Result<()> {
        self.rows += 1;
        if self.rows * self.columns.len() < HELD {
            Ok(())
        } else {
            self.write()
        }
    }

    fn write(&mut self) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for column in &mut self.columns {
            let mut writer = group.next_column()?.context("a column too many")?;
            match &*column {
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
            column.clear();
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }

    fn finish(mut self) -> Result<()> {
        if self.rows > 0 {
            self.write()?;
        }
        self.writer.close()?;
        let renamed = std::fs::rename(&self.partial, self.path);
        renamed.with_context(|| format!("cannot write {}", shown(self.path)))
    }
}
