//! Equilibria that plain Newton does not find: roll-up, buckling, snap-through, slack cables.

use std::f64::consts::PI;

use serde_json::{Value, json};

use super::support::{Figure, Product, Reader, Row, equilibrium, figure, json, short, start};
use crate::scene::Outcome;

const MOMENT: &str = include_str!("../../../../tests/cases/pure_moment/scene.json");
const COLUMN: &str = include_str!("../../../../tests/cases/buckling/scene.json");
const CABLE: &str = include_str!("../../../../tests/cases/catenary/scene_3.json");

/// What Newton's method makes of a scene under its whole load: the distance of a marker from where it
/// should be.
fn at_once(mut scene: Value, inputs: &[f64], marker: &str, wanted: [f64; 2]) -> Outcome<Figure> {
    scene["initial"] = json!("undeformed");
    let start = start(&scene)?;
    let Ok(state) = equilibrium(&start, inputs, &start.state) else {
        return Ok(figure(f64::INFINITY, "no equilibrium in 100 iterations"));
    };
    let at = Reader::new(&start).position(&state, marker)?;
    let off = (at[0] - wanted[0]).hypot(at[1] - wanted[1]);
    Ok(figure(off, format!("ends {} m off", short(off))))
}

fn found(scene: &Value, marker: &str, wanted: [f64; 2]) -> Outcome<f64> {
    let at = Product::start(scene)?.position(marker)?;
    Ok((at[0] - wanted[0]).hypot(at[1] - wanted[1]))
}

/// Newton without load steps.
pub fn roll_up() -> Outcome<Row> {
    let mut scene = json(MOMENT)?;
    scene["bodies"][0]["elements"] = json!(32);
    // An eighth of a turn: closed form (1 - cos(phi), sin(phi)) / phi.
    let phi = PI / 4.0;
    let eighth = [phi.sin() / phi, (1.0 - phi.cos()) / phi];
    let failing = at_once(scene.clone(), &[phi], "rod.tip", eighth)?;
    scene["inputs"][0]["start"] = json!([2.0 * PI]);
    let off = found(&scene, "rod.tip", [0.0, 0.0])?;
    Ok(Row {
        place: "Large static deflection",
        method: "Newton without load steps; end moment that rolls up 1/8 turn, EA L^2/EI = 1e8"
            .into(),
        failing,
        product: figure(off, format!("a full turn, tip {} L off", short(off))),
        test: "newton_without_load_steps_does_not_roll_up",
    })
}

/// A column under 1.29 times its buckling load.
pub fn buckling() -> Outcome<Row> {
    // shared/reference/buckling.json: end slope 80 degrees.
    let (load, wanted) = (
        1.293_889_323_882_278,
        [0.559_395_918_951_176 / 2.0, 0.359_748_552_365_665_6],
    );
    let side = 1e-6;
    let force = -load * PI * PI;
    let mut scene = json(COLUMN)?;
    scene["bodies"][0]["markers"]["mid"] = json!(0.5);
    let input =
        |marker: &str, start: [f64; 2]| json!({"kind": "force", "marker": marker, "start": start});
    scene["inputs"] = json!([
        input("rod.tip", [force, 0.0]),
        input("rod.mid", [0.0, side])
    ]);
    scene["outputs"] = json!([{"kind": "position", "marker": "rod.mid"}]);
    let off = found(&scene, "rod.mid", wanted)?;
    scene["bodies"][0]["elements"] = json!(16);
    let failing = at_once(scene, &[force, 0.0, 0.0, side], "rod.mid", wanted)?;
    Ok(Row {
        place: "Buckling",
        method: "Newton without load steps; pinned column, P = 1.29 of Euler's load, side force 1e-6 EI/L^2".into(),
        failing,
        product: figure(off, format!("buckled, {} L off the elastica", short(off))),
        test: "newton_does_not_find_the_buckled_column",
    })
}

