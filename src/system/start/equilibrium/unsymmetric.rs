//! Solves with the whole tangent where loads make it unsymmetric: a follower force rotates with one node or two,
//! so that its tangent differs from a symmetric one by a few columns, and GMRES with the symmetric factors
//! needs a step or two for each of them.
//!
//! Source: Y. Saad, M. H. Schultz, GMRES, SIAM J. Sci. Stat. Comput. 7 (1986).

use crate::bodies::{Node, map_node};
use crate::math::jet::{Jet, moving, part};
use crate::math::vector::{dot, norm};
use crate::system::instant::Instant;
use crate::system::loads::ForceElement as _;
use crate::system::workspace::Frozen;
use crate::system::{DrivenSystem, Dynamics};

/// Most steps, and the residual at which the iteration ends, relative to that at its start.
const STEPS: usize = 80;
const ENOUGH: f64 = 1e-13;
/// Next basis vector, relative to the product it is left of, that roundoff may be.
const NOTHING: f64 = 1e-10;
/// Stretch of a direction, relative to the largest, that counts as none: nothing moves along it.
const NEUTRAL: f64 = 1e-5;
/// Shift of the symmetric factors where joints have multipliers, relative to the smallest. Without one, pivots of
/// bodies that have no stiffness but that of their joints are small, and roundoff leads against these joints; a
/// shift that is not part of the tangent costs the iteration a few steps.
const JOINED: f64 = 1e3;

/// Approximate cost of a product with the full tangent and its projections, in accelerations.
const PRODUCT: f64 = 3.0;

/// Solves `(s^2 I + K) x = f` in place, where the model is linearized; `least` is the shift of the symmetric
/// factors that stand in where those without are singular. Products and projections are over what is counted. False where no factors are found, or where
/// `s^2 I + K` is zero on `f`: what moves nothing is no equilibrium.
pub(super) fn solve<const D: usize>(
    model: &mut DrivenSystem<'_, D>,
    s: f64,
    least: f64,
    x: &mut [f64],
) -> bool {
    let is_joined = !model.system.constraints.is_empty();
    let mut shift = if is_joined { s.max(JOINED * least) } else { s };
    for _ in 0..STEPS {
        if model.inertia([shift * shift, 0.0]).is_some() {
            break;
        }
        shift = (3.0 * shift).max(least);
    }
    model.to_counted(x);
    let right = preconditioned(model, x);
    let scale = norm(&right);
    x.fill(0.0);
    if !(scale.is_finite() && scale > 0.0) {
        return scale == 0.0;
    }
    let mut basis = vec![right.iter().map(|r| r / scale).collect::<Vec<f64>>()];
    // Columns of the Hessenberg matrix, rotated to triangular by rotations, and the right-hand side.
    let (mut columns, mut rotations) = (Vec::new(), Vec::<[f64; 2]>::new());
    let mut target = vec![scale];
    for k in 0..STEPS.min(x.len()) {
        if model.is_exhausted() {
            return false;
        }
        let product = apply(model, s, &basis[k]);
        let mut w = preconditioned(model, &product);
        let mut column: Vec<f64> = Vec::with_capacity(k + 2);
        for v in &basis {
            let h = dot(v, &w);
            w.iter_mut().zip(v).for_each(|(w, v)| *w -= h * v);
            column.push(h);
        }
        // Twice is enough.
        for (v, h) in basis.iter().zip(&mut column) {
            let more = dot(v, &w);
            w.iter_mut().zip(v).for_each(|(w, v)| *w -= more * v);
            *h += more;
        }
        let rest = norm(&w);
        for (i, [c, s]) in rotations.iter().enumerate() {
            let [a, b]: [f64; 2] = [column[i], column[i + 1]];
            (column[i], column[i + 1]) = (c * a + s * b, c * b - s * a);
        }
        let size = column[k].hypot(rest);
        if !(size.is_finite() && size > 0.0) {
            break;
        }
        let [c, sine] = [column[k] / size, rest / size];
        column[k] = size;
        rotations.push([c, sine]);
        let last = target[k];
        target[k] = c * last;
        target.push(-sine * last);
        columns.push(column);
        if (sine * last).abs() <= ENOUGH * scale || rest <= NOTHING * size {
            break;
        }
        basis.push(w.iter().map(|w| w / rest).collect());
    }
    substitute_back(&columns, &mut target);
    for (v, factor) in basis.iter().zip(&target[..columns.len()]) {
        x.iter_mut().zip(v).for_each(|(x, v)| *x += factor * v);
    }
    model.from_counted(x);
    !columns.is_empty() && x.iter().all(|x| x.is_finite())
}

