//! Bending and torsion of a rod, along the chain that is its line. Its nodes are those of the line, two for the frame carried at each of
//! them, and one inside every element, which holds the internal twist alone.

mod lanes;

use std::ops::Range;

use nalgebra::Vector3;

use super::assembly::{Assembly, NodeBlock, no_block};
use super::connectivity::Node;
use super::frame::{Carried, Frames};
use super::marker::Marker;
use super::stages::rotated;
use crate::elements::rod::{At, Force, Matrix as ElementMatrix, Rates, Rod, VELOCITIES};
use crate::math::jet::Number;
use crate::math::space::{Vector, components, vector};
use crate::math::sparse::Matrix;
use lanes::{Packed, packs};

/// Where the internal twist stands in a node inside an element: part and axis. The axis before it stands still at one, so that the node
/// has a direction.
pub const INNER: (usize, usize) = (1, 1);

/// Angles from the middle of an element to an end, and of its twist, rad, from which on its frames are not told: just below a right angle,
/// where no smallest rotation is stable, and half a turn.
const MOST_BEND: f64 = 1.5;
const MOST_TWIST: f64 = 3.0;

/// Where an element's velocities stand among its nodes `[line, frame, line, frame, inner]`: node, part, first axis, how many.
const PLACES: [(usize, usize, usize, usize); 7] = [
    (0, 0, 0, 3),
    (0, 1, 0, 3),
    (1, 1, 0, 1),
    (2, 0, 0, 3),
    (2, 1, 0, 3),
    (3, 1, 0, 1),
    (4, INNER.0, INNER.1, 1),
];

/// Inertia of an element against spins at its ends and the rate of internal twist between them, in the order first end, inside, last end.
type SpinInertia = [[f64; 3]; 3];

