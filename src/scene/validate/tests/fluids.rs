//! Fluids along bodies.

use serde_json::{Value, json};

use super::check;

fn scene() -> Value {
    json!({"name": "fluids", "dimension": 2,
        "bodies": [{"name": "rod", "element": "cable", "elements": 2,
            "material": {"youngs_modulus": 7e5, "density": 5540},
            "section": {"shape": {"circle": {"radius": 0.02}}},
            "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"tip": 1}},
            {"name": "ball", "element": "rigid", "mass": 1, "inertia": 1, "position": [0, 0]}],
        "loads": [{"name": "sea", "kind": "fluid", "body": "rod", "density": 1025, "current": [1, 0]}],
        "inputs": [{"kind": "current", "load": "sea"}]})
}

#[test]
fn fluids_have_a_density_and_stream_past_lines() {
    check(
        scene,
        r#"
        /loads/0/drag | 1.2 | accepted
        /loads/0/drag | -1 | loads[0].drag: expected zero or a positive number (1), found -1
        /loads/0/tangential_drag | -1 | loads[0].tangential_drag: expected zero or a positive number (1), found -1
        /loads/0/added_mass | -1 | loads[0].added_mass: expected zero or a positive number (1), found -1
        /loads/0/density | 0 | loads[0].density: expected a positive number (kg/m^3), found 0
        /loads/0/diameter | 0 | loads[0].diameter: expected a positive number (m), found 0
        /loads/0/area | -1 | loads[0].area: expected a positive number (m^2), found -1
        /loads/0/body | "ball" | loads[0].body: expected the name of a cable, rod, beam, plate or shell of this scene (rod), found "ball"
        /loads/0/current | [1] | loads[0].current: expected 2 values [x, y], found 1
        /loads/0/current | [] | loads[0].current: expected 2 values [x, y], found 0
        /loads/0/current | [1, "x"] | loads[0].current[1]:
        /loads/0/value | [1, 1] | loads[0].value: expected a key of the kind
        /loads/0 | {"name": "sea", "kind": "fluid", "body": "rod"} | loads[0].density: expected a density, found nothing
        /loads/0 | {"name": "sea", "kind": "fluid", "density": 1025} | loads[0].body: expected a name, found nothing
        /loads/0 | {"name": "sea", "kind": "distributed_force", "body": "rod", "value": [1, 0], "drag": 1} | loads[0].drag: expected a key of the kind
        /rotation | 1.5 | rotation: expected 0 where a fluid acts, which does not rotate with the frame, found
        /initial | {"state": "static_equilibrium", "loads": [{"name": "air", "kind": "fluid", "body": "rod", "density": 1}]} | initial.loads[0].kind: expected a force, a moment, a torque or a distributed one, found a fluid
        "#,
    );
}

#[test]
fn currents_that_are_inputs_are_numbers() {
    check(
        scene,
        r#"
        /inputs/0/start | [0.5, 0.5] | accepted
        /inputs/0/start | [0.5] | inputs[0].start: expected 2 component(s), found 1
        /inputs/0/load | "rod" | inputs[0].load: expected a fluid or an airfoil of this scene (sea), found "rod"
        /inputs/0 | {"kind": "rest_length", "load": "sea"} | inputs[0].load: expected a spring_damper or a reeving of this scene
        /inputs | [{"kind": "current", "load": "sea"}, {"kind": "current", "load": "sea"}] | inputs[1]: expected an input not declared before, found "sea"
        /loads/0/current | ["t", 0] | inputs[0].load: expected a load whose current or wind is numbers, found "sea", whose current changes
        "#,
    );
}
