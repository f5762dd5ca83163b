//! Rotations among the coordinates of bodies that rotate on and on.

use crate::laws::runs::Run;

/// Rotations among the coordinates begin at zero anew before they are large: their equations are singular at full turns.
#[test]
fn rotations_among_the_coordinates_stay_small_over_many_turns() {
    let spin = [5.0, -3.0, 4.0];
    let scene = serde_json::json!({"name": "spins", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
        "bodies": [{"element": "rigid", "name": "ball", "mass": 1.0, "inertia": [1.0, 1.0, 1.0], "position": [0.0, 0.0, 0.0],
                    "motion": {"spin": spin}, "markers": {"c": [0.0, 0.0, 0.0]}}],
        "outputs": [{"kind": "position", "marker": "ball.c"}], "accuracy": {"relative_tolerance": 1e-4}});
    let mut run = Run::started(&scene);
    let mut largest = 0.0_f64;
    for k in 1..=200 {
        run.step(0.01 * f64::from(k));
        // Of one kilogram and unit inertia coordinates are metres and radians.
        let coordinates = run.snapshot().state.coordinates;
        let size = coordinates.iter().map(|q| q * q).sum::<f64>().sqrt();
        largest = largest.max(size);
    }
    assert!(largest > 0.1 && largest < 0.6, "{largest}");
}
