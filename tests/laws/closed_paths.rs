//! Frames of rods and beams are functions of the configuration: led round a closed path slowly, a tip is held as before.

use nalgebra::Vector3;
use serde_json::json;

use crate::laws::moved::simulation;
use crate::laws::moved_rods::outputs;

/// Forces and moments on a plate at the tip of a line that a plate leads about: up and down, aside, and about two axes that do not
/// commute, out and back on another way. Before it, on the way and after it.
fn led(element: &str) -> [[Vector3<f64>; 2]; 3] {
    let mut section =
        json!({"area": 1e-4, "second_moments": [1e-9, 3e-9], "torsion_constant": 1.5e-9});
    if element == "beam" {
        section["shear_factors"] = json!([0.9, 0.9]);
    }
    // Round a circle of the plane of both angles, from rest to rest.
    let way = "(2*PI*(1-exp(-2*t^2)))";
    let (a, b) = (format!("0.6*(1-cos({way}))"), format!("0.8*sin({way})"));
    let turn = [
        format!("cos({a}/2)*cos({b}/2)"),
        format!("sin({a}/2)*cos({b}/2)"),
        format!("cos({a}/2)*sin({b}/2)"),
        format!("sin({a}/2)*sin({b}/2)"),
    ];
    let place = [
        format!("0.35-0.05*(1-cos({way}))"),
        format!("0.05+0.1*sin({way})"),
        format!("0.08*sin({way})"),
    ];
    let scene = json!({"name": "led", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
        "bodies": [{"name": "line", "element": element, "elements": 4,
            "material": {"youngs_modulus": 1e6, "shear_modulus": 4e5, "density": 1000.0, "damping_time": 0.05},
            "section": section, "axis": [0.0, 0.3, 1.0],
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [0.35, 0.05, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}},
            {"name": "plate", "element": "rigid", "mass": 0.1, "inertia": [1e-4, 1e-4, 1e-4], "position": [0.35, 0.05, 0.0],
             "markers": {"hub": [0.0, 0.0, 0.0]}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]},
                   {"name": "hold", "kind": "weld", "markers": ["plate.hub", "line.tip"]}],
        "motions": [{"name": "place", "kind": "position", "marker": "plate.hub", "value": place},
                    {"name": "turn", "kind": "orientation", "marker": "plate.hub", "value": turn}],
        "loads": [{"name": "pull", "kind": "distributed_force", "body": "line", "value": [0.0, 0.01, 0.02]}],
        "outputs": [{"kind": "reaction", "joint": "wall"}, {"kind": "reaction_moment", "joint": "wall"}],
        "initial": "static_equilibrium", "method": {"integrator": "radau"},
        "accuracy": {"relative_tolerance": 1e-6}});
    let mut simulation = simulation(&scene);
    [0.0, 0.6, 4.0].map(|until| {
        if until > 0.0 {
            simulation.step(until).expect("a step");
        }
        let mut read = outputs(&mut simulation).into_iter();
        [(); 2].map(|()| Vector3::from_vec(read.next().expect("a reaction").1))
    })
}

#[test]
fn a_closed_path_of_the_tip_returns_its_forces() {
    for element in ["rod", "beam"] {
        let [before, away, after] = led(element);
        for k in 0..2 {
            let moved = (away[k] - before[k]).norm();
            let left = (after[k] - before[k]).norm();
            assert!(
                left <= 1e-5 * moved,
                "{element}: {left:.2e} of {moved:.2e} is left"
            );
        }
    }
}
