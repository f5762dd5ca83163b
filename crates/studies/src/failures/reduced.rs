//! Finite element bodies as modes of a floating frame.

use flexbody::scene::Scene;
use serde_json::Value;

use super::support::{Product, Row, figure, json, short};
use crate::scene::Outcome;

const SCENE: &str = include_str!("../../../../tests/cases/reduced_bracket/scene.json");
/// The model of the case, with 5 modes and second-order displacements.
const OWN: &[u8] = include_bytes!("../../../../tests/cases/reduced_bracket/bracket.safetensors");
/// The same bracket without these displacements, with 3 and 9 modes, by `crates/studies/exudyn/bracket.py`.
const LINEAR: [&[u8]; 2] = [
    include_bytes!("../../scenes/bracket_3_linear.safetensors"),
    include_bytes!("../../scenes/bracket_9_linear.safetensors"),
];
/// Place of the tip of the whole solid after 1 s (case `reduced_bracket`), and the size of the bracket, m.
const SOLID: [f64; 3] = [0.12555, -0.33840, 0.00003];
const SIZE: f64 = 0.36;

/// How far the tip with a model is from that of the solid after 1 s, over the size.
fn apart(model: &[u8]) -> Outcome<f64> {
    let mut scene = json(SCENE)?;
    scene["accuracy"]["relative_tolerance"] = Value::from(1e-5);
    let files = |_: &str| Ok(model.to_vec());
    let scene = Scene::from_json_with(&scene.to_string(), &files);
    let mut product = Product::of(scene.map_err(|error| error.to_string())?)?;
    product.step(1.0).map_err(|error| error.to_string())?;
    let mut square = 0.0;
    for (axis, place) in SOLID.iter().enumerate() {
        let found = product.get(&format!("bracket.tip.position[{}]", axis + 1))?;
        square += (found - place).powi(2);
    }
    Ok(square.sqrt() / SIZE)
}

/// Modes beside displacements that are not linear in them.
pub fn linear_frame() -> Outcome<Row> {
    let [few, many] = LINEAR.map(apart);
    let (few, many, found) = (few?, many?, apart(OWN)?);
    Ok(Row {
        place: "A bracket of finite elements that swings",
        method: "floating frame whose displacements are linear in the modes, with static shapes of its joints".into(),
        failing: figure(
            many,
            format!(
                "tip {} of the size from the solid with 3 modes, {} with 9",
                short(few),
                short(many)
            ),
        ),
        product: figure(found, format!("{} with 5 modes", short(found))),
        test: "more_modes_do_not_bring_a_linear_frame_to_the_solid",
    })
}

#[test]
fn more_modes_do_not_bring_a_linear_frame_to_the_solid() {
    let row = linear_frame().expect("a row");
    assert!(row.failing.value > 1.5e-3, "{}", row.failing.text);
    assert!(row.product.value < 4e-4, "{}", row.product.text);
}
