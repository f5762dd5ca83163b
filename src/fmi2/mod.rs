//! Floor 8. FMI 2.0 for co-simulation: the model description and documentation that are packaged,
//! and the C interface that a master calls. Everything in the package derives from the scene and
//! its variables; the only unsafe code is in [`abi`] and `float`.

pub mod abi;
mod documentation;
mod float;
mod guid;
mod instance;
mod lifecycle;
mod location;
mod logger;
mod model_description;
mod state;
mod status;
mod terminals;
mod values;

pub use documentation::documentation;
pub use guid::guid;
pub use lifecycle::{Function, State};
pub use logger::Category;
pub use model_description::model_description;
pub use status::Status;
pub use terminals::terminals;

use crate::page::icon;
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
