//! Cables that a winch pays out or takes in at one of their ends. Their mesh lengthens evenly with them, so that material passes through it:
//! with `g = L / L_0` the length now over that of reference, and `xi` the part of it from the other end to a place (1 at the winch), a
//! point of the cable moves through the mesh at `xi c` with `c = L' / L`, away from the winch, and
//!
//! `v = dr/dt + xi c L_0 r'`,
//! `a = d^2r/dt^2 + 2 xi c L_0 dr'/dt + (xi c L_0)^2 r'' + xi (L''/L - 2 c^2) L_0 r'`,
//!
//! `r' = dr/ds` by the reference length on the way from the winch. The mass is `g M_0`; over coordinates `u` with `x = x_ref + u / sqrt(g)` it is `M_0`, whatever the
//! length: the identity inertia of [`Elimination`](super::Elimination) stays, and what lengthening adds to accelerations of the nodes
//! is known from positions and rates.
//!
//! Sources: M. Stangl, J. Gerstmayr, H. Irschik, An alternative approach for the analysis of nonlinear vibrations of pipes conveying fluid,
//! J. Sound Vib. 310 (2008) 493-511 (material that passes through a mesh); W. D. Zhu, J. Ni, Energetics and stability of translating media
//! with an arbitrarily varying length, J. Vib. Acoust. 122 (2000) 295-304 (equation of motion, energy that comes in).

mod scaling;

use std::ops::Range;

use super::{LineChain, Node};
use crate::elements::shape::{Values, on_coordinates};
use crate::elements::{Element, Nodal, shape};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;

/// A cable that is paid out.
#[derive(Clone, Debug)]
pub struct Winch<const D: usize = 2> {
    /// Whether the winch is at its last end.
    pub at_last: bool,
    /// Driven coordinate: the length that has been paid out, m.
    pub coordinate: usize,
    /// Nodes of the chain.
    pub nodes: Range<usize>,
    /// Reference length, m.
    pub length: f64,
    /// Where elements begin, from the first end by the reference length, m.
    pub starts: Vec<f64>,
    /// Mass per length, kg/m.
    pub density: f64,
    /// Gravitational acceleration, m/s^2.
    pub gravity: Vector<D>,
}

/// A cable that is paid out, at an instant.
#[derive(Clone, Copy, Debug)]
pub struct PaidOut<'a, const D: usize, N> {
    /// Winch that pays the cable out.
    pub winch: &'a Winch<D>,
    /// The cable.
    pub chain: &'a LineChain<D>,
    /// How long it is.
    pub now: Length<N>,
}

impl<const D: usize, N: Number> PaidOut<'_, D, N> {
    /// Velocity at which material passes a place of the mesh, from the slope `r'` there, m/s.
    pub fn convective_velocity(
        &self,
        (element, at): (usize, f64),
        slope: Vector<D, N>,
    ) -> Vector<D, N> {
        let way = self.winch.way(self.chain, element, at);
        slope * (self.now.rate * N::of(way))
    }

    /// Length that is paid out in time, `L'`, m/s.
    pub fn speed(&self) -> N {
        self.now.rate * N::of(self.winch.length) / self.now.by
    }
}

/// The length now over the reference length; 1 of what no winch pays out.
pub fn length_ratio<const D: usize, N: Number>(paid_out: Option<&PaidOut<'_, D, N>>) -> N {
    paid_out.map_or_else(|| N::of(1.0), |paid_out| paid_out.now.length_ratio())
}

/// Ratio `g` of present and reference length of a cable, with its time derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length<N> {
    /// Reference length over the length now, `1 / g`.
    pub by: N,
    /// Square root `s = sqrt(1 / g)` and its first two time derivatives.
    pub root: [N; 3],
    /// `L' / L`, 1/s.
    pub rate: N,
    /// `L'' / L`, 1/s^2.
    pub second: N,
}

impl<N: Number> Length<N> {
    /// Returns `1 / g` and `L' / L` (1/s), which the chain of the cable needs.
    pub fn scaling(&self) -> [N; 2] {
        [self.by, self.rate]
    }

    /// `g`, the length now over the reference length.
    pub fn length_ratio(&self) -> N {
        N::of(1.0) / self.by
    }

    /// Returns the ratio of a cable at its reference length.
    pub fn same() -> Self {
        let [zero, one] = [0.0, 1.0].map(N::of);
        Self {
            by: one,
            root: [one, zero, zero],
            rate: zero,
            second: zero,
        }
    }
}

impl<const D: usize> Winch<D> {
    /// Builds the winch of a chain. `at_last` selects the paid-out end, `coordinate` is the driven one, its length.
    pub fn new(
        chain: &LineChain<D>,
        (at_last, coordinate): (bool, usize),
        gravity: Vector<D>,
    ) -> Self {
        let length = chain.length();
        let mut at = 0.0;
        let starts = chain.elements().iter().map(|element| {
            let start = at;
            at += element.length();
            start
        });
        Self {
            at_last,
            coordinate,
            nodes: chain.range(),
            length,
            starts: starts.collect(),
            density: chain.mass() / length,
            gravity,
        }
    }

    /// The node at the winch.
    pub fn end(&self) -> usize {
        if self.at_last {
            self.nodes.end - 1
        } else {
            self.nodes.start
        }
    }

