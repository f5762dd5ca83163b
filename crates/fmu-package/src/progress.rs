//! Telling the user what happens meanwhile.

use std::time::{Duration, Instant};

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};

/// Runs a silent action with a spinner on a terminal. Says afterwards what was done and how long it took.
///
/// # Errors
/// Errors of `action`.
pub fn announced<T>(doing: &str, done: &str, action: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let style = ProgressStyle::with_template("{spinner} {msg} ({elapsed})")
        .unwrap_or_else(|_| ProgressStyle::default_spinner());
    let spinner = ProgressBar::new_spinner()
        .with_style(style)
        .with_message(doing.to_owned());
    spinner.enable_steady_tick(Duration::from_millis(100));
    let result = action();
    spinner.finish_and_clear();
    if result.is_ok() {
        eprintln!("{done} ({:.1} s)", started.elapsed().as_secs_f64());
    }
    result
}

/// A bar on standard error, as a template of `indicatif` says; invisible where that is no terminal.
pub fn bar(template: &str, count: u64) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(count).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
