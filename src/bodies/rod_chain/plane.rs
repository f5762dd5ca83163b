//! Sections of a beam in the plane: a unit vector `d` across each of them, a natural coordinate as that of a rigid body is, in the second
//! vector of a node. The sections in the middle of elements, which nothing is joined to, have angles. Second axes stand across the plane.
//!
//! The section's angle changes by `d x d' / d.d`, so that a moment `M` on it is the force `M perp(d) / d.d`, which has no part along `d`.
//!
//! Source: J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), section 2.2 (natural coordinates in
//! the plane).

use std::ops::Range;

use super::{Node, part};
use crate::elements::beam::Matrix;
use crate::math::jet::Number;

/// Components that there are: about the second axis.
pub(super) const PARTS: Range<usize> = 1..2;

/// Where the angle of the section in the middle of an element stands in its node: part and axis.
pub(super) const ANGLE: (usize, usize) = (0, 0);

/// Where the spins of both ends stand in the matrix of an element.
const SPINS: [usize; 2] = [6, 15];

/// Axes of a section with this direction: its normal, that across the plane, and that in it.
pub fn axes<const D: usize, N: Number>(d: &[N; D]) -> [[N; 3]; 3] {
    let (zero, one) = (N::of(0.0), N::of(1.0));
    let size = (d[0] * d[0] + d[1] * d[1]).root();
    let [c, s] = [d[0] / size, d[1] / size];
    [[c, s, zero], [zero, zero, one], [s, -c, zero]]
}

/// Returns the angular velocity along the section axes for a direction `d` and its rate, rad/s.
pub(super) fn spin<const D: usize, N: Number>(d: &[N; D], rate: &[N; D]) -> [N; 3] {
    let [c, s] = turned(d);
    [N::of(0.0), c * rate[0] + s * rate[1], N::of(0.0)]
}

/// The normal of the section in the middle of an element, from the node there.
pub(super) fn inner<const D: usize, N: Number>(node: &Node<D, N>) -> [N; 3] {
    let (sin, cos) = node[ANGLE.0][ANGLE.1].sin_cos();
    [cos, sin, N::of(0.0)]
}

/// Adds a rotation, or a rate of it, to what a node inside an element holds: in the plane the angle of the section there, in space nothing that
/// rotates with a body.
pub fn rotate_inner<const D: usize>(node: &mut Node<D>, turn: f64) {
    if D == 2 {
        node[ANGLE.0][ANGLE.1] += turn;
    }
}

/// The node inside an element whose section is across the line there, from those of the line at its ends.
pub fn middle<const D: usize>([a, b]: [&Node<D>; 2], length: f64) -> Node<D> {
    let ([p, u], [q, v]) = ([0, 1].map(|k| part(a, k)), [0, 1].map(|k| part(b, k)));
    let slope = |k: usize| 1.5 * (q[k] - p[k]) / length - 0.25 * (u[k] + v[k]);
    let mut node = [[0.0; D]; 2];
    (node[ANGLE.0][ANGLE.1], node[1][0]) = (slope(1).atan2(slope(0)), 1.0);
    node
}

/// Adds what a moment along its axes does to the direction.
pub(super) fn turn<const D: usize, N: Number>(d: &[N; D], moment: &[N; 3], force: &mut [N; D]) {
    let by = turned(d);
    (force.iter_mut().zip(by)).for_each(|(sum, by)| *sum += moment[1] * by);
}

/// Change of the angle by the direction.
fn turned<const D: usize, N: Number>(d: &[N; D]) -> [N; 2] {
    let square = d[0] * d[0] + d[1] * d[1];
    [-d[1] / square, d[0] / square]
}

/// Selects the entry of an inertia block that planar sections use.
pub(super) fn inertia(block: &[[f64; 3]; 3]) -> f64 {
    block[PARTS.start][PARTS.start]
}

/// Puts rates of directions in the places of the spins of the ends of an element.
pub(super) fn over_directions<const D: usize>(directions: [&[f64; D]; 2], matrix: &mut Matrix) {
    for (first, d) in SPINS.into_iter().zip(directions) {
        let by = turned(d);
        for row in matrix.iter_mut() {
            (row[first], row[first + 1]) = (row[first + 1] * by[0], row[first + 1] * by[1]);
        }
        let of_angle = matrix[first + 1];
        matrix[first] = of_angle.map(|entry| entry * by[0]);
        matrix[first + 1] = of_angle.map(|entry| entry * by[1]);
    }
}
