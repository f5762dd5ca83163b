//! The sections of a rod or beam, along the chain that is its line: bending and torsion; of a beam shear and stretching too. Its nodes are
//! those of the line, two for the frame carried at each of them, and one inside every element, which holds the internal twist and a beam's
//! internal leans alone.

mod lanes;
mod loaded;
mod shaped;
mod turning;

use std::ops::Range;

use nalgebra::Vector3;

use super::assembly::{Assembly, NodeBlock, no_block};
use super::connectivity::{Node, no_node};
use super::frame::{Carried, Frames, axes_at, combined};
use super::marker::Marker;
use crate::elements::beam::{At, Force, Matrix as ElementMatrix, Rates, VELOCITIES};
use crate::elements::section::{Section, SpinInertia};
use crate::math::jet::Number;
use crate::math::space::{Vector, components};
use crate::math::sparse::Matrix;
use lanes::{Packed, packs};
use loaded::add_moment;
pub use shaped::carried_nodes;

/// Where the internal twist and a beam's two internal leans stand in a node inside an element: part and axis. The first axis stands one
/// further than the lean, so that the node has a direction.
pub const INNER: [(usize, usize); 3] = [(1, 1), (1, 0), (1, 2)];

/// What stands in the places of [`INNER`] beside the coordinates.
const AHEAD: [f64; 3] = [0.0, 1.0, 0.0];

/// A node inside an element without internal twist and leans.
pub fn untwisted<const D: usize>() -> Node<D> {
    let mut node = no_node();
    for ((part, axis), ahead) in INNER.into_iter().zip(AHEAD).take(D) {
        node[part][axis] = ahead;
    }
    node
}

/// Angles from the middle of an element to an end, and of its twist, rad, from which on its frames are not told: just below a right angle,
/// where no smallest rotation is stable, and half a turn.
const MOST_BEND: f64 = 1.5;
const MOST_TWIST: f64 = 3.0;

/// The sections of a rod or beam.
#[derive(Clone, Debug)]
pub struct RodChain {
    packs: Vec<Packed>,
    /// Its elements, each with its inertia against spins at its ends and the rates inside, kg m^2.
    elements: Vec<(Section, SpinInertia)>,
    /// Spins of a section: 1 of a rod, 3 of a beam.
    turns: usize,
    /// First node of the line, of the carried frames, and inside the elements.
    line: usize,
    frames: usize,
    inner: usize,
    /// Its first carried frame among those of the system.
    carried: usize,
    is_damped: bool,
}

impl RodChain {
    /// Along the line from node `line` on, whose nodes those of its frames follow and then those inside its elements; each element with its
    /// inertia against spins. So many frames are carried before its own.
    pub fn new(elements: Vec<(Section, SpinInertia)>, line: usize, carried: usize) -> Self {
        let nodes = elements.len() + 1;
        Self {
            turns: elements.first().map_or(1, |(section, _)| section.turns()),
            is_damped: elements.iter().any(|(section, _)| section.is_damped()),
            line,
            frames: line + nodes,
            inner: line + 3 * nodes,
            packs: packs(&elements),
            elements,
            carried,
        }
    }

    /// The nodes of element `j`: line and frame at both ends, then that inside.
    pub fn nodes(&self, j: usize) -> [usize; 5] {
        let [a, b] = [j, j + 1].map(|k| [self.line + k, self.frames + 2 * k]);
        [a[0], a[1], b[0], b[1], self.inner + j]
    }