/// Slack cable under its weight.
pub fn slack() -> Outcome<Row> {
    let scene = json(CABLE)?;
    // Span 1, length 1.5, EA 20, weight 1 per length.
    let wanted = [0.5, -0.526_312_510_052_342_3];
    let failing = at_once(scene.clone(), &[], "rod.middle", wanted)?;
    let off = found(&scene, "rod.middle", wanted)?;
    Ok(Row {
        place: "Slack cable",
        method: "Newton without a shift; cable without bending stiffness under its weight".into(),
        failing,
        product: figure(off, format!("middle {} L off the catenary", short(off))),
        test: "newton_does_not_hang_a_slack_cable",
    })
}

/// Half span, height, EA and EI of bars of a shallow truss of two bars.
const TRUSS: [f64; 4] = [1.0, 0.2, 1e4, 100.0];

/// The truss with its apex under a force.
fn truss(force: f64) -> Value {
    let [half, height, axial, bending] = TRUSS;
    let area = 1e-4;
    let modulus = axial / area;
    let bar = |name: &str, from: [f64; 2], to: [f64; 2]| {
        json!({
            "name": name, "element": "cable", "elements": 2,
            "material": {"youngs_modulus": modulus, "density": 1000.0},
            "section": {"area": area, "second_moment": bending / modulus},
            "shape": {"line": {"from": from, "to": to}}, "markers": {"a": 0.0, "b": 1.0}
        })
    };
    json!({
        "name": "truss", "dimension": 2,
        "bodies": [bar("left", [-half, 0.0], [0.0, height]), bar("right", [0.0, height], [half, 0.0])],
        "joints": [
            {"name": "first", "kind": "revolute", "markers": ["ground", "left.a"]},
            {"name": "apex", "kind": "revolute", "markers": ["left.b", "right.a"]},
            {"name": "last", "kind": "revolute", "markers": ["ground", "right.b"]}
        ],
        "inputs": [{"kind": "force", "marker": "left.b", "start": [0.0, -force]}],
        "outputs": [{"kind": "position", "marker": "left.b"}, {"kind": "energy"}, {"kind": "work"}],
        "initial": "static_equilibrium"
    })
}

/// Load under which the apex is at rest at a height: closed form.
fn load(y: f64) -> f64 {
    let [half, height, axial, _] = TRUSS;
    let (rest, length) = (half.hypot(height), half.hypot(y));
    2.0 * axial * (1.0 - length / rest) * y / length
}

/// Highest load before the truss snaps through, and the height there.
fn limit() -> (f64, f64) {
    let length = (TRUSS[0].powi(2) * TRUSS[0].hypot(TRUSS[1])).cbrt();
    let y = (length * length - TRUSS[0].powi(2)).sqrt();
    (load(y), y)
}

