//! The product on the same scenes: its own integrator at a tolerance, and its cables under generalized-alpha.

use std::time::Duration;

use cpu_time::ThreadTime;
use serde_json::json;

use super::Vector;
use super::scenes::Played;
use crate::failures::support::{After, March, Product, Reader, named, start};
use crate::scene::Outcome;

/// Positions of the markers at every time, m.
pub type Path = Vec<Vec<Vector>>;

fn scene(played: Played, elements: usize, tolerance: f64) -> serde_json::Value {
    let mut scene = played.json();
    scene["bodies"][played.rod_index()]["elements"] = json!(elements);
    scene["accuracy"] = json!({"relative_tolerance": tolerance});
    scene
}

/// As it stands.
pub fn adaptive(played: Played, elements: usize, tolerance: f64) -> Outcome<(Path, Duration)> {
    follow(played, &scene(played, elements, tolerance))
}

/// With so many elements and so fine steps that neither moves the fifth digit.
pub fn converged(played: Played) -> Outcome<(Path, Duration)> {
    let (elements, tolerance, method) = match played {
        Played::SteelPendulum | Played::SpinUp => (16, 1e-8, "radau"),
        Played::SoftPendulum => (160, 1e-8, "auto"),
        Played::SliderCrank => (16, 1e-7, "radau"),
        Played::Spaghetti => (64, 1e-7, "auto"),
    };
    let mut scene = scene(played, elements, tolerance);
    scene["method"] = json!({ "integrator": method });
    follow(played, &scene)
}

fn follow(played: Played, scene: &serde_json::Value) -> Outcome<(Path, Duration)> {
    let mut product = Product::start(scene)?;
    let (mut path, mut spent) = (Path::new(), Duration::ZERO);
    for time in played.times() {
        let started = ThreadTime::now();
        let stepped = product.step(time);
        spent += started.elapsed();
        stepped.map_err(|failure| format!("{}: {failure:?}", played.name()))?;
        let markers = played.markers().iter();
        path.push(
            markers
                .map(|marker| product.position(marker))
                .collect::<Outcome<_>>()?,
        );
    }
    Ok((path, spent))
}

/// Runs the product's equations at fixed steps of generalized-alpha.
pub fn alpha(played: Played, elements: usize, step: f64) -> Outcome<(Path, Duration)> {
    let start = start(&scene(played, elements, 1e-6))?;
    let times = played.times();
    let march = March {
        start: &start,
        method: named(&start, "alpha_0.8")?,
        times: [step, times.last().copied().unwrap_or_default()],
        after: After::All,
    };
    let (mut states, mut next) = (Vec::new(), times.iter().peekable());
    let started = ThreadTime::now();
    let ended = march.run(|state| {
        if next
            .next_if(|time| state.time > **time - 0.5 * step)
            .is_some()
        {
            states.push(state.clone());
        }
    })?;
    let spent = started.elapsed();
    ended.map_err(|time| format!("{}: no step at {time} s", played.name()))?;
    let mut reader = Reader::new(&start);
    let mut row = |state| {
        let markers = played.markers().iter();
        markers
            .map(|marker| reader.position(state, marker))
            .collect::<Outcome<_>>()
    };
    let path = states.iter().map(&mut row).collect::<Outcome<_>>()?;
    Ok((path, spent))
}

/// Largest elastic energy of the undeformed rod in so many directions, J.
pub fn energy_turned(played: Played, elements: usize, directions: u32) -> Outcome<f64> {
    let mut most = 0.0_f64;
    for direction in 0..directions {
        let (s, c) =
            (std::f64::consts::TAU * f64::from(direction) / f64::from(directions)).sin_cos();
        let mut scene = scene(played, elements, 1e-6);
        let length = played.rod().length;
        scene["bodies"][0]["shape"]["line"]["to"] = json!([length * c, length * s]);
        most = most.max(Product::start(&scene)?.get("energy.strain")?);
    }
    Ok(most)
}
