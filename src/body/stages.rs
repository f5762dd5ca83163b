//! Solves for the three stages of an implicit method together, with one tangent that turns along.
//!
//! The stage equations become one real and one complex system when all stages share a tangent. In
//! absolute coordinates they hardly do: a slope that turns by `t` in a step turns the axial stiffness
//! with it, and Newton's method diverges as soon as `EA t^2` outweighs inertia. So forces of every
//! stage are turned back, node by node, to where the tangent was made, and displacements are turned
//! forth again. Mass is isotropic and hardly notices; what is left of the turn only slows convergence
//! down in proportion (docs/decisions/0005-corotated-newton.md).

use nalgebra::{Complex, SVector};

use super::{FlexibleBody, Tangent};
use crate::elements::{Element, Nodal};

/// Nodal vectors of three stages and how far their slopes have turned.
#[derive(Clone, Debug)]
pub(super) struct Stages<const D: usize, const B: usize> {
    x: [Vec<[f64; B]>; 3],
    /// Unit slopes where the tangent was made.
    base: Vec<SVector<f64, D>>,
    /// Unit slopes at the stages.
    turned: [Vec<SVector<f64, D>>; 3],
}

impl<const D: usize, const B: usize> Stages<D, B> {
    pub(super) fn new(nodes: usize) -> Self {
        let slopes = || vec![SVector::zeros(); nodes];
        let vectors = || vec![[0.0; B]; nodes];
        Self {
            x: [vectors(), vectors(), vectors()],
            base: slopes(),
            turned: [slopes(), slopes(), slopes()],
        }
    }

    /// The tangent is made at this configuration.
    pub(super) fn set_base(&mut self, e: &[Nodal<D>]) {
        unit_slopes(e, &mut self.base);
        for turned in &mut self.turned {
            turned.copy_from_slice(&self.base);
        }
    }
}

impl<E: Element<D>, const D: usize, const B: usize> FlexibleBody<E, D, B> {
    /// Sets the configuration of a stage.
    pub fn set_stage(&self, stage: usize, e: &[Nodal<D>], tangent: &mut Tangent<D, B>) {
        unit_slopes(e, &mut tangent.stages.turned[stage]);
    }

    /// Solves in place, in the coordinates `q`: `forward` takes the three right-hand sides to one for
    /// the real factors and two for the complex ones, `back` takes the solutions to the stages.
    pub fn solve_stages(
        &self,
        tangent: &mut Tangent<D, B>,
        (e, border): (&mut [Nodal<D>], &mut [f64]),
        (forward, back): (&[[f64; 3]; 3], &[[f64; 3]; 3]),
        q: &mut [Vec<f64>; 3],
    ) {
        for (i, q) in q.iter().enumerate() {
            self.nodal_forces(tangent, e, border, q);
            let Stages { x, base, turned } = &mut tangent.stages;
            for (node, x) in tangent.x.iter_mut().enumerate() {
                turn(&turned[i][node], &base[node], x);
            }
            self.hold(&mut tangent.x);
            x[i].copy_from_slice(&tangent.x);
        }
        let stages = &mut tangent.stages.x;
        for node in 0..tangent.x.len() {
            for k in 0..B {
                let x = [stages[0][node][k], stages[1][node][k], stages[2][node][k]];
                tangent.x[node][k] = dot(&forward[0], &x);
                tangent.z[node][k] = Complex::new(dot(&forward[1], &x), dot(&forward[2], &x));
            }
        }
        tangent.real.solve(&mut tangent.x);
        tangent.complex.solve(&mut tangent.z);
        for node in 0..tangent.x.len() {
            for k in 0..B {
                let z = tangent.z[node][k];
                let x = [tangent.x[node][k], z.re, z.im];
                for (stage, row) in stages.iter_mut().zip(back) {
                    stage[node][k] = dot(row, &x);
                }
            }
        }
        for (i, q) in q.iter_mut().enumerate() {
            let Stages { x, base, turned } = &mut tangent.stages;
            for (node, out) in tangent.x.iter_mut().enumerate() {
                *out = x[i][node];
                turn(&base[node], &turned[i][node], out);
            }
            self.hold(&mut tangent.x);
            self.reduce_displacements(tangent, e, border, q);
        }
    }
}

fn unit_slopes<const D: usize>(e: &[Nodal<D>], slopes: &mut [SVector<f64, D>]) {
    for (e, slope) in e.iter().zip(slopes.iter_mut()) {
        *slope = e.column(1).normalize();
    }
    if let (Some(e), Some(slope)) = (e.last(), slopes.last_mut()) {
        *slope = e.column(3).normalize();
    }
}

/// Turns the vectors of a node by the smallest rotation that takes the unit vector `from` to `to`.
fn turn<const D: usize, const B: usize>(
    from: &SVector<f64, D>,
    to: &SVector<f64, D>,
    x: &mut [f64; B],
) {
    let sum = from + to;
    let scale = 1.0 + from.dot(to);
    if scale < 1e-6 {
        // Opposite directions have no smallest rotation, and the step is far too long anyway.
        return;
    }
    for vector in x.chunks_exact_mut(D) {
        let v = SVector::<f64, D>::from_column_slice(vector);
        let turned = v - sum * (sum.dot(&v) / scale) + to * (2.0 * from.dot(&v));
        vector.copy_from_slice(turned.as_slice());
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
