//! Integrators at fixed steps: beyond stability, without damping of what they do not resolve, and on a
//! spurious root of Newton's method.

use flexbody::integrators::OneStepMethod;
use flexbody::system::fastest;
use serde_json::{Value, json};

use super::alpha::Alpha;
use super::support::{
    After, Figure, March, Product, Reader, Row, figure, json, named, short, start,
};
use crate::scene::{Outcome, Start};

const STEEL: &str = include_str!("../../../../tests/cases/steel_pendulum/scene.json");
const THROWN: &str = include_str!("../../../../tests/cases/free_flight/scene.json");

/// Energy over that at the start, in units of `scale`, where the run ends or has grown hundredfold.
fn growth(
    start: &Start,
    method: Box<dyn OneStepMethod>,
    times: [f64; 2],
    scale: f64,
) -> Outcome<Figure> {
    let mut reader = Reader::new(start);
    let first = reader.energy(&start.state);
    let (mut most, mut time, mut at) = (0.0_f64, 0.0, f64::NAN);
    let after = After::All;
    let march = March {
        start,
        method,
        times,
        after,
    };
    let end = march.run(|state| {
        let grown = (reader.energy(state) - first) / scale;
        if at.is_nan() && grown > 1.0 {
            at = state.time;
        }
        // Not f64::max, which would hide a NaN.
        most = if grown <= most { most } else { grown };
        time = state.time;
    })?;
    Ok(match end {
        _ if !at.is_nan() => figure(
            f64::INFINITY,
            format!("energy doubles after {} s and grows on", short(at)),
        ),
        Ok(()) => figure(
            most,
            format!("energy grows by {} in {} s", short(most), short(time)),
        ),
        Err(time) => figure(f64::INFINITY, format!("stops after {} s", short(time))),
    })
}

/// Largest change of energy of the product in units of `scale`.
fn change(scene: &Value, stop: f64, points: u32, scale: f64) -> Outcome<f64> {
    let mut product = Product::start(scene)?;
    let first = product.balance()?;
    let mut most = 0.0_f64;
    for point in 1..=points {
        let until = stop * f64::from(point) / f64::from(points);
        product.step(until).map_err(|e| e.to_string())?;
        most = most.max((product.balance()? - first).abs() / scale);
    }
    Ok(most)
}

/// Explicit steps beyond the stability limit.
pub fn beyond_stability() -> Outcome<Row> {
    let mut scene = json(STEEL)?;
    let start = start(&scene)?;
    let (system, mut work) = (&start.assembled.system, start.work.clone());
    let limit = 2.0 / fastest(system, &[], &mut work, &start.state).0;
    // m g L/2: what gravity can give.
    let scale = system.mass() * 9.81 * 0.6;
    let step = 1.1 * limit;
    let failing = growth(
        &start,
        named(&start, "verlet")?,
        [step, 2000.0 * step],
        scale,
    )?;
    scene["outputs"] = json!([{"kind": "position", "marker": "rod.tip"}]);
    let mut product = Product::start(&scene)?;
    // A period of the rigid rod: elliptic functions, 28 digits (case `steel_pendulum`).
    product
        .step(2.117_862_221_902_384)
        .map_err(|e| e.to_string())?;
    let [x, y] = product.position("rod.tip")?;
    let off = (x - 1.2).hypot(y);
    Ok(Row {
        place: "Explicit steps",
        method: format!(
            "velocity Verlet at 1.1 of its stability limit ({} s); steel pendulum",
            short(step)
        ),
        failing,
        product: figure(
            off,
            format!("after a swing {} m from the rigid rod", short(off)),
        ),
        test: "verlet_explodes_beyond_its_limit",
    })
}

/// A thrown steel rod that rotates 20 rad/s.
fn thrown() -> Outcome<Value> {
    let mut scene = json(THROWN)?;
    scene["bodies"][0]["motion"]["spin"] = json!(20.0);
    scene["outputs"] = json!([{"kind": "energy"}, {"kind": "work"}]);
    Ok(scene)
}

/// The product on the thrown rod for ten seconds, and a method for one.
fn on_the_thrown(method: impl Fn(f64) -> Alpha, step: f64) -> Outcome<[Figure; 2]> {
    let scene = thrown()?;
    let start = start(&scene)?;
    let scale = Reader::new(&start).energy(&start.state);
    let method = Box::new(method(start.assembled.system.scale()));
    let failing = growth(&start, method, [step, 1.0], scale)?;
    let kept = change(&scene, 10.0, 100, scale)?;
    Ok([
        failing,
        figure(kept, format!("energy kept to {} for 10 s", short(kept))),
    ])
}

/// Generalized-alpha without damping.
pub fn undamped_alpha() -> Outcome<Row> {
    let [failing, product] = on_the_thrown(|size| Alpha::new(1.0, size), 1e-2)?;
    Ok(Row {
        place: "Energy of stiff modes",
        method: "generalized-alpha, spectral radius 1, 10 ms; thrown steel rod, 20 rad/s".into(),
        failing,
        product,
        test: "undamped_alpha_gains_energy",
    })
}

/// The trapezoidal rule.
pub fn trapezoidal() -> Outcome<Row> {
    let [failing, product] = on_the_thrown(Alpha::trapezoidal, 5e-3)?;
    Ok(Row {
        place: "Stiff axial modes that turn",
        method: "trapezoidal rule, 5 ms; thrown steel rod, 20 rad/s".into(),
        failing,
        product,
        test: "the_trapezoidal_rule_gains_energy",
    })
}

#[test]
fn verlet_explodes_beyond_its_limit() {
    let row = beyond_stability().expect("a row");
    assert!(row.failing.value > 1.0, "{}", row.failing.text);
    // The beam's own bending is most of it: the reference is rigid.
    assert!(row.product.value < 1.5e-3, "{}", row.product.text);
}

#[test]
fn undamped_alpha_gains_energy() {
    let row = undamped_alpha().expect("a row");
    assert!(row.failing.value > 1.0, "{}", row.failing.text);
    assert!(row.product.value < 1e-2, "{}", row.product.text);
}

#[test]
fn the_trapezoidal_rule_gains_energy() {
    let row = trapezoidal().expect("a row");
    assert!(row.failing.value > 1.0, "{}", row.failing.text);
    assert!(row.product.value < 1e-2, "{}", row.product.text);
}
