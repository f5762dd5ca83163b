//! Where methods fail, and what the product does there: a table, every row with the test that holds it.

use anyhow::{Context, Result};

use super::bench::Bench;
use super::csv::Csv;
use super::numbers::text;

/// Measures the chart by the studies.
///
/// # Errors
/// The measurement fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let report = bench.studies(&["failures"], None)?;
    let mut csv = Csv::new(bench, "failures", "place,method,failing,product,test");
    for row in report.as_array().context("expected a list of rows")? {
        let [place, method, failing, product, test] =
            ["place", "method", "failing", "product", "test"].map(|column| text(&row[column]));
        csv.row(&[&place?, &method?, &failing?, &product?, &test?]);
    }
    csv.save()
}
