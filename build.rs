//! What only the build knows: the platform that the library is for, as FMI calls it.
//!
//! Nothing is said to the linker here: cargo passes a build script's words for shared libraries on
//! only where the manifest names one, and ours must not (see `Cargo.toml`). `xtask/src/linker.rs` does.

use std::env;

fn main() -> Result<(), env::VarError> {
    let system = env::var("CARGO_CFG_TARGET_OS")?;
    let processor = env::var("CARGO_CFG_TARGET_ARCH")?;
    let platform = match (system.as_str(), processor.as_str()) {
        ("linux", "x86_64") => "linux64".into(),
        ("windows", "x86_64") => "win64".into(),
        ("macos", "x86_64") => "darwin64".into(),
        ("macos", _) => format!("{processor}-darwin"),
        _ => format!("{processor}-{system}"),
    };
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-env=FLEXBODY_PLATFORM={platform}");
    Ok(())
}
