//! Communication steps, inputs that jump, tolerances.

use std::f64::consts::PI;

use flexbody::integrators::{RK4, RungeKutta, Tolerance, advance};
use flexbody::system::{DrivenSystem, fastest};
use serde_json::{Value, json};

use super::alpha::Alpha;
use super::support::{After, March, Product, Reader, Row, figure, json, short, start};
use crate::scene::Outcome;

const STEEL: &str = include_str!("../../../../tests/cases/steel_pendulum/scene.json");

/// Period of the rigid rod from the horizontal, s: elliptic functions (case `steel_pendulum`).
const PERIOD: f64 = 2.117_862_221_902_384;

/// Communication steps of a millionth of a second and of ten periods.
pub fn communication_steps() -> Outcome<Row> {
    let scene = json(STEEL)?;
    let start = start(&scene)?;
    let mut tip = [f64::NAN; 2];
    let mut reader = Reader::new(&start);
    let march = March {
        start: &start,
        method: Box::new(Alpha::new(0.8, start.assembled.system.scale())),
        times: [PERIOD, 10.0 * PERIOD],
        after: After::All,
    };
    let end = march.run(|state| {
        if let Ok(at) = reader.position(state, "rod.tip") {
            tip = at;
        }
    })?;
    // After ten periods the rod is back where it started.
    let off = |tip: [f64; 2]| (tip[0] - 1.2).hypot(tip[1]);
    let failing = match end {
        Ok(()) => figure(
            off(tip),
            format!("no error told, tip {} m off", short(off(tip))),
        ),
        Err(time) => figure(f64::INFINITY, format!("stops after {} s", short(time))),
    };
    let mut long = Product::start(&scene)?;
    long.step(10.0 * PERIOD).map_err(|e| e.to_string())?;
    let far = off(long.position("rod.tip")?);
    // Ten thousand short steps against one.
    let (mut short_steps, mut one) = (Product::start(&scene)?, Product::start(&scene)?);
    for point in 1..=10_000 {
        short_steps
            .step(1e-6 * f64::from(point))
            .map_err(|e| e.to_string())?;
    }
    one.step(0.01).map_err(|e| e.to_string())?;
    let (a, b) = (short_steps.position("rod.tip")?, one.position("rod.tip")?);
    let near = (a[0] - b[0]).hypot(a[1] - b[1]);
    let text = format!(
        "tip {} m off after one step of ten periods; steps of 1e-6 s within {} m of one of 0.01 s",
        short(far),
        short(near)
    );
    Ok(Row {
        place: "Communication steps of 1e-6 s to ten periods",
        method: "one step of generalized-alpha 0.8 each, one period long; steel pendulum".into(),
        failing,
        product: figure(far.max(near * 100.0), text),
        test: "communication_steps_of_any_length_are_right",
    })
}

/// Time between jumps, s; angular frequency, rad/s; force over stiffness, m; number of jumps.
const JUMPS: (f64, f64, f64, u32) = (0.35, 2.0 * PI, 1.0, 8);

/// A particle of 1 kg on a spring with a force that the master sets, or with one that jumps by itself.
fn oscillator(load: Option<Vec<[f64; 2]>>) -> Value {
    let (_, w, size, _) = JUMPS;
    let spring = json!({
        "name": "spring", "kind": "spring_damper", "markers": ["ground", "box.centre"], "point": [-10.0, 0.0],
        "stiffness": w * w, "damping": 0.0
    });
    let mut scene = json!({
        "name": "oscillator", "dimension": 2,
        "bodies": [{
            "name": "box", "element": "rigid", "mass": 1.0, "inertia": 0.0, "position": [0.0, 0.0],
            "markers": {"centre": [0.0, 0.0]}
        }],
        "joints": [{
            "name": "rail", "kind": "point_on_line", "markers": ["ground", "box.centre"], "direction": [1.0, 0.0]
        }],
        "loads": [spring],
        "outputs": [{"kind": "position", "marker": "box.centre"}],
        "accuracy": {"relative_tolerance": 1e-8}
    });
    match load {
        None => {
            scene["inputs"] =
                json!([{"kind": "force", "marker": "box.centre", "start": [w * w * size, 0.0]}]);
        }
        Some(table) => {
            let push = json!({
                "name": "push", "kind": "force", "marker": "box.centre", "value": [{"table": table}, 0.0]
            });
            scene["loads"] = json!([scene["loads"][0], push]);
        }
    }
    scene
}

/// Position at the end: closed form, from jump to jump.
fn jumped() -> f64 {
    let (time, w, size, count) = JUMPS;
    let (mut x, mut v) = (0.0, 0.0);
    for jump in 0..count {
        let rest = if jump % 2 == 0 { size } else { 0.0 };
        let (sin, cos) = (w * time).sin_cos();
        (x, v) = (
            rest + (x - rest) * cos + v / w * sin,
            v * cos - w * (x - rest) * sin,
        );
    }
    x
}

