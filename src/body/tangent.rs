//! The tangent of a body over its nodes, and solves with it in the coordinates `q` without any dense
//! matrix: with `B` the assembly of the free nodal coordinates,
//! `(s^2 I + s T^T R T + T^T K T)^-1 = T^T M B (s^2 M + s R + K)^-1 B^T M T`,
//! one block-tridiagonal solve.

use nalgebra::{Complex, SMatrix};

use super::FlexibleBody;
use super::stages::Stages;
use crate::elements::{Blocks, Element, Nodal};
use crate::math::block_tridiagonal::{Block, BlockTridiagonal, Number};

/// Mass, damping and stiffness over the nodes, and the factors of a combination of them.
#[derive(Clone, Debug)]
pub struct Tangent<const D: usize, const B: usize> {
    pub(super) mass: BlockTridiagonal<f64, B>,
    /// Stiffness `K`; what [`FlexibleBody::assemble`] made of it and loads added.
    pub stiffness: BlockTridiagonal<f64, B>,
    damping: BlockTridiagonal<f64, B>,
    pub(super) real: BlockTridiagonal<f64, B>,
    pub(super) complex: BlockTridiagonal<Complex<f64>, B>,
    pub(super) x: Vec<[f64; B]>,
    pub(super) y: Vec<[f64; B]>,
    pub(super) z: Vec<[Complex<f64>; B]>,
    pub(super) stages: Stages<D, B>,
}

impl<E: Element<D>, const D: usize, const B: usize> FlexibleBody<E, D, B> {
    /// Storage for the tangent, with the mass in place.
    pub fn tangent(&self) -> Tangent<D, B> {
        let nodes = self.elements.len() + 1;
        let zeros = BlockTridiagonal::zeros(nodes);
        let mut mass = zeros.clone();
        for (j, element) in self.elements.iter().enumerate() {
            let m = element.mass();
            let blocks: Blocks<D> =
                std::array::from_fn(|a| std::array::from_fn(|b| SMatrix::identity() * m[(a, b)]));
            add_element(&mut mass, j, &blocks);
        }
        Tangent {
            stages: Stages::new(&mass, self.supports.is_empty()),
            mass,
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            real: zeros,
            complex: BlockTridiagonal::zeros(nodes),
            x: vec![[0.0; B]; nodes],
            y: vec![[0.0; B]; nodes],
            z: vec![[Complex::new(0.0, 0.0); B]; nodes],
        }
    }

    /// Computes stiffness and damping at a configuration.
    pub fn assemble(&self, e: &[Nodal<D>], rate: &[Nodal<D>], tangent: &mut Tangent<D, B>) {
        tangent.stages.set_base(e);
        clear(&mut tangent.stiffness);
        for (j, element) in self.elements.iter().enumerate() {
            add_element(
                &mut tangent.stiffness,
                j,
                &element.stiffness(&e[j], &rate[j]),
            );
        }
        if self.is_damped() {
            clear(&mut tangent.damping);
            for (j, element) in self.elements.iter().enumerate() {
                add_element(&mut tangent.damping, j, &element.damping(&e[j]));
            }
        }
    }

    /// Factors `s^2 M + s R + K` for a real `s`. False when it is not positive definite.
    pub fn factor(&self, s: f64, tangent: &mut Tangent<D, B>) -> bool {
        let Tangent {
            mass,
            stiffness,
            damping,
            real,
            ..
        } = tangent;
        let damping = self.is_damped().then_some(&*damping);
        combine(mass, damping, stiffness, s, real);
        self.constrain(real);
        tangent.real.factor()
    }

    /// Factors `s^2 M + s R + K` for a complex `s`. False at a vanishing pivot.
    pub fn factor_complex(&self, s: Complex<f64>, tangent: &mut Tangent<D, B>) -> bool {
        let Tangent {
            mass,
            stiffness,
            damping,
            complex,
            ..
        } = tangent;
        let damping = self.is_damped().then_some(&*damping);
        combine(mass, damping, stiffness, s, complex);
        self.constrain(complex);
        tangent.complex.factor()
    }

