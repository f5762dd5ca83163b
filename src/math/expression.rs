//! Expressions in the time `t`, with their first four derivatives: a program runs on numbers, on numbers
//! with their derivatives, or on numbers whose derivatives have derivatives.

use std::f64::consts::TAU;

use num_dual::{Dual2, Dual2_64, DualNumCopy};

use super::grammar;
use super::switches::{self, Switch};

/// Most numbers that wait while an expression is evaluated.
pub(super) const DEPTH: usize = 64;
/// Most sines, cosines and tangents whose periods are counted.
const PHASES: usize = 32;

/// An expression in `t` (s): numbers, `PI`, `E`, `+ - * / ^`, parentheses and the functions `sin`, `cos`,
/// `tan`, `asin`, `acos`, `atan`, `atan2(y, x)`, `sinh`, `cosh`, `tanh`, `exp`, `ln`, `log2`, `log10`, `sqrt`,
/// `abs`, `sign` (-1, 0 or 1), `step` (1 from zero on, 0 below), `min` and `max` of two or more, and `if(c, a, b)`,
/// which is `a` where `c` is positive and `b` elsewhere. `a < b`, `<=`, `>`, `>=` are 1 where that is so
/// and 0 elsewhere. Powers bind first, from the right, then signs: `-2^2` is -4; comparisons bind last.
#[derive(Clone, Debug)]
pub struct Expression {
    program: Vec<Operation>,
    switches: bool,
}

/// A step of a program: it takes numbers from the top of a stack and puts one there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operation {
    Time,
    /// Another variable, by its place among those given.
    Variable(usize),
    Number(f64),
    /// Value where the variable is zero, and its constant rate.
    Line([f64; 2]),
    Negate,
    /// The next four: of the number below and the one on top.
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    /// To a constant power: has derivatives also where the base is not positive.
    PowerOf(f64),
    Function(Elementary),
    Switch(Switch),
}

/// Functions of one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Elementary {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Log2,
    Log10,
    Sqrt,
}

