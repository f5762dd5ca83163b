//! Prices of the operations of an implicit method in accelerations, by which methods are compared.
//!
//! Along chains of elements all operations grow with the elements, and constants say what they cost. On surfaces and in nets elimination fills
//! in: factors and solves there are priced by the products that the pattern asks for besides, tangents by the elements.

use crate::bodies::{Bodies, Elimination};
use crate::math::sparse::FactorWork;

/// Costs of operations along chains in accelerations: medians over 15 scenes with 1 to 16 elements, which scatter by a factor of 2
/// (docs/decisions/0034-integrator-by-counted-cost.md).
const LINEARIZE: f64 = 2.5;
const FACTOR: f64 = 0.6;
const FACTOR_COMPLEX: f64 = 1.5;
const SOLVE: f64 = 0.5;
const SOLVE_STAGES: f64 = 2.5;

/// Costs of a product in line elements ([`Bodies::cost_units`]) where elimination fills in, of real and of complex numbers
/// (docs/decisions/0077-speed-of-plates.md).
const PANELS: [f64; 2] = [1.2e-3, 4.0e-3];
const APART: [f64; 2] = [4.0e-3, 1.2e-2];
const SUBSTITUTED: [f64; 2] = [5.0e-3, 1.5e-2];
/// Cost of an entry of the factor of the mass in line elements. Most entries go three directions at once.
const OF_MASS: f64 = 6e-4;

/// Substitutions with the factor of the mass of an acceleration, and with that of a matrix for each solve.
const ACCELERATION_SWEEPS: f64 = 2.0;
const SOLVE_SWEEPS: f64 = 2.0;

/// Prices in accelerations.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::system) struct Prices {
    /// Price of a tangent.
    pub linearize: f64,
    /// Price of real factors.
    pub factor: f64,
    /// Price of complex factors.
    pub factor_complex: f64,
    /// Price of a solve with real factors.
    pub solve: f64,
    /// Price of a solve for three stages.
    pub solve_stages: f64,
}

/// Solves of three stages in an implicit step, each with an acceleration for every stage.
const ITERATIONS: f64 = 3.0;

/// Prices along chains.
const CHAIN: Prices = Prices {
    linearize: LINEARIZE,
    factor: FACTOR,
    factor_complex: FACTOR_COMPLEX,
    solve: SOLVE,
    solve_stages: SOLVE_STAGES,
};

impl Prices {
    /// Price of an implicit step over that along a chain.
    pub fn beside_chain(&self) -> f64 {
        self.step() / CHAIN.step()
    }

    fn step(&self) -> f64 {
        let once = self.linearize + self.factor + self.factor_complex;
        once + ITERATIONS * (self.solve_stages + 3.0)
    }

    /// Prices where an acceleration costs so many line elements without its solves.
    pub fn new<const D: usize>(
        parts: usize,
        bodies: &Bodies<D>,
        elimination: &Elimination<D>,
    ) -> Self {
        let assembly = &elimination.assembly;
        let (mass, matrix) = (assembly.of_mass().work(), assembly.pattern().work());
        let of_mass = OF_MASS * mass.entries;
        let acceleration = parts as f64 + ACCELERATION_SWEEPS * of_mass;
        let factor =
            |FactorWork {
                 in_panels, apart, ..
             }: FactorWork,
             k: usize| { (PANELS[k] * in_panels + APART[k] * apart) / acceleration };
        let sweeps = |k: usize| SOLVE_SWEEPS * SUBSTITUTED[k] * matrix.entries / acceleration;
        // Forces and coordinates pass through the mass.
        let through = SOLVE_SWEEPS * of_mass / acceleration;
        Self {
            linearize: LINEARIZE + bodies.tangent_cost() as f64 / acceleration,
            factor: FACTOR + factor(matrix, 0),
            factor_complex: FACTOR_COMPLEX + factor(matrix, 1),
            solve: SOLVE + sweeps(0) + through,
            solve_stages: SOLVE_STAGES + sweeps(0) + sweeps(1) + 3.0 * through,
        }
    }
}
