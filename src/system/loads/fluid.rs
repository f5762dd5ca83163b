//! A fluid that streams past a cable, rod or beam: drag, inertia of the fluid and buoyancy per reference length. With the velocity `u` of
//! the fluid less that of the line, its parts `u_t` along the tangent and `u_n` across it, the displaced area `A` and the diameter `D`
//!
//! `f = C_d rho D |u_n| u_n / 2 + C_t rho pi D |u_t| u_t / 2 + rho A (1 + C_a) du/dt - rho A g`,
//!
//! `du/dt` that of the fluid at a fixed place, `g` the gravitational acceleration. The rest, `-rho A C_a` times the acceleration of the
//! line, is in the mass matrix (docs/decisions/0056-added-mass.md).
//!
//! Source: J. R. Morison, M. P. O'Brien, J. W. Johnson, S. A. Schaaf, The force exerted by surface waves on piles, Journal of Petroleum
//! Technology 2 (1950) 149-154 (drag and inertia); M. Hall, A. Goupee, Validation of a lumped-mass mooring line model with DeepCwind
//! semisubmersible model test data, Ocean Engineering 104 (2015) 590-603, Eqs. 9-14 (along and across a line).

use crate::elements::shape::Values;
use nalgebra::SMatrix;

use super::line_load::LineLoad;
use super::{Add, ForceElement, Instant};
use crate::bodies::winch::{PaidOut, length_ratio};
use crate::bodies::{Bodies, LinePoint, LoadedLine, Node, no_block};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::{Vector, spun};
use crate::system::signal::Signal;

/// Coefficients of a fluid at a point of a line, per reference length, or of a surface, per reference area.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidSegment {
    /// Drag across the tangent of a line or the normal of a surface, and along it: force by the square of the velocity, N s^2/m^3 or
    /// N s^2/m^4.
    pub drag: [f64; 2],
    /// Mass of the fluid that is displaced and has weight, kg/m or kg/m^2: none without buoyancy.
    pub buoyant: f64,
    /// Mass of the displaced fluid and of that which moves along, kg/m or kg/m^2: the acceleration of the fluid acts on it.
    pub inert: f64,
}

/// A fluid along a body.
#[derive(Clone, Debug)]
pub struct Fluid<const D: usize = 2> {
    /// Line that the fluid acts on.
    pub on: LoadedLine,
    /// Coefficients at the Gauss points of all segments, one segment after another.
    pub strips: Vec<FluidSegment>,
    /// Velocity of the fluid, m/s.
    pub current: LineLoad<D>,
    /// Gravitational acceleration, m/s^2.
    pub gravity: Vector<D>,
    /// Velocity of the body as a whole beside its rates, where equilibria are sought in a steady motion: that of the origin, m/s, and
    /// angular velocity, rad/s.
    pub carried: (Vector<D>, [f64; 3]),
    /// Part of the force that acts.
    pub fraction: f64,
}

/// Velocity of the fluid relative to a place, m/s: its parts along an axis and across it. The axis is the tangent of a line or the normal of
/// a surface.
pub(super) struct Flow<const D: usize, N> {
    /// Unit vector along the axis.
    axis: Vector<D, N>,
    along: N,
    across: Vector<D, N>,
    /// Size of the part across.
    speed: N,
}

/// Flow past a point of a line.
struct LineFlow<const D: usize, N> {
    flow: Flow<D, N>,
    /// Velocity of the line, m/s.
    velocity: Vector<D, N>,
    /// How much of what is per reference length counts: the fraction, times the length now over that.
    counts: N,
}

/// The length of a vector; none, without derivatives, of a vector that is zero.
fn length<const D: usize, N: Number>(v: &Vector<D, N>) -> N {
    if v.iter().all(|part| part.plain() == 0.0) {
        N::of(0.0)
    } else {
        v.norm()
    }
}

/// The size of a number.
fn size<N: Number>(of: N) -> N {
    if of.plain() < 0.0 { -of } else { of }
}

