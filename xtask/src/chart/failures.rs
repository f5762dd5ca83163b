//! Where methods fail, and what the product does there: a table, every row with the test that holds it.

use anyhow::{Context, Result};

use super::bench::Bench;
use super::page;

/// Columns of the report of the lab.
const COLUMNS: [&str; 5] = ["place", "method", "failing", "product", "test"];

/// Makes the chart.
pub fn chart(bench: &Bench) -> Result<String> {
    let report = bench.lab_alone("failures")?;
    let rows = report.as_array().context("expected a list of rows")?;
    let cell = |row: &serde_json::Value, column: &str| {
        let text = row[column].as_str().map(str::to_owned);
        text.with_context(|| format!("expected a text {column}, found {}", row[column]))
    };
    let row = |row| COLUMNS.iter().map(|column| cell(row, column)).collect();
    let rows = rows.iter().map(row).collect::<Result<Vec<Vec<String>>>>()?;
    let quoted = |cells: &Vec<String>| cells.iter().map(|cell| format!("\"{cell}\"")).collect();
    let csv: Vec<Vec<String>> = rows.iter().map(quoted).collect();
    page::write_csv(&bench.output("failures.csv"), &COLUMNS, &csv)?;
    Ok(section(&rows))
}

fn section(rows: &[Vec<String>]) -> String {
    let header = [
        "where",
        "method and setting",
        "what happens",
        "what the product does",
        "test",
    ];
    let shown = |cells: &Vec<String>| {
        let mut cells = cells.clone();
        cells[4] = format!("`{}`", cells[4]);
        cells
    };
    let says_so =
        |row: &&Vec<String>| row[2].contains("stops") || row[2].contains("no equilibrium");
    let stops = rows.iter().filter(says_so).count();
    format!(
        "\
## failures: where methods fail

{} places where methods of textbooks and of other programs fail, each run as it stands, and the product on the same scene with nothing chosen (integrator and formulation `auto`). \
References are closed forms, published figures and invariants. The methods are small pieces of the `lab`; the implicit ones solve every step by Newton's method to the end, so that what fails is the method. Each row is held by a test (`cargo test -p lab failures`).

{}
**What it means.** {stops} of these methods stop, or find nothing, and say so; the others go on with something wrong and say nothing, which is worse. \
The product answers with the right result or with a reason: in a unit a step that cannot be finished is `fmi2Discard` with the last good time, and a state saved before goes on (`tests/abi/steps.rs`, `tests/abi/states.rs`). \
A perfectly straight column beyond its buckling load stays straight at static equilibrium, as symmetry has it; its first natural frequency is then negative, and any side force shows the buckled shape.
",
        rows.len(),
        page::table(&header, &rows.iter().map(shown).collect::<Vec<_>>()),
    )
}
