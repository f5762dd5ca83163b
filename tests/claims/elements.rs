//! `"element": "auto"`: a body becomes the cable, rod or beam of the same keys, whose claims hold of it then.

use std::collections::BTreeSet;

use flexbody::scene::Scene;
use flexbody::simulation::{Budget, plan};
use serde_json::{Value, json};

use crate::claims::scenes;
use crate::claims::schema::Schema;

const LINES: [&str; 3] = ["cable", "rod", "beam"];

/// The scene as it is packaged, and the element of every body.
fn packaged(scene: &Value) -> Result<(Value, Vec<Value>), String> {
    let scene = Scene::from_json(&scene.to_string()).map_err(|error| error.to_string())?;
    let (scene, _) =
        plan(&scene, &Budget::default(), &mut |_, _, _| ()).map_err(|error| error.to_string())?;
    let scene: Value = serde_json::from_str(&scene.to_json()).expect("JSON");
    let bodies = scene["bodies"].as_array().expect("bodies").iter();
    let elements = bodies.map(|body| body["element"].clone()).collect();
    Ok((scene, elements))
}

/// Beams by what they alone have: with one section, and with two at stations.
fn beams() -> Vec<Value> {
    let mut matrix = [[0.0; 6]; 6];
    (0..6).for_each(|k| matrix[k][k] = if k < 3 { 2.0 } else { 1.0 });
    let kinds = [
        (
            json!({"area": 0.01, "second_moments": [1e-5, 2e-5], "torsion_constant": 2e-5, "shear_factors": [0.8, 0.7]}),
            json!({"youngs_modulus": 1e7, "shear_modulus": 4e6, "density": 1000.0}),
        ),
        (
            json!({"stiffness": matrix, "inertia": matrix, "about": [0.0, 0.0]}),
            json!({}),
        ),
    ];
    let mut scenes = Vec::new();
    for (section, material) in kinds {
        let stations = [0.0, 1.0].map(|at| json!({"at": at, "section": section, "twist": 0.1}));
        for (key, value) in [("section", section), ("stations", json!(stations))] {
            let mut scene = json!({"name": "beam", "dimension": 3, "bodies": [{"name": "beam", "element": "beam",
                "elements": 2, "material": material, "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}},
                "markers": {"root": 0.0, "tip": 1.0}}],
                "accuracy": {"relative_tolerance": 1e-6},
                "outputs": [{"kind": "orientation", "marker": "beam.tip"}]});
            scene["bodies"][0][key] = value;
            scenes.push(scene);
        }
    }
    // Reduced to modes.
    scenes.push(json!({"name": "modes", "dimension": 3, "bodies": [{"name": "beam", "element": "rod", "model": "modal", "modes": 2,
        "material": {"youngs_modulus": 1e7, "shear_modulus": 4e6, "density": 1000.0},
        "section": {"area": 0.01, "second_moments": [1e-5, 2e-5], "torsion_constant": 2e-5},
        "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "markers": {"root": 0.0, "tip": 1.0}}],
        "accuracy": {"relative_tolerance": 1e-6},
        "outputs": [{"kind": "orientation", "marker": "beam.tip"}]}));
    // In the plane, thick.
    let section = json!({"area": 0.01, "second_moment": 1e-5, "shear_factor": 0.8});
    let stations = [0.0, 1.0].map(|at| json!({"at": at, "section": section}));
    for (key, value) in [("section", section.clone()), ("stations", json!(stations))] {
        let mut scene = json!({"name": "beam", "dimension": 2, "bodies": [{"name": "beam", "element": "beam",
            "elements": 2, "material": {"youngs_modulus": 1e7, "shear_modulus": 4e6, "density": 1000.0},
            "shape": {"line": {"from": [0, 0], "to": [1, 0]}}, "markers": {"root": 0.0, "tip": 1.0}}],
            "accuracy": {"relative_tolerance": 1e-6},
            "outputs": [{"kind": "angle", "marker": "beam.tip"}]});
        scene["bodies"][0][key] = value;
        scenes.push(scene);
    }
    scenes
}

#[test]
fn a_chosen_element_is_the_same_as_one_that_is_said() {
    let schema = Schema::published();
    let (mut seen, mut alike, mut failed) = (BTreeSet::new(), 0, Vec::new());
    let specimens = scenes::all().into_iter().map(|specimen| specimen.scene);
    for mut scene in specimens.chain(beams()) {
        let said = packaged(&scene).unwrap_or_else(|error| panic!("{error}"));
        for body in scene["bodies"].as_array_mut().expect("bodies") {
            if LINES.iter().any(|line| body["element"] == *line) {
                body["element"] = json!("auto");
            }
        }
        // In space a cable with moduli left out may be asked to be a rod, a thick rod a beam; a slender beam may be a cable.
        let may_differ = scene["dimension"] == 3 || said.1.contains(&json!("beam"));
        let Ok(chosen) = packaged(&scene) else {
            assert!(may_differ, "{scene}");
            continue;
        };
        if chosen.1 != said.1 {
            assert!(may_differ, "{scene}");
            continue;
        }
        if chosen.0 != said.0 {
            failed.push(scene["name"].clone());
        }
        alike += 1;
        let places = schema.places(&scene).into_iter();
        let there = places.filter(|place| place.samples.is_none());
        seen.extend(there.map(|place| place.key));
    }
    assert!(failed.is_empty(), "{failed:?}");
    let keys = schema
        .keys()
        .into_iter()
        .map(|key| match key.split_once('=') {
            Some((key, _)) => key.to_owned(),
            None => key,
        });
    let missing: Vec<String> = keys
        .filter(|key| key.starts_with("bodies{auto}") && !seen.contains(key))
        .collect();
    println!("{alike} scenes alike");
    assert!(missing.is_empty(), "in no scene: {missing:?}");
}
