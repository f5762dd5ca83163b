//! `studies statics`: what the equilibrium of a scene in space costs in the product, and where markers are in it.

use std::path::PathBuf;

use cpu_time::ThreadTime;
use flexbody::scene::assemble;
use flexbody::system::{Evaluation, Workspace, equilibrium};
use serde_json::{Map, Value, json};

use crate::scene::{Outcome, read};

/// Finds the static equilibrium of a scene in space once, without set-up in its time; prints JSON: CPU time (s) and places of all markers (m).
#[derive(clap::Args)]
pub struct Statics {
    /// Scene file. Its bodies and loads are taken, whatever its initial state is.
    scene: PathBuf,
}

/// Finds an equilibrium.
pub fn statics(arguments: &Statics) -> Outcome<()> {
    let scene = read(&arguments.scene, &[])?;
    let assembled = assemble::<3>(&scene).map_err(|error| error.to_string())?;
    let resolved = scene.resolved();
    let inputs = resolved.inputs.iter();
    let inputs: Vec<f64> = inputs.flat_map(|input| input.start.clone()).collect();
    let system = &assembled.system;
    let mut work = Workspace::new(system);
    let described = (&assembled.nodes[..], &assembled.rates[..]);
    let state = system.initial_state(0.0, &inputs, described, &mut work);
    let mut state = state.map_err(|error| format!("joints do not fit: {:?}", error.gaps))?;
    let started = ThreadTime::now();
    let found = equilibrium::find(
        system,
        &inputs,
        &mut work,
        &mut state,
        (None, f64::INFINITY),
    );
    let spent = started.elapsed();
    found.map_err(|error| error.to_string())?;
    let mut values = Evaluation::new(system);
    values.kinematics(system, &state, &mut work);
    let mut places = Map::new();
    for marker in &resolved.markers {
        let place = assembled.marker(marker.id).position(&values.x);
        let name = format!("{}.{}", marker.place.body().name(), marker.name);
        places.insert(name, json!([place.x, place.y, place.z]));
    }
    let report = json!({
        "coordinates": system.coordinates(),
        "cpu_time": spent.as_secs_f64(),
        "places": Value::Object(places),
    });
    println!("{report}");
    Ok(())
}
