//! `studies statics`: what the equilibrium of a scene in space costs in the product, and where markers are in it.

use std::path::PathBuf;

use cpu_time::ThreadTime;
use flexbody::system::Evaluation;
use serde_json::{Map, Value, json};

use crate::scene::{Outcome, Start, read};

/// Finds the static equilibrium of a scene in space once, without set-up in its time; prints JSON: CPU time (s) and places of all markers (m).
#[derive(clap::Args)]
pub struct Statics {
    /// Scene file. Its bodies and loads are taken, whatever its initial state is.
    scene: PathBuf,
}

/// Finds an equilibrium.
pub fn statics(arguments: &Statics) -> Outcome<()> {
    let mut start = Start::<3>::described(read(&arguments.scene, &[])?)?;
    let started = ThreadTime::now();
    let settled = start.settle();
    let spent = started.elapsed();
    settled?;
    let (assembled, resolved) = (&start.assembled, start.scene.resolved());
    let system = &assembled.system;
    let mut values = Evaluation::new(system);
    values.kinematics(system, &start.state, &mut start.work);
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
