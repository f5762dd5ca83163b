//! Docs of public items: each is read alone, and functions that can fail say with which errors.

use crate::tidy::source::{Source, all, no_complaints, words};

/// Words that no doc begins with: they point at another doc, or begin a clause without a noun.
const POINTERS: [&str; 13] = [
    "The same", "What", "Its", "That", "Of", "Such", "It", "They", "This", "These", "Those",
    "Their", "Theirs",
];

/// An item with a doc, or a function.
struct Item {
    /// Line of the item, from 1.
    line: usize,
    /// Lines of the doc, without slashes.
    doc: Vec<String>,
    /// Code of the item up to its body.
    signature: String,
    is_public: bool,
}

impl Item {
    /// Returns the first words of the doc that point elsewhere, if it begins with such.
    fn pointer(&self) -> Option<&'static str> {
        let first = self.doc.first()?;
        let rest = |word: &&str| first.strip_prefix(*word);
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric());
        POINTERS
            .into_iter()
            .find(|word| rest(word).is_some_and(ends))
    }

    /// Tells whether the item is a function that returns a `Result`.
    fn can_fail(&self) -> bool {
        let bounded = words(&self.signature, "where").next();
        let signature = &self.signature[..bounded.unwrap_or(self.signature.len())];
        let returned = arrows(signature).pop().map(|at| &signature[at..]);
        is_function(signature)
            && returned.is_some_and(|code| words(code, "Result").next().is_some())
    }

    fn has_errors(&self) -> bool {
        self.doc.iter().any(|line| line == "# Errors")
    }
}

/// Tells whether an item that begins here is a function with a name, by its first line.
fn is_function(code: &str) -> bool {
    let line = code.lines().next().unwrap_or_default();
    let mut names = words(line, "fn").map(|at| line[at + 2..].trim_start());
    names.any(|name| name.starts_with(|c: char| c.is_alphabetic() || c == '_'))
}

/// Places of arrows outside of parentheses.
fn arrows(signature: &str) -> Vec<usize> {
    let (mut depth, mut found) = (0, Vec::new());
    for (at, c) in signature.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '-' if depth == 0 && signature[at..].starts_with("->") => found.push(at),
            _ => {}
        }
    }
    found
}

/// Code of an item that begins here, up to its body or its semicolon.
fn signature(code: &str) -> &str {
    let mut depth = 0;
    let end = code.find(|c: char| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        depth <= 0 && matches!(c, '{' | ';')
    });
    &code[..end.unwrap_or(code.len())]
}

/// Kind of a block of code, as far as the visibility of its members goes.
#[derive(Clone, Copy, PartialEq)]
enum Block {
    /// Variants of a public enum, and their fields.
    Enum,
    /// Methods of a public trait.
    Trait,
    Other,
}

impl Block {
    /// Returns the kind of the block that a header opens inside another block.
    fn of(header: &str, outside: Option<Self>) -> Self {
        let has = |word: &str| words(header, word).next().is_some();
        match (has("enum"), has("trait"), has("pub")) {
            (true, _, true) => Self::Enum,
            (_, true, true) => Self::Trait,
            (false, false, _) if outside == Some(Self::Enum) => Self::Enum,
            _ => Self::Other,
        }
    }
}

/// All items with docs, and all functions.
fn items(source: &Source) -> Vec<Item> {
    let (mut found, mut doc, mut attribute) = (Vec::new(), Vec::<String>::new(), 0);
    let (mut blocks, mut header) = (Vec::<Block>::new(), String::new());
    let mut start = 0;
    let lines = source.text.split('\n').zip(source.code.split('\n'));
    for (number, (text, code)) in lines.enumerate() {
        let (here, begin) = (code.trim(), start + code.len() - code.trim_start().len());
        start += code.len() + 1;
        if let Some(line) = text.trim_start().strip_prefix("///") {
            doc.push(line.trim().to_owned());
        }
        if here.is_empty() {
            continue;
        }
        if attribute > 0 || here.starts_with("#[") {
            let count = |of: char| i32::try_from(code.matches(of).count()).expect("a short line");
            attribute += count('[') - count(']');
            continue;
        }
        let inside = blocks.last().copied();
        let is_member = matches!(inside, Some(Block::Enum | Block::Trait));
        let signature = signature(&source.code[begin..]);
        if !doc.is_empty() || is_function(here) {
            found.push(Item {
                line: number + 1,
                doc: std::mem::take(&mut doc),
                signature: signature.to_owned(),
                is_public: is_member || here.starts_with("pub"),
            });
        }
        for c in code.chars().chain(['\n']) {
            match c {
                '{' => blocks.push(Block::of(&header, blocks.last().copied())),
                '}' => drop(blocks.pop()),
                _ => header.push(c),
            }
            if matches!(c, '{' | '}' | ';') {
                header.clear();
            }
        }
    }
    found
}

fn complaints(source: &Source) -> Vec<String> {
    let mut found = Vec::new();
    for item in items(source).iter().filter(|item| item.is_public) {
        let place = format!("{}:{}", source.path, item.line);
        if let Some(word) = item.pointer() {
            found.push(format!("{place}: a doc that begins with \"{word}\""));
        }
        if item.can_fail() && !item.has_errors() {
            found.push(format!(
                "{place}: a function that can fail without `# Errors`"
            ));
        }
    }
    found
}

#[test]
fn docs_are_read_alone_and_tell_errors() {
    no_complaints(&all().iter().flat_map(complaints).collect::<Vec<_>>());
}

#[test]
fn bad_docs_are_found() {
    let text = "\
/// Its kind.
#[derive(
    Debug,
)]
pub enum A {
    /// What is in braces.
    B {
        /// Of a field.
        c: fn(u8),
    },
    /// Italic.
    D,
}
/// It is private.
enum E {
    /// They are too.
    F,
}
pub trait G {
    /// The same.
    fn h(&self) -> io::Result<()>;
    fn i(&self) -> Result<u8, ()> {
        /// Of no one.
        fn j() -> Result<(), ()> {}
    }
}
impl K {
    /// # Errors
    /// None.
    pub fn l(x: [u8; 3]) -> Result<(), ()> {}
    pub fn m(
        call: impl Fn() -> Result<(), ()>,
    ) -> Outcome
    where
        N: Fn() -> Result<(), ()>,
    {
    }
    /// Such: a struct.
    // A comment.
    pub(super) fn n() -> (u8, Result<(), ()>) {}
    fn o() -> Result<(), ()> {}
}
";
    let found = complaints(&Source::of("a.rs", text));
    let expected = [
        (5, "Its"),
        (7, "What"),
        (9, "Of"),
        (21, "The same"),
        (21, "# Errors"),
        (22, "# Errors"),
        (40, "Such"),
        (40, "# Errors"),
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (complaint, (line, part)) in found.iter().zip(expected) {
        let place = format!("a.rs:{line}: ");
        assert!(
            complaint.starts_with(&place) && complaint.contains(part),
            "{complaint} {line}"
        );
    }
}
