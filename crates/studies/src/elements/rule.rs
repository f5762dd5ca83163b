//! Quadrature rules of Gauss and Lobatto on [0, 1] with any number of points.
//!
//! Source: P. J. Davis, P. Rabinowitz, Methods of Numerical Integration (1984), section 2.7.

/// A point and its weight.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Coordinate in [0, 1].
    pub at: f64,
    /// Weight; the weights of a rule sum to 1.
    pub weight: f64,
}

/// A rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Gauss-Legendre, exact to degree `2 n - 1`.
    Gauss(usize),
    /// Gauss-Lobatto, with both ends, exact to degree `2 n - 3`.
    Lobatto(usize),
    /// Three points, the outer ones at this part of the half length from the middle; exact to degree 3.
    Three(f64),
}

impl Rule {
    /// Returns the points of the rule.
    pub fn points(self) -> Vec<Point> {
        match self {
            Self::Gauss(n) => (0..n).map(|i| gauss(n, i)).collect(),
            Self::Lobatto(n) => (0..n).map(|i| lobatto(n, i)).collect(),
            Self::Three(part) => {
                let weight = 1.0 / (6.0 * part * part);
                let point = |at, weight| Point { at, weight };
                vec![
                    point(0.5 - 0.5 * part, weight),
                    point(0.5, 1.0 - 2.0 * weight),
                    point(0.5 + 0.5 * part, weight),
                ]
            }
        }
    }
}

/// Legendre polynomial of degree `n`, its derivative inside the interval, and the polynomial of the
/// degree below.
pub fn legendre(n: usize, x: f64) -> (f64, f64, f64) {
    if n == 0 {
        return (1.0, 0.0, 0.0);
    }
    let (mut below, mut p) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (below, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * below) / k);
    }
    let slope = n as f64 * (below - x * p) / (1.0 - x * x);
    (p, slope, below)
}

const NEWTON: usize = 60;

fn gauss(n: usize, index: usize) -> Point {
    let count = n as f64;
    let mut x = -(std::f64::consts::PI * (index as f64 + 0.75) / (count + 0.5)).cos();
    for _ in 0..NEWTON {
        let (p, slope, _) = legendre(n, x);
        x -= p / slope;
    }
    let slope = legendre(n, x).1;
    Point {
        at: 0.5 * (1.0 + x),
        weight: 1.0 / ((1.0 - x * x) * slope * slope),
    }
}

/// Inner points are the extrema of the Legendre polynomial of degree `n - 1`.
fn lobatto(n: usize, index: usize) -> Point {
    let (degree, order) = (n - 1, (n * (n - 1)) as f64);
    let mut x = -(std::f64::consts::PI * index as f64 / degree as f64).cos();
    if index > 0 && index < degree {
        for _ in 0..NEWTON {
            let (p, slope, _) = legendre(degree, x);
            // (1 - x^2) p'' = 2 x p' - n (n - 1) p
            x -= slope * (1.0 - x * x) / (2.0 * x * slope - order * p);
        }
    }
    let p = legendre(degree, x).0;
    Point {
        at: 0.5 * (1.0 + x),
        weight: 1.0 / (order * p * p),
    }
}
