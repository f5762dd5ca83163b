//! Airfoils at markers and along lines.

use serde_json::{Value, json};

use super::check;

fn planar() -> Value {
    json!({"name": "airfoils", "dimension": 2,
        "bodies": [{"name": "rod", "element": "cable", "elements": 2,
            "material": {"youngs_modulus": 7e5, "density": 5540},
            "section": {"shape": {"circle": {"radius": 0.02}}},
            "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"tip": 1, "root": 0}},
            {"name": "ball", "element": "rigid", "mass": 1, "inertia": 1, "position": [0, 0], "markers": {"c": [0, 0]}}],
        "loads": [
            {"name": "strip", "kind": "airfoil", "marker": "ball.c", "chord_direction": [1, 0], "chord": 0.1, "span": 0.2, "density": 1.2,
                "wind": [1, "t"], "lift": "a + q"},
            {"name": "wing", "kind": "airfoil", "body": "rod", "chord_direction": [1, 0], "chord": 0.1, "density": 1.2, "lift": 1}],
        "outputs": [{"kind": "load_force", "load": "wing"}]})
}

fn spatial() -> Value {
    let mut scene = planar();
    scene["dimension"] = json!(3);
    let rod = json!({"name": "rod", "element": "rod", "elements": 2, "material": {"youngs_modulus": 7e5, "density": 5540, "shear_modulus": 3e5},
        "section": {"shape": {"circle": {"radius": 0.02}}}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"tip": 1}});
    scene["bodies"] = json!([rod]);
    scene["loads"] = json!([{"name": "wing", "kind": "airfoil", "body": "rod", "chord_direction": [0, 1, 0], "lift_direction": [0, 0, 1],
        "chord": 0.1, "density": 1.2, "lift": 1}]);
    scene
}

#[test]
fn strips_are_at_markers_and_wings_along_lines() {
    check(
        planar,
        r#"
        /loads/0/chord | 0.3 | accepted
        /loads/0/chord | 0 | loads[0].chord: expected a positive number (m), found 0
        /loads/0/chord | "0.1 + s" | loads[0].chord: expected a number at a marker, found `0.1 + s`
        /loads/0/ahead | 0.2 | accepted
        /loads/0/ahead | {"table": [[0, 0], [1, 1]]} | loads[0].ahead: expected a number at a marker, found table of 2 points from 0 to 1
        /loads/0/span | -1 | loads[0].span: expected a positive number (m), found -1
        /loads/0/span | null | loads[0].span: expected a length at a marker, found nothing
        /loads/0/density | 0 | loads[0].density: expected a positive number (kg/m^3), found 0
        /loads/0/wind | [1, "s"] | loads[0].wind[1]:
        /loads/0/wind | [1] | loads[0].wind: expected 2 values [x, y], found 1
        /loads/0/lift | "s*a" | loads[0].lift:
        /loads/0/drag | {"table": [[-1, 0], [1, 2]]} | accepted
        /loads/0/chord_direction | [0, 0] | loads[0].chord_direction:
        /loads/0/lift_direction | [0, 1] | loads[0].lift_direction: expected nothing in the plane, where it is the chord rotated left
        /loads/0/marker | "ball.x" | loads[0].marker: expected a marker of this scene
        /loads/0/marker | null | loads[0].marker: expected a marker, or a `body`, found nothing
        /loads/0/body | "rod" | loads[0].body: expected nothing beside `marker`, found "rod"
        /loads/1/chord | "0.1 + s" | accepted
        /loads/1/chord | {"table": [[0, 0], [1, 1]]} | accepted
        /loads/1/chord | "0.1 + t" | loads[1].chord:
        /loads/1/chord | -1 | loads[1].chord: expected a positive number (m), found -1
        /loads/1/ahead | "0.3*s" | accepted
        /loads/1/span | 1 | loads[1].span: expected nothing along a body, whose length it is, found 1
        /loads/1/wind | ["s*t", 0] | accepted
        /loads/1/lift | "s*a + q" | accepted
        /loads/1/lift | "x" | loads[1].lift:
        /loads/1/body | "ball" | loads[1].body: expected
        /rotation | 1.5 | rotation: expected 0 where air acts, which does not rotate with the frame, found
        /motions | [{"name": "w", "kind": "winch", "marker": "rod.root", "value": 0}] | loads[1].body: expected a line that no winch pays out, found "rod"
        "#,
    );
    check(
        spatial,
        r#"
        /loads/0/drag | 0.1 | accepted
        /loads/0/lift_direction | null | loads[0].lift_direction: expected a direction, in space, found nothing
        /loads/0/lift_direction | [0, 2, 0] | loads[0].lift_direction: expected a direction other than that of the chord, found one along it
        /bodies/0 | {"name": "rod", "element": "cable", "elements": 2, "material": {"youngs_modulus": 7e5, "density": 5540}, "section": {"shape": {"circle": {"radius": 0.02}}}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}} | loads[0].body: expected a rod or beam, whose sections have axes, found "rod"
        "#,
    );
}
