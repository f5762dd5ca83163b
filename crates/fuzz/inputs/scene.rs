//! Bytes as a scene: refused with a reason, or written, read again, described and simulated.

use flexbody::fmi2::describe;
use flexbody::scene::{Body, Scene};
use flexbody::simulation::{Budget, Simulation, plan};

/// Most elements of a scene that is simulated: more find nothing new.
const MOST: u32 = 32;
/// Most work of a step (evaluations times parts).
const WORK: f64 = 1e5;

fn elements(body: &Body) -> u32 {
    body.cable().and_then(|cable| cable.elements).unwrap_or(1)
}

/// Puts bytes through all of it.
pub fn put_through(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    let Ok(scene) = Scene::from_json(text) else {
        return;
    };
    let again = Scene::from_json(&scene.to_json());
    assert_eq!(again.as_ref(), Ok(&scene));
    let sizes = scene.bodies.iter().map(elements);
    if sizes.fold(0, u32::saturating_add) > MOST {
        return;
    }
    let budget = Budget {
        seconds: 0.1,
        ..Budget::default()
    };
    let Ok((mut scene, planned)) = plan(&scene, &budget, &mut |_, _, _| ()) else {
        return;
    };
    // Ports add terminals.
    let files = 4 + usize::from(!scene.ports.is_empty());
    assert_eq!(describe(&scene, &planned, "").len(), files);
    scene.method.work_limit = scene.method.work_limit.min(WORK);
    let mut simulation = Simulation::new(scene);
    if simulation.initialize(0.0).is_err() || simulation.start().is_err() {
        return;
    }
    for number in 1..=3 {
        let done = simulation.step(1e-3 * f64::from(number));
        for index in 0..simulation.variables().len() {
            let _ = simulation.real(index);
        }
        if done.is_err() {
            return;
        }
    }
}
