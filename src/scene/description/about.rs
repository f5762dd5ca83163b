//! Whose model a scene is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Whose model this is and under which terms it may be used, as the model description says it to every importer. The
/// library that runs it is licensed apart (`documentation/licenses` of the FMU). At most 1000 characters each.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// Subject of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Name and organization of who made it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub author: Option<String>,
    /// Version of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// Copyright of the model, such as `(c) 2026 The firm`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copyright: Option<String>,
    /// The terms under which it may be used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub license: Option<String>,
}

impl About {
    /// Returns the keys that are given, with their texts.
    pub fn texts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let all = [
            ("description", &self.description),
            ("author", &self.author),
            ("version", &self.version),
            ("copyright", &self.copyright),
            ("license", &self.license),
        ];
        all.into_iter()
            .filter_map(|(key, text)| Some((key, text.as_deref()?)))
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.texts().next().is_none()
    }
}