    /// First nodes of its carried frames, and the nodes of the line that they are at.
    pub fn frames(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..=self.elements.len()).map(|k| (self.frames + 2 * k, self.line + k))
    }

    /// First node of the frame at a marker of its line that is at a node.
    pub fn frame_at(&self, marker: &Marker) -> Option<usize> {
        let k = marker.nodes[0] - self.line;
        marker.is_nodal().then_some(self.frames + 2 * k)
    }

    /// Element and place inside it of a frame by its first node: the element after it, but at the last end.
    pub fn element_at(&self, frame: usize) -> (usize, f64) {
        let k = (frame - self.frames) / 2;
        match k == self.elements.len() {
            true => (k - 1, 1.0),
            false => (k, 0.0),
        }
    }

    /// Nodes inside its elements.
    pub fn inner(&self) -> Range<usize> {
        self.inner..self.inner + self.elements.len()
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.elements.len()
    }

    /// First node of the line.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Spins of a section, and numbers inside an element: 1 of a rod, 3 of a beam.
    pub fn turns(&self) -> usize {
        self.turns
    }

    /// Element `j`.
    pub fn element(&self, j: usize) -> &Section {
        &self.elements[j].0
    }

    /// Whether any element dissipates.
    pub fn is_damped(&self) -> bool {
        self.is_damped
    }

    /// Where element `j` is.
    pub fn at<const D: usize, N: Number>(&self, j: usize, x: &[Node<D, N>]) -> At<N> {
        let [a, fa, b, fb, inner] = self.nodes(j);
        let axes = |frame: usize| {
            let ([_, first], [second, third]) = (&x[frame], &x[frame + 1]);
            [first, second, third].map(|axis| components(&Vector::<D, N>::from(*axis)))
        };
        At {
            e: ends([a, b], x),
            axes: [axes(fa), axes(fb)],
            inner: [0, 1, 2].map(|k| x[inner][INNER[k].0][INNER[k].1] - N::of(AHEAD[k])),
        }
    }

    /// Velocities of element `j`, or changes.
    pub fn rates<const D: usize, N: Number>(
        &self,
        j: usize,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
    ) -> Rates<N> {
        let [a, _, b, _, inner] = self.nodes(j);
        let spin = |k: usize| self.frame(k, frames).spin(x, v);
        Rates {
            e: ends([a, b], v),
            spin: [spin(j), spin(j + 1)],
            inner: INNER.map(|(part, axis)| v[inner][part][axis]),
        }
    }

    /// Its carried frame at a node.
    fn frame<'a>(&self, k: usize, frames: &'a Frames) -> &'a Carried {
        &frames.carried()[self.carried + k]
    }

    /// [`Self::add_force`] of numbers of any kind, element by element.
    pub fn add_force_of<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
        (force, moments): (&mut [Node<D, N>], &mut [[N; 3]]),
    ) -> N {
        let mut sum = N::of(0.0);
        for (j, (section, _)) in self.elements.iter().enumerate() {
            let at = self.at(j, motion.0);
            let rates = section.is_damped().then(|| self.rates(j, motion, frames));
            let (
                Force {
                    e,
                    moment,
                    inner: f,
                },
                power,
            ) = section.force(&at, rates.as_ref());
            let [a, _, b, _, inner] = self.nodes(j);
            for (k, vector) in e.iter().enumerate() {
                let node = &mut force[[a, b][k / 2]][k % 2];
                for (sum, f) in node.iter_mut().zip(vector) {
                    *sum += *f;
                }
            }
            for (k, moment) in moment.into_iter().enumerate() {
                for (sum, m) in moments[self.carried + j + k].iter_mut().zip(moment) {
                    *sum += m;
                }
            }
            for ((part, axis), f) in self.inside().zip(f) {
                force[inner][part][axis] += f;
            }
            sum += power;
        }
        sum
    }

    /// Power that damping takes out, W.
    pub fn dissipation<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
    ) -> N {
        let mut sum = N::of(0.0);
        for (j, (section, _)) in self.elements.iter().enumerate() {
            if section.is_damped() {
                let rates = self.rates(j, motion, frames);
                sum += section.force(&self.at(j, motion.0), Some(&rates)).1;
            }
        }
        sum
    }

    /// Strain energy, J.
    pub fn strain_energy<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> N {
        let elements = self.elements.iter().enumerate();
        let energies = elements.map(|(j, (section, _))| section.energy(&self.at(j, x)));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Momenta conjugate to the spins at the ends of element `j` and to its rates inside, N m s: first end, inside, last end.
    fn momenta<const D: usize, N: Number>(
        &self,
        j: usize,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
    ) -> [[N; 3]; 3] {
        self.momenta_of(j, &self.rates(j, motion, frames))
    }

    /// The same of these velocities; of their rates, what changes it.
    fn momenta_of<N: Number>(&self, j: usize, rates: &Rates<N>) -> [[N; 3]; 3] {
        let (_, inertia) = &self.elements[j];
        let rates = [rates.spin[0], rates.inner, rates.spin[1]];
        let mut momenta = [[N::of(0.0); 3]; 3];
        for (momentum, row) in momenta.iter_mut().zip(inertia) {
            for (block, rate) in row.iter().zip(&rates) {
                for r in 0..self.turns {
                    for c in 0..self.turns {
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
        frames: &Frames,
        mut each: impl FnMut(&Carried, [N; 3]),
    ) {
        for j in 0..self.elements.len() {
            let [a, _, b] = self.momenta(j, motion, frames);
            each(self.frame(j, frames), a);
            each(self.frame(j + 1, frames), b);
        }
    }

    /// Kinetic energy of spin, J.
    pub fn spin_energy<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
    ) -> N {
        let mut sum = N::of(0.0);
        for j in 0..self.elements.len() {
            let rates = self.rates(j, motion, frames);
            let momenta = self.momenta_of(j, &rates);
            let rates = [rates.spin[0], rates.inner, rates.spin[1]];
            for (momentum, rate) in momenta.iter().zip(&rates) {
                let terms = momentum.iter().zip(rate).take(self.turns);
                sum = terms.fold(sum, |sum, (p, w)| sum + *p * *w);
            }
        }
        sum * N::of(0.5)
    }

    /// Adds the force on slopes, or of a beam the moment on sections, that spin asks for where sections turn.
    pub fn add_gyroscopic<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
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
        frames: &Frames,
        force: &mut [Node<D>],
    ) {
        for j in 0..self.elements.len() {
            let [a, inner, b] = self.momenta(j, (x, dx), frames);
            for (k, moment) in [(j, a), (j + 1, b)] {
                add_moment(self.frame(k, frames).node, &moment, x, force);
            }
            for ((part, axis), f) in self.inside().zip(inner) {
                force[self.inner + j][part][axis] += f;
            }
        }
    }

    /// Adds the inertia of spins to a matrix of the system.
    pub fn add_mass<const D: usize>(&self, assembly: &Assembly<D>, matrix: &mut Matrix<f64>) {
        let turns: Vec<_> = (0..self.turns).map(|axis| (1, axis)).collect();
        let inside: Vec<_> = self.inside().collect();
        for (j, (_, inertia)) in self.elements.iter().enumerate() {
            let [_, a, _, b, inner] = self.nodes(j);
            let places = [(a, &turns), (inner, &inside), (b, &turns)];
            for (r, (row, at)) in places.iter().enumerate() {
                for (c, (column, on)) in places.iter().enumerate().take(r + 1) {
                    let mut block: NodeBlock<D> = no_block();
                    for (i, (p, axis)) in at.iter().enumerate() {
                        for (k, (q, other)) in on.iter().enumerate() {
                            block[*p][*axis][*q][*other] = inertia[r][c][i][k];
                        }
                    }
                    assembly.add(*row, *column, &block, matrix);
                }
            }
        }
    }

    /// Where the coordinates inside its elements stand in their nodes.
    pub fn inside(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        INNER.into_iter().take(self.turns)
    }

    /// The blocks of a symmetric matrix over the velocities of element `j`, on and below the diagonal of its nodes.
    fn for_each_block<const D: usize>(
        &self,
        j: usize,
        whole: &ElementMatrix,
        mut add: impl FnMut(usize, usize, &NodeBlock<D>),
    ) {
        let nodes = self.nodes(j);
        for (row, a) in nodes.iter().enumerate() {
            for (column, b) in nodes.iter().enumerate().take(row + 1) {
                let mut block: NodeBlock<D> = no_block();
                for (r, (p, i)) in self.entries(row) {
                    for (c, (q, k)) in self.entries(column) {
                        block[p][i][q][k] = whole[r][c];
                    }
                }
                add(*a, *b, &block);
            }
        }
    }

    /// Velocities of an element at one of its nodes `[line, frame, line, frame, inner]`: number, then part and axis.
    fn entries(&self, node: usize) -> impl Iterator<Item = (usize, (usize, usize))> {
        let turns = self.turns;
        let first = [0, 6, 6 + turns, 12 + turns, 12 + 2 * turns][node];
        let count = if [0, 2].contains(&node) { 6 } else { turns };
        (0..count).map(move |k| {
            let place = match node {
                0 | 2 => (k / 3, k % 3),
                4 => INNER[k],
                _ => (1, k),
            };
            (first + k, place)
        })
    }

    /// Velocities of element `j`, or small displacements, in the order of its matrices: what nodes hold that have coordinates, so for
    /// every frame its rotations. Positions are relative to the first one.
    pub fn displacements<const D: usize>(&self, j: usize, x: &[Node<D>]) -> [f64; VELOCITIES] {
        let nodes = self.nodes(j);
        let mut found = [0.0; VELOCITIES];
        for (k, node) in nodes.iter().enumerate() {
            for (at, (part, axis)) in self.entries(k) {
                found[at] = x[*node][part][axis];
                if (k == 0 || k == 2) && part == 0 {
                    found[at] -= x[nodes[0]][0][axis];
                }
            }
        }
        found
    }

    /// The first element that is bent or twisted beyond what its frames hold.
    pub fn overbent<const D: usize>(&self, x: &[Node<D>]) -> Option<usize> {
        (0..self.count()).find(|j| {
            let [bend, twist] = self.element(*j).angles(&self.at(*j, x));
            bend > MOST_BEND || twist > MOST_TWIST
        })
    }

    /// Moments on the sections at the ends of element `j`, given along their axes, in global components.
    pub fn global<const D: usize, N: Number>(
        &self,
        j: usize,
        moments: [[N; 3]; 2],
        x: &[Node<D, N>],
    ) -> [Vector3<N>; 2] {
        let [_, a, _, b, _] = self.nodes(j);
        let [first, last] = moments.map(Vector3::from);
        [(a, first), (b, last)].map(|(frame, moment)| combined(&axes_at(frame, x), &moment))
    }

    /// What element `j` lacks for equilibrium: elastic and damping forces less the inertia of spins, with the force that these ask for
    /// where tangents turn, in a scene that turns at this rate, rad/s.
    pub fn lack<const D: usize, N: Number>(
        &self,
        j: usize,
        [x, v, a]: [&[Node<D, N>]; 3],
        (rotation, frames): ([f64; 3], &Frames),
    ) -> Force<N> {
        let (section, _) = &self.elements[j];
        let rates = self.rates(j, (x, v), frames);
        let mut force = section.force(&self.at(j, x), Some(&rates)).0;
        let ends = [self.frame(j, frames), self.frame(j + 1, frames)];
        let changes = self.momenta_of(
            j,
            &Rates {
                e: rates.e,
                spin: ends.map(|frame| frame.spin_rate(x, a)),
                inner: INNER.map(|(part, axis)| a[self.inner + j][part][axis]),
            },
        );
        for (k, change) in changes.iter().enumerate() {
            let on = match k {
                1 => &mut force.inner,
                _ => &mut force.moment[k / 2],
            };
            on.iter_mut().zip(change).for_each(|(f, p)| *f -= *p);
        }
        let [first, _, last] = self.momenta_of(j, &rates);
        for (k, (frame, momentum)) in ends.into_iter().zip([first, last]).enumerate() {
            let [slope, rate] = [x, v].map(|of| part(&of[frame.line], 1).into());
            let asked = frame.gyroscopic(momentum, [&slope, &rate, &rates.spin[k].into()]);
            let on = match frame.leans {
                true => &mut force.moment[k],
                false => &mut force.e[2 * k + 1],
            };
            on.iter_mut().zip(&asked).for_each(|(sum, f)| *sum += *f);
        }
        if rotation != [0.0; 3] {
            force.add(&self.turning(j, (x, v), rotation, frames));
        }
        force
    }
}

/// Positions and slopes of two nodes, or their rates.
fn ends<const D: usize, N: Number>(nodes: [usize; 2], x: &[Node<D, N>]) -> [[N; 3]; 4] {
    let [a, b] = nodes.map(|node| [0, 1].map(|k| part(&x[node], k)));
    [a[0], a[1], b[0], b[1]]
}

fn part<const D: usize, N: Number>(node: &Node<D, N>, k: usize) -> [N; 3] {
    components(&Vector::<D, N>::from(node[k]))
}
