//! Exudyn, run by `lab/exudyn/run.py --serve`: one process that stays warm, a line in for a line out.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Stdio};

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::cargo::Workspace;
use crate::python::Python;

use super::numbers::{Path, number, path};

const SERVER: &str = "lab/exudyn/run.py";

/// The running program.
pub struct Exudyn {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

/// What a run gave.
pub struct Answer {
    /// Places of the marker, m.
    pub path: Path,
    /// CPU time of the steps alone, s.
    pub cpu_time: f64,
}

impl Exudyn {
    /// Starts it, in an environment of its own with its pinned version.
    pub fn start(workspace: &Workspace) -> Result<Self> {
        let python = Python::prepare_peers(workspace)?;
        let mut command = python.script(&workspace.path(SERVER));
        command.arg("--serve");
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command
            .stderr(Stdio::null())
            .spawn()
            .context("cannot start Exudyn")?;
        let input = child.stdin.take().context("expected a standard input")?;
        let output = child.stdout.take().context("expected a standard output")?;
        Ok(Self {
            child,
            input,
            output: BufReader::new(output),
        })
    }

    /// One run with options as `run.py` has them.
    pub fn run(&mut self, options: &Value) -> Result<Answer> {
        writeln!(self.input, "{options}").context("Exudyn has stopped")?;
        let answer = loop {
            let mut line = String::new();
            if self.output.read_line(&mut line)? == 0 {
                bail!("Exudyn stopped in the run {options}");
            }
            // It greets and warns in words.
            if line.starts_with('{') {
                break serde_json::from_str::<Value>(&line)?;
            }
        };
        if answer["good"] != Value::Bool(true) {
            bail!("Exudyn failed in the run {options}: {}", answer["failure"]);
        }
        Ok(Answer {
            path: path(&answer["path"])?,
            cpu_time: number(&answer["cpu_time"])?,
        })
    }
}

impl Drop for Exudyn {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
