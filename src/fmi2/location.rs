//! `fmuResourceLocation`: from the URI that a master passes to a directory.

use std::path::PathBuf;

/// Error in a resource location.
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

/// The directory of a `file:` URI: `file:///p`, `file:/p` or `file://localhost/p`, percent-decoded. On Windows also one of another
/// machine, `file://server/share/p`, and a drive after two slashes for three, as some masters write it.
///
/// # Errors
/// Any other URI.
pub fn directory(uri: &str) -> Result<PathBuf, LocationError> {
    path(uri, cfg!(windows)).map(PathBuf::from)
}

fn path(uri: &str, on_windows: bool) -> Result<String, LocationError> {
    let scheme = || LocationError::Scheme(uri.into());
    let (name, rest) = uri.split_once(':').ok_or_else(scheme)?;
    if !name.eq_ignore_ascii_case("file") || !rest.starts_with('/') {
        return Err(scheme());
    }
    let is_drive = |text: &str| on_windows && text.as_bytes().get(1) == Some(&b':');
    let path = match rest.strip_prefix("//") {
        None => rest,
        Some(after) if is_drive(after) => after,
        Some(after) => {
            let root = after.find('/').ok_or_else(scheme)?;
            let (host, path) = after.split_at(root);
            if host.is_empty() || host.eq_ignore_ascii_case("localhost") {
                path
            } else if on_windows {
                rest
            } else {
                return Err(LocationError::Host(uri.into()));
            }
        }
    };
    let path = decode(path).ok_or_else(|| LocationError::Encoding(uri.into()))?;
    // A URI puts a slash before a drive.
    let drive = path.strip_prefix('/').filter(|rest| is_drive(rest));
    Ok(drive.unwrap_or(&path).to_owned())
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
        let host = path("file://server/p", false);
        assert!(matches!(host, Err(LocationError::Host(_))));
        assert!(matches!(error("file:///a%2"), LocationError::Encoding(_)));
        assert!(matches!(error("file:///a%+1"), LocationError::Encoding(_)));
        assert!(matches!(error("file:///%FF"), LocationError::Encoding(_)));
    }

    #[test]
    fn windows_has_drives_and_other_machines() {
        for (uri, expected) in [
            ("file:///C:/a%20b/resources", "C:/a b/resources"),
            ("file:///c%3A/p", "c:/p"),
            ("file:/C:/p", "C:/p"),
            ("file://localhost/C:/p", "C:/p"),
            ("file:///C:\\a b\\p", "C:\\a b\\p"),
            ("file://C:/p", "C:/p"),
            ("file://C:\\p", "C:\\p"),
            ("file://server/share/a%20b", "//server/share/a b"),
            ("file:////server/share/p", "//server/share/p"),
        ] {
            assert_eq!(path(uri, true).as_deref(), Ok(expected), "{uri}");
        }
        assert!(matches!(
            path("file://server", true),
            Err(LocationError::Scheme(_))
        ));
        assert_eq!(path("file:///C:/p", false).as_deref(), Ok("/C:/p"));
    }
}
