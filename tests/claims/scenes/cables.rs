//! Cables: material, section, strain measures, elements, and the forces inside.

use serde_json::{Value, json};

use super::times;
use crate::claims::specimen::Specimen;

pub fn all() -> Vec<Specimen> {
    vec![
        bent("thetaPrime"),
        bent("engStrain_FrenetKappa"),
        bent("GreenLagrange_FrenetKappa"),
        default_strain(),
        stretched(),
        let_go(),
        cantilever(),
        loaded_at_the_tip(),
        pulled_apart(),
        settled(),
    ]
}

fn cable(name: &str, elements: u32, of: [f64; 4], from: [f64; 2], to: [f64; 2]) -> Value {
    let [youngs_modulus, density, area, second_moment] = of;
    json!({"element": "cable", "name": name, "elements": elements,
           "material": {"youngs_modulus": youngs_modulus, "density": density},
           "section": {"area": area, "second_moment": second_moment},
           "shape": {"line": {"from": from, "to": to}}, "markers": {"root": 0.0, "middle": 0.5, "tip": 1.0}})
}

const MOMENT: f64 = 1.2;
const LENGTH: f64 = 0.5;
const AXIAL: f64 = 100.0;
const BENDING: f64 = 0.9;

/// A clamped cable under a moment at its tip, EA = 100 N, EI = 0.9 N m^2.
fn bent_scene(name: &str) -> Value {
    let of = [5000.0, 1000.0, AXIAL / 5000.0, BENDING / 5000.0];
    json!({
        "name": name, "dimension": 2, "initial": "static_equilibrium",
        "bodies": [cable("rod", 8, of, [0.0, 0.0], [LENGTH, 0.0])],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "rod.root"]}],
        "loads": [{"name": "twist", "kind": "moment", "marker": "rod.tip", "value": MOMENT}],
        "outputs": [{"kind": "angle", "marker": "rod.tip"}, {"kind": "position", "marker": "rod.tip"},
                    {"kind": "curvature", "marker": "rod.middle"}, {"kind": "strain", "marker": "rod.middle"},
                    {"kind": "bending_moment", "marker": "rod.middle"},
                    {"kind": "axial_force", "marker": "rod.middle"},
                    {"kind": "reaction_moment", "joint": "clamp"}, {"kind": "energy"}]})
}

/// The stretch l makes the energy of strain and curvature stationary under the moment. With rotation per
/// reference length it is 1; with the curvature of the deformed line, `kappa = theta' / l = M l / EI`, it
/// follows from `EA (l - 1) = M^2 l / EI`, and with Green's strain from `EA (l^2 - 1) / 2 = M^2 / EI`.
fn bent(strain: &'static str) -> Specimen {
    let mut scene = bent_scene(strain);
    scene["bodies"][0]["strain"] = json!(strain);
    bent_claims(Specimen::new(strain, scene), strain)
}

/// Without a word it is rotation per reference length.
fn default_strain() -> Specimen {
    bent_claims(
        Specimen::new("default_strain", bent_scene("default_strain")),
        "thetaPrime",
    )
}

