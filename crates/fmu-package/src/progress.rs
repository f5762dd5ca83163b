//! Telling the user what happens meanwhile.

use std::io::{IsTerminal, stderr};
use std::ops::Deref;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};

/// Time from one line to the next where standard error is no terminal.
const EVERY: Duration = Duration::from_secs(10);
/// Beginning of such a line, by which other programs know it.
const PREFIX: &str = "... ";

/// Progress of an action on standard error: a bar or a spinner on a terminal, elsewhere a line every ten seconds. It ends when it is
/// dropped.
pub struct Progress {
    bar: ProgressBar,
    lines: Option<Lines>,
}

/// The thread that writes lines, until its sender is dropped.
struct Lines {
    end: Sender<()>,
    thread: JoinHandle<()>,
}

impl Progress {
    /// Progress of an action of unknown length, with a template of `indicatif` for terminals. Lines begin with `doing`.
    pub fn spinner(template: &str, doing: &str) -> Self {
        let style = ProgressStyle::with_template(template);
        let style = style.unwrap_or_else(|_| ProgressStyle::default_spinner());
        let spinner = ProgressBar::new_spinner().with_style(style);
        spinner.enable_steady_tick(Duration::from_millis(100));
        Self::told(spinner, doing)
    }

    /// Progress of an action in `count` parts, of which `done` were done before.
    pub fn bar(template: &str, doing: &str, count: u64, done: u64) -> Self {
        let bar = bar(template, count).with_position(done);
        bar.reset_eta();
        Self::told(bar, doing)
    }

    fn told(bar: ProgressBar, doing: &str) -> Self {
        let lines = (!stderr().is_terminal()).then(|| {
            let (of, doing) = (bar.clone(), doing.to_owned());
            let (end, ended) = channel();
            let thread = thread::spawn(move || {
                write_lines(&of, &doing, EVERY, &ended, |line| eprintln!("{line}"));
            });
            Lines { end, thread }
        });
        Self { bar, lines }
    }
}

impl Deref for Progress {
    type Target = ProgressBar;

    fn deref(&self) -> &ProgressBar {
        &self.bar
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
        if let Some(Lines { end, thread }) = self.lines.take() {
            drop(end);
            // A thread that panicked has told so.
            let _ = thread.join();
        }
    }
}

/// Writes a line about a bar at every interval until the other side of the channel is dropped.
fn write_lines(
    bar: &ProgressBar,
    doing: &str,
    every: Duration,
    ended: &Receiver<()>,
    mut write: impl FnMut(String),
) {
    let (started, before) = (Instant::now(), bar.position());
    while ended.recv_timeout(every) == Err(RecvTimeoutError::Timeout) {
        write(line(bar, doing, before, started.elapsed().as_secs_f64()));
    }
}

/// A line about a bar that began at a position, after so many seconds.
fn line(bar: &ProgressBar, doing: &str, before: u64, seconds: f64) -> String {
    let mut line = format!("{PREFIX}{doing} for {seconds:.0} s");
    let message = bar.message();
    if !message.is_empty() {
        line += &format!(": {message}");
    }
    if let Some(count) = bar.length() {
        let at = bar.position();
        line += &format!(": {at} of {count} ({} %)", 100 * at / count.max(1));
        if at > before {
            let left = seconds * count.saturating_sub(at) as f64 / (at - before) as f64;
            line += &format!(", about {left:.0} s left");
        }
    }
    line
}

/// Runs a silent action with a spinner on a terminal. Says afterwards what was done and how long it took.
///
/// # Errors
/// Errors of `action`.
pub fn announced<T>(doing: &str, done: &str, action: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let spinner = Progress::spinner(&format!("{{spinner}} {doing} ({{elapsed}})"), doing);
    let result = action();
    drop(spinner);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_what_is_done_its_share_and_the_time_left() {
        let bar = ProgressBar::hidden();
        bar.set_length(200);
        bar.set_position(80);
        assert_eq!(
            line(&bar, "sweeping", 20, 30.0),
            "... sweeping for 30 s: 80 of 200 (40 %), about 60 s left"
        );
        assert_eq!(
            line(&bar, "sweeping", 80, 10.0),
            "... sweeping for 10 s: 80 of 200 (40 %)"
        );
        let spinner = ProgressBar::hidden();
        spinner.unset_length();
        assert_eq!(
            line(&spinner, "packaging", 0, 10.0),
            "... packaging for 10 s"
        );
        spinner.set_message("run 3");
        assert_eq!(
            line(&spinner, "planning", 0, 10.0),
            "... planning for 10 s: run 3"
        );
    }

    /// Lines follow each other while the action is under way, and end with it.
    #[test]
    fn lines_are_written_until_the_end() {
        let (end, ended) = channel();
        let (told, lines) = channel();
        let thread = thread::spawn(move || {
            let bar = ProgressBar::hidden();
            let every = Duration::from_millis(1);
            write_lines(&bar, "waiting", every, &ended, |line| {
                let _ = told.send(line);
            });
        });
        for _ in 0..3 {
            let line = lines.recv().expect("a line");
            assert!(line.starts_with("... waiting for 0 s"), "{line}");
        }
        drop(end);
        thread.join().expect("an end");
    }
}
