//! Equilibria of clamped chains of rods, with the stretching of cables on the same line, against other programs' solutions.
//!
//! Source: closed form of a helix under a dead end moment (uniform curvature and torsion); the others by shooting with a method of
//! order 8, residuals 1e-13.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};

use super::tests::{moved, section};
use super::*;
use crate::elements::cable::{self, Cable, Inertia, LineOf};
use crate::elements::{Element, Nodal, StrainMeasure};

type V = Vector3<f64>;

/// Load at the tip: a dead force (N) and a dead moment (N m).
#[derive(Clone, Copy)]
struct Load {
    force: V,
    moment: V,
}

struct Chain {
    rods: Vec<Rod>,
    cables: Vec<Cable<3>>,
    /// Position, slope and `d` of every station.
    stations: Vec<[[f64; 3]; 3]>,
    bubbles: Vec<f64>,
}

/// Returns the places of an element's velocities among those of a chain: seven a station, then the internal twists.
fn place(element: usize, elements: usize) -> [usize; VELOCITIES] {
    std::array::from_fn(|k| match k {
        14 => 7 * (elements + 1) + element,
        _ => 7 * element + k,
    })
}

impl Chain {
    /// A chain whose stations are at these places when nothing acts.
    fn new(
        elements: usize,
        length: f64,
        stiffness: [[f64; 3]; 3],
        axial_stiffness: f64,
        at: impl Fn(f64) -> [V; 3],
    ) -> Self {
        let l = length / elements as f64;
        let stations: Vec<_> = (0..=elements)
            .map(|k| at(k as f64 * l).map(<[f64; 3]>::from))
            .collect();
        let parameters = Parameters {
            length: l,
            stiffness: [stiffness; 3],
            damping_times: [0.0; 3],
            axial: None,
        };
        let stretching = cable::Parameters {
            length: l,
            axial_stiffness,
            bending_stiffness: 0.0,
            line_of: LineOf::Cable,
            line_density: 1.0,
            axial_damping_time: 0.0,
            bending_damping_time: 0.0,
            strain: StrainMeasure::ThetaPrime,
            inertia: Inertia::Consistent,
        };
        let mut chain = Self {
            rods: Vec::new(),
            cables: Vec::new(),
            stations,
            bubbles: vec![0.0; elements],
        };
        for k in 0..elements {
            let shape = chain.at(k);
            chain.rods.push(Rod::new(parameters, &shape));
            chain
                .cables
                .push(Cable::new(stretching, Some(&Nodal::from(shape.e))));
        }
        chain
    }

    fn at(&self, k: usize) -> At<f64> {
        let [a, b] = [&self.stations[k], &self.stations[k + 1]];
        At {
            e: [a[0], a[1], b[0], b[1]],
            d: [a[2], b[2]],
            bubble: self.bubbles[k],
        }
    }

    /// Sum of all forces, and minus its derivative.
    fn balance(&self, load: Load) -> (DVector<f64>, DMatrix<f64>) {
        let elements = self.rods.len();
        let size = 7 * (elements + 1) + elements;
        let (mut force, mut tangent) = (DVector::zeros(size), DMatrix::zeros(size, size));
        for k in 0..elements {
            let (at, places) = (self.at(k), place(k, elements));
            let e = Nodal::<3>::from(at.e);
            let axial = self.cables[k].force(&e, &Nodal::zeros());
            let blocks = self.cables[k].stiffness(&e, &Nodal::zeros());
            let (bent, matrix) = (
                self.rods[k].force(&at, None).0.flat(),
                self.rods[k].stiffness(&at, None),
            );
            for i in 0..VELOCITIES {
                force[places[i]] += bent[i];
                for j in 0..VELOCITIES {
                    tangent[(places[i], places[j])] += matrix[i][j];
                }
            }
            let start = |block: usize| places[7 * (block / 2) + 3 * (block % 2)];
            for (p, q) in (0..16).map(|n| (n / 4, n % 4)) {
                let mut part = tangent.fixed_view_mut::<3, 3>(start(p), start(q));
                part += blocks[p][q];
                if q == 0 {
                    let mut part = force.fixed_rows_mut::<3>(start(p));
                    part += axial.column(p);
                }
            }
        }
        self.add_load(load, &mut force, &mut tangent);
        (force, tangent)
    }