    /// Solves in place with the real factors, in the coordinates `q`.
    pub fn solve(
        &self,
        tangent: &mut Tangent<D, B>,
        e: &mut [Nodal<D>],
        border: &mut [f64],
        q: &mut [f64],
    ) {
        self.nodal_forces(tangent, e, border, q);
        tangent.real.solve(&mut tangent.x);
        self.reduce_displacements(tangent, e, border, q);
    }

    /// `T^T R T q`, in place; does nothing to an undamped body but set zero.
    pub fn apply_damping(
        &self,
        tangent: &mut Tangent<D, B>,
        e: &mut [Nodal<D>],
        border: &mut [f64],
        q: &mut [f64],
    ) {
        if !self.is_damped() {
            q.fill(0.0);
            return;
        }
        self.rates(q, border, e);
        gather(e, &mut tangent.x);
        tangent.damping.multiply(&tangent.x, &mut tangent.y);
        place(&tangent.y, e);
        self.reduce(e, border, q);
    }

    /// Dense stiffness `T^T K T`, column by column: for natural frequencies at set-up.
    pub fn reduced_stiffness(&self, tangent: &mut Tangent<D, B>) -> Vec<Vec<f64>> {
        let mut scratch = self.scratch();
        (0..self.coordinates())
            .map(|column| {
                let mut q = vec![0.0; self.coordinates()];
                q[column] = 1.0;
                self.rates(&q, &mut scratch.border, &mut scratch.e);
                gather(&scratch.e, &mut tangent.x);
                tangent.stiffness.multiply(&tangent.x, &mut tangent.y);
                place(&tangent.y, &mut scratch.force);
                self.reduce(&scratch.force, &mut scratch.border, &mut q);
                q
            })
            .collect()
    }

    /// `x = B^T M T q`.
    pub(super) fn nodal_forces(
        &self,
        tangent: &mut Tangent<D, B>,
        e: &mut [Nodal<D>],
        border: &mut [f64],
        q: &[f64],
    ) {
        self.rates(q, border, e);
        gather(e, &mut tangent.y);
        tangent.mass.multiply(&tangent.y, &mut tangent.x);
        self.hold(&mut tangent.x);
    }

    /// Takes held directions out of nodal forces or displacements.
    pub(super) fn hold(&self, x: &mut [[f64; B]]) {
        for support in &self.supports {
            let x = &mut x[support.node];
            *x = (support.free * nalgebra::SVector::from(*x)).into();
        }
    }

    /// `q = T^T M B x`.
    pub(super) fn reduce_displacements(
        &self,
        tangent: &mut Tangent<D, B>,
        e: &mut [Nodal<D>],
        border: &mut [f64],
        q: &mut [f64],
    ) {
        tangent.mass.multiply(&tangent.x, &mut tangent.y);
        place(&tangent.y, e);
        self.reduce(e, border, q);
    }

    /// Takes held directions out: `P A P` plus, along every held direction, a pivot as large as its
    /// neighbours, which would drown in their roundoff otherwise.
    fn constrain<T: Number>(&self, a: &mut BlockTridiagonal<T, B>) {
        for support in &self.supports {
            let (node, p) = (support.node, &support.free);
            let before = a.diagonal[node];
            a.diagonal[node] = right(&left(p, &before), p);
            for unit in &support.held {
                let size: f64 = (0..B)
                    .map(|i| unit[i] * unit[i] * before[i][i].size())
                    .sum();
                let size = if size > 0.0 { size } else { 1.0 };
                for r in 0..B {
                    for c in 0..B {
                        let value = T::from(size * unit[r] * unit[c]);
                        a.diagonal[node][r][c] = a.diagonal[node][r][c] + value;
                    }
                }
            }
            if let Some(l) = a.lower.get_mut(node) {
                *l = right(l, p);
            }
            if node > 0 {
                let l = &mut a.lower[node - 1];
                *l = left(p, l);
            }
        }
    }
}

