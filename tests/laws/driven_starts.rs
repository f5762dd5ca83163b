//! Starts of bodies whose places motions give alone.

use serde_json::json;

use crate::laws::runs::Run;

/// Joints between bodies whose places motions give alone: the start fits, or is refused.
#[test]
fn joints_between_driven_bodies_fit_at_the_start_or_are_refused() {
    let ball = |name: &str, place: [f64; 2]| json!({"element": "rigid", "name": name, "mass": 1.0, "position": place, "markers": {"c": [0.0, 0.0]}});
    let drive = |name: &str, place: [f64; 2]| json!({"name": format!("of_{name}"), "kind": "position", "marker": format!("{name}.c"), "value": place});
    let joints = [
        (json!({"kind": "distance", "length": 1.25}), true),
        (json!({"kind": "distance", "length": 1.2}), false),
        (json!({"kind": "distance", "length": 1.2500001}), false),
    ];
    for (mut joint, fits) in joints {
        joint["name"] = json!("link");
        joint["markers"] = json!(["a.c", "b.c"]);
        // Drawn elsewhere than where motions bring them.
        let scene = json!({"name": "driven", "dimension": 2, "gravity": [0.0, 0.0],
            "bodies": [ball("a", [0.1, 0.0]), ball("b", [0.9, 0.4])],
            "motions": [drive("a", [0.0, 0.0]), drive("b", [1.0, 0.75])], "joints": [joint],
            "outputs": [{"kind": "position", "marker": "b.c"}]});
        let started = Run::ready(&scene).0.initialize(0.0);
        assert_eq!(started.is_ok(), fits, "{}: {started:?}", scene["joints"]);
        if let Err(error) = started {
            assert!(error.to_string().contains("link"), "{error}");
        }
    }
}
