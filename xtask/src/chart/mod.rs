//! `cargo xtask chart`: measures what the product does and writes it as CSV files to `docs/charts`. What is shown of them and said about
//! them is in `xtask/charts`, in Python.

use anyhow::{Context, Result};
use clap::builder::{PossibleValue, PossibleValuesParser};

use crate::cargo::Workspace;
use crate::process::run;
use crate::python::Python;

mod as_printed;
mod bench;
mod bodies;
mod constraints;
mod cost;
mod coupling;
mod csv;
mod economy;
mod energies;
mod failures;
mod formulations;
mod machine;
mod mesh;
mod methods;
mod numbers;
mod overhead;
mod peers;
mod planned;
mod plates;
mod reduced;
mod rivals;
mod rods;
mod server;
mod space;
mod sweeps;
mod tolerances;
mod trees;

use bench::Bench;

/// Name, what it shows, and what measures it.
type Chart = (&'static str, &'static str, fn(&Bench) -> Result<()>);

/// All charts, in the order of the page.
#[rustfmt::skip]
const CHARTS: [Chart; 22] = [
    ("mesh", "Error against the number of elements", mesh::measure),
    ("space", "Shape functions, meshes, quadratures and masses", space::measure),
    ("methods", "Integrators: error in time against CPU time", methods::measure),
    ("tolerances", "Errors of all outputs over the tolerance", tolerances::measure),
    ("economy", "What planned meshes and tolerances are worth", economy::measure),
    ("drift", "Energy drift over a hundred swings", energies::drift),
    ("cost", "CPU time of a step against the number of elements", cost::measure),
    ("bodies", "CPU time of a step against the number of bodies", bodies::measure),
    ("overhead", "What a unit costs besides its solver", overhead::measure),
    ("sweeps", "Many runs of one scene: throughput", sweeps::measure),
    ("coupling", "Coupled units: error against communication step, largest stable steps", coupling::measure),
    ("constraints", "Projection and partitioning: error against CPU time", constraints::measure),
    ("energies", "Energy and residuals of mechanisms over a minute", energies::energies),
    ("peers", "Exudyn at its best and the product as it plans: error against CPU time", peers::measure),
    ("rods", "Rods in space beside Exudyn's geometrically exact beam: error against CPU time", rods::measure),
    ("reduced", "Reduced bodies beside Exudyn's floating frame with the same modes: error against CPU time", reduced::measure),
    ("plates", "Plates beside Exudyn's thin plate: error against CPU time, and cost against size", plates::measure),
    ("trees", "Trees of bodies in space beside MuJoCo, Pinocchio and Exudyn", trees::measure),
    ("failures", "Where methods fail, and what the product does there", failures::measure),
    ("formulations", "Coordinates and how accelerations follow from forces", formulations::measure),
    ("rivals", "Floating frames, incremental methods, rotation vectors and the product", rivals::measure),
    ("as_printed", "What the report's equations do as printed", as_printed::measure),
];

/// Names of charts for the command line.
pub fn names() -> PossibleValuesParser {
    CHARTS
        .map(|(name, about, _)| PossibleValue::new(name).help(about))
        .into()
}

/// Measures the named charts, or all, unless they are only to be drawn, and draws them from their CSV files.
///
/// # Errors
/// A chart cannot be measured or drawn.
pub fn chart(workspace: &Workspace, names: &[String], is_measured: bool) -> Result<()> {
    let is_wanted = |name: &str| names.is_empty() || names.iter().any(|wanted| wanted == name);
    if is_measured {
        let bench = Bench::new(workspace)?;
        for (name, _, measure) in CHARTS.iter().filter(|chart| is_wanted(chart.0)) {
            measure(&bench).with_context(|| format!("the chart {name} was not measured"))?;
            // After the chart: the load is that of its last minute.
            machine::note(&bench, name)?;
        }
    }
    let python = Python::prepare(workspace)?;
    run(python
        .script(&workspace.path("xtask/charts/draw.py"))
        .args(names))
    .context("the charts were not drawn")?;
    println!(
        "wrote {}",
        fmu_package::shown(&workspace.path("docs/charts/README.md"))
    );
    Ok(())
}
