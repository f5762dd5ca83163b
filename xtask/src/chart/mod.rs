//! `cargo xtask chart`: what the product measurably does, as CSV, SVG and one generated page.

use anyhow::{Context, Result};
use clap::ValueEnum;

use crate::cargo::Workspace;

mod as_printed;
mod bench;
mod bodies;
mod constraints;
mod cost;
mod coupling;
mod drift;
mod energies;
mod exudyn;
mod failures;
mod formulations;
mod machine;
mod mesh;
mod methods;
mod numbers;
mod overhead;
mod page;
mod peers;
mod plot;
mod space;
mod tolerances;

use bench::Bench;

/// Charts by name, in the order of the page.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Chart {
    /// Error against the number of elements
    Mesh,
    /// Shape functions, meshes, quadratures and masses
    Space,
    /// Integrators: error in time against CPU time
    Methods,
    /// Errors of all outputs over the tolerance
    Tolerances,
    /// Energy drift over a hundred swings
    Drift,
    /// CPU time of a step against the number of elements
    Cost,
    /// CPU time of a step against the number of bodies
    Bodies,
    /// What a unit costs besides its solver
    Overhead,
    /// Coupled units: error against communication step, largest stable steps
    Coupling,
    /// Projection and partitioning: error against CPU time
    Constraints,
    /// Energy and residuals of mechanisms over a minute
    Energies,
    /// Exudyn and the product: error against CPU time
    Peers,
    /// Where methods fail, and what the product does there
    Failures,
    /// Coordinates and how accelerations follow from forces
    Formulations,
    /// What the report's equations do as printed
    AsPrinted,
}

impl Chart {
    fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::Space => "space",
            Self::Methods => "methods",
            Self::Tolerances => "tolerances",
            Self::Drift => "drift",
            Self::Cost => "cost",
            Self::Bodies => "bodies",
            Self::Overhead => "overhead",
            Self::Coupling => "coupling",
            Self::Constraints => "constraints",
            Self::Energies => "energies",
            Self::Peers => "peers",
            Self::Failures => "failures",
            Self::Formulations => "formulations",
            Self::AsPrinted => "as_printed",
        }
    }

    /// Measures, writes CSV and SVG, and returns the text of the page's section.
    fn make(self, bench: &Bench) -> Result<String> {
        match self {
            Self::Mesh => mesh::chart(bench),
            Self::Space => space::chart(bench),
            Self::Methods => methods::chart(bench),
            Self::Tolerances => tolerances::chart(bench),
            Self::Drift => drift::chart(bench),
            Self::Cost => cost::chart(bench),
            Self::Bodies => bodies::chart(bench),
            Self::Overhead => overhead::chart(bench),
            Self::Coupling => coupling::chart(bench),
            Self::Constraints => constraints::chart(bench),
            Self::Energies => energies::chart(bench),
            Self::Peers => peers::chart(bench),
            Self::Failures => failures::chart(bench),
            Self::Formulations => formulations::chart(bench),
            Self::AsPrinted => as_printed::chart(bench),
        }
    }
}

/// Makes the named charts, or all, and says where they are.
pub fn chart(workspace: &Workspace, charts: &[Chart]) -> Result<()> {
    let bench = Bench::new(workspace)?;
    let wanted = |chart: &&Chart| charts.is_empty() || charts.contains(chart);
    for chart in Chart::value_variants().iter().filter(wanted) {
        let name = chart.name();
        let section = chart
            .make(&bench)
            .with_context(|| format!("the chart {name} was not made"))?;
        // After the chart: the load is that of its last minute.
        let machine = machine::describe();
        let names: Vec<&str> = Chart::value_variants().iter().map(|c| c.name()).collect();
        page::update(&bench.output("README.md"), &names, name, &section, &machine)?;
    }
    println!(
        "wrote {}",
        crate::process::shown(&bench.output("README.md"))
    );
    Ok(())
}
