//! Beams that spin fast about their axes: implicit steps are those of a rod, whose only coordinate of a section is its rotation about the
//! tangent. What shear adds is stiff and, damped, soon at rest.

use serde_json::{Value, json};

use crate::laws::moved::simulation;

/// A free rod or beam that is thrown with bending and spins about its axis.
struct Thrown {
    youngs_modulus: f64,
    density: f64,
    second_moments: [f64; 2],
    damping_time: f64,
    tolerance: f64,
}

const SOFT: Thrown = Thrown {
    youngs_modulus: 5e6,
    density: 1000.0,
    second_moments: [1.6667e-9, 6.6667e-9],
    damping_time: 1e-4,
    tolerance: 1e-8,
};

/// A strip whose bending stiffnesses are 1 to 25, of waves of shear a hundred times faster than its rotations.
const STEEL: Thrown = Thrown {
    youngs_modulus: 2e11,
    density: 8000.0,
    second_moments: [1e-10, 2.5e-9],
    damping_time: 1e-7,
    tolerance: 1e-4,
};

impl Thrown {
    fn scene(&self, element: &str) -> Value {
        let [flat, edge] = self.second_moments;
        let mut section =
            json!({"area": 2e-4, "second_moments": [flat, edge], "torsion_constant": 4.58e-9});
        if element == "beam" {
            section["shear_factors"] = json!([0.8, 0.6]);
        }
        json!({"name": "thrown", "dimension": 3, "gravity": [0.0, 0.0, 0.0],
               "bodies": [{"name": "rod", "element": element, "elements": 4, "section": section, "axis": [0.0, 1.0, 0.0],
                           "material": {"youngs_modulus": self.youngs_modulus, "shear_modulus": 0.4 * self.youngs_modulus,
                                        "density": self.density, "damping_time": self.damping_time},
                           "shape": {"line": {"from": [0.0, 0.0, 0.0], "to": [1.0, 0.0, 0.0]}},
                           "motion": {"spin": [200.0, 3.0, 5.0], "deformation": ["0", "0.5*sin(PI*s)", "0.3*cos(2*PI*s)"]},
                           "markers": {"tip": 1.0}}],
               "outputs": [{"kind": "position", "marker": "rod.tip"}],
               "accuracy": {"relative_tolerance": self.tolerance}, "method": {"integrator": "radau"}})
    }

    /// Attempted steps and Newton iterations over a time, s.
    fn work(&self, element: &str, time: f64) -> [f64; 2] {
        let mut simulation = simulation(&self.scene(element));
        simulation.step(time).expect("a step");
        let report = simulation.report();
        [report.steps + report.rejected, report.newton_iterations].map(|count| count as f64)
    }

    fn holds(&self, time: f64, most: [f64; 2]) {
        let [rod, beam] = ["rod", "beam"].map(|element| self.work(element, time));
        for (k, of) in ["attempts", "iterations"].iter().enumerate() {
            let ratio = beam[k] / rod[k];
            assert!(
                ratio < most[k],
                "{of}: {} of a rod, {} of a beam",
                rod[k],
                beam[k]
            );
        }
    }
}

/// As rotations about sections' axes (a vector of Rodrigues) the spin alone would take twice the steps, and corrections in which rotations
/// were taken for spins a hundred times in the stiff one.
#[test]
fn a_beam_that_spins_fast_takes_the_steps_of_a_rod() {
    SOFT.holds(0.05, [1.7, 2.4]);
    STEEL.holds(0.02, [1.5, 2.0]);
}
