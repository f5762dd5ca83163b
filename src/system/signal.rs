//! Numbers that change in time: functions of time, and inputs that the master sets.

use super::attitude::Attitude;
use super::instant::Instant;
use crate::math::function::Function;
use crate::math::jet::Number;
use crate::math::rotation::Quaternion;

/// The size of a load.
#[derive(Clone, Debug)]
pub enum Signal {
    /// A function of time.
    Function(Function),
    /// Input, by its index.
    Input(usize),
}

impl Signal {
    /// Value.
    pub fn value<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> N {
        match self {
            Self::Function(function) => {
                (at.time).map(|t| function.value(t), |t| function.derivatives(t))
            }
            Self::Input(index) => at.inputs[*index],
        }
    }

    /// Rate, 1/s.
    pub fn rate<const D: usize, N: Number>(&self, at: Instant<'_, D, N>) -> N {
        match self {
            Self::Function(function) => {
                let rates = |t: f64| {
                    let [_, first, second, third, _] = function.orders(t);
                    [first, second, third]
                };
                (at.time).map(|t| function.derivatives(t)[1], rates)
            }
            Self::Input(index) => at.input_rates[*index],
        }
    }

    /// Whether it is the constant zero.
    pub fn is_zero(&self) -> bool {
        matches!(self, Self::Function(Function::Constant(0.0)))
    }

    /// A fraction of what it is at an instant, from then on.
    pub fn held<const D: usize>(&self, at: Instant<'_, D>, fraction: f64) -> Self {
        Self::Function(Function::constant(fraction * self.value(at)))
    }
}

/// A prescribed coordinate: its value and first two derivatives are needed.
#[derive(Clone, Debug)]
pub enum Drive {
    /// A function of time.
    Function(Function),
    /// Inputs from this index on: the value, then as many derivatives.
    Input {
        /// Index of the input with the value.
        first: usize,
        /// Derivatives that are inputs too: 0, 1 or 2.
        derivatives: usize,
    },
    /// One of the four parts, which stand side by side, of the quaternion of an orientation that inputs give.
    Turned {
        /// The inputs.
        attitude: Attitude,
        /// Which part, scalar first.
        part: usize,
    },
    /// A number that the state keeps, and that changes at events only.
    Kept,
}

/// Where a state keeps what friction does: driven coordinates that change at events only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrictionState {
    /// Index of the driven coordinate that holds the place at which the coordinate sticks, m or rad.
    pub place: usize,
    /// Index of the driven coordinate that holds the direction of sliding: 1, -1, or 0 where it sticks.
    pub direction: usize,
}

/// Inputs, or the state, as they prescribe a driven coordinate that follows no function of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputSignal {
    /// Value and derivatives of the coordinate: index of the first input, and the number of inputs.
    Coordinate(usize, usize),
    /// Part of the quaternion of an orientation, by its index.
    Part(Attitude, usize),
    /// None: the state keeps the number.
    Kept,
}

impl InputSignal {
    /// Finds what prescribes a driven coordinate, unless it follows a function of time.
    pub fn of(drive: &Drive) -> Option<Self> {
        match drive {
            Drive::Input { first, derivatives } => Some(Self::Coordinate(*first, 1 + derivatives)),
            Drive::Turned { attitude, part } => Some(Self::Part(*attitude, *part)),
            Drive::Kept => Some(Self::Kept),
            Drive::Function(_) => None,
        }
    }

    /// Whether its second derivative is an input.
    pub fn has_acceleration(self) -> bool {
        match self {
            Self::Coordinate(_, count) => count == 3,
            Self::Part(attitude, _) => attitude.derivatives == 2,
            Self::Kept => false,
        }
    }

    /// Value, first and second derivative where inputs say that it starts.
    pub fn start(self, inputs: &[f64]) -> [f64; 3] {
        match self {
            Self::Coordinate(first, count) => {
                std::array::from_fn(|k| if k < count { inputs[first + k] } else { 0.0 })
            }
            Self::Part(attitude, part) => attitude.start(inputs).map(|order| order[part]),
            Self::Kept => [0.0; 3],
        }
    }

    /// The second derivative that inputs give, at once; that of the coordinate where they give none. `known` is all that
    /// inputs drive, of which it has this place.
    pub fn second<const N: usize>(self, place: usize, known: &[[f64; N]], inputs: &[f64]) -> f64 {
        match self {
            Self::Coordinate(first, 3) => inputs[first + 2],
            Self::Coordinate(..) => known[place][2],
            Self::Part(attitude, part) => {
                attitude.second(quaternion(place - part, known), |i| inputs[i])[part]
            }
            Self::Kept => 0.0,
        }
    }

    /// How that changes along a direction of the inputs.
    pub fn second_along<const N: usize>(
        self,
        place: usize,
        known: &[[f64; N]],
        direction: &[f64],
    ) -> f64 {
        match self {
            Self::Coordinate(first, 3) => direction[first + 2],
            Self::Coordinate(..) => 0.0,
            Self::Part(attitude, part) => {
                let [q, ..] = quaternion(place - part, known);
                attitude.second_along(&q, direction)[part]
            }
            Self::Kept => 0.0,
        }
    }

