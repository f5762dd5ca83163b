//! Fastest oscillation and decay of a system, which bound the steps of explicit methods.

use crate::math::eigen::symmetric_eigenvalues;
use crate::math::vector::{dot, norm};
use crate::system::{DrivenSystem, Dynamics, State, System, Workspace};

/// Steps of the Lanczos iteration, and what is added to its largest value, which it nears from below.
const STEPS: usize = 40;
const MARGIN: f64 = 1.02;

/// Fastest oscillation (rad/s) and fastest decay (1/s) at a state, from a few Lanczos steps with
/// stiffness and damping.
///
/// Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., section 10.1.
pub fn fastest<const D: usize>(
    system: &System<D>,
    inputs: &[f64],
    work: &mut Workspace<D>,
    state: &State,
) -> (f64, f64) {
    let n = state.rates.len();
    let rest = vec![0.0; n];
    DrivenSystem::new(system, inputs, work, state).linearize(state.time, &state.coordinates, &rest);
    let (tangent, elimination) = (&mut work.linearization.tangent, &system.elimination);
    let stiffest = largest_eigenvalue(n, |x| tangent.apply_stiffness(elimination, x));
    let decay = if system.is_damped {
        largest_eigenvalue(n, |x| tangent.apply_damping(elimination, x))
    } else {
        0.0
    };
    (stiffest.sqrt(), decay)
}

/// Largest eigenvalue of a symmetric operator, nearly.
pub(super) fn largest_eigenvalue(n: usize, mut apply: impl FnMut(&mut [f64])) -> f64 {
    let steps = STEPS.min(n);
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    };
    let mut v: Vec<f64> = (0..n).map(|_| random()).collect();
    let mut before = vec![0.0; n];
    let (mut diagonal, mut off) = (Vec::new(), Vec::new());
    let mut beta = norm(&v);
    for _ in 0..steps {
        if beta <= 0.0 || !beta.is_finite() {
            break;
        }
        v.iter_mut().for_each(|x| *x /= beta);
        let mut w = v.clone();
        apply(&mut w);
        let alpha = dot(&v, &w);
        for i in 0..n {
            w[i] -= alpha * v[i]
                + if diagonal.is_empty() {
                    0.0
                } else {
                    beta * before[i]
                };
        }
        diagonal.push(alpha);
        before = std::mem::replace(&mut v, w);
        beta = norm(&v);
        if beta <= 1e-12 * alpha.abs() {
            break;
        }
        off.push(beta);
    }
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => off[i.min(j)],
        _ => 0.0,
    };
    let values = symmetric_eigenvalues(diagonal.len(), entry).unwrap_or_default();
    let largest = values.last().copied().unwrap_or(0.0);
    // A limit of a step is a quotient by it: a negative zero would make one of minus infinity.
    if largest > 0.0 { MARGIN * largest } else { 0.0 }
}
