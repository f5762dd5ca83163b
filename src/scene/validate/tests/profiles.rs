//! Sizes of profiles that fit, polygons that are some, and points inside them.

use serde_json::{Value, json};

use super::check;

fn scene(shape: &Value) -> Value {
    json!({"name": "profile", "dimension": 3,
        "bodies": [{"name": "bar", "element": "beam", "elements": 2,
            "material": {"youngs_modulus": 2.1e11, "shear_modulus": 8e10, "density": 7850},
            "section": {"shape": shape}, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0}}],
        "outputs": [{"kind": "torsion_stress", "marker": "bar.root", "points": [[0.0, 0.0]]}]})
}

fn walls(shape: &str) -> Value {
    json!({shape: {"width": 0.1, "height": 0.2, "web_thickness": 0.03, "flange_thickness": 0.04}})
}

#[test]
fn walls_fit_into_their_profile() {
    check(
        || scene(&walls("i")),
        r#"
        /bodies/0/section/shape/i/flange_thickness | 0.1 | bodies[0].section.shape.i.flange_thickness: expected less than 0.1 m, half of the height, found 0.1 m
        /bodies/0/section/shape/i/web_thickness | 0.1 | bodies[0].section.shape.i.web_thickness: expected less than 0.1 m, the width, found 0.1 m
        /bodies/0/section/shape/i/width | 0 | bodies[0].section.shape.i.width: expected
        /bodies/0/section/shape/i/web_thickness | 1e-9 | bodies[0].section.shape.i: expected a shape whose torsion constant is found to 1e-3, with walls that are not so thin, found one
        /bodies/0/section | {"area": 1} | bodies[0].section
        /bodies/0/section/area | 1 | bodies[0].section.area: expected nothing beside `shape`
        /bodies/0/element | "rod" | accepted
        /bodies/0/element | "cable" | bodies[0].material.shear_modulus
        /outputs/0/points | [[0.045, 0.09]] | accepted
        /outputs/0/points | [[0.045, 0.05]] | outputs[0].points[0]: expected a point of the section, measured from its centroid, where it reaches from
        /outputs/0/points | [[0.015, 0.06]] | outputs[0].points[0]: expected a point apart from corners that the material reaches around
        "#,
    );
    for (name, key, most, wanted) in [
        ("c", "web_thickness", 0.1, "the width"),
        ("c", "flange_thickness", 0.1, "half of the height"),
        ("t", "web_thickness", 0.1, "the width"),
        ("t", "flange_thickness", 0.2, "the height"),
        ("l", "web_thickness", 0.1, "the width"),
        ("l", "flange_thickness", 0.2, "the height"),
        ("box", "web_thickness", 0.05, "half of the width"),
        ("box", "flange_thickness", 0.1, "half of the height"),
    ] {
        let mut shape = walls(name);
        shape[name][key] = json!(most);
        let told = refusal(&scene(&shape));
        let wanted = format!(
            "bodies[0].section.shape.{name}.{key}: expected less than {most} m, {wanted}, found {most} m"
        );
        assert_eq!(told, wanted);
    }
    let ring = json!({"hollow_ellipse": {"width": 0.1, "height": 0.2, "inner_width": 0.1}});
    assert!(refusal(&scene(&ring)).contains("inner_width: expected less than 0.1 m, the width"));
}

fn refusal(scene: &Value) -> String {
    let refused = crate::scene::Scene::from_json(&scene.to_string());
    refused.expect_err("a shape that is none").to_string()
}

