//! Cases and their claims: reading them strictly, checking them in parallel, reporting.

mod checks;
mod claim;
mod records;
mod run;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

use serde::Deserialize;

use checks::Place;
use claim::Claim;
use records::Demand;

pub use run::{Method, Step};

/// A case as read.
pub struct Case {
    name: String,
    folder: PathBuf,
    scene: String,
    claims: Vec<Result<Claim, String>>,
}

/// Verdict on a claim.
pub struct Verdict {
    place: String,
    kind: &'static str,
    outcome: Result<Measured, String>,
    seconds: f64,
}

/// Measured quantity of a claim, its error and the allowed one, in its own unit.
pub struct Measured {
    /// Name of the measured quantity.
    pub what: String,
    /// The error found.
    pub found: f64,
    /// The largest or smallest that is allowed, with its relation.
    pub allowed: String,
    /// Reason why the claim fails, if it does.
    pub failure: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    #[serde(default)]
    purpose: String,
    #[serde(default)]
    source: String,
    #[serde(default = "default_scene")]
    scene: String,
    #[serde(default)]
    claims: Vec<serde_json::Map<String, serde_json::Value>>,
}

fn default_scene() -> String {
    "scene.json".into()
}

impl Case {
    /// Reads the text of a `case.json`. A bad claim does not hide the others.
    ///
    /// # Errors
    /// A file that is not JSON or lacks a key, in words.
    pub fn parse(name: &str, folder: &Path, text: &str) -> Result<Self, String> {
        let text: Text =
            serde_json::from_str(text).map_err(|error| format!("{name}/case.json: {error}"))?;
        for (key, value) in [("purpose", &text.purpose), ("source", &text.source)] {
            if value.trim().is_empty() {
                return Err(format!("{name}: {key}: expected a sentence, found nothing"));
            }
        }
        if text.claims.is_empty() {
            return Err(format!("{name}: claims: expected at least one, found none"));
        }
        Ok(Self {
            name: name.into(),
            folder: folder.into(),
            scene: text.scene,
            claims: text.claims.into_iter().map(Claim::parse).collect(),
        })
    }
}

/// Finds all cases in a folder with `filter` in their name, in order.
///
/// # Errors
/// A folder that cannot be read, in words.
pub fn find(root: &Path, filter: &str) -> Result<Vec<Case>, String> {
    let at = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    let mut folders = Vec::new();
    for entry in fs::read_dir(root).map_err(|error| at(root, error))? {
        let folder = entry.map_err(|error| at(root, error))?.path();
        if folder.is_dir() {
            folders.push(folder);
        }
    }
    folders.sort();
    let mut cases = Vec::new();
    for folder in folders {
        let name = folder
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if name.contains(filter) {
            // A folder without its case.json would be a case that nobody checks.
            let path = folder.join("case.json");
            let text = fs::read_to_string(&path).map_err(|error| at(&path, error))?;
            cases.push(Case::parse(&name, &folder, &text)?);
        }
    }
    Ok(cases)
}

/// Claims of a case that one run decides, or one that takes runs of its own.
struct Job<'a> {
    case: &'a Case,
    scene: PathBuf,
    claims: Vec<usize>,
    demand: Option<Demand<'a>>,
}

/// Checks all claims on all cores, in the order of the cases.
pub fn check_all(cases: &[Case], method: &Method) -> Vec<Verdict> {
    let jobs: Vec<Job> = cases.iter().flat_map(jobs).collect();
    let next = AtomicUsize::new(0);
    let verdicts = Mutex::new(Vec::new());
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads.min(jobs.len()) {
            scope.spawn(|| {
                while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let found = check(job, method);
                    let mut verdicts = verdicts.lock().expect("no panic while locked");
                    verdicts.extend(found);
                }
            });
        }
    });
    let mut verdicts = verdicts.into_inner().expect("no panic while locked");
    verdicts.sort_by_key(|(a, _)| *a);
    verdicts.into_iter().map(|(_, verdict)| verdict).collect()
}