fn bent_claims(specimen: Specimen, strain: &str) -> Specimen {
    let share = MOMENT * MOMENT / (AXIAL * BENDING);
    let stretch = match strain {
        "thetaPrime" => 1.0,
        "engStrain_FrenetKappa" => 1.0 / (1.0 - share),
        _ => (1.0 + 2.0 * share).sqrt(),
    };
    let (curvature, axial) = match strain {
        "thetaPrime" => (MOMENT / BENDING, 0.0),
        "engStrain_FrenetKappa" => (MOMENT * stretch / BENDING, stretch - 1.0),
        _ => (MOMENT * stretch / BENDING, 0.5 * (stretch * stretch - 1.0)),
    };
    let turn = stretch * curvature * LENGTH;
    // On a circle of the curvature theta' / l.
    let radius = stretch * LENGTH / turn;
    let energy = 0.5 * LENGTH * (AXIAL * axial * axial + BENDING * curvature * curvature);
    let specimen = specimen
        .claim_within("rod.tip.angle", "rad", turn, 1e-5)
        .vector_within(
            "rod.tip.position",
            "m",
            times(radius, [turn.sin(), 1.0 - turn.cos()]),
            1e-5,
        )
        .claim_within("rod.middle.curvature", "1/m", curvature, 1e-3)
        .claim_within("rod.middle.strain", "", axial, 1e-4)
        .claim_within("clamp.reaction_moment", "N.m", -MOMENT, 1e-6)
        .claim_within("energy.strain", "J", energy, 1e-5);
    match strain {
        "thetaPrime" => specimen
            .claim_within("rod.middle.bending_moment", "N.m", MOMENT, 1e-3)
            .claim_within("rod.middle.axial_force", "N", 0.0, 1e-2),
        _ => specimen,
    }
}

