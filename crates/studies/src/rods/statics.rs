//! Equilibria of a clamped line under dead loads at its end, by Newton's method with load steps.

use nalgebra::{DMatrix, DVector};

/// What differences for the tangent are taken at.
const DIFFERENCE: f64 = 3e-6;
/// Corrections below this end Newton's method.
const SETTLED: f64 = 1e-9;
/// Iterations of a load step.
const MOST: usize = 60;

/// Nodes in a row with elements between them, and their energy about where they stand.
pub trait Line {
    /// Numbers that move a node, and those inside an element.
    const NODE: usize;
    const INTERNAL: usize;

    /// Number of elements.
    fn elements(&self) -> usize;
    /// Numbers that do not move.
    fn held(&self) -> Vec<usize>;
    /// Derivatives of the energy of an element by the numbers of its first node, of its last, and inside, at a step.
    fn slopes(&self, element: usize, step: &[f64]) -> Vec<f64>;
    /// Returns the generalized forces of a part of the load on the numbers of the last node, at a step of these.
    fn load(&self, part: f64, step: &[f64]) -> Vec<f64>;
    /// Moves.
    fn accept(&mut self, step: &[f64]);
}

/// Applies the load in equal parts, each to equilibrium.
///
/// # Errors
/// The first part that has no equilibrium.
pub fn equilibrium<L: Line>(line: &mut L, parts: u32) -> Result<(), u32> {
    (1..=parts).try_for_each(|part| {
        let value = f64::from(part) / f64::from(parts);
        newton(line, value).ok_or(part)
    })
}

fn newton<L: Line>(line: &mut L, part: f64) -> Option<()> {
    for _ in 0..MOST {
        let (tangent, residual) = assembled(line, part);
        let step = tangent.lu().solve(&residual)?;
        if !step.iter().all(|x| x.is_finite()) {
            return None;
        }
        line.accept(step.as_slice());
        if step.amax() < SETTLED {
            return Some(());
        }
    }
    None
}

/// Derivative of what is missing, and what is missing.
fn assembled<L: Line>(line: &L, part: f64) -> (DMatrix<f64>, DVector<f64>) {
    let elements = line.elements();
    let nodes = L::NODE * (elements + 1);
    let n = nodes + L::INTERNAL * elements;
    let (mut tangent, mut missing) = (DMatrix::zeros(n, n), DVector::zeros(n));
    for element in 0..elements {
        let index = |k: usize| {
            if k < 2 * L::NODE {
                L::NODE * element + k
            } else {
                nodes + L::INTERNAL * element + k - 2 * L::NODE
            }
        };
        let size = 2 * L::NODE + L::INTERNAL;
        let (own, columns) = differences(size, |step| line.slopes(element, step));
        for r in 0..size {
            missing[index(r)] -= own[r];
            for c in 0..size {
                tangent[(index(r), index(c))] += columns[c][r];
            }
        }
    }
    let first = nodes - L::NODE;
    let (own, columns) = differences(L::NODE, |step| line.load(part, step));
    for r in 0..L::NODE {
        missing[first + r] += own[r];
        for c in 0..L::NODE {
            tangent[(first + r, first + c)] -= columns[c][r];
        }
    }
    for k in line.held() {
        tangent.row_mut(k).fill(0.0);
        tangent.column_mut(k).fill(0.0);
        tangent[(k, k)] = 1.0;
        missing[k] = 0.0;
    }
    (tangent, missing)
}

/// Values where nothing moves, and their derivatives by every number.
fn differences(size: usize, values: impl Fn(&[f64]) -> Vec<f64>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut step = vec![0.0; size];
    let own = values(&step);
    let columns = (0..size).map(|k| {
        step[k] = DIFFERENCE;
        let ahead = values(&step);
        step[k] = -DIFFERENCE;
        let behind = values(&step);
        step[k] = 0.0;
        let slope = |(a, b): (&f64, &f64)| (a - b) / (2.0 * DIFFERENCE);
        ahead.iter().zip(&behind).map(slope).collect()
    });
    let columns = columns.collect();
    (own, columns)
}
