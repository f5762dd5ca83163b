//! A moment per reference length of a rod or beam, about global axes (dead) or about the axes of the sections (a follower). Its power is
//! the integral of `m . w`, with the angular velocity `w` of the sections, so that it adds `-m` to the rate `M'` of the moment in a
//! section. Where it is dead, its work depends on the way on which sections turn: it has no potential.
//!
//! Source: S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. (2005), section 8.2 (balance of moments of a rod); H. Ziegler, Principles
//! of Structural Stability, 2nd ed. (1977), section 5.2 (moments without a potential).

use super::Instant;
use super::line_load::LineLoad;
use crate::bodies::{Marker, Node, RodChain};
use crate::elements::section::Vectors;
use crate::math::jet::Number;

/// A distributed moment.
#[derive(Clone, Debug)]
pub struct DistributedMoment {
    /// Index of the rod or beam that the moment acts along. Its segments are the elements.
    pub on: usize,
    /// The first end of that.
    pub end: Marker,
    /// Whether it turns with the sections.
    pub follower: bool,
    /// Components along global axes or those of the sections, N m/m.
    pub density: LineLoad<3>,
}

impl DistributedMoment {
    /// Moments in global components at the Gauss points of an element, N m/m.
    pub(in crate::system) fn moments<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> Vectors<N> {
        let uniform = self.density.uniform(at);
        let moments = if self.density.changes() {
            self.density
                .changing(at, element)
                .map(|here| here + uniform)
        } else {
            [uniform; _]
        };
        let moments = moments.map(Into::into);
        if self.follower {
            at.bodies.rod_chains[self.on].outward(element, at.x, &moments)
        } else {
            moments
        }
    }

    fn rod<'a, const D: usize, N>(&self, at: Instant<'a, D, N>) -> &'a RodChain {
        &at.bodies.rod_chains[self.on]
    }

    /// Adds its forces on an element.
    pub(super) fn add_force_on<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
        f: &mut [Node<D, N>],
    ) {
        let force = self
            .rod(at)
            .loaded(element, at.x, &self.moments(at, element));
        self.rod(at).add_load(element, &force, at.x, f);
    }

    pub(super) fn add_force<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        f: &mut [Node<D, N>],
    ) {
        for element in 0..self.rod(at).count() {
            self.add_force_on(at, element, f);
        }
    }

    pub(super) fn power<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let rod = self.rod(at);
        let mut sum = N::of(0.0);
        for element in 0..rod.count() {
            let force = rod.loaded(element, at.x, &self.moments(at, element));
            sum += rod.power_of((element, &force), (at.x, at.v), &at.bodies.frames);
        }
        sum
    }

    /// Exact for small turns.
    pub(super) fn work<const D: usize>(
        &self,
        before: Instant<'_, D>,
        after: Instant<'_, D>,
    ) -> f64 {
        let rod = self.rod(before);
        let work = (0..rod.count()).map(|element| {
            let moments = self.moments(before, element);
            let force = rod.loaded(element, before.x, &moments);
            rod.work_of((element, &force), [before.x, after.x])
        });
        work.sum()
    }
}
