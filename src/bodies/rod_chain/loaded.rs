//! What moments per reference length do to the elements of a rod or beam.

use nalgebra::Vector3;

use super::{RodChain, plane};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{RigidBodyFrame, axes_at};
use crate::elements::beam::{Force, Rates};
use crate::elements::section::Vectors;
use crate::math::jet::Number;

/// The power of a force at these rates, or its work along small changes.
fn product<N: Number>(force: &Force<N>, rates: &Rates<N>) -> N {
    let pairs = force.e.as_flattened().iter().zip(rates.e.as_flattened());
    let spins = force.moment.as_flattened().iter();
    let pairs = pairs.chain(spins.zip(rates.spin.as_flattened()));
    let pairs = pairs.chain(force.inner.iter().zip(&rates.inner));
    pairs.fold(N::of(0.0), |sum, (f, rate)| sum + *f * *rate)
}

impl RodChain {
    /// Vectors along the axes of the sections at the Gauss points of element `j`, in global components.
    pub fn outward<const D: usize, N: Number>(
        &self,
        j: usize,
        x: &[Node<D, N>],
        vectors: &Vectors<N>,
    ) -> Vectors<N> {
        self.element(j).outward(&self.at(j, x), vectors)
    }

    /// Returns the force of distributed moments on element `j`. `moments` holds global components per reference length
    /// at the Gauss points, N m/m.
    pub fn loaded<const D: usize, N: Number>(
        &self,
        j: usize,
        x: &[Node<D, N>],
        moments: &Vectors<N>,
    ) -> Force<N> {
        self.element(j).loaded(&self.at(j, x), moments)
    }

    /// Adds a force on element `j` to those over the nodes: moments on sections as forces on their axes.
    pub fn add_load<const D: usize, N: Number>(
        &self,
        j: usize,
        force: &Force<N>,
        x: &[Node<D, N>],
        out: &mut [Node<D, N>],
    ) {
        let [a, first, b, last, inner] = self.nodes(j);
        for (k, vector) in force.e.iter().enumerate() {
            add(&mut out[[a, b][k / 2]][k % 2], &(*vector).into());
        }
        for (frame, moment) in [first, last].into_iter().zip(&force.moment) {
            add_moment(frame, moment, x, out);
        }
        for (k, (part, axis)) in self.inside() {
            out[inner][part][axis] += force.inner[k];
        }
    }

    /// Power of a force on element `j`, W.
    pub fn power_of<const D: usize, N: Number>(
        &self,
        (j, force): (usize, &Force<N>),
        motion: (&[Node<D, N>], &[Node<D, N>]),
    ) -> N {
        product(force, &self.rates(j, motion))
    }

    /// Work of a force on element `j` that stays what it is on the way between two places, J: exact for small rotations.
    pub fn work_of<const D: usize>(
        &self,
        (j, force): (usize, &Force<f64>),
        [before, after]: [&[Node<D>]; 2],
    ) -> f64 {
        let [from, to] = [before, after].map(|x| self.at(j, x));
        let turned = |end: usize| {
            let [from, to] = [&from, &to].map(|at| at.axes[end].map(Vector3::from));
            let turn: Vector3<f64> = (0..3).map(|k| from[k].cross(&to[k])).sum();
            from.map(|axis| 0.5 * axis.dot(&turn))
        };
        let inner = self.nodes(j)[4];
        let inside = |x: &[Node<D>]| self.read_inner(&x[inner], [0.0; 3]);
        let [out, of] = [after, before].map(inside);
        let changes = Rates {
            e: std::array::from_fn(|k| std::array::from_fn(|i| to.e[k][i] - from.e[k][i])),
            spin: [turned(0), turned(1)],
            inner: std::array::from_fn(|k| out[k] - of[k]),
        };
        product(force, &changes)
    }

    /// The nodes that element `j` follows and acts on, both of its frames among them.
    pub fn all_nodes(&self, j: usize) -> Vec<usize> {
        let [a, first, b, last, inner] = self.nodes(j);
        let frames = [first, last].map(|node| node..node + self.stride);
        frames.into_iter().flatten().chain([a, b, inner]).collect()
    }
}

/// Adds a moment along the axes of a frame, by its first node, as forces on them.
pub(super) fn add_moment<const D: usize, N: Number>(
    frame: usize,
    moment: &[N; 3],
    x: &[Node<D, N>],
    out: &mut [Node<D, N>],
) {
    if D == 2 {
        return plane::turn(&x[frame][1], moment, &mut out[frame][1]);
    }
    let [first, second, third] = RigidBodyFrame::on_axes(&axes_at(frame, x), &(*moment).into());
    add(&mut out[frame][1], &first);
    add(&mut out[frame + 1][0], &second);
    add(&mut out[frame + 1][1], &third);
}

fn add<const D: usize, N: Number>(to: &mut [N; D], vector: &Vector3<N>) {
    to.iter_mut().zip(vector).for_each(|(sum, f)| *sum += *f);
}
