//! Inertia of the sections of a rod or beam against spins, and of what is inside its elements.

use std::ops::Range;

use super::{RodChain, part, plane};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::SectionFrame;
use crate::elements::beam::{Force, Rates};
use crate::math::jet::Number;

impl RodChain {
    /// Momenta conjugate to the spins at the ends of element `j` and to its rates inside, N m s: first end, inside, last end.
    pub(super) fn momenta<const D: usize, N: Number>(
        &self,
        j: usize,
        motion: (&[Node<D, N>], &[Node<D, N>]),
    ) -> [[N; 3]; 3] {
        self.momenta_of(j, &self.rates(j, motion))
    }

    /// Returns the conjugate momenta of these velocities, N m s, as inertia times rates. For rates of velocities it
    /// returns the change of momenta.
    pub(super) fn momenta_of<N: Number>(&self, j: usize, rates: &Rates<N>) -> [[N; 3]; 3] {
        let (_, inertia) = &self.elements[j];
        let rates = [rates.spin[0], rates.inner, rates.spin[1]];
        let mut momenta = [[N::of(0.0); 3]; 3];
        for (momentum, row) in momenta.iter_mut().zip(inertia) {
            for (block, rate) in row.iter().zip(&rates) {
                for r in self.parts.clone() {
                    for c in self.parts.clone() {
                        momentum[r] += rate[c] * N::of(block[r][c]);
                    }
                }
            }
        }
        momenta
    }

    /// For every transported frame its momentum about the tangent or, of a beam, along its axes, N m s, part by part of the elements.
    pub fn for_each_momentum<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        mut each: impl FnMut(&SectionFrame, [N; 3]),
    ) {
        // In the plane they are those of inertia at the nodes.
        for j in (0..self.elements.len()).filter(|_| D > 2) {
            let [a, _, b] = self.momenta(j, motion);
            each(self.frame(j), a);
            each(self.frame(j + 1), b);
        }
    }

    /// Angular momentum, N m s, of what in the plane has inertia that is none of a node: the sections inside elements.
    pub fn planar_momentum<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
    ) -> N {
        let inside = |j: usize| self.momenta(j, motion)[1][plane::PARTS.start];
        (0..self.elements.len()).fold(N::of(0.0), |sum, j| sum + inside(j))
    }

    /// Which of first end, inside and last end of an element have inertia that is none of a node: in the plane the inside alone.
    pub(super) fn massive(&self) -> Range<usize> {
        if self.is_planar() { 1..2 } else { 0..3 }
    }

    /// Inertia of its sections against rotation in the plane, kg m^2, by their nodes: that of the elements beside them.
    pub fn planar_inertia(&self) -> impl Iterator<Item = (usize, f64)> {
        let of = |j: Option<usize>, end: usize| {
            let element = j.and_then(|j| self.elements.get(j));
            element.map_or(0.0, |(_, inertia)| plane::inertia(&inertia[end][end]))
        };
        let frames = self.frames().enumerate();
        frames.map(move |(k, (node, _))| (node, of(k.checked_sub(1), 2) + of(Some(k), 0)))
    }

    /// Returns the force residual of element `j`: elastic and damping forces minus the inertia forces of spins. Inertia
    /// forces include the gyroscopic terms of rotating tangents and of a scene that rotates at `rotation`, rad/s.
    pub fn lack<const D: usize, N: Number>(
        &self,
        j: usize,
        [x, v, a]: [&[Node<D, N>]; 3],
        rotation: [f64; 3],
    ) -> Force<N> {
        let (section, _) = &self.elements[j];
        let rates = self.rates(j, (x, v));
        let mut force = section.force(&self.at(j, x), Some(&rates)).0;
        let [_, first, _, last, inner] = self.nodes(j);
        let spin = |k: usize, node: usize| match D {
            2 => plane::spin(&x[node][1], &a[node][1]),
            _ => self.frame(k).spin_rate(x, a),
        };
        let changes = Rates {
            e: rates.e,
            spin: [spin(j, first), spin(j + 1, last)],
            inner: self.read_inner(&a[inner], [0.0; 3]),
        };
        let changes = self.momenta_of(j, &changes);
        for (k, change) in changes.iter().enumerate() {
            let on = match k {
                1 => &mut force.inner,
                _ => &mut force.moment[k / 2],
            };
            on.iter_mut().zip(change).for_each(|(f, p)| *f -= *p);
        }
        if D == 2 {
            return force;
        }
        let ends = [self.frame(j), self.frame(j + 1)];
        let [first, _, last] = self.momenta_of(j, &rates);
        for (k, (frame, momentum)) in ends.into_iter().zip([first, last]).enumerate() {
            let [slope, rate] = [x, v].map(|of| part(&of[frame.line], 1).into());
            let asked = frame.gyroscopic(momentum, [&slope, &rate, &rates.spin[k].into()]);
            let on = if frame.has_shear {
                &mut force.moment[k]
            } else {
                &mut force.e[2 * k + 1]
            };
            on.iter_mut().zip(&asked).for_each(|(sum, f)| *sum += *f);
        }
        if rotation != [0.0; 3] {
            force.add(&self.frame_spin_force(j, (x, v), rotation));
        }
        force
    }
}