/// A straight cable, inclined, pulled at its tip along its line.
fn stretched() -> Specimen {
    let (e, area, length, pull) = (4000.0, 0.05, 0.5, 30.0);
    let along = [0.6, 0.8];
    let scene = json!({
        "name": "stretched", "dimension": 2, "initial": "static_equilibrium",
        "bodies": [cable("rod", 2, [e, 1000.0, area, 1e-3], [0.0, 0.0], times(length, along)),
                   cable("other", 2, [e, 1000.0, area, 1e-3], [2.0, 0.0], [2.5, 0.0])],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"]},
                   {"name": "clamp", "kind": "weld", "markers": ["ground", "other.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "rod.tip", "value": times(pull, along)},
                  {"name": "push", "kind": "force", "marker": "other.tip", "value": [-pull, 0.0]}],
        "outputs": [{"kind": "position", "marker": "rod.tip"}, {"kind": "strain", "marker": "rod.middle"},
                    {"kind": "axial_force", "marker": "rod.middle"}, {"kind": "axial_force", "marker": "other.middle"},
                    {"kind": "connectivity_force", "marker": "rod.middle"}, {"kind": "reaction", "joint": "pin"},
                    {"kind": "strain", "marker": "other.middle"}, {"kind": "energy"}]});
    let strain = pull / (e * area);
    Specimen::new("stretched", scene)
        .vector(
            "rod.tip.position",
            "m",
            times(length * (1.0 + strain), along),
        )
        .claim("rod.middle.strain", "", strain)
        .claim("other.middle.strain", "", -strain)
        .claim_within("rod.middle.axial_force", "N", pull, 1e-7)
        .claim_within("other.middle.axial_force", "N", -pull, 1e-7)
        .vector_within(
            "rod.middle.connectivity_force",
            "N",
            times(-pull, along),
            1e-7,
        )
        .vector_within("pin.reaction", "N", times(-pull, along), 1e-7)
        .claim("energy.strain", "J", pull * strain * length)
}

/// Without a word a scene starts from unstressed shapes, whatever acts, and nothing damps.
fn let_go() -> Specimen {
    let (e, area, pull) = (4000.0, 0.05, 30.0);
    let scene = json!({
        "name": "let_go", "dimension": 2,
        "bodies": [cable("rod", 2, [e, 1000.0, area, 1e-3], [0.0, 0.0], [0.3, 0.4])],
        "joints": [{"name": "pin", "kind": "revolute", "markers": ["ground", "rod.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "rod.tip", "value": [0.6 * pull, 0.8 * pull]}],
        "outputs": [{"kind": "position", "marker": "rod.tip"}, {"kind": "strain", "marker": "rod.middle"},
                    {"kind": "work"}]});
    Specimen::new("let_go", scene)
        .vector("rod.tip.position", "m", [0.3, 0.4])
        .claim("rod.middle.strain", "", 0.0)
        .at(0.05)
        // Without damping nothing is lost.
        .claim("energy.dissipated", "J", 0.0)
}

/// A clamped beam under a small uniform load, EI = 1 N m^2. Cubic elements are exact at their nodes and
/// lack the energy of a clamped beam of their own length inside: `q^2 L^5 (1/40 - 1/(1440 n^4)) / EI`.
fn cantilever() -> Specimen {
    let (q, n) = (1e-4, 2);
    let scene = json!({
        "name": "cantilever", "dimension": 2, "initial": "static_equilibrium",
        "bodies": [cable("beam", n, [1e6, 1000.0, 1e-3, 1e-6], [0.0, 0.0], [1.0, 0.0])],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "beam.root"]}],
        "loads": [{"name": "snow", "kind": "distributed_force", "body": "beam", "value": [0.0, -q]}],
        "outputs": [{"kind": "position", "marker": "beam.tip"}, {"kind": "angle", "marker": "beam.tip"},
                    {"kind": "connectivity_force", "marker": "beam.middle"}, {"kind": "energy"},
                    {"kind": "reaction", "joint": "clamp"}, {"kind": "reaction_moment", "joint": "clamp"}]});
    let energy = q * q * (1.0 / 40.0 - 1.0 / (1440.0 * f64::from(n).powi(4)));
    Specimen::new("cantilever", scene)
        .claim_within("energy.strain", "J", energy, 1e-5 * energy)
        .claim_within("beam.tip.position[2]", "m", -q / 8.0, 1e-5 * q)
        .claim_within("beam.tip.angle", "rad", -q / 6.0, 1e-5 * q)
        .claim_within("beam.middle.connectivity_force[2]", "N", 0.5 * q, 1e-5 * q)
        .claim_within("clamp.reaction[2]", "N", q, 1e-6 * q)
        .claim_within("clamp.reaction_moment", "N.m", 0.5 * q, 1e-6 * q)
}

/// A clamped beam under a small force across it at its tip, EI = 1 N m^2: `M = -F (L - s)`, which cubic
/// elements give exactly.
fn loaded_at_the_tip() -> Specimen {
    let force = 1e-4;
    let scene = json!({
        "name": "loaded_at_the_tip", "dimension": 2, "initial": "static_equilibrium",
        "bodies": [cable("beam", 2, [1e6, 1000.0, 1e-3, 1e-6], [0.0, 0.0], [1.0, 0.0])],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "beam.root"]}],
        "loads": [{"name": "pull", "kind": "force", "marker": "beam.tip", "value": [0.0, -force]}],
        "outputs": [{"kind": "curvature", "marker": "beam.middle"}, {"kind": "bending_moment", "marker": "beam.middle"},
                    {"kind": "position", "marker": "beam.tip"}]});
    Specimen::new("loaded_at_the_tip", scene)
        .claim_within("beam.middle.curvature", "1/m", -0.5 * force, 1e-5 * force)
        .claim_within(
            "beam.middle.bending_moment",
            "N.m",
            -0.5 * force,
            1e-5 * force,
        )
        .claim_within("beam.tip.position[2]", "m", -force / 3.0, 1e-5 * force)
}

