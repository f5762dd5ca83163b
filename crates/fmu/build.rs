//! The name that a library bears inside, where a linker would take the path that it was built at, or a loader that goes by names could take it
//! for one of another version.

use std::env;

fn main() -> Result<(), env::VarError> {
    let (package, version) = (env::var("CARGO_PKG_NAME")?, env::var("CARGO_PKG_VERSION")?);
    let words = match env::var("CARGO_CFG_TARGET_OS")?.as_str() {
        "linux" => vec![format!("-Wl,-soname,{package}-{version}.so")],
        "macos" => vec!["-install_name".into(), format!("@rpath/{package}.dylib")],
        _ => Vec::new(),
    };
    for word in words {
        println!("cargo::rustc-cdylib-link-arg={word}");
    }
    Ok(())
}
