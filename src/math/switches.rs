//! Switches in expressions (`abs`, `min`, `step`, `if`, ..., and the poles of quotients and tangents, across which
//! nothing goes on), and the times at which they turn over: found by
//! bisection of intervals that are proven to hold no such time, so that none is overlooked however near
//! the next one is.
//!
//! Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapter 6
//! (mean value form) and section 8.1 (bisection).

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};

use super::expression::{ConstantPower, DEPTH, Elementary, Operation, run_noting};
use super::interval::Interval;

/// Function with two branches (`sign` with three) that the sign of its switching argument selects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Switch {
    Abs,
    Sign,
    /// 1 from zero on, 0 below.
    Step,
    Min,
    Max,
    /// The angle of the point `(x, y)`, from `y` and `x`; its cut is the negative half of the axis `x`.
    Atan2,
    /// The second number where the first is positive, else the third.
    If,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

/// Most evaluations over intervals in the search for one time: beyond it the rest is sampled.
const LOOKS: usize = 4000;
/// Samples of the rest.
const SAMPLES: u32 = 256;
/// Most intervals that wait: halves of the longest time down to the shortest.
const WAITING: usize = 128;

/// Shortest way in time, s, that functions of time tell apart: what turns over within it of a time turns over
/// at that time.
pub fn grain(time: f64) -> f64 {
    16.0 * f64::EPSILON * time.abs().max(1.0)
}

impl Switch {
    /// Numbers that it takes.
    pub(super) fn arity(self) -> usize {
        match self {
            Self::Abs | Self::Sign | Self::Step => 1,
            Self::If => 3,
            _ => 2,
        }
    }

    /// Returns the switching argument, which decides the branch.
    fn argument(self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::Abs | Self::Sign | Self::Step | Self::If => a,
            Self::Atan2 => a.max(b),
            _ => a - b,
        }
    }

    /// Returns the range of the switching argument over intervals.
    fn argument_range(self, [a, b]: [Interval; 2]) -> Interval {
        match self {
            Self::Abs | Self::Sign | Self::Step | Self::If => a,
            Self::Atan2 => a.larger(b),
            _ => a.minus(b),
        }
    }

    /// The branch: it only rises or only falls with the argument.
    fn branch(self, argument: f64) -> u8 {
        u8::from(match self {
            Self::Abs | Self::Step | Self::Max | Self::AtLeast => argument >= 0.0,
            Self::If | Self::Greater => argument > 0.0,
            Self::Min | Self::AtMost => argument <= 0.0,
            Self::Less | Self::Atan2 => argument < 0.0,
            Self::Sign => {
                return match argument.partial_cmp(&0.0) {
                    Some(Ordering::Less) => 0,
                    Some(Ordering::Greater) => 2,
                    _ => 1,
                };
            }
        })
    }

    /// Returns the value with the derivatives of its branch, and the branch.
    pub(super) fn apply<N: ConstantPower>(self, [a, b, c]: [N; 3]) -> (N, u8) {
        let branch = self.branch(self.argument([a.re(), b.re()]));
        let value = match (self, branch) {
            (Self::Abs, 0) => -a,
            (Self::Abs, _) => a,
            (Self::Min | Self::Max, 0) => b,
            (Self::Min | Self::Max, _) => a,
            (Self::If, 0) => c,
            (Self::If, _) => b,
            (Self::Sign, _) => N::from(f64::from(branch) - 1.0),
            (Self::Atan2, _) => angle(a, b),
            _ => N::from(f64::from(branch)),
        };
        (value, branch)
    }
}

/// The angle of the point `(x, y)`.
fn angle<N: ConstantPower>(y: N, x: N) -> N {
    let exact = y.re().atan2(x.re());
    let near = if x.re().abs() >= y.re().abs() {
        (y / x).atan()
    } else {
        -(x / y).atan()
    };
    near + N::from(exact - near.re())
}

/// Values of an expression over an interval of time, of its derivative there, and in the middle.
#[derive(Clone, Copy)]
struct Range {
    value: Interval,
    slope: Interval,
    middle: Interval,
}

impl Range {
    fn constant(value: f64) -> Self {
        Self {
            value: Interval::point(value),
            slope: Interval::point(0.0),
            middle: Interval::point(value),
        }
    }

    /// A function of it, from its values and those of its derivative.
    fn map(
        self,
        value: impl Fn(Interval) -> Interval,
        slope: impl Fn(Interval) -> Interval,
    ) -> Self {
        Self {
            value: value(self.value),
            slope: slope(self.value).times(self.slope),
            middle: value(self.middle),
        }
    }

