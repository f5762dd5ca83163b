//! A whip, a rope that goes taut, a rod on a spurious root.

use serde_json::{Value, json};

use super::alpha::Alpha;
use super::support::{After, Figure, March, Product, Reader, Row, figure, json, short, start};
use crate::scene::{Outcome, Start};

const SPAGHETTI: &str = include_str!("../../../../tests/cases/flying_spaghetti/scene.json");

const GRAVITY: f64 = 9.81;

/// A cable of 1 m and 1 kg that hangs folded between its pin and a force that holds its other end 5 cm
/// beside.
fn folded(elements: u32) -> Value {
    let (gap, modulus, axial) = (0.05, 1e9, 1e5);
    // Inextensible catenary: 2 a sinh(gap / 2a) = 1.
    let (mut low, mut high) = (1e-3_f64, 1.0);
    for _ in 0..100 {
        let a = 0.5 * (low + high);
        if 2.0 * a * (0.5 * gap / a).sinh() > 1.0 {
            low = a;
        } else {
            high = a;
        }
    }
    let force = [GRAVITY * low, 0.5 * GRAVITY];
    let area = axial / modulus;
    json!({
        "name": "whip", "dimension": 2, "gravity": [0.0, -GRAVITY],
        "bodies": [{
            "name": "rod", "element": "cable", "elements": elements,
            "material": {"youngs_modulus": modulus, "density": 1.0 / area},
            "section": {"area": area, "second_moment": 1e-5 / modulus},
            "shape": {"arc": {"from": [0.0, 0.0], "to": [gap, 0.0], "length": 1.0}},
            "markers": {"root": 0.0, "tip": 1.0}
        }],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"]}],
        "inputs": [{"kind": "force", "marker": "rod.tip", "start": force}],
        "outputs": [{"kind": "position", "marker": "rod.tip"}, {"kind": "energy"}, {"kind": "work"}],
        "initial": "static_equilibrium"
    })
}

/// A particle of 1 kg that falls 0.3 m before its rope of 1e-6 kg is taut.
fn slack() -> Value {
    let (modulus, axial) = (1e9, 1e3);
    let area = axial / modulus;
    json!({
        "name": "slack", "dimension": 2, "gravity": [0.0, -GRAVITY],
        "bodies": [{
            "name": "rope", "element": "cable", "elements": 4,
            "material": {"youngs_modulus": modulus, "density": 1e-6 / area},
            "section": {"area": area, "second_moment": 0.0},
            "shape": {"arc": {"from": [0.0, 0.0], "to": [0.0, -0.7], "length": 1.0}},
            "markers": {"root": 0.0, "tip": 1.0}
        }],
        "masses": [{"marker": "rope.tip", "mass": 1.0}],
        "joints": [
            {"name": "pin", "kind": "revolute", "markers": ["ground", "rope.root"]},
            {"name": "guide", "kind": "point_on_line", "markers": ["ground", "rope.tip"], "direction": [0.0, 1.0]}
        ],
        "outputs": [{"kind": "position", "marker": "rope.tip"}, {"kind": "energy"}, {"kind": "work"}]
    })
}

/// A run of generalized-alpha with spectral radius 0.8: energy that it gained, and the time it stopped.
fn alpha(start: &Start, step: f64, stop: f64) -> Outcome<(f64, Result<(), f64>)> {
    let mut reader = Reader::new(start);
    let first = reader.energy(&start.state);
    let mut gained = 0.0_f64;
    let march = March {
        start,
        method: Box::new(Alpha::new(0.8, start.assembled.system.scale())),
        times: [step, stop],
        after: After::All,
    };
    let end = march.run(|state| gained = gained.max(reader.energy(state) - first))?;
    Ok((gained, end))
}

/// What such a run is in the table, with a size of its energy, J.
fn stopped(gained: f64, end: Result<(), f64>, size: f64) -> Figure {
    match end {
        Err(time) if gained > size => figure(
            f64::INFINITY,
            format!("gains {} J, stops after {} s", short(gained), short(time)),
        ),
        Err(time) => figure(f64::INFINITY, format!("stops after {} s", short(time))),
        Ok(()) => figure(gained / size, format!("gains {} J", short(gained))),
    }
}

