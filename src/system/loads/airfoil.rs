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

use super::{Add, ForceElement, Instant};
use crate::bodies::Marker;
use crate::math::function::Function;
use crate::math::jet::Number;
use crate::math::space::{Vector, perpendicular, spun};
use crate::math::state_expression::StateExpression;
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
    Expression(StateExpression),
}

impl AirfoilCoefficient {
    fn value<N: Number>(&self, time: N, angle: N, rate: N) -> N {
        match self {
            Self::Curve(curve) => angle.map(|a| curve.value(a), |a| curve.derivatives(a)),
            Self::Expression(of) => of.value(time, [angle, rate, N::of(0.0)]),
        }
    }

    /// Whether it has kinks.
    pub fn has_kinks(&self) -> bool {
        match self {
            Self::Curve(curve) => matches!(curve, Function::Linear(_)),
            Self::Expression(of) => of.has_switches(),
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
    /// The time, s, that expressions of coefficients take.
    pub time: Signal,
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
    /// Moment, nose up, N m.
    moment: N,
    /// Unit vector of the lift at no angle of attack.
    up: Vector<D, N>,
    /// Rate of pitch, nose up, rad/s.
    pitch: N,
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

    fn acting<N: Number>(&self, at: Instant<'_, D, N>) -> StripForces<D, N> {
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
        let [along, across] = [chord, up].map(|axis| axis.dot(&past));
        let square = along * along + across * across;
        let pitch = -rate.dot(&up);
        if square.plain() == 0.0 {
            return StripForces {
                force: Vector::zeros(),
                moment: N::of(0.0),
                up,
                pitch,
            };
        }
        let speed = square.sqrt();
        let angle = across.atan2(along);
        let reduced = N::of(-0.5 * self.chord) * turning.dot(&up) / speed;
        let time = self.time.value(at);
        let [lift, drag, moment] =
            [0, 1, 2].map(|k| self.coefficients[k].value(time, angle, reduced));
        let pressure = N::of(self.fraction * self.inert) * speed;
        let lifted = up * along - chord * across;
        let dragged = chord * along + up * across;
        StripForces {
            force: (lifted * lift + dragged * drag) * pressure,
            moment: pressure * speed * N::of(self.chord) * moment,
            up,
            pitch,
        }
    }
}

impl<const D: usize> ForceElement<D> for Airfoil<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let acting = self.acting(at);
        let point = Attachment::Body(self.point.lift());
        match &self.axes {
            // Nose up is clockwise: the chord points away from the nose.
            AirfoilAxes::Angle(_) => {
                let [_, direction] = point.turn(-acting.moment, at.x);
                call(&point, [acting.force, direction]);
            }
            AirfoilAxes::Markers(axes) => {
                let chord = Attachment::Body(axes[0].lift());
                call(&chord, [Vector::zeros(), -acting.up * acting.moment]);
                call(&point, [acting.force, Vector::zeros()]);
            }
        }
    }

    /// Adds the damping of lift and drag by the velocity of the aerodynamic centre. Derivatives by the rotation are left out: they are not
    /// symmetric, and steps converge without them.
    fn add_tangent(&self, at: Instant<'_, D>, _stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let [chord, up, _] = self.directions(at);
        let point: Vector<D> = self.point.position(at.v);
        let wind = Vector::from(self.wind.each_ref().map(|part| part.value(at)));
        let past = wind - point - self.carried.0;
        let [along, across] = [chord, up].map(|axis| axis.dot(&past));
        let speed = along.hypot(across);
        if speed == 0.0 {
            return;
        }
        let (angle, time) = (across.atan2(along), self.time.value(at));
        // The rise of the lift by a difference: a kink does not matter here.
        let step = 1e-4;
        let [before, after] =
            [-step, step].map(|by| self.coefficients[0].value(time, angle + by, 0.0));
        let rise = (after - before) / (2.0 * step);
        let drag = self.coefficients[1].value(time, angle, 0.0).max(0.0);
        let pressure = self.fraction * self.inert * speed;
        let lifted = (up * along - chord * across) / speed;
        let dragged = (chord * along + up * across) / speed;
        let end = Attachment::Body(self.point);
        for (axis, size) in [(lifted, (rise + drag).max(0.0)), (dragged, 2.0 * drag)] {
            let mut terms: Terms<D> = Terms::default();
            terms.add_end(&end, [axis, Vector::zeros()]);
            terms.add_square(pressure * size, &mut *damping);
        }
    }

    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let acting = self.acting(at);
        let velocity = self.point.lift().position(at.v);
        let supplied = acting.force.dot(&velocity) + acting.moment * acting.pitch;
        [supplied, N::of(0.0)]
    }

    /// Exact for small rotations.
    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let acting = self.acting(before);
        let way: Vector<D> = self.point.position(after.x) - self.point.position(before.x);
        let turned = self.directions(after)[0] - self.directions(before)[0];
        acting.force.dot(&way) - acting.moment * turned.dot(&acting.up)
    }

    fn hold(&mut self, at: Instant<'_, D>, fraction: f64) {
        for part in self.wind.iter_mut().chain([&mut self.time]) {
            *part = part.held(at, 1.0);
        }
        self.fraction *= fraction;
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.wind.iter().for_each(call);
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
