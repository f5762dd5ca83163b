//! `flexbody plan`, and what is done with scenes that leave numbers to the planner.

use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Result, bail};
use flexbody::scene::{Chosen, Scene, remarks};
use flexbody::simulation::{
    self, Budget, Damped, FirstFrequencies, Plan, Planned, Settles, TrialConditions,
};
use fmu_package::Progress;

use crate::inputs::{Inputs, signals};
use crate::reading::{at, read};
use crate::settings::assignments;

/// Limits of planning, and the treatment of a plan that misses the wanted error.
#[derive(Clone, clap::Args)]
pub struct Within {
    /// Most time that planning may take, s; what is best so far is taken then, and told.
    #[arg(long, value_name = "SECONDS", default_value_t = Budget::default().seconds, value_parser = seconds)]
    pub budget: f64,
    /// Fails where the plan does not keep the error wanted of an output, which is told otherwise.
    #[arg(long)]
    pub strict: bool,
}

impl Within {
    /// Refuses a plan that does not keep the error wanted, where that is asked for.
    fn check(&self, plan: &Plan) -> Result<()> {
        if self.strict && !plan.missed().is_empty() {
            bail!("--strict: the plan does not keep the error wanted");
        }
        Ok(())
    }
}

/// A positive number of seconds.
fn seconds(text: &str) -> Result<f64, String> {
    let expected = || format!("expected a positive number of seconds, found \"{text}\"");
    let seconds: f64 = text.parse().map_err(|_| expected())?;
    if seconds > 0.0 && seconds <= 1e6 {
        Ok(seconds)
    } else {
        Err(expected())
    }
}

/// Number of natural frequencies that are printed beside a plan.
const FREQUENCIES: usize = 5;
/// Distance of the start from equilibrium, in sizes of the scene, from which on it is told beside natural frequencies.
const REST: f64 = 0.01;

