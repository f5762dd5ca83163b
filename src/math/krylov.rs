//! Eigenvalues of largest size of an operator that is only applied: block Arnoldi iteration with full
//! reorthogonalization, whose blocks grow when they are told to. A start of its own finds further copies of
//! multiple eigenvalues. The basis is never cut off: with operators that are inverses, as here, it stays short.
//!
//! Sources: Y. Saad, Numerical Methods for Large Eigenvalue Problems, 2nd ed. (2011), sections 6.2 and 6.5
//! (Arnoldi, block Arnoldi), proposition 6.8 (residuals), chapter 8 (inverses); G. H. Golub, C. F. Van Loan,
//! Matrix Computations, 4th ed., section 5.2.8 (a second pass of orthogonalization is enough).

use nalgebra::{Complex, DMatrix};

use super::eigen::eigenvalues;
use super::vector::{dot, norm};

/// Part of a vector that others must leave for it to count.
const NOTHING: f64 = 1e-12;

/// An orthonormal basis and the operator projected onto it.
#[derive(Clone, Debug)]
pub struct Krylov {
    length: usize,
    basis: Vec<Vec<f64>>,
    /// Columns of the projected operator, each as long as the basis was when it was made or longer.
    columns: Vec<Vec<f64>>,
    /// Columns, the sizes of their images and what the basis leaves of these.
    left: Vec<(usize, f64, Vec<f64>)>,
    seed: u64,
    starts: usize,
}

/// An approximate eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ritz {
    /// The value.
    pub value: Complex<f64>,
    /// Size of what is missing in its equation, for a vector of unit length.
    pub residual: f64,
}

impl Krylov {
    /// Nothing yet, for vectors of this length.
    pub fn new(length: usize) -> Self {
        Self {
            length,
            basis: Vec::new(),
            columns: Vec::new(),
            left: Vec::new(),
            seed: 1,
            starts: 1,
        }
    }

    /// The basis.
    pub fn basis(&self) -> &[Vec<f64>] {
        &self.basis
    }

    /// Length of the basis.
    pub fn size(&self) -> usize {
        self.basis.len()
    }

    /// Has the next extension start afresh, too.
    pub fn start(&mut self) {
        self.starts += 1;
    }

    /// Extends the basis by `count` vectors. False where it spans all that the operator reaches before:
    /// then the projected operator is exact. An operator may map everything into a subspace.
    pub fn extend(&mut self, count: usize, mut apply: impl FnMut(&mut [f64])) -> bool {
        for _ in 0..count {
            let Some(vector) = self.next(&mut apply) else {
                return false;
            };
            for (column, _, left) in &mut self.left {
                let part = dot(&vector, left);
                subtract(part, &vector, left);
                self.columns[*column].resize(self.basis.len(), 0.0);
                self.columns[*column].push(part);
            }
            let mut image = vector.clone();
            apply(&mut image);
            self.basis.push(vector);
            let size = norm(&image);
            let mut column = vec![0.0; self.basis.len()];
            self.orthogonalize(&mut image, &mut column);
            if norm(&image) > NOTHING * size {
                self.left.push((self.columns.len(), size, image));
            }
            self.columns.push(column);
        }
        true
    }

    /// A unit vector that the basis does not span: a start, or what is left of the oldest image.
    fn next(&mut self, apply: &mut impl FnMut(&mut [f64])) -> Option<Vec<f64>> {
        let mut none = vec![0.0; self.basis.len()];
        while self.starts > 0 {
            self.starts -= 1;
            let mut vector: Vec<f64> = (0..self.length).map(|_| self.random()).collect();
            apply(&mut vector);
            let size = norm(&vector);
            self.orthogonalize(&mut vector, &mut none);
            if let Some(unit) = unit(vector, NOTHING * size) {
                return Some(unit);
            }
        }
        while !self.left.is_empty() {
            let (column, size, mut vector) = self.left.remove(0);
            let mut parts = vec![0.0; self.basis.len()];
            self.orthogonalize(&mut vector, &mut parts);
            let rest = norm(&vector);
            if let Some(unit) = unit(vector, NOTHING * size) {
                parts.push(rest);
                let to = &mut self.columns[column];
                to.resize(parts.len(), 0.0);
                to.iter_mut().zip(parts).for_each(|(to, part)| *to += part);
                return Some(unit);
            }
        }
        None
    }

    /// Takes the basis out, and adds what was taken out.
    fn orthogonalize(&self, vector: &mut [f64], parts: &mut [f64]) {
        for _ in 0..2 {
            for (unit, sum) in self.basis.iter().zip(&mut *parts) {
                let part = dot(unit, vector);
                subtract(part, unit, vector);
                *sum += part;
            }
        }
    }

    fn random(&mut self) -> f64 {
        self.seed = self
            .seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    }

    fn projected(&self) -> DMatrix<f64> {
        let n = self.size();
        DMatrix::from_fn(n, n, |i, j| self.columns[j].get(i).copied().unwrap_or(0.0))
    }

