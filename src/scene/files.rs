//! Files that a scene names: read with it, and kept with it.

use std::collections::BTreeMap;
use std::fs::{File, metadata};
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use super::container::Container;
use super::description::Body;
use super::validate::checks::{expected, quoted};
use super::{Error, FileBody, Scene};

/// Function that gives the bytes of a file that a scene names, or says why it cannot.
pub type Files<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// End of the names of files of reduced models.
const ENDING: &str = ".safetensors";
/// Largest file that is read, bytes: room for a million numbers in tables, and for a model of 200 modes on 20,000 points.
const MOST_BYTES: u64 = 1 << 26;
/// Longest name of a file.
const MOST_LETTERS: usize = 200;

/// Refuses every file.
///
/// # Errors
/// Always.
pub(super) fn none(_name: &str) -> Result<Vec<u8>, String> {
    Err("this reader of scenes has no folder that files are read from".into())
}

impl Scene {
    /// Reads the files that the scene names, each once, and writes out their digests.
    ///
    /// # Errors
    /// A name that is none of a file beside the scene, a file that cannot be read or is not valid, or one with another digest than that given.
    pub(super) fn read_files(&mut self, files: Files<'_>) -> Result<(), Error> {
        let mut read: BTreeMap<String, Arc<Container>> = BTreeMap::new();
        for (index, body) in self.bodies.iter_mut().enumerate() {
            let Body::Reduced(body) = body else {
                continue;
            };
            let path = format!("bodies[{index}]");
            let container = match read.get(&body.file) {
                Some(container) => container.clone(),
                None => {
                    let container = body.read(&format!("{path}.file"), files)?;
                    let container = Arc::new(match self.dimension {
                        2 => container.in_plane(),
                        _ => container,
                    });
                    read.insert(body.file.clone(), container.clone());
                    container
                }
            };
            body.take(&format!("{path}.sha256"), container)?;
        }
        Ok(())
    }

    /// Iterates over the files that the scene has read: the name of each, and its bytes.
    pub fn files(&self) -> BTreeMap<&str, &Arc<[u8]>> {
        let reduced = self.bodies.iter().filter_map(Body::reduced);
        let files = reduced.filter_map(|body| {
            let container = body.container.as_ref()?;
            Some((body.file.as_str(), container.bytes()))
        });
        files.collect()
    }
}

/// Gives the files of a folder.
///
/// # Errors
/// Those of [`bounded`], in words.
pub fn beside(folder: &Path) -> impl Fn(&str) -> Result<Vec<u8>, String> {
    let folder = folder.to_owned();
    move |name| bounded(&folder.join(name)).map_err(|error| error.to_string())
}

/// The bytes of a regular file of bounded size. Anything else might never end: it is refused unopened.
///
/// # Errors
/// What the operating system says; no regular file, or one that is too large.
pub fn bounded(path: &Path) -> io::Result<Vec<u8>> {
    let refused = |found: &str| {
        let message =
            format!("expected a regular file of at most {MOST_BYTES} bytes, found {found}");
        Err(io::Error::new(io::ErrorKind::InvalidData, message))
    };
    let status = metadata(path)?;
    if status.is_dir() {
        return refused("a folder");
    }
    if !status.is_file() {
        return refused("a device or a pipe");
    }
    let mut bytes = Vec::new();
    // It may grow while it is read.
    if status.len() <= MOST_BYTES {
        let mut file = File::open(path)?.take(MOST_BYTES + 1);
        file.read_to_end(&mut bytes)?;
    }
    match status.len().max(bytes.len() as u64) {
        length if length > MOST_BYTES => refused(&format!("{length}")),
        _ => Ok(bytes),
    }
}

impl FileBody {
    fn read(&self, path: &str, files: Files<'_>) -> Result<Container, Error> {
        check_name(path, &self.file)?;
        let wrong = |error: String| Error::new(path, format!("{}: {error}", quoted(&self.file)));
        let bytes = files(&self.file).map_err(wrong)?;
        Container::from_bytes(&bytes).map_err(wrong)
    }

    /// Keeps a file that was read.
    fn take(&mut self, path: &str, container: Arc<Container>) -> Result<(), Error> {
        let digest = container.digest();
        let given = self.sha256.get_or_insert_with(|| digest.to_owned());
        if given != digest {
            let wanted = format!("the digest of {}, {digest}", quoted(&self.file));
            let end = "; without the key any file is taken";
            return Err(expected(path, &wanted, quoted(given) + end));
        }
        self.container = Some(container);
        Ok(())
    }
}

/// Checks that a name is one of a file beside the scene or below, on every system.
///
/// # Errors
/// Another name.
fn check_name(path: &str, name: &str) -> Result<(), Error> {
    let is_fit = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let is_part = |part: &str| {
        !part.is_empty()
            && !part.starts_with('.')
            && !part.ends_with('.')
            && part.chars().all(is_fit)
    };
    if name.len() <= MOST_LETTERS && name.ends_with(ENDING) && name.split('/').all(is_part) {
        return Ok(());
    }
    let wanted = format!(
        "the name of a file beside the scene or below that ends in {ENDING}, of letters, digits, _, -, . and / ({MOST_LETTERS} at most)"
    );
    Err(expected(path, &wanted, quoted(name)))
}
