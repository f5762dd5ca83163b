//! Natural frequencies that `flexbody plan` prints beside a plan.

mod place;

use std::f64::consts::PI;

use place::Place;
use serde_json::{Value, json};

/// A beam between two pins with a force that is known.
fn beam() -> Value {
    let scene = include_str!("place/beam.json");
    let mut scene: Value = serde_json::from_str(scene).expect("JSON");
    scene["inputs"] = json!([]);
    scene["loads"] = json!([{"name": "push", "kind": "force", "marker": "rod.middle", "value": [0, "-sin(50*t)"]}]);
    scene["accuracy"]["error"] = json!(1e-2);
    scene
}

impl Place {
    /// What `plan` prints of a scene, and its report.
    fn plan(&self, scene: &Value) -> (String, Option<Value>) {
        std::fs::write(self.0.join("scene.json"), scene.to_string()).expect("a writable folder");
        let options = ["plan", "scene.json", "--report", "report.json"];
        let run = self.command(&options).output().expect("the program runs");
        let told = String::from_utf8(run.stderr).expect("UTF-8");
        assert!(run.status.success(), "{told}");
        // Short work prints no progress.
        assert!(!told.contains("..."), "{told}");
        let report = std::fs::read(self.0.join("report.json"));
        let report = report
            .ok()
            .map(|text| serde_json::from_slice(&text).expect("JSON"));
        (String::from_utf8(run.stdout).expect("UTF-8"), report)
    }
}

/// Frequencies of a beam between pins are `(n pi)^2 sqrt(EI / (rho A))` for a length of 1 m.
#[test]
fn a_plan_is_printed_with_natural_frequencies() {
    let (text, report) = Place::new("frequencies-printed", &[]).plan(&beam());
    let exact = PI.powi(2) * (2.0e11 * 1.0e-9 / (7800.0 * 1.0e-4_f64)).sqrt();
    let rows = text
        .split_once("natural frequencies about the start")
        .expect("frequencies")
        .1;
    let first = rows
        .lines()
        .find(|line| line.trim_start().starts_with("1 "))
        .expect("a row");
    let mut numbers = first
        .split_whitespace()
        .skip(1)
        .map(|n| n.parse::<f64>().expect("a number"));
    let [rate, hertz] = [numbers.next(), numbers.next()].map(|number| number.expect("a number"));
    assert!((rate / exact - 1.0).abs() < 1e-2, "{rate}");
    assert!((hertz / (exact / (2.0 * PI)) - 1.0).abs() < 1e-2, "{hertz}");
    let listed = &report.expect("a report")["natural_frequencies"];
    assert!(
        (listed[0].as_f64().expect("a number") / rate - 1.0).abs() < 1e-3,
        "{listed}"
    );
    assert!(!text.contains("away from rest"), "{text}");
}

/// A force that follows has no potential. A swing that starts level is far from rest.
#[test]
fn a_plan_says_why_there_are_no_frequencies_or_what_they_are_of() {
    let place = Place::new("frequencies-none", &[]);
    let mut scene = beam();
    scene["loads"][0]["follower"] = json!(true);
    scene["loads"][0]["value"] = json!([-10, 0]);
    let (text, report) = place.plan(&scene);
    assert!(
        text.contains("natural frequencies: none (expected forces with a potential"),
        "{text}"
    );
    assert!(report.expect("a report")["natural_frequencies"].is_null());
    let swing = json!({
        "name": "swing", "dimension": 2, "gravity": [0, -9.81],
        "bodies": [{"name": "arm", "element": "rigid", "mass": 1.0, "inertia": 0.1, "position": [1, 0],
            "markers": {"a": [-1, 0], "b": [0, 0]}}],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "arm.a"]}],
        "outputs": [{"kind": "position", "marker": "arm.b"}],
        "experiment": {"stop_time": 1.0, "step": 0.1},
        "accuracy": {"relative_tolerance": 1e-4}
    });
    let (text, _) = place.plan(&swing);
    assert!(
        text.contains("nothing to plan") && text.contains("away from rest"),
        "{text}"
    );
}
