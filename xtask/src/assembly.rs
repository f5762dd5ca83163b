//! What the compiler made of the library: instructions of newer processors stand where they are needed, or are called
//! one by one where something around them was not inlined, several times slower.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use fmu_package::shown;

/// Functions that are a single instruction each, by their place in the standard library.
const INSTRUCTIONS: &str = "core_arch";
/// Instructions that query the capabilities of the processor. They run once.
const QUESTIONS: [&str; 2] = ["xgetbv", "cpuid"];
/// How names of functions of Rust begin where they are linked.
const MANGLED: [&str; 2] = ["_ZN", "_R"];

/// Checks the code that the library is linked from: no function that is a single instruction is called.
///
/// # Errors
/// Code that cannot be read, or such a function that is called.
pub fn check(code: &Path) -> Result<()> {
    let place = shown(code);
    let bytes = std::fs::read(code).with_context(|| format!("cannot read {place}"))?;
    let called = called(&bytes)?;
    ensure!(
        called.is_empty(),
        "{place}: expected vector instructions inlined, found functions that are one instruction each; \
         a closure or a function that is not #[inline(always)] stands around them: {}",
        called.join(", ")
    );
    Ok(())
}

/// Names of functions that are a single instruction, from the tables of names in object files.
fn called(objects: &[u8]) -> Result<Vec<&str>> {
    let words = objects.split(|byte| *byte == 0);
    let words = words.filter_map(|word| std::str::from_utf8(word).ok());
    let names: BTreeSet<&str> = words
        .filter(|word| MANGLED.iter().any(|start| word.starts_with(start)))
        .collect();
    ensure!(!names.is_empty(), "expected names of functions, found none");
    let is_called = |name: &&str| {
        let asks = QUESTIONS.iter().any(|question| name.contains(question));
        name.contains(INSTRUCTIONS) && !asks
    };
    Ok(names.into_iter().filter(is_called).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &[u8] =
        b"\x7fELF\0_ZN8flexbody5force\0_ZN4core9core_arch3x865xsave7_xgetbv\0core_arch\0";

    #[test]
    fn instructions_that_are_called_are_found() {
        assert_eq!(called(GOOD).expect("names"), [""; 0]);
        let name = "_ZN4core9core_arch3x863fma15_mm256_fmadd_pd";
        let bad = [GOOD, name.as_bytes(), b"\0"].concat();
        assert_eq!(called(&bad).expect("names"), [name]);
        assert!(called(b"\x7fELF\0core_arch\0").is_err());
    }
}
