//! Equilibria of clamped chains of beams under a dead force, against other programs' solutions.
//!
//! Source: shooting with a method of order 8, residuals 1e-12, on the equations of Simo and Reissner; setup of the arc: K. J. Bathe,
//! S. Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979); of the beam in air: E. H. Dowell, J. J. Traybar, An experimental study of the
//! nonlinear stiffness of a rotor blade undergoing flap, lag, and twist deformations, Princeton University AMS 1194 (1975).

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::*;

type V = Vector3<f64>;

struct Chain {
    beams: Vec<Beam>,
    /// Position and slope of every station.
    line: Vec<[V; 2]>,
    /// Axes of the sections, as columns.
    frames: Vec<Matrix3<f64>>,
    inner: Vec<[f64; 3]>,
}

/// The rotation of a rational vector.
fn rotation(c: V) -> Matrix3<f64> {
    let cross = c.cross_matrix();
    Matrix3::identity() + (cross + cross * cross * 0.5) / (1.0 + 0.25 * c.norm_squared())
}

impl Chain {
    /// A chain whose stations are at these places with these axes when nothing acts.
    fn new(
        elements: usize,
        length: f64,
        stiffness: [[f64; 6]; 6],
        at: impl Fn(f64) -> (V, [V; 3]),
    ) -> Self {
        let l = length / elements as f64;
        let stations: Vec<_> = (0..=elements).map(|k| at(k as f64 * l)).collect();
        let mut chain = Self {
            beams: Vec::new(),
            line: stations.iter().map(|(r, axes)| [*r, axes[0]]).collect(),
            frames: stations
                .iter()
                .map(|(_, axes)| Matrix3::from_columns(axes))
                .collect(),
            inner: vec![[0.0; 3]; elements],
        };
        let parameters = Parameters {
            length: l,
            stiffness: [stiffness; 3],
            damping_times: [0.0; 6],
        };
        for k in 0..elements {
            let shape = chain.at(k);
            chain.beams.push(Beam::new(parameters, &shape));
        }
        chain
    }

    fn at(&self, k: usize) -> At<f64> {
        let [[ra, ua], [rb, ub]] = [self.line[k], self.line[k + 1]];
        At {
            e: [ra.into(), ua.into(), rb.into(), ub.into()],
            axes: [self.frames[k].into(), self.frames[k + 1].into()],
            inner: self.inner[k],
        }
    }

    /// Newton's method with the first section clamped; the number of iterations.
    fn settle(&mut self, load: V) -> usize {
        let elements = self.beams.len();
        let size = 9 * (elements + 1) + 3 * elements;
        for iteration in 0..100 {
            let (mut force, mut tangent) = (DVector::zeros(size), DMatrix::zeros(size, size));
            for (k, beam) in self.beams.iter().enumerate() {
                let at = self.at(k);
                let (part, matrix) = (beam.force(&at, None).0.flat(), beam.stiffness(&at, None));
                // Nine a station, then what is inside.
                let place = |i: usize| match i {
                    18.. => 9 * (elements + 1) + 3 * k + i - 18,
                    _ => 9 * k + i,
                };
                for i in 0..VELOCITIES {
                    force[place(i)] += part[i];
                    for j in 0..VELOCITIES {
                        tangent[(place(i), place(j))] += matrix[i][j];
                    }
                }
            }
            let mut tip = force.fixed_rows_mut::<3>(9 * elements);
            tip += load;
            for held in [0, 1, 2, 6, 7, 8] {
                tangent.row_mut(held).fill(0.0);
                tangent.column_mut(held).fill(0.0);
                (tangent[(held, held)], force[held]) = (1.0, 0.0);
            }
            let step = tangent.lu().solve(&force).expect("a regular tangent");
            self.advance(&step);
            if step.amax() < 1e-9 {
                return iteration;
            }
        }
        panic!("no equilibrium");
    }

    /// Sections follow the tangents, which rotate by the rational vector that their rate in the step is: else slope and section fall
    /// apart in the second order of a step, against a stiff shear. A section without spin stands still.
    fn advance(&mut self, step: &DVector<f64>) {
        let stations = self.line.len();
        for (k, ([r, u], frame)) in self.line.iter_mut().zip(&mut self.frames).enumerate() {
            let part = |from: usize| V::from(step.fixed_rows::<3>(9 * k + from));
            let (t, size) = (u.normalize(), u.norm());
            let turn = t.cross(&part(3)) / size;
            *r += part(0);
            *u = rotation(turn) * t * (*u + part(3)).norm();
            *frame = rotation(turn) * *frame * rotation(part(6) - frame.transpose() * turn);
        }
        for (k, inner) in self.inner.iter_mut().enumerate() {
            for (d, inner) in inner.iter_mut().enumerate() {
                *inner += step[9 * stations + 3 * k + d];
            }
        }
    }
}

/// Steps in which a load grows.
const STEPS: u32 = 6;

/// Errors of the tip with 4, 8 and 16 elements, m, and iterations of each.
struct Convergence {
    errors: [f64; 3],
    iterations: [usize; 3],
}

/// Loads chains of 4, 8 and 16 elements, whose tip is to be there.
fn errors(make: impl Fn(usize) -> Chain, load: V, tip: V) -> Convergence {
    let mut all = [0; 3];
    let mut errors = [0.0; 3];
    for (k, elements) in [4, 8, 16].into_iter().enumerate() {
        let mut chain = make(elements);
        for step in 1..=STEPS {
            all[k] += chain.settle(load * (f64::from(step) / f64::from(STEPS)));
        }
        errors[k] = (chain.line[elements][0] - tip).norm();
    }
    Convergence {
        errors,
        iterations: all,
    }
}

