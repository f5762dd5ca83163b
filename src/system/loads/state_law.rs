//! Expressions in quantities of the state and in the time, as loads have them.

use super::Instant;
use crate::math::function::Function;
use crate::math::jet::Number;
use crate::math::state_expression::StateExpression;
use crate::system::signal::Signal;

/// An expression with the time that it takes.
#[derive(Clone, Debug)]
pub struct StateLaw {
    expression: StateExpression,
    time: Signal,
    /// Parts in the time alone, whose kinks and waves steps mind.
    clocks: Vec<Signal>,
}

impl StateLaw {
    /// An expression that takes the time of the run.
    pub fn new(expression: StateExpression) -> Self {
        let clocks = expression.clocks().iter().cloned();
        let clocks = clocks.map(|clock| Signal::Function(Function::Expression(Box::new(clock))));
        let time = if expression.is_timed() {
            Function::time()
        } else {
            Function::constant(0.0)
        };
        Self {
            time: Signal::Function(time),
            clocks: clocks.collect(),
            expression,
        }
    }

    /// Value at an instant, for its other variables.
    pub fn value<const D: usize, N: Number>(&self, at: Instant<'_, D, N>, others: [N; 3]) -> N {
        self.expression.value(self.time.value(at), others)
    }

    /// Derivative by one of its other variables; 0 where it does not depend on that.
    pub fn slope<const D: usize>(&self, at: Instant<'_, D>, others: [f64; 3], by: usize) -> f64 {
        if self.depends()[by] {
            self.expression.slope(self.time.value(at), others, by)
        } else {
            0.0
        }
    }

    /// Whether it depends on each of its other variables.
    pub fn depends(&self) -> [bool; 3] {
        self.expression.depends()
    }

    /// Whether it has kinks or jumps at times that the state decides.
    pub fn has_switches(&self) -> bool {
        self.expression.has_switches()
    }

    /// Stops its time at an instant.
    pub fn hold<const D: usize>(&mut self, at: Instant<'_, D>) {
        self.time = self.time.held(at, 1.0);
        self.clocks.clear();
    }

    /// Calls with its parts in the time alone.
    pub fn each_signal<'a>(&'a self, call: &mut dyn FnMut(&'a Signal)) {
        self.clocks.iter().for_each(call);
    }
}
