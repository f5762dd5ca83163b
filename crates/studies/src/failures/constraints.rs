//! Constraints: a fixed choice of coordinates, and accelerations integrated without projection.

use serde_json::Value;

use super::support::{
    After, Figure, March, Product, Reader, Row, figure, json, named, short, start,
};
use crate::scene::Outcome;

const CRANK: &str = include_str!("../../../../tests/cases/slider_crank_free/scene.json");
const PARALLELOGRAM: &str = include_str!("../../../../tests/cases/parallelogram/heavy.json");
const PENDULUM: &str = include_str!("../../../../tests/cases/double_pendulum/scene.json");

/// Energy and residual of positions at worst, and where the run ended.
fn marched(scene: &Value, after: After, times: [f64; 2]) -> Outcome<(f64, f64, Result<(), f64>)> {
    let start = start(scene)?;
    let mut reader = Reader::new(&start);
    let first = reader.energy(&start.state);
    let (mut energy, mut residual) = (0.0_f64, 0.0_f64);
    let method = named(&start, "rk4")?;
    let march = March {
        start: &start,
        method,
        times,
        after,
    };
    let end = march.run(|state| {
        energy = energy.max((reader.energy(state) - first).abs());
        residual = residual.max(reader.values.residuals(&start.assembled.system)[0]);
    })?;
    Ok((energy, residual, end))
}

/// Energy (J) and residual of positions of the product at worst.
fn product(scene: &Value, stop: f64, points: u32) -> Outcome<(f64, f64)> {
    let mut product = Product::start(scene)?;
    let energy = |product: &mut Product| -> Outcome<f64> {
        Ok(product.get("energy.kinetic")? + product.get("energy.gravity")?)
    };
    let first = energy(&mut product)?;
    let (mut change, mut residual) = (0.0_f64, 0.0_f64);
    for point in 1..=points {
        let until = stop * f64::from(point) / f64::from(points);
        product.step(until).map_err(|e| e.to_string())?;
        change = change.max((energy(&mut product)? - first).abs());
        residual = residual.max(product.get("residual.position")?);
    }
    Ok((change, residual))
}

/// A choice of coordinates that stays as it was at the start, on a scene and for a time (s).
fn fixed_choice(text: &str, stop: f64) -> Outcome<[Figure; 2]> {
    let scene = json(text)?;
    let (energy, _, end) = marched(&scene, After::Dependent, [1e-4, stop])?;
    let failing = match end {
        Err(time) => figure(f64::INFINITY, format!("stops after {} s", short(time))),
        Ok(()) => figure(
            energy,
            format!("energy off by {} J in {} s", short(energy), short(stop)),
        ),
    };
    let (energy, residual) = product(&scene, stop, 100)?;
    let text = format!(
        "energy kept to {} J for {} s, residual {}",
        short(energy),
        short(stop),
        short(residual)
    );
    Ok([failing, figure(energy + residual, text)])
}

/// Coordinate partitioning at a slider-crank's dead centre.
pub fn dead_centre() -> Outcome<Row> {
    let [failing, product] = fixed_choice(CRANK, 2.0)?;
    Ok(Row {
        place: "Dead centre of a slider-crank",
        method: "coordinate partitioning, chosen once at the start".into(),
        failing,
        product,
        test: "a_fixed_choice_of_coordinates_dies_in_a_slider_crank",
    })
}

/// Coordinate partitioning at a parallelogram's flat position.
pub fn flat_position() -> Outcome<Row> {
    let [failing, product] = fixed_choice(PARALLELOGRAM, 2.0)?;
    Ok(Row {
        place: "Flat position of a parallelogram",
        method: "coordinate partitioning, chosen once at the start".into(),
        failing,
        product,
        test: "a_fixed_choice_of_coordinates_dies_in_a_parallelogram",
    })
}

/// Accelerations that keep constraints, integrated as they are.
pub fn drift() -> Outcome<Row> {
    let scene = json(PENDULUM)?;
    let residual_of =
        |stop: f64| marched(&scene, After::Nothing, [2e-3, stop]).map(|found| found.1);
    let [early, late] = [residual_of(10.0)?, residual_of(40.0)?];
    let (_, kept) = product(&scene, 40.0, 100)?;
    Ok(Row {
        place: "Constraints kept by their accelerations (index 3)",
        method: "multipliers, no projection; rigid double pendulum, rk4, 2 ms".into(),
        failing: figure(
            late,
            format!(
                "residual {} after 10 s, {} after 40 s",
                short(early),
                short(late)
            ),
        ),
        product: figure(kept, format!("residual {} in 40 s", short(kept))),
        test: "accelerations_alone_drift_off_their_constraints",
    })
}

#[test]
fn a_fixed_choice_of_coordinates_dies_in_a_slider_crank() {
    let row = dead_centre().expect("a row");
    assert!(row.failing.value > 1e-3, "{}", row.failing.text);
    assert!(row.product.value < 1e-8, "{}", row.product.text);
}

#[test]
fn a_fixed_choice_of_coordinates_dies_in_a_parallelogram() {
    let row = flat_position().expect("a row");
    assert!(row.failing.value > 1e-3, "{}", row.failing.text);
    assert!(row.product.value < 1e-7, "{}", row.product.text);
}

#[test]
fn accelerations_alone_drift_off_their_constraints() {
    let row = drift().expect("a row");
    assert!(row.failing.value > 1e-6, "{}", row.failing.text);
    assert!(row.product.value < 1e-14, "{}", row.product.text);
}
