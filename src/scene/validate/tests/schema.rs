//! The published schema.

use serde_json::{Value, json};

use crate::scene::Scene;

/// All variants of a part, each under the check that leads to it.
fn variants(schema: &Value, part: &str) -> Vec<Value> {
    fn told(check: &Value) -> Vec<Value> {
        let further = |key: &str| check.get(key).map(told).unwrap_or_default();
        match check.get("then") {
            Some(_) => [further("then"), further("else")].concat(),
            None => vec![check.clone()],
        }
    }
    let checks = schema["$defs"][part]["allOf"].as_array();
    checks.expect("checks").iter().flat_map(told).collect()
}

#[test]
fn the_schema_tells_bodies_apart_by_their_element() {
    let schema: Value = serde_json::from_str(&Scene::json_schema()).expect("JSON");
    let kinds = variants(&schema, "Body");
    let elements: Vec<_> = kinds
        .iter()
        .map(|kind| &kind["properties"]["element"]["const"])
        .collect();
    assert_eq!(
        elements,
        [
            "cable", "rod", "beam", "auto", "rigid", "reduced", "plate", "shell"
        ]
    );
    for kind in &kinds {
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
        let found = variants(&schema, part)
            .into_iter()
            .find(|variant| variant["properties"]["kind"]["const"] == kind);
        found.expect("a variant")
    };
    let revolute = variant("Joint", "revolute");
    assert_eq!(revolute["properties"]["kind"]["const"], "revolute");
    assert_eq!(revolute["additionalProperties"], json!(false));
    assert!(revolute["properties"].get("stiffness").is_some());
    assert!(revolute["properties"].get("point").is_some());
    assert_eq!(
        variant("Joint", "point_on_line")["required"][3],
        "direction"
    );
    assert!(
        variant("Joint", "weld")["properties"]
            .get("stiffness")
            .is_none()
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

/// Every kind has its own words: no key of it is explained by what it means in another kind.
#[test]
fn keys_are_described_for_their_kind_alone() {
    let schema: Value = serde_json::from_str(&Scene::json_schema()).expect("JSON");
    let mut complaints = Vec::new();
    for part in ["Joint", "Motion", "Load", "Input", "Output", "Port"] {
        let variants = variants(&schema, part);
        let kind = |of: &Value| {
            of["properties"]["kind"]["const"]
                .as_str()
                .map(str::to_owned)
        };
        let kinds: Vec<String> = variants.iter().filter_map(kind).collect();
        for variant in &variants {
            let own = kind(variant);
            let keys = variant["properties"].as_object().expect("keys");
            for (key, told) in keys.iter().filter(|(key, _)| *key != "kind") {
                let words = told["description"].as_str().unwrap_or_default();
                let names = |of: &&String| words.contains(&format!("`{of}`"));
                if words.is_empty() || kinds.iter().any(|of| names(&of)) {
                    complaints.push(format!("{part} {own:?} {key}: {words}"));
                }
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// What a validator says is of the kind that is meant: no choice stands above it in which none fits.
#[test]
fn the_schema_checks_by_kind() {
    let schema: Value = serde_json::from_str(&Scene::json_schema()).expect("JSON");
    for (part, tag) in [
        ("Body", "element"),
        ("Joint", "kind"),
        ("Motion", "kind"),
        ("Load", "kind"),
        ("Input", "kind"),
        ("Output", "kind"),
        ("Port", "kind"),
    ] {
        let part = &schema["$defs"][part];
        assert!(part.get("oneOf").is_none() && part.get("anyOf").is_none());
        assert_eq!(part["required"], json!([tag]));
        let names = part["properties"][tag]["enum"].as_array().expect("names");
        let checks = part["allOf"].as_array().expect("checks");
        assert_eq!(names.len(), checks.len());
        for (name, check) in names.iter().zip(checks) {
            assert_eq!(check["if"]["properties"][tag]["const"], *name);
            assert_eq!(check["if"]["required"], json!([tag]));
        }
    }
    // Of a kind that is read at one thing or another, what is named decides.
    let checks = schema["$defs"]["Motion"]["allOf"]
        .as_array()
        .expect("checks");
    let angle = &checks[0]["then"];
    assert_eq!(angle["if"], json!({"anyOf": [{"required": ["joint"]}]}));
    assert!(angle["then"]["properties"].get("marker").is_none());
    assert!(angle["else"]["properties"].get("joint").is_none());
}

#[test]
fn where_the_schema_is_may_stand_in_a_scene_and_means_nothing() {
    let scene = json!({"$schema": "../scene.schema.json", "name": "stone", "dimension": 2,
        "bodies": [{"name": "stone", "element": "rigid", "mass": 2, "position": [0, 0]}]});
    let read = Scene::from_json(&scene.to_string()).expect("a scene");
    assert!(!read.to_json().contains("$schema"));
    let mut wrong = scene.clone();
    wrong["$schema"] = json!(7);
    let told = Scene::from_json(&wrong.to_string()).expect_err("no text");
    assert_eq!(
        told.to_string(),
        "$schema: expected where the schema is, a text, found 7"
    );
    let mut within = scene;
    within["bodies"][0]["$schema"] = json!("x");
    assert!(Scene::from_json(&within.to_string()).is_err());
}
