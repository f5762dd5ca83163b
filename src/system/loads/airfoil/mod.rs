//! Lift, drag and moment of strips of an airfoil, quasi-steady: they follow from the flow at this instant. A strip has the chord `c`, the
//! area `S` and the aerodynamic centre `p`; the unit vector `d` points from the leading to the trailing edge, `n` is across it.
//!
//! The flow `u` is the velocity of the air less that of the point at three quarters of the chord, `p + c d / 2`, without its part along the
//! span. With the angle of attack `a = atan2(u . n, u . d)`, the rate of pitch `r = -n . d'`, nose up, and `q = c r / (2 |u|)`
//!
//! `F = rho S |u| (C_l (n u.d - d u.n) + C_d u) / 2`, `M = rho S c |u|^2 C_m / 2` about `p`, nose up.
//!
//! A thin airfoil has `C_l = 2 pi sin(a)` and `C_m = -pi q / 2`: Theodorsen's equations without the lag of the wake and the mass of the air.
//!
//! Where the aerodynamic centre is `e` ahead of the point `r` of a body, `p = r - e d`, the virtual work of force and moment is
//! `F . dr - (e F + M n) . dd`. A strip between two sections has the direction between theirs. The force `G` on it is the moment `d x G`,
//! which acts on sections of rods and beams as one that is distributed along them.
//!
//! Source: R. L. Bisplinghoff, H. Ashley, R. L. Halfman, Aeroelasticity (1955), Eqs. 5-311 and 5-312 (thin airfoil), section 9-4
//! (quasi-steady).

mod strip;

pub use strip::{AirfoilAxes, AirfoilStrip};

use super::{Add, ForceElement, Instant, LineLoad, StateLaw};
use crate::bodies::{Bodies, LoadedLine, Node, RodChain};
use crate::elements::section::Vectors;
use crate::elements::shape::Values;
use crate::math::function::Function;
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::{Vector, moment};
use crate::system::end::Attachment;
use crate::system::gradient::Terms;
use crate::system::signal::Signal;
use strip::{StripAxes, StripFlow, across};

/// A coefficient over the angle of attack, rad, and the reduced rate of pitch.
#[derive(Clone, Debug)]
pub enum AirfoilCoefficient {
    /// Over the angle of attack.
    Curve(Function),
    /// By an expression in both and in the time.
    Expression(StateLaw),
}

impl AirfoilCoefficient {
    /// Value for the angle of attack, the reduced rate of pitch and the material coordinate.
    fn value<const D: usize, N: Number>(&self, at: Instant<'_, D, N>, of: [N; 3]) -> N {
        match self {
            Self::Curve(curve) => of[0].map(|a| curve.value(a), |a| curve.derivatives(a)),
            Self::Expression(law) => law.value(at, of),
        }
    }

    /// Whether it has kinks.
    pub fn has_kinks(&self) -> bool {
        match self {
            Self::Curve(curve) => matches!(curve, Function::Linear(_)),
            Self::Expression(law) => law.has_switches(),
        }
    }
}

/// Line that is an airfoil.
#[derive(Clone, Copy, Debug)]
pub struct AirfoilLine {
    /// Line that forces act along.
    pub line: LoadedLine,
    /// Index of the rod or beam whose sections moments act on; of none of a cable or a rigid body.
    pub sections: Option<usize>,
}

/// An airfoil: a strip at a marker, or strips at the Gauss points of the segments of a line.
#[derive(Clone, Debug)]
pub struct Airfoil<const D: usize = 2> {
    /// The line, where it is along one.
    pub on: Option<AirfoilLine>,
    /// Strips.
    pub strips: Vec<AirfoilStrip>,
    /// Density of the air, kg/m^3.
    pub density: f64,
    /// Coefficients of lift, drag and moment.
    pub coefficients: [AirfoilCoefficient; 3],
    /// Velocity of the air, m/s.
    pub wind: LineLoad<D>,
    /// Velocity of the body as a whole beside its rates, where equilibria are sought in a steady motion: that of the origin, m/s, and
    /// angular velocity, rad/s.
    pub carried: (Vector<D>, [f64; 3]),
    /// Part of the force that acts.
    pub fraction: f64,
}

/// What acts on a strip.
struct StripForces<const D: usize, N> {
    /// Force on the aerodynamic centre, N.
    force: Vector<D, N>,
    /// Force on the direction of the chord, N m: that of the moment, and of the force ahead of the point.
    turning: Vector<D, N>,
}

impl<const D: usize> Airfoil<D> {
    /// Strips of a segment.
    fn of_segment(&self, segment: usize) -> &[AirfoilStrip] {
        &self.strips[GAUSS_5.len() * segment..][..GAUSS_5.len()]
    }

    /// Number of strips that act together.
    fn per_segment(&self) -> usize {
        if self.on.is_some() { GAUSS_5.len() } else { 1 }
    }

    /// Part that acts of half the density times the area of a strip, kg/m.
    fn inert(&self, strip: &AirfoilStrip) -> f64 {
        self.fraction * (0.5 * self.density * strip.chord * strip.span)
    }

