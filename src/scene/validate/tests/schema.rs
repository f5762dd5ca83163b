//! The published schema.

use serde_json::{Value, json};

use crate::scene::Scene;

#[test]
fn the_schema_tells_bodies_apart_by_their_element() {
    let schema: Value = serde_json::from_str(&Scene::json_schema()).expect("JSON");
    let kinds = schema["$defs"]["Body"]["oneOf"]
        .as_array()
        .expect("kinds of bodies");
    let elements: Vec<_> = kinds
        .iter()
        .map(|kind| &kind["properties"]["element"]["const"])
        .collect();
    assert_eq!(elements, ["cable", "rod", "beam", "auto", "rigid"]);
    for kind in kinds {
        assert_eq!(kind["additionalProperties"], json!(false));
        assert!(
            kind["required"]
                .as_array()
                .is_some_and(|keys| keys.contains(&json!("element")))
        );
    }
}

/// The schema refuses what the program refuses: keys that a kind of a part does not take, keys that it lacks.
#[test]
fn the_schema_has_a_variant_for_every_kind() {
    let schema: Value = serde_json::from_str(&Scene::json_schema()).expect("JSON");
    let variant = |part: &str, kind: &str| {
        let variants = schema["$defs"][part]["oneOf"].as_array().expect("variants");
        let found = variants
            .iter()
            .find(|variant| variant["properties"]["kind"]["const"] == kind);
        found.expect("a variant").clone()
    };
    let revolute = variant("Joint", "revolute");
    assert_eq!(revolute["properties"]["kind"]["const"], "revolute");
    assert_eq!(revolute["additionalProperties"], json!(false));
    assert!(revolute["properties"].get("stiffness").is_none());
    assert!(revolute["properties"].get("point").is_some());
    assert_eq!(variant("Joint", "slider")["required"][3], "direction");
    assert!(
        variant("Joint", "hinge")["properties"]
            .get("stiffness")
            .is_some()
    );
    assert_eq!(
        variant("Load", "torque")["required"],
        json!(["name", "kind", "joint", "value"])
    );
    assert!(
        variant("Input", "torque")["properties"]
            .get("follower")
            .is_none()
    );
    assert_eq!(
        variant("Joint", "universal")["required"][4],
        "second_direction"
    );
    assert!(
        variant("Joint", "spherical")["properties"]
            .get("direction")
            .is_none()
    );
    assert!(
        variant("Output", "energy")["properties"]
            .get("marker")
            .is_none()
    );
    assert!(
        variant("Port", "force")["properties"]
            .get("damping")
            .is_none()
    );
    assert!(schema["$defs"].get("JointKind").is_none());
}
