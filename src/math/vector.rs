//! Sums over slices of equal length.

/// Inner product. The sum is one, in order; four terms a pass take half the instructions of one.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, a_rest) = a[..n].as_chunks::<4>();
    let (b, b_rest) = b[..n].as_chunks::<4>();
    let mut sum = -0.0;
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            sum += a[k] * b[k];
        }
    }
    for (a, b) in a_rest.iter().zip(b_rest) {
        sum += a * b;
    }
    sum
}

/// Inner product of few numbers: without loops where they are as many as constraints have on one body or on two.
#[inline(always)]
pub fn short_dot(a: &[f64], b: &[f64]) -> f64 {
    fn of<const N: usize>(a: &[f64], b: &[f64]) -> Option<f64> {
        let (a, b) = (a.first_chunk::<N>()?, b.first_chunk::<N>()?);
        let mut sum = a[0] * b[0];
        for k in 1..N {
            sum += a[k] * b[k];
        }
        Some(sum)
    }
    let known = match a.len() {
        4 => of::<4>(a, b),
        6 => of::<6>(a, b),
        12 => of::<12>(a, b),
        _ => None,
    };
    known.unwrap_or_else(|| dot(a, b))
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
