//! Runs of the product, of the lab and of diffsol on one scene, taking turns.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::Value;

use super::super::numbers::median;
use super::{LONG, Plan, Setting};
use crate::cargo::Workspace;
use crate::package::PACKAGE;
use crate::process::{prepared, shown};
use crate::table::Table;

/// Programs and the folder they write to.
pub struct Programs {
    product: PathBuf,
    lab: PathBuf,
    /// Built where a scene asks for it.
    diffsol: Option<PathBuf>,
    scratch: PathBuf,
}

/// What a run gave: places of all markers at all points, and CPU times of the steps, s.
pub struct Outcome {
    path: Result<Vec<Vec<[f64; 2]>>, String>,
    times: Vec<f64>,
}

impl Outcome {
    /// Places of the markers.
    pub fn path(&self) -> Result<&Vec<Vec<[f64; 2]>>> {
        match &self.path {
            Ok(path) => Ok(path),
            Err(failure) => bail!("expected a run without failure, found: {failure}"),
        }
    }

    /// Median CPU time, s.
    pub fn cpu_time(&self) -> f64 {
        median(&self.times)
    }
}

impl Programs {
    /// Builds them.
    pub fn new(workspace: &Workspace, with_diffsol: bool) -> Result<Self> {
        let diffsol = || workspace.program_apart("lab/diffsol", "lab-diffsol");
        Ok(Self {
            product: workspace.program(PACKAGE)?,
            lab: workspace.program("lab")?,
            diffsol: with_diffsol.then(diffsol).transpose()?,
            scratch: workspace.target("chart"),
        })
    }

    /// Runs everything in rounds; a run that takes long runs once.
    pub fn run(
        &self,
        title: &str,
        setting: &Setting,
        plans: &[Plan],
        rounds: usize,
    ) -> Result<Vec<Outcome>> {
        let template = "{msg} {bar:40} {pos}/{len} runs  {elapsed}";
        let style = ProgressStyle::with_template(template);
        let bar = ProgressBar::new((plans.len() * rounds) as u64)
            .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
            .with_message(title.to_owned());
        let mut outcomes: Vec<Outcome> = Vec::new();
        for round in 0..rounds {
            for (index, plan) in plans.iter().enumerate() {
                bar.inc(1);
                if round > 0 && (outcomes[index].path.is_err() || outcomes[index].times[0] > LONG) {
                    continue;
                }
                let outcome = self.execute(setting, plan)?;
                match outcomes.get_mut(index) {
                    Some(first) => first.times.extend(outcome.times),
                    None => outcomes.push(outcome),
                }
            }
        }
        bar.finish_and_clear();
        eprintln!("{title}: {} runs", plans.len() * rounds);
        Ok(outcomes)
    }

    fn execute(&self, setting: &Setting, plan: &Plan) -> Result<Outcome> {
        let file = |kind: &str| prepared(&self.scratch.join(format!("methods.{kind}")));
        let (scene, outputs, report) = (file("scene.json")?, file("csv")?, file("report.json")?);
        let is_product = plan.method.starts_with("product_");
        let name = plan.method.trim_start_matches("product_");
        let text = match is_product {
            true => setting.with_method(name),
            false => setting.scene.clone(),
        };
        std::fs::write(&scene, text.to_string())?;
        let mut command = Command::new(match (is_product, name) {
            (true, _) => &self.product,
            (_, "diffsol") => self.diffsol.as_ref().context("diffsol was not built")?,
            _ => &self.lab,
        });
        match (is_product, name) {
            (true, _) => command.arg("simulate"),
            (_, "diffsol") => &mut command,
            _ => command.args(["integrate", "--method", name.trim_end_matches("_adaptive")]),
        };
        command
            .arg(&scene)
            .arg("--stop-time")
            .arg(setting.stop_time.to_string());
        command
            .arg("--output")
            .arg(&outputs)
            .arg("--report")
            .arg(&report);
        let every = if is_product { "--step" } else { "--every" };
        command.arg(every).arg(setting.every.to_string());
        if let Some(step) = plan.step {
            command.arg("--step").arg(step.to_string());
        }
        if let Some(tolerance) = plan.tolerance {
            match is_product {
                true => command
                    .arg("--set")
                    .arg(format!("relative_tolerance={tolerance}")),
                false => command.arg("--tolerance").arg(tolerance.to_string()),
            };
        }
        let finished = command.output().context("cannot start a program")?;
        if !finished.status.success() {
            let failure = String::from_utf8_lossy(&finished.stderr).trim().to_owned();
            return Ok(Outcome {
                path: Err(failure),
                times: Vec::new(),
            });
        }
        Ok(Outcome {
            path: Ok(places(setting, &outputs)?),
            times: vec![cpu_time(&report)?],
        })
    }
}

/// Places of every marker that the scene reads.
fn places(setting: &Setting, outputs: &Path) -> Result<Vec<Vec<[f64; 2]>>> {
    let table = Table::read(outputs)?;
    let markers = setting.scene["outputs"].as_array().into_iter().flatten();
    let place = |marker: &Value| -> Result<Vec<[f64; 2]>> {
        let name = marker["marker"].as_str().context("expected a marker")?;
        let [x, y] = [1, 2].map(|axis| table.column(&format!("{name}.position[{axis}]")));
        Ok(x?.into_iter().zip(y?).map(|(x, y)| [x, y]).collect())
    };
    markers.map(place).collect()
}

fn cpu_time(path: &Path) -> Result<f64> {
    let text = std::fs::read_to_string(path)?;
    let report: Value = serde_json::from_str(&text)?;
    let time = report["cpu_time"].as_f64();
    time.with_context(|| format!("{}: expected a CPU time", shown(path)))
}
