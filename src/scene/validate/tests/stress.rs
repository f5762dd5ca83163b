//! Stress is read where a section says it.

use serde_json::{Value, json};

use super::check;

fn scene(dimension: usize, element: &str, section: &Value, output: &Value) -> Value {
    let place = |x: f64| vec![x, 0.0, 0.0][..dimension].to_vec();
    let mut material = json!({"youngs_modulus": 7e5, "density": 5540});
    if dimension == 3 && element != "cable" {
        material["shear_modulus"] = json!(3e5);
    }
    let line = json!({"from": place(0.0), "to": place(1.0)});
    json!({"name": "stress", "dimension": dimension,
        "bodies": [{"name": "rod", "element": element, "elements": 8, "model": "flexible", "material": material,
            "section": section, "shape": {"line": line}, "markers": {"root": 0, "tip": 1}}],
        "outputs": [output]})
}

#[test]
fn stress_is_read_where_sections_say_it() {
    let (circle, numbers) = (
        json!({"shape": {"circle": {"radius": 0.02}}}),
        json!({"area": 1e-3, "second_moments": [1e-7, 1e-7], "torsion_constant": 1e-7}),
    );
    let stress = json!({"kind": "stress", "marker": "rod.tip", "points": [[0.01, 0.0]]});
    let torsion = json!({"kind": "torsion_stress", "marker": "rod.tip", "points": [[0.01, 0.0]]});
    check(
        || scene(3, "rod", &circle, &stress),
        r#"
        /outputs/0/points | [[0.01, 0.0], [0.0, 0.01]] | accepted
        /outputs/0/points | [] | outputs[0].points: expected 1 to 100 points, found 0
        /outputs/0/points | [[0.01]] | outputs[0].points[0]: expected [y, z] in space, found [0.01]
        /outputs/0/points | [[0.01, 0.0], [1, 2, 3]] | outputs[0].points[1]: expected [y, z] in space
        /outputs/0 | {"kind": "stress", "marker": "rod.tip"} | outputs[0].points: expected points, found nothing
        /outputs/0 | {"kind": "torque", "marker": "rod.tip", "points": [[0.01, 0.0]]} | outputs[0].points: expected a key of the kind
        /bodies/0/section/coupling | [0.001, 0, 0] | outputs[0].marker: expected a marker of a body whose section has area and second moments
        /bodies/0/section/axial_coupling | [0.001, 0, 0] | outputs[0].marker: expected a marker of a body whose section has area and second moments
        /bodies/0/section/axial_coupling | [1e3, 0, 0] | bodies[0].section.axial_coupling: expected stiffness that couples less than stretching, twist and bending
        "#,
    );
    check(
        || scene(3, "rod", &numbers, &torsion),
        r#"
        /outputs/0/kind | "stress" | accepted
        /outputs/0/marker | "rod.tip" | outputs[0].marker: expected a marker of a body whose section has a `shape` there
        "#,
    );
    check(
        || scene(3, "cable", &circle, &stress),
        r#"
        /outputs/0/marker | "rod.tip" | outputs[0].marker: expected a marker of a rod
        /bodies/0/section/axial_coupling | [1, 0, 0] | bodies[0].section.axial_coupling: expected nothing of a cable
        "#,
    );
    check(
        || scene(2, "cable", &circle, &stress),
        r#"
        /outputs/0/points | [[0.01], [-0.01]] | accepted
        /outputs/0/points | [[0.01, 0.0]] | outputs[0].points[0]: expected [y] in the plane
        /outputs/0/kind | "torsion_stress" | outputs[0].marker: expected a marker of a rod
        "#,
    );
    let limp = json!({"area": 1e-3, "second_moment": 0});
    check(
        || scene(2, "cable", &limp, &stress),
        r#"
        /outputs/0/points | [[0.0]] | accepted
        /outputs/0/points | [[0.01]] | outputs[0].points[0]: expected a point on the line of a cable without bending stiffness
        "#,
    );
    let whole: Vec<Vec<f64>> = (0..6)
        .map(|r| (0..6).map(|c| f64::from(u8::from(r == c))).collect())
        .collect();
    let given = json!({"stiffness": whole, "inertia": whole});
    check(
        || {
            let mut scene = scene(3, "beam", &given, &stress);
            scene["bodies"][0]["material"] = json!({});
            scene
        },
        r#"
        /outputs/0/points | [[0.01, 0.0]] | outputs[0].marker: expected a marker of a body whose section has area and second moments
        "#,
    );
}
