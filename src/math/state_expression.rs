//! Expressions in the time `t` and up to three other variables: in a coordinate `x`, its rate `v` and a control `u` for instance.

use super::expression::{ConstantPower, Expression, Operation, run_in};
use super::grammar;
use super::jet::{Jet, Number};
use super::switches::Switch;

/// Names of a coordinate, its rate and a control.
const NAMES: [&str; 3] = ["x", "v", "u"];

/// An expression in `t` and up to three other variables, `x`, `v` and `u` where nothing else is said; [`Expression`] says what it may hold.
#[derive(Clone, Debug)]
pub struct StateExpression {
    program: Vec<Operation>,
    /// Largest parts of it that are in the time alone and have kinks, jumps or waves.
    clocks: Vec<Expression>,
    /// Whether it depends on each of the others.
    depends: [bool; 3],
    /// Whether it depends on the time.
    is_timed: bool,
    /// Whether it has switches that the state decides.
    has_switches: bool,
}

/// A number that waits while the parts of a program are found.
#[derive(Clone, Copy)]
struct Part {
    /// Index of its first operation.
    first: usize,
    /// Whether it depends on the time.
    is_timed: bool,
    /// Whether it depends on another variable.
    is_given: bool,
}

impl StateExpression {
    /// Reads an expression in `x`, `v` and `u`.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn new(text: &str) -> Result<Self, String> {
        Self::with_names(text, &NAMES)
    }

    /// Reads an expression in variables of these names, three at most.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn with_names(text: &str, names: &[&'static str]) -> Result<Self, String> {
        let given = names.iter().enumerate();
        let given: Vec<_> = given
            .map(|(place, name)| (*name, Operation::Variable(place)))
            .collect();
        let program = grammar::program(text, "t", &given)?;
        if let [Operation::Number(number)] = program[..]
            && !number.is_finite()
        {
            return Err(format!("expected a finite number, found {number}"));
        }
        let depends = [0, 1, 2].map(|place| program.contains(&Operation::Variable(place)));
        let mut of = Self {
            is_timed: program.contains(&Operation::Time),
            clocks: Vec::new(),
            has_switches: false,
            depends,
            program,
        };
        of.find_switches();
        Ok(of)
    }

    /// Finds the switches, those of the time alone apart from those that the state decides.
    fn find_switches(&mut self) {
        let mut stack: Vec<Part> = Vec::new();
        for (at, operation) in self.program.iter().enumerate() {
            let operands = 1_usize.wrapping_add_signed(-operation.rise());
            let parts = stack.split_off(stack.len() - operands);
            let whole = Part {
                first: parts.first().map_or(at, |part| part.first),
                is_timed: parts.iter().any(|part| part.is_timed) || *operation == Operation::Time,
                is_given: parts.iter().any(|part| part.is_given)
                    || matches!(operation, Operation::Variable(_)),
            };
            if let Operation::Switch(switch) = operation {
                // The numbers between which an `if` chooses decide nothing.
                let deciding = if *switch == Switch::If { 1 } else { operands };
                self.has_switches |= parts[..deciding].iter().any(|part| part.is_given);
            }
            if whole.is_given {
                let ends = parts.iter().skip(1).map(|part| part.first).chain([at]);
                for (place, (part, end)) in parts.iter().zip(ends).enumerate() {
                    let decides = *operation == Operation::Switch(Switch::If) && place == 0;
                    self.clocks
                        .extend(clock(&self.program[part.first..end], part, decides));
                }
            }
            stack.push(whole);
        }
        if let Some(whole) = stack.pop() {
            self.clocks.extend(clock(&self.program, &whole, false));
        }
    }

    /// Value, for `[x, v, u]`.
    pub fn value<N: Number>(&self, t: N, others: [N; 3]) -> N {
        N::of_state(self, t, others)
    }

    /// Value in numbers that an expression runs on.
    pub(super) fn run<N: ConstantPower>(&self, t: N, others: [N; 3]) -> N {
        run_in(&self.program, t, &others)
    }

    /// Derivative by `x` (0) or `v` (1), for `[x, v, u]`.
    pub fn slope(&self, t: f64, others: [f64; 3], by: usize) -> f64 {
        let mut others = others.map(Jet::from_re);
        others[by].v1 = 1.0;
        self.run(Jet::from_re(t), others).v1
    }

    /// Jump of the value where `v` changes its sign, after an `x` at which it is, if it jumps at one of some. A body under such a force can
    /// neither stay at rest nor leave it.
    pub fn jump_at_rest(&self) -> Option<(f64, f64)> {
        const PLACES: [f64; 7] = [0.0, 0.1, -0.1, 1.0, -1.0, 10.0, -10.0];
        let jump = |x: f64, u: f64| {
            // So slow that no slope shows.
            let [back, forth] = [-1e-300, 1e-300].map(|v| self.value(0.0, [x, v, u]));
            let jump = forth - back;
            let is_one = jump.abs() > 1e-9 * (back.abs() + forth.abs()) && jump.abs() > 1e-30;
            (is_one && jump.is_finite()).then_some((x, jump))
        };
        let controls = PLACES.into_iter().flat_map(|x| [0.0, 1.0].map(|u| (x, u)));
        { controls }.find_map(|(x, u)| jump(x, u))
    }

    /// Whether it depends on `x`, on `v` and on `u`.
    pub fn depends(&self) -> [bool; 3] {
        self.depends
    }

    /// Whether it depends on the time.
    pub fn is_timed(&self) -> bool {
        self.is_timed
    }

    /// Whether it has kinks or jumps at times that the state decides.
    pub fn has_switches(&self) -> bool {
        self.has_switches
    }

    /// Returns its largest parts that are in the time alone and have kinks, jumps or waves.
    pub fn clocks(&self) -> &[Expression] {
        &self.clocks
    }
}

