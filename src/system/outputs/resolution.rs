//! How well the mesh of a cable carries the shape that it has.
//!
//! Curvature is continuous where nothing exerts a moment; that of the position field jumps at nodes. Half a jump is about
//! what curvature is off there, and that times the square of the length of the element what the shape misses
//! (docs/decisions/0036-resolution.md).
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, A simple error estimator and adaptive procedure for practical engineering
//! analysis, Int. J. Numer. Methods Eng. 24 (1987): the mean of both sides of a node as the better value; C. de Boor,
//! A Practical Guide to Splines (1978), chapter IV: a cubic between nodes is off by its curvature's error times the square
//! of their distance.

use crate::elements::Element;
use crate::math::jet::Number;
use crate::system::{CableChain, Evaluation, System};

impl<const D: usize, N: Number> Evaluation<D, N> {
    /// What curvature is off times the square of the length of the element, m: the largest over the nodes between elements
    /// where nothing exerts a moment; over such ends where there are no such nodes, since there curvature vanishes.
    pub fn missed(&self, system: &System<D>, chain: &CableChain<D>) -> N {
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
        match largest > N::of(0.0) {
            true => largest.root() * system.length_now(chain, &self.drives).longer_by(),
            false => largest,
        }
    }
}