fn straight(s: f64) -> (V, [V; 3]) {
    (V::x() * s, [V::x(), V::y(), V::z()])
}

fn diagonal(of: [f64; 6]) -> [[f64; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { of[i] } else { 0.0 }))
}

/// A strip 30 x 6 mm and its load; axial and shear stiffness are multiplied by these.
fn strip(elements: usize, axial: f64, shear: f64) -> Chain {
    let [axial, shear] = [axial * 1.26e7, shear * 4_038_461.538];
    let stiffness = diagonal([axial, shear, shear, 50.823_569_19, 37.8, 945.0]);
    Chain::new(elements, 1.0, stiffness, straight)
}

fn oblique() -> V {
    let (sin, cos) = 60_f64.to_radians().sin_cos();
    V::new(0.0, -60.0 * cos, 60.0 * sin)
}

/// Errors are those of another program of the same equations, fall with the fourth power, and Newton's method converges at all
/// meshes alike.
fn check(name: &str, found: Convergence, expected: [f64; 3], most: usize) {
    let Convergence { errors, iterations } = found;
    for (error, expected) in errors.iter().zip(expected) {
        assert!((error / expected - 1.0).abs() < 0.05, "{name}: {errors:?}");
    }
    assert!((errors[1] / errors[2]).log2() > 3.9, "{name}: {errors:?}");
    let [fewest, largest] = [iterations.iter().min(), iterations.iter().max()];
    assert!(largest <= Some(&most), "{name}: {iterations:?} iterations");
    assert!(
        largest <= fewest.map(|fewest| fewest + 3).as_ref(),
        "{name}: {iterations:?}"
    );
}

#[test]
fn a_strip_does_not_lock() {
    let tips = [
        (
            1.0,
            V::new(0.902_879_647_38, -0.020_856_654_92, 0.390_173_762_97),
        ),
        (
            1e2,
            V::new(0.902_882_069_585, -0.020_849_538_837, 0.390_163_799_697),
        ),
        (
            1e4,
            V::new(0.902_882_093_807, -0.020_849_467_676, 0.390_163_700_064),
        ),
    ];
    for (more, tip) in tips {
        let found = errors(|n| strip(n, more, more), oblique(), tip);
        check("strip", found, [5.1e-5, 3.5e-6, 2.2e-7], 31);
    }
}

#[test]
fn a_strip_stiff_in_shear_is_a_rod() {
    // Tip and errors of the rod.
    let tip = V::new(1.0 - 0.097_116_751_85, -0.020_849_580_45, 0.390_165_021_12);
    let found = errors(|n| strip(n, 1.0, 1e6), oblique(), tip);
    check("strip", found, [5.1e-5, 3.5e-6, 2.2e-7], 31);
}

#[test]
fn a_section_may_couple_all_strains() {
    let mut stiffness = diagonal([1368.17e3, 88.56e3, 38.78e3, 16.96e3, 59.12e3, 141.47e3]);
    let coupled = [
        (3, 4, 17.61e3),
        (3, 5, -0.351e3),
        (4, 5, -0.370e3),
        (1, 4, -5e3),
        (0, 5, 20e3),
    ];
    for (i, j, value) in coupled {
        (stiffness[i][j], stiffness[j][i]) = (value, value);
    }
    let tip = V::new(9.172_016_630_8, 0.031_896_611_0, 3.665_243_309_0);
    let make = |n| Chain::new(n, 10.0, stiffness, straight);
    let found = errors(make, V::new(0.0, 200.0, 600.0), tip);
    check("composite", found, [2.0e-4, 1.35e-5, 8.5e-7], 31);
}

#[test]
fn an_arc_bends_out_of_its_plane() {
    let radius = 100.0;
    let arc = |s: f64| {
        let (sin, cos) = (s / radius).sin_cos();
        let axes = [V::new(sin, cos, 0.0), V::new(-cos, sin, 0.0), V::z()];
        (V::new(radius * (1.0 - cos), radius * sin, 0.0), axes)
    };
    let (length, young) = (radius * std::f64::consts::FRAC_PI_4, 1e7);
    let tips = [
        (5e6, V::new(15.684_800_53, 47.150_438_57, 53.474_858_79)),
        (
            5e6 / 1.2,
            V::new(15.684_689_48, 47.150_096_24, 53.475_478_00),
        ),
    ];
    for (shear, tip) in tips {
        let bending = young / 12.0;
        let stiffness = diagonal([young, shear, shear, bending, bending, bending]);
        let make = |n| Chain::new(n, length, stiffness, arc);
        let found = errors(make, V::z() * 600.0, tip);
        check("bend", found, [7.3e-3, 4.2e-4, 2.57e-5], 39);
    }
}

#[test]
fn the_princeton_beam_bends_as_computed() {
    let (length, shear) = (0.508, 903_914.985_419_847_4);
    let stiffness = diagonal([
        2_841_908.714_16,
        shear,
        shear,
        3.103_338_270_810_379,
        2.428_734_443_353_508,
        36.279_363_544_032_89,
    ]);
    let make = |n| Chain::new(n, length, stiffness, straight);
    let soft = V::new(length - 0.050_405_679_739_174_48, 0.0, 0.200_692_911_372_08);
    let found = errors(make, V::z() * 13.345, soft);
    check("soft", found, [1.39e-5, 8.76e-7, 5.48e-8], 31);
    let stiff = V::new(
        length - 0.000_304_811_000_176_763,
        -0.016_065_144_807_901_617,
        0.0,
    );
    let found = errors(make, V::y() * -13.345, stiff);
    check("stiff", found, [2.0e-8, 1.25e-9, 7.84e-11], 31);
}
