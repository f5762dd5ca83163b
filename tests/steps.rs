//! Communication steps of any length: what was planned holds for any sequence of them, and one that is next to nothing changes next to
//! nothing, on every ready scene.

use std::fs;

use flexbody::scene::{Scene, beside};
use flexbody::simulation::{Simulation, Variable};

/// Elements of the cables whose number is left to the planner.
const ELEMENTS: u32 = 4;
/// Steps of the default experiment that a run takes at most.
const STEPS: u32 = 30;
/// Tolerance of the runs, as loose as plans have it, and of those that they are compared with.
const TOLERANCE: f64 = 1e-2;
const CLOSE: f64 = 1e-7;
/// How many times the error with even steps the error with uneven ones may be, and what is no error: a tenth of what is wanted.
const LIMIT: f64 = 3.0;
const LEAST: f64 = 1e-4;
/// A communication step that is next to nothing, s.
const NOTHING: f64 = 1e-12;

/// Values of outputs at one time, one list a vector.
type Row = Vec<Vec<f64>>;

/// The ready scenes, with a mesh that costs little and a tolerance, as if they were planned for their step.
fn scenes(tolerance: f64) -> Vec<Scene> {
    let scenes = crate::ready_scenes().into_iter().map(|path| {
        let text = fs::read_to_string(&path).expect("a text");
        let files = beside(path.parent().expect("a folder"));
        let mut scene = Scene::from_json_with(&text, &files).expect("a scene");
        let cables = scene.bodies.iter_mut().filter_map(|body| body.cable_mut());
        for cable in cables.filter(|cable| cable.elements.is_none()) {
            cable.elements = Some(ELEMENTS);
        }
        scene.accuracy = Default::default();
        scene.accuracy.error = Some(1e-3);
        scene.accuracy.relative_tolerance = Some(tolerance);
        scene
    });
    scenes.collect()
}

fn started(scene: &Scene) -> Simulation {
    let mut simulation = Simulation::new(scene.clone());
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    simulation
}

/// What is computed, the components of a vector together.
fn groups(simulation: &Simulation) -> Vec<(String, Vec<usize>)> {
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    let is_computed = |v: &Variable| v.start.is_none() && v.name != "time";
    for (index, variable) in simulation.variables().iter().enumerate() {
        if !is_computed(variable) {
            continue;
        }
        let name = variable.name.split('[').next().unwrap_or_default();
        match groups.iter_mut().find(|(group, _)| group == name) {
            Some((_, members)) => members.push(index),
            None => groups.push((name.to_owned(), vec![index])),
        }
    }
    groups
}

fn read(simulation: &mut Simulation, groups: &[(String, Vec<usize>)]) -> Row {
    let mut value = |index: &usize| simulation.real(*index).expect("a number");
    let of = |(_, members): &(String, Vec<usize>)| members.iter().map(&mut value).collect();
    groups.iter().map(of).collect()
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let squares = one.iter().zip(other).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// The largest size of every group over a run.
fn scales(rows: &[Row]) -> Vec<f64> {
    let size = |values: &[f64]| distance(values, &vec![0.0; values.len()]);
    let largest = |group: usize| rows.iter().map(|row| size(&row[group])).fold(0.0, f64::max);
    (0..rows[0].len()).map(largest).collect()
}

/// The default experiment, every step of it in these parts: outputs after every step, and what was used there.
fn run(scene: &Scene, parts: &[f64]) -> (Vec<Row>, Vec<&'static str>) {
    let mut simulation = started(scene);
    let (groups, step) = (groups(&simulation), scene.experiment.step);
    let (mut rows, mut methods) = (Vec::new(), Vec::new());
    for number in 0..STEPS.min(scene.experiment.steps() as u32) {
        for part in parts {
            let until = (f64::from(number) + part) * step;
            simulation.step(until).expect("a step");
        }
        methods.push(simulation.report().method);
        rows.push(read(&mut simulation, &groups));
    }
    (rows, methods)
}

/// The largest error of a group of outputs in its scale.
fn error(rows: &[Row], right: &[Row], (group, scale): (usize, f64)) -> f64 {
    let pairs = rows.iter().zip(right);
    let errors = pairs.map(|(row, right)| distance(&row[group], &right[group]) / scale);
    errors.fold(0.0, f64::max)
}

/// Positions are what a tolerance is of: `auto` takes the same methods, and errors stay those of even steps.
#[test]
fn uneven_steps_keep_the_error_of_even_ones() {
    let mut off = Vec::new();
    for (scene, close) in scenes(TOLERANCE).into_iter().zip(scenes(CLOSE)) {
        let (right, _) = run(&close, &[1.0]);
        let (even, methods) = run(&scene, &[1.0]);
        let (groups, scales) = (groups(&started(&scene)), scales(&right));
        for parts in [&[0.5, 0.75, 1.0][..], &[0.3, 1.0], &[1e-3, 0.4, 1.0]] {
            let (uneven, others) = run(&scene, parts);
            for (group, (name, _)) in groups.iter().enumerate() {
                let of = (group, scales[group]);
                if !name.ends_with("position") || name.starts_with("residual") || of.1 == 0.0 {
                    continue;
                }
                let [wanted, found] = [&even, &uneven].map(|rows| error(rows, &right, of));
                let ends = [methods.last(), others.last()];
                println!(
                    "{} {name} {parts:?}: {found:.1e} for {wanted:.1e} {ends:?}",
                    scene.name
                );
                if found > (LIMIT * wanted).max(LEAST) {
                    off.push(format!(
                        "{} {name} {parts:?}: {found:.1e} for {wanted:.1e}",
                        scene.name
                    ));
                }
            }
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}

/// Between points a step of next to nothing is taken: outputs change by what their rates say, and by roundoff.
#[test]
fn a_step_of_next_to_nothing_changes_next_to_nothing() {
    let mut off = Vec::new();
    for scene in scenes(TOLERANCE) {
        let (rows, _) = run(&scene, &[1.0]);
        let scales = scales(&rows);
        let mut simulation = started(&scene);
        let groups = groups(&simulation);
        for number in 0..rows.len() as u32 {
            let before = read(&mut simulation, &groups);
            simulation
                .step(simulation.time() + NOTHING)
                .expect("a step");
            let after = read(&mut simulation, &groups);
            simulation
                .step(f64::from(number + 1) * scene.experiment.step)
                .expect("a step");
            for (group, (name, _)) in groups.iter().enumerate() {
                let jump = distance(&before[group], &after[group]);
                if scales[group] > 1e-9 && jump > 1e-5 * scales[group] {
                    let part = jump / scales[group];
                    let method = simulation.report().method;
                    off.push(format!(
                        "{} {name} by {part:.1e} at {number} {method}",
                        scene.name
                    ));
                }
            }
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}