impl<const D: usize, N: Number> Flow<D, N> {
    /// Parts of a relative velocity along the direction of a vector and across it.
    pub(super) fn new(past: Vector<D, N>, direction: Vector<D, N>) -> Self {
        let axis = direction / direction.norm();
        let along = axis.dot(&past);
        let across = past - axis * along;
        Self {
            speed: length(&across),
            axis,
            along,
            across,
        }
    }

    /// Drag by its coefficients across and along: N/m or N/m^2.
    pub(super) fn drag(&self, [across, along]: [f64; 2]) -> Vector<D, N> {
        let pushed = self.across * (N::of(across) * self.speed);
        pushed + self.axis * (N::of(along) * size(self.along) * self.along)
    }

    /// The whole relative velocity, m/s.
    pub(super) fn past(&self) -> Vector<D, N> {
        self.across + self.axis * self.along
    }
}

impl<const D: usize> Flow<D, f64> {
    /// Derivative of the drag by the relative velocity: N s/m^2 or N s/m^3.
    pub(super) fn damping(&self, [across, along]: [f64; 2]) -> SMatrix<f64, D, D> {
        let tangent = self.axis * self.axis.transpose();
        let mut damping = tangent * (2.0 * along * self.along.abs());
        if self.speed > 0.0 {
            let turned = self.across * self.across.transpose() / self.speed;
            let even = (SMatrix::identity() - tangent) * self.speed;
            damping += (even + turned) * across;
        }
        damping
    }
}

impl<const D: usize> Fluid<D> {
    /// Number of its segments.
    fn segments(&self) -> usize {
        self.strips.len() / GAUSS_5.len()
    }

    /// The current at the Gauss points of a segment by what its components are: their values or their rates.
    fn current<N: Number>(&self, segment: usize, of: impl Fn(&Signal) -> N + Copy) -> Values<D, N> {
        let uniform: Vector<D, N> = self.current.uniform.each_ref().map(of).into();
        std::array::from_fn(|point| {
            let place = GAUSS_5.len() * segment + point;
            let here = |values: &Vec<Signal>| values.get(place).map_or(N::of(0.0), of);
            uniform + Vector::from(self.current.along.each_ref().map(here))
        })
    }

    fn flow<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        (place, (segment, xi)): (&LinePoint, (usize, f64)),
        (current, paid_out): (Vector<D, N>, Option<&PaidOut<'_, D, N>>),
    ) -> LineFlow<D, N> {
        let (velocity, rate) = self.carried;
        let mut carried = velocity.map(N::of);
        if rate != [0.0; 3] {
            carried += spun(rate, place.sum(&place.position, at.x));
        }
        let slope = place.sum(&place.slope, at.x);
        let mut velocity = place.sum(&place.position, at.v);
        if let Some(paid_out) = paid_out {
            velocity += paid_out.convective_velocity((segment, xi), slope);
        }
        let past = current - velocity - carried;
        LineFlow {
            flow: Flow::new(past, slope),
            velocity,
            counts: N::of(self.fraction) * length_ratio(paid_out),
        }
    }

    /// Calls with every Gauss point of a segment, the flow and what the fluid does there, and the whole force, N/m.
    fn each<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        segment: usize,
        mut call: impl FnMut(&LinePoint, &LineFlow<D, N>, &FluidSegment, Vector<D, N>),
    ) {
        let current = self.current(segment, |signal| signal.value(at));
        let rates = self.current(segment, |signal| signal.rate(at));
        let paid_out = self.on.paid_out(at.bodies, at.drives);
        for (point, (current, rate)) in current.into_iter().zip(rates).enumerate() {
            let strip = &self.strips[GAUSS_5.len() * segment + point];
            let place = self.on.point(at.bodies, segment, point);
            let on = (&place, (segment, GAUSS_5[point].at));
            let flow = self.flow(at, on, (current, paid_out.as_ref()));
            let force = flow.flow.drag(strip.drag) + rate * N::of(strip.inert)
                - (self.gravity * strip.buoyant).map(N::of);
            call(&place, &flow, strip, force * flow.counts);
        }
    }

    /// Forces at the Gauss points of a segment, N/m.
    pub(in crate::system) fn values<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        segment: usize,
    ) -> Values<D, N> {
        let (mut values, mut point) = ([Vector::zeros(); GAUSS_5.len()], 0);
        self.each(at, segment, |_, _, _, force| {
            values[point] = force;
            point += 1;
        });
        values
    }

    /// Whether it can do without a potential: buoyancy alone acts on what rests in a fluid at rest.
    pub(super) fn streams(&self) -> bool {
        let (velocity, rate) = self.carried;
        let is_carried = velocity != Vector::<D>::zeros() || rate != [0.0; 3];
        self.is_damped() && (is_carried || !self.current.signals().all(Signal::is_zero))
    }
}

