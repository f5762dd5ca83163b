//! Natural frequencies about a configuration, and how fast a system is at most.

use nalgebra::DMatrix;

use super::{Dynamics, Model, State, System, Work};
use crate::math::eigen::{eigenvalues, symmetric_eigenvalues};
use crate::math::vector::{dot, norm};

/// Steps of the Lanczos iteration, and what is added to its largest value, which it nears from below.
const STEPS: usize = 40;
const MARGIN: f64 = 1.02;

/// Lowest natural frequencies at rest, rad/s; unstable ones negative.
///
/// In a turning frame they are those of `q'' + G q' + K q = 0` with the gyroscopic matrix `G`.
pub fn natural_frequencies(
    system: &System,
    inputs: &[f64],
    work: &mut Work,
    state: &State,
    count: usize,
) -> Vec<f64> {
    let n = state.rates.len();
    let rest = vec![0.0; n];
    Model::new(system, inputs, work, state).linearize(state.time, &state.coordinates, &rest);
    let mut stiffness = work.tangent.reduced_stiffness(&system.elimination);
    let units = units(work, n);
    project_out(&units, &mut stiffness);
    let mut frequencies = if system.rotation == 0.0 {
        let entry = |i: usize, j: usize| 0.5 * (stiffness[i][j] + stiffness[j][i]);
        let values = symmetric_eigenvalues(n, entry).unwrap_or_default();
        let frequency = |value: &f64| value.signum() * value.abs().sqrt();
        values.iter().take(count).map(frequency).collect()
    } else {
        gyroscopic(system, work, &units, &stiffness, count)
    };
    frequencies.resize(count, 0.0);
    frequencies
}

/// Orthonormal directions that non-linear constraints hold, as whole vectors `q`.
fn units(work: &Work, n: usize) -> Vec<Vec<f64>> {
    let mut units = Vec::new();
    for group in &work.groups {
        for i in 0..group.rows.rank() {
            let mut unit = vec![0.0; n];
            unit[group.range()].copy_from_slice(group.rows.unit(i));
            units.push(unit);
        }
    }
    units
}

/// `A <- P A P + large Q^T Q`: held directions go to the end of the spectrum.
fn project_out(units: &[Vec<f64>], a: &mut [Vec<f64>]) {
    if units.is_empty() {
        return;
    }
    let largest = (a.iter().flatten()).fold(0.0_f64, |m, v| m.max(v.abs()));
    let large = largest * a.len() as f64 + 1.0;
    for unit in units {
        for column in a.iter_mut() {
            let part = dot(unit, column);
            (column.iter_mut().zip(unit)).for_each(|(c, u)| *c -= part * u);
        }
        for row in 0..a.len() {
            let part: f64 = a.iter().zip(unit).map(|(column, u)| column[row] * u).sum();
            (a.iter_mut().zip(unit)).for_each(|(column, u)| column[row] -= part * u);
        }
    }
    for unit in units {
        for (column, u) in a.iter_mut().zip(unit) {
            (column.iter_mut().zip(unit)).for_each(|(c, v)| *c += large * u * v);
        }
    }
}

/// Positive imaginary parts of the eigenvalues of `[0 C^T; -C -G]` with `K = C C^T`, smallest first; a growing
/// motion counts as a negative frequency. Where `K` is not positive definite, those of `[0 I; -K -G]`, whose
/// roundoff is that of the squares.
fn gyroscopic(
    system: &System,
    work: &mut Work,
    units: &[Vec<f64>],
    stiffness: &[Vec<f64>],
    count: usize,
) -> Vec<f64> {
    let n = stiffness.len();
    let mut coupling: Vec<Vec<f64>> = Vec::with_capacity(n);
    for column in 0..n {
        let mut q = vec![0.0; n];
        q[column] = 1.0;
        system.elimination.expand(&q, &mut work.y, &mut work.v);
        for (turned, v) in work.other.iter_mut().zip(&work.v) {
            *turned = [-v[1], v[0], -v[3], v[2]];
        }
        work.f.fill([0.0; 4]);
        system.add_inertia(2.0 * system.rotation, &work.other, &mut work.f);
        system.elimination.reduce(&work.f, &mut work.y, &mut q);
        for unit in units {
            let part = dot(unit, &q);
            (q.iter_mut().zip(unit)).for_each(|(q, u)| *q -= part * u);
        }
        coupling.push(q);
    }
    let symmetric = |i: usize, j: usize| 0.5 * (stiffness[i][j] + stiffness[j][i]);
    let root = DMatrix::from_fn(n, n, symmetric).cholesky().map(|c| c.l());
    let entry = |i: usize, j: usize| match (i < n, j < n, &root) {
        (true, true, _) => 0.0,
        (true, false, Some(root)) => root[(j - n, i)],
        (true, false, None) => f64::from(u8::from(j - n == i)),
        (false, true, Some(root)) => -root[(i - n, j)],
        (false, true, None) => -stiffness[j][i - n],
        (false, false, _) => -coupling[j - n][i - n],
    };
    let values = eigenvalues(2 * n, entry).unwrap_or_default();
    let size = values
        .iter()
        .fold(0.0_f64, |m, (re, im)| m.max(re.hypot(*im)));
    let mut found: Vec<f64> = (values.iter())
        .filter(|(re, im)| *im >= 0.0 && (*im > 1e-12 * size || *re >= 0.0))
        .map(|(re, im)| if *re > 1e-6 * size { -re } else { *im })
        .collect();
    found.sort_by(f64::total_cmp);
    found.truncate(count);
    found
}

/// Fastest oscillation (rad/s) and fastest decay (1/s) at a state, from a few Lanczos steps with
/// stiffness and damping.
///
/// Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., section 10.1.
pub fn fastest(system: &System, inputs: &[f64], work: &mut Work, state: &State) -> (f64, f64) {
    let n = state.rates.len();
    let rest = vec![0.0; n];
    Model::new(system, inputs, work, state).linearize(state.time, &state.coordinates, &rest);
    let (tangent, elimination) = (&mut work.tangent, &system.elimination);
    let stiffest = lanczos(n, |x| tangent.apply_stiffness(elimination, x));
    let decay = if system.is_damped {
        lanczos(n, |x| tangent.apply_damping(elimination, x))
    } else {
        0.0
    };
    (stiffest.sqrt(), decay)
}

/// Largest eigenvalue of a symmetric operator, nearly.
fn lanczos(n: usize, mut apply: impl FnMut(&mut [f64])) -> f64 {
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
    values
        .last()
        .map_or(0.0, |largest| MARGIN * largest.max(0.0))
}
