//! QR of the transposed constraints of a chain, scaled element by element: `S Phi^T = Q R`. A front of
//! each interface takes what is passed on to it and the next element, two rows of `R` out of them and
//! two free coordinates, and passes the rest on: at most 6 x 6, never more fill.
//!
//! Source: multifrontal QR, T. A. Davis, ACM Trans. Math. Softw. 38 (2011), 8; the reflections of a front
//! are multiplied out.

use flexbody::math::householder::{reflect, reflector};

use super::rod::{Mass, Node, rows};

/// Rows of a front that are kept: two passed on, two free; columns: the element, then what was passed.
type Front = [[f64; 6]; 4];

/// The part `Q2` of `Q` that is free of `R`, times a scaling of the elements: `u = B Q2 q` and
/// `q = Q2^T B^T f`.
pub struct Fronts {
    fronts: Vec<Front>,
}

impl Fronts {
    /// From scalings `S` and `B` of every element.
    pub fn new(scalings: &[Mass], back: impl Fn(usize) -> Mass) -> Self {
        let count = scalings.len();
        let mut passed = [[0.0; 2]; 2];
        let mut fronts = Vec::new();
        for (j, scaling) in scalings.iter().enumerate() {
            let (q, next) = front(j, count, scaling, &passed);
            passed = next;
            let back = back(j);
            let entry = |r: usize, c: usize| {
                if c < 4 {
                    (0..4).map(|k| q[r][k] * back[c][k]).sum()
                } else {
                    q[r][c]
                }
            };
            fronts.push(std::array::from_fn(|r| {
                std::array::from_fn(|c| entry(r, c))
            }));
        }
        Self { fronts }
    }

    /// Numbers in `q`.
    pub fn coordinates(&self) -> usize {
        2 * (2 * self.fronts.len() + 1)
    }

    /// `q = Q2^T B^T f`.
    pub fn restrict(&self, f: &[Node], q: &mut [f64]) {
        let (q, _) = q.as_chunks_mut::<2>();
        let mut carry = [[0.0; 2]; 2];
        for (j, (front, f)) in self.fronts.iter().zip(f.as_chunks::<2>().0).enumerate() {
            let [[a, b], [c, d]] = *f;
            let x = [a, b, c, d, carry[0], carry[1]];
            let y: [[f64; 2]; 4] = std::array::from_fn(|r| {
                std::array::from_fn(|k| (0..6).map(|c| front[r][c] * x[c][k]).sum())
            });
            carry = [y[0], y[1]];
            if j == 0 {
                q[0] = y[2];
            } else {
                (q[2 * j - 1], q[2 * j]) = (y[2], y[3]);
            }
        }
        let last = q.len() - 2;
        q[last..].copy_from_slice(&carry);
    }

    /// `u = B Q2 q`.
    pub fn prolong(&self, q: &[f64], u: &mut [Node]) {
        let (q, _) = q.as_chunks::<2>();
        let last = q.len() - 2;
        let mut carry = [q[last], q[last + 1]];
        let elements = u.as_chunks_mut::<2>().0.iter_mut();
        for (j, (front, u)) in self.fronts.iter().zip(elements).enumerate().rev() {
            let free = match j {
                0 => [q[0], [0.0; 2]],
                _ => [q[2 * j - 1], q[2 * j]],
            };
            let y = [carry[0], carry[1], free[0], free[1]];
            let x: [[f64; 2]; 6] = std::array::from_fn(|c| {
                std::array::from_fn(|k| (0..4).map(|r| front[r][c] * y[r][k]).sum())
            });
            *u = [[x[0], x[1]], [x[2], x[3]]];
            carry = [x[4], x[5]];
        }
    }

    /// Bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.fronts[..])
    }
}

/// Rows of the orthogonal matrix of one front, and the rows of `R` that it passes on.
fn front(j: usize, count: usize, scaling: &Mass, passed: &[[f64; 2]; 2]) -> (Front, [[f64; 2]; 2]) {
    let (own, next) = rows(j, count);
    // Nothing is passed to the first front.
    let size = if j == 0 { 4 } else { 6 };
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for (index, row) in own.iter().chain(next).enumerate() {
        let of_element = |r: usize| (0..4).map(|k| scaling[r][k] * row[k]).sum::<f64>();
        let mut column: Vec<f64> = (0..4).map(of_element).collect();
        if j > 0 {
            let before = |r: usize| if index < 2 { passed[r][index] } else { 0.0 };
            column.extend([before(0), before(1)]);
        }
        columns.push(column);
    }
    let mut q: Vec<Vec<f64>> = (0..size)
        .map(|k| (0..size).map(|r| f64::from(u8::from(r == k))).collect())
        .collect();
    for k in 0..columns.len() {
        let mut v = columns[k][k..].to_vec();
        let (tau, _) = reflector(&mut v);
        for column in columns[k..].iter_mut().chain(&mut q) {
            reflect(&v, tau, &mut column[k..]);
        }
    }
    let kept = |r: usize, c: usize| {
        let column = if c < size { Some(&q[c]) } else { None };
        column.and_then(|column| column.get(own.len() + r).copied())
    };
    let kept = std::array::from_fn(|r| std::array::from_fn(|c| kept(r, c).unwrap_or(0.0)));
    let on = |r: usize, c: usize| {
        let column = columns.get(own.len() + c);
        column.map_or(0.0, |column| column[own.len() + r])
    };
    let passed = std::array::from_fn(|r| std::array::from_fn(|c| on(r, c)));
    (kept, passed)
}