    fn add_load(&self, load: Load, force: &mut DVector<f64>, tangent: &mut DMatrix<f64>) {
        let tip = 7 * self.rods.len();
        let (u, m) = (V::from(self.stations[self.rods.len()][1]), load.moment);
        let (square, t) = (u.norm_squared(), u.normalize());
        let on_slope = m.cross(&u) / square;
        let mut part = force.fixed_rows_mut::<3>(tip);
        part += load.force;
        let mut part = force.fixed_rows_mut::<3>(tip + 3);
        part += on_slope;
        force[tip + 6] += m.dot(&t);
        let change = m.cross_matrix() / square - on_slope * u.transpose() * (2.0 / square);
        // The frame rotates about the tangent as slopes change one after the other: half of it for either.
        let skew = t.cross_matrix() * (0.5 * m.dot(&t) / square);
        let mut part = tangent.fixed_view_mut::<3, 3>(tip + 3, tip + 3);
        part -= change - skew;
        let across = (m - t * m.dot(&t)) / square.sqrt();
        let mut part = tangent.fixed_view_mut::<1, 3>(tip + 6, tip + 3);
        part -= across.transpose();
    }

    /// Newton's method with the first station clamped but for its stretch; the number of iterations.
    fn settle(&mut self, load: Load) -> usize {
        let elements = self.rods.len();
        let along = V::from(self.stations[0][1]).normalize();
        for iteration in 0..100 {
            let (mut force, mut tangent) = self.balance(load);
            let (held, free) = (
                Matrix3::identity() - along * along.transpose(),
                along * along.transpose(),
            );
            for (start, free) in [(0, Matrix3::zeros()), (3, free)] {
                let rows = free * tangent.fixed_rows::<3>(start);
                tangent.fixed_rows_mut::<3>(start).copy_from(&rows);
                let columns = tangent.fixed_columns::<3>(start) * free;
                tangent.fixed_columns_mut::<3>(start).copy_from(&columns);
                let part = free * force.fixed_rows::<3>(start);
                force.fixed_rows_mut::<3>(start).copy_from(&part);
                let mut block = tangent.fixed_view_mut::<3, 3>(start, start);
                block += if start == 0 {
                    Matrix3::identity()
                } else {
                    held
                };
            }
            tangent.row_mut(6).fill(0.0);
            tangent.column_mut(6).fill(0.0);
            (tangent[(6, 6)], force[6]) = (1.0, 0.0);
            let step = tangent.lu().solve(&force).expect("a regular tangent");
            self.advance(&step, elements);
            if step.amax() < 1e-9 {
                return iteration;
            }
        }
        panic!("no equilibrium");
    }

    fn advance(&mut self, step: &DVector<f64>, elements: usize) {
        for k in 0..=elements {
            let part = |from: usize| std::array::from_fn(|i| step[7 * k + from + i]);
            let rates = Rates {
                e: [part(0), part(3), [0.0; 3], [0.0; 3]],
                spin: [step[7 * k + 6], 0.0],
                bubble: 0.0,
            };
            let [r, u, d] = self.stations[k];
            let at = At {
                e: [r, u, r, u],
                d: [d, d],
                bubble: 0.0,
            };
            let at = moved(&at, &rates, 1.0);
            self.stations[k] = [at.e[0], at.e[1], at.d[0]];
        }
        for k in 0..elements {
            self.bubbles[k] += step[7 * (elements + 1) + k];
        }
    }
}

/// Steps in which a load grows.
const STEPS: u32 = 4;

/// Errors of the tip with 4, 8 and 16 elements, m, and iterations of each.
struct Convergence {
    errors: [f64; 3],
    iterations: [usize; 3],
}

/// Loads chains of 4, 8 and 16 elements, whose tip is to be there.
fn errors(make: impl Fn(usize) -> Chain, load: Load, tip: V) -> Convergence {
    let mut all = [0; 3];
    let errors = [0, 1, 2].map(|mesh| {
        let elements = 4 << mesh;
        let mut chain = make(elements);
        for step in 1..=STEPS {
            let share = f64::from(step) / f64::from(STEPS);
            all[mesh] += chain.settle(Load {
                force: load.force * share,
                moment: load.moment * share,
            });
        }
        (V::from(chain.stations[elements][0]) - tip).norm()
    });
    Convergence {
        errors,
        iterations: all,
    }
}

