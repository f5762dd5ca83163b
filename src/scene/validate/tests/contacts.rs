//! What may touch what, and how contacts are told.

use serde_json::{Value, json};

use super::check;

fn scene(dimension: usize) -> Value {
    let place = |x: f64| vec![x, 0.0, 0.0][..dimension].to_vec();
    json!({"name": "contact", "dimension": dimension,
        "bodies": [{"name": "rod", "element": "cable", "elements": 8,
                    "material": {"youngs_modulus": 7e5, "density": 5540}, "section": {"area": 1.8e-3, "second_moment": 0.0},
                    "shape": {"line": {"from": place(0.0), "to": place(1.0)}}, "markers": {"tip": 1}},
                   {"name": "ball", "element": "rigid", "mass": 1, "inertia": 1, "position": place(2.0),
                    "markers": {"c": place(0.0)}}],
        "loads": [{}]})
}

#[test]
fn markers_and_bodies_touch_surfaces_of_their_dimension() {
    check(
        || scene(2),
        r#"
        /loads/0 | {"name": "l", "kind": "contact", "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}, "stiffness": 5} | loads[0].body: expected a name, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "body": "rod", "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}, "stiffness": 5} | loads[0].body: expected nothing beside `marker`, found a name
        /loads/0 | {"name": "l", "kind": "contact", "body": "ball", "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}, "stiffness": 5} | loads[0].body: expected the name of a cable, rod, beam, plate or shell of this scene (rod), found "ball"
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"plane": {"point": [0, 0], "normal": [0, 0]}}, "stiffness": 5} | loads[0].surface.plane.normal: expected a direction that is not zero, found [0.0, 0.0]
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"sphere": {"center": [0, 0], "radius": 1}}, "stiffness": 5} | loads[0].surface: expected plane or circle in the plane, found sphere
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"circle": {"center": [0, 0], "radius": 1}}} | loads[0].stiffness: expected a stiffness, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "body": "rod", "surface": {"circle": {"center": [0, 0], "radius": 1}}, "stiffness": 0} | loads[0].stiffness: expected a positive number (N/m^2), found 0
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"circle": {"center": [0, 0], "radius": 1}}, "stiffness": 5, "damping": -1} | loads[0].damping: expected zero or a positive number (s/m), found -1
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"circle": {"center": [0, 0], "radius": 1}}, "stiffness": 5, "friction": 0.3} | loads[0].slip_velocity: expected a speed, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"circle": {"center": [0, 0], "radius": 1}}, "stiffness": 5, "slip_velocity": 0.1} | loads[0].friction: expected a coefficient, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "marker": "rod.tip", "surface": {"circle": {"center": [0, 0], "radius": 1}}, "stiffness": 5, "friction": 0.3, "slip_velocity": 0} | loads[0].slip_velocity: expected a positive number (m/s), found 0
        "#,
    );
    check(
        || {
            let mut scene = scene(3);
            scene["bodies"][1]["inertia"] = json!([1, 1, 1]);
            scene
        },
        r#"
        /loads/0 | {"name": "l", "kind": "contact", "marker": "ball.c", "surface": {"circle": {"center": [0, 0, 0], "radius": 1}}, "stiffness": 5} | loads[0].surface: expected plane, sphere or cylinder in space, found circle
        /loads/0 | {"name": "l", "kind": "contact", "body": "rod", "surface": {"sphere": {"center": [0, 0], "radius": 1}}, "stiffness": 5} | loads[0].surface.sphere.center: expected 3 components [x, y, z], found 2
        /loads/0 | {"name": "l", "kind": "contact", "body": "rod", "surface": {"sphere": {"center": [0, 0, 0], "radius": 0}}, "stiffness": 5} | loads[0].surface.sphere.radius: expected a positive number (m), found 0
        /loads/0 | {"name": "l", "kind": "contact", "body": "rod", "surface": {"cylinder": {"point": [0, 0, 0], "axis": [0, 0, 0], "radius": 1}}, "stiffness": 5} | loads[0].surface.cylinder.axis: expected a direction that is not zero, found [0.0, 0.0, 0.0]
        /loads/0 | {"name": "l", "kind": "contact", "body": "rod", "surface": {"cylinder": {"point": [0, 0, 0], "axis": [0, 0, 1], "radius": 1}}, "stiffness": 5} | accepted
        "#,
    );
}

