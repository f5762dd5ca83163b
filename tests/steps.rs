//! Communication steps of any length: what a run gives depends on them by no more than the tolerance, on every ready scene.

use std::fs;
use std::path::PathBuf;

use flexbody::scene::Scene;
use flexbody::simulation::{Simulation, Variable};

/// Elements of the cables whose number is left to the planner.
const ELEMENTS: u32 = 4;
/// Communication steps of a run, at most.
const STEPS: u32 = 50;
/// Tolerance of the runs.
const TOLERANCE: f64 = 1e-4;

/// The ready scenes by name, with a mesh that costs little and a tolerance.
fn scenes(tolerance: f64) -> Vec<(String, Scene)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = fs::read_dir(folder).expect("ready scenes");
    let mut files: Vec<PathBuf> = files.map(|entry| entry.expect("a file").path()).collect();
    files.retain(|path| !path.to_string_lossy().ends_with(".schema.json"));
    files.sort();
    let scenes = files.into_iter().map(|path| {
        let text = fs::read_to_string(&path).expect("a text");
        let mut scene = Scene::from_json(&text).expect("a scene");
        let cables = scene.bodies.iter_mut().filter_map(|body| body.cable_mut());
        for cable in cables.filter(|cable| cable.elements.is_none()) {
            cable.elements = Some(ELEMENTS);
        }
        scene.accuracy = Default::default();
        scene.accuracy.relative_tolerance = Some(tolerance);
        (scene.name.clone(), scene)
    });
    scenes.collect()
}

fn started(scene: &Scene) -> Simulation {
    let mut simulation = Simulation::new(scene.clone());
    simulation.initialize(0.0).expect("a start");
    simulation.start().expect("a start");
    simulation
}

/// Indices of what is computed, the components of a vector together.
fn groups(simulation: &Simulation) -> Vec<(String, Vec<usize>)> {
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    let computed = |v: &&Variable| v.start.is_none() && v.name != "time";
    for (index, variable) in simulation.variables().iter().enumerate() {
        if !computed(&variable) {
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

/// All outputs, a vector a group.
fn read(simulation: &mut Simulation, groups: &[(String, Vec<usize>)]) -> Vec<Vec<f64>> {
    let mut value = |index: &usize| simulation.real(*index).expect("a number");
    let of = |(_, members): &(String, Vec<usize>)| members.iter().map(&mut value).collect();
    groups.iter().map(of).collect()
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let squares = one.iter().zip(other).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

type Rows = Vec<Vec<Vec<f64>>>;

fn run(scene: &Scene, parts: &[f64]) -> (Rows, Vec<&'static str>, f64) {
    let mut simulation = started(scene);
    let groups = groups(&simulation);
    let step = scene.experiment.step;
    let (mut rows, mut methods, mut work) = (Vec::new(), Vec::new(), 0.0);
    for number in 0..STEPS.min(scene.experiment.steps() as u32) {
        let start = f64::from(number) * step;
        for part in parts {
            simulation.step(start + part * step).expect("a step");
            work += simulation.report().work;
        }
        methods.push(simulation.report().method);
        rows.push(read(&mut simulation, &groups));
    }
    (rows, methods, work)
}

fn scales(rows: &Rows) -> Vec<f64> {
    let zero = |values: &Vec<f64>| vec![0.0; values.len()];
    (0..rows[0].len())
        .map(|g| {
            rows.iter()
                .map(|row| distance(&row[g], &zero(&row[g])))
                .fold(0.0, f64::max)
        })
        .collect()
}

#[test]
fn measured() {
    let only = std::env::var("ONLY").unwrap_or_default();
    let tolerance: f64 = std::env::var("TOL")
        .ok()
        .and_then(|t| t.parse().ok())
        .unwrap_or(TOLERANCE);
    for ((name, scene), (_, close)) in scenes(tolerance).into_iter().zip(scenes(tolerance * 1e-3)) {
        if !name.contains(&only) {
            continue;
        }
        let (truth, _, _) = run(&close, &[1.0]);
        let scales = scales(&truth);
        let groups = groups(&started(&scene));
        let error = |rows: &Rows| {
            let mut worst = (0.0, 0);
            for (row, right) in rows.iter().zip(&truth) {
                for g in 0..row.len() {
                    let off = distance(&row[g], &right[g]) / scales[g].max(1e-300);
                    if off > worst.0 && groups[g].0.contains("position") {
                        worst = (off, g);
                    }
                }
            }
            worst
        };
        let mut line = format!("{name:20}");
        for parts in [&[1.0][..], &[0.5, 0.75, 1.0], &[0.3, 1.0], &[1e-3, 1.0]] {
            let (rows, methods, work) = run(&scene, parts);
            let (off, g) = error(&rows);
            let radau = methods.iter().filter(|m| **m == "radau").count();
            line += &format!(
                " | {off:.1e} {:20} radau {radau:2} last {:8} {work:.1e}",
                groups[g].0,
                methods.last().unwrap()
            );
        }
        println!("{line}");
        // Jumps.
        let mut simulation = started(&scene);
        let mut worst = (0.0, 0, 0, "");
        let step = scene.experiment.step;
        for number in 0..STEPS.min(scene.experiment.steps() as u32) {
            let before = read(&mut simulation, &groups);
            let start = simulation.time();
            simulation.step(start + 1e-12).expect("a step");
            let after = read(&mut simulation, &groups);
            for g in 0..before.len() {
                let off = distance(&before[g], &after[g]) / scales[g].max(1e-300);
                if off > worst.0 {
                    worst = (off, g, number, simulation.report().method);
                }
            }
            simulation
                .step(f64::from(number + 1) * step)
                .expect("a step");
        }
        println!(
            "      jump {:.1e} {} at {} {}",
            worst.0, groups[worst.1].0, worst.2, worst.3
        );
    }
}
