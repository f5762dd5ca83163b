//! Examples of the book: each runs as it is printed, without a warning, and its variables are those of the book's table.

use std::fs;
use std::path::{Path, PathBuf};

use flexbody::scene::Scene;
use flexbody::simulation::{RedundantNames, Simulation};

/// Communication steps of one example at most: examples are short.
const STEPS: u32 = 400;
/// Parts of the names in the book's table that stand for a name of a scene.
const NAMES: [&str; 9] = [
    "body", "marker", "gauge", "joint", "gear", "latch", "motion", "load", "port",
];

/// A file or folder of the book.
fn book(inside: &str) -> PathBuf {
    crate::root().join("docs/book").join(inside)
}

/// Files of all examples, sorted.
fn examples() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![book("examples")];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of examples") {
            let path = entry.expect("a file").path();
            let is_scene = path.extension().is_some_and(|ending| ending == "json");
            if path.is_dir() {
                open.push(path);
            } else if is_scene {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// An example, with what it leaves to the planner.
fn planned(path: &Path) -> Result<Scene, String> {
    let text = fs::read_to_string(path).map_err(|error| error.to_string())?;
    crate::planned_beside(&text, path.parent().expect("a folder"))
}

/// Complains of real variables without a finite value.
fn check_finite(simulation: &mut Simulation) -> Result<(), String> {
    for index in 0..simulation.variables().len() {
        let variable = &simulation.variables()[index];
        if variable.is_integer() {
            continue;
        }
        let name = variable.name.clone();
        let value = simulation.real(index).map_err(|error| error.to_string())?;
        if !value.is_finite() {
            return Err(format!("{name}: {value}"));
        }
    }
    Ok(())
}

/// Runs the experiment of an example.
fn run(path: &Path) -> Result<(), String> {
    let scene = planned(path)?;
    let (stop, step) = (scene.experiment.stop_time, scene.experiment.step);
    let mut simulation = Simulation::new(scene);
    let begun = simulation.initialize(0.0);
    begun.map_err(|error| error.to_string())?;
    check_finite(&mut simulation)?;
    let mut number = 0;
    while simulation.time() < stop {
        number += 1;
        if number > STEPS {
            return Err(format!("expected at most {STEPS} communication steps"));
        }
        let until = (f64::from(number) * step).min(stop);
        let stepped = simulation.step(until);
        stepped.map_err(|failure| format!("{} s: {}", failure.time, failure.reason))?;
        check_finite(&mut simulation)?;
    }
    let redundant = simulation.redundant();
    if redundant != RedundantNames::default() {
        return Err(format!("holds what others hold already: {redundant:?}"));
    }
    let mut warnings = Vec::new();
    simulation.tell_warnings(|warning| warnings.push(warning.to_string()));
    if warnings.is_empty() {
        Ok(())
    } else {
        Err(warnings.join("; "))
    }
}

#[test]
fn every_example_of_the_book_runs() {
    let paths = examples();
    assert!(paths.len() > 80, "found {} examples", paths.len());
    let mut complaints = Vec::new();
    for path in &paths {
        if let Err(complaint) = run(path) {
            complaints.push(format!("{}: {complaint}", path.display()));
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// Names of variables in the first column of the book's table.
fn patterns() -> Vec<String> {
    let page = fs::read_to_string(book("src/variables.md")).expect("the page of variables");
    let rows = page.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.map(|line| line.split('|').nth(1).unwrap_or_default());
    let named = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2));
    named.map(str::to_owned).collect()
}

/// Whether a name is one of those that a pattern such as `body.marker.position[i]` stands for.
fn is_named(pattern: &str, name: &str) -> bool {
    let [wanted, found] = [pattern, name].map(|text| text.split('.').collect::<Vec<_>>());
    let is_part = |(wanted, found): (&&str, &&str)| {
        if NAMES.contains(wanted) {
            return true;
        }
        if let Some(first) = wanted.strip_suffix("[i]") {
            let place = found.strip_prefix(first);
            let place = place.and_then(|rest| rest.strip_prefix('['));
            let place = place.and_then(|rest| rest.strip_suffix(']'));
            return match place {
                Some(number) => number.parse::<u32>().is_ok(),
                // A marker at the end of a part: `deflection_from_marker[i]`.
                None => first.strip_suffix("marker").is_some_and(|before| {
                    !before.is_empty() && found.starts_with(before) && found.ends_with(']')
                }),
            };
        }
        wanted == found
    };
    wanted.len() == found.len() && wanted.iter().zip(&found).all(is_part)
}

#[test]
fn every_variable_of_an_example_is_in_the_table_of_the_book() {
    let patterns = patterns();
    assert!(patterns.len() > 60, "found {} names", patterns.len());
    let mut missing = Vec::new();
    for path in examples() {
        let scene = planned(&path).expect("an example that can be planned");
        for variable in Simulation::new(scene).variables() {
            let name = &variable.name;
            if !patterns.iter().any(|pattern| is_named(pattern, name)) {
                missing.push(format!("{}: {name}", path.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
