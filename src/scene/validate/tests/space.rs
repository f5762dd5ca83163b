//! What space offers, and what it refuses for want of an angle.

use serde_json::{Value, json};

use super::check;

fn scene() -> Value {
    let cable = |name: &str, from: [f64; 3], to: [f64; 3]| {
        json!({"name": name, "element": "cable", "elements": 8,
            "material": {"youngs_modulus": 7e5, "density": 5540},
            "section": {"area": 1.8e-3, "second_moment": 0.0},
            "shape": {"line": {"from": from, "to": to}},
            "motion": {"velocity": [0, 1, 0], "spin": [0, 0, 1], "deformation": ["0", "0", "sin(PI*s)"]},
            "markers": {"root": 0, "mid": 0.5, "tip": 1}})
    };
    json!({
        "name": "everything", "dimension": 3, "gravity": [0, 0, -9.81],
        "bodies": [
            cable("rod", [0.0, 0.0, 0.0], [1.0, 0.0, 1.0]), cable("rope", [1.0, 0.0, 1.0], [3.0, 1.0, 0.0]),
            {"name": "load", "element": "rigid", "mass": 1, "position": [3, 1, 0], "markers": {"eye": [0, 0, 0]}}
        ],
        "masses": [{"marker": "rod.mid", "mass": 2}],
        "joints": [
            {"name": "clamp", "kind": "weld", "markers": ["ground", "rod.root"]},
            {"name": "knot", "kind": "revolute", "markers": ["rod.tip", "rope.root"]},
            {"name": "rail", "kind": "slider", "markers": ["ground", "load.eye"], "direction": [1, 0, 0]},
            {"name": "ring", "kind": "along", "markers": ["rope", "load.eye"]},
            {"name": "link", "kind": "distance", "markers": ["rod.mid", "load.eye"]}
        ],
        "motions": [{"name": "lift", "kind": "position", "marker": "rope.tip", "value": ["t", 0, 1]}],
        "loads": [
            {"name": "push", "kind": "force", "marker": "rod.tip", "value": ["t", 1, 0]},
            {"name": "tie", "kind": "spring_damper", "markers": ["ground", "rod.tip"], "point": [2, 1, 0],
                "stiffness": 1}
        ],
        "inputs": [{"kind": "distributed", "body": "rod", "start": [1, 2, 3]}],
        "outputs": [{"kind": "bending_moment", "marker": "rod.mid"}, {"kind": "reaction", "joint": "clamp"}],
        "ports": [{"name": "plug", "marker": "rod.tip", "kind": "force"}]
    })
}

#[test]
fn vectors_have_three_components() {
    check(
        scene,
        r#"
        /name | "net" | accepted
        /gravity | [0, -9.81] | gravity: expected 3 components [x, y, z], found 2
        /gravity | [1] | gravity: expected a list of 2 or 3, found 1
        /bodies/0/shape/line/to | [1, 0] | bodies[0].shape.line.to: expected 3 components [x, y, z], found 2
        /bodies/0/motion/spin | 1 | bodies[0].motion.spin: expected [x, y, z] in space, found 1
        /bodies/0/motion/spin | [1, 2] | bodies[0].motion.spin: expected a list of 3, found 2
        /bodies/0/motion/deformation | ["0", "0"] | bodies[0].motion.deformation: expected 3 values [x, y, z], found 2
        /bodies/2/position | [3, 1] | bodies[2].position: expected 3 components [x, y, z], found 2
        /bodies/2/markers/eye | [0, 0, 1] | bodies[2].markers.eye: expected [0, 0, 0] in a body without inertia
        /joints/2/direction | [1, 0] | joints[2].direction: expected 3 components [x, y, z], found 2
        /joints/2/direction | [0, 0, 0] | joints[2].direction: expected a direction that is not zero
        /motions/0/value | ["t", 0] | motions[0].value: expected 3 values [x, y, z], found 2
        /motions/0/value | 1 | motions[0].value: expected 3 values [x, y, z] or {"input": 0, 1 or 2}, found one value
        /loads/0/value | [1, 2] | loads[0].value: expected 3 values [x, y, z], found 2
        /loads/0/value | [1, 2, "t t"] | loads[0].value[2]: expected an operator
        /loads/1/point | [1, 2] | loads[1].point: expected 3 components [x, y, z], found 2
        /inputs/0/start | [1, 2] | inputs[0].start: expected 3 component(s), found 2
    "#,
    );
}

