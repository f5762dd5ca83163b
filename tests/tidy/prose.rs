//! Prose of the pages that are read first: short sentences, short bullets, few lines, a whole index of decisions.

use std::fs;

use crate::tidy::source::{files, name, no_complaints, root};

/// Pages, each with the most lines that it may have.
const PAGES: [(&str, usize); 2] = [("README.md", 150), ("ARCHITECTURE.md", 120)];
/// Most words of a sentence.
const SENTENCE: usize = 30;
/// Most words of the sentence in the middle, by length.
const MEDIAN: usize = 15;
/// Most characters of a bullet.
const BULLET: usize = 300;

/// A paragraph or a bullet in one line of text.
struct Block {
    line: usize,
    bullet: bool,
    text: String,
}

/// Paragraphs and bullets of a page, without fenced code, tables, headings and HTML.
fn blocks(page: &str) -> Vec<Block> {
    let (mut found, mut fenced, mut open) = (Vec::<Block>::new(), false, false);
    for (number, line) in page.lines().enumerate() {
        let text = line.trim();
        let fence = text.starts_with("```");
        fenced ^= fence;
        if fence || fenced || text.is_empty() || text.starts_with(['|', '#', '<']) {
            open = false;
            continue;
        }
        if let Some(rest) = bullet(text) {
            found.push(Block {
                line: number + 1,
                bullet: true,
                text: rest.into(),
            });
        } else if let Some(last) = found.last_mut().filter(|_| open) {
            last.text.push(' ');
            last.text.push_str(text);
        } else {
            found.push(Block {
                line: number + 1,
                bullet: false,
                text: text.into(),
            });
        }
        open = true;
    }
    for block in &mut found {
        block.text = visible(&block.text);
    }
    found
}

/// The text of a bullet or of a numbered item.
fn bullet(text: &str) -> Option<&str> {
    let digits = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let numbered = digits.strip_prefix(". ").filter(|_| digits != text);
    text.strip_prefix("- ")
        .or_else(|| text.strip_prefix("* "))
        .or(numbered)
}

/// What is read: links as their text, no pictures, inline code as one word.
fn visible(text: &str) -> String {
    let (mut out, mut rest) = (String::new(), text);
    while let Some(at) = rest.find(['`', '!', '[']) {
        out.push_str(&rest[..at]);
        let here = &rest[at..];
        if let Some((_, after)) = here.strip_prefix('`').and_then(|code| code.split_once('`')) {
            out.push_str("Code");
            rest = after;
        } else if let Some((_, after)) = link(here.strip_prefix('!').unwrap_or_default()) {
            rest = after;
        } else if let Some((words, after)) = link(here) {
            out.push_str(&visible(words));
            rest = after;
        } else {
            out.push_str(&here[..1]);
            rest = &here[1..];
        }
    }
    out.push_str(rest);
    out.replace('*', "")
}

/// Text of the link that begins here, and what follows it.
fn link(text: &str) -> Option<(&str, &str)> {
    let (mut depth, inside) = (0, text.strip_prefix('[')?);
    for (at, c) in inside.char_indices() {
        match c {
            '[' => depth += 1,
            ']' if depth > 0 => depth -= 1,
            ']' => {
                let target = inside[at + 1..].strip_prefix('(')?;
                let (_, after) = target.split_once(')')?;
                return Some((&inside[..at], after));
            }
            _ => {}
        }
    }
    None
}

/// Numbers of words of the sentences of a text, with how each begins.
fn sentences(text: &str) -> Vec<(usize, String)> {
    let (mut found, mut sentence) = (Vec::new(), Vec::new());
    let mut tokens = text.split_whitespace().peekable();
    while let Some(token) = tokens.next() {
        sentence.push(token);
        let closed = token.trim_end_matches([')', '"', '\'']);
        let stop = closed.ends_with(['.', '!', '?']);
        // "e.g. ten" and "A. Name" go on: after an abbreviation comes a small letter, before a name an initial.
        let initial = closed.len() == 2 && closed.starts_with(|c: char| c.is_uppercase());
        let new = |next: &&str| !next.starts_with(|c: char| c.is_lowercase());
        if stop && !initial && tokens.peek().is_none_or(new) {
            found.push(measured(&sentence));
            sentence.clear();
        }
    }
    if !sentence.is_empty() {
        found.push(measured(&sentence));
    }
    found.retain(|(words, _)| *words > 0);
    found
}

