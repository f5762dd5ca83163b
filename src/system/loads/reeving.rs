//! A rope without mass that runs over points without friction, and onto a drum: one tension all along.
//!
//! Between its ends it has the length `l` without stress, the given length less what the drum has wound up, `r q`. When its path is longer
//! than that, by `s`, it pulls with `N = EA (s + d) / l`. In this `d = T s'` is viscosity of Kelvin and Voigt, at most `s` in size: the
//! tension is continuous where the rope becomes taut, and never a compression. The elastic part derives from the energy `EA s^2 / (2 l)`.
//! So the drum feels `N r + EA s^2 r / (2 l^2)`: the second term is the energy of the length that it winds up.

use nalgebra::SMatrix;

use super::{Add, ForceElement, Instant};
use crate::math::jet::Number;
use crate::math::space::Vector;
use crate::system::coordinate::{Coordinate, line};
use crate::system::end::{Attachment, between};
use crate::system::gradient::Terms;
use crate::system::signal::Signal;

/// Most points of a rope.
pub const MOST_POINTS: usize = 30;
/// Nodes that a rope depends on at most: two at each point, and four of the joint of a drum.
const MOST_NODES: usize = 2 * MOST_POINTS + 4;

/// A rope over points.
#[derive(Clone, Debug)]
pub struct Reeving<const D: usize = 2> {
    /// Points from one end to the other, two to [`MOST_POINTS`].
    pub points: Vec<Attachment<D>>,
    /// Drum that winds it up.
    pub drum: Option<Drum<D>>,
    /// Axial stiffness `EA`, N.
    pub axial_stiffness: f64,
    /// Ratio `T` of viscosity to stiffness, s.
    pub damping_time: f64,
    /// Length without stress while the drum is where it is at the start, m.
    pub length: Signal,
}

/// A drum on a joint.
#[derive(Clone, Debug)]
pub struct Drum<const D: usize> {
    /// Angle of the joint.
    pub angle: Box<Coordinate<D>>,
    /// Angle at the start, rad.
    pub start: f64,
    /// Radius, m; negative where a positive angle pays out.
    pub radius: f64,
}

/// A rope that is longer than its length without stress.
struct Taut<N> {
    /// Axial stiffness over the length without stress, N/m.
    stiffness: N,
    /// Strain, the elongation over the length without stress.
    strain: N,
    /// Elongation `s`, m.
    elongation: N,
    /// Its rate, m/s.
    rate: N,
    /// Part `d` of the viscosity, m.
    viscous: N,
    /// Derivatives of `d` by `s` and by its rate.
    slopes: [f64; 2],
}

impl<N: Number> Taut<N> {
    /// Tension, N.
    fn tension(&self) -> N {
        self.stiffness * (self.elongation + self.viscous)
    }

    /// Tension with the energy of the length that a drum winds up, N.
    fn on_drum(&self) -> N {
        self.tension() + N::of(0.5) * self.stiffness * self.elongation * self.strain
    }

    /// Stored energy, J.
    fn energy(&self) -> N {
        N::of(0.5) * self.stiffness * self.elongation * self.elongation
    }
}

