//! Sums over slices of equal length.

/// Inner product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Euclidean norm. Of four sums side by side: one alone waits for itself.
pub fn norm(a: &[f64]) -> f64 {
    let (a, rest) = a.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for a in a {
        for k in 0..4 {
            sums[k] += a[k] * a[k];
        }
    }
    let [p, q, r, s] = sums;
    ((p + q) + (r + s) + dot(rest, rest)).sqrt()
}
