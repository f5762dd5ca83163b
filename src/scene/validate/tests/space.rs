//! What space offers, and what it refuses: what has an angle of particles and of cables without torsion, what no body can
//! have, and what joints cannot hold.

use serde_json::{Value, json};

use super::check;
use crate::scene::Scene;

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
            {"name": "knot", "kind": "spherical", "markers": ["rod.tip", "rope.root"]},
            {"name": "rail", "kind": "point_on_line", "markers": ["ground", "load.eye"], "direction": [1, 0, 0]},
            {"name": "ring", "kind": "point_on_cable", "markers": ["rope", "load.eye"]},
            {"name": "link", "kind": "distance", "markers": ["rod.mid", "load.eye"]}
        ],
        "motions": [{"name": "lift", "kind": "position", "marker": "rope.tip", "value": ["t", 0, 1]}],
        "loads": [
            {"name": "push", "kind": "force", "marker": "rod.tip", "value": ["t", 1, 0]},
            {"name": "tie", "kind": "spring_damper", "markers": ["ground", "rod.tip"], "point": [2, 1, 0],
                "stiffness": 1}
        ],
        "inputs": [{"kind": "distributed_force", "body": "rod", "start": [1, 2, 3]}],
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
        /joints/2/second_direction | [0, 1, 0] | joints[2].second_direction: expected a key of the kind
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
fn what_a_particle_and_a_cable_do_not_have_is_refused() {
    check(
        scene,
        r#"
        /rotation | 1 | rotation: expected [x, y, z] in space, found 1
        /rotation | [0, 0, 1] | accepted
        /initial | "steady" | accepted
        /bodies/2/inertia | 0 | accepted
        /bodies/2/inertia | [0, 0, 0] | bodies[2].inertia: expected moments of inertia that are positive, one of them 0 at most
        /bodies/2/orientation | {"cardan": [0, 0, 1]} | bodies[2].orientation: expected nothing of a body without inertia
        /bodies/2/motion | {"spin": [0, 0, 1]} | bodies[2].motion.spin: expected 0 in a body without inertia
        /bodies/0/shape | {"arc": {"from": [0, 0, 0], "to": [1, 0, 0], "length": 2}} | accepted
        /bodies/0/shape | {"arc": {"from": [0, 0, 0], "to": [0, 0, 1], "length": 2}} | bodies[0].shape: expected ends of an arc that are not one above the other
        /bodies/0 | {"name": "rod", "element": "cable", "elements": 8, "material": {"youngs_modulus": 7e5, "density": 5540}, "section": {"area": 1.8e-3, "second_moment": 1e-9}, "shape": {"arc": {"from": [0, 0, 0], "to": [1, 0, 0], "length": 2}}} | bodies[0].section.second_moment: expected 0 of a cable that is curved without stress
        /masses/0/inertia | 1 | masses[0].inertia: expected 0 in space, found 1
        /joints/0/angle | 1 | joints[0].angle: expected nothing in space, found an angle
        /joints/0/markers | ["rope.tip", "rod.root"] | joints[0].markers: expected a rigid body or the ground beside a cable, which has no axes, found two cables
        /joints/0/markers | ["ground", "load.eye"] | joints[0].markers[1]: expected a marker of a rigid body with inertia
        /joints/2/markers | ["rod.tip", "load.eye"] | joints[2].markers[0]: expected a marker of a rigid body with inertia
        /joints/1/kind | "orientation" | joints[1].markers: expected a rigid body or the ground beside a cable
        /joints/1/kind | "spherical" | accepted
        /joints/1/kind | "prismatic" | joints[1].direction: expected a direction [x, y, z], found nothing
        /joints/1/direction | [0, 0, 1] | joints[1].direction: expected a key of the kind spherical
        /joints/1 | {"name": "knot", "kind": "revolute", "markers": ["rod.tip", "rope.root"], "direction": [0, 0, 1]} | joints[1].markers[0]: expected a marker of a rigid body with inertia or of a rod, which has axes
        /joints/2/kind | "cylindrical" | joints[2].markers[1]: expected a marker of a rigid body with inertia
        /joints/2/kind | "planar" | joints[2].markers[1]: expected a marker of a rigid body with inertia
        /joints/1 | {"name": "h", "kind": "revolute", "markers": ["rod.tip", "rope.root"], "stiffness": 1} | joints[1].direction: expected the axis [x, y, z] that a revolute joint rotates about (a ball joint is `spherical`), found nothing
        /joints/1 | {"name": "h", "kind": "revolute", "markers": ["rod.tip", "rope.root"], "stiffness": 1, "direction": [0, 0, 1]} | joints[1].markers[0]: expected a marker of a rigid body with inertia
        /motions/0 | {"name": "lift", "kind": "angle", "marker": "rope.tip", "value": 0} | motions[0].marker: expected nothing in space, where
        /motions/0 | {"name": "lift", "kind": "angle", "joint": "knot", "value": 0} | motions[0].joint: expected a revolute joint with a direction, or a cylindrical one
        /loads/0 | {"name": "push", "kind": "moment", "marker": "rod.tip", "value": [0, 0, 1]} | loads[0].marker: expected a marker of a rigid body with inertia or of a rod; a cable without torsion has a direction alone
        /loads/0 | {"name": "push", "kind": "torque", "joint": "knot", "value": 1} | loads[0].joint: expected a revolute joint with a direction
        /loads/0/follower | true | loads[0].marker: expected a marker of a rigid body with inertia
        /outputs/0 | {"kind": "angle", "marker": "rod.tip"} | outputs[0].marker: expected nothing in space, where
        /outputs/0 | {"kind": "angle", "joint": "knot"} | outputs[0].joint: expected a revolute joint with a direction
        /outputs/0 | {"kind": "direction", "marker": "rod.tip"} | accepted
        /outputs/0 | {"kind": "direction", "marker": "load.eye"} | outputs[0].marker: expected a marker that can rotate
        /outputs/0 | {"kind": "angular_velocity", "marker": "rod.tip"} | outputs[0].marker: expected a marker of a rigid body with inertia
        /outputs/0 | {"kind": "orientation", "marker": "load.eye"} | outputs[0].marker: expected a marker of a rigid body with inertia
        /outputs/1 | {"kind": "reaction_moment", "joint": "clamp"} | accepted
        /outputs/1 | {"kind": "reaction_moment", "joint": "knot"} | outputs[1].joint: expected a joint that transmits a moment, found "knot"
        /ports/0/rotation | true | ports[0].marker: expected a marker of a rigid body with inertia or of a rod; a cable without torsion
    "#,
    );
}