#[test]
fn surfaces_belong_to_rigid_bodies_that_rotate() {
    check(
        || {
            let mut scene = scene(3);
            scene["bodies"][1]["inertia"] = json!([1, 1, 1]);
            let more = [
                json!({"name": "bar", "element": "rigid", "mass": 1, "inertia": [0, 1, 1], "position": [5, 0, 0], "markers": {"c": [0, 0, 0]}}),
                json!({"name": "dot", "element": "rigid", "mass": 1, "position": [6, 0, 0], "markers": {"c": [0, 0, 0]}}),
                json!({"name": "sheet", "element": "plate", "surface": {"rectangle": {"corner": [0, 0, 3], "edges": [[1, 0, 0], [0, 1, 0]]}},
                       "mesh": [2, 2], "material": {"youngs_modulus": 1e9, "poisson_ratio": 0.3, "density": 1000}, "thickness": 0.01}),
            ];
            let bodies = scene["bodies"].as_array_mut().expect("bodies");
            bodies.extend(more);
            let load = json!({"name": "l", "kind": "contact", "marker": "rod.tip", "stiffness": 5, "surface_of": "ball",
                "surface": {"sphere": {"center": [0, 0, 0], "radius": 1}}});
            scene["loads"] = json!([load]);
            scene
        },
        r#"
        /loads/0/stiffness | 5 | accepted
        /loads/0/radius | 0.1 | accepted
        /loads/0/radius | -0.1 | loads[0].radius: expected zero or a positive number (m), found -0.1
        /loads/0/surface_of | "rod" | loads[0].surface_of: expected the name of a rigid body with a moment of inertia about every axis (ball), found "rod"
        /loads/0/surface_of | "bar" | loads[0].surface_of: expected the name of a rigid body with a moment of inertia about every axis (ball), found "bar"
        /loads/0/surface_of | "dot" | loads[0].surface_of: expected the name of a rigid body with a moment of inertia about every axis (ball), found "dot"
        /loads/0/surface_of | "ground" | loads[0].surface_of: expected the name of a rigid body with a moment of inertia about every axis (ball), found "ground"
        /loads/0/marker | "ball.c" | loads[0].surface_of: expected the name of another body than the one that touches, found "ball"
        /loads/0/marker | "dot.c" | accepted
        /loads/0 | {"name": "l", "kind": "contact", "marker": "bar.c", "radius": 0.1, "stiffness": 5, "surface": {"sphere": {"center": [0, 0, 0], "radius": 1}}} | loads[0].radius: expected nothing at a thin rod, whose rotation about itself is not known, found a number
        /loads/0 | {"name": "l", "kind": "contact", "body": "sheet", "surface_of": "ball", "stiffness": 5, "surface": {"sphere": {"center": [0, 0, 0], "radius": 1}}} | loads[0].surface_of: expected nothing beside a plate or shell, which touches surfaces of the ground, found "ball"
        /loads/0 | {"name": "l", "kind": "contact", "body": "sheet", "radius": 0.005, "stiffness": 5, "surface": {"sphere": {"center": [0, 0, 0], "radius": 1}}} | accepted
        "#,
    );
}

/// Markers stick, where they do not roll; what says how needs a stiffness along the surface, and friction.
#[test]
fn markers_stick_to_surfaces() {
    check(
        || {
            let mut scene = scene(2);
            let load = json!({"name": "l", "kind": "contact", "marker": "ball.c", "stiffness": 5, "friction": 0.3, "slip_velocity": 0.1,
                "tangential_stiffness": 4, "tangential_damping": 1, "static_ratio": 1.2, "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}});
            scene["loads"] = json!([load]);
            scene
        },
        r#"
        /loads/0/marker | "rod.tip" | accepted
        /loads/0/static_ratio | 0.9 | loads[0].static_ratio: expected a number from 1 on, found 0.9
        /loads/0/tangential_stiffness | 0 | loads[0].tangential_stiffness: expected a positive number (N/m), found 0
        /loads/0/tangential_damping | -1 | loads[0].tangential_damping: expected zero or a positive number (N.s/m), found -1
        /loads/0/radius | 0.1 | loads[0].tangential_stiffness: expected nothing at a rigid body with a radius, which rolls, found a number
        /loads/0/tangential_stiffness | null | loads[0].tangential_stiffness: expected a stiffness along the surface, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "marker": "ball.c", "stiffness": 5, "tangential_stiffness": 4, "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}} | loads[0].friction: expected a coefficient, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "marker": "ball.c", "stiffness": 5, "friction": 0, "tangential_stiffness": 4, "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}} | loads[0].slip_velocity: expected a speed, found nothing
        /loads/0 | {"name": "l", "kind": "contact", "body": "rod", "stiffness": 5, "friction": 0.3, "slip_velocity": 0.1, "tangential_stiffness": 4, "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}} | loads[0].tangential_stiffness: expected nothing along a line, which does not stick, found a number
        "#,
    );
}

#[test]
fn forces_and_moments_are_read_of_loads_that_follow_from_the_motion() {
    check(
        || {
            let mut scene = scene(2);
            scene["joints"] =
                json!([{"name": "pin", "kind": "revolute", "markers": ["ground", "ball.c"]}]);
            scene["loads"] = json!([
                {"name": "push", "kind": "force", "marker": "ball.c", "value": [1, 0]},
                {"name": "floor", "kind": "contact", "body": "rod", "stiffness": 5,
                 "surface": {"plane": {"point": [0, 0], "normal": [0, 1]}}},
                {"name": "spring", "kind": "joint_spring", "joint": "pin", "stiffness": 5}]);
            scene["outputs"] = json!([{}]);
            scene
        },
        r#"
        /outputs/0 | {"kind": "load_force", "load": "floor"} | accepted
        /outputs/0 | {"kind": "load_moment", "load": "spring"} | accepted
        /outputs/0 | {"kind": "load_force"} | outputs[0].load: expected a name, found nothing
        /outputs/0 | {"kind": "load_force", "load": "ground"} | outputs[0].load: expected a load of this scene
        /outputs/0 | {"kind": "load_force", "load": "push"} | outputs[0].load: expected a spring_damper, bushing, airfoil or contact, or a table_spring, force_law, joint_spring, joint_limit or joint_friction on a displacement, found "push"
        /outputs/0 | {"kind": "load_force", "load": "spring"} | outputs[0].load: expected a spring_damper, bushing, airfoil or contact, or a table_spring, force_law, joint_spring, joint_limit or joint_friction on a displacement, found "spring"
        /outputs/0 | {"kind": "load_moment", "load": "floor"} | outputs[0].load: expected a bushing, or a table_spring, force_law, joint_spring, joint_limit or joint_friction on an angle, found "floor"
        /outputs/0 | {"kind": "reaction", "joint": "pin", "load": "floor"} | outputs[0].load: expected a key of the kind
        "#,
    );
}
