//! The report's elimination as printed, and Green's strain in bending.

use flexbody::elements::cable::{Inertia, Parameters};
use serde_json::{Value, json};

use super::support::{Product, Row, figure, json, short};
use crate::formulations::{Formulation, uniform};
use crate::scene::Outcome;
use crate::space::Problem;
use crate::swing::{COURANT, fall};

const SOFT: &str = include_str!("../../../../tests/cases/soft_pendulum/scene.json");
const GREEN: &str =
    include_str!("../../../../tests/cases/pure_moment/GreenLagrange_FrenetKappa.json");
/// Ends of the elements that meet in the middle: each marker on its own element.
const LEFT: f64 = 0.5 - 1e-11;

/// Times between compared points and at the end, s.
const TIMES: [f64; 2] = [0.1, 1.1];

/// Largest gap between two elements and largest distance from the pin of the product, m.
fn weighted(scene: &Value) -> Outcome<[f64; 2]> {
    let mut scene = scene.clone();
    scene["bodies"][0]["elements"] = json!(2);
    scene["bodies"][0]["markers"] = json!({"left": LEFT, "right": 0.5, "root": 0.0, "tip": 1.0});
    let output = |marker: &str| json!({"kind": "position", "marker": format!("rod.{marker}")});
    scene["outputs"] = ["left", "right", "root"].map(output).into();
    scene["method"] = json!({"integrator": "rk4"});
    let mut product = Product::start(&scene)?;
    let [mut gap, mut pin] = [0.0_f64; 2];
    for point in 1..=11 {
        product
            .step(TIMES[0] * f64::from(point))
            .map_err(|e| e.to_string())?;
        let [a, b] = [
            product.position("rod.left")?,
            product.position("rod.right")?,
        ];
        let root = product.position("rod.root")?;
        gap = gap.max((a[0] - b[0]).hypot(a[1] - b[1]));
        pin = pin.max(root[0].hypot(root[1]));
    }
    Ok([gap, pin])
}

/// The same of the report's equations, with its mass.
fn as_printed(scene: &Value) -> Outcome<[f64; 2]> {
    let problem = Problem::read(scene)?;
    let cable = Parameters {
        inertia: Inertia::Consistent,
        ..problem.cable()
    };
    let (elements, gravity) = (uniform(cable, 2), problem.gravity);
    let found = fall(Formulation::AsPrinted, elements, gravity, COURANT, TIMES)?;
    let gaps = found.gaps.iter().map(|gap| gap[0]);
    let pins = found.pins.iter().copied();
    Ok([gaps.fold(0.0, f64::max), pins.fold(0.0, f64::max)])
}

/// The report's Eqs. 29 to 34.
pub fn printed() -> Outcome<Row> {
    let scene = json(SOFT)?;
    let [printed, weighted] = [as_printed(&scene)?, weighted(&scene)?];
    Ok(Row {
        place: "Elimination of connectivity",
        method: "report MBS97-2-UIC, Eqs. 23-34 as printed; soft pendulum, 2 elements".into(),
        failing: figure(
            printed[1],
            format!(
                "in 1.1 s the elements part by {} m and the pinned end falls {} m",
                short(printed[0]),
                short(printed[1])
            ),
        ),
        product: figure(
            weighted[0].max(weighted[1]),
            format!(
                "largest gap {} m, at the pin {} m",
                short(weighted[0]),
                short(weighted[1])
            ),
        ),
        test: "printed_elements_part",
    })
}

/// Error of the tip of a cantilever rolled up to a full circle, over its length.
fn rolled(strain: &str) -> Outcome<f64> {
    let mut scene = json(GREEN)?;
    scene["bodies"][0]["strain"] = json!(strain);
    scene["bodies"][0]["elements"] = json!(64);
    let number = |value: &Value| value.as_f64().ok_or("expected a number");
    let body = &scene["bodies"][0];
    let bending =
        number(&body["material"]["youngs_modulus"])? * number(&body["section"]["second_moment"])?;
    let line = &body["shape"]["line"];
    let length = number(&line["to"][0])? - number(&line["from"][0])?;
    scene["inputs"][0]["start"] = json!([2.0 * std::f64::consts::PI * bending / length]);
    let mut product = Product::start(&scene)?;
    let tip = product.position("rod.tip")?;
    Ok(tip[0].hypot(tip[1]) / length)
}

/// Green-Lagrange strain stretches what is only bent.
pub fn green() -> Outcome<Row> {
    let [green, default] = [rolled("GreenLagrange_FrenetKappa")?, rolled("thetaPrime")?];
    Ok(Row {
        place: "Bending to a full circle",
        method: "Green-Lagrange strain with Frenet curvature, 64 elements".into(),
        failing: figure(
            green,
            format!(
                "stretches in pure bending: the tip is {} L off",
                short(green)
            ),
        ),
        product: figure(default, format!("tip {} L off", short(default))),
        test: "green_strain_stretches_in_bending",
    })
}

#[test]
fn printed_elements_part() {
    let row = printed().expect("a row");
    assert!(row.failing.value > 1.0, "{}", row.failing.text);
    assert!(row.product.value < 1e-13, "{}", row.product.text);
}

#[test]
fn green_strain_stretches_in_bending() {
    let row = green().expect("a row");
    // Closed form: J. Gerstmayr, H. Irschik, J. Sound Vib. 318 (2008): 0.0326 m of 2 m.
    assert!(
        (row.failing.value - 0.0163).abs() < 1e-4,
        "{}",
        row.failing.text
    );
    assert!(row.product.value < 1e-5, "{}", row.product.text);
}