fn left<T: Number, const B: usize>(p: &SMatrix<f64, B, B>, a: &Block<T, B>) -> Block<T, B> {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            (0..B).fold(T::from(0.0), |sum, k| sum + T::from(p[(r, k)]) * a[k][c])
        })
    })
}

fn right<T: Number, const B: usize>(a: &Block<T, B>, p: &SMatrix<f64, B, B>) -> Block<T, B> {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            (0..B).fold(T::from(0.0), |sum, k| sum + a[r][k] * T::from(p[(k, c)]))
        })
    })
}

fn clear<const B: usize>(a: &mut BlockTridiagonal<f64, B>) {
    a.diagonal.fill([[0.0; B]; B]);
    a.lower.fill([[0.0; B]; B]);
}

/// `out = s^2 M + s R + K`, lower triangles only where that is all the factorization reads.
fn combine<T: Number, const B: usize>(
    mass: &BlockTridiagonal<f64, B>,
    damping: Option<&BlockTridiagonal<f64, B>>,
    stiffness: &BlockTridiagonal<f64, B>,
    s: T,
    out: &mut BlockTridiagonal<T, B>,
) {
    let square = s * s;
    let add =
        |m: &Block<f64, B>, r: Option<&Block<f64, B>>, k: &Block<f64, B>, out: &mut Block<T, B>| {
            for i in 0..B {
                for j in 0..B {
                    let mut value = square * T::from(m[i][j]) + T::from(k[i][j]);
                    if let Some(r) = r {
                        value = value + s * T::from(r[i][j]);
                    }
                    out[i][j] = value;
                }
            }
        };
    for (i, out) in out.diagonal.iter_mut().enumerate() {
        add(
            &mass.diagonal[i],
            damping.map(|r| &r.diagonal[i]),
            &stiffness.diagonal[i],
            out,
        );
    }
    for (i, out) in out.lower.iter_mut().enumerate() {
        add(
            &mass.lower[i],
            damping.map(|r| &r.lower[i]),
            &stiffness.lower[i],
            out,
        );
    }
}

/// Adds the blocks of element `j` to the rows of nodes `j` and `j + 1`.
fn add_element<const D: usize, const B: usize>(
    a: &mut BlockTridiagonal<f64, B>,
    j: usize,
    blocks: &Blocks<D>,
) {
    let add = |out: &mut Block<f64, B>, row: usize, column: usize| {
        for r in 0..B {
            for c in 0..B {
                out[r][c] += blocks[row + r / D][column + c / D][(r % D, c % D)];
            }
        }
    };
    add(&mut a.diagonal[j], 0, 0);
    add(&mut a.diagonal[j + 1], 2, 2);
    add(&mut a.lower[j], 2, 0);
}

/// Nodal coordinates of connected elements.
fn gather<const D: usize, const B: usize>(e: &[Nodal<D>], x: &mut [[f64; B]]) {
    for (e, x) in e.iter().zip(x.iter_mut()) {
        x.copy_from_slice(&e.as_slice()[..B]);
    }
    if let (Some(e), Some(x)) = (e.last(), x.last_mut()) {
        x.copy_from_slice(&e.as_slice()[B..]);
    }
}

/// Nodal forces put on elements: on which neighbour does not matter to `T^T`, since `Phi T = 0`.
fn place<const D: usize, const B: usize>(x: &[[f64; B]], f: &mut [Nodal<D>]) {
    for (f, x) in f.iter_mut().zip(x) {
        f.fill(0.0);
        f.as_mut_slice()[..B].copy_from_slice(x);
    }
    if let (Some(f), Some(x)) = (f.last_mut(), x.last()) {
        f.as_mut_slice()[B..].copy_from_slice(x);
    }
}
