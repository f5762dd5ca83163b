//! Laws that hold for a rod in any shape functions.

use super::band::Band;
use super::basis::{Basis, MOST, graded};
use super::rod::{Material, Mesh, Rod, Rules, Vector};
use super::rule::Rule;

const MATERIAL: Material = Material {
    axial: 30.0,
    bending: 0.7,
    density: 1.3,
};
const LENGTH: f64 = 1.7;

fn mesh(basis: Basis) -> Mesh {
    let mut extra = [0.0; MOST];
    extra[2] = 1.0;
    extra[3] = 8.0;
    Mesh {
        basis,
        breaks: graded(LENGTH, 5, 0.8),
        rules: Rules {
            axial: Rule::Lobatto(4),
            bending: Rule::Gauss(3),
            extra,
        },
    }
}

/// Calls a law with a rod of every kind of shape functions.
macro_rules! for_all {
    ($law:ident) => {
        $law(&Rod::<4>::new(MATERIAL, mesh(Basis::Hermite(2))));
        $law(&Rod::<6>::new(MATERIAL, mesh(Basis::Hermite(3))));
        for (degree, continuity) in [(3, 1), (3, 2)] {
            let basis = Basis::Spline { degree, continuity };
            $law(&Rod::<4>::new(MATERIAL, mesh(basis)));
        }
        for (degree, continuity) in [(4, 1), (4, 2), (4, 3)] {
            let basis = Basis::Spline { degree, continuity };
            $law(&Rod::<5>::new(MATERIAL, mesh(basis)));
        }
    };
}

/// A stretched arc that wobbles.
fn bent<const F: usize>(rod: &Rod<F>) -> Vec<Vector> {
    rod.fit(|s| [1.1 * s.sin() + 0.02 * (5.0 * s).sin(), 1.2 - 1.2 * s.cos()])
}

fn forces<const F: usize>(rod: &Rod<F>, c: &[Vector]) -> Vec<Vector> {
    let mut f = vec![[0.0; 2]; c.len()];
    rod.add_force(c, &mut f);
    f
}

fn force_is_the_gradient_of_the_energy<const F: usize>(rod: &Rod<F>) {
    let c = bent(rod);
    let f = forces(rod, &c);
    let h = 1e-6;
    for i in 0..c.len() {
        for a in 0..2 {
            let energy = |step: f64| {
                let mut moved = c.clone();
                moved[i][a] += step;
                rod.energy(&moved)
            };
            let gradient = (energy(h) - energy(-h)) / (2.0 * h);
            let scale = 1.0 + f[i][a].abs();
            assert!((f[i][a] + gradient).abs() < 1e-6 * scale, "{i} {a}");
        }
    }
}

fn stiffness_is_the_gradient_of_the_force<const F: usize>(rod: &Rod<F>) {
    let c = bent(rod);
    let mut stiffness = Band::zeros(2 * c.len(), 2 * F - 1);
    rod.add_stiffness(&c, &mut stiffness);
    let h = 1e-6;
    for column in 0..2 * c.len() {
        let shifted = |step: f64| {
            let mut moved = c.clone();
            moved[column / 2][column % 2] += step;
            forces(rod, &moved)
        };
        let (ahead, behind) = (shifted(h), shifted(-h));
        for row in column..(column + 2 * F).min(2 * c.len()) {
            let (i, a) = (row / 2, row % 2);
            let slope = (behind[i][a] - ahead[i][a]) / (2.0 * h);
            let found = *stiffness.at(row, column);
            assert!((slope - found).abs() < 1e-5 * (1.0 + found.abs()));
        }
    }
}

