//! The claims in `crates/studies/cases` on coordinate partitioning, read and checked as those of the product.

#[path = "../../../tests/cases_runner/mod.rs"]
mod cases_runner;

use std::path::Path;

use cases_runner::{Step, Verdict, check_all, find, table};
use flexbody::integrators::advance;
use flexbody::simulation::Simulation;
use flexbody::system::DrivenSystem;

use crate::failures::support::named;
use crate::integrate::tolerance;
use crate::integrators::Probe;
use crate::scene::{Start, read};

/// Takes steps by coordinate partitioning; the simulation reads the states.
fn partitioning(path: &Path, simulation: &Simulation) -> Result<Step, String> {
    let mut start = Start::new(read(path, &[])?)?;
    let mut names = simulation.variables().iter();
    let place = names.position(|variable| variable.name == "relative_tolerance");
    let relative = simulation.setting(place.ok_or("expected a tolerance")?);
    let tolerance = tolerance(&mut start, relative);
    let mut method = named(&start, "rk4")?;
    Ok(Box::new(move |simulation, until| {
        let mut snapshot = simulation.snapshot();
        let (state, work) = (&mut snapshot.state, &mut start.work);
        let model = DrivenSystem::new(&start.assembled.system, &start.inputs, work, state);
        let mut probe = Probe::new(model, None).partitioned(state);
        let (_, done) = advance(&mut *method, &mut probe, state, until, &tolerance);
        done.map_err(|stop| format!("{stop:?} at {} s", state.time))?;
        let restored = simulation.restore(&snapshot);
        restored.map_err(|error| error.to_string())
    }))
}

#[test]
fn every_claim_on_partitioning_holds() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let cases = find(&root, "").expect("readable cases");
    let verdicts = check_all(&cases, &partitioning);
    println!("{}", table(&verdicts));
    let failed: Vec<String> = verdicts.iter().filter_map(Verdict::failure).collect();
    assert!(
        !verdicts.is_empty() && failed.is_empty(),
        "{}",
        failed.join("\n")
    );
}