    fn flow<N: Number>(&self, at: Instant<'_, D, N>, strip: usize) -> StripFlow<D, N> {
        self.strips[strip].flow(at, self.wind.value(at, strip), self.carried)
    }

    /// What acts on a strip, and the directions of the strip.
    fn forces<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        strip: usize,
    ) -> (StripForces<D, N>, StripAxes<D, N>) {
        let (flow, of) = (self.flow(at, strip), &self.strips[strip]);
        if flow.is_still() || of.chord == 0.0 {
            let forces = StripForces {
                force: Vector::zeros(),
                turning: Vector::zeros(),
            };
            return (forces, flow.axes);
        }
        let (speed, angle) = (flow.speed(), flow.angle());
        let reduced = N::of(0.5 * of.chord) * flow.pitch / speed;
        let [lift, drag, moment] = self
            .coefficients
            .each_ref()
            .map(|coefficient| coefficient.value(at, [angle, reduced, N::of(of.s)]));
        let pressure = N::of(self.inert(of)) * speed;
        let [lifted, dragged] = flow.directions();
        let force = (lifted * lift + dragged * drag) * pressure;
        let moment = pressure * speed * N::of(of.chord) * moment;
        let arm = across(flow.axes.chord, force) * N::of(of.ahead);
        let turning = -flow.axes.up * moment - arm;
        (StripForces { force, turning }, flow.axes)
    }

    /// The rod or beam whose sections moments act on.
    fn rod<'a, N>(&self, at: Instant<'a, D, N>) -> Option<&'a RodChain> {
        let sections = self.on?.sections?;
        Some(&at.bodies.all_sections()[sections])
    }

    /// Forces on the points (N) and moments on the sections of an element of a rod or beam, in global components (N m/m).
    fn on_element<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        element: usize,
    ) -> ([Vector<D, N>; GAUSS_5.len()], Vectors<N>) {
        let mut forces = [Vector::zeros(); GAUSS_5.len()];
        let moments = std::array::from_fn(|point| {
            let strip = GAUSS_5.len() * element + point;
            let (StripForces { force, turning }, axes) = self.forces(at, strip);
            forces[point] = force;
            let span = N::of(self.strips[strip].span);
            moment(&axes.chord, &turning).map(|part| part / span)
        });
        (forces, moments)
    }

    /// Calls with what a strip acts on.
    fn act_by<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        strip: usize,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let (StripForces { force, turning }, all) = self.forces(at, strip);
        let of = &self.strips[strip];
        for (weight, axes) in of.sections() {
            let turning = turning * (N::of(*weight) / all.length);
            match axes {
                AirfoilAxes::Angle(marker, _) => {
                    let end = Attachment::Body(marker.lift());
                    let [_, up, _] = axes.directions(at);
                    call(&end, end.turn(turning.dot(&up), at.x));
                }
                AirfoilAxes::Markers([chord, _]) => {
                    let chord = Attachment::Body(chord.lift());
                    call(&chord, [Vector::zeros(), turning]);
                }
            }
        }
        call(&Attachment::Body(of.point.lift()), [force, Vector::zeros()]);
    }

    /// Force of all strips together, N.
    pub fn whole<N: Number>(&self, at: Instant<'_, D, N>) -> Vector<D, N> {
        let strips = 0..self.strips.len();
        strips.fold(Vector::zeros(), |sum, strip| {
            sum + self.forces(at, strip).0.force
        })
    }

    /// Adds the damping of lift and drag of a strip by the velocity of its point.
    fn add_damping(&self, at: Instant<'_, D>, strip: usize, damping: Add<'_, D>) {
        let (flow, of) = (self.flow(at, strip), &self.strips[strip]);
        if flow.is_still() {
            return;
        }
        let (speed, angle) = (flow.speed(), flow.angle());
        // The rise of the lift by a difference: a kink does not matter here.
        let step = 1e-4;
        let [before, after] =
            [-step, step].map(|by| self.coefficients[0].value(at, [angle + by, 0.0, of.s]));
        let rise = (after - before) / (2.0 * step);
        let drag = self.coefficients[1].value(at, [angle, 0.0, of.s]).max(0.0);
        let pressure = self.inert(of) * speed;
        let [lifted, dragged] = flow.directions().map(|axis| axis / speed);
        let end = Attachment::Body(of.point);
        for (axis, size) in [(lifted, (rise + drag).max(0.0)), (dragged, 2.0 * drag)] {
            let mut terms: Terms<D> = Terms::default();
            terms.add_end(&end, [axis, Vector::zeros()]);
            terms.add_square(pressure * size, &mut *damping);
        }
    }
}

