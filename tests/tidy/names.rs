//! Names of types: each stands for one thing.

use std::collections::BTreeMap;

use crate::tidy::source::{Source, no_complaints, sources, words};

/// Words that declare a type.
const WORDS: [&str; 5] = ["struct", "enum", "trait", "union", "type"];

/// Names of the types that a file declares for itself and others, outside functions and implementations.
fn declared(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for word in WORDS {
        for at in words(code, word) {
            let before = code[..at].rsplit('\n').next().unwrap_or_default();
            // Types inside of traits, implementations and functions are indented.
            if before.starts_with(' ') {
                continue;
            }
            let rest = code[at + word.len()..].trim_start();
            let part = |c: &char| c.is_alphanumeric() || *c == '_';
            found.push(rest.chars().take_while(part).collect());
        }
    }
    found
}

/// Whether a file belongs to one kind of element: there names are those of its papers.
fn is_of_an_element(source: &Source) -> bool {
    let inside = source
        .inside()
        .and_then(|path| path.strip_prefix("elements/"));
    inside.is_some_and(|path| path.contains('/'))
}

/// Where each name is declared in more than one file.
fn declared_twice(sources: &[Source]) -> Vec<String> {
    let mut places: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for source in sources {
        let mut names = declared(source.product());
        // One of several is compiled: each for a platform.
        names.sort();
        names.dedup();
        for name in names {
            places.entry(name).or_default().push(&source.path);
        }
    }
    places.retain(|_, places| places.len() > 1);
    let lines = places.into_iter();
    lines
        .map(|(name, places)| format!("{name}: declared in {}", places.join(", ")))
        .collect()
}

#[test]
fn a_type_name_stands_for_one_thing() {
    let mut all = sources(&["src"]);
    all.retain(|source| !is_of_an_element(source) && !source.path.contains("tests"));
    no_complaints(&declared_twice(&all));
}

#[test]
fn types_of_one_name_are_found() {
    let file = |path: &str, code: &str| Source {
        path: path.into(),
        text: code.into(),
        code: code.into(),
    };
    let one = file(
        "src/a.rs",
        "pub struct Row<N>(N);\nimpl A for Row {\n    type Item = f64;\n}\n",
    );
    let two = file(
        "src/b.rs",
        "enum Row {}\nimpl A for Row {\n    type Item = f64;\n}\n",
    );
    let own = file("src/elements/rod/c.rs", "pub(super) type Row = f64;\n");
    assert_eq!(declared(&one.code), ["Row"]);
    assert!(is_of_an_element(&own) && !is_of_an_element(&one));
    let found = declared_twice(&[one, two]);
    assert_eq!(found, ["Row: declared in src/a.rs, src/b.rs"]);
}
