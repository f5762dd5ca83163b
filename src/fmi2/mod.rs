//! Floor 7. FMI 2.0 for co-simulation: the model description and documentation that are packaged,
//! and the C interface that a master calls. Everything in the package derives from the scene and
//! its variables; the only unsafe code is in [`abi`] and `float`.

pub mod abi;
mod canvas;
mod documentation;
mod drawing;
mod float;
mod guid;
mod instance;
mod lifecycle;
mod location;
mod logger;
mod model_description;
mod number;
mod parts;
mod state;
mod status;
mod symbols;
mod terminals;
mod values;

pub use documentation::documentation;
pub use drawing::{drawing, icon};
pub use guid::guid;
pub use lifecycle::{Causality, Function, State};
pub use logger::Category;
pub use model_description::model_description;
pub use status::Status;
pub use terminals::terminals;

use crate::scene::Scene;

/// Name of the library inside the package; the same for every scene.
pub const MODEL_IDENTIFIER: &str = "flexbody";

/// The generated text files of a unit: path inside the package, content. The same scene gives the
/// same bytes.
pub fn describe(scene: &Scene) -> Vec<(&'static str, String)> {
    let mut files = vec![
        ("modelDescription.xml", model_description(scene)),
        ("resources/scene.json", scene.to_json()),
        ("documentation/index.html", documentation(scene)),
        ("documentation/scene.svg", icon(scene)),
    ];
    let terminals = terminals(scene);
    files.extend(terminals.map(|text| ("terminalsAndIcons/terminalsAndIcons.xml", text)));
    files
}

/// A scene with something of everything, for the tests of this folder.
#[cfg(test)]
fn example() -> Scene {
    let text = include_str!("example.json");
    Scene::from_json(text).expect("a valid scene")
}
