//! The licenses that go with an FMU: ours, and the notices of everything that its library is linked with. They are
//! collected when an FMU is packaged, from the very packages that were compiled, so that they cannot be stale.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use fmu_package::{Content, LICENSES, Platform, prepared, shown, write_whole};
use serde_json::Value;

use crate::cargo::{Workspace, release, rustc};
use crate::linker::c_library_notices;
use crate::process::stdout;

/// Introduction of the file.
const FIRST: &str = include_str!("../license.txt");
/// Our licenses, at the root of the project: short names of the terms, files.
const OURS: [(&str, &str); 2] = [("MIT", "LICENSE-MIT"), ("Apache-2.0", "LICENSE-APACHE")];
/// How the names of files with notices begin, in capitals.
const NOTICES: [&str; 6] = [
    "LICENSE",
    "LICENCE",
    "COPYING",
    "COPYRIGHT",
    "NOTICE",
    "UNLICENSE",
];

/// A package of others.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Linked {
    name: String,
    version: String,
    license: String,
    authors: String,
    folder: PathBuf,
}

/// Writes the licenses of a package's libraries for these platforms into the folder of an FMU.
///
/// # Errors
/// A license that is missing or not known, or a file that cannot be written.
pub fn put(
    workspace: &Workspace,
    package: &str,
    platforms: &[Platform],
    folder: &Path,
) -> Result<()> {
    for (name, bytes) in content(workspace, package, platforms)? {
        write_whole(&prepared(&folder.join(name))?, bytes)?;
    }
    Ok(())
}

fn content(workspace: &Workspace, package: &str, platforms: &[Platform]) -> Result<Content> {
    let read =
        |path: &Path| std::fs::read(path).with_context(|| format!("cannot read {}", shown(path)));
    let mut content = Content::new();
    let mut add = |name: &str, bytes: Vec<u8>| content.insert(format!("{LICENSES}{name}"), bytes);
    add("license.txt", FIRST.into());
    for (_, file) in OURS {
        add(file, read(&workspace.path(file))?);
    }
    add("crates.txt", notices(&linked(workspace, package)?)?.into());
    let (file, name) = standard_library()?;
    add(&name, read(&file)?);
    for platform in platforms {
        if let Some(file) = c_library_notices(workspace, *platform)? {
            add("mingw-w64.txt", read(&file)?);
        }
    }
    Ok(content)
}

/// Lists the packages that a package is linked with on some platform. Build dependencies are left out.
fn linked(workspace: &Workspace, package: &str) -> Result<BTreeSet<Linked>> {
    // Of one package: cargo's metadata would add what other packages switch on.
    let mut tree = workspace.cargo("tree");
    tree.args(["--locked", "--package", package, "--prefix", "none"]);
    tree.args(["--edges", "normal,no-proc-macro", "--format", "{p}"]);
    let mut metadata = workspace.cargo("metadata");
    metadata.args(["--format-version", "1", "--locked"]);
    for platform in Platform::value_variants() {
        tree.args(["--target", platform.target()]);
        metadata.args(["--filter-platform", platform.target()]);
    }
    let metadata: Value = serde_json::from_str(&stdout(&mut metadata)?)
        .context("cargo metadata printed broken JSON")?;
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    // The project's own packages come from nowhere else.
    let (mut packages, mut own) = (BTreeMap::new(), BTreeSet::new());
    for found in list(&metadata["packages"]) {
        let manifest = PathBuf::from(text(&found["manifest_path"]));
        let authors: Vec<String> = list(&found["authors"]).iter().map(text).collect();
        let (name, version) = (text(&found["name"]), text(&found["version"]));
        if found["source"].is_null() {
            own.insert(name);
            continue;
        }
        let one = Linked {
            license: text(&found["license"]),
            authors: authors.join(", "),
            folder: manifest.parent().unwrap_or(&manifest).to_owned(),
            name: name.clone(),
            version: version.clone(),
        };
        packages.insert((name, version), one);
    }
    let mut found = BTreeSet::new();
    for line in stdout(&mut tree)?.lines() {
        let mut words = line.split(' ');
        let (Some(name), Some(version)) = (words.next(), words.next()) else {
            continue;
        };
        let version = version.trim_start_matches('v');
        if own.contains(name) {
            continue;
        }
        let one = packages.get(&(name.to_owned(), version.to_owned()));
        let one = one.with_context(|| format!("cargo metadata names no {line}"))?;
        found.insert(one.clone());
    }
    Ok(found)
}

