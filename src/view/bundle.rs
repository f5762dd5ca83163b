//! What of the picture is a program: compiled in, so that a page needs no other file.

/// SHA-256 of the sources on the first line, then what is made from them: gzip in base64.
const BUNDLE: &str = include_str!("bundle.txt");

/// Style of the picture.
pub(super) const STYLE: &str = include_str!("script/style.css");

/// License of three.js, which the bundle holds.
pub const LICENSE: &str = include_str!("script/LICENSE-three.txt");

/// Folder of the sources, below the root of the project.
pub const SOURCES: &str = "src/view/script";

/// SHA-256 of the sources that the bundle was made from, and the bundle.
pub fn bundle() -> (&'static str, &'static str) {
    BUNDLE.split_once('\n').unwrap_or_default()
}