/// Where the load is `wanted` between two heights.
fn height(wanted: f64, mut low: f64, mut high: f64) -> f64 {
    let side = (load(low) - wanted).signum();
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if (load(middle) - wanted).signum() == side {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Snap-through under a load.
pub fn under_load() -> Outcome<Row> {
    let (most, y) = limit();
    let (before, beyond) = (0.999 * most, 1.001 * most);
    let wanted = [
        [0.0, height(before, y, TRUSS[1])],
        [0.0, height(beyond, -0.1, -1.0)],
    ];
    let mut off = 0.0_f64;
    for (force, wanted) in [before, beyond].into_iter().zip(wanted) {
        off = off.max(found(&truss(force), "left.b", wanted)?);
    }
    let failing = at_once(truss(0.0), &[0.0, -beyond], "left.b", wanted[1])?;
    Ok(Row {
        place: "Snap-through under a load",
        method: "Newton; shallow truss of two bars, 1.001 of the load it bears".into(),
        failing,
        product: figure(
            off,
            format!("apex {} m off, at 0.999 and at 1.001", short(off)),
        ),
        test: "newton_does_not_snap_through",
    })
}

/// Snap-through under a displacement.
pub fn under_displacement() -> Outcome<Row> {
    let (most, _) = limit();
    let mut scene = truss(0.0);
    scene["initial"] = json!("undeformed");
    let start = start(&scene)?;
    let mut reader = Reader::new(&start);
    let (mut state, mut lowest) = (start.state.clone(), TRUSS[1]);
    // Up to the load and past it, from equilibrium to equilibrium.
    let mut reached = 0.0;
    for part in 1..=120 {
        let force = most * f64::from(part) / 100.0;
        let Ok(next) = equilibrium(&start, &[0.0, -force], &state) else {
            break;
        };
        let y = reader.position(&next, "left.b")?[1];
        if y < 0.0 {
            break;
        }
        (state, lowest, reached) = (next, y, force);
    }
    let failing = figure(
        lowest + TRUSS[1],
        format!(
            "ends at {} N, {} m of the way untold",
            short(reached),
            short(lowest + TRUSS[1])
        ),
    );
    scene["inputs"] = json!([]);
    for body in 0..2 {
        scene["bodies"][body]["material"]["density"] = json!(10.0);
        scene["bodies"][body]["material"]["damping_time"] = json!(1e-5);
    }
    let course = format!("{}*cos(PI*t/2)", TRUSS[1]);
    scene["motions"] =
        json!([{"name": "push", "kind": "position", "marker": "left.b", "value": [0, course]}]);
    scene["outputs"] =
        json!([{"kind": "position", "marker": "left.b"}, {"kind": "reaction", "motion": "push"}]);
    let mut product = Product::start(&scene)?;
    let mut off = 0.0_f64;
    for point in 1..=40 {
        product
            .step(0.05 * f64::from(point))
            .map_err(|e| e.to_string())?;
        let y = product.position("left.b")?[1];
        off = off.max((product.get("push.reaction[2]")? + load(y)).abs() / most);
    }
    Ok(Row {
        place: "Snap-through under a displacement",
        method: "equilibria under loads, in steps of 1 %; shallow truss of two bars".into(),
        failing,
        product: figure(
            off,
            format!(
                "follows the whole way, force within {} of the highest",
                short(off)
            ),
        ),
        test: "loads_do_not_lead_through_a_snap",
    })
}

#[test]
fn newton_without_load_steps_does_not_roll_up() {
    let row = roll_up().expect("a row");
    assert!(row.failing.value > 0.1, "{}", row.failing.text);
    assert!(row.product.value < 2e-5, "{}", row.product.text);
}

#[test]
fn newton_does_not_find_the_buckled_column() {
    let row = buckling().expect("a row");
    assert!(row.failing.value > 0.1, "{}", row.failing.text);
    assert!(row.product.value < 1e-5, "{}", row.product.text);
}

#[test]
fn newton_does_not_hang_a_slack_cable() {
    let row = slack().expect("a row");
    assert!(row.failing.value > 1e-2, "{}", row.failing.text);
    assert!(row.product.value < 1e-5, "{}", row.product.text);
}

#[test]
fn newton_does_not_snap_through() {
    let row = under_load().expect("a row");
    assert!(row.failing.value > 0.1, "{}", row.failing.text);
    assert!(row.product.value < 1e-10, "{}", row.product.text);
}

#[test]
fn loads_do_not_lead_through_a_snap() {
    let row = under_displacement().expect("a row");
    assert!(row.failing.value > 0.3, "{}", row.failing.text);
    assert!(row.product.value < 1e-3, "{}", row.product.text);
}

/// A load put on at once needs less than one at rest: where the work of the load meets the energy of the
/// bars.
#[test]
fn a_step_load_snaps_a_damped_truss_to_its_other_equilibrium() {
    for (part, other) in [(0.6, false), (0.9, true)] {
        let force = part * limit().0;
        let mut scene = truss(force);
        scene["initial"] = json!("undeformed");
        for body in 0..2 {
            scene["bodies"][body]["material"]["damping_time"] = json!(1e-3);
        }
        let wanted = if other {
            height(force, -0.1, -1.0)
        } else {
            height(force, limit().1, TRUSS[1])
        };
        let mut product = Product::start(&scene).expect("a scene");
        let first = product.balance().expect("energies");
        product.step(20.0).expect("a step");
        let [x, y] = product.position("left.b").expect("a position");
        assert!(
            x.abs() < 1e-6 && (y - wanted).abs() < 1e-5,
            "{part}: {y} instead of {wanted}"
        );
        let lost = product.balance().expect("energies") - first;
        assert!(lost.abs() < 1e-2 * force * (TRUSS[1] - y), "{lost} J");
    }
}
