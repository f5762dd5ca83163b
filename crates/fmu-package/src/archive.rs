//! The zip archive of an FMU. Equal content gives equal bytes on every machine and every day.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{Cursor, Read, Seek, Write};
use std::path::Path;

use anyhow::{Context, Result, bail};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

use crate::files::{entry_name, files, shown, write_whole};

/// Names of files in an archive, with forward slashes, and what is in them.
pub type Content = BTreeMap<String, Vec<u8>>;

/// Limits of an archive, so that one from elsewhere fits into memory whatever its headers claim.
#[derive(Clone, Copy)]
struct Limits {
    /// Files and folders.
    entries: usize,
    /// Bytes of all files together, unpacked.
    bytes: u64,
    /// Bytes of a name, what most file systems allow for a path.
    name: usize,
}

/// Five platforms' libraries take 20 MB.
const LIMITS: Limits = Limits {
    entries: 10_000,
    bytes: 1 << 29,
    name: 1_000,
};

/// Packs every file below a folder.
///
/// # Errors
/// A file that cannot be read or written.
pub fn pack(folder: &Path, archive: &Path) -> Result<()> {
    write(&content(folder)?, archive)
}

/// Reads every file below a folder, named as in an archive.
///
/// # Errors
/// A file that cannot be read.
pub fn content(folder: &Path) -> Result<Content> {
    let mut content = Content::new();
    for path in files(folder)? {
        let bytes =
            std::fs::read(&path).with_context(|| format!("cannot read {}", shown(&path)))?;
        content.insert(entry_name(folder, &path)?, bytes);
    }
    Ok(content)
}

/// Writes an archive.
///
/// # Errors
/// The archive cannot be written.
pub fn write(content: &Content, archive: &Path) -> Result<()> {
    write_whole(archive, zipped(content)?)
}

/// Reads every file of an archive.
///
/// # Errors
/// A file that is no archive, a name that leads out of a folder or occurs twice, or content that does not fit into
/// memory.
pub fn read(archive: &Path) -> Result<Content> {
    let opened = File::open(archive).map_err(anyhow::Error::from);
    opened
        .and_then(|file| read_from(file, LIMITS))
        .with_context(|| format!("cannot read {}", shown(archive)))
}

fn read_from(archive: impl Read + Seek, limits: Limits) -> Result<Content> {
    let mut zip = ZipArchive::new(archive)?;
    if zip.len() > limits.entries {
        bail!(
            "expected at most {} entries, found {}",
            limits.entries,
            zip.len()
        );
    }
    if zip.has_duplicate_names() {
        bail!("expected every name once, found one twice");
    }
    let mut content = Content::new();
    // Names that differ in capitals alone are one file on Windows and macOS.
    let mut names = BTreeSet::new();
    let mut left = limits.bytes;
    for index in 0..zip.len() {
        let entry = zip.by_index(index)?;
        let name = entry.name()?.into_owned();
        check_name(&name, limits.name)?;
        if !names.insert(name.trim_end_matches('/').to_lowercase()) {
            bail!("expected every name once, found {name:?} twice");
        }
        if entry.is_dir() {
            continue;
        }
        if !entry.is_file() {
            bail!("{name:?}: expected a file or a folder, found a link");
        }
        let mut bytes = Vec::new();
        // What an archive says of its sizes may be wrong: what comes out of it counts.
        entry.take(left + 1).read_to_end(&mut bytes)?;
        left = left.checked_sub(bytes.len() as u64).with_context(|| {
            format!(
                "expected at most {} MiB unpacked, found more",
                limits.bytes >> 20
            )
        })?;
        content.insert(name, bytes);
    }
    Ok(content)
}

/// Refuses a name that is not that of a file below the folder where an archive is unpacked, on any system.
fn check_name(name: &str, longest: usize) -> Result<()> {
    let is_plain = |part: &str| !part.is_empty() && part != "." && part != "..";
    let is_relative = name
        .strip_suffix('/')
        .unwrap_or(name)
        .split('/')
        .all(is_plain);
    let is_portable = !name.contains(|c: char| c == '\\' || c == ':' || c.is_control());
    if name.len() > longest {
        bail!(
            "expected names of at most {longest} bytes, found {}",
            name.len()
        );
    }
    if !is_relative || !is_portable {
        bail!(
            "expected names below the archive's own folder, without \\, : or control characters, found {name:?}"
        );
    }
    Ok(())
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
        let archive = folder.join("a.fmu");
        let partial = crate::files::partial(&archive);
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

    /// An archive of files with names as given, which the writer of archives does not check.
    fn archive_of(files: &[(&str, &[u8])]) -> Result<Vec<u8>> {
        let content = files.iter();
        zipped(
            &content
                .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec()))
                .collect(),
        )
    }

    fn refusal(archive: Vec<u8>) -> String {
        let limits = Limits {
            entries: 4,
            bytes: 1 << 20,
            name: 20,
        };
        let error = read_from(Cursor::new(archive), limits).expect_err("not to be read");
        format!("{error:#}")
    }

    #[test]
    fn names_that_lead_elsewhere_are_refused() -> Result<()> {
        for name in [
            "../a.txt",
            "b/../../a.txt",
            "b/./a.txt",
            "/a.txt",
            "b//a.txt",
            "..",
            "b\\a.txt",
            "..\\a.txt",
            "C:/a.txt",
            "a.txt:stream",
            "a\n.txt",
        ] {
            let found = refusal(archive_of(&[("good.txt", b""), (name, b"")])?);
            assert!(found.contains(&format!("found {name:?}")), "{found}");
        }
        let found = refusal(archive_of(&[(&"a".repeat(21), b"")])?);
        assert!(found.contains("at most 20 bytes, found 21"), "{found}");
        for name in ["a..b", ".hidden", "b/...", "ä/ö"] {
            check_name(name, 20)?;
        }
        Ok(())
    }

    #[test]
    fn names_that_stand_twice_are_refused() -> Result<()> {
        let mut archive = archive_of(&[("aa", b"1"), ("ab", b"2")])?;
        for at in 0..archive.len() - 1 {
            if archive[at..].starts_with(b"ab") {
                archive[at + 1] = b'a';
            }
        }
        assert!(refusal(archive).contains("every name once"));
        let found = refusal(archive_of(&[("aa", b"1"), ("aA", b"2")])?);
        assert!(found.contains("\"aa\" twice"), "{found}");
        Ok(())
    }

    #[test]
    fn what_would_not_fit_into_memory_is_refused() -> Result<()> {
        let bomb = archive_of(&[("a", &[0; 1 << 19]), ("b", &[0; 1 + (1 << 19)])])?;
        assert!(bomb.len() < 10_000, "it is small: {}", bomb.len());
        let found = refusal(bomb);
        assert!(found.contains("at most 1 MiB unpacked"), "{found}");
        let names = ["a", "b", "c", "d", "e"].map(|name| (name, &b""[..]));
        assert!(refusal(archive_of(&names)?).contains("at most 4 entries, found 5"));
        read_from(Cursor::new(archive_of(&names[..4])?), LIMITS).map(drop)
    }

    #[test]
    fn links_are_refused() -> Result<()> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        zip.add_symlink("link", "/etc/passwd", SimpleFileOptions::default())?;
        let found = refusal(zip.finish()?.into_inner());
        assert!(found.contains("found a link"), "{found}");
        Ok(())
    }
}