fn rigid_motion_makes_no_force<const F: usize>(rod: &Rod<F>) {
    let (sin, cos) = 0.7_f64.sin_cos();
    let turned = rod.fit(|s| [3.0 + cos * s, -2.0 + sin * s]);
    assert!(rod.energy(&turned) < 1e-18);
    assert!(
        forces(rod, &turned)
            .iter()
            .flatten()
            .all(|f| f.abs() < 1e-8)
    );
    let c = bent(rod);
    let moved: Vec<Vector> = rod.fit(|s| {
        let [x, y] = [1.1 * s.sin() + 0.02 * (5.0 * s).sin(), 1.2 - 1.2 * s.cos()];
        [3.0 + cos * x - sin * y, -2.0 + sin * x + cos * y]
    });
    assert!((rod.energy(&moved) / rod.energy(&c) - 1.0).abs() < 1e-9);
}

/// Kinetic energy of a straight rod that moves and rotates, whatever the extra mass.
fn inertia_of_rigid_motion_is_exact<const F: usize>(rod: &Rod<F>) {
    let mass = rod.mass();
    let v = rod.fit(|s| [0.3, 2.0 + 5.0 * s]);
    let mut momentum = v.clone();
    mass.multiply(&v, &mut momentum);
    let twice: f64 = v
        .iter()
        .zip(&momentum)
        .map(|(v, p)| v[0] * p[0] + v[1] * p[1])
        .sum();
    let l = LENGTH;
    let across = 4.0 * l + 10.0 * l * l + 25.0 * l.powi(3) / 3.0;
    let exact = MATERIAL.density * (0.09 * l + across);
    assert!((twice / exact - 1.0).abs() < 1e-11);
}

fn stretch_is_a_patch<const F: usize>(rod: &Rod<F>) {
    let c = rod.fit(|s| [1.1 * s, 0.0]);
    let exact = 0.5 * MATERIAL.axial * 0.01 * LENGTH;
    assert!((rod.energy(&c) / exact - 1.0).abs() < 1e-10);
    let f = forces(rod, &c);
    let pull = 0.1 * MATERIAL.axial;
    assert!((f[0][0] - pull).abs() < 1e-6 && (f[rod.end()][0] + pull).abs() < 1e-6);
}

#[test]
fn laws_hold_in_all_shape_functions() {
    for_all!(force_is_the_gradient_of_the_energy);
    for_all!(stiffness_is_the_gradient_of_the_force);
    for_all!(rigid_motion_makes_no_force);
    for_all!(inertia_of_rigid_motion_is_exact);
    for_all!(stretch_is_a_patch);
}

/// Position and rate of slope of a rod fitted to a curve, inside an element.
fn fitted<const F: usize>(basis: Basis) -> [Vector; 2] {
    let rod = Rod::<F>::new(MATERIAL, mesh(basis));
    let c = rod.fit(|s| [(2.0 * s).sin(), (3.0 * s).cos()]);
    [0, 2].map(|derivative| rod.vector(&c, 2, 0.37, derivative))
}

#[test]
fn splines_of_low_continuity_span_what_hermite_polynomials_span() {
    let spline = |degree, continuity| Basis::Spline { degree, continuity };
    let pairs = [
        (fitted::<4>(Basis::Hermite(2)), fitted::<4>(spline(3, 1))),
        (fitted::<6>(Basis::Hermite(3)), fitted::<6>(spline(5, 2))),
    ];
    for (a, b) in pairs {
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }
}

#[test]
fn rules_are_exact_to_their_degree_and_no_further() {
    let all = [
        (Rule::Gauss(1), 1),
        (Rule::Gauss(4), 7),
        (Rule::Gauss(6), 11),
        (Rule::Lobatto(2), 1),
        (Rule::Lobatto(3), 3),
        (Rule::Lobatto(5), 7),
        (Rule::Three(0.9), 3),
    ];
    for (rule, degree) in all {
        let error = |power: i32| {
            let points = rule.points();
            let sum: f64 = points.iter().map(|p| p.weight * p.at.powi(power)).sum();
            (sum - 1.0 / f64::from(power + 1)).abs()
        };
        assert!((0..=degree).all(|power| error(power) < 1e-14), "{rule:?}");
        assert!(error(degree + 1) > 1e-8, "{rule:?}");
    }
}
