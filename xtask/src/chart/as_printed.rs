//! The report's equations as printed against the mass-weighted elimination, on the soft pendulum.

use anyhow::Result;
use serde_json::{Value, json};

use crate::table::Table;

use super::bench::{Bench, Run};
use super::csv::Csv;
use super::numbers::{Path, distance, numbers, path};

const MESHES: [u32; 3] = [2, 4, 10];
const STOP_TIME: f64 = 1.1;
const STEP: f64 = 0.01;
/// Ends of the elements that meet in the middle: markers this near to a node lie on it, each on
/// its own element.
const LEFT: f64 = 0.5 - 1e-11;
const RIGHT: f64 = 0.5;

/// Motion of a rod at the communication points that it reached: gaps between the two elements that meet in the middle,
/// distances of the first end from its pin (m), positions of the tip.
struct Moved {
    gap: Vec<f64>,
    pin: Vec<f64>,
    tip: Path,
}

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let scene = marked(bench.case("soft_pendulum/scene.json")?);
    let reference = bench.table("soft_pendulum/reference.csv")?;
    let known = reference.points("x_tip", "y_tip")?;
    let header = "formulation,elements,time_s,gap_m,pin_distance_m,tip_error_m";
    let mut csv = Csv::new(bench, "as_printed", header);
    let mut add = |formulation: &str, elements: u32, moved: Moved| {
        for (at, (tip, known)) in moved.tip.iter().zip(&known).enumerate() {
            let (time, gap, pin) = (STEP * at as f64, moved.gap[at], moved.pin[at]);
            let error = distance(*tip, *known);
            csv.row(&[&formulation, &elements, &time, &gap, &pin, &error]);
        }
    };
    for elements in MESHES {
        add("as_printed", elements, as_printed(bench, &scene, elements)?);
    }
    let run = |elements| Run::new(&scene, STOP_TIME, STEP).elements(elements);
    let runs = MESHES.map(|elements| run(elements).tolerance(1e-6).integrator("rk4"));
    for (elements, outcome) in MESHES.into_iter().zip(bench.run("as printed", &runs)?) {
        add("mass_weighted", elements, weighted(&outcome?.table)?);
    }
    csv.save()
}

/// The scene with markers at both sides of the node in the middle, and at the pin.
fn marked(mut scene: Value) -> Value {
    scene["bodies"][0]["markers"] = json!({"root": 0.0, "left": LEFT, "right": RIGHT, "tip": 1.0});
    let output = |marker: &str| json!({"kind": "position", "marker": format!("rod.{marker}")});
    scene["outputs"] = ["root", "left", "right", "tip"].map(output).into();
    scene
}

/// The report's equations in the studies.
fn as_printed(bench: &Bench, scene: &Value, elements: u32) -> Result<Moved> {
    let options = format!(
        "swing --formulation as_printed --consistent --elements {elements} --stop-time {STOP_TIME} --every {STEP}"
    );
    let report = bench.studies(&options.split(' ').collect::<Vec<_>>(), Some(scene))?;
    Ok(Moved {
        gap: numbers(&report["middle"])?,
        pin: numbers(&report["pins"])?,
        tip: path(&report["path"])?,
    })
}

/// Reads the motion of a run of the product.
fn weighted(table: &Table) -> Result<Moved> {
    let marker = |name: &str| table.marker(&format!("rod.{name}"));
    let (left, right, root) = (marker("left")?, marker("right")?, marker("root")?);
    let gaps = left.into_iter().zip(right);
    Ok(Moved {
        gap: gaps.map(|(left, right)| distance(left, right)).collect(),
        pin: root
            .into_iter()
            .map(|root| distance(root, [0.0; 2]))
            .collect(),
        tip: marker("tip")?,
    })
}
