//! What the numbers were measured on, a row a chart in `docs/charts/machine.csv`.

use anyhow::{Context, Result};

use crate::cargo::release;

use super::bench::Bench;
use super::csv::Csv;

const FILE: &str = "machine";

/// Notes the machine of a chart that was just measured.
///
/// # Errors
/// The file cannot be read or written.
pub fn note(bench: &Bench, chart: &str) -> Result<()> {
    let before = std::fs::read_to_string(bench.output(&format!("{FILE}.csv"))).unwrap_or_default();
    let mut csv = Csv::new(bench, FILE, "chart,machine");
    for line in before.lines().skip(1) {
        let (name, machine) = line
            .split_once(',')
            .context("machine.csv: expected two columns")?;
        if name != chart {
            csv.row(&[&name, &machine.trim_matches('"')]);
        }
    }
    csv.row(&[&chart, &describe()]);
    csv.save()
}

/// Processor, system, compiler and build flags in one sentence.
fn describe() -> String {
    let (system, processor) = (std::env::consts::OS, std::env::consts::ARCH);
    let model = processor_model().unwrap_or_else(|| "unknown processor".into());
    let compiler = release().unwrap_or_else(|_| "of unknown version".into());
    let flags = match std::env::var("RUSTFLAGS") {
        Ok(flags) if !flags.trim().is_empty() => format!("RUSTFLAGS {}", flags.trim()),
        _ => format!("baseline {processor}, no RUSTFLAGS"),
    };
    format!(
        "{model} ({system}, {processor}), one thread, rustc {compiler}, release profile \
         (opt-level 3, one codegen unit), {flags}{}",
        load().unwrap_or_default()
    )
}

/// How busy the machine is with this and everything else, where it tells.
fn load() -> Option<String> {
    let text = std::fs::read_to_string("/proc/loadavg").ok()?;
    let load = text.split_whitespace().next()?;
    let processors = std::thread::available_parallelism().ok()?;
    Some(format!("; load average {load} on {processors} processors"))
}

/// Only Linux tells without a library.
fn processor_model() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let field = |name: &str| {
        let line = text.lines().find(|line| line.starts_with(name))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let (name, numbers) = (
        field("model name")?,
        field("cpu family").zip(field("model\t")),
    );
    Some(match numbers {
        Some((family, model)) => format!("{name}, family {family} model {model}"),
        None => name,
    })
}