/// A folded cable let go at one end.
pub fn whip() -> Outcome<Row> {
    let scene = folded(16);
    let mut start = start(&scene)?;
    start.inputs = vec![0.0; 2];
    // m g L/4 is what the free half can give.
    let (gained, end) = alpha(&start, 5e-3, 0.6)?;
    let failing = stopped(gained, end, 0.25 * GRAVITY);
    let mut product = Product::start(&scene)?;
    for axis in 1..=2 {
        product.set(&format!("rod.tip.force[{axis}]"), 0.0)?;
    }
    let first = product.balance()?;
    let (mut lowest, mut time, mut lost) = (0.0_f64, 0.0, 0.0_f64);
    for point in 1..=240 {
        let now = 2.5e-3 * f64::from(point);
        product.step(now).map_err(|e| e.to_string())?;
        let y = product.position("rod.tip")?[1];
        if y < lowest {
            (lowest, time) = (y, now);
        }
        lost = lost.max((product.balance()? - first).abs());
    }
    // M. G. Calkin, R. H. March, Am. J. Phys. 57 (1989) 154-157: a folded chain that keeps its energy falls
    // in 0.8472 of the time of free fall.
    let ratio = time / (2.0 / GRAVITY).sqrt();
    let text = format!(
        "falls in {ratio:.3} of free fall (0.847 is exact for a sharp fold), energy within {} J",
        short(lost)
    );
    Ok(Row {
        place: "Whip at its free end",
        method: "generalized-alpha 0.8, 5 ms; folded cable let go at one end".into(),
        failing,
        product: figure((ratio / 0.8472 - 1.0).abs().max(lost / GRAVITY), text),
        test: "a_whip_keeps_its_energy",
    })
}

/// A rope that is slack at first.
pub fn taut() -> Outcome<Row> {
    let scene = slack();
    let (gained, end) = alpha(&start(&scene)?, 5e-3, 0.4)?;
    let failing = stopped(gained, end, GRAVITY);
    let mut product = Product::start(&scene)?;
    let mut lowest = 0.0_f64;
    for point in 1..=400 {
        product
            .step(1e-3 * f64::from(point))
            .map_err(|e| e.to_string())?;
        lowest = lowest.min(product.position("rope.tip")?[1]);
    }
    // Energy: g (0.3 + u) = k u^2 / 2 with k = 1000 N/m.
    let u = (GRAVITY + (GRAVITY * GRAVITY + 600.0 * GRAVITY).sqrt()) / 1e3;
    let off = (lowest + 1.0 + u).abs();
    Ok(Row {
        place: "Slack rope that goes taut",
        method: "generalized-alpha 0.8, 5 ms; 1 kg falls 0.3 m on a rope of 1e-6 kg".into(),
        failing,
        product: figure(
            off,
            format!("lowest point {} m off the closed form", short(off)),
        ),
        test: "a_slack_rope_goes_taut",
    })
}

/// The flying spaghetti under a rectangular load.
pub fn spaghetti() -> Outcome<Row> {
    let mut scene = json(SPAGHETTI)?;
    scene["bodies"][0]["elements"] = json!(16);
    scene["accuracy"] = json!({"relative_tolerance": 1e-4});
    let (gained, end) = alpha(&start(&scene)?, 1e-2, 2.5)?;
    let mut once = Product::start(&scene)?;
    once.step(1e-2).map_err(|e| e.to_string())?;
    let work = once.get("energy.input")?;
    let failing = match end {
        Err(time) if time < 0.1 => figure(
            gained / work,
            format!(
                "takes a wrong root: {} J in {} s, where the loads can do {} J; then stops",
                short(gained),
                short(time),
                short(work)
            ),
        ),
        _ => figure(
            gained / 550.0,
            format!("gains {} J of 555 J", short(gained)),
        ),
    };
    scene["accuracy"] = json!({"relative_tolerance": 1e-5});
    let mut product = Product::start(&scene)?;
    let first = product.balance()?;
    let mut lost = 0.0_f64;
    for point in 1..=500 {
        product
            .step(5e-3 * f64::from(point))
            .map_err(|e| e.to_string())?;
        lost = lost.max((product.balance()? - first).abs());
    }
    // Impulse of the force over the mass: 8 N for 2.5 s on 10 kg.
    let speed = product.get("momentum[1]")? / 10.0;
    let off = (speed - 2.0).abs();
    let text = format!(
        "speed of the centre of mass {} m/s off the impulse, energy within {} J of 550",
        short(off),
        short(lost)
    );
    Ok(Row {
        place: "Load that starts at once on a soft rod",
        method: "generalized-alpha 0.8, 10 ms, full Newton; flying spaghetti, 16 elements".into(),
        failing,
        product: figure(off.max(lost / 550.0), text),
        test: "a_flying_rod_takes_no_extra_turn",
    })
}

#[test]
fn a_whip_keeps_its_energy() {
    let row = whip().expect("a row");
    assert!(row.failing.value > 1.0, "{}", row.failing.text);
    assert!(row.product.value < 0.01, "{}", row.product.text);
}

#[test]
fn a_slack_rope_goes_taut() {
    let row = taut().expect("a row");
    assert!(row.failing.value > 0.1, "{}", row.failing.text);
    assert!(row.product.value < 5e-4, "{}", row.product.text);
}

#[test]
fn a_flying_rod_takes_no_extra_turn() {
    let row = spaghetti().expect("a row");
    assert!(row.failing.value > 2.0, "{}", row.failing.text);
    assert!(row.product.value < 1e-3, "{}", row.product.text);
}
