//! Lift, drag and moment of a strip of an airfoil, quasi-steady: they follow from the flow at this instant. The strip has the chord `c`, the
//! area `S` and the aerodynamic centre `p`; the unit vector `d` points from the leading to the trailing edge, `n` is across it.
//!
//! The flow `u` is the velocity of the air less that of the point at three quarters of the chord, `p + c d / 2`, without its part along the
//! span. With the angle of attack `a = atan2(u . n, u . d)`, the rate of pitch `r = -n . d'`, nose up, and `q = c r / (2 |u|)`
//!
//! `F = rho S |u| (C_l (n u.d - d u.n) + C_d u) / 2`, `M = rho S c |u|^2 C_m / 2` about `p`, nose up.
//!
//! A thin airfoil has `C_l = 2 pi sin(a)` and `C_m = -pi q / 2`: Theodorsen's equations without the lag of the wake and the mass of the air.
//!
//! Source: R. L. Bisplinghoff, H. Ashley, R. L. Halfman, Aeroelasticity (1955), Eqs. 5-311 and 5-312 (thin airfoil), section 9-4
//! (quasi-steady).

use super::{Add, ForceElement, Instant, StateLaw, hold};
use crate::bodies::Marker;
use crate::math::function::Function;
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular, spun};
use crate::system::end::Attachment;
use crate::system::gradient::Terms;
use crate::system::signal::Signal;

/// Part of the chord from the aerodynamic centre to the point whose velocity counts.
const BEHIND: f64 = 0.5;

/// A coefficient over the angle of attack, rad, and the reduced rate of pitch.
#[derive(Clone, Debug)]
pub enum AirfoilCoefficient {
    /// Over the angle of attack.
    Curve(Function),
    /// By an expression in both and in the time.
    Expression(StateLaw),
}

impl AirfoilCoefficient {
    fn value<const D: usize, N: Number>(&self, at: Instant<'_, D, N>, angle: N, rate: N) -> N {
        match self {
            Self::Curve(curve) => angle.map(|a| curve.value(a), |a| curve.derivatives(a)),
            Self::Expression(law) => law.value(at, [angle, rate, N::of(0.0)]),
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

/// Directions of the chord, towards the trailing edge, and of the lift at no angle of attack.
#[derive(Clone, Debug)]
pub enum AirfoilAxes {
    /// In the plane, by the angle, rad, from the direction of the marker to the chord; the other one is to its left.
    Angle(f64),
    /// In space, as directions of markers.
    Markers(Box<[Marker; 2]>),
}

/// A strip of an airfoil.
#[derive(Clone, Debug)]
pub struct Airfoil<const D: usize = 2> {
    /// Aerodynamic centre.
    pub point: Marker,
    /// Directions.
    pub axes: AirfoilAxes,
    /// Half the density times the area, kg/m.
    pub inert: f64,
    /// Chord, m.
    pub chord: f64,
    /// Coefficients of lift, drag and moment.
    pub coefficients: [AirfoilCoefficient; 3],
    /// Velocity of the air, m/s.
    pub wind: [Signal; D],
    /// Velocity of the body as a whole beside its rates, where equilibria are sought in a steady motion: that of the origin, m/s, and
    /// angular velocity, rad/s.
    pub carried: (Vector<D>, [f64; 3]),
    /// Part of the force that acts.
    pub fraction: f64,
}

/// Flow past a strip.
struct StripFlow<const D: usize, N> {
    /// Unit vectors along the chord and across it.
    axes: [Vector<D, N>; 2],
    /// Rate of pitch of the body, nose up, rad/s.
    pitch: N,
    /// Rate of pitch with which the whole is carried too, rad/s.
    turning: N,
    /// Velocity of the air past the strip along both axes, m/s.
    past: [N; 2],
}

/// What acts on a strip.
struct StripForces<const D: usize, N> {
    /// Force on the aerodynamic centre, N.
    force: Vector<D, N>,
    /// Moment, nose up, N m.
    moment: N,
}

impl<const D: usize, N: Number> StripFlow<D, N> {
    /// Unit vectors of lift and drag, times the speed.
    fn directions(&self) -> [Vector<D, N>; 2] {
        let ([chord, up], [along, across]) = (self.axes, self.past);
        [up * along - chord * across, chord * along + up * across]
    }

    fn speed(&self) -> N {
        let [along, across] = self.past;
        (along * along + across * across).sqrt()
    }

    /// Angle of attack, rad.
    fn angle(&self) -> N {
        let [along, across] = self.past;
        across.atan2(along)
    }

    /// Whether there is none, where forces have no direction.
    fn is_still(&self) -> bool {
        self.past.iter().all(|part| part.plain() == 0.0)
    }
}

impl<const D: usize> Airfoil<D> {
    /// Unit vectors of the chord and across it, and the rate of the first, 1/s.
    fn directions<N: Number>(&self, at: Instant<'_, D, N>) -> [Vector<D, N>; 3] {
        match &self.axes {
            AirfoilAxes::Angle(angle) => {
                let end = Attachment::Body(self.point.lift());
                let u = end.direction(at.x).normalize();
                let (sin, cos) = angle.sin_cos();
                let chord = u * N::of(cos) + perpendicular(u) * N::of(sin);
                let up = perpendicular(chord);
                [chord, up, up * end.spin(at.x, at.v)]
            }
            AirfoilAxes::Markers(axes) => {
                let [chord, up] = axes.each_ref().map(|axis| axis.lift());
                [
                    chord.direction(at.x),
                    up.direction(at.x),
                    chord.direction(at.v),
                ]
            }
        }
    }

    fn flow<N: Number>(&self, at: Instant<'_, D, N>) -> StripFlow<D, N> {
        let [chord, up, rate] = self.directions(at);
        let mut turning = rate;
        let point = self.point.lift();
        let mut velocity = point.position(at.v);
        let (origin, spin) = self.carried;
        velocity += origin.map(N::of);
        if spin != [0.0; 3] {
            velocity += spun(spin, point.position(at.x));
            turning += spun(spin, chord);
        }
        velocity += turning * N::of(BEHIND * self.chord);
        let wind = Vector::from(self.wind.each_ref().map(|part| part.value(at)));
        let past = wind - velocity;
        StripFlow {
            axes: [chord, up],
            pitch: -rate.dot(&up),
            turning: -turning.dot(&up),
            past: [chord, up].map(|axis| axis.dot(&past)),
        }
    }

    fn forces<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        flow: &StripFlow<D, N>,
    ) -> StripForces<D, N> {
        if flow.is_still() {
            return StripForces {
                force: Vector::zeros(),
                moment: N::of(0.0),
            };
        }
        let (speed, angle) = (flow.speed(), flow.angle());
        let reduced = N::of(0.5 * self.chord) * flow.turning / speed;
        let [lift, drag, moment] =
            [0, 1, 2].map(|k| self.coefficients[k].value(at, angle, reduced));
        let pressure = N::of(self.fraction * self.inert) * speed;
        let [lifted, dragged] = flow.directions();
        StripForces {
            force: (lifted * lift + dragged * drag) * pressure,
            moment: pressure * speed * N::of(self.chord) * moment,
        }
    }
}

impl<const D: usize> ForceElement<D> for Airfoil<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let flow = self.flow(at);
        let StripForces { force, moment } = self.forces(at, &flow);
        let point = Attachment::Body(self.point.lift());
        match &self.axes {
            // Nose up is clockwise: the chord points away from the nose.
            AirfoilAxes::Angle(_) => {
                let [_, direction] = point.turn(-moment, at.x);
                call(&point, [force, direction]);
            }
            AirfoilAxes::Markers(axes) => {
                let chord = Attachment::Body(axes[0].lift());
                call(&chord, [Vector::zeros(), -flow.axes[1] * moment]);
                call(&point, [force, Vector::zeros()]);
            }
        }
    }

