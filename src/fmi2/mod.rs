//! Floor 11. FMI 2.0 for co-simulation: the model description and the C interface that a master calls. Everything in the
//! package derives from the scene and its variables.

pub mod abi;
mod documentation;
mod instantiation;
mod lifecycle;
mod location;
mod model_description;

pub use documentation::documentation;
pub use lifecycle::{InterfaceFunction, state_name};
pub use model_description::model_description;

use crate::fmi::terminals;
use crate::page::icon;
use crate::scene::Scene;
use crate::simulation::Planned;

/// The generated text files of a unit: path inside the package, content. The same scene, plan where it was planned, and section of it in
/// motion ([`crate::page::motion`]; nothing where its page stands still) gives the same bytes.
pub fn describe(scene: &Scene, planned: &Planned, motion: &str) -> Vec<(&'static str, String)> {
    let mut files = vec![
        ("modelDescription.xml", model_description(scene)),
        ("resources/scene.json", scene.to_json()),
        (
            "documentation/index.html",
            documentation(scene, planned, motion),
        ),
        ("documentation/scene.svg", icon(scene)),
    ];
    let terminals = terminals(scene);
    files.extend(terminals.map(|text| ("terminalsAndIcons/terminalsAndIcons.xml", text)));
    files
}
