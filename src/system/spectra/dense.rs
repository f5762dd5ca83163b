//! Eigenvalues of small dense matrices, and what is made of them: roots, their order, what is roundoff.

use nalgebra::{Complex, DMatrix};

use crate::math::eigen::{eigenvalues as dense_eigenvalues, symmetric_eigenvalues};

/// Roundoff of an eigenvalue of `K`, relative to the size of `K` and the number of coordinates.
pub(super) const ROUNDOFF: f64 = 4.0 * f64::EPSILON;

/// Slowest first; of those that are equally fast the one that oscillates slower, then the one that decays faster.
pub(super) fn sort(found: &mut [Complex<f64>]) {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
    found.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    // Conjugates of a whole spectrum are equally fast to roundoff.
    let mut first = 0;
    while first < found.len() {
        let size = found[first].norm();
        let alike = found[first..]
            .iter()
            .take_while(|s| near(s.norm(), size))
            .count();
        let order = |a: &Complex<f64>, b: &Complex<f64>| {
            if near(a.im, b.im) {
                a.re.total_cmp(&b.re)
            } else {
                a.im.total_cmp(&b.im)
            }
        };
        found[first..first + alike].sort_by(order);
        first += alike;
    }
}

/// Size of the roundoff in eigenvalues of `K`, from theirs and that of the terms which `K` is summed from.
pub(super) fn noise(squares: impl ExactSizeIterator<Item = f64>, terms: f64) -> f64 {
    let count = squares.len() as f64;
    let size = squares.fold(terms, |m, k| m.max(k.abs()));
    ROUNDOFF * count * size
}

/// Eigenvalues `s` from those of `K`, `s^2 = -k`; what is below the noise is zero, twice.
pub(super) fn roots(squares: impl Iterator<Item = Complex<f64>>, noise: f64) -> Vec<Complex<f64>> {
    let mut found = Vec::new();
    for k in squares.filter(|k| k.im >= 0.0) {
        if k.norm() <= noise {
            found.extend([Complex::new(0.0, 0.0); 2]);
        } else if k.im == 0.0 && k.re > 0.0 {
            found.push(Complex::new(0.0, k.re.sqrt()));
        } else if k.im == 0.0 {
            let rate = (-k.re).sqrt();
            found.extend([Complex::new(-rate, 0.0), Complex::new(rate, 0.0)]);
        } else {
            let s = (-k).sqrt();
            found.extend([s, -s].map(|s| Complex::new(s.re, s.im.abs())));
        }
    }
    found
}

/// Eigenvalues of the symmetric part; what is below the noise is zero. `None` where they are not finite.
pub(super) fn symmetric(stiffness: &DMatrix<f64>) -> Option<Vec<f64>> {
    let entry = |i: usize, j: usize| 0.5 * (stiffness[(i, j)] + stiffness[(j, i)]);
    let found = symmetric_eigenvalues(stiffness.nrows(), entry);
    let mut squares = found?;
    let noise = noise(squares.iter().copied(), 0.0);
    squares
        .iter_mut()
        .filter(|k| k.abs() <= noise)
        .for_each(|k| *k = 0.0);
    Some(squares)
}

/// Eigenvalues of any matrix. `None` where they are not finite.
pub(super) fn general(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let found = dense_eigenvalues(matrix.nrows(), |i, j| matrix[(i, j)]);
    let pairs = found?.into_iter();
    Some(pairs.map(|(re, im)| Complex::new(re, im)).collect())
}

/// Eigenvalues of `s^2 I + s R + K`, of a pair the one with the positive imaginary part: those of `[0 C^T; -C -R]`
/// with `K = C C^T`, whose roundoff is that of rates; where `K` is not symmetric and positive definite, of
/// `[0 w I; -K/w -R]`, whose roundoff is that of their squares. `None` where they are not finite.
pub(super) fn quadratic(
    stiffness: &DMatrix<f64>,
    damping: &DMatrix<f64>,
) -> Option<Vec<Complex<f64>>> {
    let n = stiffness.nrows();
    let size = stiffness.amax();
    let skew = (stiffness - stiffness.transpose()).amax();
    // Stiffness of bodies that rotate is what is left of terms as large as squares of gyroscopic rates.
    let gyroscopic = 0.5 * (damping - damping.transpose()).amax();
    let noise = ROUNDOFF * (2 * n) as f64 * size.max(gyroscopic * gyroscopic);
    let root = if skew <= 1e-13 * size {
        // Pivots of roundoff have roots of any size: singular matrices have none.
        (stiffness.clone().cholesky().map(|c| c.l()))
            .filter(|l| l.diagonal().iter().all(|d| d * d > noise))
    } else {
        None
    };
    let rate = match size.sqrt() {
        0.0 => 1.0,
        rate => rate,
    };
    let entry = |i: usize, j: usize| match (i < n, j < n, &root) {
        (true, true, _) => 0.0,
        (true, false, Some(root)) => root[(j - n, i)],
        (true, false, None) => rate * f64::from(u8::from(j - n == i)),
        (false, true, Some(root)) => -root[(i - n, j)],
        (false, true, None) => -stiffness[(i - n, j)] / rate,
        (false, false, _) => -damping[(i - n, j - n)],
    };
    let matrix = DMatrix::from_fn(2 * n, 2 * n, entry);
    let found = general(&matrix)?.into_iter().filter(|s| s.im >= 0.0);
    // Without a root a double eigenvalue 0 shows as the root of roundoff.
    let zero = |s: Complex<f64>| root.is_none() && s.norm_sqr() <= noise;
    let twice = |s: Complex<f64>| match (zero(s), s.im > 0.0) {
        (true, true) => vec![Complex::new(0.0, 0.0); 2],
        (true, false) => vec![Complex::new(0.0, 0.0)],
        _ => vec![s],
    };
    Some(found.flat_map(twice).collect())
}
