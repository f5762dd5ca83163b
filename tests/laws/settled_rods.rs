//! Static equilibria of rods that carry bodies.

use flexbody::scene::Scene;
use flexbody::simulation::Simulation;
use serde_json::{Value, json};

use crate::laws::differences::Outcome;
use crate::laws::moved::simulation;
use crate::laws::moved_rods::{AT_START, GRAVITY, line, read, rod, same};

/// A clamped rod that carries a body at its tip, and one under the weight and the moment of that body instead: in
/// equilibrium both are the same. The moment has no potential, and the body no stiffness but that of its joint.
fn carrying(moment: [f64; 3], kind: &str) -> Outcome {
    const MASS: f64 = 0.2;
    let shape = line([0.0, 0.0, 0.0], [1.0, 0.2, 0.1]);
    let arm = rod("arm", 4, shape, [0.0, 0.1, 1.0]);
    // On a ball it hangs below and would rotate under a moment of its own.
    let (above, on) = match kind {
        "weld" => (0.0, "bob.eye"),
        _ => (0.05, "arm.tip"),
    };
    let bob = json!({"name": "bob", "element": "rigid", "mass": MASS, "inertia": [1e-5, 2e-5, 2e-5],
                     "position": [1.0, 0.2, 0.1 - above], "markers": {"eye": [0.0, 0.0, above]}});
    let wall = json!({"name": "wall", "kind": "weld", "markers": ["ground", "arm.root"]});
    let end = json!({"name": "end", "kind": kind, "markers": ["arm.tip", "bob.eye"]});
    let weight = GRAVITY.map(|g| MASS * g);
    let twist =
        |on: &str| json!({"name": "twist", "kind": "moment", "marker": on, "value": moment});
    let all = |bodies: &[&Value], joints: &[&Value], loads: &[Value]| {
        json!({"name": "carrying", "dimension": 3, "gravity": GRAVITY, "bodies": bodies, "joints": joints,
               "loads": loads, "initial": "static_equilibrium",
               "outputs": read(&["position", "orientation"], "marker", &["arm.mid", "arm.tip"])})
    };
    let carried = all(&[&arm, &bob], &[&wall, &end], &[twist(on)]);
    let force = json!({"name": "weight", "kind": "force", "marker": "arm.tip", "value": weight});
    let loaded = all(&[&arm], &[&wall], &[twist("arm.tip"), force]);
    let (mut a, mut b) = (simulation(&carried), simulation(&loaded));
    same([&mut a, &mut b], |_, of| of.to_vec(), AT_START)
}

#[test]
fn rods_settle_under_a_body_as_under_its_weight() {
    for moment in [
        [1e-9, 2e-9, -1.5e-9],
        [0.01, 0.02, -0.015],
        [-0.2, 0.4, 0.6],
    ] {
        for kind in ["weld", "spherical"] {
            carrying(moment, kind).unwrap_or_else(|error| panic!("{kind}, {moment:?}: {error}"));
        }
    }
}

/// A body on a ball below a rod of this bending stiffness, N m^2, driven about the upright by a moment, N m: what is told when it is to
/// settle.
fn driven_about_the_upright(stiffness: f64, moment: f64, gravity: f64) -> String {
    let mut arm = rod("arm", 4, line([0.0; 3], [1.0, 0.0, 0.0]), [0.0, 0.0, 1.0]);
    if stiffness > 0.0 {
        arm["material"] = json!({"youngs_modulus": 1e9, "shear_modulus": 5e8, "density": 1000.0});
        let (second, torsion) = (stiffness / 1e9, 2.0 * stiffness / 1e9);
        arm["section"] =
            json!({"area": 1e-4, "second_moments": [second, second], "torsion_constant": torsion});
    }
    let bob = json!({"name": "bob", "element": "rigid", "mass": 1.0, "inertia": [0.1, 0.1, 0.1],
                     "position": [1.0, 0.0, -0.3], "markers": {"eye": [0.0, 0.0, 0.3]}});
    let scene = json!({"name": "driven", "dimension": 3, "gravity": [0.0, 0.0, -gravity], "bodies": [arm, bob],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "arm.root"]},
                   {"name": "ball", "kind": "spherical", "markers": ["arm.tip", "bob.eye"]}],
        "loads": [{"name": "drive", "kind": "moment", "marker": "bob.eye", "value": [0.0, 0.0, moment]}],
        "initial": "static_equilibrium"});
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let told = Simulation::new(scene).initialize(0.0);
    told.map_or_else(|error| error.to_string(), |_| "an equilibrium".into())
}

/// On a ball below a rod a body that a moment drives about the upright rotates for ever, however small the moment is.
#[test]
fn what_turns_for_ever_has_no_equilibrium() {
    for moment in [1e-6, 0.1] {
        let told = driven_about_the_upright(0.0, moment, 9.81);
        assert!(told.contains("no static equilibrium"), "{moment}: {told}");
    }
}

/// Newton's corrections end below roundoff of the body's size where a percent of its weight is left: what is left tells.
#[test]
fn where_forces_are_left_there_is_no_equilibrium_however_small_corrections_are() {
    for (stiffness, moment, gravity) in [(3.183, 3.888e-13, 1.095e-2), (2.766, 2.546e-12, 1.341e-2)]
    {
        let told = driven_about_the_upright(stiffness, moment, gravity);
        assert!(told.contains("on `bob`"), "{moment}: {told}");
    }
}