/// Solves with the triangular matrix of these columns in place, along directions that it stretches; others stay out.
fn substitute_back(columns: &[Vec<f64>], target: &mut [f64]) {
    let stretches = columns.iter().enumerate().map(|(i, column)| column[i]);
    let largest = stretches.fold(0.0, f64::max);
    for i in (0..columns.len()).rev() {
        let term = |j: usize| columns[j][i] * target[j];
        let later: f64 = (i + 1..columns.len()).map(term).sum();
        target[i] = if columns[i][i] > NEUTRAL * largest {
            (target[i] - later) / columns[i][i]
        } else {
            0.0
        };
    }
}

/// Solves with the symmetric factors, inside the tangent plane of the constraints: what they lead out of it, no
/// product with the tangent sees.
fn preconditioned<const D: usize>(model: &mut DrivenSystem<'_, D>, f: &[f64]) -> Vec<f64> {
    model.spend(PRODUCT);
    let mut x = f.to_vec();
    model
        .system
        .project_on_tangent_plane(&mut model.work.constraints, &mut x);
    model.solve_counted(&mut x);
    model
        .system
        .project_on_tangent_plane(&mut model.work.constraints, &mut x);
    x
}

/// `(s^2 I + K) q` with the whole tangent `K` at the configuration that the model is linearized at.
fn apply<const D: usize>(model: &mut DrivenSystem<'_, D>, s: f64, q: &[f64]) -> Vec<f64> {
    let mut sum = q.to_vec();
    model.apply_stiffness(&mut sum);
    sum.iter_mut().zip(q).for_each(|(sum, q)| *sum += s * s * q);
    let skew = skew(model, q);
    sum.iter_mut().zip(skew).for_each(|(sum, k)| *sum += k);
    sum
}

/// Returns the part of the tangent's product that the symmetric tangent leaves out: minus the derivative of the
/// non-conservative loads along `q`, minus their part in the symmetric tangent.
fn skew<const D: usize>(model: &mut DrivenSystem<'_, D>, q: &[f64]) -> Vec<f64> {
    let (system, time) = (model.system, Jet::from_re(model.time));
    let work = &mut *model.work;
    system
        .elimination
        .expand(q, &mut work.scratch.y, &mut work.scratch.other);
    let (drives, x) = (&work.kinematics.drives, &work.kinematics.x);
    (system.bodies).place_changes(drives, x, &mut work.scratch.other);
    let still: Frozen<Jet> = work.kinematics.frozen();
    let zero = Jet::from_re(0.0);
    let pairs = work.kinematics.x.iter().zip(&work.scratch.other);
    let x: Vec<Node<D, Jet>> = pairs.map(|(x, dx)| moving(x, dx)).collect();
    let v = vec![[[zero; D]; 2]; x.len()];
    let mut f = v.clone();
    let at = Instant {
        time,
        inputs: &still.inputs,
        input_rates: &still.input_rates,
        drives: &still.drives,
        x: &x,
        v: &v,
        bodies: &system.bodies,
        angles: (&system.angles, &still.angles),
    };
    let loads = || (system.loads.iter()).filter(|load| !load.is_conservative());
    loads().for_each(|load| load.add_force(at, &mut f));
    for (out, f) in work.forces.f.iter_mut().zip(&f) {
        *out = map_node(f, |f| -part(f, 1));
    }
    let force = &mut work.forces.f;
    let dx = &work.scratch.other;
    for load in loads() {
        load.add_tangent(
            system.instant(model.time, &work.kinematics),
            &mut |a, b, block| {
                for (r, row) in block.as_flattened().iter().enumerate() {
                    for (c, entry) in row.as_flattened().iter().enumerate() {
                        force[a].as_flattened_mut()[r] -= entry * dx[b].as_flattened()[c];
                        if a != b {
                            force[b].as_flattened_mut()[c] -= entry * dx[a].as_flattened()[r];
                        }
                    }
                }
            },
            &mut |_, _, _| {},
        );
    }
    let mut out = vec![0.0; q.len()];
    let (drives, x) = (&work.kinematics.drives, &work.kinematics.x);
    system.bodies.pull_back(drives, x, &mut work.forces.f);
    system
        .elimination
        .reduce(&work.forces.f, &mut work.scratch.y, &mut out);
    out
}
