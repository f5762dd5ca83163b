//! Rigid links pinned to each other in long chains and loops, against Lagrange's equations in their angles: as many
//! links as are eliminated together, and many more, whose pins keep multipliers.

use nalgebra::{DMatrix, DVector, Vector2};

use flexbody::system::DrivenSystem;

use crate::laws::closed::{bodies, ground, hold, on, rigid, started};
use crate::laws::mechanism::{Kind, Mechanism};

const LENGTH: f64 = 0.7;
const MASS: f64 = 1.3;
const INERTIA: f64 = 0.09;
const GRAVITY: f64 = 9.81;

fn angle(i: usize) -> f64 {
    0.9 * (1.7 * i as f64).sin() + 0.3 * (0.41 * i as f64).cos()
}

/// A chain from the origin on, and where it ends.
fn chain(count: usize) -> (Mechanism, [f64; 2]) {
    let (mut parts, mut end) = (Vec::new(), [0.0, 0.0]);
    for i in 0..count {
        let (sin, cos) = angle(i).sin_cos();
        let way = [LENGTH * cos, LENGTH * sin];
        let center = [end[0] + 0.5 * way[0], end[1] + 0.5 * way[1]];
        parts.push((rigid(MASS, INERTIA), [center[0], center[1], angle(i)]));
        end = [end[0] + way[0], end[1] + way[1]];
    }
    let mut made = bodies(&parts);
    made.gravity = Vector2::new(0.0, -GRAVITY);
    for i in 0..count {
        let first = match i {
            0 => ground(0.0, 0.0),
            _ => on(i - 1, 0.5 * LENGTH, 0.0),
        };
        let second = on(i, -0.5 * LENGTH, 0.0);
        made.holds.push(hold(Kind::Revolute, first, second));
    }
    (made, end)
}

/// Angular accelerations; with both ends pinned, or one.
fn lagrange(angles: &[f64], rates: &[f64], is_closed: bool) -> DVector<f64> {
    let n = angles.len();
    let rows = if is_closed { 2 } else { 0 };
    let (mut a, mut b) = (DMatrix::zeros(n + rows, n + rows), DVector::zeros(n + rows));
    for i in 0..n {
        for j in 0..n {
            let beyond = (n - 1 - i.max(j)) as f64;
            let coupling = if i == j {
                INERTIA + MASS * LENGTH * LENGTH * (0.25 + beyond)
            } else {
                MASS * LENGTH * LENGTH * (0.5 + beyond)
            };
            let (sin, cos) = (angles[i] - angles[j]).sin_cos();
            a[(i, j)] = coupling * cos;
            b[i] -= coupling * sin * rates[j] * rates[j];
        }
        b[i] -= GRAVITY * MASS * LENGTH * ((n - 1 - i) as f64 + 0.5) * angles[i].cos();
    }
    if is_closed {
        for i in 0..n {
            let (sin, cos) = angles[i].sin_cos();
            for (row, way, bias) in [(n, -sin, cos), (n + 1, cos, sin)] {
                a[(row, i)] = LENGTH * way;
                a[(i, row)] = LENGTH * way;
                b[row] += LENGTH * bias * rates[i] * rates[i];
            }
        }
    }
    a.lu().solve(&b).expect("regular").rows(0, n).into_owned()
}

/// Moves a chain at random and compares its angular accelerations.
fn compare(count: usize, is_closed: bool) {
    let (mut mechanism, end) = chain(count);
    if is_closed {
        let last = on(count - 1, 0.5 * LENGTH, 0.0);
        let pin = hold(Kind::Revolute, ground(end[0], end[1]), last);
        mechanism.holds.push(pin);
    }
    let mut moving = started(&mechanism);
    for (i, rate) in moving.state.rates.iter_mut().enumerate() {
        *rate = (2.3 * i as f64).cos();
    }
    let mut model = DrivenSystem::new(&moving.system, &[], &mut moving.work, &moving.state);
    assert!(model.project(&mut moving.state));
    let values = moving.evaluated();
    let residuals = values.residuals(&moving.system);
    assert!(
        residuals[0] < 1e-13 && residuals[1] < 1e-12,
        "{residuals:?}"
    );
    let turned = |a: &[f64; 2], b: &[f64; 2]| a[0] * b[1] - a[1] * b[0];
    let angles: Vec<f64> = values.x.iter().map(|[_, u]| u[1].atan2(u[0])).collect();
    let rates = values.x.iter().zip(&values.v);
    let rates: Vec<f64> = rates.map(|(x, v)| turned(&x[1], &v[1])).collect();
    let expected = lagrange(&angles, &rates, is_closed);
    let nodes = values.x.iter().zip(&values.acceleration);
    for (i, (x, a)) in nodes.enumerate() {
        let off = turned(&x[1], &a[1]) - expected[i];
        assert!(
            off.abs() < 1e-10 * (1.0 + expected.amax()),
            "link {i} of {count}, closed {is_closed}: {off}"
        );
    }
}

#[test]
fn links_follow_lagrange() {
    for count in [3, 8, 9, 40, 150] {
        compare(count, false);
        compare(count, true);
    }
}
