//! The formulations that the report argues against, and the product beside them: error against CPU time.

use anyhow::Result;

use super::bench::Bench;

/// Measures the chart by the studies, which write the table themselves.
///
/// # Errors
/// The measurement fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    bench.lab_table("rivals")
}