/// Errors are those of another program of the same equations, fall with the fourth power, and Newton's method converges at all
/// meshes alike.
fn check(name: &str, found: Convergence, expected: [f64; 3]) {
    let Convergence { errors, iterations } = found;
    for (error, expected) in errors.iter().zip(expected) {
        assert!((error / expected - 1.0).abs() < 0.05, "{name}: {errors:?}");
    }
    assert!((errors[1] / errors[2]).log2() > 3.9, "{name}: {errors:?}");
    let [fewest, largest] = [iterations.iter().min(), iterations.iter().max()];
    assert!(largest <= Some(&36), "{name}: {iterations:?} iterations");
    assert!(
        largest <= fewest.map(|fewest| fewest + 3).as_ref(),
        "{name}: {iterations:?} iterations"
    );
}

fn straight(s: f64) -> [V; 3] {
    [V::x() * s, V::x(), V::y()]
}

fn section_of(torsion: f64, first: f64, second: f64) -> [[f64; 3]; 3] {
    [[torsion, 0.0, 0.0], [0.0, first, 0.0], [0.0, 0.0, second]]
}

#[test]
fn a_dead_end_moment_makes_a_helix() {
    let moment = V::new(1.5, 2.0, 4.0);
    let (axis, rate) = (moment.normalize(), moment.norm());
    let along = axis * axis.x;
    let tip = along
        + (V::x() - along) * (rate.sin() / rate)
        + axis.cross(&V::x()) * ((1.0 - rate.cos()) / rate);
    let load = Load {
        force: V::zeros(),
        moment,
    };
    for stretching in [1e4, 1e6, 1e8] {
        let make = |elements| {
            Chain::new(
                elements,
                1.0,
                section_of(0.75, 1.0, 1.0),
                stretching,
                straight,
            )
        };
        check("helix", errors(make, load, tip), [9.1e-3, 5.7e-4, 3.5e-5]);
    }
}

#[test]
fn a_strip_and_quarter_circles_bend_and_twist() {
    let (sin, cos) = 60_f64.to_radians().sin_cos();
    let load = Load {
        force: V::new(0.0, -60.0 * cos, 60.0 * sin),
        moment: V::zeros(),
    };
    let make = |elements| {
        Chain::new(
            elements,
            1.0,
            section_of(50.823_569_19, 37.8, 945.0),
            1.26e7,
            straight,
        )
    };
    let tip = V::new(1.0 - 0.097_116_751_85, -0.020_849_580_45, 0.390_165_021_12);
    let found = errors(make, load, tip);
    check("strip", found, [5.1e-5, 3.5e-6, 2.2e-7]);
    let load = Load {
        force: V::new(0.0, 0.8, 1.5),
        moment: V::zeros(),
    };
    let arc = |s: f64| {
        let (sin, cos) = s.sin_cos();
        [
            V::new(sin, 1.0 - cos, 0.0),
            V::new(cos, sin, 0.0),
            V::new(-sin, cos, 0.0),
        ]
    };
    let make = |elements| {
        Chain::new(
            elements,
            std::f64::consts::FRAC_PI_2,
            section_of(0.7, 1.0, 2.5),
            1e5,
            arc,
        )
    };
    let tip = V::new(0.735_304_027_76, 0.830_980_858_02, 0.806_971_227_00);
    let found = errors(make, load, tip);
    check("arc", found, [2.3e-4, 1.5e-5, 9.3e-7]);
    let tip = V::new(0.743_202_297_89, 0.742_008_370_80, 0.883_430_839_49);
    let make = |elements| {
        Chain::new(
            elements,
            std::f64::consts::FRAC_PI_2,
            section_of(0.7, 1.0, 2.5),
            1e5,
            coiled,
        )
    };
    let found = errors(make, load, tip);
    check("coil", found, [2.7e-4, 1.8e-5, 1.1e-6]);
}

/// A natural helix: strains (0.6, 0, 1) about the axes of the section, which starts along x with `d` along y.
fn coiled(s: f64) -> [V; 3] {
    let turning = V::new(0.6, 0.0, 1.0);
    let (rate, axis) = (turning.norm(), turning.normalize());
    let along = axis * axis.x;
    let r = along * s
        + (V::x() - along) * ((rate * s).sin() / rate)
        + axis.cross(&V::x()) * ((1.0 - (rate * s).cos()) / rate);
    let turn = Rotation3::new(turning * s);
    [
        r,
        turn * V::x(),
        section((turn * V::x()).into(), turn * V::y()).into(),
    ]
}
