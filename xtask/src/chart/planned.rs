//! Scenes that say which error is wanted and leave meshes, models and the tolerance to the planner.

use anyhow::Result;
use serde_json::{Value, json};

use super::bench::{Bench, Planned, Run};
use super::numbers::{number, text};

/// Errors that are wanted.
pub const ERRORS: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Scenes of the chart `peers`, with what is measured there.
pub const SETTINGS: &str = "crates/studies/exudyn/settings.json";
const PEERS: &str = "soft_pendulum steel_pendulum flying_spaghetti spin_up slider_crank catenary";

/// A scene to plan.
pub struct Case {
    /// Name on the page.
    pub name: String,
    /// `ready` or `peers`.
    pub of: &'static str,
    /// The scene without numbers of elements, tolerance and method.
    pub scene: Value,
}

/// Choice that a run is made with: elements of every cable (0 for one that became rigid), and a tolerance.
pub type Choice = (Vec<u32>, f64);

/// Returns the scenes of the chart `peers` with their settings, in the order of the page.
///
/// # Errors
/// A file cannot be read.
pub fn peers(bench: &Bench) -> Result<Vec<(Case, Value)>> {
    let settings = bench.json(SETTINGS)?;
    let cases = PEERS.split(' ').map(|name| {
        let setting = settings[name].clone();
        Ok((Case::of_peers(bench, name, &setting)?, setting))
    });
    cases.collect()
}

impl Case {
    /// A scene of `peers`: its marker is what counts.
    fn of_peers(bench: &Bench, name: &str, setting: &Value) -> Result<Self> {
        let mut scene = bench.json(text(&setting["scene"])?)?;
        let marker = text(&setting["marker"])?;
        scene["accuracy"] = json!({ "of": [format!("{marker}.position")] });
        scene["experiment"] =
            json!({ "stop_time": setting["stop_time"], "step": setting["every"] });
        for body in cables(&mut scene) {
            let name = text(&body["name"])?.to_owned();
            for (key, value) in setting["set"].as_object().into_iter().flatten() {
                if let Some(key) = key.strip_prefix(&format!("{name}.")) {
                    body["material"][key] = value.clone();
                }
            }
        }
        if let Some(scene) = scene.as_object_mut() {
            scene.remove("method");
        }
        let (name, of) = (name.to_owned(), "peers");
        Ok(Self { name, of, scene }.left_to_the_planner())
    }

    /// Leaves the numbers of elements to the planner, also where the scene gives them.
    pub fn left_to_the_planner(mut self) -> Self {
        for body in cables(&mut self.scene) {
            if body["elements"].is_u64() {
                body["elements"] = json!("auto");
            }
        }
        self
    }

    /// Plans the scene for a relative error.
    ///
    /// # Errors
    /// The plan fails.
    pub fn plan(&self, bench: &Bench, error: f64) -> Result<Planned> {
        let mut scene = self.scene.clone();
        scene["accuracy"]["error"] = json!(error);
        bench.plan(&scene)
    }

    /// Returns the run with a choice.
    ///
    /// # Errors
    /// The scene cannot be written.
    pub fn run(&self, choice: &Choice) -> Result<Run> {
        let mut scene = self.scene.clone();
        mesh(&mut scene, &choice.0);
        scene["accuracy"] = json!({ "relative_tolerance": choice.1 });
        let [stop, step] = ["stop_time", "step"].map(|key| number(&scene["experiment"][key]));
        Ok(Run::new(&scene, stop?, step?))
    }
}

/// Sets the meshes of a scene that its plan chooses.
///
/// # Errors
/// The plan fails.
pub fn settle(bench: &Bench, scene: &mut Value) -> Result<()> {
    let (counts, tolerance) = chosen(&bench.plan(scene)?)?;
    mesh(scene, &counts);
    scene["accuracy"] = json!({ "relative_tolerance": tolerance });
    Ok(())
}

/// Gives the cables of a scene numbers of elements.
fn mesh(scene: &mut Value, counts: &[u32]) {
    for (body, count) in cables(scene).zip(counts) {
        match count {
            0 => body["model"] = json!("rigid"),
            count => body["elements"] = json!(count),
        }
    }
}

/// The cables of a scene.
fn cables(scene: &mut Value) -> impl Iterator<Item = &mut Value> {
    let bodies = scene["bodies"].as_array_mut().into_iter().flatten();
    bodies.filter(|body| body["element"] == "cable")
}

/// Numbers of elements of cables that a plan names; none of one that became rigid.
pub fn counts(report: &Value, key: &str) -> Vec<u32> {
    let bodies = report["bodies"].as_array().into_iter().flatten();
    let cables = bodies.filter(|body| !body["fewest"].is_null());
    let counts = cables.map(|body| body[key].as_u64().unwrap_or(0));
    counts
        .map(|count| u32::try_from(count).unwrap_or(u32::MAX))
        .collect()
}

/// Reads the choice of a plan.
///
/// # Errors
/// A number is missing.
pub fn chosen(plan: &Planned) -> Result<Choice> {
    Ok((
        counts(&plan.report, "elements"),
        number(&plan.report["tolerance"])?,
    ))
}
