//! A force by an expression in a length or a coordinate of a joint, its rate, a control and the time.

use super::{Add, ForceElement, Instant, StateLaw};
use crate::math::jet::Number;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;
use crate::math::state_expression::StateExpression;
use crate::system::coordinate::Coordinate;
use crate::system::end::Attachment;
use crate::system::signal::Signal;

/// Times at which a law is looked at around an instant: halves of halves of an interval.
const HALVINGS: i32 = 40;

/// A force against the growth of a length or of a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ForceLaw<const D: usize = 2> {
    on: Coordinate<D>,
    law: StateLaw,
    control: Signal,
}

impl<const D: usize> ForceLaw<D> {
    /// A force against the growth of a length or coordinate, by a law whose control is a signal.
    pub fn new(on: Coordinate<D>, law: StateExpression, control: Signal) -> Self {
        let law = StateLaw::new(law);
        Self { on, law, control }
    }

    /// Length or coordinate, and its rate. The rotations of an angle that the law does not depend on are not counted.
    fn read<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let rate = self.on.rate(at.x, at.v);
        if self.law.depends()[0] {
            [self.on.value(at.x, at.angles.1), rate]
        } else {
            [N::of(0.0), rate]
        }
    }

    /// Length or coordinate, m or rad, and its rate, whatever the law depends on.
    pub fn path<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        [self.on.value(at.x, at.angles.1), self.on.rate(at.x, at.v)]
    }

    /// The nearest length or coordinate, m or rad, with its rate, at which the law has no finite value: of those that are passed within a
    /// time, s, before or after an instant at its rate.
    pub fn without_value(&self, at: Instant<'_, D>, within: f64) -> Option<[f64; 2]> {
        let [value, rate] = self.path(at);
        let times = (0..HALVINGS).map(|k| within * 0.5_f64.powi(HALVINGS - k));
        let times = times.flat_map(|time| [time, -time]);
        let mut places = std::iter::once(0.0).chain(times);
        let found = places.find(|time| {
            let place = [value + rate * time, rate];
            !self.force(at, place).is_finite()
        })?;
        Some([value + rate * found, rate])
    }

    /// Force against growth, N or N m.
    pub fn against_growth<N: Number>(&self, at: Instant<'_, D, N>) -> N {
        self.force(at, self.read(at))
    }

    /// Force against growth at a value and a rate, N or N m.
    fn force<N: Number>(&self, at: Instant<'_, D, N>, [value, rate]: [N; 2]) -> N {
        let others = [value, rate, self.control.value(at)];
        self.law.value(at, others)
    }
}

impl<const D: usize> ForceElement<D> for ForceLaw<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let force = self.against_growth(at);
        self.on.act(-force, at.x, call);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let read = self.read(at);
        let others = [read[0], read[1], self.control.value(at)];
        let slope = |by: usize| self.law.slope(at, others, by);
        self.on.add_square(slope(0), at.x, &mut *stiffness);
        (self.on).add_hessian(self.force(at, read), at.x, stiffness);
        // A force that falls with the rate is negative damping, which no factor of the tangent has.
        let grows = slope(1);
        if grows > 0.0 {
            self.on.add_square(grows, at.x, damping);
        }
    }

    /// The part of the force that is there without a rate is supplied, the rest dissipates.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [value, rate] = self.read(at);
        let still = self.force(at, [value, N::of(0.0)]);
        let moving = self.force(at, [value, rate]) - still;
        [-still * rate, moving * rate]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let [from, to] = [before, after].map(|at| self.on.value(at.x, at.angles.1));
        let points = GAUSS_5.iter();
        let work = points.map(|point| {
            let value = from + point.at * (to - from);
            point.weight * self.force(before, [value, 0.0])
        });
        (from - to) * work.sum::<f64>()
    }

    fn hold(&mut self, at: Instant<'_, D>, _fraction: f64) {
        self.control = self.control.held(at, 1.0);
        self.law.hold(at);
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        call(&self.control);
        self.law.each_signal(call);
    }

    fn is_moment(&self) -> bool {
        self.on.is_angle()
    }

    fn has_contact(&self) -> bool {
        self.law.has_switches()
    }

    fn is_damped(&self) -> bool {
        self.law.depends()[1]
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.on.ends().to_vec()
    }

    fn is_grounded(&self) -> bool {
        self.on.is_grounded_length()
    }
}