fn measured(sentence: &[&str]) -> (usize, String) {
    let word = |token: &&&str| token.contains(char::is_alphanumeric);
    let begin = sentence[..sentence.len().min(6)].join(" ");
    (sentence.iter().filter(word).count(), begin)
}

fn complaints(page: &str, text: &str, most_lines: usize) -> Vec<String> {
    let (mut found, mut lengths) = (Vec::new(), Vec::new());
    let lines = text.lines().count();
    if lines > most_lines {
        found.push(format!("{page}: {lines} lines, at most {most_lines}"));
    }
    for block in blocks(text) {
        let place = format!("{page}:{}", block.line);
        let characters = block.text.chars().count();
        if block.bullet && characters > BULLET {
            found.push(format!("{place}: a bullet of {characters} characters"));
        }
        for (words, begin) in sentences(&block.text) {
            lengths.push(words);
            if words > SENTENCE {
                found.push(format!("{place}: {words} words in \"{begin} ...\""));
            }
        }
    }
    lengths.sort_unstable();
    let median = lengths.get(lengths.len() / 2).copied().unwrap_or_default();
    if median > MEDIAN {
        found.push(format!("{page}: the median sentence has {median} words"));
    }
    found
}

#[test]
fn pages_that_are_read_first_are_short() {
    let mut found = Vec::new();
    for (page, most_lines) in PAGES {
        let text = fs::read_to_string(root().join(page)).expect("a readable page");
        found.extend(complaints(page, &text, most_lines));
    }
    no_complaints(&found);
}

#[test]
fn sentences_are_counted() {
    let page = "# A heading\n\nOne `two three` four\n[five six](a.md). Seven, e.g. nine! ![no](b.svg)\n\
                | a | table |\n- First. A. B. Name\n  goes on.\n2. Last\n```\ncode\n```\n";
    let found = blocks(page);
    let bullets: Vec<(usize, bool)> = found.iter().map(|b| (b.line, b.bullet)).collect();
    assert_eq!(bullets, [(3, false), (6, true), (8, true)]);
    let words = |block: &Block| -> Vec<usize> {
        sentences(&block.text)
            .iter()
            .map(|(words, _)| *words)
            .collect()
    };
    let counts: Vec<Vec<usize>> = found.iter().map(words).collect();
    assert_eq!(counts, [vec![5, 3], vec![1, 5], vec![1]]);
}

#[test]
fn long_prose_is_found() {
    let long = "word ".repeat(31);
    let page = format!("{long}.\n\n- {}\n", "letters ".repeat(38));
    let found = complaints("page", &page, 2);
    let about = ["3 lines", "31 words", "characters", "38 words", "median"];
    assert_eq!(found.len(), about.len(), "{found:?}");
    for (complaint, part) in found.iter().zip(about) {
        assert!(complaint.contains(part), "{complaint}");
    }
}

#[test]
fn every_decision_is_in_the_index_once() {
    let index = fs::read_to_string(root().join("docs/decisions/README.md")).expect("an index");
    let mut found = Vec::new();
    for path in files("docs/decisions") {
        let path = name(&path);
        let file = path.trim_start_matches("docs/decisions/");
        let number = file.split('-').next().unwrap_or_default();
        let row = format!("\n| [{}]({file}) |", number.trim_start_matches('0'));
        let rows = index.matches(&row).count();
        if file != "README.md" && rows != 1 {
            found.push(format!("{path}: {rows} rows in the index"));
        }
    }
    no_complaints(&found);
}
