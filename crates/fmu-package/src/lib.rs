//! What the program `flexbody` and `cargo xtask` share: archives of FMUs, their platforms, files, progress.

mod archive;
mod files;
mod platform;
mod progress;

pub use archive::{Content, content, pack, read, write};
pub use files::{Stage, destination, partial, prepared, shown, write_whole};
pub use platform::Platform;
pub use progress::{Progress, announced, bar};

/// The folder of an FMU with the scene and the files that it names.
pub const RESOURCES: &str = "resources/";
/// The scene in an FMU.
pub const SCENE: &str = "resources/scene.json";
/// The folder beside the program with what goes into every FMU: libraries and licenses.
pub const PARTS: &str = "fmu";
/// Where the licenses are in an FMU.
pub const LICENSES: &str = "documentation/licenses/";
/// The folder of libraries in an FMU, with one folder for every platform.
pub const BINARIES: &str = "binaries/";