    /// Third and fourth derivative where inputs have these derivatives; nothing where they do not give the second.
    pub fn higher<const N: usize>(
        self,
        (place, known): (usize, &[[f64; N]]),
        inputs: &[f64],
        slope: impl Fn(usize) -> [f64; 2],
    ) -> Option<[f64; 2]> {
        match self {
            Self::Coordinate(first, 3) => Some(slope(first + 2)),
            Self::Coordinate(..) => None,
            Self::Part(attitude, part) => {
                let now = quaternion(place - part, known);
                let higher = attitude.higher(now, inputs, slope);
                higher.map(|orders| orders.map(|order| order[part]))
            }
            Self::Kept => None,
        }
    }

    /// Returns the trajectory through a step of length `h` (s) that begins at `time`. It leads from the present value
    /// and derivatives to those that the inputs prescribe at the end. The second derivative that inputs prescribe
    /// applies at once.
    pub fn course<const N: usize>(
        self,
        (time, h): (f64, f64),
        (place, known): (usize, &[[f64; N]]),
        input: impl Fn(usize) -> [f64; 3],
    ) -> Trajectory {
        let mut from = std::array::from_fn(|k| known[place][k]);
        match self {
            Self::Coordinate(first, count) => {
                let mut inputs = [[0.0; 3]; 3];
                for (k, told) in inputs[..count].iter_mut().enumerate() {
                    *told = input(first + k);
                }
                if count == 3 {
                    from[2] = inputs[2][0];
                }
                Trajectory::new(time, h, from, &inputs[..count])
            }
            Self::Part(attitude, part) => {
                let now = quaternion(place - part, known);
                from[2] = attitude.second(now, |i| input(i)[0])[part];
                let end = attitude.destination(h, &now[0], input);
                let ends = [from, end.map(|order| order[part])];
                Trajectory::between((time, h), ends, self.has_acceleration())
            }
            Self::Kept => Trajectory::hold(time, from),
        }
    }
}

/// The quaternion whose parts stand from a place on, with two derivatives.
fn quaternion<const N: usize>(first: usize, known: &[[f64; N]]) -> [Quaternion; 3] {
    std::array::from_fn(|order| std::array::from_fn(|part| known[first + part][order]))
}

/// The smooth way of a prescribed coordinate through one communication step: a polynomial.
///
/// An input is known at the beginning of a step only, and jumps from step to step. The coordinate
/// therefore goes from where it is to where the input says it will be at the end of the step: the
/// value itself, or with derivatives its Taylor polynomial. Velocity is continuous; with the second
/// derivative given, acceleration too.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Trajectory {
    start: f64,
    coefficients: [f64; 6],
}

impl Trajectory {
    /// The Taylor polynomial of value and derivatives at a time.
    pub fn hold(time: f64, [p, v, a]: [f64; 3]) -> Self {
        Self {
            start: time,
            coefficients: [p, v, 0.5 * a, 0.0, 0.0, 0.0],
        }
    }

    /// From value and derivatives at `time` to where `inputs` (value, first, second derivative as far as
    /// given, each with its own rate and that one's rate) will be at `time + h`.
    pub fn new(time: f64, h: f64, from: [f64; 3], inputs: &[[f64; 3]]) -> Self {
        let end = destination(h, from[0], inputs);
        Self::between((time, h), [from, end], inputs.len() == 3)
    }

    /// From value and derivatives at a time to those after `h`, the second derivatives met if `is_smooth`.
    pub fn between((time, h): (f64, f64), ends: [[f64; 3]; 2], is_smooth: bool) -> Self {
        let [[p, v, a], [target, rate, second]] = ends;
        let mut c = [p, v, 0.0, 0.0, 0.0, 0.0];
        if !is_smooth {
            // Hermite cubic.
            let way = (target - p) / h;
            c[2] = (3.0 * way - 2.0 * v - rate) / h;
            c[3] = (v + rate - 2.0 * way) / (h * h);
        } else {
            // Hermite quintic.
            c[2] = 0.5 * a;
            let d0 = target - p - h * (v + 0.5 * h * a);
            let d1 = h * (rate - v - h * a);
            let d2 = h * h * (second - a);
            let h3 = h * h * h;
            c[3] = (10.0 * d0 - 4.0 * d1 + 0.5 * d2) / h3;
            c[4] = (-15.0 * d0 + 7.0 * d1 - d2) / (h3 * h);
            c[5] = (6.0 * d0 - 3.0 * d1 + 0.5 * d2) / (h3 * h * h);
        }
        Self {
            start: time,
            coefficients: c,
        }
    }

    /// Value and first four derivatives.
    pub fn orders(&self, time: f64) -> [f64; 5] {
        let t = time - self.start;
        let mut c = self.coefficients;
        std::array::from_fn(|_| {
            let value = c.iter().rev().fold(0.0, |sum, c| sum * t + c);
            for k in 1..c.len() {
                c[k - 1] = k as f64 * c[k];
            }
            c[5] = 0.0;
            value
        })
    }

