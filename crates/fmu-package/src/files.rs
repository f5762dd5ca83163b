//! Files and folders: whole or not at all, and named as the user would.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};

/// A path as the user would write it: relative to the current folder where it lies below it.
pub fn shown(path: &Path) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(&here)
        .unwrap_or(path)
        .display()
        .to_string()
}

/// Returns the absolute path, and creates the folder that is to hold it.
///
/// # Errors
/// The folder cannot be created.
pub fn prepared(path: &Path) -> Result<PathBuf> {
    let path =
        std::path::absolute(path).with_context(|| format!("{} is no path", path.display()))?;
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot create the folder {}", shown(folder)))?;
    }
    Ok(path)
}

/// Links that are followed from one to the next, as many as Linux does.
const LINKS: usize = 40;

/// Where a file is to be written whole: links are followed, and what is there and no plain file is refused.
///
/// # Errors
/// A folder, a device, a pipe or a socket of that name, or links that lead to no end.
pub fn destination(path: &Path) -> Result<PathBuf> {
    let place = shown(path);
    let mut path = prepared(path)?;
    for _ in 0..LINKS {
        let found = match std::fs::symlink_metadata(&path) {
            Ok(found) => found.file_type(),
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(path),
            Err(error) => return Err(error).with_context(|| format!("cannot write {place}")),
        };
        if found.is_symlink() {
            let to = std::fs::read_link(&path);
            let to = to.with_context(|| format!("cannot read the link {}", shown(&path)))?;
            path.set_file_name("");
            path.push(to);
            continue;
        }
        if found.is_file() {
            return Ok(path);
        }
        let what = if found.is_dir() {
            "a folder"
        } else {
            "a device, a pipe or a socket"
        };
        bail!("{place}: expected a plain file or none, found {what}");
    }
    bail!("{place}: expected a plain file or none, found links that lead to no end")
}

/// Writes a file under another name first, of this process alone: nobody ever meets half of it. Links are followed.
///
/// # Errors
/// What [`destination`] refuses, and what the system says.
pub fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    let place = destination(path)?;
    let partial = partial(&place);
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, &place));
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

/// Lists every file below a folder, in no order.
///
/// # Errors
/// A folder that cannot be read.
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

/// Returns the name of a file relative to a folder, with forward slashes.
///
/// # Errors
/// A file outside the folder, or a name that is not UTF-8.
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
    /// Creates an empty folder for this process and purpose below another folder, which is created if necessary.
    ///
    /// # Errors
    /// The folder cannot be created or emptied.
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

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::symlink;
    use std::os::unix::net::UnixListener;

    use super::*;

    #[test]
    fn what_is_no_plain_file_stays_and_links_are_followed() -> Result<()> {
        let stage = Stage::new(&std::env::temp_dir(), "flexbody-destination")?;
        let at = |name: &str| stage.0.join(name);
        let pipe = UnixListener::bind(at("pipe"))?;
        let refused = write_whole(&at("pipe"), "text").expect_err("no plain file");
        let told = "expected a plain file or none, found a device, a pipe or a socket";
        assert!(refused.to_string().ends_with(told), "{refused}");
        assert!(!std::fs::symlink_metadata(at("pipe"))?.is_file());
        drop(pipe);
        std::fs::create_dir(at("folder"))?;
        let refused = write_whole(&at("folder"), "text").expect_err("a folder");
        assert!(refused.to_string().ends_with("found a folder"), "{refused}");
        // By two links to a file, and by one to none.
        std::fs::write(at("folder/file"), "before")?;
        symlink(at("folder/file"), at("folder/second"))?;
        symlink("folder/second", at("first"))?;
        write_whole(&at("first"), "after")?;
        assert!(std::fs::symlink_metadata(at("first"))?.is_symlink());
        assert_eq!(std::fs::read_to_string(at("folder/file"))?, "after");
        assert!(std::fs::symlink_metadata(at("folder/second"))?.is_symlink());
        symlink("folder/new", at("open"))?;
        write_whole(&at("open"), "new")?;
        assert_eq!(std::fs::read_to_string(at("folder/new"))?, "new");
        symlink("round", at("round"))?;
        let refused = write_whole(&at("round"), "text").expect_err("no end");
        assert!(refused.to_string().contains("lead to no end"), "{refused}");
        Ok(())
    }
}