    /// How long the cable is.
    pub fn now<N: Number>(&self, drives: &[[N; 3]]) -> Length<N> {
        let [travel, rate, second] = drives[self.coordinate];
        let length = travel + N::of(self.length);
        let by = N::of(self.length) / length;
        let (rate, second) = (rate / length, second / length);
        let root = by.root();
        Length {
            by,
            root: [
                root,
                -root * rate * N::of(0.5),
                root * (rate * rate * N::of(0.75) - second * N::of(0.5)),
            ],
            rate,
            second,
        }
    }

    /// `xi L_0` at a place in an element, m; negative where the way from the winch leads to the first end.
    fn way(&self, chain: &LineChain<D>, element: usize, at: f64) -> f64 {
        let place = self.starts[element] + at * chain.element_length(element);
        if self.at_last {
            -place
        } else {
            self.length - place
        }
    }

    /// Velocity at which material passes a place of the mesh, `xi c L_0 r'`, m/s.
    fn convective_velocity<N: Number>(
        &self,
        (chain, j, xi): (&LineChain<D>, usize, f64),
        e: &Nodal<D, N>,
        now: &Length<N>,
    ) -> Vector<D, N> {
        let slope = e * shape::slopes(N::of(xi), chain.element_length(j));
        let (winch, now) = (self, *now);
        PaidOut { winch, chain, now }.convective_velocity((j, xi), slope)
    }

    /// Inertia forces of the accelerations of the material that follow from positions and rates of the mesh, at the Gauss points of an
    /// element per reference length, N/m.
    pub fn transport<N: Number>(
        &self,
        chain: &LineChain<D>,
        j: usize,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        now: &Length<N>,
    ) -> Values<D, N> {
        let l = chain.element_length(j);
        let [e, rates] = [x, v].map(|of| chain.element(j, of));
        let twice = now.second - now.rate * now.rate * N::of(2.0);
        let density = N::of(-self.density) / now.by;
        GAUSS_5.map(|point| {
            let xi = N::of(point.at);
            let way = N::of(self.way(chain, j, point.at));
            let (slopes, passed) = (shape::slopes(xi, l), way * now.rate);
            let acceleration = rates * slopes * (passed * N::of(2.0))
                + e * shape::curvatures(xi, l) * (passed * passed)
                + e * slopes * (way * twice);
            acceleration * density
        })
    }

    /// Momentum of the material that passes through the mesh, over the coordinates of an element, kg m/s and kg m^2/s.
    pub fn convective_momentum<N: Number>(
        &self,
        chain: &LineChain<D>,
        j: usize,
        x: &[Node<D, N>],
        now: &Length<N>,
    ) -> Nodal<D, N> {
        let (e, density) = (chain.element(j, x), N::of(self.density) / now.by);
        let passing =
            GAUSS_5.map(|point| self.convective_velocity((chain, j, point.at), &e, now) * density);
        on_coordinates(&passing, chain.element_length(j))
    }

    /// Kinetic energy of the cable, J.
    pub fn kinetic<N: Number>(
        &self,
        chain: &LineChain<D>,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        now: &Length<N>,
    ) -> N {
        let mut sum = N::of(0.0);
        for (j, element) in chain.elements().iter().enumerate() {
            let (l, [e, rates]) = (element.length(), [x, v].map(|of| chain.element(j, of)));
            sum += (rates * element.mass().map(N::of)).dot(&rates) * N::of(0.5);
            for point in &GAUSS_5 {
                let passing = self.convective_velocity((chain, j, point.at), &e, now);
                let mesh = rates * shape::values(N::of(point.at), l);
                let twice = passing.dot(&(mesh * N::of(2.0) + passing));
                sum += twice * N::of(0.5 * self.density * point.weight * l);
            }
        }
        sum / now.by
    }

    /// Power that comes in with the material, W: its energy, and what the winch does against the axial force where it leaves it.
    pub fn power<N: Number>(
        &self,
        chain: &LineChain<D>,
        (x, v): (&[Node<D, N>], &[Node<D, N>]),
        now: &Length<N>,
    ) -> N {
        let (j, xi) = if self.at_last {
            (chain.elements().len() - 1, 1.0)
        } else {
            (0, 0.0)
        };
        let (element, [e, rates]) = (&chain.elements()[j], [x, v].map(|of| chain.element(j, of)));
        let l = element.length();
        let place = e * shape::values(N::of(xi), l);
        let velocity =
            rates * shape::values(N::of(xi), l) + self.convective_velocity((chain, j, xi), &e, now);
        let (at, rate) = (e * now.by, (rates - e * now.rate) * now.by);
        let strain = element.recovered_strain(&at, None, xi);
        let total = element.recovered_strain(&at, Some(&rate), xi);
        let stiffness = N::of(element.axial_stiffness());
        let (tension, stored) = (total * stiffness, strain * strain * stiffness * N::of(0.5));
        let density = N::of(self.density);
        let energy = (velocity.norm_squared() * N::of(0.5) - place.dot(&self.gravity.map(N::of)))
            * density
            + stored;
        let rate = now.rate * N::of(self.length) / now.by;
        rate * (energy - tension * (strain + N::of(1.0)))
    }
}