impl<const D: usize> ForceElement<D> for Fluid<D> {
    /// Nodes of its segments.
    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        let segments = 0..self.segments();
        let nodes = segments.map(|j| self.on.nodes(bodies, j).to_vec());
        nodes.collect()
    }

    /// Adds its forces on a segment.
    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, segment: usize, f: &mut [Node<D, N>]) {
        self.each(at, segment, |place, _, _, force| {
            for (k, part) in place.position.into_iter().enumerate() {
                let on = force * N::of(part * place.weight);
                let node = &mut f[place.nodes[k / 2]][k % 2];
                (node.iter_mut().zip(&on)).for_each(|(sum, on)| *sum += *on);
            }
        });
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        for segment in 0..self.segments() {
            self.add_part(at, segment, f);
        }
    }

    /// Adds the damping matrix of drag. Its derivatives with respect to the rotation of the line are left out: they are
    /// not symmetric, and steps converge without them.
    fn add_tangent(&self, at: Instant<'_, D>, _stiffness: Add<'_, D>, damping: Add<'_, D>) {
        if !self.is_damped() {
            return;
        }
        for segment in 0..self.segments() {
            let [mut first, mut between, mut last] = [no_block(); 3];
            let mut nodes = [0; 2];
            self.each(at, segment, |place, flow, strip, _| {
                let matrix = flow.flow.damping(strip.drag) * (place.weight * flow.counts);
                nodes = place.nodes;
                for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    for (block, [row, column]) in [
                        (&mut first, [p, q]),
                        (&mut between, [2 + p, q]),
                        (&mut last, [2 + p, 2 + q]),
                    ] {
                        let weight = place.position[row] * place.position[column];
                        for (r, c) in (0..D).flat_map(|r| (0..D).map(move |c| (r, c))) {
                            block[p][r][q][c] += weight * matrix[(r, c)];
                        }
                    }
                }
            });
            let [a, b] = nodes;
            damping(a, a, &first);
            if a != b {
                damping(b, a, &between);
                damping(b, b, &last);
            }
        }
    }

    /// Returns the power that the fluid supplies by its motion and by buoyancy, and the power that drag dissipates, W.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let (mut on_line, mut lost) = (N::of(0.0), N::of(0.0));
        for segment in 0..self.segments() {
            self.each(at, segment, |place, flow, strip, force| {
                let weight = N::of(place.weight);
                let drag = flow.flow.drag(strip.drag) * flow.counts;
                on_line += force.dot(&flow.velocity) * weight;
                lost += drag.dot(&flow.flow.past()) * weight;
            });
        }
        [on_line + lost, lost]
    }

    /// Returns the work from one instant to another of forces that stay as they were at the first, J.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let mut sum = 0.0;
        for segment in 0..self.segments() {
            self.each(before, segment, |place, _, _, force| {
                let [from, to] = [before, after].map(|at| place.sum(&place.position, at.x));
                sum += force.dot(&(to - from)) * place.weight;
            });
        }
        sum
    }

    /// Becomes a fraction of what it is, from then on, the current as it is at an instant.
    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.current.hold(at, 1.0);
        self.fraction *= fraction;
    }

    /// Whether its velocity takes something out.
    fn is_damped(&self) -> bool {
        self.strips.iter().any(|strip| strip.drag != [0.0; 2])
    }

    fn changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Values<D, N>> {
        (self.on.first_node(at.bodies) == first).then(|| self.values(at, segment))
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.current.signals().for_each(call);
    }

    fn is_conservative(&self) -> bool {
        !self.streams()
    }
}
