//! The Python environments of the project: virtual environments among the products, with every
//! version pinned. Nothing outside the products is read or written.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::cargo::Workspace;
use crate::process::{announced, run_quietly, shown};

/// The pinned packages of tests and pictures, and their folder among the products.
const PROJECT: (&str, &str) = ("tests/fmpy/requirements.txt", "python");
/// The same of the programs that charts compare the product with; apart, so that no check needs them.
const PEERS: (&str, &str) = ("lab/exudyn/requirements.txt", "python-peers");
/// The same of the masters that tests couple FMUs in; apart, so that a picture needs none of them.
const MASTERS: (&str, &str) = ("tests/masters/requirements.txt", "python-masters");
/// The linker of libraries; apart, so that what needs no library does not need it.
const LINKER: (&str, &str) = ("xtask/linker.txt", "python-linker");
/// Oldest Python that the pinned packages run on.
const OLDEST: (u32, u32) = (3, 11);
/// Where to look, best first: the version that the pins were made with, then any other.
const CANDIDATES: [&str; 6] = [
    "python3.11",
    "python3.12",
    "python3.13",
    "python3.14",
    "python3",
    "python",
];
/// Prints the version where a virtual environment can be made, else fails and says why.
const PROBE: &str = "import sys, venv, ensurepip; print(*sys.version_info[:2])";

/// A Python interpreter with the project's packages.
pub struct Python {
    interpreter: PathBuf,
    temporary: PathBuf,
    settings: PathBuf,
}

impl Python {
    /// The environment, made or brought up to date where needed.
    pub fn prepare(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, PROJECT)
    }

    /// The environment of the programs to compare with.
    pub fn prepare_peers(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, PEERS)
    }

    /// The environment of the masters.
    pub fn prepare_masters(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, MASTERS)
    }

    /// The environment of the linker.
    pub fn prepare_linker(workspace: &Workspace) -> Result<Self> {
        Self::prepare_one(workspace, LINKER)
    }

    fn prepare_one(workspace: &Workspace, (requirements, folder): (&str, &str)) -> Result<Self> {
        let folder = workspace.target(folder);
        let interpreter = if cfg!(windows) {
            folder.join("Scripts").join("python.exe")
        } else {
            folder.join("bin").join("python")
        };
        let python = Self {
            interpreter,
            temporary: workspace.target("tmp"),
            settings: folder.join("matplotlib"),
        };
        std::fs::create_dir_all(&python.temporary)
            .with_context(|| format!("cannot create the folder {}", shown(&python.temporary)))?;
        let requirements = workspace.path(requirements);
        let wanted = std::fs::read_to_string(&requirements)
            .with_context(|| format!("cannot read {}", shown(&requirements)))?;
        let stamp = folder.join("installed.txt");
        let is_current = std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted);
        if !is_current || !python.runs() {
            python.install(&folder, &requirements)?;
            std::fs::write(&stamp, wanted)
                .with_context(|| format!("cannot write {}", shown(&stamp)))?;
        }
        Ok(python)
    }

    /// A command that runs a Python file.
    pub fn script(&self, file: &Path) -> Command {
        let mut command = self.command();
        command.arg(file);
        command
    }

    /// A command that runs a module.
    pub fn module(&self, name: &str) -> Command {
        let mut command = self.command();
        command.args(["-m", name]);
        command
    }

    /// A program that came with a package, or the interpreter itself.
    pub fn program(&self, name: &str) -> PathBuf {
        self.interpreter.with_file_name(name)
    }

    fn command(&self) -> Command {
        let mut command = isolated(&self.interpreter);
        command
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .env("PYTHONUTF8", "1")
            .env("MPLBACKEND", "Agg")
            .env("MPLCONFIGDIR", &self.settings);
        for variable in ["TMPDIR", "TEMP", "TMP"] {
            command.env(variable, &self.temporary);
        }
        command
    }

    /// Whether the interpreter still starts: the Python it was made from may be gone.
    fn runs(&self) -> bool {
        let probe = self.command().args(["-c", ""]).output();
        probe.is_ok_and(|output| output.status.success())
    }

    fn install(&self, folder: &Path, requirements: &Path) -> Result<()> {
        let base = find()?;
        let done = format!("made the Python environment {}", shown(folder));
        announced("making the Python environment", &done, || {
            run_quietly(
                isolated(Path::new(base))
                    .args(["-m", "venv", "--clear"])
                    .arg(folder),
            )?;
            run_quietly(
                self.module("pip")
                    .args(["install", "--no-input", "--no-cache-dir"])
                    .args(["--disable-pip-version-check", "--requirement"])
                    .arg(requirements),
            )
            .with_context(|| format!("cannot install {}", shown(requirements)))
        })
    }
}

/// Finds a Python that is new enough and can make a virtual environment.
fn find() -> Result<&'static str> {
    let mut found = Vec::new();
    for name in CANDIDATES {
        // Not on this machine: nothing to report.
        let Ok(output) = isolated(Path::new(name)).args(["-c", PROBE]).output() else {
            continue;
        };
        if !output.status.success() {
            let errors = String::from_utf8_lossy(&output.stderr);
            let reason = errors
                .trim()
                .lines()
                .last()
                .unwrap_or("does not start")
                .to_owned();
            found.push(format!("{name}: {reason}"));
            continue;
        }
        let version = String::from_utf8_lossy(&output.stdout);
        match parse_version(&version) {
            Some(version) if version >= OLDEST => return Ok(name),
            _ => found.push(format!(
                "{name}: version {}",
                version.trim().replace(' ', ".")
            )),
        }
    }
    let found = if found.is_empty() {
        "none".to_owned()
    } else {
        found.join("; ")
    };
    bail!(
        "expected Python {}.{} or newer with venv and ensurepip (Debian: python3-venv), found {found}",
        OLDEST.0,
        OLDEST.1
    )
}

/// A command that no setting of another Python installation reaches.
fn isolated(interpreter: &Path) -> Command {
    let mut command = Command::new(interpreter);
    for variable in ["PYTHONHOME", "PYTHONPATH", "PYTHONSTARTUP", "VIRTUAL_ENV"] {
        command.env_remove(variable);
    }
    command
}

fn parse_version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.trim().split_once(' ')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_compare_by_number() {
        assert_eq!(parse_version("3 11\n"), Some((3, 11)));
        assert!(parse_version("3 9") < Some(OLDEST));
        assert!(parse_version("3 14") > Some(OLDEST));
        assert_eq!(parse_version("Python"), None);
    }
}