    /// Adds the damping of lift and drag by the velocity of the aerodynamic centre. Derivatives by the rotation are left out: they are not
    /// symmetric, and steps converge without them.
    fn add_tangent(&self, at: Instant<'_, D>, _stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let flow = self.flow(at);
        if flow.is_still() {
            return;
        }
        let (speed, angle) = (flow.speed(), flow.angle());
        // The rise of the lift by a difference: a kink does not matter here.
        let step = 1e-4;
        let [before, after] =
            [-step, step].map(|by| self.coefficients[0].value(at, angle + by, 0.0));
        let rise = (after - before) / (2.0 * step);
        let drag = self.coefficients[1].value(at, angle, 0.0).max(0.0);
        let pressure = self.fraction * self.inert * speed;
        let [lifted, dragged] = flow.directions().map(|axis| axis / speed);
        let end = Attachment::Body(self.point);
        for (axis, size) in [(lifted, (rise + drag).max(0.0)), (dragged, 2.0 * drag)] {
            let mut terms: Terms<D> = Terms::default();
            terms.add_end(&end, [axis, Vector::zeros()]);
            terms.add_square(pressure * size, &mut *damping);
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let flow = self.flow(at);
        let StripForces { force, moment } = self.forces(at, &flow);
        let velocity = self.point.lift().position(at.v);
        let supplied = force.dot(&velocity) + moment * flow.pitch;
        [supplied, N::of(0.0)]
    }

    /// Exact for small rotations.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let flow = self.flow(before);
        let StripForces { force, moment } = self.forces(before, &flow);
        let way: Vector<D> = self.point.position(after.x) - self.point.position(before.x);
        let [chord, up] = flow.axes;
        let turned = self.directions(after)[0] - chord;
        force.dot(&way) - moment * turned.dot(&up)
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        hold(&mut self.wind, at, 1.0);
        for coefficient in &mut self.coefficients {
            if let AirfoilCoefficient::Expression(law) = coefficient {
                law.hold(at);
            }
        }
        self.fraction *= fraction;
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.wind.iter().for_each(&mut *call);
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

    fn ends(&self) -> Vec<Attachment<D>> {
        let axes: &[Marker] = match &self.axes {
            AirfoilAxes::Angle(_) => &[],
            AirfoilAxes::Markers(axes) => &axes[..],
        };
        let ends = [self.point].into_iter().chain(axes.iter().copied());
        ends.map(Attachment::Body).collect()
    }
}
