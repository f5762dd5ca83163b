//! `studies dynamics`: what one acceleration of a scene costs in the product.

use std::hint::black_box;
use std::path::PathBuf;

use flexbody::scene::assemble;
use flexbody::system::{DrivenSystem, Dynamics as _, Workspace};
use serde_json::json;

use crate::accelerate::median;
use crate::scene::{Outcome, read};

/// Times accelerations of a scene in space as it is described; prints JSON.
#[derive(clap::Args)]
pub struct Dynamics {
    /// Scene file.
    scene: PathBuf,
    /// Number of batches; times are medians.
    #[arg(long, default_value_t = 9)]
    repeat: usize,
}

/// Times accelerations.
pub fn dynamics(arguments: &Dynamics) -> Outcome<()> {
    let scene = read(&arguments.scene, &[])?;
    let assembled = assemble::<3>(&scene).map_err(|error| error.to_string())?;
    let system = &assembled.system;
    let mut work = Workspace::new(system);
    let state = system.blank_state(0.0);
    let mut model = DrivenSystem::new(system, &[], &mut work, &state);
    let mut a = vec![0.0; system.coordinates()];
    let time = median(arguments.repeat, || {
        model.acceleration(0.0, black_box(&state.coordinates), &state.rates, &mut a);
        black_box(&mut a);
    });
    println!(
        "{}",
        json!({ "coordinates": a.len(), "acceleration": time })
    );
    Ok(())
}