/// The scene with nothing but its first body, a rod.
fn rod() -> Value {
    let mut scene = scene();
    for key in ["masses", "motions", "loads", "ports"] {
        scene[key] = json!([]);
    }
    scene["joints"] = json!([]);
    scene["outputs"] = json!([{ "kind": "position", "marker": "rod.tip" }]);
    scene["inputs"] = json!([]);
    let only = scene["bodies"][0].clone();
    scene["bodies"] = json!([only]);
    scene
}

#[test]
fn rods_say_what_their_sections_are() {
    check(
        rod,
        r#"
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 7e5, "shear_modulus": 3e5, "density": 5540}, "section": {"area": 1.8e-3, "second_moments": [1e-9, 2e-9], "torsion_constant": 1e-9}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | accepted
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}, "axis": [0, 1, 0]} | accepted
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}, "axis": [2, 0, 0]} | bodies[0].axis: expected a direction that is not along the tangent at the first end
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | bodies[0].material.shear_modulus: expected a value, found nothing
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09]}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | bodies[0].section.torsion_constant: expected a value of a rod, found nothing
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | bodies[0].section.second_moments: expected two values of a rod, found nothing
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 0], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | bodies[0].section.second_moments[1]: expected
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09, "second_moment": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | bodies[0].section.second_moment: expected `second_moments` of a rod, one about each axis
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}, "strain": "GreenLagrange_FrenetKappa"} | bodies[0].strain: expected "thetaPrime" of a rod
        /bodies/0 | {"name": "rod", "element": "rod", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}, "model": "rigid"} | bodies[0].model: expected "auto" or "flexible"
        /bodies/0 | {"name": "rod", "element": "cable", "elements": 8, "material": {"youngs_modulus": 700000.0, "shear_modulus": 300000.0, "density": 5540}, "section": {"area": 0.0018, "second_moments": [1e-09, 2e-09], "torsion_constant": 1e-09}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}} | bodies[0].material.shear_modulus: expected nothing of a cable
    "#,
    );
}

