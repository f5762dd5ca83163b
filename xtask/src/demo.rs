//! `cargo xtask demo`: from a scene to an FMU, a simulation by fmpy, a comparison and a picture.

use std::process::Stdio;

use anyhow::{Result, bail};
use fmu_package::{prepared, shown};

use crate::cargo::Workspace;
use crate::process::run;
use crate::python::Python;
use crate::table::Table;
use crate::{describe, package, simulate};

/// The independent solution of the same pendulum.
const REFERENCE: &str = "tests/cases/soft_pendulum/reference.csv";
/// Two times nearer than this are the same communication point, s.
const SAME_TIME: f64 = 1e-9;

/// Packages, simulates, compares and draws the pendulum, and prints where the files are.
///
/// # Errors
/// A step of the demo fails.
pub fn demo(workspace: &Workspace) -> Result<()> {
    let workspace = &workspace.quick();
    let fmu = workspace.target("demo/pendulum.fmu");
    let results = prepared(&workspace.target("demo/pendulum.csv"))?;
    let picture = workspace.target("demo/pendulum.png");
    let reference = workspace.path(REFERENCE);
    let scene = workspace.path(describe::DEFAULT_SCENE);
    package::package(workspace, &scene, Some(&fmu), &[], &[])?;
    let python = Python::prepare(workspace)?;
    run(simulate::fmpy(workspace, &python, &fmu)
        .arg("--output")
        .arg(&results))?;
    compare(&Table::read(&results)?, &Table::read(&reference)?)?;
    let shapes = workspace.target("demo/pendulum.shapes.jsonl");
    run(simulate::native(workspace, &scene, Some(&shapes))?.stdout(Stdio::null()))?;
    run(
        simulate::plot(workspace, &python, &results, Some(&shapes), &picture)
            .arg("--reference")
            .arg(&reference),
    )?;
    println!("\nFMU      {}", shown(&fmu));
    println!("results  {}", shown(&results));
    println!("picture  {}", shown(&picture));
    println!(
        "\nThis FMU was compiled in little time. `cargo xtask package` makes FMUs that run faster."
    );
    Ok(())
}

/// Prints the tip against the reference at every 0.1 s, and the largest distance.
fn compare(results: &Table, reference: &Table) -> Result<()> {
    let found = Tip::new(
        results,
        "time",
        "rod.tip.position[1]",
        "rod.tip.position[2]",
    )?;
    let expected = Tip::new(reference, "t", "x_tip", "y_tip")?;
    println!("\nTip of the pendulum and the same beam solved independently (B-spline Galerkin)\n");
    println!("  t [s]      x [m]      y [m]   reference x, y [m]     distance [m]");
    let mut largest = 0.0_f64;
    let mut last = None;
    for (index, &time) in found.time.iter().enumerate() {
        let same = |&other: &f64| (other - time).abs() < SAME_TIME;
        let Some(other) = expected.time.iter().position(same) else {
            continue;
        };
        let ([x, y], [x_reference, y_reference]) = (found.at(index), expected.at(other));
        let distance = (x - x_reference).hypot(y - y_reference);
        largest = largest.max(distance);
        let row = format!(
            "{time:7.2} {x:10.6} {y:10.6} {x_reference:10.6} {y_reference:10.6} {distance:13.1e}"
        );
        let tenths = time / 0.1;
        if (tenths - tenths.round()).abs() < SAME_TIME {
            println!("{row}");
        }
        last = Some((time, [x, y]));
    }
    let Some((time, [x, y])) = last else {
        bail!("the run and {REFERENCE} have no time in common");
    };
    println!("\nAt {time:.2} s the tip is at ({x:.6}, {y:.6}) m.");
    println!("Largest distance from the reference: {largest:.1e} m.");
    Ok(())
}

/// The path of the tip.
struct Tip {
    time: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Tip {
    fn new(table: &Table, time: &str, x: &str, y: &str) -> Result<Self> {
        Ok(Self {
            time: table.column(time)?,
            x: table.column(x)?,
            y: table.column(y)?,
        })
    }

    fn at(&self, index: usize) -> [f64; 2] {
        [self.x[index], self.y[index]]
    }
}