/// Which scene, and where to write.
#[derive(clap::Args)]
pub struct Planning {
    #[command(flatten)]
    within: Within,
    /// Scene file.
    scene: PathBuf,
    /// Writes the scene with these numbers to a file.
    #[arg(long)]
    output: Option<PathBuf>,
    /// JSON file for the plan: elements and fewest elements of bodies, meshes of plates and shells, tolerance, errors of outputs, runs.
    #[arg(long)]
    report: Option<PathBuf>,
    /// CSV file for what inputs do by `accuracy.input_profiles`, which `simulate --input` reads; not written where none moves.
    #[arg(long)]
    courses: Option<PathBuf>,
    /// Inputs in place of `accuracy.input_profiles`.
    #[command(flatten)]
    inputs: Inputs,
    /// Value of a parameter or input that is planned for, e.g. `rod.density=7800`; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

/// Reads a scene, and plans the elements and numbers that it leaves to the planner.
///
/// # Errors
/// A scene that is not valid or cannot be run, or a plan that `--strict` refuses.
pub fn planned(path: &Path, within: &Within) -> Result<(Scene, Planned)> {
    planned_for(path, &read(path)?, &TrialConditions::default(), within)
}

/// Plans a scene that was read from `path`, for given parameters and inputs, if it leaves something to the planner.
///
/// # Errors
/// A name or value that the scene does not have, a scene that cannot be run, or a plan that `--strict` refuses.
pub fn planned_for(
    path: &Path,
    scene: &Scene,
    given: &TrialConditions,
    within: &Within,
) -> Result<(Scene, Planned)> {
    let found = planned_quietly(path, scene, given, within)?;
    let Some(plan) = &found.1.numbers else {
        return Ok(found);
    };
    eprintln!("flexbody: {}", plan.in_a_line());
    for sentence in plan.missed() {
        eprintln!("flexbody: {sentence}");
    }
    within.check(plan)?;
    Ok(found)
}

/// Plans a scene without printing the plan. The caller reports it.
fn planned_quietly(
    path: &Path,
    scene: &Scene,
    given: &TrialConditions,
    within: &Within,
) -> Result<(Scene, Planned)> {
    tell_remarks(scene);
    let started = Instant::now();
    let budget = Budget {
        seconds: within.budget,
        is_over: &|| started.elapsed().as_secs_f64() >= within.budget,
    };
    let doing = format!("planning (budget {} s)", within.budget);
    let bar = Progress::spinner("planning {spinner} {msg}", &doing);
    let found = simulation::plan_for(scene, given, &budget, &mut |run, elements, tolerance| {
        bar.set_message(format!(
            "run {run}: {elements} elements, tolerance {tolerance:e}"
        ));
    });
    drop(bar);
    found.map_err(|error| at(path, error))
}

/// Tells at once, on standard error, what is likely a slip of a unit.
fn tell_remarks(scene: &Scene) {
    for remark in remarks(scene) {
        eprintln!("flexbody: remark: {remark}");
    }
}

/// Plans a scene and prints the plan.
///
/// # Errors
/// A scene that is not valid or cannot be run, a plan that `--strict` refuses, or a file that cannot be written.
pub fn plan(arguments: &Planning) -> Result<()> {
    let path = &arguments.scene;
    let scene = read(path)?;
    let table = arguments.inputs.table()?;
    if let Some((table, path)) = &table {
        let variables = simulation::variables(&scene);
        signals(table, path, &variables, scene.experiment.stop_time)?;
    }
    let given = TrialConditions {
        set: assignments(&scene, &arguments.set)?,
        inputs: table.map(|(table, _)| table),
    };
    let courses = simulation::courses(&scene).map_err(|error| at(path, error))?;
    let (scene, planned) = planned_quietly(path, &scene, &given, &arguments.within)?;
    let Planned {
        elements,
        damping,
        numbers,
    } = &planned;
    let finding = Progress::spinner(
        "natural frequencies {spinner}",
        "finding natural frequencies",
    );
    let frequencies = simulation::first_frequencies(&scene, &given, FREQUENCIES);
    drop(finding);
    if let (Some(file), Some(plan)) = (&arguments.report, numbers) {
        fs::write(file, json(plan, &frequencies)).map_err(|error| at(file, error))?;
    }
    if let Some(file) = &arguments.courses {
        let written = courses.map_or(Ok(()), |table| fs::write(file, table.text));
        written.map_err(|error| at(file, error))?;
    }
    print!("{}{}", chosen_in_words(elements), damping_in_words(damping));
    match numbers {
        Some(plan) => {
            print!("{}", in_words(plan));
        }
        None if !elements.is_empty() || !damping.is_empty() => (),
        None => println!("nothing to plan: the scene gives numbers of elements and a tolerance"),
    }
    print!("\n{}", frequencies_in_words(&frequencies));
    if let Some(plan) = numbers {
        arguments.within.check(plan)?;
    }
    let Some(output) = &arguments.output else {
        return Ok(());
    };
    fs::write(output, scene.to_json()).map_err(|error| at(output, error))
}

/// The plan as a line of JSON, with natural frequencies or `null`. Names need no escapes.
fn json(plan: &Plan, frequencies: &Result<FirstFrequencies, String>) -> String {
    let frequencies = match frequencies {
        Ok(found) => format!("{:?}", found.frequencies),
        Err(_) => "null".into(),
    };
    let number = |value: Option<u32>| value.map_or("null".into(), |n| n.to_string());
    let bodies = plan.bodies.iter().map(|body| {
        let counts = [body.elements, body.fewest].map(number);
        let mesh = body.mesh.map_or("null".into(), |mesh| format!("{mesh:?}"));
        format!(
            "{{\"name\": \"{}\", \"elements\": {}, \"fewest\": {}, \"mesh\": {mesh}}}",
            body.name, counts[0], counts[1]
        )
    });
    let outputs = plan.outputs.iter().map(|output| {
        let settles = match output.settles {
            Settles::Yes => "true, \"until\": null".to_owned(),
            Settles::Until(time) => format!("false, \"until\": {time:?}"),
            Settles::No => "false, \"until\": 0.0".to_owned(),
        };
        let error = if output.error.is_finite() { format!("{:?}", output.error) } else { "null".into() };
        format!(
            "{{\"name\": \"{}\", \"error\": {error}, \"scale\": {:?}, \"skips_start\": {}, \"settles\": {settles}}}",
            output.name, output.scale, output.skips_start
        )
    });
    format!(
        "{{\"error\": {:?}, \"tolerance\": {:?}, \"method\": \"{}\", \"runs\": {}, \"runs_cost\": {:?}, \
         \"bodies\": [{}], \"outputs\": [{}], \"natural_frequencies\": {frequencies}}}\n",
        plan.error,
        plan.tolerance,
        plan.method,
        plan.runs,
        plan.runs_cost,
        bodies.collect::<Vec<_>>().join(", "),
        outputs.collect::<Vec<_>>().join(", ")
    )
}

/// Natural frequencies as a list of a terminal, or why there are none.
fn frequencies_in_words(found: &Result<FirstFrequencies, String>) -> String {
    let found = match found {
        Ok(found) if found.frequencies.is_empty() => {
            return "natural frequencies: none, nothing can move\n".into();
        }
        Ok(found) => found,
        Err(reason) => return format!("natural frequencies: none ({reason})\n"),
    };
    let rows = found.frequencies.iter().enumerate().map(|(index, rate)| {
        let hertz = if *rate < 0.0 {
            "unstable".into()
        } else {
            significant(rate / TAU)
        };
        [(index + 1).to_string(), significant(*rate), hertz]
    });
    let mut text = "natural frequencies about the start, at rest and without dampers\n".to_owned();
    text += &table(&["mode", "rad/s", "Hz"], rows.collect());
    if let Some(from_rest) = found.from_rest.filter(|distance| *distance > REST) {
        text += &format!(
            "  the start is no equilibrium: it is {from_rest:.1e} of the size of the scene away from rest\n"
        );
    }
    text
}

/// A number with five significant digits.
fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.4e}");
    }
    let decimals = (4.0 - value.abs().log10().floor()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

/// Elements that were chosen as a list of a terminal.
fn chosen_in_words(elements: &[Chosen]) -> String {
    if elements.is_empty() {
        return String::new();
    }
    let rows = elements.iter().map(|of| [of.name.clone(), of.in_words()]);
    format!(
        "elements chosen\n{}\n",
        table(&["body", "element and why"], rows.collect())
    )
}

/// Damping times that were made of ratios as a list of a terminal.
fn damping_in_words(damping: &[Damped]) -> String {
    if damping.is_empty() {
        return String::new();
    }
    let rows = damping.iter().map(|of| {
        let mode = format!(
            "{:.6} rad/s, {:.1} % strain of it",
            of.frequency,
            100.0 * of.share
        );
        [
            of.name.clone(),
            of.ratio.to_string(),
            mode,
            format!("{:e} s", of.time),
        ]
    });
    let heads = ["body", "damping ratio", "mode", "damping time"];
    format!("damping\n{}\n", table(&heads, rows.collect()))
}

/// The plan as tables of a terminal.
fn in_words(plan: &Plan) -> String {
    let mut text = format!("error wanted {:e}\n\nmodel\n", plan.error);
    let rows = plan.bodies.iter().map(|body| {
        [
            body.name.clone(),
            body.kind.to_owned(),
            body.count_in_words(),
            body.why.clone(),
        ]
    });
    text += &table(&["body", "kind", "elements", "why"], rows.collect());
    text += &format!(
        "time: relative tolerance {:e}, integrator {}\n",
        plan.tolerance, plan.method
    );
    if !plan.held.is_empty() {
        text += &format!(
            "inputs held at their start values: {}\n",
            plan.held.join(", ")
        );
    }
    if !plan.answers.is_empty() {
        let heads = [
            "linear answers and frequencies",
            "changed by twice the mesh",
        ];
        let rows = plan.answers.iter();
        let rows = rows.map(|(name, error)| [name.clone(), format!("{error:.1e}")]);
        text += &table(&heads, rows.collect());
    }
    text += "\nerrors estimated\n";
    let rows = plan.outputs.iter().map(|output| {
        let settles = match output.settles {
            Settles::Yes => String::new(),
            Settles::Until(time) => format!("kept until {time:.3} s"),
            Settles::No => "does not settle".into(),
        };
        [output.name.clone(), output.error_in_words(), settles]
    });
    text += &table(&["output", "error", ""], rows.collect());
    for sentence in plan.measured_otherwise() {
        text += &format!("  {sentence}\n");
    }
    for sentence in plan.bounds() {
        text += &format!("  {sentence}\n");
    }
    if let Some(cut) = plan.cut() {
        text += &format!("{cut}\n");
    }
    if let Some(settled) = &plan.settled {
        text += &format!("\nproposed\n  {}\n", settled.in_words());
    }
    text += "\ncost\n";
    let rows = plan.prices().map(|(name, price)| {
        [
            name.to_owned(),
            price.elements_in_words(),
            format!("about {:.2} ms a second", price.milliseconds()),
            price.error_in_words(),
        ]
    });
    text += &table(
        &["choice", "elements", "cost", "largest error"],
        rows.collect(),
    );
    text + &format!(
        "{} runs, which cost {:.1} times one with the choice\n",
        plan.runs, plan.runs_cost
    )
}

/// Columns of text, as wide as their widest cell.
fn table<const N: usize>(heads: &[&str; N], rows: Vec<[String; N]>) -> String {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0).max(heads[column].len())
    };
    let line = |cells: [&str; N]| {
        let cells = cells.iter().enumerate();
        let cells: Vec<String> = cells
            .map(|(i, cell)| format!("{cell:<0$}", width(i)))
            .collect();
        format!("  {}\n", cells.join("  ").trim_end())
    };
    let mut text = line(*heads);
    for row in &rows {
        text += &line(std::array::from_fn(|i| row[i].as_str()));
    }
    text
}