#[test]
fn sections_are_shapes_or_numbers_or_at_stations() {
    let scene = || {
        let mut scene = rod();
        scene["bodies"][0] = json!({"name": "rod", "element": "rod", "elements": 8,
            "material": {"youngs_modulus": 7e5, "shear_modulus": 3e5, "density": 5540},
            "section": {"shape": {"tube": {"radius": 0.02, "inner_radius": 0.01}}},
            "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}});
        scene
    };
    check(
        scene,
        r#"
        /bodies/0/section | {"shape": {"rectangle": {"width": 0.01, "height": 0.02}}} | accepted
        /bodies/0/section | {"shape": {"circle": {"radius": 0}}} | bodies[0].section.shape.circle.radius: expected
        /bodies/0/section | {"shape": {"tube": {"radius": 0.01, "inner_radius": 0.01}}} | bodies[0].section.shape.tube.inner_radius: expected less than the outer radius
        /bodies/0/section | {"shape": {"star": {"radius": 0.01}}} | bodies[0].section.shape: expected
        /bodies/0/section | {"shape": {"circle": {"radius": 0.01}}, "area": 1} | bodies[0].section.area: expected nothing beside `shape`
        /bodies/0/section | {} | bodies[0].section: expected a cross section, or `stations`
        /bodies/0/section | {"shape": {"circle": {"radius": 0.01}}, "coupling": [1e3, 0, 0]} | bodies[0].section.coupling: expected stiffness that couples less
        /bodies/0/stations | [] | accepted
        /bodies/0/stations | [{"at": 0, "section": {"shape": {"circle": {"radius": 0.01}}}}] | bodies[0].section: expected nothing beside `stations`
        "#,
    );
    let tapered = || {
        let mut scene = scene();
        let station =
            |at: f64| json!({"at": at, "section": {"shape": {"circle": {"radius": 0.02}}}});
        scene["bodies"][0]["stations"] =
            json!([station(0.0), station(0.4), station(0.4), station(1.0)]);
        if let Some(body) = scene["bodies"][0].as_object_mut() {
            body.remove("section");
        }
        scene
    };
    check(
        tapered,
        r#"
        /bodies/0/stations/0/at | 0.1 | bodies[0].stations[0].at: expected stations from 0 to 1 in order
        /bodies/0/stations/3/at | 0.9 | bodies[0].stations[3].at: expected stations from 0 to 1 in order
        /bodies/0/stations/3/at | 0.4 | bodies[0].stations[3].at: expected stations from 0 to 1 in order
        /bodies/0/stations/1/at | 0.6 | bodies[0].stations[2].at: expected stations from 0 to 1 in order
        /bodies/0/stations/2/twist | 0.1 | bodies[0].stations[2].twist: expected the twist of the other station at this place
        /bodies/0/stations/1/section | {"shape": {"rectangle": {"width": 0.01, "height": 0}}} | bodies[0].stations[1].section.shape.rectangle.height: expected
        "#,
    );
    let cable = || {
        let mut scene = tapered();
        scene["bodies"][0]["element"] = json!("cable");
        scene["bodies"][0]["material"] = json!({"youngs_modulus": 7e5, "density": 5540});
        scene
    };
    check(
        cable,
        r#"
        /bodies/0/stations/1/section | {"shape": {"rectangle": {"width": 0.01, "height": 0.02}}} | bodies[0].stations[1].section.shape.rectangle: expected a circle or a tube of a cable
        /bodies/0/stations/1/section | {"shape": {"rectangle": {"width": 0.02, "height": 0.02}}} | accepted
        /bodies/0/stations/3/twist | 0.1 | bodies[0].stations[3].twist: expected 0 of a cable
        /bodies/0/model | "rigid" | bodies[0].stations: expected none of a rigid rod
        "#,
    );
}

/// Rigid bodies and every joint between them.
fn mechanism() -> Value {
    let body = |name: &str, position: [f64; 3]| {
        json!({"name": name, "element": "rigid", "mass": 1, "inertia": [1, 2, 2.5], "position": position,
            "orientation": {"cardan": [0.1, 0.2, 0.3]}, "motion": {"spin": [0, 0, 1]},
            "markers": {"in": [-0.5, 0, 0], "out": [0.5, 0.1, 0.2]}})
    };
    json!({
        "name": "mechanism", "dimension": 3,
        "bodies": [
            body("a", [0.0, 0.0, 0.0]), body("b", [1.0, 0.0, 0.0]), body("c", [2.0, 0.0, 0.0]),
            {"name": "rope", "element": "cable", "elements": 8,
                "material": {"youngs_modulus": 7e5, "density": 5540},
                "section": {"area": 1.8e-3, "second_moment": 0.0},
                "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0, "tip": 1}}
        ],
        "joints": [
            {"name": "pin", "kind": "revolute", "markers": ["ground", "a.in"], "direction": [0, 0, 1]},
            {"name": "elbow", "kind": "revolute", "markers": ["a.out", "b.in"], "direction": [0, 1, 0], "stiffness": 1,
                "angle": 0.1},
            {"name": "cross", "kind": "universal", "markers": ["b.out", "c.in"], "direction": [1, 0, 0],
                "second_direction": [0, 1, 0]},
            {"name": "sleeve", "kind": "cylindrical", "markers": ["a.in", "c.out"], "direction": [1, 1, 0]},
            {"name": "table", "kind": "planar", "markers": ["ground", "c.in"], "direction": [0, 0, 1]},
            {"name": "rail", "kind": "prismatic", "markers": ["a.in", "b.out"], "direction": [1, 0, 0]},
            {"name": "clamp", "kind": "weld", "markers": ["a.in", "rope.root"]},
            {"name": "ball", "kind": "spherical", "markers": ["b.in", "rope.tip"]},
            {"name": "track", "kind": "point_on_line", "markers": ["b.in", "rope.tip"], "direction": [1, 0, 0]},
            {"name": "guide", "kind": "orientation", "markers": ["a.in", "c.in"]}
        ],
        "motions": [{"name": "turn", "kind": "angle", "joint": "pin", "value": "t"}],
        "loads": [
            {"name": "twist", "kind": "moment", "marker": "a.in", "value": [1, "t", 0]},
            {"name": "follow", "kind": "moment", "marker": "b.in", "value": [1, 2, 3], "follower": true},
            {"name": "thrust", "kind": "force", "marker": "c.in", "value": [1, 2, 3], "follower": true},
            {"name": "motor", "kind": "torque", "joint": "elbow", "value": 2}
        ],
        "inputs": [
            {"kind": "moment", "marker": "a.in", "start": [1, 2, 3]},
            {"kind": "moment", "marker": "a.in", "follower": true},
            {"kind": "torque", "joint": "sleeve", "start": [1]}
        ],
        "outputs": [
            {"kind": "orientation", "marker": "a.in"}, {"kind": "angular_velocity", "marker": "a.in"},
            {"kind": "angle", "joint": "sleeve"}, {"kind": "angular_acceleration", "joint": "elbow"},
            {"kind": "reaction_moment", "joint": "cross"}, {"kind": "reaction_moment", "motion": "turn"},
            {"kind": "reaction", "joint": "table"}
        ]
    })
}

#[test]
fn a_mechanism_is_valid_and_survives_being_written() {
    let read = Scene::from_json(&mechanism().to_string()).expect("a valid scene");
    assert_eq!(Scene::from_json(&read.to_json()), Ok(read));
}

/// The mechanism with a body of a shape.
fn shaped() -> Value {
    let mut scene = mechanism();
    let body = scene["bodies"][0].as_object_mut().expect("a body");
    body.remove("mass");
    body.remove("inertia");
    body.insert("density".into(), json!(7850));
    body.insert("shape".into(), json!({"box": {"size": [0.1, 0.2, 0.3]}}));
    scene
}

#[test]
fn shapes_are_what_bodies_can_be() {
    check(
        shaped,
        r#"
        /bodies/0/shape | {"sphere": {"radius": 0.2}} | accepted
        /bodies/0/shape | {"cylinder": {"radius": 0.2, "length": 1}} | accepted
        /bodies/0/shape | {"tube": {"radius": 0.2, "inner_radius": 0.1, "length": 1, "axis": [0, 3, 4]}} | accepted
        /bodies/0/shape | null | bodies[0].shape: expected `shape` beside `density`, or `mass` instead of both, found nothing
        /bodies/0/density | null | bodies[0].density: expected a positive number (kg/m^3) beside `shape`, or `mass` instead, found nothing
        /bodies/0/density | 0 | bodies[0].density: expected a positive number (kg/m^3), found 0
        /bodies/0/mass | 1 | bodies[0].mass: expected nothing beside `shape` and `density`, from which it follows, found a value
        /bodies/0/inertia | [1, 1, 1] | bodies[0].inertia: expected nothing beside `shape` and `density`, from which it follows, found a value
        /bodies/0/shape/box/size/1 | 0 | bodies[0].shape.box.size[1]: expected a positive number (m), found 0
        /bodies/0/shape/box/size | [1, 2] | bodies[0].shape.box.size: expected a list of 3, found 2
        /bodies/0/shape | {"ball": {}} | bodies[0].shape: expected "box" or "cylinder" or "sphere" or "tube", found "ball"
        /bodies/0/shape | {"sphere": {"radius": -1}} | bodies[0].shape.sphere.radius: expected a positive number (m), found -1
        /bodies/0/shape | {"sphere": {"radius": 1e103}} | bodies[0].shape: expected a shape and a density whose mass (kg) and inertia are numbers of the machine
        /bodies/0/shape | {"cylinder": {"radius": 1, "length": 1, "axis": [0, 0, 0]}} | bodies[0].shape.cylinder.axis: expected three finite numbers, not all zero, found [0.0, 0.0, 0.0]
        /bodies/0/shape | {"tube": {"radius": 1, "inner_radius": 1, "length": 1}} | bodies[0].shape.tube.inner_radius: expected less than the outer radius (1 m), found 1
        /bodies/0/shape | {"tube": {"radius": 1, "length": 1}} | bodies[0].shape.tube.inner_radius: expected a value, found nothing
    "#,
    );
    check(
        mechanism,
        r#"
        /bodies/0/mass | null | bodies[0].mass: expected a positive number (kg), or `shape` and `density`, found nothing
        /bodies/0/density | 1 | bodies[0].shape: expected `shape` beside `density`, or `mass` instead of both, found nothing
        /bodies/0/shape | {"sphere": {"radius": 0.2}} | accepted
        /bodies/0/shape | {"sphere": {"radius": 0}} | bodies[0].shape.sphere.radius: expected a positive number (m), found 0
    "#,
    );
}

#[test]
fn rigid_bodies_are_what_bodies_can_be() {
    check(
        mechanism,
        r#"
        /bodies/0/inertia | 1 | bodies[0].inertia: expected three moments of inertia or a tensor of a body in space (0 of a particle), found 1
        /bodies/0/inertia | -1 | bodies[0].inertia: expected zero or a positive number (kg m^2)
        /bodies/0/inertia | 0 | bodies[0].orientation: expected nothing of a body without inertia
        /bodies/0/inertia | [1, 2] | bodies[0].inertia: expected a list of 3, found 2
        /bodies/0/inertia | [[1, 0, 0], [0, 1, 0]] | bodies[0].inertia: expected a list of 3, found 2
        /bodies/0/inertia | [1, 1, 2] | accepted
        /bodies/0/inertia | [0, 1, 1] | bodies[0].markers.out: expected a point on the axis of a thin rod
        /bodies/0/inertia | [1, 1, 2.1] | bodies[0].inertia: expected moments of inertia of which none is more than the sum of the other two
        /bodies/0/inertia | [0, 0, 1] | bodies[0].inertia: expected moments of inertia that are positive, one of them 0 at most (a thin rod)
        /bodies/0/inertia | [-0.1, 1, 1] | bodies[0].inertia: expected moments of inertia that are positive
        /bodies/0/inertia | [[2, 0.3, 0.1], [0.3, 2, 0], [0.1, 0, 2]] | accepted
        /bodies/0/inertia | [[2, 0.3, 0], [0.2, 2, 0], [0, 0, 2]] | bodies[0].inertia: expected a symmetric tensor
        /bodies/0/inertia | [[2, 1.5, 0], [1.5, 2, 0], [0, 0, 2]] | bodies[0].inertia: expected moments of inertia of which none is more
        /bodies/0/inertia | [[2, 3, 0], [3, 2, 0], [0, 0, 2]] | bodies[0].inertia: expected moments of inertia that are positive
        /bodies/0/angle | 1 | bodies[0].angle: expected 0 beside `orientation`, which says how a body stands, in space, found 1
        /bodies/0/motion/spin | 1 | bodies[0].motion.spin: expected [x, y, z] in space, found 1
        /bodies/0/markers/in | [1, 2] | bodies[0].markers.in: expected 3 components [x, y, z], found 2
        /bodies/0/orientation | null | accepted
        /bodies/0/orientation | {"rotation_vector": [0, 0, 7]} | accepted
        /bodies/0/orientation | {"euler": [1, 2, 3]} | accepted
        /bodies/0/orientation | {"quaternion": [0, 2, 0, 0]} | accepted
        /bodies/0/orientation | {"quaternion": [0, 0, 0, 0]} | bodies[0].orientation: expected finite numbers, of a matrix orthonormal right-handed axes, of a quaternion not all zero, found [0.0, 0.0, 0.0, 0.0]
        /bodies/0/orientation | {"matrix": [[0, -1, 0], [1, 0, 0], [0, 0, 1]]} | accepted
        /bodies/0/orientation | {"matrix": [[0, 1, 0], [1, 0, 0], [0, 0, 1]]} | bodies[0].orientation: expected finite numbers, of a matrix orthonormal right-handed axes
        /bodies/0/orientation | {"matrix": [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]} | bodies[0].orientation: expected finite numbers, of a matrix orthonormal
        /bodies/0/orientation | {"cardan": [1, 2]} | bodies[0].orientation
        /bodies/0/orientation | {"angles": [1, 2, 3]} | bodies[0].orientation
    "#,
    );
}

#[test]
fn joints_hold_axes_of_the_ground_and_of_rigid_bodies() {
    check(
        mechanism,
        r#"
        /joints/0/direction | null | joints[0].direction: expected the axis [x, y, z] that a revolute joint rotates about (a ball joint is `spherical`), found nothing
        /joints/0/kind | "spherical" | joints[0].direction: expected a key of the kind
        /joints/0/direction | [0, 0, 0] | joints[0].direction: expected a direction that is not zero
        /joints/1/direction | null | joints[1].direction: expected the axis [x, y, z] that a revolute joint rotates about (a ball joint is `spherical`), found nothing
        /joints/1/stiffness | null | joints[1].angle: expected a stiffness or a damping beside the angle of a revolute joint, found neither
        /joints/2/second_direction | null | joints[2].second_direction: expected a direction [x, y, z], found nothing
        /joints/2/second_direction | [0, 0, 0] | joints[2].second_direction: expected a direction that is not zero
        /joints/2/second_direction | [0, 1] | joints[2].second_direction: expected 3 components [x, y, z], found 2
        /joints/2/second_direction | [1, 1, 0] | joints[2].second_direction: expected a direction across `direction`, found one at 0.785398
        /joints/2/markers | ["b.out", "rope.tip"] | joints[2].markers[1]: expected a marker of a rigid body with inertia or of a rod, which has axes
        /joints/3/direction | null | joints[3].direction: expected a direction [x, y, z], found nothing
        /joints/3/markers | ["rope.tip", "c.out"] | joints[3].markers[0]: expected a marker of a rigid body with inertia
        /joints/4/markers | ["ground", "rope.tip"] | joints[4].markers[1]: expected a marker of a rigid body with inertia
        /joints/5/direction | null | joints[5].direction: expected a direction [x, y, z], found nothing
        /joints/5/angle | 1 | joints[5].angle: expected nothing in space, found an angle
        /joints/5/markers | ["rope.tip", "b.out"] | joints[5].markers[0]: expected a marker of a rigid body with inertia
        /joints/6/markers | ["rope.root", "a.in"] | accepted
        /joints/6/angle | 1 | joints[6].angle: expected nothing in space, found an angle
        /joints/7/direction | [1, 0, 0] | joints[7].direction: expected a key of the kind
        /joints/8/markers | ["rope.tip", "b.in"] | joints[8].markers[0]: expected a marker of a rigid body with inertia
        /joints/9/angle | 1 | joints[9].angle: expected nothing in space, found an angle
    "#,
    );
}

#[test]
fn moments_turns_and_what_is_read_of_them_belong_to_bodies_that_turn() {
    check(
        mechanism,
        r#"
        /motions/0/joint | "elbow" | accepted
        /motions/0/joint | "sleeve" | accepted
        /motions/0/joint | "cross" | motions[0].joint: expected a revolute joint with a direction, or a cylindrical one, found "cross"
        /motions/0 | {"name": "turn", "kind": "angle", "marker": "a.in", "value": 0} | motions[0].marker: expected nothing in space, where
        /motions | [{"name": "turn", "kind": "angle", "joint": "pin", "value": 0}, {"name": "slide", "kind": "displacement", "joint": "rail", "value": 0}] | accepted
        /motions/0 | {"name": "turn", "kind": "displacement", "joint": "ball", "value": 0} | motions[0].joint: expected a joint along a line of the ground or of a rigid body, found "ball"
        /gears | [{"name": "g", "joints": ["elbow", "rail"], "ratio": 0.5}] | accepted
        /gears | [{"name": "elbow", "joints": ["elbow", "rail"], "ratio": 0.5}] | gears[0].name: expected a name not used yet
        /gears | [{"name": "g", "joints": ["elbow", "none"], "ratio": 0.5}] | gears[0].joints[1]: expected a joint of this scene
        /gears | [{"name": "g", "joints": ["elbow", "ball"], "ratio": 0.5}] | gears[0].joints[1]: expected a joint with an angle or along a line
        /gears | [{"name": "g", "joints": ["elbow", "elbow"], "ratio": 0.5}] | gears[0].joints: expected two joints, found "elbow" twice
        /latches | [{"name": "l", "joint": "elbow", "at": 0.5}, {"name": "m", "joint": "rail", "most_force": 2.0}] | accepted
        /latches | [{"name": "elbow", "joint": "elbow"}] | latches[0].name: expected a name not used yet
        /latches | [{"name": "l", "joint": "none"}] | latches[0].joint: expected a joint of this scene
        /latches | [{"name": "l", "joint": "ball"}] | latches[0].joint: expected a joint with an angle or along a line
        /latches | [{"name": "l", "joint": "elbow", "coordinate": "displacement"}] | latches[0].joint: expected a joint along a line
        /latches | [{"name": "l", "joint": "elbow", "from_time": -1}] | latches[0].from_time: expected zero or a positive number (s), found -1
        /latches | [{"name": "l", "joint": "elbow", "least_force": 2, "most_force": 1}] | latches[0].most_force: expected more than least_force = 2, found 1
        /gears | [{"name": "g", "joints": ["elbow", "rail"], "ratio": 0}] | gears[0].ratio: expected a number that is not zero (m/rad), found 0
        /outputs/0 | {"kind": "gear_torque", "gear": "g"} | outputs[0].gear: expected a gear of this scene
        /outputs/0 | {"kind": "displacement", "joint": "elbow"} | outputs[0].joint: expected a joint along a line
        /outputs/0 | {"kind": "velocity", "joint": "rail"} | accepted
        /joints/0 | {"name": "s", "kind": "screw", "markers": ["ground", "a.in"], "direction": [1, 0, 0]} | joints[0].pitch: expected a pitch, found nothing
        /joints/0 | {"name": "s", "kind": "screw", "markers": ["ground", "a.in"], "direction": [1, 0, 0], "pitch": 0} | joints[0].pitch: expected a number that is not zero (m), found 0
        /joints/0 | {"name": "s", "kind": "generic", "markers": ["ground", "a.in"], "free": ["x", "x"]} | joints[0].free[1]: expected a freedom that is not in the list yet
        /joints/0 | {"name": "s", "kind": "generic", "markers": ["ground", "a.in"], "free": ["x", "y", "z", "rotation_x", "rotation_y", "rotation_z"]} | joints[0].free: expected freedoms that leave something to hold, found all six
        /joints/0 | {"name": "s", "kind": "generic", "markers": ["ground", "rope.tip"], "free": ["x"]} | joints[0].markers[1]: expected a marker of a rigid body with inertia
        /loads/0 | {"name": "l", "kind": "joint_spring", "joint": "rail"} | loads[0]: expected a stiffness or a damping, found neither
        /loads/0 | {"name": "l", "kind": "joint_spring", "joint": "rail", "coordinate": "angle", "stiffness": 1} | loads[0].joint: expected a revolute joint with a direction
        /loads/0 | {"name": "l", "kind": "joint_spring", "joint": "ball", "stiffness": 1} | loads[0].joint: expected a joint with an angle or along a line
        /loads/0 | {"name": "l", "kind": "joint_spring", "joint": "elbow", "stiffness": -1} | loads[0].stiffness: expected zero or a positive number (N m/rad), found -1
        /loads/0 | {"name": "l", "kind": "joint_limit", "joint": "rail", "stiffness": 5} | loads[0]: expected a lower or an upper limit, found neither
        /loads/0 | {"name": "l", "kind": "joint_limit", "joint": "rail", "stiffness": 0, "lower": 1} | loads[0].stiffness: expected a positive number (N/m), found 0
        /loads/0 | {"name": "l", "kind": "joint_limit", "joint": "rail", "stiffness": 5, "lower": 1, "upper": 0} | loads[0].upper: expected a limit that is not below `lower`, 1, found 0
        /loads/0 | {"name": "l", "kind": "joint_friction", "joint": "rail", "force": 5} | accepted
        /loads/0 | {"name": "l", "kind": "joint_friction", "joint": "rail"} | loads[0].force: expected
        /loads/0 | {"name": "l", "kind": "joint_friction", "joint": "ball", "force": 5} | loads[0].joint: expected a joint with an angle or along a line
        /loads/0 | {"name": "l", "kind": "joint_friction", "joint": "rail", "force": 5, "static_ratio": 0.9} | loads[0].static_ratio: expected a number from 1 on, found 0.9
        /loads/0 | {"name": "l", "kind": "joint_friction", "joint": "rail", "force": 5, "stribeck_speed": -1} | loads[0].stribeck_speed: expected zero or a positive number (m/s), found -1
        /inputs | [{"kind": "friction", "load": "l"}] | inputs[0].load: expected a joint_friction of this scene
        /loads/0 | {"name": "l", "kind": "bushing", "markers": ["a.in", "b.out"]} | loads[0]: expected stiffnesses or dampings, found none
        /loads/0 | {"name": "l", "kind": "bushing", "markers": ["ground", "rope.tip"], "rotational_stiffness": [1, 1, 1]} | loads[0].markers[1]: expected a marker of a rigid body with inertia
        /loads/0 | {"name": "l", "kind": "bushing", "markers": ["a.in", "b.out"], "rotational_damping": [1, 1, -1]} | loads[0].rotational_damping[2]: expected zero or a positive number (N m s/rad), found -1
        /loads/0/value | 1 | loads[0].value: expected 3 values [x, y, z], found 1
        /loads/0/value | [1, 2] | loads[0].value: expected 3 values [x, y, z], found 2
        /loads/1/marker | "rope.tip" | loads[1].marker: expected a marker of a rigid body with inertia
        /loads/2/marker | "rope.tip" | loads[2].marker: expected a marker of a rigid body with inertia
        /loads/3/joint | "table" | loads[3].joint: expected a revolute joint with a direction
        /loads/3/joint | "ball" | loads[3].joint: expected a revolute joint with a direction
        /loads/3/value | [1, 2, 3] | loads[3].value: expected one value, found 3
        /inputs/0/start | [1] | inputs[0].start: expected 3 component(s), found 1
        /inputs/2/start | [1, 2, 3] | inputs[2].start: expected 1 component(s), found 3
        /inputs/2/joint | "guide" | inputs[2].joint: expected a revolute joint with a direction
        /outputs/0/marker | "rope.tip" | outputs[0].marker: expected a marker of a rigid body with inertia or of a rod; a cable without torsion
        /outputs/1/marker | "rope.tip" | outputs[1].marker: expected a marker of a rigid body with inertia
        /outputs/2/joint | "cross" | outputs[2].joint: expected a revolute joint with a direction
        /outputs/4/joint | "ball" | outputs[4].joint: expected a joint that transmits a moment, found "ball"
        /outputs/4/joint | "track" | outputs[4].joint: expected a joint that transmits a moment, found "track"
        /outputs/6/joint | "guide" | outputs[6].joint: expected a joint that transmits a force, found "guide"
        /outputs/0 | {"kind": "quaternion", "marker": "rope.tip"} | outputs[0].marker: expected a marker of a rigid body with inertia
        /outputs/0 | {"kind": "rotation_vector", "marker": "a.in"} | accepted
        /outputs/0 | {"kind": "angular_velocity", "marker": "a.in", "axes": "body"} | accepted
        /outputs/0 | {"kind": "angular_velocity", "joint": "elbow", "axes": "body"} | outputs[0].axes: expected nothing beside `joint`, found axes
        /outputs/0 | {"kind": "velocity", "marker": "a.in", "axes": "body"} | outputs[0].axes: expected a key of the kind
        /outputs/0 | {"kind": "reaction", "joint": "elbow", "axes": "body"} | accepted
        /outputs/0 | {"kind": "reaction", "joint": "elbow", "axes": "joint"} | outputs[0].axes: expected "
        /ports | [{"name": "plug", "marker": "a.in", "kind": "force", "rotation": true}] | accepted
        /ports | [{"name": "plug", "marker": "b.in", "kind": "motion", "stiffness": 1, "rotational_stiffness": 1}] | accepted
        /ports | [{"name": "plug", "marker": "b.in", "kind": "motion", "rotation": true}] | accepted
        /ports | [{"name": "plug", "marker": "rope.tip", "kind": "motion", "rotation": true}] | ports[0].marker: expected a marker of a rigid body with inertia
        /ports | [{"name": "plug", "marker": "b.in", "kind": "motion", "rotation": true}, {"name": "socket", "marker": "b.in", "kind": "motion"}] | ports[1].marker: expected a marker that is not driven yet
    "#,
    );
}

#[test]
fn orientations_are_driven_by_quaternions() {
    check(
        mechanism,
        r#"
        /motions | [{"name": "turn", "kind": "orientation", "marker": "b.in", "value": {"input": 2}}] | accepted
        /motions | [{"name": "turn", "kind": "orientation", "marker": "b.in", "value": [1, 0, 0, "sin(t)"]}] | accepted
        /motions | [{"name": "turn", "kind": "orientation", "marker": "b.in", "value": [1, 0, 0]}] | motions[0].value: expected 4 values [w, x, y, z] or {"input": 0, 1 or 2}, found 3 values
        /motions | [{"name": "turn", "kind": "orientation", "marker": "b.in", "value": 1}] | motions[0].value: expected 4 values [w, x, y, z] or {"input": 0, 1 or 2}, found one value
        /motions | [{"name": "turn", "kind": "orientation", "marker": "b.in", "value": {"input": 3}}] | motions[0].value.input: expected 0, 1 or 2, found 3
        /motions | [{"name": "turn", "kind": "orientation", "marker": "b.in", "value": [1, 0, "sin(", 0]}] | motions[0].value[2]
        /motions | [{"name": "turn", "kind": "orientation", "marker": "rope.tip", "value": {"input": 2}}] | motions[0].marker: expected a marker of a rigid body with inertia
        /motions | [{"name": "turn", "kind": "orientation", "value": {"input": 2}}] | motions[0].marker: expected a name, found nothing
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
        /outputs | [{"kind": "natural_frequency", "count": 1}] | accepted
        /bodies/0/markers/first | [-0.5, 0.1, 0] | bodies[0].markers.first: expected a point on the axis of a thin rod
        /joints/0/direction | [1, 0, 0] | accepted
        /joints/0/direction | [1, 1, 0] | joints[0].markers[1]: expected a body with a moment of inertia about every axis
        /motions | [{"name": "m", "kind": "orientation", "marker": "lower.last", "value": {"input": 2}}] | motions[0].marker: expected a body with a moment of inertia about every axis, found "lower.last"
        /ports | [{"name": "plug", "marker": "lower.last", "kind": "motion", "rotation": true}] | ports[0].marker: expected a body with a moment of inertia about every axis, found "lower.last"
        /joints/0/kind | "planar" | accepted
        /joints/1/kind | "weld" | joints[1].markers[0]: expected a body with a moment of inertia about every axis
        /joints/1 | {"name": "e", "kind": "revolute", "markers": ["upper.last", "lower.first"], "direction": [0, 1, 0]} | joints[1].markers[0]: expected a body with a moment
        /joints/1 | {"name": "e", "kind": "revolute", "markers": ["upper.last", "lower.first"], "direction": [1, 0, 0]} | accepted
        /joints/1 | {"name": "e", "kind": "universal", "markers": ["upper.last", "lower.first"], "direction": [1, 0, 0], "second_direction": [0, 1, 0]} | joints[1].markers[1]: expected a body with a moment
    "#,
    );
}

/// The thread of a screw relates a displacement along its axis, which a rod has none of: it was left out without a word.
#[test]
fn the_axis_of_a_screw_belongs_to_no_rod() {
    let mut scene = scene();
    scene["bodies"][0]["element"] = json!("rod");
    scene["bodies"][0]["section"] =
        json!({"area": 1.8e-3, "second_moments": [1e-9, 2e-9], "torsion_constant": 1e-9});
    scene["bodies"][0]["material"]["shear_modulus"] = json!(3e5);
    scene["bodies"][2]["inertia"] = json!([1, 1, 1]);
    scene["joints"][2] = json!({"name": "rail", "kind": "screw", "markers": ["rod.tip", "load.eye"],
        "direction": [1, 0, 0], "pitch": 0.1});
    let error = Scene::from_json(&scene.to_string()).expect_err("no such axis");
    let told = "joints[2].markers[0]: expected the ground or a marker of a rigid body, which carries the axis, found \"rod.tip\"";
    assert_eq!(error.to_string(), told);
}
