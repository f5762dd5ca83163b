//! Files and folders: whole or not at all, and named as the user would.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};

/// A path as the user would write it: relative to the current folder where it lies below it.
pub fn shown(path: &Path) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(&here)
        .unwrap_or(path)
        .display()
        .to_string()
}

/// The path, absolute, with the folder that is to hold it created.
pub fn prepared(path: &Path) -> Result<PathBuf> {
    let path =
        std::path::absolute(path).with_context(|| format!("{} is no path", path.display()))?;
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot create the folder {}", shown(folder)))?;
    }
    Ok(path)
}

/// Writes a file under another name first, of this process alone: nobody ever meets half of it.
pub fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    let partial = partial(path);
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    if written.is_err() {
        // A full disk is no place for half a file; the first error is the one to tell.
        let _ = std::fs::remove_file(&partial);
    }
    written.with_context(|| format!("cannot write {}", shown(path)))
}

/// The name that a file has while it is written.
pub fn partial(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".partial-{}", std::process::id()));
    path.with_file_name(name)
}

/// Every file below a folder, in no order.
pub fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let listing = std::fs::read_dir(&folder)
            .with_context(|| format!("cannot read the folder {}", shown(&folder)))?;
        for entry in listing {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path);
            }
        }
    }
    Ok(found)
}

/// The name of a file relative to a folder, with forward slashes.
pub fn entry_name(folder: &Path, path: &Path) -> Result<String> {
    let relative = path.strip_prefix(folder)?;
    let parts = relative.iter().map(|part| {
        part.to_str()
            .ok_or_else(|| anyhow!("the file name {} is not UTF-8", relative.display()))
    });
    Ok(parts.collect::<Result<Vec<_>>>()?.join("/"))
}

/// A folder to build in, removed when it goes out of scope.
pub struct Stage(pub PathBuf);

impl Stage {
    /// An empty folder of this process and this purpose alone, below another, which is made if need be.
    pub fn new(below: &Path, purpose: &str) -> Result<Self> {
        let folder = below.join(format!("{purpose}-{}", std::process::id()));
        // A crashed process with the same number may have left one behind.
        if folder.exists() {
            std::fs::remove_dir_all(&folder)
                .with_context(|| format!("cannot clear {}", shown(&folder)))?;
        }
        std::fs::create_dir_all(&folder)
            .with_context(|| format!("cannot create the folder {}", shown(&folder)))?;
        Ok(Self(folder))
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        // Nothing depends on the removal, and a failing drop could not be reported.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
