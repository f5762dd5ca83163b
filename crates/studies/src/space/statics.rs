//! Equilibrium of a cantilever by Newton's method, its loads applied in equal parts.

use crate::elements::band::Band;
use crate::elements::rod::{Rod, Vector};

/// Iterations a load may take.
const ITERATIONS: usize = 60;
/// Parts of the loads, one after the other.
const PARTS: usize = 20;
/// Newton's correction, relative to the length, at which an equilibrium is found.
const SMALL: f64 = 1e-12;

/// Loads on a cantilever.
#[derive(Clone, Copy, Debug, Default)]
pub struct Loads {
    /// Dead force on the tip, N.
    pub force: Vector,
    /// Moment on the tip, N m.
    pub moment: f64,
    /// Dead force per reference length, N/m.
    pub weight: Vector,
}

/// Coordinates held by the clamp: position of the start, and its slope across the rod.
pub const HELD: [usize; 3] = [0, 1, 3];

/// Coordinates in equilibrium of a rod along the first axis that is clamped at its start; nothing where
/// Newton's method does not settle.
pub fn cantilever<const F: usize>(rod: &Rod<F>, loads: &Loads) -> Option<Vec<Vector>> {
    let mut c = rod.fit(|s| [s, 0.0]);
    let weight = rod.loads(|_| loads.weight);
    let mut stiffness = Band::zeros(2 * c.len(), 2 * F - 1);
    for part in 1..=PARTS {
        let scale = part as f64 / PARTS as f64;
        let settled = (0..ITERATIONS).any(|_| {
            let step = correction(rod, loads, &weight, scale, &c, &mut stiffness);
            for (c, d) in c.iter_mut().zip(&step) {
                c[0] += d[0];
                c[1] += d[1];
            }
            let [x, y] = rod.vector(&step, rod.elements() - 1, 1.0, 0);
            x.hypot(y) < SMALL
        });
        if !settled && part == PARTS {
            return None;
        }
    }
    Some(c)
}

/// Newton's correction at a part of the loads.
fn correction<const F: usize>(
    rod: &Rod<F>,
    loads: &Loads,
    weight: &[Vector],
    scale: f64,
    c: &[Vector],
    stiffness: &mut Band,
) -> Vec<Vector> {
    let mut residual: Vec<Vector> = weight.iter().map(|w| w.map(|w| scale * w)).collect();
    rod.add_force(c, &mut residual);
    stiffness.clear();
    rod.add_stiffness(c, stiffness);
    let tip = rod.end();
    residual[tip][0] += scale * loads.force[0];
    residual[tip][1] += scale * loads.force[1];
    turn(rod, scale * loads.moment, c, &mut residual, stiffness);
    let mut flat: Vec<f64> = residual.iter().flatten().copied().collect();
    for held in HELD {
        flat[held] = 0.0;
        stiffness.hold(held);
    }
    stiffness.factor();
    stiffness.solve_any(&mut flat);
    flat.chunks(2).map(|d| [d[0], d[1]]).collect()
}

/// Adds a moment on the tip: its work is moment times the angle of the slope there.
fn turn<const F: usize>(
    rod: &Rod<F>,
    moment: f64,
    c: &[Vector],
    force: &mut [Vector],
    stiffness: &mut Band,
) {
    if moment == 0.0 {
        return;
    }
    let last = rod.elements() - 1;
    let (first, jets) = rod.jets(last, 1.0);
    let u = rod.vector(c, last, 1.0, 1);
    let inverse = 1.0 / (u[0] * u[0] + u[1] * u[1]);
    let m = moment * inverse;
    // Second derivatives of the angle of u.
    let (mixed, same) = (
        (u[1] * u[1] - u[0] * u[0]) * inverse,
        2.0 * u[0] * u[1] * inverse,
    );
    let hessian = [[same, mixed], [mixed, -same]];
    for i in 0..F {
        force[first + i][0] -= m * u[1] * jets[i][1];
        force[first + i][1] += m * u[0] * jets[i][1];
        for j in 0..=i {
            for a in 0..2 {
                for b in 0..2 {
                    let (row, column) = (2 * (first + i) + a, 2 * (first + j) + b);
                    if column <= row {
                        *stiffness.at(row, column) -= m * hessian[a][b] * jets[i][1] * jets[j][1];
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::rod::Material;
    use crate::space::discretization::Discretization;

    /// Distance of the tip under `F L^2 / EI = 5` from the solution by elliptic integrals with stretch.
    fn elastica<const F: usize>(element: Discretization, elements: usize, axial: f64) -> f64 {
        let exact = match axial {
            1e2 => [0.6213411565388267, 0.7495047555130362],
            1e4 => [0.6124620138924823, 0.7141456703386245],
            1e8 => [0.6123716483137145, 0.7137915590234712],
            _ => panic!("no solution at hand for EA L^2/EI = {axial}"),
        };
        let material = Material {
            axial,
            bending: 1.0,
            density: 1.0,
        };
        let rod = Rod::<F>::new(material, element.mesh(&material, 1.0, elements));
        let loads = Loads {
            force: [0.0, 5.0],
            ..Loads::default()
        };
        let c = cantilever(&rod, &loads).expect("an equilibrium");
        let tip = rod.vector(&c, elements - 1, 1.0, 0);
        (tip[0] - exact[0]).hypot(tip[1] - exact[1])
    }

    #[test]
    fn cubic_elements_converge_with_order_4_and_do_not_lock() {
        for element in [Discretization::Cubic, Discretization::CubicMassBending] {
            let [a, b] = [8, 16].map(|n| elastica::<4>(element, n, 1e8));
            assert!((a / b).log2() > 3.7 && b < 6e-6, "{a} {b}");
        }
        let [two, three] = [Discretization::CubicMass, Discretization::CubicMassBending]
            .map(|element| elastica::<4>(element, 8, 1e8));
        assert!(three < two / 4.0, "{three} {two}");
    }

    #[test]
    fn quintic_elements_converge_with_order_8_and_do_not_lock() {
        let [a, b] = [4, 8].map(|n| elastica::<6>(Discretization::Quintic, n, 1e4));
        assert!((a / b).log2() > 7.0, "{a} {b}");
        let slender = elastica::<6>(Discretization::Quintic, 4, 1e8);
        assert!(slender < 3e-6, "{slender}");
    }

    #[test]
    fn splines_converge_where_they_are_not_slender() {
        let [a, b] = [8, 16].map(|n| elastica::<5>(Discretization::Spline4, n, 1e2));
        assert!((a / b).log2() > 5.0, "{a} {b}");
        let [a, b] = [8, 16].map(|n| elastica::<4>(Discretization::Spline3, n, 1e2));
        assert!((a / b).log2() > 3.7, "{a} {b}");
    }

    #[test]
    fn a_moment_rolls_the_rod_up() {
        let material = Material {
            axial: 1e4,
            bending: 1.0,
            density: 1.0,
        };
        let mesh = Discretization::Quintic.mesh(&material, 1.0, 8);
        let rod = Rod::<6>::new(material, mesh);
        let loads = Loads {
            moment: std::f64::consts::PI,
            ..Loads::default()
        };
        let c = cantilever(&rod, &loads).expect("an equilibrium");
        let [x, y] = rod.vector(&c, 7, 1.0, 0);
        assert!(x.hypot(y - 2.0 / std::f64::consts::PI) < 1e-8, "{x} {y}");
    }
}
