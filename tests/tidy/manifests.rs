//! What the manifests must and must not say.

use std::fs;

use crate::tidy::source::{files, name, no_complaints, root};

/// Lines of a manifest without comments, with the section that each stands in.
fn lines(path: &str) -> Vec<(String, String)> {
    let text = fs::read_to_string(root().join(path)).expect("a manifest");
    let mut section = String::new();
    let mut found = Vec::new();
    for line in text.lines() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if let Some(header) = line.strip_prefix('[') {
            section = header.trim_end_matches(']').into();
        }
        if !line.is_empty() {
            found.push((section.clone(), line.to_owned()));
        }
    }
    found
}

/// Names of dependencies of all kinds.
fn dependencies(path: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (section, line) in lines(path) {
        match section.split_once("dependencies.") {
            Some((_, name)) if line.starts_with('[') => found.push(name.into()),
            None if section.ends_with("dependencies") && !line.starts_with('[') => {
                let name = line.split(['=', '.']).next().unwrap_or_default();
                found.push(name.trim().trim_matches('"').into());
            }
            _ => {}
        }
    }
    found
}

#[test]
fn xtask_never_depends_on_the_library() {
    let found = dependencies("xtask/Cargo.toml");
    assert!(found.iter().any(|name| name == "clap"), "{found:?}");
    assert!(found.iter().all(|name| name != "flexbody"), "{found:?}");
    // Nor by what it shares with the program.
    let is_path = |(_, line): &(String, String)| line.contains("path =");
    let mut paths = lines("xtask/Cargo.toml").into_iter().filter(is_path);
    let (_, shared) = paths.next().expect("what is shared with the program");
    assert!(shared.starts_with("fmu-package ="), "{shared}");
    assert_eq!(paths.next(), None);
    assert!(!lines("crates/fmu-package/Cargo.toml").iter().any(is_path));
}

#[test]
fn there_are_no_features_and_libraries_are_linked_apart() {
    for folder in [
        ".",
        "crates/fmu",
        "crates/fmu-package",
        "crates/example-fmus",
        "crates/cli",
        "xtask",
    ] {
        let path = &format!("{folder}/Cargo.toml");
        let is_linked = ["crates/fmu", "crates/example-fmus"].contains(&folder);
        for (section, line) in lines(path) {
            assert!(section != "features", "{path}: [features]");
            assert!(
                is_linked || !line.starts_with("crate-type"),
                "{path}: {line}"
            );
            assert!(!line.contains("optional = true"), "{path}: {line}");
        }
    }
    // What is in every FMU is the library, and nothing else.
    assert_eq!(dependencies("crates/fmu/Cargo.toml"), ["flexbody"]);
}

#[test]
fn panics_unwind() {
    // A panic must reach the guard of the C interface, not abort the master.
    for (_, line) in lines("Cargo.toml") {
        assert!(!line.starts_with("panic"), "{line}");
    }
}

#[test]
fn every_dependency_is_a_recorded_decision() {
    let decisions: Vec<String> = files("docs/decisions")
        .iter()
        .map(|path| fs::read_to_string(path).expect("a readable decision"))
        .collect();
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let mut complaints = Vec::new();
    let manifests = [
        "Cargo.toml",
        "crates/fmu-package/Cargo.toml",
        "crates/cli/Cargo.toml",
    ];
    for dependency in manifests.into_iter().flat_map(dependencies) {
        let named = |text: &String| text.split(|c: char| !is_name(c)).any(|w| w == dependency);
        if !decisions.iter().any(named) {
            complaints.push(format!("{dependency}: named nowhere in docs/decisions"));
        }
    }
    no_complaints(&complaints);
}

#[test]
fn all_manifests_promise_one_rust_version() {
    let promised = |path: &str| {
        let mut lines = lines(&format!("{path}/Cargo.toml")).into_iter();
        lines.find_map(|(section, line)| {
            (line.starts_with("rust-version")).then_some((section, line))
        })
    };
    let inherited = Some((
        "package".to_owned(),
        "rust-version.workspace = true".to_owned(),
    ));
    for path in [
        ".",
        "crates/fmu",
        "crates/fmu-package",
        "crates/example-fmus",
        "crates/cli",
        "crates/studies",
        "tests",
        "xtask",
    ] {
        assert_eq!(promised(path), inherited, "{path}");
    }
    let mut workspace = lines("Cargo.toml").into_iter();
    let is_one = |(section, line): &(String, String)| {
        section == "workspace.package" && line.starts_with("rust-version")
    };
    let (_, version) = workspace.find(is_one).expect("a version of Rust");
    for path in [
        "crates/studies/diffsol",
        "crates/fmi-rs-checker",
        "crates/fuzz",
    ] {
        let found = promised(path).map(|(_, line)| line);
        assert_eq!(found.as_deref(), Some(&version[..]), "{path}");
    }
}

#[test]
fn cited_decisions_exist() {
    let decisions: Vec<String> = files("docs/decisions")
        .iter()
        .map(|path| name(path))
        .collect();
    let mut complaints = Vec::new();
    for folder in [
        "src",
        "tests",
        "crates/fmu-package/src",
        "crates/cli",
        "xtask/src",
        "docs",
    ] {
        for path in files(folder) {
            let Ok(text) = fs::read_to_string(&path) else {
                continue;
            };
            for (at, _) in text.match_indices(concat!("docs/decisions", "/0")) {
                let is_path = |c: char| c.is_ascii_alphanumeric() || "/-_.".contains(c);
                let cited: String = text[at..].chars().take_while(|c| is_path(*c)).collect();
                if !decisions.contains(&cited.trim_end_matches('.').to_owned()) {
                    complaints.push(format!("{}: {cited} does not exist", name(&path)));
                }
            }
        }
    }
    no_complaints(&complaints);
}
