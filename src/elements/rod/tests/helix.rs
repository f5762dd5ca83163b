//! Strains of a rod wound to a helix.
//!
//! Source: the closed form of a helix with a frame that rotates evenly.

use super::*;

/// A helix of curvature 2 and torsion 1 whose sections rotate about the tangent by 0.8 1/m more, at two points.
fn helix(from: f64, length: f64) -> At<f64> {
    let (curvature, torsion, more) = (2.0, 1.0, 0.8);
    let rate = f64::hypot(curvature, torsion);
    let at = |s: f64| {
        let (sin, cos) = (rate * s).sin_cos();
        let (p, q) = (curvature / rate, torsion / rate);
        let r = V::new(p / rate * cos, p / rate * sin, q * s);
        let (t, n) = (V::new(-p * sin, p * cos, q), V::new(-cos, -sin, 0.0));
        let (sin, cos) = (more * s).sin_cos();
        (r, t, n * cos + t.cross(&n) * sin)
    };
    let [(ra, ta, da), (rb, tb, db)] = [from, from + length].map(at);
    At {
        e: [ra.into(), ta.into(), rb.into(), tb.into()],
        d: [da.into(), db.into()],
        bubble: 0.0,
    }
}

/// With the internal twist of least energy.
fn relaxed(rod: &Rod, at: &At<f64>) -> At<f64> {
    let mut at = *at;
    for _ in 0..8 {
        let fixed = |v: [f64; 3]| v.map(Jet::from_re);
        let energy = rod.energy(&At {
            e: at.e.map(fixed),
            d: at.d.map(fixed),
            bubble: Jet::new(at.bubble, 1.0, 0.0),
        });
        at.bubble -= energy.v1 / energy.v2;
    }
    at
}

#[test]
fn a_helix_has_its_strains() {
    let straight = bent(1, 0.0);
    // Torsion is uniform where the section is round, as it is in equilibrium: only there the internal twist is that of least
    // energy.
    for (parameters, relax) in [(GENERAL, false), (ROUND, true)] {
        let errors = [2, 4, 8, 16].map(|elements| {
            let length = 1.0 / f64::from(elements);
            let shape = At {
                e: straight.e.map(|v| v.map(|x| x * length)),
                ..straight
            };
            let rod = Rod::new(
                Parameters {
                    length,
                    ..parameters
                },
                &shape,
            );
            let mut errors = [-exact(&parameters), 0.0_f64];
            for element in 0..elements {
                let from = f64::from(element) * length;
                let mut at = helix(from, length);
                if relax {
                    at = relaxed(&rod, &at);
                }
                errors[0] += rod.energy(&at);
                for xi in [0.0, 0.5, 0.3] {
                    let angle = 0.8 * (from + xi * length);
                    let wanted = V::new(1.8, 2.0 * angle.sin(), 2.0 * angle.cos());
                    let miss = V::from(rod.strains(&at, xi)) - wanted;
                    errors[1] = errors[1].max(miss.norm());
                }
            }
            errors
        });
        // Those of the line's second derivative are of order 2 but for a few points; what they are in the energy cancels.
        for (part, order, last) in [(0, 4.0, 3e-6), (1, 2.0, 4e-3)] {
            assert!(errors[3][part].abs() < last, "{errors:?}");
            for pair in errors.windows(2) {
                let found = (pair[0][part] / pair[1][part]).log2();
                assert!((found - order).abs() < 0.15, "{errors:?}");
            }
        }
    }
}

/// Energy of a metre of that helix, J.
fn exact(parameters: &Parameters) -> f64 {
    let [c, ..] = parameters.stiffness;
    let rule = |s: f64| {
        let strains = V::new(1.8, 2.0 * (0.8 * s).sin(), 2.0 * (0.8 * s).cos());
        let stress = V::from(c.map(|row| V::from(row).dot(&strains)));
        0.5 * stress.dot(&strains)
    };
    let pieces = 200;
    let mut sum = 0.0;
    for k in 0..pieces {
        for p in &GAUSS_3 {
            sum += p.weight * rule((f64::from(k) + p.at) / f64::from(pieces));
        }
    }
    sum / f64::from(pieces)
}