/// Bending and torsion of a rod.
#[derive(Clone, Debug)]
pub struct RodChain {
    packs: Vec<Packed>,
    /// Its elements, each with its inertia against spins at its ends and the rate of internal twist between them, kg m^2.
    elements: Vec<(Rod, SpinInertia)>,
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
    /// inertia against spins ([`spin_inertia`](crate::elements::rod::spin_inertia)). So many frames are carried before its own.
    pub fn new(elements: Vec<(Rod, SpinInertia)>, line: usize, carried: usize) -> Self {
        let nodes = elements.len() + 1;
        Self {
            is_damped: elements.iter().any(|(rod, _)| rod.is_damped()),
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

    /// Element `j`.
    pub fn element(&self, j: usize) -> &Rod {
        &self.elements[j].0
    }

    /// Whether any element dissipates.
    pub fn is_damped(&self) -> bool {
        self.is_damped
    }

    /// Where element `j` is.
    pub fn at<const D: usize, N: Number>(&self, j: usize, x: &[Node<D, N>]) -> At<N> {
        let [a, fa, b, fb, inner] = self.nodes(j);
        At {
            e: ends([a, b], x),
            d: [fa, fb].map(|frame| part(&x[frame + 1], 0)),
            bubble: x[inner][INNER.0][INNER.1],
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
            bubble: v[inner][INNER.0][INNER.1],
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
        (force, torques): (&mut [Node<D, N>], &mut [N]),
    ) -> N {
        let mut sum = N::of(0.0);
        for (j, (rod, _)) in self.elements.iter().enumerate() {
            let at = self.at(j, motion.0);
            let rates = rod.is_damped().then(|| self.rates(j, motion, frames));
            let (Force { e, torque, bubble }, power) = rod.force(&at, rates.as_ref());
            let [a, _, b, _, inner] = self.nodes(j);
            for (k, vector) in e.iter().enumerate() {
                let node = &mut force[[a, b][k / 2]][k % 2];
                for (sum, f) in node.iter_mut().zip(vector) {
                    *sum += *f;
                }
            }
            for (k, torque) in torque.into_iter().enumerate() {
                torques[self.carried + j + k] += torque;
            }
            force[inner][INNER.0][INNER.1] += bubble;
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
        for (j, (rod, _)) in self.elements.iter().enumerate() {
            if rod.is_damped() {
                let rates = self.rates(j, motion, frames);
                sum += rod.force(&self.at(j, motion.0), Some(&rates)).1;
            }
        }
        sum
    }

    /// Strain energy, J.
    pub fn strain_energy<const D: usize, N: Number>(&self, x: &[Node<D, N>]) -> N {
        let elements = self.elements.iter().enumerate();
        let energies = elements.map(|(j, (rod, _))| rod.energy(&self.at(j, x)));
        energies.fold(N::of(0.0), |sum, energy| sum + energy)
    }

    /// Momenta conjugate to the spins at the ends of element `j` and to its rate of internal twist, N m s.
    fn momenta<const D: usize, N: Number>(
        &self,
        j: usize,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
    ) -> [N; 3] {
        self.momenta_of(j, &self.rates(j, motion, frames))
    }

    /// The same of these velocities; of their rates, what changes it.
    fn momenta_of<N: Number>(&self, j: usize, rates: &Rates<N>) -> [N; 3] {
        let (_, inertia) = &self.elements[j];
        let rates = [rates.spin[0], rates.bubble, rates.spin[1]];
        inertia.map(|row| {
            let terms = row.iter().zip(&rates);
            terms.fold(N::of(0.0), |sum, (m, rate)| sum + *rate * N::of(*m))
        })
    }

    /// For every carried frame its momentum about the tangent, N m s, part by part of the elements.
    pub fn for_each_momentum<const D: usize, N: Number>(
        &self,
        motion: (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
        mut each: impl FnMut(&Carried, N),
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
            let [a, inner, b] = self.momenta(j, motion, frames);
            let Rates { spin, bubble, .. } = self.rates(j, motion, frames);
            sum += a * spin[0] + inner * bubble + b * spin[1];
        }
        sum * N::of(0.5)
    }

    /// Adds the force on slopes that spin asks for where the tangent turns.
    pub fn add_gyroscopic<const D: usize, N: Number>(
        &self,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        frames: &Frames,
        force: &mut [Node<D, N>],
    ) {
        self.for_each_momentum((x, v), frames, |frame, momentum| {
            let on_slope = frame.gyroscopic(momentum, (x, v));
            for (sum, f) in force[frame.line][1].iter_mut().zip(on_slope) {
                *sum += f;
            }
        });
    }

    /// Adds mass times changes of spins and internal twists, over the nodes: forces on axes.
    pub fn add_spin_inertia<const D: usize>(
        &self,
        (x, dx): (&[Node<D>], &[Node<D>]),
        frames: &Frames,
        force: &mut [Node<D>],
    ) {
        for j in 0..self.elements.len() {
            let [a, inner, b] = self.momenta(j, (x, dx), frames);
            for (k, torque) in [(j, a), (j + 1, b)] {
                let frame = self.frame(k, frames);
                let [_, _, third] = frame.axes(x);
                for (sum, axis) in force[frame.node + 1][0].iter_mut().zip(&third) {
                    *sum += torque * axis;
                }
            }
            force[self.inner + j][INNER.0][INNER.1] += inner;
        }
    }

    /// Adds the inertia of spins to a matrix of the system.
    pub fn add_mass<const D: usize>(&self, assembly: &Assembly<D>, matrix: &mut Matrix<f64>) {
        for (j, (_, inertia)) in self.elements.iter().enumerate() {
            let [_, a, _, b, inner] = self.nodes(j);
            let places = [(a, (1, 0)), (inner, INNER), (b, (1, 0))];
            for (r, (row, at)) in places.iter().enumerate() {
                for (c, (column, on)) in places.iter().enumerate().take(r + 1) {
                    let mut block: NodeBlock<D> = no_block();
                    block[at.0][at.1][on.0][on.1] = inertia[r][c];
                    assembly.add(*row, *column, &block, matrix);
                }
            }
        }
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
                for (r, (p, i)) in entries(row) {
                    for (c, (q, k)) in entries(column) {
                        block[p][i][q][k] = whole[r][c];
                    }
                }
                add(*a, *b, &block);
            }
        }
    }

    /// Velocities of element `j`, or small displacements, in the order of its matrices: what nodes hold that have coordinates, so for
    /// every frame the rotation about its tangent. Positions are relative to the first one.
    pub fn displacements<const D: usize>(&self, j: usize, x: &[Node<D>]) -> [f64; VELOCITIES] {
        let nodes = self.nodes(j);
        let mut found = [0.0; VELOCITIES];
        for (k, node) in nodes.iter().enumerate() {
            for (at, (part, axis)) in entries(k) {
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

    /// What element `j` lacks for equilibrium: elastic and damping forces less the inertia of spins, with the force that these ask for
    /// where tangents turn.
    pub fn lack<const D: usize, N: Number>(
        &self,
        j: usize,
        [x, v, a]: [&[Node<D, N>]; 3],
        frames: &Frames,
    ) -> Force<N> {
        let (rod, _) = &self.elements[j];
        let mut force = rod
            .force(&self.at(j, x), Some(&self.rates(j, (x, v), frames)))
            .0;
        let ends = [self.frame(j, frames), self.frame(j + 1, frames)];
        let [first, inner, last] = self.momenta_of(
            j,
            &Rates {
                e: self.rates(j, (x, v), frames).e,
                spin: ends.map(|frame| frame.spin_rate(x, a)),
                bubble: a[self.inner + j][INNER.0][INNER.1],
            },
        );
        force.torque[0] -= first;
        force.torque[1] -= last;
        force.bubble -= inner;
        let [first, _, last] = self.momenta(j, (x, v), frames);
        for (k, (frame, momentum)) in ends.into_iter().zip([first, last]).enumerate() {
            let on_slope = components(&Vector::<D, N>::from(frame.gyroscopic(momentum, (x, v))));
            for (sum, f) in force.e[2 * k + 1].iter_mut().zip(on_slope) {
                *sum += f;
            }
        }
        force
    }
}

/// Velocities of an element at one of its nodes: number, then part and axis.
fn entries(node: usize) -> impl Iterator<Item = (usize, (usize, usize))> {
    let mut first = 0;
    let places = PLACES.iter().map(move |(of, part, axis, count)| {
        first += count;
        (*of, *part, *axis, first - count, *count)
    });
    let own = places.filter(move |(of, ..)| *of == node);
    own.flat_map(|(_, part, axis, first, count)| {
        (0..count).map(move |k| (first + k, (part, axis + k)))
    })
}

/// Positions and slopes of two nodes, or their rates.
fn ends<const D: usize, N: Number>(nodes: [usize; 2], x: &[Node<D, N>]) -> [[N; 3]; 4] {
    let [a, b] = nodes.map(|node| [0, 1].map(|k| part(&x[node], k)));
    [a[0], a[1], b[0], b[1]]
}

fn part<const D: usize, N: Number>(node: &Node<D, N>, k: usize) -> [N; 3] {
    components(&Vector::<D, N>::from(node[k]))
}

/// Axes of frames carried along a line, whose tangents are those at parts in [0, 1] of its elements, by so many smallest rotations an element
/// (one where a plane holds it; else the angle that they miss falls with the square of their number), the first of them with this second
/// axis, and then turned about the tangent by the angles of these twists, rad: position and axes in two nodes each.
pub fn carried_nodes<const D: usize>(
    line: &[Node<D>],
    second: [f64; 3],
    (tangent, steps): (impl Fn(usize, f64) -> [f64; 3], u32),
    twists: impl Iterator<Item = f64>,
) -> Vec<Node<D>> {
    let mut second = Vector3::from(second);
    let mut t = Vector3::from(tangent(0, 0.0));
    let mut nodes = Vec::with_capacity(2 * line.len());
    for (j, (node, twist)) in line.iter().zip(twists).enumerate() {
        for step in (1..=steps).take_while(|_| j > 0) {
            let next = Vector3::from(tangent(j - 1, f64::from(step) / f64::from(steps)));
            second = rotated(&t, &next, &second);
            t = next;
        }
        second = (second - t * t.dot(&second)).normalize();
        let (sin, cos) = twist.sin_cos();
        let turned = second * cos + t.cross(&second) * sin;
        let [a, b, c] =
            [t, turned, t.cross(&turned)].map(|axis| vector::<D, f64>(axis.into()).into());
        nodes.extend([[node[0], a], [b, c]]);
    }
    nodes
}
