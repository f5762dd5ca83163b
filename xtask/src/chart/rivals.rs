//! The formulations that the report argues against, and the product beside them: error against CPU time.

use anyhow::Result;

use super::bench::Bench;

/// Measures, by the studies, which writes the table itself.
pub fn measure(bench: &Bench) -> Result<()> {
    bench.lab_table("rivals")
}