impl Expression {
    /// Reads an expression.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn new(text: &str) -> Result<Self, String> {
        Self::of(text, "t")
    }

    /// The time itself.
    pub fn time() -> Self {
        Self::run_by(vec![Operation::Time])
    }

    /// Reads an expression in another variable; the calls below take its value for the time.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn of(text: &str, variable: &'static str) -> Result<Self, String> {
        Self::read(text, variable, &[])
    }

    /// Reads an expression in `t` and in coordinates of a body, at this place of it.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn at(text: &str, place: &[(&'static str, f64)]) -> Result<Self, String> {
        let given = place.iter();
        let given: Vec<_> = given
            .map(|(name, at)| (*name, Operation::Number(*at)))
            .collect();
        Self::read(text, "t", &given)
    }

    /// Value, derivatives by both variables and the mixed second derivative of an expression in two variables, at a place.
    ///
    /// # Errors
    /// What was expected in the text, and what was found.
    pub fn of_two(
        text: &str,
        [first, second]: [&'static str; 2],
        [u, v]: [f64; 2],
    ) -> Result<[f64; 4], String> {
        // Along both diagonals: f' = f_1 + rate f_2 and f'' = f_11 + 2 rate f_12 + f_22.
        let along = |rate: f64| {
            let line = [(second, Operation::Line([v - rate * u, rate]))];
            Self::read(text, first, &line).map(|of| of.derivatives(u))
        };
        let ([value, slope, bend], [_, other, unbend]) = (along(1.0)?, along(-1.0)?);
        Ok([
            value,
            0.5 * (slope + other),
            0.5 * (slope - other),
            0.25 * (bend - unbend),
        ])
    }

    fn read(
        text: &str,
        variable: &'static str,
        given: &[(&'static str, Operation)],
    ) -> Result<Self, String> {
        grammar::program(text, variable, given).map(Self::run_by)
    }

    /// The expression that a program in the time computes.
    pub(super) fn run_by(program: Vec<Operation>) -> Self {
        let switches = switches::any(&program);
        Self { program, switches }
    }

    /// The value if it is the same at all times.
    pub fn constant(&self) -> Option<f64> {
        match self.program[..] {
            [Operation::Number(value)] => Some(value),
            _ => None,
        }
    }

    /// The first time after `from`, `until` at the latest, at which it has a kink, a jump or a pole at which it
    /// changes its sign.
    pub fn next_break(&self, from: f64, until: f64) -> Option<f64> {
        if !self.switches {
            return None;
        }
        switches::next(&self.program, from, until)
    }

    /// Whether it may have kinks or jumps.
    pub fn has_breaks(&self) -> bool {
        self.switches
    }

    /// Value at a time.
    pub fn value(&self, t: f64) -> f64 {
        run(&self.program, t)
    }

    /// Whether it holds sines, cosines or tangents.
    pub fn is_periodic(&self) -> bool {
        let periodic = |of: &Operation| matches!(of, Operation::Function(f) if f.is_periodic());
        self.program.iter().any(periodic)
    }

    /// Most periods that a sine, cosine or tangent in it goes through from one time to another, of the first [`PHASES`].
    pub fn periods(&self, from: f64, until: f64) -> f64 {
        let mut phases = [0.0; PHASES];
        let mut rest = phases.iter_mut();
        let first = |argument| {
            if let Some(phase) = rest.next() {
                *phase = argument;
            }
        };
        run_telling(&self.program, (from, &[]), |_| {}, first);
        let (mut rest, mut most) = (phases.iter(), 0.0_f64);
        let last = |argument: f64| {
            if let Some(phase) = rest.next() {
                most = most.max((argument - phase).abs() / TAU);
            }
        };
        run_telling(&self.program, (until, &[]), |_| {}, last);
        most
    }

    /// Value, first and second derivative at a time.
    pub fn derivatives(&self, t: f64) -> [f64; 3] {
        let found = run(&self.program, Dual2_64::from_re(t).derivative());
        [found.re, found.v1, found.v2]
    }
}

impl Expression {
    /// Value and first four derivatives at a time.
    pub fn orders(&self, t: f64) -> [f64; 5] {
        let number = |re, v1| Dual2_64::new(re, v1, 0.0);
        let t = Dual2::new(number(t, 1.0), number(1.0, 0.0), number(0.0, 0.0));
        let found = run(&self.program, t);
        let (low, high) = (found.re, found.v2);
        [low.re, low.v1, high.re, high.v1, high.v2]
    }
}

impl Operation {
    /// Change of the height of the stack.
    pub(super) fn rise(self) -> isize {
        match self {
            Self::Time | Self::Variable(_) | Self::Number(_) | Self::Line(_) => 1,
            Self::Negate | Self::PowerOf(_) | Self::Function(_) => 0,
            Self::Add | Self::Subtract | Self::Multiply | Self::Divide | Self::Power => -1,
            Self::Switch(switch) => 1 - switch.arity() as isize,
        }
    }
}

impl Elementary {
    fn is_periodic(self) -> bool {
        matches!(self, Self::Sin | Self::Cos | Self::Tan)
    }

    fn apply<N: DualNumCopy<Primitive = f64>>(self, x: N) -> N {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => tanh(x),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Log2 => x.log2(),
            Self::Log10 => x.log10(),
            Self::Sqrt => x.sqrt(),
        }
    }
}

/// `sinh x / cosh x`, of which num-dual makes it, loses derivatives where the quotient is flat.
fn tanh<N: DualNumCopy<Primitive = f64>>(x: N) -> N {
    let sign = x.re().signum();
    if sign * x.re() < 1.0 {
        return x.tanh();
    }
    let decay = (x * N::from(-2.0 * sign)).exp();
    (N::from(1.0) - decay) / (N::from(1.0) + decay) * N::from(sign)
}

/// Numbers that know their constant powers also at zero.
pub(super) trait ConstantPower: DualNumCopy<Primitive = f64> {
    fn to(self, exponent: f64) -> Self;
    /// Whether it is zero with all its derivatives.
    fn vanishes(self) -> bool;
}

impl ConstantPower for f64 {
    fn to(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    fn vanishes(self) -> bool {
        self == 0.0
    }
}

impl<T: ConstantPower> ConstantPower for Dual2<T>
where
    Self: DualNumCopy<Primitive = f64>,
{
    fn to(self, n: f64) -> Self {
        // What is multiplied by zero is zero, even an infinite power.
        let term = |factor: f64, n: f64| {
            if factor == 0.0 {
                T::from(0.0)
            } else {
                self.re.to(n) * T::from(factor)
            }
        };
        let (first, second) = (term(n, n - 1.0), term(n * (n - 1.0), n - 2.0));
        let curvature = if self.v1.vanishes() {
            T::from(0.0)
        } else {
            second * self.v1 * self.v1
        };
        Self::new(self.re.to(n), first * self.v1, first * self.v2 + curvature)
    }

    fn vanishes(self) -> bool {
        self.re.vanishes() && self.v1.vanishes() && self.v2.vanishes()
    }
}

/// Runs a program whose stack never holds more than [`DEPTH`] numbers.
pub(super) fn run<N: ConstantPower>(program: &[Operation], t: N) -> N {
    run_noting(program, t, |_| {})
}

/// Runs a program; `note` is told the branches that its switches take, and on which side of their poles
/// quotients and tangents are, in order.
pub(super) fn run_noting<N: ConstantPower>(program: &[Operation], t: N, note: impl FnMut(u8)) -> N {
    run_telling(program, (t, &[]), note, |_| {})
}

/// Runs a program in the time and other variables.
pub(super) fn run_in<N: ConstantPower>(program: &[Operation], t: N, others: &[N]) -> N {
    run_telling(program, (t, others), |_| {}, |_| {})
}

/// Runs a program in the time and other variables; `tell` gets the arguments of sines, cosines and tangents as well, in order.
fn run_telling<N: ConstantPower>(
    program: &[Operation],
    (t, others): (N, &[N]),
    mut note: impl FnMut(u8),
    mut tell: impl FnMut(f64),
) -> N {
    let mut stack = [N::from(0.0); DEPTH];
    let mut height = 0_usize;
    for operation in program {
        height = height.wrapping_add_signed(operation.rise());
        let top = height - 1;
        stack[top] = match *operation {
            Operation::Time => t,
            Operation::Variable(place) => others[place],
            Operation::Number(number) => N::from(number),
            Operation::Line([at_zero, rate]) => N::from(at_zero) + t * N::from(rate),
            Operation::Negate => -stack[top],
            Operation::Add => stack[top] + stack[height],
            Operation::Subtract => stack[top] - stack[height],
            Operation::Multiply => stack[top] * stack[height],
            Operation::Divide => {
                note(u8::from(stack[height].re() >= 0.0));
                stack[top] / stack[height]
            }
            Operation::Power => stack[top].powd(stack[height]),
            Operation::PowerOf(exponent) => stack[top].to(exponent),
            Operation::Function(function) => {
                if function.is_periodic() {
                    tell(stack[top].re());
                }
                if function == Elementary::Tan {
                    note(u8::from(stack[top].re().cos() >= 0.0));
                }
                function.apply(stack[top])
            }
            Operation::Switch(switch) => {
                let at = |k: usize| stack[(top + k).min(DEPTH - 1)];
                let (value, branch) = switch.apply([stack[top], at(1), at(2)]);
                note(branch);
                value
            }
        };
    }
    stack[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Expressions, a time, and what they and their derivatives are there, by hand.
    #[test]
    fn values_and_derivatives_are_those_of_calculus() {
        let (s, c) = 0.6_f64.sin_cos();
        let th = 0.2_f64.tanh();
        let decay = (-0.2_f64).exp();
        let cases: [(&str, f64, [f64; 3]); 27] = [
            ("sin(3*t)", 0.2, [s, 3.0 * c, -9.0 * s]),
            ("cos(3*t)", 0.2, [c, -3.0 * s, -9.0 * c]),
            ("-t^2", 2.0, [-4.0, -4.0, -2.0]),
            ("(-t)^2 + 1", 2.0, [5.0, 4.0, 2.0]),
            ("2*-t", 2.0, [-4.0, -2.0, 0.0]),
            ("2^-t*2^t", 2.0, [1.0, 0.0, 0.0]),
            ("2^3^2 + 0*t", 2.0, [512.0, 0.0, 0.0]),
            ("10 - t - 2", 3.0, [5.0, -1.0, 0.0]),
            ("10 - t + 2*t", 3.0, [13.0, 1.0, 0.0]),
            ("8/t/2*t", 3.0, [4.0, 0.0, 0.0]),
            ("t^1", 0.0, [0.0, 1.0, 0.0]),
            ("t^2", 0.0, [0.0, 0.0, 2.0]),
            ("t^3", -1.0, [-1.0, 3.0, -6.0]),
            ("t^2.5", 0.0, [0.0, 0.0, 0.0]),
            ("(t-1)^0", 1.0, [1.0, 0.0, 0.0]),
            ("t^-1", 2.0, [0.5, -0.25, 0.25]),
            ("(t^2)^1.5", 0.0, [0.0, 0.0, 0.0]),
            ("1.5e-3*t + 2E2", 2.0, [200.003, 1.5e-3, 0.0]),
            ("exp(-t)", 0.2, [decay, -decay, decay]),
            (
                "tanh(t)",
                0.2,
                [th, 1.0 - th * th, -2.0 * th * (1.0 - th * th)],
            ),
            ("sqrt(t)", 4.0, [2.0, 0.25, -1.0 / 32.0]),
            ("1/(1+t^2)", 0.5, [0.8, -0.64, -0.256]),
            ("atan(t)", 0.5, [0.5_f64.atan(), 0.8, -0.64]),
            ("E^(2*t)", 0.0, [1.0, 2.0, 4.0]),
            ("ln(t)", 2.0, [2.0_f64.ln(), 0.5, -0.25]),
            ("log10(10^t) + log2(2^t)", 0.3, [0.6, 2.0, 0.0]),
            (
                "10*(t/0.2)^3-15*(t/0.2)^4+6*(t/0.2)^5",
                0.2,
                [1.0, 0.0, 0.0],
            ),
        ];
        for (text, t, wanted) in cases {
            let f = Expression::new(text).expect(text);
            let found = f.derivatives(t);
            assert!((f.value(t) - wanted[0]).abs() < 1e-12, "{text}");
            for order in 0..3 {
                let error = (found[order] - wanted[order]).abs();
                assert!(error < 1e-10, "{text}: {found:?}, expected {wanted:?}");
            }
        }
    }

    #[test]
    fn derivatives_of_two_variables_are_those_of_calculus() {
        let (u, v) = (0.3_f64, 0.7_f64);
        let wave = u.sin() * v.powi(3) - 2.0 * u;
        let wanted = [
            wave,
            u.cos() * v.powi(3) - 2.0,
            3.0 * u.sin() * v * v,
            3.0 * u.cos() * v * v,
        ];
        let found = Expression::of_two("sin(a)*b^3 - 2*a", ["a", "b"], [u, v]);
        for (found, wanted) in found.expect("an expression").into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
        }
        assert!(Expression::of_two("a*t", ["a", "b"], [u, v]).is_err());
        let kink = Expression::of_two("abs(a-b)*b", ["a", "b"], [u, v]).expect("an expression");
        assert!((kink[3] + 1.0).abs() < 1e-14, "{kink:?}");
    }

    #[test]
    fn periods_are_those_of_the_fastest_wave() {
        for (text, from, until, wanted) in [
            ("sin(2*PI*50*t)", 0.0, 0.1, 5.0),
            ("3*cos(2*PI*t) + tan(2*PI*7*t)", 1.0, 1.5, 3.5),
            ("sin(2*PI*t^2)", 1.0, 3.0, 8.0),
            ("exp(-1e9*t)", 0.0, 1.0, 0.0),
        ] {
            let f = Expression::new(text).expect(text);
            assert!((f.periods(from, until) - wanted).abs() < 1e-12, "{text}");
            assert_eq!(f.is_periodic(), wanted > 0.0, "{text}");
        }
    }

    /// Every smooth function of one number.
    fn elementary() -> Vec<String> {
        let smooth = grammar::FUNCTIONS.iter().filter_map(|(name, operation)| {
            let is_smooth = matches!(operation, Operation::Function(_));
            is_smooth.then(|| format!("{name}(0.3 + 0.1*t)"))
        });
        smooth.collect()
    }

    #[test]
    fn every_function_has_its_derivatives() {
        let functions = elementary();
        let others = ["(1+t)^(1-t)", "2^t/(t+3)*5-t", "-(t^1.5)"].map(String::from);
        for text in functions.iter().chain(&others) {
            let f = Expression::new(text).expect(text);
            let (t, h) = (0.7, 1e-4);
            let (y, before, after) = (f.derivatives(t), f.value(t - h), f.value(t + h));
            let first = (after - before) / (2.0 * h);
            let second = (after - 2.0 * y[0] + before) / (h * h);
            assert!((first - y[1]).abs() < 1e-7, "{text}: {first} {y:?}");
            assert!((second - y[2]).abs() < 1e-6, "{text}: {second} {y:?}");
        }
    }

    #[test]
    fn third_and_fourth_derivatives_follow_from_those_below() {
        let functions = elementary();
        let others = [
            "(1+t)^(1-t)",
            "2^t/(t+3)*5-t",
            "t^4",
            "tanh(20*(t-15))",
            "tanh(3*t)",
            "3*t^2 + (15/(2*PI))^2*(cos(2*PI*t/15) - 1)",
        ];
        for text in functions.iter().map(String::as_str).chain(others) {
            let f = Expression::new(text).expect(text);
            let (t, h) = (0.7, 1e-3);
            let y = f.orders(t);
            let low = f.derivatives(t);
            for order in 0..3 {
                assert!(
                    (y[order] - low[order]).abs() < 1e-14,
                    "{text}: {y:?} {low:?}"
                );
            }
            let [far, before, after, beyond] = [-2.0, -1.0, 1.0, 2.0].map(|k| f.orders(t + k * h));
            for order in 1..5 {
                let below = |y: [f64; 5]| y[order - 1];
                let difference = (below(far) - 8.0 * below(before) + 8.0 * below(after)
                    - below(beyond))
                    / (12.0 * h);
                let error = (y[order] - difference).abs();
                assert!(
                    error < 1e-9 * (1.0 + y[order].abs()),
                    "{text} {order}: {y:?}"
                );
            }
        }
    }

    #[test]
    fn what_does_not_change_is_a_constant() {
        let constant = |text| Expression::new(text).expect("an expression").constant();
        assert_eq!(constant("2*PI"), Some(2.0 * std::f64::consts::PI));
        assert_eq!(constant("-3"), Some(-3.0));
        assert_eq!(constant("t"), None);
    }

    #[test]
    fn as_many_numbers_wait_as_may() {
        let deep = |n: usize| format!("{}t{}", "1+(".repeat(n), ")".repeat(n));
        let f = Expression::new(&deep(DEPTH - 1)).expect("not too deep");
        assert_eq!(f.derivatives(2.0), [DEPTH as f64 + 1.0, 1.0, 0.0]);
        let told = Expression::new(&deep(DEPTH)).expect_err("too deep");
        assert!(told.contains("fewer parentheses"), "{told}");
    }
}