impl<const D: usize> Reeving<D> {
    /// Length of its path, m, and the rate of that, m/s.
    pub fn path<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let mut path = [N::of(0.0); 2];
        for span in self.points.array_windows() {
            let (unit, length) = line(span, at.x);
            let [a, b] = span.map(|end| end.lift().velocity(at.v));
            path[0] += length;
            path[1] += unit.dot(&(b - a));
        }
        path
    }

    /// The rope where it is taut.
    fn taut<N: Number>(&self, at: Instant<'_, D, N>) -> Option<Taut<N>> {
        let [path, growth] = self.path(at);
        let (mut free, mut change) = (self.length.value(at), self.length.rate(at));
        if let Some(Drum {
            angle,
            start,
            radius,
        }) = &self.drum
        {
            let turned = angle.value(at.x, at.angles.1) - N::of(*start);
            free -= N::of(*radius) * turned;
            change -= N::of(*radius) * angle.rate(at.x, at.v);
        }
        let (elongation, rate) = (path - free, growth - change);
        if elongation.plain() <= 0.0 {
            return None;
        }
        let flow = N::of(self.damping_time) * rate;
        let (viscous, slopes) = match flow.plain() {
            fast if fast > elongation.plain() => (elongation, [1.0, 0.0]),
            fast if fast < -elongation.plain() => (-elongation, [-1.0, 0.0]),
            _ => (flow, [0.0, self.damping_time]),
        };
        Some(Taut {
            stiffness: N::of(self.axial_stiffness) / free,
            strain: elongation / free,
            elongation,
            rate,
            viscous,
            slopes,
        })
    }

    /// Force with which it pulls, N.
    pub fn tension<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.taut(at).map_or(N::of(0.0), |taut| taut.tension())
    }

    /// Calls with every point and the derivative of the length of the path by its position.
    fn each_point<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, Vector<D, N>),
    ) {
        let mut before = Vector::zeros();
        for (k, point) in self.points.iter().enumerate() {
            let next = self.points.get(k + 1);
            let after = next.map_or(Vector::zeros(), |next| line(&[*point, *next], at.x).0);
            call(&point.lift(), before - after);
            before = after;
        }
    }
}

impl<const D: usize> Reeving<D> {
    /// Derivatives of the elongation by coordinates, those of a drum times a factor.
    fn terms(&self, at: Instant<'_, D>, on_drum: f64) -> Terms<D, MOST_NODES> {
        let mut terms = Terms::default();
        self.each_point(at, |point, slope| {
            terms.add_end(point, [slope, Vector::zeros()]);
        });
        if let Some(drum) = &self.drum {
            let gradient = drum.angle.gradient(at.x).scaled(drum.radius * on_drum);
            gradient.for_each(|node, term| terms.add(node, term));
        }
        terms
    }
}

impl<const D: usize> ForceElement<D> for Reeving<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        mut call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let Some(taut) = self.taut(at) else {
            return;
        };
        let tension = taut.tension();
        self.each_point(at, |point, slope| {
            call(point, [-slope * tension, Vector::zeros()]);
        });
        if let Some(drum) = &self.drum {
            let moment = taut.on_drum() * N::of(drum.radius);
            drum.angle.act(-moment, at.x, call);
        }
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let Some(taut) = self.taut(at) else {
            return;
        };
        // The elastic part is a square of the derivatives of the strain: those of the length without stress count too.
        let factor = taut.stiffness * (1.0 + taut.slopes[0]);
        if factor > 0.0 {
            let terms = self.terms(at, 1.0 + taut.strain);
            terms.add_square(factor, &mut *stiffness);
        }
        let factor = taut.stiffness * taut.slopes[1];
        if factor > 0.0 {
            self.terms(at, 1.0).add_square(factor, damping);
        }
        for span in self.points.array_windows() {
            let (unit, length) = line(span, at.x);
            if length > 0.0 {
                let across = SMatrix::identity() - unit * unit.transpose();
                let k = across * (taut.tension() / length);
                between(span, k, 0, &mut *stiffness);
            }
        }
        if let Some(drum) = &self.drum {
            let moment = taut.on_drum() * drum.radius;
            drum.angle.add_hessian(moment, at.x, stiffness);
        }
    }

    /// A length that changes does work, as a drum does.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let none = N::of(0.0);
        self.taut(at).map_or([none; 2], |taut| {
            [
                -taut.on_drum() * self.length.rate(at),
                taut.stiffness * taut.viscous * taut.rate,
            ]
        })
    }

    fn energy<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.taut(at).map_or(N::of(0.0), |taut| taut.energy())
    }

    fn hold(&mut self, at: Instant<'_, D>, _fraction: f64) {
        self.length = self.length.held(at, 1.0);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        call(&self.length);
    }

    fn is_moment(&self) -> bool {
        self.drum.is_some()
    }

    fn has_contact(&self) -> bool {
        true
    }

    fn is_damped(&self) -> bool {
        self.damping_time > 0.0
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        let drum = self.drum.iter().flat_map(|drum| drum.angle.ends());
        self.points.iter().copied().chain(drum).collect()
    }

    fn is_grounded(&self) -> bool {
        self.points.iter().any(|point| point.marker().is_none())
    }
}