/// A part of a program as an expression, if it is in the time alone and has kinks, jumps or waves. A number that decides an `if` has a kink
/// where its sign changes.
fn clock(program: &[Operation], part: &Part, decides: bool) -> Option<Expression> {
    if part.is_given || !part.is_timed {
        return None;
    }
    let mut program = program.to_vec();
    if decides {
        program.extend([Operation::Number(0.0), Operation::Switch(Switch::Greater)]);
    }
    let clock = Expression::run_by(program);
    (clock.has_breaks() || clock.is_periodic()).then_some(clock)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times of all kinks and jumps of the clocks of an expression.
    fn breaks(text: &str) -> Vec<f64> {
        let of = StateExpression::new(text).expect(text);
        let mut found: Vec<f64> = (of.clocks().iter())
            .filter_map(|clock| clock.next_break(0.0, 10.0))
            .collect();
        found.sort_by(f64::total_cmp);
        found
    }

    #[test]
    fn values_and_slopes_are_those_of_calculus() {
        let of = StateExpression::new("3*x^2 + v*abs(v)*t - u*x").expect("an expression");
        let (t, others) = (2.0, [0.5, -1.5, 4.0]);
        assert_eq!(of.value(t, others), 0.75 - 4.5 - 2.0);
        assert_eq!(of.slope(t, others, 0), 3.0 - 4.0);
        assert_eq!(of.slope(t, others, 1), 6.0);
        assert_eq!(of.depends(), [true; 3]);
        assert!(of.is_timed() && of.has_switches());
        let of = StateExpression::new("10*x").expect("an expression");
        assert_eq!(of.depends(), [true, false, false]);
        assert!(!of.is_timed() && !of.has_switches());
    }

    #[test]
    fn switches_of_time_are_found_among_others() {
        for (text, wanted) in [
            ("if(t < 1, 10*x, 20*x)", &[1.0][..]),
            ("if(t - 1, 10*x, 20*x)", &[1.0]),
            ("x*abs(t - 2) + step(t - 3)*v", &[2.0, 3.0]),
            ("max(0, t - 4)", &[4.0]),
            ("max(x, t - 4)", &[]),
            ("x*t", &[]),
            ("x*if(t < 5, min(t, 2), 3)", &[2.0]),
        ] {
            let found = breaks(text);
            assert_eq!(found.len(), wanted.len(), "{text}: {found:?}");
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-12, "{text}: {found}");
            }
        }
        let state = |text: &str| StateExpression::new(text).expect(text).has_switches();
        assert!(state("max(0, x)") && state("max(x, t - 4)") && state("if(v, t, 1)"));
        assert!(!state("if(t < 1, 10*x, 20*x)") && !state("abs(t)*x"));
    }

    #[test]
    fn jumps_at_rest_are_found() {
        let jump = |text: &str| StateExpression::new(text).expect(text).jump_at_rest();
        assert_eq!(jump("3*sign(v)"), Some((0.0, 6.0)));
        assert_eq!(jump("u*v/abs(v)"), Some((0.0, 2.0)));
        assert_eq!(jump("if(v > 0, x, 0)"), Some((0.1, 0.1)));
        for text in [
            "1e9*v + x",
            "v*abs(v)",
            "sign(v)*sqrt(abs(v))",
            "if(v > 0, 2400*v, 1300*v)",
            "tanh(v/1e-6)",
            "sign(x)",
            "sqrt(x - 20)",
        ] {
            assert_eq!(jump(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_told() {
        let told = StateExpression::new("3*q").expect_err("no name");
        assert!(
            told.starts_with("expected one of the names t, x, v, u, PI"),
            "{told}"
        );
        assert_eq!(
            StateExpression::new("1/0").expect_err("not finite"),
            "expected a finite number, found inf"
        );
    }
}
