//! A fluid that streams past a plate or shell: drag, inertia of the fluid and buoyancy per area of the unstressed surface. With the velocity
//! `u` of the fluid less that of the surface, its parts `u_n` along the normal and `u_t` in the surface, and the thickness `h`
//!
//! `f = C_n rho |u_n| u_n / 2 + C_t rho |u_t| u_t / 2 + rho h (du/dt - g)`,
//!
//! `du/dt` that of the fluid at a fixed place, `g` the gravitational acceleration.
//!
//! Source: S. F. Hoerner, Fluid-Dynamic Drag (1965) (pressure by the normal part of the velocity, friction by the tangential one, and
//! their coefficients); J. R. Morison, M. P. O'Brien, J. W. Johnson, S. A. Schaaf, The force exerted by surface waves on piles, Journal of
//! Petroleum Technology 2 (1950) 149-154 (inertia of the fluid).

use nalgebra::{Matrix3, Vector3};

use super::area_load::AreaValues;
use super::fluid::{Flow, FluidSegment};
use super::{Add, ForceElement, Instant, LoadedSurface};
use crate::bodies::{Bodies, Node};
use crate::elements::shell::{AREA_PLACES, ElementCorners};
use crate::math::jet::Number;
use crate::math::space::spun;
use crate::system::signal::Signal;

/// A fluid along a plate or shell.
#[derive(Clone, Debug)]
pub struct SurfaceFluid {
    /// Surface that it acts on.
    pub on: LoadedSurface,
    /// Coefficients per area at the places of quadrature, element by element.
    pub places: Vec<FluidSegment>,
    /// Velocity of the fluid, m/s.
    pub current: [AreaValues; 3],
    /// Gravitational acceleration, m/s^2.
    pub gravity: [f64; 3],
    /// Velocity of the body as a whole beside its rates, where equilibria are sought in a steady motion: that of the origin, m/s, and
    /// angular velocity, rad/s.
    pub carried: [[f64; 3]; 2],
    /// Part of the force that acts.
    pub fraction: f64,
}

/// Flow past a place of an element.
struct PlaceFlow<N> {
    flow: Flow<3, N>,
    /// Velocity of the surface, m/s.
    velocity: Vector3<N>,
    /// Force per area of the unstressed surface, N/m^2.
    force: Vector3<N>,
}

impl SurfaceFluid {
    /// Flow at the places of quadrature of an element.
    fn flows<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> [PlaceFlow<N>; AREA_PLACES] {
        let patch = self.on.patch(at.bodies);
        let of = &patch.elements()[element];
        let (x, v) = (patch.element(element, at.x), patch.element(element, at.v));
        let current = (self.current.each_ref())
            .map(|values| values.each_place(element, |signal| signal.value(at)));
        let rates = (self.current.each_ref())
            .map(|values| values.each_place(element, |signal| signal.rate(at)));
        let [steady, spin] = self.carried;
        std::array::from_fn(|place| {
            let [first, second] = of.tangents(&x, place);
            let velocity = of.at_place(&v, place);
            let mut past = Vector3::from(current.map(|of| of[place])) - velocity;
            past -= Vector3::from(steady.map(N::of)) + spun(spin, of.at_place(&x, place));
            let flow = Flow::new(past, first.cross(&second));
            let FluidSegment {
                drag,
                buoyant,
                inert,
            } = self.places[AREA_PLACES * element + place];
            let rate = Vector3::from(rates.map(|of| of[place]));
            let lift = Vector3::from(self.gravity.map(|part| N::of(-buoyant * part)));
            let force = flow.drag(drag) + rate * N::of(inert) + lift;
            PlaceFlow {
                flow,
                velocity,
                force: force * N::of(self.fraction),
            }
        })
    }

    /// Forces on the corners of an element.
    fn force<const D: usize, N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> ElementCorners<N> {
        let load = self.flows(at, element).map(|flow| flow.force.into());
        self.on.patch(at.bodies).elements()[element].varying_area_force(&load)
    }

    /// Whether there is drag.
    fn is_dragged(&self) -> bool {
        self.places.iter().any(|of| of.drag != [0.0; 2])
    }

    /// Whether it can do without a potential: buoyancy alone acts on what rests in a fluid at rest.
    pub(super) fn streams(&self) -> bool {
        let is_carried = self.carried != [[0.0; 3]; 2];
        let mut signals = self.current.iter().flat_map(AreaValues::signals);
        self.is_dragged() && (is_carried || !signals.all(Signal::is_zero))
    }
}

impl<const D: usize> ForceElement<D> for SurfaceFluid {
    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        self.on.parts(bodies)
    }

    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        let force = self.force(at, part);
        self.on.add(at.bodies, part, (&force, f));
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        for element in 0..self.on.count(at.bodies) {
            self.add_part(at, element, f);
        }
    }

    /// Adds the damping matrix of drag. Derivatives by the rotation of the surface are left out: they are not symmetric, and steps
    /// converge without them.
    fn add_tangent(&self, at: Instant<'_, D>, _stiffness: Add<'_, D>, damping: Add<'_, D>) {
        if !self.is_dragged() {
            return;
        }
        let patch = self.on.patch(at.bodies);
        for (index, element) in patch.elements().iter().enumerate() {
            let flows = self.flows(at, index);
            let matrices: [Matrix3<f64>; AREA_PLACES] = std::array::from_fn(|place| {
                let drag = self.places[AREA_PLACES * index + place].drag;
                flows[place].flow.damping(drag) * self.fraction
            });
            let blocks = element.area_matrix(&matrices);
            self.on.add_matrix(at.bodies, index, (&blocks, damping));
        }
    }

    /// Returns the power that the fluid supplies by its motion and by buoyancy, and the power that drag dissipates, W.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let (mut on_surface, mut lost) = (N::of(0.0), N::of(0.0));
        for (index, element) in self.on.patch(at.bodies).elements().iter().enumerate() {
            let places = self.places[AREA_PLACES * index..].iter();
            let places = places.zip(element.place_areas());
            for (flow, (own, area)) in self.flows(at, index).iter().zip(places) {
                let drag = flow.flow.drag(own.drag) * N::of(self.fraction * area);
                on_surface += flow.force.dot(&flow.velocity) * N::of(*area);
                lost += drag.dot(&flow.flow.past());
            }
        }
        [on_surface + lost, lost]
    }

    /// Returns the work from one instant to another of forces that stay as they were at the first, J.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let patch = self.on.patch(before.bodies);
        let mut sum = 0.0;
        for (index, element) in patch.elements().iter().enumerate() {
            let [from, to] = [before, after].map(|at| patch.element(index, at.x));
            let flows = self.flows(before, index);
            for (place, (flow, area)) in flows.iter().zip(element.place_areas()).enumerate() {
                let way = element.at_place(&to, place) - element.at_place(&from, place);
                sum += flow.force.dot(&way) * area;
            }
        }
        sum
    }

    /// Becomes a fraction of what it is, from then on, the current as it is at an instant.
    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.current.iter_mut().for_each(|of| of.hold(at, 1.0));
        self.fraction *= fraction;
    }

    fn is_damped(&self) -> bool {
        self.is_dragged()
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        let signals = self.current.iter().flat_map(AreaValues::signals);
        signals.for_each(call);
    }

    fn is_conservative(&self) -> bool {
        !self.streams()
    }
}