impl<const D: usize> ForceElement<D> for Airfoil<D> {
    /// A strip at a marker: along a line there are no ends.
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        if self.on.is_none() {
            self.act_by(at, 0, call);
        }
    }

    fn add_force<N: Number>(&self, at: Instant<'_, D, N>, f: &mut [Node<D, N>]) {
        for part in 0..self.strips.len() / self.per_segment() {
            self.add_part(at, part, f);
        }
    }

    /// Derivatives by the rotation are left out: they are not symmetric, and steps converge without them.
    fn add_tangent(&self, at: Instant<'_, D>, _stiffness: Add<'_, D>, damping: Add<'_, D>) {
        (0..self.strips.len()).for_each(|strip| self.add_damping(at, strip, &mut *damping));
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let mut supplied = N::of(0.0);
        if let Some(rod) = self.rod(at) {
            for element in 0..rod.count() {
                let (forces, moments) = self.on_element(at, element);
                let force = rod.loaded(element, at.x, &moments);
                supplied += rod.power_of((element, &force), (at.x, at.v));
                for (strip, force) in self.of_segment(element).iter().zip(forces) {
                    supplied += force.dot(&strip.point.lift().position(at.v));
                }
            }
            return [supplied, N::of(0.0)];
        }
        for (strip, of) in self.strips.iter().enumerate() {
            let (StripForces { force, turning }, axes) = self.forces(at, strip);
            supplied += force.dot(&of.point.lift().position(at.v)) + turning.dot(&axes.rate);
        }
        [supplied, N::of(0.0)]
    }

    /// Exact for small rotations.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let mut work = 0.0;
        if let Some(rod) = self.rod(before) {
            for element in 0..rod.count() {
                let (forces, moments) = self.on_element(before, element);
                let force = rod.loaded(element, before.x, &moments);
                work += rod.work_of((element, &force), [before.x, after.x]);
                for (strip, force) in self.of_segment(element).iter().zip(forces) {
                    let [from, to] = [before, after].map(|at| strip.point.position(at.x));
                    work += force.dot(&(to - from));
                }
            }
            return work;
        }
        for (strip, of) in self.strips.iter().enumerate() {
            let (StripForces { force, turning }, axes) = self.forces(before, strip);
            let way: Vector<D> = of.point.position(after.x) - of.point.position(before.x);
            work += force.dot(&way) + turning.dot(&(of.axes(after).chord - axes.chord));
        }
        work
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        self.wind.hold(at, 1.0);
        for coefficient in &mut self.coefficients {
            if let AirfoilCoefficient::Expression(law) = coefficient {
                law.hold(at);
            }
        }
        self.fraction *= fraction;
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.wind.signals().for_each(&mut *call);
        for coefficient in &self.coefficients {
            if let AirfoilCoefficient::Expression(law) = coefficient {
                law.each_signal(call);
            }
        }
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn is_moment(&self) -> bool {
        true
    }

    fn has_contact(&self) -> bool {
        self.coefficients.iter().any(AirfoilCoefficient::has_kinks)
    }

    fn is_damped(&self) -> bool {
        true
    }

    /// Those of a strip at a marker: along a line its elements couple what the strips do.
    fn ends(&self) -> Vec<Attachment<D>> {
        match (self.on, &self.strips[..]) {
            (None, [strip]) => strip.markers().map(Attachment::Body).collect(),
            _ => Vec::new(),
        }
    }

    /// Nodes of the segments of its line.
    fn parts(&self, bodies: &Bodies<D>) -> Vec<Vec<usize>> {
        if let Some(sections) = self.on.and_then(|on| on.sections) {
            let rod = &bodies.all_sections()[sections];
            let elements = 0..rod.count();
            return elements.map(|j| rod.all_nodes(j)).collect();
        }
        let segments = self.strips.chunks(self.per_segment());
        segments
            .map(|strips| {
                let markers = strips.iter().flat_map(AirfoilStrip::markers);
                let mut nodes: Vec<usize> = markers.flat_map(|marker| marker.nodes).collect();
                nodes.sort_unstable();
                nodes.dedup();
                nodes
            })
            .collect()
    }

    fn add_part<N: Number>(&self, at: Instant<'_, D, N>, part: usize, f: &mut [Node<D, N>]) {
        if let Some(rod) = self.rod(at) {
            let (forces, moments) = self.on_element(at, part);
            let force = rod.loaded(part, at.x, &moments);
            rod.add_load(part, &force, at.x, f);
            for (strip, force) in self.of_segment(part).iter().zip(forces) {
                let point = strip.point.lift();
                point.add_force(force, Vector::zeros(), f);
            }
            return;
        }
        let count = self.per_segment();
        for strip in part * count..(part + 1) * count {
            self.act_by(at, strip, |end, [position, direction]| {
                end.add_force(position, direction, f);
            });
        }
    }

    fn changing<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Values<D, N>> {
        let line = self.on?.line;
        (line.first_node(at.bodies) == first).then(|| {
            std::array::from_fn(|point| {
                let strip = GAUSS_5.len() * segment + point;
                self.forces(at, strip).0.force / N::of(self.strips[strip].span)
            })
        })
    }

    fn changing_moments<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        first: usize,
        segment: usize,
    ) -> Option<Vectors<N>> {
        let rod = self.rod(at)?;
        (rod.line() == first).then(|| self.on_element(at, segment).1)
    }
}
