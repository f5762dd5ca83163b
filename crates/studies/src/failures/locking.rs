//! Membrane locking, on a cantilever of its own: the product's cable chooses its quadrature itself.

use nalgebra::Vector2;
use serde_json::json;

use super::support::{Product, Row, figure, json, newton, short};
use crate::scene::Outcome;

const ELASTIC: &str = include_str!("../../../../tests/cases/elastica/scene.json");

/// Slenderness EA L^2 / EI of the cantilever that locks.
const SLENDERNESS: f64 = 1e8;
/// Tip of the inextensible elastica at F L^2 / EI = 10 (elliptic integrals, case `elastica`).
const ELASTICA: [f64; 2] = [0.445_004_402_246_248_7, 0.810_609_024_880_296_5];

/// Residual of a cantilever along x of unit length and bending stiffness, clamped at its start, under a
/// force across its tip; axial strain at Gauss points.
fn residual(axial: &[[f64; 2]], free: &[f64], force: f64, r: &mut [f64]) {
    let elements = free.len() / 4;
    let length = 1.0 / elements as f64;
    let node = |i: usize| match i {
        0 => [Vector2::zeros(), Vector2::x()],
        _ => {
            let c = &free[4 * (i - 1)..4 * i];
            // Columns of the clamped start are left out: position first.
            [Vector2::new(c[0], c[1]), Vector2::new(c[2], c[3])]
        }
    };
    r.fill(0.0);
    let third = (1.0_f64 / 3.0).sqrt() / 2.0;
    for j in 0..elements {
        let ([p, s], [q, t]) = (node(j), node(j + 1));
        let mut add = |at: f64, by_u: Vector2<f64>, by_w: Vector2<f64>| {
            let slope = [
                6.0 * (at * at - at) / length,
                1.0 - 4.0 * at + 3.0 * at * at,
                6.0 * (at - at * at) / length,
                3.0 * at * at - 2.0 * at,
            ];
            let curvature = [
                (12.0 * at - 6.0) / (length * length),
                (6.0 * at - 4.0) / length,
                (6.0 - 12.0 * at) / (length * length),
                (6.0 * at - 2.0) / length,
            ];
            for (k, (a, b)) in slope.iter().zip(curvature).enumerate() {
                let part = by_u * *a + by_w * b;
                if let Some(first) = (4 * j + 2 * k).checked_sub(4) {
                    r[first] -= part.x;
                    r[first + 1] -= part.y;
                }
            }
        };
        let derivatives = |at: f64| {
            let chord = (q - p) / length;
            let u = chord * (6.0 * (at - at * at))
                + s * (1.0 - 4.0 * at + 3.0 * at * at)
                + t * (3.0 * at * at - 2.0 * at);
            let w = chord * (6.0 - 12.0 * at) + s * (6.0 * at - 4.0) + t * (6.0 * at - 2.0);
            (u, w / length)
        };
        for [at, weight] in axial {
            let (u, _) = derivatives(*at);
            let force = SLENDERNESS * (u.norm() - 1.0) * weight * length;
            add(*at, u.normalize() * force, Vector2::zeros());
        }
        for at in [0.5 - third, 0.5 + third] {
            let (u, w) = derivatives(at);
            let square = u.norm_squared();
            let bend = (u.x * w.y - u.y * w.x) / square;
            let moment = bend * 0.5 * length / square;
            let by_u = Vector2::new(w.y, -w.x) - u * (2.0 * bend);
            add(at, by_u * moment, Vector2::new(-u.y, u.x) * moment);
        }
    }
    let n = r.len();
    r[n - 3] += force;
}

/// Gauss points for axial strain: full integration, and those of Lobatto that the product takes.
const FULL: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_7, 0.173_927_422_568_727],
    [0.330_009_478_207_571_9, 0.326_072_577_431_273],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273],
    [0.930_568_155_797_026_3, 0.173_927_422_568_727],
];
const ELEMENTS: usize = 16;

/// Tip of the cantilever under ten times EI/L^2, the load put on in parts; `Err` with the part that
/// failed.
fn cantilever(axial: &[[f64; 2]], parts: u32) -> Result<[f64; 2], u32> {
    let node = |i: usize| [(i + 1) as f64 / ELEMENTS as f64, 0.0, 1.0, 0.0];
    let mut free: Vec<f64> = (0..ELEMENTS).flat_map(node).collect();
    for part in 1..=parts {
        let force = 10.0 * f64::from(part) / f64::from(parts);
        let solved = newton(&mut free, 1.0, 100, |x, r| residual(axial, x, force, r));
        solved.map_err(|()| part)?;
    }
    let n = free.len();
    Ok([free[n - 4], free[n - 3]])
}

fn off(tip: [f64; 2]) -> f64 {
    (tip[0] - ELASTICA[0]).hypot(tip[1] - ELASTICA[1])
}

/// Membrane locking.
pub fn locking() -> Outcome<Row> {
    let tip = cantilever(&FULL, 40).map_err(|part| format!("no equilibrium at part {part}"))?;
    let mut scene = json(ELASTIC)?;
    scene["bodies"][0]["elements"] = json!(ELEMENTS);
    scene["inputs"][0]["start"] = json!([0.0, 10.0]);
    let found = off(Product::start(&scene)?.position("rod.tip")?);
    Ok(Row {
        place: "Slender curved elements",
        method: "axial strain fully integrated (4 Gauss points), 16 elements, EA L^2/EI = 1e8"
            .into(),
        failing: figure(
            off(tip),
            format!("locks: tip {} L from the elastica", short(off(tip))),
        ),
        product: figure(found, format!("tip {} L from the elastica", short(found))),
        test: "full_integration_locks",
    })
}

#[test]
fn full_integration_locks() {
    let row = locking().expect("a row");
    assert!(row.failing.value > 5e-4, "{}", row.failing.text);
    assert!(row.product.value < 2e-5, "{}", row.product.text);
}
