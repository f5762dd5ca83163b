//! Solves for the three stages of an implicit method together, with one tangent that turns along.
//!
//! The stage equations become one real and one complex system when all stages share a tangent. In
//! absolute coordinates they hardly do: a slope that turns by `t` in a step turns the axial stiffness
//! with it, and Newton's method diverges as soon as `EA t^2` outweighs inertia. So forces of every
//! stage are turned back, node by node, to where the tangent was made, and displacements are turned
//! forth again. Mass is isotropic and hardly notices; what is left of the turn only slows convergence
//! down in proportion (docs/decisions/0005-corotated-newton.md).
//!
//! Turning every node by itself changes sums over nodes. The translation of a free body is therefore
//! put right before and after, so that momentum is kept exactly however far the iteration goes.

use nalgebra::{Complex, SVector};

use super::{FlexibleBody, Tangent};
use crate::elements::{Element, Nodal};
use crate::math::block_tridiagonal::BlockTridiagonal;

/// Nodal vectors of three stages and how far their slopes have turned.
#[derive(Clone, Debug)]
pub(super) struct Stages<const D: usize, const B: usize> {
    x: [Vec<[f64; B]>; 3],
    /// Unit slopes where the tangent was made.
    base: Vec<SVector<f64, D>>,
    /// Unit slopes at the stages.
    turned: [Vec<SVector<f64, D>>; 3],
    /// Mass times a unit translation: what positions and slopes of a node carry of the momentum, kg.
    /// Empty where the body is held.
    carried: Vec<[f64; 2]>,
    mass: f64,
}

impl<const D: usize, const B: usize> Stages<D, B> {
    pub(super) fn new(mass: &BlockTridiagonal<f64, B>, is_free: bool) -> Self {
        let nodes = mass.diagonal.len();
        let slopes = || vec![SVector::zeros(); nodes];
        let vectors = || vec![[0.0; B]; nodes];
        let (mut unit, mut product) = (vectors(), vectors());
        unit.iter_mut().for_each(|x| x[0] = 1.0);
        mass.multiply(&unit, &mut product);
        let mut carried: Vec<[f64; 2]> = product.iter().map(|y| [y[0], y[D]]).collect();
        let total = carried.iter().map(|[position, _]| position).sum();
        if !is_free {
            carried.clear();
        }
        Self {
            carried,
            mass: total,
            x: [vectors(), vectors(), vectors()],
            base: slopes(),
            turned: [slopes(), slopes(), slopes()],
        }
    }

    /// Mean translation of nodal displacements, weighted by mass, m.
    fn translation(&self, x: &[[f64; B]]) -> SVector<f64, D> {
        let mut sum = SVector::zeros();
        for ([position, slope], x) in self.carried.iter().zip(x) {
            for axis in 0..D {
                sum[axis] += position * x[axis] + slope * x[D + axis];
            }
        }
        sum / self.mass
    }

    /// Adds the nodal forces of a uniform acceleration, m/s^2.
    fn accelerate(&self, acceleration: &SVector<f64, D>, x: &mut [[f64; B]]) {
        for ([position, slope], x) in self.carried.iter().zip(x) {
            for axis in 0..D {
                x[axis] += position * acceleration[axis];
                x[D + axis] += slope * acceleration[axis];
            }
        }
    }

    /// Turns the forces on a stage back to where the tangent was made; their sum stays.
    fn turn_back(&self, stage: usize, x: &mut [[f64; B]]) {
        let before = total(x);
        for (node, x) in x.iter_mut().enumerate() {
            turn(&self.turned[stage][node], &self.base[node], x);
        }
        self.accelerate(&((before - total(x)) / self.mass), x);
    }

    /// Turns displacements forth to a stage; their mean translation stays.
    fn turn_forth(&self, stage: usize, x: &mut [[f64; B]]) {
        let before = self.translation(x);
        for (node, x) in x.iter_mut().enumerate() {
            turn(&self.base[node], &self.turned[stage][node], x);
        }
        if !self.carried.is_empty() {
            let change = before - self.translation(x);
            for x in x {
                for axis in 0..D {
                    x[axis] += change[axis];
                }
            }
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
            tangent.stages.turn_back(i, &mut tangent.x);
            self.hold(&mut tangent.x);
            tangent.stages.x[i].copy_from_slice(&tangent.x);
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
            tangent.x.copy_from_slice(&tangent.stages.x[i]);
            tangent.stages.turn_forth(i, &mut tangent.x);
            self.hold(&mut tangent.x);
            self.reduce_displacements(tangent, e, border, q);
        }
    }
}

/// Sum of nodal forces.
fn total<const D: usize, const B: usize>(x: &[[f64; B]]) -> SVector<f64, D> {
    x.iter()
        .map(|x| SVector::<f64, D>::from_column_slice(&x[..D]))
        .sum()
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
