//! Flags of rustc that keep the paths of this machine out of what it makes.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use fmu_package::shown;

use crate::cargo::rustc;
use crate::process::stdout;

/// Returns the compiler flags for a project in one folder whose products go to another.
///
/// # Errors
/// Folders of cargo or of the compiler that cannot be found.
pub fn flags(root: &Path, target: &Path) -> Result<Vec<String>> {
    // Where one path begins with another, the later counts.
    let mut names = vec![
        (root.to_owned(), "project".to_owned()),
        (target.to_owned(), "target".to_owned()),
    ];
    for registry in registries()? {
        names.push((registry, "registry".to_owned()));
    }
    names.push(standard_library()?);
    let flag =
        |(path, name): (PathBuf, String)| format!("--remap-path-prefix={}={name}", path.display());
    Ok(names.into_iter().map(flag).collect())
}

/// Folders of the sources that cargo has downloaded; a mirror's is named after its host.
fn registries() -> Result<Vec<PathBuf>> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(std::env::home_dir()?.join(".cargo")));
    let folder = home.unwrap_or_default().join("registry").join("src");
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let listing = std::fs::read_dir(&folder)
        .and_then(Iterator::collect::<std::io::Result<Vec<_>>>)
        .with_context(|| format!("cannot read the folder {}", shown(&folder)))?;
    let mut found: Vec<PathBuf> = listing.iter().map(std::fs::DirEntry::path).collect();
    found.sort();
    Ok(found)
}

/// Where the source of the standard library lies if it is installed, and what its paths are if not.
fn standard_library() -> Result<(PathBuf, String)> {
    let sysroot = stdout(rustc().args(["--print", "sysroot"]))?;
    let version = stdout(rustc().arg("-vV"))?;
    let mut lines = version.lines();
    let commit = lines.find_map(|line| line.strip_prefix("commit-hash: "));
    let commit = commit.context("rustc names no commit-hash")?;
    let source = Path::new(sysroot.trim_end()).join("lib/rustlib/src/rust");
    Ok((source, format!("/rustc/{commit}")))
}
