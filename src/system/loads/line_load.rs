//! Vectors per reference length of a body. A component is the same along the whole body, or changes along it and is known at the Gauss
//! points of every segment, which is an element of a cable: between them it is the polynomial of degree 4 through these values.
//! Integrals of its products with shape functions are exact where it is of degree 6 at most, those up to a place inside of degree 4.
//!
//! Source: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 25.4.29 (Gauss's rule).

use super::Instant;
use crate::elements::shape::Values;
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;
use crate::system::signal::Signal;

/// A vector per reference length, 1/m times its unit.
#[derive(Clone, Debug)]
pub struct LineLoad<const K: usize> {
    /// Components that are the same everywhere; zero of those that change.
    pub uniform: [Signal; K],
    /// Components that change, at the Gauss points of every segment in turn; empty of those that do not.
    pub along: [Vec<Signal>; K],
}

impl<const K: usize> LineLoad<K> {
    /// Whether a component changes along the body.
    pub fn changes(&self) -> bool {
        self.along.iter().any(|values| !values.is_empty())
    }

    /// Components that are the same everywhere.
    pub fn uniform<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> Vector<K, N> {
        self.uniform.each_ref().map(|c| c.value(at)).into()
    }

    /// All components at a Gauss point, by its number along the whole body.
    pub fn value<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        place: usize,
    ) -> Vector<K, N> {
        Vector::from(std::array::from_fn(|k| {
            let here = self.along[k].get(place).unwrap_or(&self.uniform[k]);
            here.value(at)
        }))
    }

    /// Components that change, in a segment.
    pub fn changing<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        segment: usize,
    ) -> Values<K, N> {
        std::array::from_fn(|point| {
            let place = GAUSS_5.len() * segment + point;
            let here = |values: &Vec<Signal>| values.get(place).map(|signal| signal.value(at));
            let values = self.along.each_ref().map(here);
            values.map(|value| value.unwrap_or(N::of(0.0))).into()
        })
    }

    /// All that its components are made of.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        self.uniform.iter().chain(self.along.iter().flatten())
    }

    /// Becomes a fraction of what it is at an instant, from then on.
    pub fn hold<const D: usize>(&mut self, at: Instant<'_, D>, fraction: f64) {
        let along = self.along.iter_mut().flatten();
        for signal in self.uniform.iter_mut().chain(along) {
            *signal = signal.held(at, fraction);
        }
    }
}
