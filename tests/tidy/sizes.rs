//! Sizes and looks of files and functions.

use crate::tidy::source::{Source, all, no_complaints, words};

/// A file stays under this many lines.
const FILE: usize = 700;
/// A function stays under this many lines, from `fn` to its closing brace.
const FUNCTION: usize = 90;

/// Name, first line and number of lines of every function with a body.
fn functions(source: &Source) -> Vec<(String, usize, usize)> {
    let mut found = Vec::new();
    for at in words(&source.code, "fn") {
        let rest = &source.code[at..];
        let named = rest[2..].trim_start();
        let part = |c: &char| c.is_alphanumeric() || *c == '_';
        let name: String = named.chars().take_while(part).collect();
        // The type of a pointer to a function has no name.
        if name.is_empty() {
            continue;
        }
        if let Some(end) = end_of_body(rest) {
            let lines = 1 + rest[..end].matches('\n').count();
            found.push((name, source.line(at), lines));
        }
    }
    found
}

/// The closing brace of a function that begins here; none where a declaration ends with a semicolon.
fn end_of_body(code: &str) -> Option<usize> {
    let (mut brackets, mut braces) = (0, 0);
    for (at, c) in code.char_indices() {
        match c {
            '[' | '(' => brackets += 1,
            ']' | ')' => brackets -= 1,
            '{' => braces += 1,
            '}' if braces == 1 => return Some(at),
            '}' => braces -= 1,
            ';' if braces == 0 && brackets == 0 => return None,
            _ => {}
        }
    }
    None
}

#[test]
fn files_stay_short() {
    let long = all().into_iter().filter_map(|source| {
        let lines = source.text.lines().count();
        (lines >= FILE).then(|| format!("{}: {lines} lines", source.path))
    });
    no_complaints(&long.collect::<Vec<_>>());
}

#[test]
fn functions_stay_short() {
    let mut complaints = Vec::new();
    for source in all() {
        for (name, line, lines) in functions(&source) {
            if lines >= FUNCTION {
                complaints.push(format!("{}:{line}: {name} has {lines} lines", source.path));
            }
        }
    }
    no_complaints(&complaints);
}

#[test]
fn functions_are_found() {
    let code = "fn a<const N: usize>(x: [f64; 3]) -> [f64; N]\nwhere\n    X: Y,\n{\n    if b { c }\n}\ntrait T {\n    fn d(&self);\n    fn e() {}\n}\nlet f: fn(u8) = g;\n";
    let found = functions(&Source::of("", code));
    let names: Vec<(&str, usize, usize)> = found
        .iter()
        .map(|(name, line, lines)| (name.as_str(), *line, *lines))
        .collect();
    assert_eq!(names, [("a", 1, 6), ("e", 9, 1)]);
    // Every function of a real file, by a count that shares nothing with the one above.
    let radau = Source::read("src/integrators/radau.rs");
    let expected = radau.text.lines().filter(|line| {
        let line = line.trim_start();
        line.starts_with("fn ") || line.starts_with("pub fn ")
    });
    assert_eq!(functions(&radau).len(), expected.count());
}

#[test]
fn every_file_says_first_what_it_is() {
    let silent = all()
        .into_iter()
        .filter(|source| !source.text.starts_with("//! "));
    let complaints: Vec<String> = silent.map(|source| source.path).collect();
    no_complaints(&complaints);
}

/// Names are ASCII; what users read may be anything.
#[test]
fn code_is_ascii() {
    let mut complaints = Vec::new();
    for source in all() {
        for (number, line) in source.code.lines().enumerate() {
            if !line.is_ascii() {
                complaints.push(format!("{}:{}: {line}", source.path, number + 1));
            }
        }
    }
    no_complaints(&complaints);
}
