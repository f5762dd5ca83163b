//! Damping of rods whose stretching is coupled with twist, where the times of both differ.

use serde_json::json;

use crate::laws::runs::Run;

/// A rod that is stretched at a constant rate and does not rotate: with the times `a` of stretching and `b` of twist the torque is
/// `C (e + sqrt(a b) e')`, so that the matrix of damping has the sign of that of stiffness.
#[test]
fn the_torque_of_a_rod_that_is_stretched_is_damped_by_the_mean_of_both_times() {
    let (length, area, young, density) = (1.0, 1e-4, 1e6, 500.0);
    let (coupling, rate, twist_time) = (0.4, 0.05, 0.004_f64);
    // Held at both ends: the first axial mode is damped critically.
    let speed = f64::sqrt(young / density);
    let axial_time = 2.0 * length / (std::f64::consts::PI * speed);
    assert!(axial_time > 3.0 * twist_time);
    let scene = json!({"name": "pulled", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
        "bodies": [{"element": "rod", "name": "line", "elements": 4, "axial": "critically_damped",
            "material": {"youngs_modulus": young, "shear_modulus": 4e5, "density": density, "damping_time": twist_time},
            "section": {"area": area, "second_moments": [1e-9, 1e-9], "torsion_constant": 2e-8, "axial_coupling": [coupling, 0.0, 0.0]},
            "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [length, 0.0, 0.0]}}, "markers": {"root": 0.0, "tip": 1.0}}],
        "joints": [{"name": "wall", "kind": "weld", "markers": ["ground", "line.root"]},
                   {"name": "rail", "kind": "prismatic", "markers": ["ground", "line.tip"], "direction": [1.0, 0.0, 0.0],
                    "point": [length, 0.0, 0.0]}],
        "motions": [{"name": "pull", "kind": "displacement", "joint": "rail", "value": format!("{rate}*t")}],
        "outputs": [{"kind": "reaction_moment", "joint": "wall"}, {"kind": "reaction", "joint": "wall"}],
        "accuracy": {"relative_tolerance": 1e-8}});
    let mut run = Run::started(&scene);
    // Waves along the rod and twist inside it have come to rest.
    let t = 1.5;
    (1..=15).for_each(|k| run.step(0.1 * f64::from(k)));
    let strain = rate * t / length;
    let turned = coupling * (strain + (axial_time * twist_time).sqrt() * rate / length);
    let pulled = young * area * (strain + axial_time * rate / length);
    // On the first end both act the other way.
    let [torque, force] =
        ["wall.reaction_moment[1]", "wall.reaction[1]"].map(|name| run.read(name));
    assert!(
        (torque.abs() / turned - 1.0).abs() < 1e-5,
        "{torque} {turned}"
    );
    assert!(
        (force.abs() / pulled - 1.0).abs() < 1e-5,
        "{force} {pulled}"
    );
}
