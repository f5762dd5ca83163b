//! How well the mesh of a cable carries the shape that it has.
//!
//! Curvature is continuous where nothing exerts a moment; that of the position field jumps at nodes. Half a jump is about
//! what curvature is off there, and that times the square of the length of the element what the shape misses
//! (docs/decisions/0036-resolution.md).
//!
//! Where curvature is uniform it does not jump. A cubic that bends by an angle `w` cannot keep its arc at one speed: its strain
//! varies by the fourth power of `w`, and the curvature that minimizes the energy is off by `w^4 / 240` of itself, as measured
//! on arcs of a quarter turn to three turns. Errors of rotation displace what follows along the body, so they add up along it.
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, A simple error estimator and adaptive procedure for practical engineering
//! analysis, Int. J. Numer. Methods Eng. 24 (1987): the mean of both sides of a node as the better value; C. de Boor,
//! A Practical Guide to Splines (1978), chapter IV: a cubic between nodes is off by its curvature's error times the square
//! of their distance.

use std::f64::consts::PI;

use nalgebra::Vector3;

use crate::bodies::{LineChain, Node};
use crate::elements::Element;
use crate::math::jet::Number;
use crate::math::rotation::rotation_vector;
use crate::math::space::{Vector, components};
use crate::system::{Evaluation, System};

/// An element that is bent uniformly by `w` rad is bent too far by about `w^5 / 240`.
const STIFFENING: f64 = 1.0 / 240.0;

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Returns the curvature error times the square of the element length, m. The result is the largest over inner
    /// nodes without a moment. A cable without such nodes uses its free ends, where curvature vanishes.
    pub fn missed(&self, system: &System<D>, chain: &LineChain<D>) -> N {
        let (elements, x) = (chain.elements(), &self.x[..]);
        let length = |j: usize| elements[j].length();
        let curvature = |j: usize, xi: f64| elements[j].curvature_change(&chain.element(j, x), xi);
        let is_free = |j: usize, end: usize| !system.takes_moments[chain.nodes(j)[end]];
        let (mut largest, mut tells) = (N::of(0.0), false);
        // Squares: the root of nothing has no derivatives.
        let mut take = |off: [N; 3], length: f64| {
            let square = off.iter().fold(N::of(0.0), |sum, c| sum + *c * *c);
            let square = square * N::of(length.powi(4));
            if square > largest {
                largest = square;
            }
        };
        for j in (1..elements.len()).filter(|j| is_free(*j, 0)) {
            let (before, after) = (curvature(j - 1, 1.0), curvature(j, 0.0));
            let half = |k: usize| (after[k] - before[k]) * N::of(0.5);
            take(std::array::from_fn(half), length(j - 1).max(length(j)));
            tells = true;
        }
        let last = elements.len() - 1;
        for (j, end) in [(0, 0), (last, 1)] {
            if !tells && is_free(j, end) {
                take(curvature(j, end as f64), length(j));
            }
        }
        // Curvatures are those by reference length, by which elements have not become longer.
        if largest > N::of(0.0) {
            largest.root() * chain.length_now(&self.drives).length_ratio()
        } else {
            largest
        }
    }
}

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// Displacement, m, that bending of whole elements makes of one end of a chain where the other one is held: the larger one of both
    /// ends. What elements are bent by as drawn, from these nodes, makes none.
    pub fn bent_away(&self, chain: &LineChain<D>, drawn: &[Node<D>]) -> N {
        let x = &self.x[..];
        let count = chain.elements().len();
        let place = |place: usize| {
            let node = match place {
                0 => chain.nodes(0)[0],
                place => chain.nodes(place - 1)[1],
            };
            Vector3::from(components(&Vector::from(x[node][0])))
        };
        let off = displaced(count, place, |j| bent_too_far(chain, j, x, drawn));
        if off > N::of(0.0) {
            off * chain.length_now(&self.drives).length_ratio()
        } else {
            off
        }
    }
}

/// Displacement, m, that errors of the rotations over elements make of one end of a line where the other one is held: the larger one of both
/// ends.
pub(super) fn displaced<N: Number>(
    elements: usize,
    place: impl Fn(usize) -> Vector3<N>,
    error: impl Fn(usize) -> Vector3<N>,
) -> N {
    let ends = [place(0), place(elements)];
    let mut sums = [Vector3::<N>::zeros(); 2];
    for j in 0..elements {
        let middle = (place(j) + place(j + 1)) * N::of(0.5);
        let error = error(j);
        for (sum, end) in sums.iter_mut().zip(&ends) {
            *sum += error.cross(&(end - middle));
        }
    }
    let [a, b] = sums.map(|sum| sum.norm_squared());
    let square = if a > b { a } else { b };
    if square > N::of(0.0) {
        square.root()
    } else {
        square
    }
}

/// Error of the rotation over an element, rad.
fn bent_too_far<const D: usize, N: Number>(
    chain: &LineChain<D>,
    j: usize,
    x: &[Node<D, N>],
    drawn: &[Node<D>],
) -> Vector3<N> {
    let tangents = chain
        .tangents(j, x)
        .map(|tangent| Vector3::from(components(&tangent)));
    let before = chain
        .tangents(j, drawn)
        .map(|tangent| Vector3::from(components(&tangent)));
    too_far::<D, N>(bend(tangents), bend(before))
}

/// Error of the rotation over an element that is bent by these rotation vectors now and as drawn, rad.
pub(super) fn too_far<const D: usize, N: Number>(
    now: Vector3<N>,
    before: Vector3<f64>,
) -> Vector3<N> {
    let fourth = |square: N| square * square;
    if D == 2 {
        let before = before.map(N::of);
        let part = |bend: Vector3<N>| bend * fourth(bend.norm_squared());
        return (part(now) - part(before)) * N::of(STIFFENING);
    }
    // How an axis of bending as drawn stands now is not known of a cable.
    let rest = N::of(before.norm_squared());
    now * ((fourth(now.norm_squared()) - fourth(rest)) * N::of(STIFFENING))
}

/// Rotation vector by which the tangent of an element, here from its first end to its last, rotates, rad. Of an element that folds back on itself it
/// is as long as all rotations on the way together, which have opposite directions there.
pub(super) fn bend<N: Number, const PLACES: usize>(tangents: [Vector3<N>; PLACES]) -> Vector3<N> {
    let (mut sum, mut way, mut folds) = (Vector3::zeros(), N::of(0.0), false);
    for pair in tangents.windows(2) {
        let (before, next) = (&pair[0], &pair[1]);
        let size = (before.norm_squared() * next.norm_squared()).root();
        let (cosine, sine) = (before.dot(next), before.cross(next));
        // The quaternion of the smallest rotation; none where tangents are opposite or there is none.
        let whole = (size * N::of(2.0) * (size + cosine)).root();
        let turn = if whole.plain() > 0.0 {
            let [a, b, c] = (sine / whole).into();
            rotation_vector(&[(size + cosine) / whole, a, b, c])
        } else {
            Vector3::zeros()
        };
        sum += turn;
        if cosine.plain() < 0.0 {
            folds = true;
            way += N::of(PI);
        } else if turn.norm_squared().plain() > 0.0 {
            way += turn.norm_squared().root();
        }
    }
    // Which way it folds nobody can tell: across the plane.
    if folds { Vector3::z() * way } else { sum }
}
