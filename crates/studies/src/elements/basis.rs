//! Shape functions of a rod in pieces of polynomials: Hermite, with nodal position, slope and (degree
//! five) rate of slope, and B-splines of any degree and continuity.
//!
//! Source: A. A. Shabana, report MBS97-2-UIC (1997), Eq. 9 (cubic Hermite); the quintic adds `r''` at
//! both ends, as higher-order elements of the absolute nodal coordinate formulation do (J. Gerstmayr,
//! A. A. Shabana, Analysis of thin beams and cables using the absolute nodal co-ordinate formulation,
//! Nonlinear Dynamics 45 (2006)); L. Piegl, W. Tiller, The NURBS Book (1997), Eqs. 2.5 and 2.7.

use super::rule::Point;

/// Most functions that are not zero on one element.
pub const MOST: usize = 8;

/// Value, first and second derivative by the reference length of a function at a point.
pub type Jet = [f64; 3];

/// Kind of shape functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// Nodal vectors `r, r'` (2, cubic) or `r, r', r''` (3, quintic).
    Hermite(usize),
    /// B-splines with open ends.
    Spline {
        /// Degree of the polynomials.
        degree: usize,
        /// Continuous derivatives between elements.
        continuity: usize,
    },
}

impl Basis {
    /// Number of functions that are not zero on an element.
    pub fn local(self) -> usize {
        match self {
            Self::Hermite(vectors) => 2 * vectors,
            Self::Spline { degree, .. } => degree + 1,
        }
    }

    /// First function of element `i` is `i` times this: how many functions an element adds.
    pub fn stride(self) -> usize {
        match self {
            Self::Hermite(vectors) => vectors,
            Self::Spline { degree, continuity } => degree - continuity,
        }
    }

    /// Continuous derivatives between elements.
    pub fn continuity(self) -> usize {
        match self {
            Self::Hermite(vectors) => vectors - 1,
            Self::Spline { continuity, .. } => continuity,
        }
    }

    /// Number of functions on a mesh.
    pub fn functions(self, elements: usize) -> usize {
        elements * self.stride() + self.local() - self.stride()
    }

    /// The functions of an element at `xi` in [0, 1]; `breaks` are the ends of elements, m.
    pub fn at(self, breaks: &[f64], element: usize, xi: f64) -> [Jet; MOST] {
        match self {
            Self::Hermite(vectors) => hermite(vectors, breaks[element + 1] - breaks[element], xi),
            Self::Spline { degree, continuity } => {
                spline(degree, degree - continuity, breaks, element, xi)
            }
        }
    }
}

/// Coefficients of the Hermite polynomials by rising power, in the unit interval.
const CUBIC: [[f64; 6]; 4] = [
    [1.0, 0.0, -3.0, 2.0, 0.0, 0.0],
    [0.0, 1.0, -2.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 3.0, -2.0, 0.0, 0.0],
    [0.0, 0.0, -1.0, 1.0, 0.0, 0.0],
];
const QUINTIC: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, -10.0, 15.0, -6.0],
    [0.0, 1.0, 0.0, -6.0, 8.0, -3.0],
    [0.0, 0.0, 0.5, -1.5, 1.5, -0.5],
    [0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
    [0.0, 0.0, 0.0, -4.0, 7.0, -3.0],
    [0.0, 0.0, 0.0, 0.5, -1.0, 0.5],
];

fn hermite(vectors: usize, length: f64, xi: f64) -> [Jet; MOST] {
    let table: &[[f64; 6]] = if vectors == 2 { &CUBIC } else { &QUINTIC };
    let mut jets = [[0.0; 3]; MOST];
    for (index, (jet, polynomial)) in jets.iter_mut().zip(table).enumerate() {
        for a in polynomial.iter().rev() {
            jet[2] = jet[2] * xi + 2.0 * jet[1];
            jet[1] = jet[1] * xi + jet[0];
            jet[0] = jet[0] * xi + a;
        }
        // The k-th nodal vector is a k-th derivative by length.
        let mut scale = length.powi((index % vectors) as i32);
        for value in jet {
            *value *= scale;
            scale /= length;
        }
    }
    jets
}

/// Cox and de Boor, with derivatives from the two degrees below.
fn spline(degree: usize, repeats: usize, breaks: &[f64], element: usize, xi: f64) -> [Jet; MOST] {
    let elements = breaks.len() - 1;
    let s = breaks[element] + xi * (breaks[element + 1] - breaks[element]);
    // Knot `degree + i` for i from -degree to degree + 1, counted from the left end of the element.
    let knot = |i: isize| {
        let left = if i <= 0 {
            element as isize + i / repeats as isize
        } else {
            element as isize + 1 + (i - 1) / repeats as isize
        };
        breaks[left.clamp(0, elements as isize) as usize]
    };
    // rows[p][j]: function j of degree p.
    let mut rows = [[0.0; MOST]; MOST];
    rows[0][0] = 1.0;
    for p in 1..=degree {
        for j in 0..p {
            let (left, right) = support(p, j, &knot);
            let part = rows[p - 1][j] / (right - left);
            rows[p][j] += (right - s) * part;
            rows[p][j + 1] += (s - left) * part;
        }
    }
    let derive = |p: usize, below: &[f64; MOST]| {
        let mut row = [0.0; MOST];
        for j in 0..p {
            let (left, right) = support(p, j, &knot);
            let part = p as f64 * below[j] / (right - left);
            row[j] -= part;
            row[j + 1] += part;
        }
        row
    };
    let first = derive(degree, &rows[degree - 1]);
    let second = derive(degree, &derive(degree - 1, &rows[degree - 2]));
    std::array::from_fn(|j| [rows[degree][j], first[j], second[j]])
}

/// Ends of the support that functions `j` and `j + 1` of degree `p` share.
fn support(p: usize, j: usize, knot: &impl Fn(isize) -> f64) -> (f64, f64) {
    let j = j as isize;
    (knot(j + 1 - p as isize), knot(j + 1))
}

/// Ends of `elements` elements of a length (m); each is `ratio` times as long as the one before.
pub fn graded(length: f64, elements: usize, ratio: f64) -> Vec<f64> {
    let mut at = 0.0;
    let mut ends = vec![0.0];
    for i in 0..elements {
        at += ratio.powi(i as i32);
        ends.push(at);
    }
    ends.iter().map(|end| end * length / at).collect()
}

/// Integrates over an element.
pub fn points<'a>(
    rule: &'a [Point],
    breaks: &'a [f64],
    element: usize,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let length = breaks[element + 1] - breaks[element];
    rule.iter().map(move |p| (p.at, p.weight * length))
}
