//! Floor 8. A scene that moves: what a run looked like ([`Recording`]), and the picture of it for a page of HTML
//! ([`picture`]), which needs nothing from elsewhere. Its sources are in `script/`, what pages hold of them is `bundle.txt`
//! (`cargo xtask view-bundle` makes it).

mod actions;
mod bundle;
mod gltf;
mod header;
mod numbers;
mod picture;
mod recording;
mod run_modes;
mod sections;
mod sheets;
mod skins;
mod surface;
mod symbols;
mod table;
mod vtk;

pub use bundle::{LICENSE, SOURCES, bundle};
pub use gltf::gltf;
pub use picture::{document, picture, picture_of_table};
pub use recording::{HeldInput, Limits, Recording};
pub use table::OutputTable;
pub use vtk::vtk;
