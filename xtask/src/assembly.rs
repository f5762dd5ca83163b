//! What the compiler made of the library: instructions of newer processors stand where they are needed, or are called
//! one by one where something around them was not inlined, several times slower.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use packing::shown;

use crate::package::PACKAGE;

/// Makes the compiler write down what the library consists of, beside what it is linked from.
pub const EMIT: &str = "--emit=link,asm";

/// Functions that are a single instruction each, by their place in the standard library.
const INSTRUCTIONS: &str = "core_arch";
/// Those that ask what the processor can do, once.
const QUESTIONS: [&str; 2] = ["xgetbv", "cpuid"];

/// Checks the library that was built last: no instruction is called.
pub fn check(library: &Path) -> Result<()> {
    let folder = library.parent().context("expected a folder")?;
    let listing = folder.join(format!("deps/{PACKAGE}.s"));
    let place = shown(&listing);
    let text = std::fs::read_to_string(&listing).with_context(|| format!("cannot read {place}"))?;
    let called = called(&text)?;
    ensure!(
        called.is_empty(),
        "{place}: expected vector instructions inlined, found functions that are one instruction each; \
         a closure or a function that is not #[inline(always)] stands around them: {}",
        called.join(", ")
    );
    Ok(())
}

/// Names of functions that are a single instruction.
fn called(listing: &str) -> Result<Vec<&str>> {
    let labels = listing.lines().filter_map(|line| line.strip_suffix(':'));
    let labels: Vec<&str> = labels
        .filter(|label| !label.starts_with(['.', ' ', '\t']))
        .collect();
    ensure!(
        !labels.is_empty(),
        "expected labels of functions, found none"
    );
    let is_called = |label: &&str| {
        let asks = QUESTIONS.iter().any(|question| label.contains(question));
        label.contains(INSTRUCTIONS) && !asks
    };
    Ok(labels.into_iter().filter(is_called).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "_ZN8flexbody5force:\n.LBB0_1:\n\tvmulpd %ymm0, %ymm1, %ymm2\n\
                        _ZN4core9core_arch3x865xsave7_xgetbv:\n\tret\n";

    #[test]
    fn instructions_that_are_called_are_found() {
        assert_eq!(called(GOOD).expect("labels"), [""; 0]);
        let bad = format!("{GOOD}_ZN4core9core_arch3x863fma15_mm256_fmadd_pd:\n\tret\n");
        let found = called(&bad).expect("labels");
        assert_eq!(found, ["_ZN4core9core_arch3x863fma15_mm256_fmadd_pd"]);
        assert!(called("\tret\n").is_err());
    }
}
