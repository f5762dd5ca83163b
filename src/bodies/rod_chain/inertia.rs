//! Inertia of the sections of a rod or beam against spins, and of what is inside its elements.

use std::ops::Range;

use super::loaded::add_moment;
use super::{RodChain, part, plane};
use crate::bodies::assembly::{Assembly, no_block};
use crate::bodies::connectivity::Node;
use crate::bodies::frame::{RotationMaps, SectionFrame};
use crate::elements::beam::{Force, Rates};
use crate::math::jet::Number;
use crate::math::sparse::Matrix;

impl RodChain {
    /// Momenta conjugate to the spins at the ends of element `j` and to its rates inside, N m s: first end, inside, last end.
    fn momenta<const D: usize, N: Number>(
        &self,
        j: usize,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &RotationMaps,
    ) -> [[N; 3]; 3] {
        self.momenta_of(j, &self.rates(j, motion, frames))
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

    /// For every carried frame its momentum about the tangent or, of a beam, along its axes, N m s, part by part of the elements.
    pub fn for_each_momentum<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &RotationMaps,
        mut each: impl FnMut(&SectionFrame, [N; 3]),
    ) {
        // In the plane they are those of inertia at the nodes.
        for j in (0..self.elements.len()).filter(|_| D > 2) {
            let [a, _, b] = self.momenta(j, motion, frames);
            each(self.frame(j, frames), a);
            each(self.frame(j + 1, frames), b);
        }
    }

    /// Angular momentum, N m s, of what in the plane has inertia that is none of a node: the sections inside elements.
    pub fn planar_momentum<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &RotationMaps,
    ) -> N {
        let inside = |j: usize| self.momenta(j, motion, frames)[1][plane::PARTS.start];
        (0..self.elements.len()).fold(N::of(0.0), |sum, j| sum + inside(j))
    }

    /// Kinetic energy of spin, J.
    pub fn spin_energy<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &RotationMaps,
    ) -> N {
        let mut sum = N::of(0.0);
        for j in 0..self.elements.len() {
            let rates = self.rates(j, motion, frames);
            let momenta = self.momenta_of(j, &rates);
            let rates = [rates.spin[0], rates.inner, rates.spin[1]];
            for place in self.massive() {
                let terms = momenta[place].iter().zip(&rates[place]);
                sum = terms.fold(sum, |sum, (p, w)| sum + *p * *w);
            }
        }
        sum * N::of(0.5)
    }

    /// Adds the force on slopes, or of a beam the moment on sections, that spin asks for where sections turn.
    pub fn add_gyroscopic<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &RotationMaps,
        force: &mut [Node<D, N>],
    ) {
        self.for_each_momentum(motion, frames, |frame, momentum| {
            frame.add_gyroscopic(momentum, motion, force);
        });
    }

    /// Adds mass times changes of spins and internal coordinates, over the nodes: forces on axes whose moments along them these are.
    pub fn add_spin_inertia<const D: usize>(
        &self,
        (x, dx): (&[Node<D>], &[Node<D>]),
        frames: &RotationMaps,
        force: &mut [Node<D>],
    ) {
        for j in 0..self.elements.len() {
            let [a, inner, b] = self.momenta(j, (x, dx), frames);
            for (k, moment) in [(j, a), (j + 1, b)].into_iter().filter(|_| D > 2) {
                add_moment(self.frame(k, frames).node, &moment, x, force);
            }
            for (k, (part, axis)) in self.inside() {
                force[self.inner + j][part][axis] += inner[k];
            }
        }
    }

    /// Which of first end, inside and last end of an element have inertia that is none of a node: in the plane the inside alone.
    fn massive(&self) -> Range<usize> {
        if self.is_planar() { 1..2 } else { 0..3 }
    }

    /// Inertia of its sections against turns in the plane, kg m^2, by their nodes: that of the elements beside them.
    pub fn planar_inertia(&self) -> impl Iterator<Item = (usize, f64)> {
        let of = |j: Option<usize>, end: usize| {
            let element = j.and_then(|j| self.elements.get(j));
            element.map_or(0.0, |(_, inertia)| plane::inertia(&inertia[end][end]))
        };
        let frames = self.frames().enumerate();
        frames.map(move |(k, (node, _))| (node, of(k.checked_sub(1), 2) + of(Some(k), 0)))
    }

    /// Adds the inertia of spins to a matrix of the system.
    pub fn add_mass<const D: usize>(&self, assembly: &Assembly<D>, matrix: &mut Matrix<f64>) {
        let turns: Vec<_> = self.parts.clone().map(|k| (k, (1, k))).collect();
        let inside: Vec<_> = self.inside().collect();
        for (j, (_, inertia)) in self.elements.iter().enumerate() {
            let [_, a, _, b, inner] = self.nodes(j);
            let places = [(a, &turns), (inner, &inside), (b, &turns)];
            for r in self.massive() {
                for c in self.massive().take_while(|c| *c <= r) {
                    let (mut block, ((row, at), (column, on))) =
                        (no_block(), (places[r], places[c]));
                    for (i, (p, axis)) in at {
                        for (k, (q, other)) in on {
                            block[*p][*axis][*q][*other] = inertia[r][c][*i][*k];
                        }
                    }
                    assembly.add(row, column, &block, matrix);
                }
            }
        }
    }

    /// Returns the force residual of element `j`: elastic and damping forces minus the inertia forces of spins. Inertia
    /// forces include the gyroscopic terms of rotating tangents and of a scene that rotates at `rotation`, rad/s.
    pub fn lack<const D: usize, N: Number>(
        &self,
        j: usize,
        [x, v, a]: [&[Node<D, N>]; 3],
        (rotation, frames): ([f64; 3], &RotationMaps),
    ) -> Force<N> {
        let (section, _) = &self.elements[j];
        let rates = self.rates(j, (x, v), frames);
        let mut force = section.force(&self.at(j, x), Some(&rates)).0;
        let [_, first, _, last, inner] = self.nodes(j);
        let spin = |k: usize, node: usize| match D {
            2 => plane::spin(&x[node][1], &a[node][1]),
            _ => self.frame(k, frames).spin_rate(x, a),
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
        let ends = [self.frame(j, frames), self.frame(j + 1, frames)];
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
            force.add(&self.turning(j, (x, v), rotation, frames));
        }
        force
    }
}
