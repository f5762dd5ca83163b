//! CPU time that a unit takes besides its solver: until the first step, and at every step.

use std::fmt::Display;

use anyhow::Result;
use serde_json::{Value, json};

use super::bench::Bench;
use super::csv::Csv;
use super::numbers::number;

/// Parts of the studies's report with their times.
const PARTS: [(&str, &str); 3] = [
    ("start", "instantiate set_up enter exit first_step whole"),
    ("step", "solver step exchange outside"),
    (
        "state",
        "save restore serialize deserialize directional first second",
    ),
];

/// Measures the chart.
///
/// # Errors
/// A run fails, or the file cannot be written.
pub fn measure(bench: &Bench) -> Result<()> {
    let cable = bench.case("soft_pendulum/scene.json")?;
    let names = PARTS.map(|(_, names)| names.replace(' ', "_s,") + "_s");
    let header = format!("body,{},bytes", names.join(","));
    let mut csv = Csv::new(bench, "overhead", &header);
    for elements in [0, 1, 10, 100, 1000] {
        let report = bench.studies(&["overhead"], Some(&scene(&cable, elements)))?;
        let body = match elements {
            0 => "rigid".to_owned(),
            count => count.to_string(),
        };
        let mut times = Vec::new();
        for (part, names) in PARTS {
            for name in names.split(' ') {
                times.push(number(&report[part][name])?);
            }
        }
        times.push(number(&report["state"]["bytes"])?);
        let times = times.iter().map(|time| time as &dyn Display);
        csv.row(
            &[&body as &dyn Display]
                .into_iter()
                .chain(times)
                .collect::<Vec<_>>(),
        );
    }
    csv.save()
}

/// A pendulum with two inputs and twelve outputs; rigid without elements.
fn scene(cable: &Value, elements: u32) -> Value {
    let mut scene = cable.clone();
    match elements {
        0 => {
            scene["bodies"] = json!([{
                "name": "rod", "element": "rigid", "mass": 12.0, "inertia": 1.4, "position": [0.6, 0.0],
                "markers": { "root": [-0.6, 0.0], "middle": [0.0, 0.0], "tip": [0.6, 0.0] },
            }]);
        }
        count => scene["bodies"][0]["elements"] = count.into(),
    }
    scene["inputs"] = json!([{ "kind": "force", "marker": "rod.tip" }]);
    let at = |kind: &str, marker: &str| json!({ "kind": kind, "marker": marker });
    scene["outputs"] = json!([
        at("position", "rod.tip"),
        at("position", "rod.middle"),
        at("velocity", "rod.tip"),
        at("velocity", "rod.middle"),
        { "kind": "energy" },
    ]);
    scene["accuracy"] = json!({ "relative_tolerance": 1e-4 });
    scene
}
