//! Beams in the plane: what they say, and what belongs to space.

use serde_json::{Value, json};

use super::check;

fn scene(section: &Value, material: &Value) -> Value {
    json!({"name": "planar", "dimension": 2, "gravity": [0, -9.81],
        "bodies": [{"name": "beam", "element": "beam", "elements": 4, "material": material, "section": section,
            "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"root": 0, "tip": 1}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "beam.root"]}]})
}

fn numbers() -> Value {
    scene(
        &json!({"area": 0.01, "second_moment": 1e-5, "shear_factor": 0.8}),
        &json!({"youngs_modulus": 1e7, "shear_modulus": 4e6, "density": 1000}),
    )
}

fn matrices() -> Value {
    let mut matrix = [[0.0; 6]; 6];
    (0..6).for_each(|k| matrix[k][k] = if k < 3 { 2.0 } else { 1.0 });
    scene(
        &json!({"stiffness": matrix, "inertia": matrix, "about": [0.0, 0.0]}),
        &json!({}),
    )
}

#[test]
fn a_planar_beam_has_one_second_moment_and_one_shear_factor() {
    check(
        numbers,
        r#"
        /name | "beam" | accepted
        /bodies/0/element | "rod" | bodies[0].element: expected "cable", "beam", "rigid" or "reduced" in the plane, where nothing twists, found "rod"
        /bodies/0/axis | [0, 1] | bodies[0].axis: expected nothing in the plane, which the first axis of sections is across, found an axis
        /bodies/0/material/shear_modulus | null | bodies[0].material.shear_modulus: expected a value, found nothing
        /bodies/0/section/second_moment | 0 | bodies[0].section.second_moment
        /bodies/0/section/second_moment | null | bodies[0].section.second_moment: expected a value, found nothing
        /bodies/0/section/shear_factor | 0 | bodies[0].section.shear_factor
        /bodies/0/section/shear_factor | null | bodies[0].section.shear_factor: expected a value of a beam, or a `shape`, or `stiffness`, found nothing
        /bodies/0/section/shear_factors | [0.8, 0.8] | bodies[0].section.shear_factors: expected `shear_factor` in the plane, where sections shear one way, found a value
        /bodies/0/section/second_moments | [1e-5, 1e-5] | bodies[0].section.second_moments: expected nothing in the plane, where nothing twists and sections bend about one axis, found a value
        /bodies/0/section/torsion_constant | 1e-5 | bodies[0].section.torsion_constant: expected nothing in the plane, where nothing twists and sections bend about one axis, found a value
        /bodies/0/section | {"shape": {"circle": {"radius": 0.1}}} | accepted
        /bodies/0/section | {"shape": {"circle": {"radius": 0.1}}, "shear_factor": 0.5} | accepted
        /bodies/0/section | {"shape": {"circle": {"radius": 0.1}}, "coupling": [1, 0, 0]} | bodies[0].section.coupling: expected nothing in the plane
        /bodies/0/element | "cable" | bodies[0].material.shear_modulus
        /rotation | 3 | accepted
        /initial | "steady" | accepted
        "#,
    );
}

#[test]
fn whole_matrices_keep_a_planar_beam_in_its_plane() {
    check(
        matrices,
        r#"
        /name | "beam" | accepted
        /bodies/0/section/about | [0, 0.1] | bodies[0].section.inertia: expected a centre of mass on the line
        /bodies/0/section/about | [0.1, 0] | bodies[0].section.inertia: expected a centre of mass on the line
        /bodies/0/section/shear_factor | 1 | bodies[0].section.shear_factor: expected nothing beside `stiffness`, which holds it, found a value
        "#,
    );
    let coupled = || {
        let mut scene = matrices();
        let stiffness = &mut scene["bodies"][0]["section"]["stiffness"];
        (stiffness[3][4], stiffness[4][3]) = (json!(0.1), json!(0.1));
        scene
    };
    check(
        coupled,
        r#"
        /name | "beam" | bodies[0].section.stiffness[4][3]: expected 0 about the line in the plane, which the body would leave, found 0.1
        "#,
    );
    let slanted = || {
        let mut scene = matrices();
        let inertia = &mut scene["bodies"][0]["section"]["inertia"];
        (inertia[2][4], inertia[4][2]) = (json!(0.01), json!(0.01));
        scene
    };
    check(
        slanted,
        r#"
        /name | "beam" | bodies[0].section.inertia[2][4]: expected 0 of a section that lies across the line, found 0.01
        "#,
    );
}
