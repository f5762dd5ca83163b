//! What only the build knows: the platform that the library is for, as FMI calls it.

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