    /// Approximate eigenvalues of a symmetric operator, those of largest size first. `None` where the
    /// operator was not finite.
    pub fn symmetric(&self) -> Option<Vec<Ritz>> {
        let matrix = self.projected();
        if matrix.is_empty() || !matrix.iter().all(|x| x.is_finite()) {
            return matrix.is_empty().then(Vec::new);
        }
        let whole = (&matrix + matrix.transpose()) * 0.5;
        let eigen = whole.try_symmetric_eigen(f64::EPSILON, 100 * matrix.nrows())?;
        let pairs = eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter());
        let ritz = pairs.map(|(value, vector)| Ritz {
            value: Complex::new(*value, 0.0),
            residual: self.residual(|i| vector[i].abs()),
        });
        Some(sorted(ritz.collect()))
    }

    /// Approximate eigenvalues of any operator, those of largest size first; of a pair the one with the
    /// positive imaginary part only. `None` where the operator was not finite.
    pub fn general(&self) -> Option<Vec<Ritz>> {
        let (n, matrix) = (self.size(), self.projected());
        let values = eigenvalues(n, |i, j| matrix[(i, j)])?;
        let complex = matrix.map(|x| Complex::new(x, 0.0));
        let size = matrix.amax();
        let upper = values.into_iter().filter(|(_, im)| *im >= 0.0);
        let ritz = upper.map(|(re, im)| {
            let value = Complex::new(re, im);
            let vector = eigenvector(&complex, value, size);
            Ritz {
                value,
                residual: self.residual(|i| vector[i]),
            }
        });
        Some(sorted(ritz.collect()))
    }

    /// Bound of the residual of a vector with entries of this size.
    fn residual(&self, size: impl Fn(usize) -> f64) -> f64 {
        let parts = self.left.iter();
        parts
            .map(|(column, _, left)| norm(left) * size(*column))
            .sum()
    }
}

/// Sizes of the entries of a unit eigenvector, by inverse iteration.
fn eigenvector(matrix: &DMatrix<Complex<f64>>, value: Complex<f64>, size: f64) -> Vec<f64> {
    let n = matrix.nrows();
    let mut shifted = matrix.clone();
    let shift = value + Complex::new(1e-14, 0.7e-14) * size;
    for k in 0..n {
        shifted[(k, k)] -= shift;
    }
    let factors = shifted.lu();
    let mut vector = nalgebra::DVector::from_fn(n, |k, _| Complex::new(1.0, 0.1 * (k % 7) as f64));
    for _ in 0..3 {
        if !factors.solve_mut(&mut vector) {
            break;
        }
        let length = vector.norm();
        vector /= Complex::new(length, 0.0);
    }
    vector.iter().map(|x| x.norm()).collect()
}

fn sorted(mut ritz: Vec<Ritz>) -> Vec<Ritz> {
    ritz.sort_by(|a, b| b.value.norm().total_cmp(&a.value.norm()));
    ritz
}

fn unit(mut vector: Vec<f64>, least: f64) -> Option<Vec<f64>> {
    let size = norm(&vector);
    if size.is_nan() || size <= least {
        return None;
    }
    vector.iter_mut().for_each(|x| *x /= size);
    Some(vector)
}

fn subtract(factor: f64, a: &[f64], b: &mut [f64]) {
    b.iter_mut().zip(a).for_each(|(b, a)| *b -= factor * a);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eigenvalues `(n - i)^3 / n^3`, each twice if wanted.
    fn diagonal(twice: bool) -> impl FnMut(&mut [f64]) {
        move |x: &mut [f64]| {
            let n = x.len();
            for (i, x) in x.iter_mut().enumerate() {
                let i = if twice { i / 2 * 2 } else { i };
                *x *= ((n - i) as f64 / n as f64).powi(9);
            }
        }
    }

    #[test]
    fn finds_the_largest_and_their_copies() {
        let exact = |i: usize| ((100 - i) as f64 / 100.0).powi(9);
        for twice in [false, true] {
            let mut krylov = Krylov::new(100);
            krylov.extend(40, diagonal(twice));
            if twice {
                // Whether copies are there already is left to roundoff.
                let once = krylov.symmetric().expect("values");
                assert!((once[0].value.re - exact(0)).abs() < 1e-8);
                krylov.start();
                krylov.extend(60, diagonal(twice));
            }
            for found in [krylov.symmetric(), krylov.general()] {
                let found = found.expect("values");
                for (i, ritz) in found.iter().take(4).enumerate() {
                    let exact = exact(if twice { i / 2 * 2 } else { i });
                    assert!(
                        (ritz.value.re - exact).abs() < 1e-9 + ritz.residual,
                        "{found:?}"
                    );
                    assert!(ritz.residual < 1e-6, "{found:?}");
                }
            }
        }
    }

    #[test]
    fn knows_when_it_has_seen_everything() {
        // A rotation of a plane, three times its size, in a space of five.
        let turn = |x: &mut [f64]| {
            let [a, b] = [x[0], x[1]];
            x.fill(0.0);
            (x[0], x[1]) = (-3.0 * b, 3.0 * a);
        };
        let mut krylov = Krylov::new(5);
        assert!(!krylov.extend(10, turn));
        assert_eq!(krylov.size(), 2);
        let found = krylov.general().expect("values");
        assert_eq!(found.len(), 1);
        assert!((found[0].value - Complex::new(0.0, 3.0)).norm() < 1e-14);
        krylov.start();
        assert!(!krylov.extend(10, |x| x.fill(f64::NAN)));
    }
}