/// A bar of Kelvin-Voigt material whose end is drawn away with constant speed: once its vibration is gone,
/// strain and rate of strain are uniform. The slowest vibration is damped critically and falls by exp(-40).
fn pulled_apart() -> Specimen {
    let (e, area, tau, speed, length) = (1000.0, 0.02, 0.05, 0.2, 1.0);
    let density = e * (std::f64::consts::PI / (40.0 * length)).powi(2);
    let mut bar = cable(
        "bar",
        3,
        [e, density, area, 1e-4],
        [0.0, 0.0],
        [length, 0.0],
    );
    bar["material"]["damping_time"] = json!(tau);
    let scene = json!({
        "name": "pulled_apart", "dimension": 2, "accuracy": {"relative_tolerance": 1e-8}, "bodies": [bar],
        "joints": [{"name": "clamp", "kind": "weld", "markers": ["ground", "bar.root"]},
                   {"name": "guide", "kind": "orientation", "markers": ["ground", "bar.tip"]}],
        "motions": [{"name": "draw", "kind": "position", "marker": "bar.tip", "value": [format!("1+{speed}*t"), 0.0]}],
        "outputs": [{"kind": "axial_force", "marker": "bar.middle"}, {"kind": "reaction", "motion": "draw"},
                    {"kind": "strain", "marker": "bar.middle"}]});
    let force = |t: f64| e * area * (speed * t + tau * speed) / length;
    Specimen::new("pulled_apart", scene)
        .at(1.0)
        .claim_within("bar.middle.strain", "", speed, 1e-5)
        .claim_within("bar.middle.axial_force", "N", force(1.0), 1e-3)
        .claim_within("draw.reaction[1]", "N", force(1.0), 1e-3)
}

/// Bars without damping of their own that begin to stretch in their first axial modes, at the rate `v`: damped critically,
/// what stretches goes as `v t exp(-omega t)`, and all that it began with is lost. One is held at one end, one is free. One that rings and
/// a beam that begins to bend go on for ever.
fn settled() -> Specimen {
    use std::f64::consts::PI;
    let (e, density, area, second_moment) = (1000.0, 250.0, 0.02, 1e-4);
    let bar = |name: &str, y: f64, deformation: [&str; 2]| {
        let of = [e, density, area, second_moment];
        let mut bar = cable(name, 8, of, [0.0, y], [1.0, y]);
        bar["axial"] = json!(if name == "rings" {
            "waves"
        } else {
            "critically_damped"
        });
        bar["motion"] = json!({"deformation": deformation});
        bar
    };
    let pin =
        |name: &str, at: &str| json!({"name": name, "kind": "revolute", "markers": ["ground", at]});
    let guide = json!({"name": "guide", "kind": "point_on_line", "markers": ["ground", "beam.tip"], "direction": [1.0, 0.0]});
    let outputs = ["held.tip", "free.root", "beam.middle", "rings.root"];
    let mut outputs = outputs
        .map(|at| json!({"kind": "position", "marker": at}))
        .to_vec();
    outputs.push(json!({"kind": "work"}));
    let scene = json!({
        "name": "settled", "dimension": 2, "accuracy": {"relative_tolerance": 1e-8},
        "bodies": [bar("held", 0.0, ["0.01*sin(PI*s/2)", "0"]), bar("free", 1.0, ["0.01*cos(PI*s)", "0"]),
                   bar("beam", 2.0, ["0", "0.001*sin(PI*s)"]), bar("rings", 3.0, ["0.01*cos(PI*s)", "0"])],
        "joints": [pin("pin", "held.root"), pin("other", "beam.root"), guide],
        "outputs": outputs});
    let (speed, sound, time) = (0.01, (e / density).sqrt(), 0.3);
    let way = |omega: f64, t: f64| speed * t * (-omega * t).exp();
    let bending = PI * PI * (e * second_moment / (density * area)).sqrt();
    let across = |t: f64| 2.0 + 0.1 * speed / bending * (bending * t).sin();
    // Of both bars: half their mass times the square of the speed, half of it in the mean.
    let lost = 2.0 * 0.25 * density * area * speed * speed;
    Specimen::new("settled", scene)
        .at(time)
        .claim_within(
            "held.tip.position[1]",
            "m",
            1.0 + way(0.5 * PI * sound, time),
            1e-6,
        )
        .claim_within(
            "rings.root.position[1]",
            "m",
            speed / (PI * sound) * (PI * sound * time).sin(),
            1e-6,
        )
        .claim_within("free.root.position[1]", "m", way(PI * sound, time), 1e-6)
        .at(5.0)
        .claim_within("beam.middle.position[2]", "m", across(5.0), 1e-6)
        .claim_within("energy.dissipated", "J", lost, 1e-4 * lost)
}
