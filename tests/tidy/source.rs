//! Source files, with what is not code blanked out.

use std::fs;
use std::path::{Path, PathBuf};

/// The root of the project.
pub fn root() -> &'static Path {
    crate::root()
}

/// A source file.
pub struct Source {
    /// Path below the root, with `/`.
    pub path: String,
    pub text: String,
    /// The text with comments and the content of literals replaced by spaces: lines and columns stay.
    pub code: String,
}

impl Source {
    /// Reads a file.
    pub fn read(path: &str) -> Self {
        let text =
            fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        Self::of(path, &text)
    }

    /// Builds a source from its text.
    pub fn of(path: &str, text: &str) -> Self {
        Self {
            path: path.into(),
            code: blank(text),
            text: text.into(),
        }
    }

    /// The code before the file's own tests.
    pub fn product(&self) -> &str {
        let end = self.code.find("#[cfg(test)]\nmod tests");
        &self.code[..end.unwrap_or(self.code.len())]
    }

    /// Path of the file inside `src`, if it is there.
    pub fn inside(&self) -> Option<&str> {
        self.path.strip_prefix("src/")
    }

    /// The folder below `src` that the file lies in, if any.
    pub fn room(&self) -> Option<&str> {
        self.inside()?.split_once('/').map(|(room, _)| room)
    }

    /// Where a byte of the code is.
    pub fn line(&self, at: usize) -> usize {
        1 + self.code[..at].matches('\n').count()
    }
}

/// All files below a folder, sorted.
pub fn files(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(folder) = open.pop() {
        let entries =
            fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for entry in entries {
            let path = entry.expect("a readable folder").path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Path below the root, with `/`.
pub fn name(path: &Path) -> String {
    let inside = path.strip_prefix(root()).unwrap_or(path);
    let parts = inside.iter().map(|part| part.to_string_lossy());
    parts.collect::<Vec<_>>().join("/")
}

/// All Rust files below some folders.
pub fn sources(folders: &[&str]) -> Vec<Source> {
    let mut found = Vec::new();
    for folder in folders {
        for path in files(folder) {
            if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(Source::read(&name(&path)));
            }
        }
    }
    assert!(!found.is_empty(), "no source in {folders:?}");
    found
}

/// All Rust files of the product, its tools and its tests.
pub fn all() -> Vec<Source> {
    sources(&[
        "src",
        "tests",
        "crates/fmu",
        "crates/fmu-package/src",
        "crates/cli",
        "xtask/src",
        "crates/studies/src",
        "crates/example-fmus/src",
    ])
}

/// Fails with all complaints at once.
pub fn no_complaints(complaints: &[String]) {
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

/// Where a word stands alone in code.
pub fn words<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word)
        .map(|(at, _)| at)
        .filter(move |at| {
            let (before, after) = (&code[..*at], &code[at + word.len()..]);
            !before.ends_with(part) && !after.starts_with(part)
        })
}

/// Replaces comments and the content of literals by spaces, byte by byte.
fn blank(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = bytes.to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text.as_bytes()[at..];
        let after_name = at > 0 && (bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'_');
        let length = if rest.starts_with(b"//") {
            rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len())
        } else if rest.starts_with(b"/*") {
            find(rest, b"*/").map_or(rest.len(), |end| end + 2)
        } else if rest[0] == b'"' {
            string(rest)
        } else if !after_name && raw_string(rest).is_some() {
            raw_string(rest).unwrap_or(1)
        } else if rest[0] == b'\'' {
            character(rest)
        } else {
            at += 1;
            continue;
        };
        for byte in &mut out[at..at + length] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
        at += length.max(1);
    }
    // Multi-byte characters vanish whole or stay whole.
    String::from_utf8_lossy(&out).into_owned()
}

fn find(text: &[u8], what: &[u8]) -> Option<usize> {
    text.windows(what.len()).position(|window| window == what)
}

/// Length of a string literal.
fn string(text: &[u8]) -> usize {
    let mut at = 1;
    while at < text.len() && text[at] != b'"' {
        at += if text[at] == b'\\' { 2 } else { 1 };
    }
    (at + 1).min(text.len())
}

/// Length of a raw string literal, if here is one.
fn raw_string(text: &[u8]) -> Option<usize> {
    let hashes = text
        .strip_prefix(b"r")?
        .iter()
        .take_while(|b| **b == b'#')
        .count();
    if text.get(1 + hashes) != Some(&b'"') {
        return None;
    }
    let close: Vec<u8> = std::iter::once(b'"')
        .chain(std::iter::repeat_n(b'#', hashes))
        .collect();
    let start = 2 + hashes;
    find(&text[start..], &close).map(|end| start + end + close.len())
}

/// Length of a character literal; 0 for the tick of a lifetime.
fn character(text: &[u8]) -> usize {
    match text.get(1) {
        Some(b'\\') => {
            let end = text[2.min(text.len())..]
                .iter()
                .skip(1)
                .position(|b| *b == b'\'');
            end.map_or(0, |end| end + 4)
        }
        Some(_) => {
            // One character of up to four bytes.
            let end = text.iter().skip(2).take(4).position(|b| *b == b'\'');
            match end {
                Some(0) => 3,
                Some(end) if !text[1].is_ascii() => end + 3,
                _ => 0,
            }
        }
        None => 0,
    }
}

#[test]
fn comments_and_literals_are_blanked() {
    let text = "a(\"un\\\"safe\"); // unsafe\nb(r#\"x\"unsafe\"#, 'u', '\\'', &'a c); /* fn */ d";
    let code = blank(text);
    assert_eq!(code.len(), text.len());
    assert!(!code.contains("unsafe") && !code.contains("fn"));
    let left: Vec<&str> = code.split_whitespace().collect();
    assert_eq!(left, ["a(", ");", "b(", ",", ",", ",", "&'a", "c);", "d"]);
}
