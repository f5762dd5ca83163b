//! Bytes as the file of a reduced body: refused with a reason, or a body that hangs in a scene and moves.

use flexbody::scene::{Container, Scene};
use flexbody::simulation::Simulation;

/// Most modes of a body that is simulated: more find nothing new.
const MOST: usize = 12;
/// Most work of a step (evaluations times parts).
const WORK: f64 = 1e5;

/// A scene in which the first interface of a file is held, and the last one read.
fn scene(first: &str, last: &str, modes: &str) -> String {
    let name = |text: &str| serde_json::Value::from(text).to_string();
    format!(
        r#"{{"name": "hung", "dimension": 3, "gravity": [0, 0, -9.81],
        "bodies": [{{"name": "body", "element": "reduced", "file": "a.safetensors", "modes": {modes}, "position": [0, 0, 0],
            "markers": {{"held": {}, "end": {}}}}}],
        "joints": [{{"name": "ball", "kind": "spherical", "markers": ["ground", "body.held"]}}],
        "outputs": [{{"kind": "position", "marker": "body.end"}}, {{"kind": "reaction", "joint": "ball"}}, {{"kind": "energy"}}],
        "accuracy": {{"relative_tolerance": 1e-3}}}}"#,
        name(first),
        name(last)
    )
}

/// Puts bytes through all of it.
pub fn put_through(data: &[u8]) {
    let Ok(container) = Container::from_bytes(data) else {
        return;
    };
    let interfaces = &container.model.interfaces;
    let (Some(first), Some(last)) = (interfaces.first(), interfaces.last()) else {
        return;
    };
    if container.model.modes() > MOST {
        return;
    }
    for modes in ["\"all\"", "{\"fixed_interface\": 1}", "1", "0"] {
        let text = scene(&first.name, &last.name, modes);
        let scene = Scene::from_json_with(&text, &|_| Ok(data.to_vec()));
        let Ok(mut scene) = scene else {
            continue;
        };
        scene.method.work_limit = scene.method.work_limit.min(WORK);
        let mut simulation = Simulation::new(scene);
        if simulation.initialize(0.0).is_err() || simulation.start().is_err() {
            continue;
        }
        for number in 1..=2 {
            let done = simulation.step(1e-3 * f64::from(number));
            for index in 0..simulation.variables().len() {
                if let Ok(value) = simulation.real(index) {
                    assert!(value.is_finite(), "{value} of variable {index}");
                }
            }
            if done.is_err() {
                break;
            }
        }
    }
}