#[test]
fn what_has_an_angle_is_refused() {
    check(
        scene,
        r#"
        /rotation | 1 | rotation: expected 0 in space, found 1
        /initial | "steady" | initial: expected as_shaped or static_equilibrium in space, found steady
        /bodies/2/inertia | 1 | bodies[2].inertia: expected 0 of a rigid body, which is a particle in space, found 1
        /bodies/2/angle | 1 | bodies[2].angle: expected 0 of a rigid body, which is a particle in space, found 1
        /bodies/0/shape | {"arc": {"from": [0, 0, 0], "to": [1, 0, 0], "length": 2}} | accepted
        /bodies/0/shape | {"arc": {"from": [0, 0, 0], "to": [0, 0, 1], "length": 2}} | bodies[0].shape: expected ends of an arc that are not one above the other
        /bodies/0 | {"name": "rod", "element": "cable", "elements": 8, "material": {"youngs_modulus": 7e5, "density": 5540}, "section": {"area": 1.8e-3, "second_moment": 1e-9}, "shape": {"arc": {"from": [0, 0, 0], "to": [1, 0, 0], "length": 2}}} | bodies[0].section.second_moment: expected 0 of a cable that is curved without stress
        /masses/0/inertia | 1 | masses[0].inertia: expected 0 in space, found 1
        /joints/0/angle | 1 | joints[0].angle: expected nothing in space, found an angle
        /joints/0/markers | ["rope.tip", "rod.root"] | joints[0].kind: expected revolute, distance or along, or slider, weld, orientation or prismatic from the ground, in space, found weld between two bodies
        /joints/2/markers | ["rod.tip", "load.eye"] | joints[2].kind: expected revolute, distance or along, or slider, weld, orientation or prismatic from the ground, in space, found slider between two bodies
        /joints/0/markers | ["ground", "load.eye"] | joints[0].markers[1]: expected a marker of a cable
        /joints/1/kind | "orientation" | joints[1].kind: expected revolute, distance
        /joints/1/kind | "prismatic" | joints[1].kind: expected revolute, distance
        /joints/1 | {"name": "h", "kind": "hinge", "markers": ["rod.tip", "rope.root"], "stiffness": 1} | joints[1].kind: expected revolute, distance
        /motions/0 | {"name": "lift", "kind": "angle", "marker": "rope.tip", "value": 0} | motions[0].marker: expected nothing that has an angle
        /loads/0 | {"name": "push", "kind": "moment", "marker": "rod.tip", "value": 0} | loads[0].marker: expected nothing that has an angle
        /loads/0/follower | true | loads[0].marker: expected nothing that has an angle
        /outputs/0 | {"kind": "angle", "marker": "rod.tip"} | outputs[0].marker: expected nothing that has an angle
        /outputs/0 | {"kind": "direction", "marker": "rod.tip"} | accepted
        /outputs/0 | {"kind": "direction", "marker": "load.eye"} | outputs[0].marker: expected a marker that can turn
        /outputs/1 | {"kind": "reaction_moment", "joint": "clamp"} | outputs[1].joint: expected no moment in space, found "clamp"
        /ports/0/rotation | true | ports[0].marker: expected nothing that has an angle
    "#,
    );
}

fn rods() -> Value {
    let rod = |name: &str, x: f64| {
        json!({"name": name, "element": "rigid", "mass": 1, "inertia": [0, 0.1, 0.1], "position": [x, 0, 0],
            "markers": {"first": [-0.5, 0, 0], "last": [0.5, 0, 0]}})
    };
    json!({
        "name": "rods", "dimension": 3, "bodies": [rod("upper", 0.5), rod("lower", 1.5)],
        "joints": [
            {"name": "hook", "kind": "revolute", "markers": ["ground", "upper.first"], "direction": [0, 1, 0]},
            {"name": "elbow", "kind": "spherical", "markers": ["upper.last", "lower.first"]}
        ]
    })
}

#[test]
fn thin_rods_are_not_turned_about_their_axes() {
    check(
        rods,
        r#"
        /name | "net" | accepted
        /outputs | [{"kind": "natural_frequency", "count": 1}] | outputs[0].kind: expected nothing of a spectrum beside a rigid body that turns in space, found "upper"
        /bodies/0/markers/first | [-0.5, 0.1, 0] | bodies[0].markers.first: expected a point on the axis of a thin rod
        /joints/0/direction | [1, 0, 0] | accepted
        /joints/0/direction | [1, 1, 0] | joints[0].markers[1]: expected a body with a moment of inertia about every axis
        /joints/0/kind | "planar" | accepted
        /joints/1/kind | "weld" | joints[1].markers[0]: expected a body with a moment of inertia about every axis
        /joints/1 | {"name": "e", "kind": "revolute", "markers": ["upper.last", "lower.first"], "direction": [0, 1, 0]} | joints[1].markers[0]: expected a body with a moment
        /joints/1 | {"name": "e", "kind": "revolute", "markers": ["upper.last", "lower.first"], "direction": [1, 0, 0]} | accepted
        /joints/1 | {"name": "e", "kind": "universal", "markers": ["upper.last", "lower.first"], "direction": [1, 0, 0], "second_direction": [0, 1, 0]} | joints[1].markers[1]: expected a body with a moment
    "#,
    );
}
