//! Eigenvalues of a matrix in upper Hessenberg form: the double-shift QR iteration.
//!
//! Source: R. S. Martin, G. Peters, J. H. Wilkinson, The QR algorithm for real Hessenberg matrices,
//! Numerische Mathematik 14 (1970), 219-231; G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed.,
//! algorithm 7.5.1. nalgebra's `Schur` lacks the exceptional shifts and does not end on
//! a chain of springs and gyroscopes (docs/decisions/0024-a-good-guest.md).

use nalgebra::DMatrix;
use nalgebra::linalg::balancing::balance_parlett_reinsch;

/// Sweeps until one eigenvalue or pair splits off; every [`EXCEPTIONAL`]-th takes shifts of its own.
const SWEEPS: usize = 60;
const EXCEPTIONAL: usize = 10;
/// Sweeps after which rows that stay together are scaled anew: eigenvalues that are equal but for roundoff leave tiny
/// entries below the diagonal and large ones above.
const SCALED: usize = 20;

/// Eigenvalues (real and imaginary part) of a Hessenberg matrix of finite entries not far from 1,
/// in no order. Returns `None` when the iteration does not converge.
pub fn eigenvalues(mut h: DMatrix<f64>) -> Option<Vec<(f64, f64)>> {
    let size = h.norm();
    let mut values = Vec::with_capacity(h.nrows());
    let (mut end, mut sweeps) = (h.nrows(), 0);
    while end > 0 {
        let start = block_start(&h, end, size);
        match end - start {
            1 => values.push((h[(start, start)], 0.0)),
            2 => values.extend(pair(&h, start)),
            _ if sweeps == SWEEPS => return None,
            _ => {
                sweeps += 1;
                if sweeps % SCALED == 0 {
                    scale(&mut h, start, end);
                }
                let shifts = shifts(&h, end, sweeps % EXCEPTIONAL == 0);
                sweep(&mut h, start, end, shifts);
                continue;
            }
        }
        (end, sweeps) = (start, 0);
    }
    Some(values)
}

/// Balances the rows `start..end`, which are coupled to no others as far as eigenvalues go.
fn scale(h: &mut DMatrix<f64>, start: usize, end: usize) {
    let count = end - start;
    let mut block = h.view((start, start), (count, count)).into_owned();
    balance_parlett_reinsch(&mut block);
    h.view_mut((start, start), (count, count)).copy_from(&block);
}

/// First row of the last block of rows before `end` that is coupled to no row above it but for roundoff.
fn block_start(h: &DMatrix<f64>, end: usize, size: f64) -> usize {
    let coupled = |row: &usize| {
        let beside = h[(row - 1, row - 1)].abs() + h[(*row, *row)].abs();
        let scale = if beside > 0.0 {
            beside.max(f64::EPSILON * size)
        } else {
            size
        };
        h[(*row, row - 1)].abs() > f64::EPSILON * scale
    };
    let rows = (1..end).rev().take_while(coupled).count();
    end - 1 - rows
}

/// The two eigenvalues of the block of two rows that begins at one.
fn pair(h: &DMatrix<f64>, row: usize) -> [(f64, f64); 2] {
    let [a, b] = [h[(row, row)], h[(row, row + 1)]];
    let [c, d] = [h[(row + 1, row)], h[(row + 1, row + 1)]];
    let half = 0.5 * (a - d);
    let square = half * half + b * c;
    let root = square.abs().sqrt();
    if square < 0.0 {
        return [(d + half, root), (d + half, -root)];
    }
    let far = half + root.copysign(half);
    let near = if far == 0.0 { 0.0 } else { -b * c / far };
    [(d + far, 0.0), (d + near, 0.0)]
}

/// Two numbers near eigenvalues of the last rows before `end`: diagonal entries and product of the others
/// of a matrix of two rows that has them as eigenvalues.
fn shifts(h: &DMatrix<f64>, end: usize, exceptional: bool) -> [f64; 3] {
    let (m, n) = (end - 2, end - 1);
    if exceptional {
        let size = h[(n, m)].abs() + h[(m, m - 1)].abs();
        let centre = h[(n, n)] + 0.75 * size;
        return [centre, centre, -0.4375 * size * size];
    }
    [h[(m, m)], h[(n, n)], h[(n, m)] * h[(m, n)]]
}

/// First column of `(H - s1) (H - s2)` on the rows from one on, over the entry below its corner.
fn first_column(h: &DMatrix<f64>, row: usize, [first, second, product]: [f64; 3]) -> [f64; 3] {
    let corner = h[(row, row)];
    let (r, s) = (first - corner, second - corner);
    let top = (r * s - product) / h[(row + 1, row)] + h[(row, row + 1)];
    let column = [
        top,
        h[(row + 1, row + 1)] - corner - r - s,
        h[(row + 2, row + 1)],
    ];
    let size: f64 = column.iter().map(|x| x.abs()).sum();
    column.map(|x| x / size)
}

/// One step of the iteration on the rows `start..end`, three or more. It begins below two entries
/// whose product is roundoff, where there are such.
fn sweep(h: &mut DMatrix<f64>, start: usize, end: usize, shifts: [f64; 3]) {
    let negligible = |row: &usize| {
        let [top, middle, bottom] = first_column(h, *row, shifts);
        let above = h[(*row, row - 1)].abs() * (middle.abs() + bottom.abs());
        let beside = [row - 1, *row, row + 1].map(|i| h[(i, i)].abs());
        above <= f64::EPSILON * top.abs() * beside.iter().sum::<f64>()
    };
    let begin = (start + 1..end - 2).rev().find(negligible).unwrap_or(start);
    let mut bulge = first_column(h, begin, shifts);
    for row in begin..end - 1 {
        let height = 3.min(end - row);
        if row > begin {
            bulge = std::array::from_fn(|i| {
                if i < height {
                    h[(row + i, row - 1)]
                } else {
                    0.0
                }
            });
        }
        let norm = bulge.iter().fold(0.0_f64, |norm, x| norm.hypot(*x));
        if norm == 0.0 {
            continue;
        }
        let top = -norm.copysign(bulge[0]);
        if row > begin {
            h[(row, row - 1)] = top;
            (1..height).for_each(|i| h[(row + i, row - 1)] = 0.0);
        } else if row > start {
            h[(row, row - 1)] *= bulge[0] / top;
        }
        // Householder's reflection I - u v^T with v = (1, ...).
        let factor = 1.0 / (bulge[0] - top);
        let v = [1.0, bulge[1] * factor, bulge[2] * factor];
        let u = v.map(|v| (1.0 - bulge[0] / top) * v);
        for column in row..end {
            let part: f64 = (0..height).map(|i| v[i] * h[(row + i, column)]).sum();
            (0..height).for_each(|i| h[(row + i, column)] -= u[i] * part);
        }
        for line in start..end.min(row + 4) {
            let part: f64 = (0..height).map(|i| v[i] * h[(line, row + i)]).sum();
            (0..height).for_each(|i| h[(line, row + i)] -= u[i] * part);
        }
    }
}
