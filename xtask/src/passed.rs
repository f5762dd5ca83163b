//! Which of the long checks have passed for which files: `tests/passed.json`, a hash for each. `cargo xtask test` runs a long check where
//! the files that it depends on most have changed since, and writes its hash when it passes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use fmu_package::shown;
use sha2::{Digest, Sha256};

use crate::cargo::Workspace;

/// Where the hashes are.
const PLACE: &str = "tests/passed.json";
/// Folders that hold nothing a check depends on.
const LEFT_OUT: [&str; 2] = ["__pycache__", "target"];

/// Hashes of the files for which checks have passed, by the names of the checks.
pub struct Passed {
    path: PathBuf,
    hashes: BTreeMap<String, String>,
}

impl Passed {
    /// Reads them.
    ///
    /// # Errors
    /// The file is there and cannot be read, or is no JSON object of texts.
    pub fn read(workspace: &Workspace) -> Result<Self> {
        let path = workspace.path(PLACE);
        let hashes = match std::fs::read_to_string(&path) {
            Ok(text) => serde_json::from_str(&text)
                .with_context(|| format!("{}: expected hashes by checks", shown(&path)))?,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => BTreeMap::new(),
            Err(error) => return Err(error).context(format!("cannot read {}", shown(&path))),
        };
        Ok(Self { path, hashes })
    }

    /// Whether a check has passed for files with this hash.
    pub fn holds(&self, check: &str, hash: &str) -> bool {
        self.hashes.get(check).is_some_and(|passed| passed == hash)
    }

    /// Notes that a check has passed for files with this hash.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn note(&mut self, check: &str, hash: String) -> Result<()> {
        if self.holds(check, &hash) {
            return Ok(());
        }
        self.hashes.insert(check.to_owned(), hash);
        let text = serde_json::to_string_pretty(&self.hashes).context("hashes as JSON")?;
        std::fs::write(&self.path, text + "\n")
            .with_context(|| format!("cannot write {}", shown(&self.path)))
    }
}

/// A hash of the names and contents of all files in some folders.
///
/// # Errors
/// A file or folder cannot be read.
pub fn hash_of(workspace: &Workspace, folders: &[&str]) -> Result<String> {
    let mut files = Vec::new();
    for folder in folders {
        list(&workspace.path(folder), &mut files)?;
    }
    files.sort();
    let root = workspace.path(".");
    let mut hash = Sha256::new();
    for file in files {
        let name = file.strip_prefix(&root).unwrap_or(&file);
        let content =
            std::fs::read(&file).with_context(|| format!("cannot read {}", shown(&file)))?;
        hash.update(name.to_string_lossy().replace('\\', "/"));
        hash.update(content.len().to_le_bytes());
        hash.update(content);
    }
    let digits = hash
        .finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    Ok(digits)
}

/// All files in a folder and those inside it.
fn list(folder: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    let entries =
        std::fs::read_dir(folder).with_context(|| format!("cannot read {}", shown(folder)))?;
    for entry in entries {
        let path = entry.with_context(|| shown(folder))?.path();
        let is_left_out = LEFT_OUT.iter().any(|name| path.ends_with(name));
        if !path.is_dir() {
            files.push(path);
        } else if !is_left_out {
            list(&path, files)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_follows_names_and_contents() {
        let root = std::env::temp_dir().join(format!("flexbody-passed-{}", std::process::id()));
        let write = |name: &str, text: &str| {
            let path = root.join(name);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(path, text).expect("a file");
        };
        let workspace = Workspace::at(root.clone(), root.join("target"));
        let hash = || hash_of(&workspace, &["src"]).expect("a hash");
        write("src/a.rs", "one");
        let first = hash();
        write("src/__pycache__/a.pyc", "left out");
        assert_eq!(hash(), first);
        write("src/a.rs", "two");
        assert_ne!(hash(), first);
        write("src/a.rs", "one");
        write("src/b.rs", "");
        assert_ne!(hash(), first);
        std::fs::remove_file(root.join("src/b.rs")).expect("a file");
        assert_eq!(hash(), first);
        std::fs::create_dir_all(root.join("tests")).expect("a folder");
        let mut passed = Passed::read(&workspace).expect("none");
        assert!(!passed.holds("pages", &first));
        passed.note("pages", first.clone()).expect("a file");
        assert!(
            Passed::read(&workspace)
                .expect("one")
                .holds("pages", &first)
        );
        std::fs::remove_dir_all(&root).expect("a folder");
    }
}