    fn negated(self) -> Self {
        Self {
            value: self.value.negated(),
            slope: self.slope.negated(),
            middle: self.middle.negated(),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            value: self.value.plus(other.value),
            slope: self.slope.plus(other.slope),
            middle: self.middle.plus(other.middle),
        }
    }

    fn times(self, other: Self) -> Self {
        let (a, b) = (self.slope.times(other.value), self.value.times(other.slope));
        Self {
            value: self.value.times(other.value),
            slope: a.plus(b),
            middle: self.middle.times(other.middle),
        }
    }

    fn reciprocal(self) -> Self {
        let one = Interval::point(1.0);
        self.map(|x| one.over(x), |x| one.over(x.square()).negated())
    }

    fn of(self, function: Elementary) -> Self {
        use Elementary::*;
        let one = Interval::point(1.0);
        let log = |x: Interval, base: f64| {
            let positive = x.at_least(0.0).rising(f64::ln);
            positive.over(Interval::point(base.ln()))
        };
        let log_slope = |x: Interval, base: f64| one.over(x.times(Interval::point(base.ln())));
        let unit = |x: Interval| x.at_least(-1.0).at_most(1.0);
        let arc = |x: Interval| one.over(one.minus(unit(x).square()).at_least(0.0).power(0.5));
        match function {
            Sin => self.map(Interval::sin, Interval::cos),
            Cos => self.map(Interval::cos, |x| x.sin().negated()),
            Tan => self.map(Interval::tan, |x| one.plus(x.tan().square())),
            Asin => self.map(|x| unit(x).rising(f64::asin), arc),
            Acos => {
                let falls = |x: Interval| unit(x).negated().rising(|x| (-x).acos());
                self.map(falls, |x| arc(x).negated())
            }
            Atan => self.map(|x| x.rising(f64::atan), |x| one.over(one.plus(x.square()))),
            Sinh => self.map(|x| x.rising(f64::sinh), Interval::cosh),
            Cosh => self.map(Interval::cosh, |x| x.rising(f64::sinh)),
            Tanh => self.map(
                |x| x.rising(f64::tanh),
                |x| one.minus(x.rising(f64::tanh).square()),
            ),
            Exp => self.map(|x| x.rising(f64::exp), |x| x.rising(f64::exp)),
            Ln => {
                let value = |x: Interval| x.at_least(0.0).rising(f64::ln);
                self.map(value, |x| one.over(x))
            }
            Log2 => self.map(|x| log(x, 2.0), |x| log_slope(x, 2.0)),
            Log10 => self.map(|x| log(x, 10.0), |x| log_slope(x, 10.0)),
            Sqrt => self.power_of(0.5),
        }
    }

    fn power_of(self, n: f64) -> Self {
        let slope = |x: Interval| match n {
            0.0 => Interval::point(0.0),
            1.0 => Interval::point(1.0),
            _ => Interval::point(n).times(x.power(n - 1.0)),
        };
        self.map(|x| x.power(n), slope)
    }

    fn power(self, exponent: Self) -> Self {
        // Where the base may be negative nothing is known.
        if self.value.lo <= 0.0 {
            return Self {
                value: Interval::WHOLE,
                slope: Interval::WHOLE,
                middle: Interval::WHOLE,
            };
        }
        self.of(Elementary::Ln).times(exponent).of(Elementary::Exp)
    }

    /// The angle of the point `(x, y)` away from the cut.
    fn angle(y: Self, x: Self) -> Self {
        let over = |a: Self, b: Self| a.times(b.reciprocal()).of(Elementary::Atan);
        let found = if !x.value.contains(0.0) {
            let (up, turn) = (y.value.lo >= 0.0, Self::constant(PI));
            match (x.value.lo > 0.0, up) {
                (true, _) => over(y, x),
                (false, true) => over(y, x).plus(turn),
                (false, false) => over(y, x).plus(turn.negated()),
            }
        } else if !y.value.contains(0.0) {
            let quarter = Self::constant(FRAC_PI_2.copysign(y.value.lo));
            quarter.plus(over(x, y).negated())
        } else {
            let all = Interval { lo: -PI, hi: PI };
            return Self {
                value: all,
                slope: Interval::WHOLE,
                middle: all,
            };
        };
        Self {
            value: found.value.and(Interval::new(-PI, PI)),
            ..found
        }
    }
}

/// Whether a program has switches at all.
pub(super) fn any(program: &[Operation]) -> bool {
    let pairs = program.iter().enumerate();
    let mut switches = pairs.filter(|(i, operation)| match operation {
        Operation::Switch(_) | Operation::Function(Elementary::Tan) => true,
        // What is divided by a number has no pole.
        Operation::Divide => !matches!(program[i - 1], Operation::Number(_)),
        _ => false,
    });
    switches.next().is_some()
}

