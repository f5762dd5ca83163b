//! Quantities that change along an element with its section: stiffness and density of a tapered body.
//!
//! Source: forward differences and Boole's rule, M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 25.2.28 and
//! 25.4.14.

/// A number along an element: a polynomial of degree 4 in `xi` in [0, 1], as second moments of area are where a section
/// changes its size linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementPolynomial {
    /// Forward differences of the values at `xi` = 0, 1/4, 1/2, 3/4, 1.
    differences: [f64; 5],
}

impl From<f64> for ElementPolynomial {
    fn from(value: f64) -> Self {
        Self {
            differences: [value, 0.0, 0.0, 0.0, 0.0],
        }
    }
}

impl ElementPolynomial {
    /// The polynomial through the values of a function of `xi` at five even places.
    pub fn through(of: impl Fn(f64) -> f64) -> Self {
        let mut differences = [0.0, 0.25, 0.5, 0.75, 1.0].map(of);
        for order in 1..5 {
            for k in (order..5).rev() {
                differences[k] -= differences[k - 1];
            }
        }
        Self { differences }
    }

    /// Evaluates the quantity at `xi` in [0, 1].
    pub fn at(&self, xi: f64) -> f64 {
        let [first, second, third, fourth, fifth] = self.differences;
        let t = 4.0 * xi;
        let rest = fourth + (t - 3.0) / 4.0 * fifth;
        let rest = second + (t - 1.0) / 2.0 * (third + (t - 2.0) / 3.0 * rest);
        first + t * rest
    }

    /// Returns the mean over the element (Boole's rule, exact to degree 5).
    pub fn mean(&self) -> f64 {
        if self.is_uniform() {
            return self.differences[0];
        }
        let weights = [7.0, 32.0, 12.0, 32.0, 7.0];
        let places = [0.0, 0.25, 0.5, 0.75, 1.0];
        let terms = places.into_iter().zip(weights);
        terms.map(|(xi, weight)| weight * self.at(xi)).sum::<f64>() / 90.0
    }

    /// Whether it is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        self.differences[1..] == [0.0; 4]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goes_through_polynomials_of_degree_4() {
        let of = |x: f64| 2.0 - 3.0 * x + 0.5 * x * x - 4.0 * x.powi(3) + 1.5 * x.powi(4);
        let along = ElementPolynomial::through(of);
        for xi in [0.0, 0.1, 0.33, 0.5, 0.77, 1.0] {
            assert!((along.at(xi) - of(xi)).abs() < 1e-14);
        }
        let mean = 2.0 - 1.5 + 0.5 / 3.0 - 1.0 + 0.3;
        assert!((along.mean() - mean).abs() < 1e-15);
        let same = ElementPolynomial::from(0.1);
        assert_eq!(
            (same.at(0.3), same.mean(), same.is_uniform()),
            (0.1, 0.1, true)
        );
    }
}
