//! A force by an expression in a length or a coordinate of a joint, its rate, a control and the time.

use super::measure::Measure;
use super::{Add, ForceElement, Instant};
use crate::math::function::Function;
use crate::math::jet::Number;
use crate::math::law::Law;
use crate::math::quadrature::GAUSS_5;
use crate::math::space::Vector;
use crate::system::end::Attachment;
use crate::system::signal::Signal;

/// A force against the growth of a length or of a coordinate of a joint.
#[derive(Clone, Debug)]
pub struct ForceLaw<const D: usize = 2> {
    measure: Measure<D>,
    law: Law,
    control: Signal,
    time: Signal,
    /// Parts of the law in the time alone, whose kinks and waves steps mind.
    clocks: Vec<Signal>,
}

impl<const D: usize> ForceLaw<D> {
    /// A force against the growth of a measure, by a law whose control is a signal.
    pub fn new(measure: Measure<D>, law: Law, control: Signal) -> Self {
        let clocks = law.clocks().iter().cloned();
        let clocks = clocks.map(|clock| Signal::Function(Function::Expression(Box::new(clock))));
        let time = if law.is_timed() {
            Function::time()
        } else {
            Function::constant(0.0)
        };
        Self {
            measure,
            control,
            time: Signal::Function(time),
            clocks: clocks.collect(),
            law,
        }
    }

    /// Value and rate of the measure.
    fn read<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        self.measure.read(at, self.law.depends()[0])
    }

    /// Force against growth at a value and rate of the measure, N or N m.
    fn force<N: Number>(&self, at: Instant<'_, D, N>, [value, rate]: [N; 2]) -> N {
        let others = [value, rate, self.control.value(at)];
        self.law.value(self.time.value(at), others)
    }
}

impl<const D: usize> ForceElement<D> for ForceLaw<D> {
    fn act<N: Number>(
        &self,
        at: Instant<'_, D, N>,
        call: impl FnMut(&Attachment<D, N>, [Vector<D, N>; 2]),
    ) {
        let force = self.force(at, self.read(at));
        self.measure.act(force, at, call);
    }

    fn add_tangent(&self, at: Instant<'_, D>, stiffness: Add<'_, D>, damping: Add<'_, D>) {
        let read = self.read(at);
        let others = [read[0], read[1], self.control.value(at)];
        let t = self.time.value(at);
        let slopes = [0, 1].map(|by| {
            if self.law.depends()[by] {
                self.law.slope(t, others, by)
            } else {
                0.0
            }
        });
        // A force that falls with the rate is negative damping, which no factor of the tangent has.
        let slopes = [slopes[0], slopes[1].max(0.0)];
        (self.measure).add_tangent(at, self.force(at, read), slopes, (stiffness, damping));
    }

    /// The part of the force that is there without a rate is supplied, the rest dissipates.
    fn power<N: Number>(&self, at: Instant<'_, D, N>) -> [N; 2] {
        let [value, rate] = self.read(at);
        let still = self.force(at, [value, N::of(0.0)]);
        let moving = self.force(at, [value, rate]) - still;
        [-still * rate, moving * rate]
    }

    fn work(&self, before: Instant<'_, D>, after: Instant<'_, D>) -> f64 {
        let [from, to] = [before, after].map(|at| self.measure.read(at, true)[0]);
        let points = GAUSS_5.iter();
        let work = points.map(|point| {
            let value = from + point.at * (to - from);
            point.weight * self.force(before, [value, 0.0])
        });
        (from - to) * work.sum::<f64>()
    }

    fn hold(&mut self, at: Instant<'_, D>, _fraction: f64) {
        self.control = self.control.held(at, 1.0);
        self.time = self.time.held(at, 1.0);
        self.clocks.clear();
    }

    fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        call(&self.control);
        self.clocks.iter().for_each(call);
    }

    fn is_moment(&self) -> bool {
        self.measure.is_angle()
    }

    fn has_contact(&self) -> bool {
        self.law.has_switches()
    }

    fn is_damped(&self) -> bool {
        self.law.depends()[1]
    }

    fn ends(&self) -> Vec<Attachment<D>> {
        self.measure.ends()
    }

    fn is_grounded(&self) -> bool {
        self.measure.is_grounded()
    }
}