/// The claims of a case, those together that one run decides.
fn jobs(case: &Case) -> Vec<Job<'_>> {
    let mut jobs: Vec<Job> = Vec::new();
    for (index, claim) in case.claims.iter().enumerate() {
        let of = |claim: &Claim| {
            case.folder
                .join(claim.scene.as_ref().unwrap_or(&case.scene))
        };
        let scene = claim.as_ref().map_or_else(|_| PathBuf::new(), of);
        let demand = claim.as_ref().ok().and_then(Demand::of);
        let given = |index: usize| case.claims[index].as_ref().map(|claim| &claim.values).ok();
        let same = |job: &&mut Job| {
            let runs = job.demand.as_ref().zip(demand.as_ref());
            job.scene == scene
                && given(job.claims[0]) == given(index)
                && runs.is_some_and(|(one, other)| one.shares(other))
        };
        match (jobs.iter_mut().find(same), demand) {
            (Some(job), Some(demand)) => {
                job.claims.push(index);
                if let Some(run) = &mut job.demand {
                    run.join(demand);
                }
            }
            (_, demand) => jobs.push(Job {
                case,
                scene,
                claims: vec![index],
                demand,
            }),
        }
    }
    jobs
}

/// Verdicts on the claims of a job, each with the name of the case and its number to sort by. The time
/// of a run counts for the first claim that it decides.
fn check<'a>(job: &Job<'a>, method: &Method) -> Vec<((&'a str, usize), Verdict)> {
    let mut started = Instant::now();
    let case = job.case;
    let run = match (&job.demand, &case.claims[job.claims[0]]) {
        (Some(demand), Ok(claim)) => demand.record(&job.scene, &claim.values, method).map(Some),
        _ => Ok(None),
    };
    let at = Place {
        folder: &case.folder,
        scene: &job.scene,
        method,
    };
    let mut verdicts = Vec::new();
    for &index in &job.claims {
        let outcome = match (&case.claims[index], &run) {
            (Ok(claim), Ok(run)) => checks::check(claim, &at, run.as_ref()),
            (Err(message), _) | (_, Err(message)) => Err(message.clone()),
        };
        let kind = case.claims[index]
            .as_ref()
            .map_or("?", |claim| claim.kind.name());
        let verdict = Verdict {
            place: format!("{}[{index}]", case.name),
            kind,
            outcome,
            seconds: started.elapsed().as_secs_f64(),
        };
        verdicts.push(((case.name.as_str(), index), verdict));
        started = Instant::now();
    }
    verdicts
}

impl Verdict {
    /// Why the claim fails, if it does.
    pub fn failure(&self) -> Option<String> {
        let message = match &self.outcome {
            Ok(measured) => measured.failure.as_ref()?,
            Err(message) => message,
        };
        Some(format!("{} {}: {message}", self.place, self.kind))
    }
}

/// A table of all verdicts.
pub fn table(verdicts: &[Verdict]) -> String {
    let mut rows = vec![["claim", "kind", "of", "found", "allowed", "", "s"].map(String::from)];
    for verdict in verdicts {
        let (what, found, allowed) = match &verdict.outcome {
            Ok(m) => (
                m.what.clone(),
                format!("{:.3e}", m.found),
                m.allowed.clone(),
            ),
            Err(_) => (String::new(), String::new(), String::new()),
        };
        let holds = if verdict.failure().is_none() {
            "holds"
        } else {
            "FAILS"
        };
        rows.push([
            verdict.place.clone(),
            verdict.kind.into(),
            what,
            found,
            allowed,
            holds.into(),
            format!("{:.2}", verdict.seconds),
        ]);
    }
    let widths: [usize; 7] = std::array::from_fn(|column| {
        let lengths = rows.iter().map(|row| row[column].chars().count());
        lengths.max().unwrap_or(0)
    });
    let line = |row: &[String; 7]| {
        let cells = row.iter().zip(widths);
        let cells: Vec<String> = cells
            .map(|(cell, width)| format!("{cell:width$}"))
            .collect();
        cells.join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}
