//! `fmuResourceLocation`: from the URI that a master passes to a directory.

use std::path::PathBuf;

/// What is wrong with a resource location.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LocationError {
    /// Another scheme, or none.
    #[error("fmuResourceLocation: expected a URI that begins with file:/, found \"{0}\"")]
    Scheme(String),
    /// A directory on another machine.
    #[error("fmuResourceLocation: expected a directory of this machine, found \"{0}\"")]
    Host(String),
    /// A `%` that two hexadecimal digits do not follow, or bytes that are not UTF-8.
    #[error("fmuResourceLocation: expected percent-encoded UTF-8, found \"{0}\"")]
    Encoding(String),
}

/// The directory of a `file:` URI: `file:///p`, `file:/p` or `file://localhost/p`, percent-decoded.
///
/// # Errors
/// Any other URI.
pub fn directory(uri: &str) -> Result<PathBuf, LocationError> {
    let scheme = || LocationError::Scheme(uri.into());
    let (name, rest) = uri.split_once(':').ok_or_else(scheme)?;
    if !name.eq_ignore_ascii_case("file") || !rest.starts_with('/') {
        return Err(scheme());
    }
    let path = match rest.strip_prefix("//") {
        None => rest,
        Some(after) => {
            let root = after.find('/').ok_or_else(scheme)?;
            let (host, path) = after.split_at(root);
            if !host.is_empty() && !host.eq_ignore_ascii_case("localhost") {
                return Err(LocationError::Host(uri.into()));
            }
            path
        }
    };
    let path = decode(path).ok_or_else(|| LocationError::Encoding(uri.into()))?;
    Ok(PathBuf::from(local(&path)))
}

/// The path without the slash that a URI puts before a Windows drive letter.
fn local(path: &str) -> &str {
    let drive = |rest: &&str| cfg!(windows) && rest.as_bytes().get(1) == Some(&b':');
    path.strip_prefix('/').filter(drive).unwrap_or(path)
}

fn decode(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, tail)) = rest.split_first() {
        rest = tail;
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let (digits, tail) = rest.split_at_checked(2)?;
        let digit = |at: usize| char::from(digits[at]).to_digit(16);
        bytes.push(u8::try_from(16 * digit(0)? + digit(1)?).ok()?);
        rest = tail;
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn the_usual_forms_lead_to_the_same_directory() {
        for uri in [
            "file:///tmp/a%20b/resources",
            "file:/tmp/a%20b/resources",
            "file://localhost/tmp/a%20b/resources",
            "FILE:///tmp/a b/resources",
        ] {
            assert_eq!(
                directory(uri).as_deref(),
                Ok(Path::new("/tmp/a b/resources")),
                "{uri}"
            );
        }
        assert_eq!(directory("file:///%C3%A4%25"), Ok(PathBuf::from("/ä%")));
    }

    #[test]
    fn other_forms_are_refused() {
        let error = |uri: &str| directory(uri).expect_err(uri);
        assert!(matches!(error("http://host/p"), LocationError::Scheme(_)));
        assert!(matches!(error("/tmp/p"), LocationError::Scheme(_)));
        assert!(matches!(error(""), LocationError::Scheme(_)));
        assert!(matches!(error("file:p"), LocationError::Scheme(_)));
        assert!(matches!(error("file://server"), LocationError::Scheme(_)));
        assert!(matches!(error("file://server/p"), LocationError::Host(_)));
        assert!(matches!(error("file:///a%2"), LocationError::Encoding(_)));
        assert!(matches!(error("file:///a%+1"), LocationError::Encoding(_)));
        assert!(matches!(error("file:///%FF"), LocationError::Encoding(_)));
    }
}
