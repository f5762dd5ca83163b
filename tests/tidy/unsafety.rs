//! Unsafe code stands in four files of the product, and every exported function passes one guard.

use crate::tidy::source::{Source, no_complaints, sources, words};

const ABI: &str = "src/fmi2/abi.rs";
/// What every C interface borrows, and the guard.
const BORROW: &str = "src/fmi/borrow.rs";
/// The processor's words that no safe code may write.
const FLOAT: &str = "src/fmi/float.rs";
/// Where the library is, which only the system that loaded it knows.
const PLACE: &str = "src/fmi/place.rs";
/// The master that measures what the interface costs: it must call what it measures.
const MASTER: &str = "crates/studies/src/overhead/master.rs";
/// The interface of the units that tests couple the product with: it must not share the product's faults.
const PARTNERS: &str = "crates/example-fmus/src/abi.rs";
/// Everything but the tests.
const FOLDERS: [&str; 7] = [
    "src",
    "crates/fmu",
    "crates/fmu-package/src",
    "crates/cli/src",
    "xtask/src",
    "crates/studies/src",
    "crates/example-fmus/src",
];

#[test]
fn unsafe_code_is_in_the_interface_only() {
    let mut complaints = Vec::new();
    for source in sources(&FOLDERS) {
        if ![ABI, BORROW, FLOAT, PLACE, MASTER, PARTNERS].contains(&source.path.as_str()) {
            let found = words(&source.code, "unsafe");
            complaints.extend(found.map(|at| format!("{}:{}", source.path, source.line(at))));
        }
    }
    no_complaints(&complaints);
}

/// Functions that have no instance to guard: two constants, the making and the end of an instance.
const UNGUARDED: [(&str, &str); 4] = [
    ("fmi2GetTypesPlatform", "c"),
    ("fmi2GetVersion", "c"),
    ("fmi2Instantiate", "catch_unwind"),
    ("fmi2FreeInstance", "catch_unwind"),
];
/// Lines of a guarded function, signature included.
const SHORT: usize = 25;

/// Name and text of every exported function.
fn exported(source: &Source) -> Vec<(String, &str)> {
    let mut found = Vec::new();
    for (at, _) in source.code.match_indices("#[unsafe(no_mangle)]") {
        let rest = &source.code[at..];
        let start = words(rest, "fn").next().expect("an exported function");
        let name = rest[start + 2..].trim_start();
        let end = name.find('(').expect("a list of parameters");
        let body = rest.find('{').expect("a body");
        let mut depth = 0;
        let close = rest[body..].char_indices().find(|(_, c)| {
            depth += i32::from(*c == '{') - i32::from(*c == '}');
            depth == 0
        });
        let close = body + close.expect("balanced braces").0;
        found.push((name[..end].to_owned(), &rest[start..=close]));
    }
    found
}

#[test]
fn every_exported_function_is_short_and_guarded() {
    let source = Source::read(ABI);
    let functions = exported(&source);
    assert!(functions.len() > 15, "only {} functions", functions.len());
    let mut complaints = Vec::new();
    for (name, text) in functions {
        let unguarded = UNGUARDED.iter().find(|(exception, _)| *exception == name);
        let passes = unguarded.map_or("guard(", |(_, word)| *word);
        let computes = passes == "catch_unwind";
        for passes in [Some(passes), computes.then_some("Environment::standard()")]
            .into_iter()
            .flatten()
        {
            if !text.contains(passes) {
                complaints.push(format!("{name}: does not pass {passes}"));
            }
        }
        let lines = text.lines().count();
        if unguarded.is_none() && lines > SHORT {
            complaints.push(format!("{name}: {lines} lines"));
        }
    }
    no_complaints(&complaints);
}

#[test]
fn exported_functions_are_nowhere_else() {
    for source in sources(&FOLDERS) {
        let exports = source.code.contains("no_mangle") || source.code.contains("export_name");
        let may = [ABI, PARTNERS].contains(&source.path.as_str());
        assert!(!exports || may, "{}", source.path);
    }
}

#[test]
fn what_windows_exports_is_what_the_interface_offers() {
    let functions = |path: &str| {
        let code = Source::read(path).text;
        let words = code.split(|c: char| !c.is_ascii_alphanumeric());
        let is_function = |word: &&str| {
            let rest = word.strip_prefix("fmi2").unwrap_or_default();
            rest.starts_with(|c: char| c.is_ascii_uppercase())
        };
        let named = words
            .filter(is_function)
            .filter(|word| !TYPES.contains(word));
        let mut names: Vec<String> = named.map(str::to_owned).collect();
        names.sort();
        names.dedup();
        names
    };
    assert_eq!(functions("xtask/src/exports.rs"), functions(ABI));
}

/// Names of the standard that are no functions.
const TYPES: [&str; 9] = [
    "fmi2Component",
    "fmi2FMUstate",
    "fmi2CallbackFunctions",
    "fmi2CallbackLogger",
    "fmi2Type",
    "fmi2CoSimulation",
    "fmi2StatusKind",
    "fmi2LastSuccessfulTime",
    "fmi2Terminated",
];
