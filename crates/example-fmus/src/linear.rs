//! Small dense matrices as rows, and their exponential.

/// Rows of a matrix.
pub type Matrix = Vec<Vec<f64>>;

/// `A x`.
pub fn apply(a: &Matrix, x: &[f64]) -> Vec<f64> {
    let row = |row: &Vec<f64>| row.iter().zip(x).map(|(a, x)| a * x).sum();
    a.iter().map(row).collect()
}

/// The matrix whose column `j` is `column(e_j)`, of `n` columns.
pub fn columns(n: usize, column: impl Fn(&[f64]) -> Vec<f64>) -> Matrix {
    let mut matrix = Matrix::new();
    for j in 0..n {
        let mut unit = vec![0.0; n];
        unit[j] = 1.0;
        let values = column(&unit);
        matrix.resize(values.len(), vec![0.0; n]);
        for (row, value) in matrix.iter_mut().zip(values) {
            row[j] = value;
        }
    }
    matrix
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    columns(b.len(), |unit| apply(a, &apply(b, unit)))
}

/// `exp(h A)` by scaling, Taylor's series and squaring. Only the first `states` columns count for the
/// scale: the others are inputs, which enter once, and would cost digits where they are large.
pub fn exponential(a: &Matrix, h: f64, states: usize) -> Matrix {
    let norm = a
        .iter()
        .map(|row| row[..states].iter().map(|x| (x * h).abs()).sum::<f64>())
        .fold(0.0, f64::max);
    let squarings = (2.0 * norm).max(1.0).log2().ceil() as i32;
    let h = h / 2.0_f64.powi(squarings);
    // With a norm of at most 1/2 the 16th term is below roundoff.
    let mut exponential = columns(a.len(), |unit| {
        let (mut term, mut sum) = (unit.to_vec(), unit.to_vec());
        for k in 1..=16 {
            term = apply(a, &term)
                .iter()
                .map(|x| x * h / f64::from(k))
                .collect();
            sum.iter_mut().zip(&term).for_each(|(sum, x)| *sum += x);
        }
        sum
    });
    for _ in 0..squarings {
        exponential = product(&exponential, &exponential);
    }
    exponential
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_turns_a_rotation() {
        let rotation: Matrix = vec![vec![0.0, -1.0], vec![1.0, 0.0]];
        for angle in [0.1, 3.0, 50.0] {
            let found = exponential(&rotation, angle, 2);
            let (sin, cos) = f64::sin_cos(angle);
            let expected = [cos, -sin, sin, cos];
            for (found, expected) in found.concat().into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-13, "{angle}: {found}");
            }
        }
    }
}