#[test]
fn polygons_do_not_cross_themselves() {
    let square = json!([[1, 1], [3, 1], [3, 3], [1, 3]]);
    check(
        || {
            scene(
                &json!({"polygon": {"outline": square, "holes": [[[1.2, 1.2], [1.2, 1.6], [1.6, 1.2]]]}}),
            )
        },
        r#"
        /outputs/0/points | [[0.3, 0.3]] | accepted
        /outputs/0/points | [[-0.7, -0.7]] | outputs[0].points[0]: expected a point of the section
        /bodies/0/section/shape/polygon/outline | [[1, 3], [3, 3], [3, 1], [1, 1]] | accepted
        /bodies/0/section/shape/polygon/outline | [[1, 1], [3, 3]] | bodies[0].section.shape.polygon.outline: expected three corners or more, found 2
        /bodies/0/section/shape/polygon/outline | [[1, 1], [3, 3], [3, 1], [1, 3]] | bodies[0].section.shape.polygon.outline[0]: expected an edge that meets no other, found the one from [1, 1] to [3, 3], which meets that from [3, 1] to [1, 3]
        /bodies/0/section/shape/polygon/outline | [[1, 1], [1, 1], [3, 1], [1, 3]] | bodies[0].section.shape.polygon.outline[0]: expected another corner than the next one, found [1, 1]
        /bodies/0/section/shape/polygon/outline | [[1, 1], [3, 1], [2, 1]] | bodies[0].section.shape.polygon.outline[0]: expected an edge that meets no other
        /bodies/0/section/shape/polygon/holes | [[[4, 1], [5, 1], [5, 2]]] | bodies[0].section.shape.polygon.holes[0]: expected a hole inside the outline and outside of other holes, found one at [4, 1]
        /bodies/0/section/shape/polygon/holes | [[[2, 2], [5, 1], [5, 2]]] | bodies[0].section.shape.polygon.outline[1]: expected an edge that meets no other
        /bodies/0/section/shape/polygon/holes | [[]] | bodies[0].section.shape.polygon.holes[0]: expected three corners or more, found 0
        "#,
    );
}

/// Polygons at stations change corner by corner, through polygons.
#[test]
fn polygons_at_stations_have_as_many_corners() {
    let station = |at: f64, outline: Value| json!({"at": at, "section": {"shape": {"polygon": {"outline": outline}}}});
    let square = || json!([[0, 0], [2, 0], [2, 2], [0, 2]]);
    let stations = |last: Value| {
        let mut scene = scene(&json!({}));
        scene["bodies"][0]["stations"] = json!([station(0.0, square()), last]);
        scene["bodies"][0]
            .as_object_mut()
            .expect("a body")
            .remove("section");
        scene["outputs"] = json!([]);
        scene
    };
    let larger = station(1.0, json!([[0, 0], [3, 0], [3, 3], [0, 3]]));
    let scene = crate::scene::Scene::from_json(&stations(larger).to_string());
    let scene = scene.expect("a scene");
    let middle = scene.bodies[0].cable().expect("a beam").section_at(0.5);
    assert!((middle.area - 6.25).abs() < 1e-12, "{}", middle.area);
    for (last, wanted) in [
        (
            station(1.0, json!([[0, 0], [2, 0], [0, 2]])),
            "stations[1].section.shape.polygon: expected a polygon with as many corners and holes as the one at the station before, found another shape",
        ),
        (
            station(1.0, json!([[2, 2], [0, 2], [0, 0], [2, 0]])),
            "stations[1].section.shape.polygon: expected corners that lead from those of the station before through polygons, found at 0.500 of the way: one without area",
        ),
    ] {
        let told = refusal(&stations(last));
        assert!(told.contains(wanted), "{told}");
    }
}

/// A rod with its shear centre beside its line is told of once, a beam is not.
#[test]
fn rods_with_an_eccentric_shear_center_are_told_of() {
    for (element, shape, is_told) in [
        ("rod", "c", true),
        ("beam", "c", false),
        ("rod", "i", false),
    ] {
        let mut scene = scene(&walls(shape));
        scene["bodies"][0]["element"] = json!(element);
        scene["outputs"] = json!([]);
        let scene = crate::scene::Scene::from_json(&scene.to_string()).expect("a scene");
        let told = crate::scene::remarks(&scene);
        assert_eq!(
            told.iter().any(|of| of.contains("shear centre")),
            is_told,
            "{told:?}"
        );
    }
}
