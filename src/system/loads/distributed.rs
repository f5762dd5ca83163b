//! A dead force per reference length of a cable or a rod.

use super::line_load::LineLoad;
use super::{ForceElement, Instant};
use crate::bodies::winch::{PaidOut, length_ratio};
use crate::bodies::{LoadedLine, Node};
use crate::elements::shape::{self, Values};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;
use crate::system::signal::Signal;

/// A distributed force.
#[derive(Clone, Debug)]
pub struct DistributedForce<const D: usize = 2> {
    /// Line that the force acts along.
    pub on: LoadedLine,
    /// Components, N/m.
    pub density: LineLoad<D>,
}

impl<const D: usize> DistributedForce<D> {
    /// Returns the uniform part of the load in global axes, N/m.
    pub(in crate::system) fn uniform<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        self.density.uniform(at) * self.length_ratio(at)
    }

    /// The cable, if a winch pays it out.
    fn paid_out<'a, N: Number>(&self, at: Instant<'a, D, N>) -> Option<PaidOut<'a, D, N>> {
        self.on.paid_out(at.bodies, at.drives)
    }

    fn length_ratio<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        length_ratio(self.paid_out(at).as_ref())
    }

    /// Returns the varying part of the load at the Gauss points of a segment, N/m.
    pub(in crate::system) fn values<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        segment: usize,
    ) -> Values<D, N> {
        let longer = self.length_ratio(at);
        self.density.changing(at, segment).map(|load| load * longer)
    }

    /// Forces on the nodes of what changes along the body, Gauss point by point, and what they are on position and direction.
    fn each_changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut add: impl FnMut(usize, [f64; 2], &Vector<D, N>),
    ) {
        if !self.density.changes() {
            return;
        }
        for segment in 0..self.on.segments(at.bodies) {
            for (point, load) in self.values(at, segment).iter().enumerate() {
                let point = self.on.point(at.bodies, segment, point);
                point.for_each_node(|node, weights| add(node, weights, load));
            }
        }
    }

    /// The integral of the load times a nodal field.
    fn along<N: Number>(&self, at: Instant<'_, D, N>, field: &[Node<D, N>]) -> N {
        let load = self.uniform(at);
        let mut sum = N::of(0.0);
        let mut add = |node: usize, weights: [f64; 2], load: &Vector<D, N>| {
            for (k, weight) in weights.into_iter().enumerate() {
                sum += load.dot(&Vector::from(field[node][k])) * N::of(weight);
            }
        };
        (self.on).for_each_integral(at.bodies, |node, weights| add(node, weights, &load));
        self.each_changing(at, add);
        sum
    }

    /// Power on the material that passes through the mesh of a cable that is paid out, W.
    fn on_convected<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        let (mut sum, uniform) = (N::of(0.0), self.uniform(at));
        let Some(paid_out) = self.paid_out(at) else {
            return sum;
        };
        let chain = paid_out.chain;
        for j in 0..chain.elements().len() {
            let (e, l) = (chain.element(j, at.x), chain.element_length(j));
            for (point, load) in GAUSS_5.iter().zip(self.values(at, j)) {
                let slope = e * shape::slopes(N::of(point.at), l);
                let passing = paid_out.convective_velocity((j, point.at), slope);
                sum += (uniform + load).dot(&passing) * N::of(point.weight * l);
            }
        }
        sum
    }
}

impl<const D: usize> ForceElement<D> for DistributedForce<D> {
    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        let load = self.uniform(at);
        let mut add = |node: usize, weights: [f64; 2], load: &Vector<D, N>| {
            for (k, weight) in weights.into_iter().enumerate() {
                for d in 0..D {
                    f[node][k][d] += load[d] * N::of(weight);
                }
            }
        };
        (self.on).for_each_integral(at.bodies, |node, weights| add(node, weights, &load));
        self.each_changing(at, add);
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [self.along(at, at.v) + self.on_convected(at), N::of(0.0)]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        self.along(before, after.x) - self.along(before, before.x)
    }

    fn changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Values<D, N>> {
        let is_on = self.density.changes() && self.on.first_node(at.bodies) == first;
        is_on.then(|| self.values(at, segment))
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.density.hold(at, fraction);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.density.signals().for_each(call);
    }
}
