//! A moment per reference length of a rod or beam, about global axes (dead) or about the axes of the sections (a follower). Its power is
//! the integral of `m . w`, with the angular velocity `w` of the sections, so that it adds `-m` to the rate `M'` of the moment in a
//! section. Where it is dead, its work depends on the way on which sections rotate: it has no potential.
//!
//! Source: S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. (2005), section 8.2 (balance of moments of a rod); H. Ziegler, Principles
//! of Structural Stability, 2nd ed. (1977), section 5.2 (moments without a potential).

use super::line_load::LineLoad;
use super::{ForceElement, Instant};
use crate::bodies::{Bodies, Marker, Node, RodChain};
use crate::elements::section::Vectors;
use crate::math::jet::Number;
use crate::system::end::Attachment;
use crate::system::signal::Signal;

/// A distributed moment.
#[derive(Clone, Debug)]
pub struct DistributedMoment {
    /// Index of the rod or beam that the moment acts along. Its segments are the elements.
    pub on: usize,
    /// The first end of that.
    pub end: Marker,
    /// Whether it rotates with the sections.
    pub follower: bool,
    /// Components along global axes or those of the sections, N m/m.
    pub density: LineLoad<3>,
}

impl DistributedMoment {
    /// Moments in global components at the Gauss points of an element, N m/m.
    fn moments<const D: usize, N: Number>(
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
            at.bodies.all_sections()[self.on].outward(element, at.x, &moments)
        } else {
            moments
        }
    }

    fn rod<'a, const D: usize, N>(&self, at: Instant<'a, D, N>) -> &'a RodChain {
        &at.bodies.all_sections()[self.on]
    }
}

impl<const D: usize> ForceElement<D> for DistributedMoment {
    /// Adds its forces on an element.
    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, element: usize, f: &mut [Node<D, N>]) {
        let force = self
            .rod(at)
            .loaded(element, at.x, &self.moments(at, element));
        self.rod(at).add_load(element, &force, at.x, f);
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        for element in 0..self.rod(at).count() {
            self.add_part(at, element, f);
        }
    }

    fn changing_moments<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Vectors<N>> {
        (self.rod(at).line() == first).then(|| self.moments(at, segment))
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let rod = self.rod(at);
        let mut sum = N::of(0.0);
        for element in 0..rod.count() {
            let force = rod.loaded(element, at.x, &self.moments(at, element));
            sum += rod.power_of((element, &force), (at.x, at.v));
        }
        [sum, N::of(0.0)]
    }

    /// Exact for small rotations.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let rod = self.rod(before);
        let work = (0..rod.count()).map(|element| {
            let moments = self.moments(before, element);
            let force = rod.loaded(element, before.x, &moments);
            rod.work_of((element, &force), [before.x, after.x])
        });
        work.sum()
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.density.hold(at, fraction);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.density.signals().for_each(call);
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn is_moment(&self) -> bool {
        true
    }

    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let rod = &bodies.all_sections()[self.on];
        let elements = 0..rod.count();
        elements.map(|j| rod.all_nodes(j).to_vec()).collect()
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        vec![Attachment::Body(self.end)]
    }
}
