//! Running other programs, and telling the user what happens meanwhile.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressStyle};

/// Runs a command whose output the user sees.
pub fn run(command: &mut Command) -> Result<()> {
    let status = command
        .status()
        .with_context(|| format!("cannot start {}", name(command)))?;
    if !status.success() {
        bail!("{} failed ({status})", name(command));
    }
    Ok(())
}

/// Runs a command and returns its standard output; standard error stays with the user.
pub fn stdout(command: &mut Command) -> Result<String> {
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot start {}", name(command)))?;
    if !output.status.success() {
        bail!("{} failed ({})", name(command), output.status);
    }
    String::from_utf8(output.stdout)
        .with_context(|| format!("{} printed something other than UTF-8", name(command)))
}

/// Runs a command silently; what it printed becomes part of the error if it fails.
pub fn run_quietly(command: &mut Command) -> Result<()> {
    let output = command
        .output()
        .with_context(|| format!("cannot start {}", name(command)))?;
    if !output.status.success() {
        let printed = String::from_utf8_lossy(&output.stdout);
        let errors = String::from_utf8_lossy(&output.stderr);
        bail!(
            "{} failed ({})\n{printed}{errors}",
            name(command),
            output.status
        );
    }
    Ok(())
}

/// Runs a command and returns what it printed; nothing where it took longer than that and was stopped.
pub fn output_within(command: &mut Command, most: Duration) -> Result<Option<Output>> {
    let started = Instant::now();
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command
        .spawn()
        .with_context(|| format!("cannot start {}", name(command)))?;
    while child.try_wait()?.is_none() {
        if started.elapsed() > most {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.wait_with_output().map(Some).map_err(Into::into)
}

/// Does something that prints nothing itself, with a spinner where there is a terminal, and says
/// afterwards what was done and how long it took.
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

/// A path as the user would write it: relative to the current folder where it lies below it.
pub fn shown(path: &Path) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(&here)
        .unwrap_or(path)
        .display()
        .to_string()
}

/// The path, absolute, with the folder that is to hold it created.
pub fn prepared(path: &Path) -> Result<PathBuf> {
    let path =
        std::path::absolute(path).with_context(|| format!("{} is no path", path.display()))?;
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot create the folder {}", shown(folder)))?;
    }
    Ok(path)
}

/// Writes a file under another name first, of this process alone: nobody ever meets half of it.
pub fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    let partial = partial(path);
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    if written.is_err() {
        // A full disk is no place for half a file; the first error is the one to tell.
        let _ = std::fs::remove_file(&partial);
    }
    written.with_context(|| format!("cannot write {}", shown(path)))
}

/// The name that a file has while it is written.
pub fn partial(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".partial-{}", std::process::id()));
    path.with_file_name(name)
}

fn name(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let program = program.file_stem().unwrap_or(program.as_os_str());
    let first = command.get_args().next().unwrap_or_default();
    format!("`{} {} …`", program.display(), shown(Path::new(first)))
}
