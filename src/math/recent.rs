//! Functions of time are asked for the same times again and again: an implicit step comes back to its stages with
//! every iteration, and begins where the one before ended.

use super::function::Function;

/// Times that are kept: the start of a step and its stages, at most three of them.
const KEPT: usize = 4;

/// Values of one function at the times at which it was last taken.
#[derive(Clone, Debug)]
pub struct Recent {
    /// Times, s; not numbers at first, which no time equals.
    times: [f64; KEPT],
    derivatives: [[f64; 3]; KEPT],
    oldest: usize,
}

impl Default for Recent {
    /// None yet.
    fn default() -> Self {
        Self {
            times: [f64::NAN; KEPT],
            derivatives: [[f64::NAN; 3]; KEPT],
            oldest: 0,
        }
    }
}

impl Recent {
    /// [`Function::derivatives`] of the function, always the same one, at a time.
    pub fn derivatives(&mut self, function: &Function, t: f64) -> [f64; 3] {
        if let Function::Constant(_) = function {
            return function.derivatives(t);
        }
        let bits = t.to_bits();
        let found = self.times.iter().position(|time| time.to_bits() == bits);
        if let Some(place) = found {
            return self.derivatives[place];
        }
        let derivatives = function.derivatives(t);
        let place = self.oldest;
        (self.times[place], self.derivatives[place]) = (t, derivatives);
        self.oldest = (place + 1) % KEPT;
        derivatives
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In whatever order times come, to the bit: also at the two zeros, which a pole tells apart, and at a jump.
    #[test]
    fn values_at_recent_times_are_those_of_the_function() {
        for text in ["sin(3*t)", "1/t", "step(t - 0.5)"] {
            let function = Function::expression(text).expect(text);
            let mut recent = Recent::default();
            let before = 0.5_f64.next_down();
            let times = [0.0, -0.0, before, 0.5, 0.0, 0.7, before, 0.5, f64::NAN, 0.7];
            for t in times.iter().chain(&times) {
                let [found, wanted] = [recent.derivatives(&function, *t), function.derivatives(*t)];
                assert_eq!(
                    found.map(f64::to_bits),
                    wanted.map(f64::to_bits),
                    "{text} {t}"
                );
            }
        }
    }

    /// Frozen functions keep their values at another time, though the same scratch serves them.
    #[test]
    fn constants_are_not_kept() {
        let mut recent = Recent::default();
        for value in [1.0, 2.0] {
            let found = recent.derivatives(&Function::constant(value), 0.0);
            assert_eq!(found, [value, 0.0, 0.0]);
        }
    }
}
