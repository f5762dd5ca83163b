//! The zip archive of an FMU. Equal content gives equal bytes on every machine and every day.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

use crate::process::shown;

/// Names of files in an archive, with forward slashes, and what is in them.
pub type Content = BTreeMap<String, Vec<u8>>;

/// Packs every file below a folder.
pub fn pack(folder: &Path, archive: &Path) -> Result<()> {
    let mut content = Content::new();
    for path in files(folder)? {
        let bytes =
            std::fs::read(&path).with_context(|| format!("cannot read {}", shown(&path)))?;
        content.insert(entry_name(folder, &path)?, bytes);
    }
    write(&content, archive)
}

/// Writes an archive.
pub fn write(content: &Content, archive: &Path) -> Result<()> {
    // Under another name first: a reader never meets half an archive.
    let partial = archive.with_extension("fmu.partial");
    let bytes = zipped(content)?;
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, archive));
    if written.is_err() {
        // A full disk is no place for half an archive; the first error is the one to tell.
        let _ = std::fs::remove_file(&partial);
    }
    written.with_context(|| format!("cannot write {}", shown(archive)))
}

/// Reads every file of an archive.
pub fn read(archive: &Path) -> Result<Content> {
    read_from(archive).with_context(|| format!("cannot read {}", shown(archive)))
}

fn read_from(archive: &Path) -> Result<Content> {
    let mut zip = ZipArchive::new(File::open(archive)?)?;
    let mut content = Content::new();
    for index in 0..zip.len() {
        let mut entry = zip.by_index(index)?;
        if entry.is_file() {
            let mut bytes = Vec::new();
            entry.read_to_end(&mut bytes)?;
            content.insert(entry.name()?.into_owned(), bytes);
        }
    }
    Ok(content)
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

/// The bytes of an archive: in memory, because a writer of archives cannot give up a full disk quietly.
fn zipped(content: &Content) -> Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(DateTime::default())
        .large_file(false);
    for (name, bytes) in content {
        let is_binary = name.starts_with("binaries/");
        let mode = if is_binary { 0o755 } else { 0o644 };
        zip.start_file(name, options.unix_permissions(mode))?;
        zip.write_all(bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_leaves_nothing_behind() -> Result<()> {
        let folder = std::env::temp_dir().join(format!("xtask-full-{}", std::process::id()));
        let content = folder.join("content");
        std::fs::create_dir_all(&content)?;
        std::fs::write(content.join("a.txt"), "a".repeat(100_000))?;
        let (archive, partial) = (folder.join("a.fmu"), folder.join("a.fmu.partial"));
        std::fs::write(&archive, "the one before")?;
        std::os::unix::fs::symlink("/dev/full", &partial)?;
        let error = pack(&content, &archive).expect_err("there is no room");
        let error = format!("{error:#}");
        assert!(
            error.contains("a.fmu") && error.contains("No space left"),
            "{error}"
        );
        assert!(!partial.is_symlink(), "half an archive is left");
        assert_eq!(std::fs::read(&archive)?, b"the one before");
        std::fs::remove_dir_all(&folder)?;
        Ok(())
    }

    #[test]
    fn equal_content_gives_equal_bytes() -> Result<()> {
        let folder = std::env::temp_dir().join(format!("xtask-archive-{}", std::process::id()));
        let content = folder.join("content");
        std::fs::create_dir_all(content.join("b/c"))?;
        for name in ["z.txt", "b/c/x.txt", "b/a.txt"] {
            std::fs::write(content.join(name), name.repeat(1000))?;
        }
        let archives = ["first.fmu", "second.fmu"].map(|name| folder.join(name));
        for archive in &archives {
            pack(&content, archive)?;
        }
        assert_eq!(std::fs::read(&archives[0])?, std::fs::read(&archives[1])?);
        let written = read(&archives[0])?;
        let names: Vec<&String> = written.keys().collect();
        assert_eq!(names, ["b/a.txt", "b/c/x.txt", "z.txt"]);
        assert_eq!(written["z.txt"], b"z.txt".repeat(1000));
        std::fs::remove_dir_all(&folder)?;
        Ok(())
    }
}