/// Names, terms and notices of packages; a notice that several share stands once.
fn notices(packages: &BTreeSet<Linked>) -> Result<String> {
    let mut page = String::from(
        "Libraries that Flexbody is linked with on some platform, as published on crates.io, and their notices.\n\n",
    );
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut bare = Vec::new();
    for package in packages {
        let Linked {
            name,
            version,
            license,
            authors,
            folder,
        } = package;
        page += &format!("{name} {version}: {license}\n");
        let found = files(folder)?;
        if !found
            .iter()
            .any(|(file, _)| !file.to_uppercase().starts_with("COPYING."))
        {
            let Some((_, ours)) = OURS.iter().find(|(terms, _)| license.contains(terms)) else {
                bail!("{name} {version}: expected the text of its license ({license}), found none");
            };
            let by = if authors.is_empty() {
                "the authors of the package"
            } else {
                authors
            };
            bare.push(format!("{name} {version}: {ours}, by {by}\n"));
        }
        for (file, text) in found {
            texts
                .entry(text)
                .or_default()
                .push(format!("{name} {version} ({file})"));
        }
    }
    if !bare.is_empty() {
        page += "\nThese bring no text of their license. That of the file named applies, with their authors in place of Flexbody's.\n\n";
        page += &bare.concat();
    }
    let line = "=".repeat(80);
    let mut texts: Vec<(Vec<String>, String)> = texts.into_iter().map(|(t, of)| (of, t)).collect();
    texts.sort();
    for (of, text) in texts {
        page += &format!("\n{line}\n{}\n{line}\n\n{text}\n", of.join(",\n"));
    }
    Ok(page)
}

/// Files with notices at the root of a package: name, text.
fn files(folder: &Path) -> Result<Vec<(String, String)>> {
    let cannot = || format!("cannot read the folder {}", shown(folder));
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(cannot)? {
        let entry = entry.with_context(cannot)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let capitals = name.to_uppercase();
        let is_notice = NOTICES.iter().any(|start| capitals.starts_with(start));
        if is_notice && entry.path().is_file() {
            let bytes = std::fs::read(entry.path())
                .with_context(|| format!("cannot read {}", shown(&entry.path())))?;
            let text = String::from_utf8_lossy(&bytes).replace("\r\n", "\n");
            found.push((name, text.trim_matches('\n').trim_end().to_owned()));
        }
    }
    found.sort();
    Ok(found)
}

/// The notices of the standard library, which come with the compiler, and their name in an FMU.
fn standard_library() -> Result<(PathBuf, String)> {
    let root = stdout(rustc().args(["--print", "sysroot"]))?;
    let file = Path::new(root.trim_end()).join("share/doc/rust/COPYRIGHT-library.html");
    Ok((file, format!("rust-{}.html", release()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_linked_package_has_its_notices() -> Result<()> {
        let workspace = Workspace::locate()?;
        let packages = linked(&workspace, "flexbody")?;
        let named = |package: &Linked| format!("{} {}", package.name, package.version);
        let names: BTreeSet<&str> = packages.iter().map(|package| &*package.name).collect();
        // No macro, no package of tests or of the laboratory, nothing of the program alone.
        for name in ["nalgebra", "serde_json", "libc"] {
            assert!(names.contains(name), "{name}: {names:?}");
        }
        for name in [
            "serde_derive",
            "proptest",
            "criterion",
            "flexbody",
            "parquet",
        ] {
            assert!(!names.contains(name), "{name}");
        }
        let page = notices(&packages)?;
        for package in &packages {
            let heading = format!("\n{}: {}\n", named(package), package.license);
            assert!(page.contains(&heading), "{heading}");
            for (file, text) in files(&package.folder)? {
                assert!(
                    page.contains(&format!("{} ({file})", named(package))),
                    "{file}"
                );
                assert!(page.contains(&text), "{file}");
            }
        }
        Ok(())
    }

    #[test]
    fn a_package_without_any_text_is_refused() -> Result<()> {
        let folder = std::env::temp_dir().join(format!("xtask-bare-{}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        let package = |license: &str| Linked {
            name: "bare".into(),
            version: "1.0.0".into(),
            license: license.into(),
            authors: "Ada".into(),
            folder: folder.clone(),
        };
        let found = notices(&BTreeSet::from([package("Zlib")])).expect_err("no text");
        assert!(
            found
                .to_string()
                .contains("expected the text of its license (Zlib)")
        );
        let page = notices(&BTreeSet::from([package("MIT")]))?;
        assert!(page.contains("bare 1.0.0: LICENSE-MIT, by Ada"), "{page}");
        std::fs::remove_dir_all(&folder)?;
        Ok(())
    }
}