/// Whether no switch of a program turns over from `a` to `b`, both included, as far as can be proven.
fn holds(program: &[Operation], a: f64, b: f64) -> bool {
    let half = Interval::point(a + 0.5 * (b - a));
    let way = Interval { lo: a, hi: b }.minus(half);
    let time = Range {
        value: Interval { lo: a, hi: b },
        slope: Interval::point(1.0),
        middle: half,
    };
    let mut stack = [Range::constant(0.0); DEPTH];
    let mut height = 0_usize;
    for operation in program {
        height = height.wrapping_add_signed(operation.rise());
        let top = height - 1;
        let x = stack[top];
        let mut found = match *operation {
            Operation::Time => time,
            // Programs whose switches are looked for are in the time alone.
            Operation::Variable(_) => return false,
            Operation::Line([at_zero, rate]) => {
                Range::constant(at_zero).plus(time.times(Range::constant(rate)))
            }
            Operation::Number(number) => Range::constant(number),
            Operation::Negate => x.negated(),
            Operation::Add => x.plus(stack[height]),
            Operation::Subtract => x.plus(stack[height].negated()),
            Operation::Multiply => x.times(stack[height]),
            Operation::Divide if stack[height].value.contains(0.0) => return false,
            Operation::Divide => x.times(stack[height].reciprocal()),
            Operation::Function(Elementary::Tan) if x.value.tan() == Interval::WHOLE => {
                return false;
            }
            Operation::Power => x.power(stack[height]),
            Operation::PowerOf(exponent) => x.power_of(exponent),
            Operation::Function(function) => x.of(function),
            Operation::Switch(switch) => {
                let at = |k: usize| stack[(top + k).min(DEPTH - 1)];
                let [y, z] = [at(1), at(2)];
                let argument = switch.argument_range([x.value, y.value]);
                let branch = switch.branch(argument.lo);
                if branch != switch.branch(argument.hi) {
                    return false;
                }
                taken(switch, branch, [x, y, z])
            }
        };
        let straight = found.middle.plus(found.slope.times(way));
        found.value = found.value.and(straight);
        stack[top] = found;
    }
    true
}

fn taken(switch: Switch, branch: u8, [x, y, z]: [Range; 3]) -> Range {
    match (switch, branch) {
        (Switch::Abs, 0) => x.negated(),
        (Switch::Abs, _) => x,
        (Switch::Min | Switch::Max, 0) => y,
        (Switch::Min | Switch::Max, _) => x,
        (Switch::If, 0) => z,
        (Switch::If, _) => y,
        (Switch::Atan2, _) => Range::angle(x, y),
        (Switch::Sign, _) => Range::constant(f64::from(branch) - 1.0),
        _ => Range::constant(f64::from(branch)),
    }
}

/// The branches that all switches take at a time, as one number.
fn pattern(program: &[Operation], t: f64) -> u64 {
    let mut pattern = 0_u64;
    run_noting(program, t, |branch| {
        pattern = pattern.wrapping_mul(0x0000_0100_0000_01b3) ^ u64::from(branch + 1);
    });
    pattern
}

/// The first number from `a` on at which branches differ from those at `a`; at `b` they do.
fn turn(program: &[Operation], mut a: f64, mut b: f64) -> f64 {
    let before = pattern(program, a);
    loop {
        let middle = a + 0.5 * (b - a);
        if middle <= a || middle >= b {
            return b;
        }
        if pattern(program, middle) == before {
            a = middle;
        } else {
            b = middle;
        }
    }
}

/// The first time after `from`, `until` at the latest, at which a switch of a program turns over. Allocates
/// nothing, and follows from its arguments alone.
pub(super) fn next(program: &[Operation], from: f64, until: f64) -> Option<f64> {
    let mut waiting = [until; WAITING];
    let (mut a, mut count, mut looks) = (from, 1, 0);
    while count > 0 && a < until {
        let b = waiting[count - 1];
        looks += 1;
        if looks > LOOKS {
            return sampled(program, a, until);
        }
        if !holds(program, a, b) {
            if b - a > grain(a) && count < WAITING {
                waiting[count] = a + 0.5 * (b - a);
                count += 1;
                continue;
            }
            if pattern(program, a) != pattern(program, b) {
                return Some(turn(program, a, b));
            }
        }
        a = b;
        count -= 1;
    }
    None
}

/// The first turn that samples show.
fn sampled(program: &[Operation], from: f64, until: f64) -> Option<f64> {
    let at = |k: u32| from + (until - from) * f64::from(k) / f64::from(SAMPLES);
    let before = pattern(program, from);
    let after = (1..=SAMPLES).find(|k| pattern(program, at(*k)) != before)?;
    Some(turn(program, at(after - 1), at(after)))
}

#[cfg(test)]
mod tests;
