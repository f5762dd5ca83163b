//! What the program `flexbody` and `cargo xtask` share: archives of FMUs, their platforms, files, progress.

mod archive;
mod files;
mod platform;
mod progress;

pub use archive::{Content, pack, read, write};
pub use files::{copy_all, entry_name, files, partial, prepared, shown, write_whole};
pub use platform::Platform;
pub use progress::announced;

/// Where the licenses are in an FMU.
pub const LICENSES: &str = "documentation/licenses/";
/// The folder of libraries in an FMU, with one folder for every platform.
pub const BINARIES: &str = "binaries/";