    /// Value, first and second derivative.
    pub fn derivatives(&self, time: f64) -> [f64; 3] {
        let [value, first, second, ..] = self.orders(time);
        [value, first, second]
    }
}

/// Value and rate, after a time, of what has this value, first and second derivative.
pub fn moved([value, first, second]: [f64; 3], t: f64) -> [f64; 2] {
    [value + t * (first + 0.5 * t * second), first + t * second]
}

/// Value, first and second derivative after `h` of a coordinate that is at `p` and follows inputs. A
/// derivative that is an input carries on what is below it, unless that has a rate of its own.
fn destination(h: f64, p: f64, inputs: &[[f64; 3]]) -> [f64; 3] {
    let at_end = |input: [f64; 3]| moved(input, h)[0];
    let gained =
        |[value, first, second]: [f64; 3]| h * (value + h * (first / 2.0 + h * second / 6.0));
    let moves = |[_, first, second]: [f64; 3]| first != 0.0 || second != 0.0;
    match *inputs {
        [] => [p, 0.0, 0.0],
        [value] if moves(value) => {
            let [target, rate] = moved(value, h);
            [target, rate, value[2]]
        }
        [[value, ..]] => [value, (value - p) / h, 0.0],
        [value, rate, ref rest @ ..] => {
            let second = rest.first().copied().unwrap_or([rate[1], rate[2], 0.0]);
            let rate_at_end = if moves(rate) {
                at_end(rate)
            } else {
                rate[0] + gained(second)
            };
            let way = if moves(rate) {
                gained(rate)
            } else {
                let [a, b, c] = second;
                h * (rate[0] + h * (a / 2.0 + h * (b / 6.0 + h * c / 24.0)))
            };
            let target = if moves(value) {
                at_end(value)
            } else {
                value[0] + way
            };
            [target, rate_at_end, at_end(second)]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_meets_both_ends() {
        let (from, h) = ([0.3, -1.0, 2.0], 0.25);
        for inputs in [&[1.5][..], &[1.5, 0.2], &[1.5, 0.2, -3.0]] {
            let held: Vec<[f64; 3]> = inputs.iter().map(|input| [*input, 0.0, 0.0]).collect();
            let course = Trajectory::new(2.0, h, from, &held);
            let start = course.derivatives(2.0);
            let end = course.derivatives(2.0 + h);
            let [v, a] = [1, 2].map(|i| inputs.get(i).copied().unwrap_or(0.0));
            let target = 1.5 + h * (v + 0.5 * h * a);
            assert!((start[0] - from[0]).abs() + (start[1] - from[1]).abs() < 1e-14);
            assert!((end[0] - target).abs() < 1e-13, "{inputs:?}");
            if inputs.len() > 1 {
                assert!((end[1] - (v + h * a)).abs() < 1e-12);
            }
            if inputs.len() == 3 {
                assert!((start[2] - from[2]).abs() < 1e-12 && (end[2] - a).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn holding_keeps_the_derivatives() {
        let course = Trajectory::hold(1.0, [0.1, 0.2, 0.3]);
        assert_eq!(course.derivatives(1.0), [0.1, 0.2, 0.3]);
    }

    #[test]
    fn a_course_follows_inputs_that_move() {
        // A quintic has its derivatives at the start as inputs with rates, and is met at the end.
        let c = [0.3, -1.0, 0.7, 0.4];
        let at = |t: f64| c[0] + t * (c[1] + t * (c[2] + t * c[3]));
        let rate = |t: f64| c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]);
        let second = |t: f64| 2.0 * c[2] + t * 6.0 * c[3];
        let (from, h) = ([at(0.0), rate(0.0), second(0.0)], 0.2);
        let third = 6.0 * c[3];
        let value = [c[0], c[1], 2.0 * c[2]];
        let moving = [
            vec![[c[0], 0.0, 0.0], [c[1], 2.0 * c[2], third]],
            vec![[c[0], 0.0, 0.0], [c[1], 0.0, 0.0], [2.0 * c[2], third, 0.0]],
        ];
        for inputs in moving {
            let end = Trajectory::new(0.0, h, from, &inputs).orders(h);
            assert!((end[0] - at(h)).abs() < 1e-14, "{inputs:?}");
            assert!((end[1] - rate(h)).abs() < 1e-13, "{inputs:?}");
            assert!((end[2] - second(h)).abs() < 1e-11, "{inputs:?}");
            assert!((end[3] - third).abs() < 1e-9, "{inputs:?}");
        }
        let end = Trajectory::new(0.0, h, from, &[value]).orders(h);
        assert!((end[0] - (at(h) - c[3] * h * h * h)).abs() < 1e-14);
        assert!((end[1] - (rate(h) - 3.0 * c[3] * h * h)).abs() < 1e-13);
    }
}