/// Error of generalized-alpha where its acceleration is kept over jumps.
fn with_memory(step: f64) -> Outcome<f64> {
    let (time, w, size, count) = JUMPS;
    let mut table = Vec::new();
    for jump in 0..count {
        let force = if jump % 2 == 0 { w * w * size } else { 0.0 };
        let from = time * f64::from(jump);
        table.push([from + 1e-12, force]);
        table.push([from + time, force]);
    }
    let start = start(&oscillator(Some(table)))?;
    let mut reader = Reader::new(&start);
    let mut x = f64::NAN;
    let march = March {
        start: &start,
        method: Box::new(Alpha::new(0.8, start.assembled.system.scale())),
        times: [step, time * f64::from(count)],
        after: After::All,
    };
    let end = march.run(|state| {
        x = reader
            .position(state, "box.centre")
            .map_or(f64::NAN, |at| at[0]);
    })?;
    end.map_err(|time| format!("stops at {time} s"))?;
    Ok((x - jumped()).abs())
}

/// Inputs that jump.
pub fn jumps() -> Outcome<Row> {
    let (time, w, size, count) = JUMPS;
    let [coarse, fine] = [with_memory(time / 70.0)?, with_memory(time / 140.0)?];
    let order = (coarse / fine).log2();
    let mut product = Product::start(&oscillator(None))?;
    for jump in 0..count {
        let force = if jump % 2 == 0 { w * w * size } else { 0.0 };
        product.set("box.centre.force[1]", force)?;
        product
            .step(time * f64::from(jump + 1))
            .map_err(|e| e.to_string())?;
    }
    let off = (product.position("box.centre")?[0] - jumped()).abs();
    Ok(Row {
        place: "Inputs that jump at communication points",
        method: "generalized-alpha 0.8, its acceleration carried over the jump; oscillator, 5 ms"
            .into(),
        failing: figure(
            order,
            format!("order {order:.1} instead of 2, {} m off", short(coarse)),
        ),
        product: figure(off, format!("{} m off at tolerance 1e-8", short(off))),
        test: "jumps_cost_no_order",
    })
}

/// A tolerance tighter than roundoff.
pub fn tolerance() -> Outcome<Row> {
    let mut scene = json(STEEL)?;
    let start = start(&scene)?;
    let (system, mut work) = (&start.assembled.system, start.work.clone());
    let mut state = start.state.clone();
    let tight = Tolerance {
        relative: 1e-22,
        position: system.scale(),
        time: 1.0,
    };
    let (frequency, decay) = fastest(system, &[], &mut work, &state);
    let mut rk4 = RungeKutta::new(&RK4, state.rates.len(), frequency, decay);
    let mut model = DrivenSystem::new(system, &[], &mut work, &state);
    let stop = 1e-6;
    let (counts, end) = advance(&mut rk4, &mut model, &mut state, stop, &tight);
    let taken = counts.steps + counts.rejected;
    let failing = match end {
        Err(stop) => figure(
            f64::INFINITY,
            format!("{stop:?} at {} s", short(state.time)),
        ),
        Ok(()) => {
            let rate = taken as f64 / stop;
            figure(
                rate,
                format!("{} steps a second, no digit gained", short(rate)),
            )
        }
    };
    scene["accuracy"]["relative_tolerance"] = json!(1e-15);
    let refused = match Product::start(&scene) {
        Ok(_) => return Err("expected a tolerance of 1e-15 to be refused".into()),
        Err(message) => message,
    };
    scene["accuracy"]["relative_tolerance"] = json!(1e-14);
    scene["bodies"][0]["elements"] = json!(1);
    let mut product = Product::start(&scene)?;
    product.step(1e-3).map_err(|e| e.to_string())?;
    let first = product.get("energy.kinetic")?
        + product.get("energy.strain")?
        + product.get("energy.gravity")?;
    Ok(Row {
        place: "Tolerance tighter than roundoff",
        method: "rk4 at tolerance 1e-22; steel pendulum".into(),
        failing,
        product: figure(
            first.abs(),
            format!(
                "refuses: {refused}; at 1e-14 keeps energy to {} J",
                short(first)
            ),
        ),
        test: "tolerances_below_roundoff_are_refused",
    })
}

#[test]
fn communication_steps_of_any_length_are_right() {
    let row = communication_steps().expect("a row");
    assert!(row.failing.value > 0.1, "{}", row.failing.text);
    assert!(row.product.value < 0.01, "{}", row.product.text);
}

#[test]
fn jumps_cost_no_order() {
    let row = jumps().expect("a row");
    assert!(row.failing.value < 1.3, "{}", row.failing.text);
    assert!(row.product.value < 1e-5, "{}", row.product.text);
}

#[test]
fn tolerances_below_roundoff_are_refused() {
    let row = tolerance().expect("a row");
    assert!(row.failing.value > 1e7, "{}", row.failing.text);
    assert!(row.product.value < 1e-9, "{}", row.product.text);
    assert!(
        row.product
            .text
            .contains("relative_tolerance: expected a number from")
    );
}
