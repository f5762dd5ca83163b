//! Quadrature rules on [0, 1].

/// A point and its weight.
#[derive(Clone, Copy, Debug)]
pub struct QuadraturePoint {
    /// Coordinate in [0, 1].
    pub at: f64,
    /// Weight; the weights of a rule sum to 1.
    pub weight: f64,
}

const fn point(at: f64, weight: f64) -> QuadraturePoint {
    QuadraturePoint { at, weight }
}

/// sqrt(15) / 10.
const SQRT_15_10: f64 = 0.387_298_334_620_741_7;

/// Gauss-Legendre, exact to degree 5.
pub const GAUSS_3: [QuadraturePoint; 3] = [
    point(0.5 - SQRT_15_10, 5.0 / 18.0),
    point(0.5, 8.0 / 18.0),
    point(0.5 + SQRT_15_10, 5.0 / 18.0),
];

/// Gauss-Legendre, exact to degree 9.
pub const GAUSS_5: [QuadraturePoint; 5] = [
    point(0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    point(0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    point(0.5, 64.0 / 225.0),
    point(0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    point(0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// sqrt(13/15) / 2.
const SQRT_13_15_2: f64 = 0.465_474_668_125_631_4;

/// Between Gauss-Legendre and Gauss-Lobatto, exact to degree 3.
pub const BETWEEN_3: [QuadraturePoint; 3] = [
    point(0.5 - SQRT_13_15_2, 5.0 / 26.0),
    point(0.5, 8.0 / 13.0),
    point(0.5 + SQRT_13_15_2, 5.0 / 26.0),
];

/// Gauss-Lobatto, exact to degree 3, with both ends (Simpson's rule).
pub const LOBATTO_3: [QuadraturePoint; 3] = [
    point(0.0, 1.0 / 6.0),
    point(0.5, 4.0 / 6.0),
    point(1.0, 1.0 / 6.0),
];

/// sqrt(6) / 10.
const SQRT_6_10: f64 = 0.244_948_974_278_317_8;

/// Gauss-Radau, exact to degree 4, with the first end.
pub const RADAU_3: [QuadraturePoint; 3] = [
    point(0.0, 1.0 / 9.0),
    point(0.6 - SQRT_6_10, (16.0 + 10.0 * SQRT_6_10) / 36.0),
    point(0.6 + SQRT_6_10, (16.0 - 10.0 * SQRT_6_10) / 36.0),
];

/// Gauss-Radau, exact to degree 4, with the last end.
pub const RADAU_3_LAST: [QuadraturePoint; 3] = [
    point(0.4 - SQRT_6_10, (16.0 - 10.0 * SQRT_6_10) / 36.0),
    point(0.4 + SQRT_6_10, (16.0 + 10.0 * SQRT_6_10) / 36.0),
    point(1.0, 1.0 / 9.0),
];

/// Integrals from 0 to `x` of the polynomial of degree 4 through values at the points of [`GAUSS_5`], as weights of these values: by
/// Legendre's polynomials, whose products the rule integrates exactly.
///
/// Source: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 22.7.10 (recurrence) and 22.8.5 (derivative, from which
/// the integral follows).
pub fn integrals_to(x: f64) -> [f64; 5] {
    let end = legendre(x);
    GAUSS_5.map(|point| {
        let here = legendre(point.at);
        let terms = (1..5).map(|n| here[n] * (end[n + 1] - end[n - 1]) / 2.0);
        point.weight * (x + terms.sum::<f64>())
    })
}

/// Legendre's polynomials of degree 0 to 5 of `2 x - 1`.
fn legendre(x: f64) -> [f64; 6] {
    let y = 2.0 * x - 1.0;
    let mut p = [1.0, y, 0.0, 0.0, 0.0, 0.0];
    for n in 1..5 {
        let k = n as f64;
        p[n + 1] = ((2.0 * k + 1.0) * y * p[n] - k * p[n - 1]) / (k + 1.0);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integrate(rule: &[QuadraturePoint], degree: i32) -> f64 {
        rule.iter().map(|p| p.weight * p.at.powi(degree)).sum()
    }

    #[test]
    fn integrals_of_polynomials_of_degree_4_are_exact_up_to_any_place() {
        for x in [0.0, 0.17, 0.5, 0.9, 1.0] {
            let weights = integrals_to(x);
            for power in 0..=4 {
                let terms = GAUSS_5.iter().zip(&weights);
                let found: f64 = terms.map(|(p, w)| w * p.at.powi(power)).sum();
                let exact = x.powi(power + 1) / f64::from(power + 1);
                assert!((found - exact).abs() < 1e-15, "{x} {power}");
            }
        }
    }

    #[test]
    fn rules_are_exact_to_their_degree_and_no_further() {
        for (rule, degree, missed) in [
            (&GAUSS_3[..], 5, 1e-5),
            (&GAUSS_5, 9, 1e-6),
            (&BETWEEN_3, 3, 1e-5),
            (&LOBATTO_3, 3, 1e-5),
            (&RADAU_3, 4, 1e-5),
            (&RADAU_3_LAST, 4, 1e-5),
        ] {
            for power in 0..=degree {
                let exact = 1.0 / f64::from(power + 1);
                assert!((integrate(rule, power) - exact).abs() < 1e-15);
            }
            let exact = 1.0 / f64::from(degree + 2);
            assert!((integrate(rule, degree + 1) - exact).abs() > missed);
        }
    }
}
