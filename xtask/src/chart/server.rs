//! Programs of others, run by a Python file with `--serve`: one process that stays warm, a line in for a line out.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Stdio};

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::cargo::Workspace;
use crate::python::Python;

use super::numbers::{Path, number, path};

/// Exudyn for scenes of the plane, and of rods in space.
pub const EXUDYN: &str = "crates/studies/exudyn/run.py";
/// PyElastica for one clamped rod.
pub const ELASTICA: &str = "crates/studies/exudyn/elastica_rod.py";
/// Exudyn for rectangular plates.
pub const PLATES: &str = "crates/studies/exudyn/plates.py";
/// MuJoCo, Pinocchio and Exudyn for trees in space.
pub const TREES: &str = "crates/studies/trees/run.py";

/// The running program.
pub struct Server {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

/// Results of a run.
pub struct Answer<const D: usize = 2> {
    /// Places of the marker, m.
    pub path: Path<D>,
    /// CPU time of the steps alone, s.
    pub cpu_time: f64,
}

impl Server {
    /// Starts a server from a file of the project, in an environment of its own with pinned versions.
    ///
    /// # Errors
    /// The environment cannot be installed, or the server does not start.
    pub fn start(workspace: &Workspace, file: &str) -> Result<Self> {
        let python = Python::prepare_peers(workspace)?;
        let mut command = python.script(&workspace.path(file));
        command.arg("--serve");
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command
            .stderr(Stdio::null())
            .spawn()
            .with_context(|| format!("cannot start {file}"))?;
        let input = child.stdin.take().context("expected a standard input")?;
        let output = child.stdout.take().context("expected a standard output")?;
        Ok(Self {
            child,
            input,
            output: BufReader::new(output),
        })
    }

    /// Runs once, with options in the form of `run.py`.
    ///
    /// # Errors
    /// The server fails.
    pub fn run<const D: usize>(&mut self, options: &Value) -> Result<Answer<D>> {
        let answer = self.ask(options)?;
        if answer["good"] != Value::Bool(true) {
            bail!("a run failed: {options}: {}", answer["failure"]);
        }
        Ok(Answer {
            path: path(&answer["path"])?,
            cpu_time: number(&answer["cpu_time"])?,
        })
    }

    /// Returns the server's answer to options.
    ///
    /// # Errors
    /// The server ends or answers no JSON.
    pub fn ask(&mut self, options: &Value) -> Result<Value> {
        writeln!(self.input, "{options}").context("the program has stopped")?;
        loop {
            let mut line = String::new();
            if self.output.read_line(&mut line)? == 0 {
                bail!("the program stopped in the run {options}");
            }
            // Programs greet and warn in words.
            if line.starts_with('{') {
                return Ok(serde_json::from_str(&line)?);
            }
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
