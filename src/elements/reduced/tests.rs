//! Reduced models against all their points, and their derivatives against differences.
//!
//! Source: Newton's law for every point, written here anew.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};

use super::{CentrifugalStiffness, ModalMatrix, ModalStrain, PAIRED, ReducedModel, Symmetric};

mod basis;

/// Numbers that look random, between -1 and 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.next())
    }
}

/// Points with masses, their places and displacements by modes.
struct Points {
    masses: Vec<f64>,
    places: Vec<Vector3<f64>>,
    /// `[modes][points]`.
    modes: Vec<Vec<Vector3<f64>>>,
}

const POINTS: usize = 9;
const MODES: usize = 7;

fn symmetric(m: &Matrix3<f64>) -> Symmetric {
    [
        m[(0, 0)],
        m[(1, 1)],
        m[(2, 2)],
        m[(0, 1)],
        m[(0, 2)],
        m[(1, 2)],
    ]
}

impl Points {
    /// Points about their centre of mass in principal axes, and modes that are orthonormal in the mass and orthogonal to rigid motions.
    fn new() -> Self {
        let mut random = Random(7);
        let masses: Vec<f64> = (0..POINTS).map(|_| 1.5 + random.next()).collect();
        let mut places: Vec<Vector3<f64>> = (0..POINTS).map(|_| random.vector()).collect();
        let mass: f64 = masses.iter().sum();
        let of = |places: &[Vector3<f64>]| -> Vector3<f64> {
            masses.iter().zip(places).map(|(m, x)| x * *m).sum()
        };
        let center = of(&places) / mass;
        places.iter_mut().for_each(|x| *x -= center);
        let inertia: Matrix3<f64> = masses
            .iter()
            .zip(&places)
            .map(|(m, x)| inertia_of(*m, x))
            .sum();
        let axes = inertia.symmetric_eigen().eigenvectors;
        places.iter_mut().for_each(|x| *x = axes.transpose() * *x);
        let mut held: Vec<Vec<Vector3<f64>>> = (0..3)
            .map(|axis| vec![Vector3::ith(axis, 1.0); POINTS])
            .chain((0..3).map(|axis| {
                places
                    .iter()
                    .map(|x| Vector3::ith(axis, 1.0).cross(x))
                    .collect()
            }))
            .collect();
        let product = |a: &[Vector3<f64>], b: &[Vector3<f64>]| -> f64 {
            (masses.iter().zip(a.iter().zip(b)))
                .map(|(m, (a, b))| m * a.dot(b))
                .sum()
        };
        for _ in 0..MODES {
            held.push((0..POINTS).map(|_| random.vector()).collect());
        }
        for k in 0..held.len() {
            for l in 0..k {
                let share = product(&held[k], &held[l]);
                let other = held[l].clone();
                held[k]
                    .iter_mut()
                    .zip(other)
                    .for_each(|(a, b)| *a -= b * share);
            }
            let size = product(&held[k], &held[k]).sqrt();
            held[k].iter_mut().for_each(|a| *a /= size);
        }
        Self {
            masses,
            places,
            modes: held.split_off(6),
        }
    }

    fn model(&self) -> ReducedModel {
        let sum = |of: &dyn Fn(usize) -> Matrix3<f64>| -> Matrix3<f64> {
            (0..POINTS).map(|i| of(i) * self.masses[i]).sum()
        };
        let turned =
            |m: Matrix3<f64>| Matrix3::from_diagonal_element(m.trace()) - (m + m.transpose()) * 0.5;
        let inertia = sum(&|i| inertia_of(1.0, &self.places[i]));
        let first =
            |k: usize| turned(sum(&|i| self.modes[k][i] * self.places[i].transpose())) * 2.0;
        let second =
            |k: usize, l: usize| turned(sum(&|i| self.modes[k][i] * self.modes[l][i].transpose()));
        let coupling = |k: usize, l: usize| -> Vector3<f64> {
            (0..POINTS)
                .map(|i| self.modes[k][i].cross(&self.modes[l][i]) * self.masses[i])
                .sum()
        };
        let pairs = || (0..MODES * MODES).map(|at| (at / MODES, at % MODES));
        let mut random = Random(11);
        let paired = 4;
        let mut cubic = vec![0.0; MODES * paired * paired];
        for m in 0..MODES {
            for k in 0..paired {
                for l in 0..=k {
                    let value = random.next() * 1e3;
                    cubic[(m * paired + k) * paired + l] = value;
                    cubic[(m * paired + l) * paired + k] = value;
                }
            }
        }
        ReducedModel {
            mass: self.masses.iter().sum(),
            moments: inertia.diagonal().into(),
            eigenvalues: (0..MODES).map(|k| 400.0 * (k + 1) as f64).collect(),
            inertia_1: (0..MODES).map(|k| symmetric(&first(k))).collect(),
            inertia_2: pairs().map(|(k, l)| symmetric(&second(k, l))).collect(),
            coupling: pairs().map(|(k, l)| coupling(k, l)).collect(),
            paired,
            cubic,
            interfaces: Vec::new(),
            of_file: None,
        }
    }

    fn place(&self, i: usize, eta: &[f64]) -> Vector3<f64> {
        self.places[i] + self.moved(i, eta)
    }

    fn moved(&self, i: usize, eta: &[f64]) -> Vector3<f64> {
        self.modes
            .iter()
            .zip(eta)
            .map(|(mode, eta)| mode[i] * *eta)
            .sum()
    }

    /// Velocities of a point by spins and rates of amplitudes.
    fn columns(&self, i: usize, eta: &[f64]) -> DMatrix<f64> {
        let place = self.place(i, eta);
        DMatrix::from_fn(3, 3 + MODES, |r, c| match c {
            0..3 => Vector3::ith(c, 1.0).cross(&place)[r],
            _ => self.modes[c - 3][i][r],
        })
    }
}

fn inertia_of(mass: f64, x: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::from_diagonal_element(x.norm_squared()) - x * x.transpose()) * mass
}

/// Amplitudes, rates and a spin.
fn motion() -> (Vec<f64>, Vec<f64>, Vector3<f64>) {
    let mut random = Random(3);
    let mut some = |size: f64| (0..MODES).map(|_| size * random.next()).collect();
    (some(0.3), some(2.0), Vector3::new(1.1, -0.7, 2.3))
}

/// The matrix of terms that are linear in the amplitudes, with the terms at amplitudes and their rates.
fn terms(model: &ReducedModel, eta: &[f64], rates: &[f64]) -> (ModalMatrix, [Vec<f64>; 2]) {
    let matrix = ModalMatrix::new(model, &ModalStrain::new(model));
    let mut at = matrix.undeformed().to_vec();
    matrix.deform(eta, &mut at);
    let mut by_rates = vec![f64::NAN; at.len()];
    matrix.rates(rates, &mut by_rates);
    (matrix, [at, by_rates])
}

#[test]
fn mass_in_the_counted_rates_is_that_of_all_points() {
    let points = Points::new();
    let model = points.model();
    let (eta, ..) = motion();
    let whole = (0..POINTS).fold(DMatrix::zeros(3 + MODES, 3 + MODES), |sum, i| {
        let columns = points.columns(i, &eta);
        sum + columns.transpose() * columns * points.masses[i]
    });
    let (matrix, [terms, _]) = terms(&model, &eta, &eta);
    let terms = matrix.read(&terms);
    let (scale, h) = (model.spin_scale(&eta, terms), terms.couplings());
    // nu = S w, zeta = eta' + h^T w.
    let inverse = scale.matrix().try_inverse().expect("a scale");
    let counted = DMatrix::from_fn(3 + MODES, 3 + MODES, |r, c| match (r, c) {
        (0..3, 0..3) => inverse[(r, c)],
        (0..3, _) => 0.0,
        (_, 0..3) => h[r - 3][c],
        _ => f64::from(u8::from(r == c)),
    });
    let constant = DVector::from_fn(3 + MODES, |r, _| if r < 3 { model.moments[r] } else { 1.0 });
    let error =
        (counted.transpose() * DMatrix::from_diagonal(&constant) * &counted - &whole).amax();
    assert!(error < 1e-13 * whole.amax(), "{error:e}");
}

#[test]
fn forces_of_inertia_are_those_of_all_points() {
    let points = Points::new();
    let model = points.model();
    let (eta, rates, spin) = motion();
    let mut asked = DVector::zeros(3 + MODES);
    for i in 0..POINTS {
        let (place, moved) = (points.place(i, &eta), points.moved(i, &rates));
        let bias = spin.cross(&spin.cross(&place)) + spin.cross(&moved) * 2.0;
        let force = -bias * points.masses[i];
        asked += points.columns(i, &eta).transpose() * force;
    }
    let mut force = [0.0; MODES];
    let (matrix, terms) = terms(&model, &eta, &rates);
    let terms = terms.each_ref().map(|terms| matrix.read(terms));
    let moment = model.add_inertial((&eta, &rates), terms, &spin, &mut force);
    let found = moment.iter().chain(&force);
    for (found, asked) in found.zip(&asked) {
        assert!(
            (found - asked).abs() < 1e-12 * asked.abs().max(1.0),
            "{found} {asked}"
        );
    }
}

#[test]
fn changes_of_the_scale_of_spins_are_differences() {
    let model = Points::new().model();
    let (eta, rates, _) = motion();
    let at = |t: f64| {
        let eta: Vec<f64> = eta
            .iter()
            .zip(&rates)
            .map(|(eta, rate)| eta + t * rate)
            .collect();
        let (matrix, [terms, _]) = terms(&model, &eta, &rates);
        model.spin_scale(&eta, matrix.read(&terms)).0
    };
    let (matrix, terms) = terms(&model, &eta, &rates);
    let terms = terms.each_ref().map(|terms| matrix.read(terms));
    let scale = model.spin_scale(&eta, terms[0]);
    let first = model.spin_scale_change(&scale, &rates, terms).0;
    let second = model.spin_scale_bias(&scale, &rates, terms).0;
    let step = 1e-3;
    let [before, now, after] = [at(-step), at(0.0), at(step)];
    for k in 0..6 {
        let difference = (after[k] - before[k]) / (2.0 * step);
        assert!(
            (first[k] - difference).abs() < 1e-4 * first[k].abs().max(1.0),
            "{k}"
        );
        let difference = (after[k] - 2.0 * now[k] + before[k]) / (step * step);
        assert!(
            (second[k] - difference).abs() < 1e-4 * second[k].abs().max(1.0),
            "{k}: {} {difference}",
            second[k]
        );
    }
}

#[test]
fn elastic_forces_and_stiffness_derive_from_the_energy() {
    let model = Points::new().model();
    assert!(model.paired <= PAIRED);
    let strain = ModalStrain::new(&model);
    let (eta, ..) = motion();
    let step = 1e-4;
    let moved = |k: usize, way: f64| {
        let mut eta = eta.clone();
        eta[k] += way;
        eta
    };
    let force_at = |eta: &[f64]| {
        let mut force = [0.0; MODES];
        let (matrix, [terms, _]) = terms(&model, eta, eta);
        strain.add_force(eta, matrix.read(&terms), &mut force);
        force
    };
    let energy = |eta: &[f64]| {
        let (matrix, [terms, _]) = terms(&model, eta, eta);
        strain.energy(eta, matrix.read(&terms))
    };
    let (matrix, [at, _]) = terms(&model, &eta, &eta);
    let stiffness = strain.stiffness(&eta, matrix.read(&at));
    let force = force_at(&eta);
    for k in 0..MODES {
        let (more, less) = (moved(k, step), moved(k, -step));
        let difference = (energy(&less) - energy(&more)) / (2.0 * step);
        assert!((force[k] - difference).abs() < 1e-6 * force[k].abs().max(1.0));
        let (more, less) = (force_at(&more), force_at(&less));
        for l in 0..MODES {
            let difference = (less[l] - more[l]) / (2.0 * step);
            let second = stiffness.at(k, l);
            assert!(
                (second - difference).abs() < 1e-6 * second.abs().max(400.0),
                "{k} {l}"
            );
        }
    }
}

/// Second differences of `V = -W^T J W / 2` along rotations by `s p` and amplitudes `eta + s d`.
#[test]
fn centrifugal_stiffness_is_that_of_the_potential() {
    let model = Points::new().model();
    let (eta, ..) = motion();
    let mut random = Random(11);
    let rotation = random.vector();
    let potential = |turn: &Vector3<f64>, eta: &[f64]| {
        let carried = Rotation3::new(-turn) * rotation;
        let (matrix, [terms, _]) = terms(&model, eta, &[0.0; MODES]);
        -0.5 * carried.dot(&model.momentum_of_spin(eta, matrix.read(&terms), &carried))
    };
    let (matrix, [deformed, _]) = terms(&model, &eta, &[0.0; MODES]);
    let stiffness = CentrifugalStiffness {
        model: &model,
        eta: &eta,
        terms: matrix.read(&deformed),
        rotation,
    };
    for _ in 0..8 {
        let (turn, moved) = (random.vector(), [0; MODES].map(|_| random.next()));
        let step = 1e-3;
        let at = |s: f64| {
            let eta: Vec<f64> = eta.iter().zip(&moved).map(|(eta, d)| eta + s * d).collect();
            potential(&(turn * s), &eta)
        };
        let difference = (at(step) - 2.0 * at(0.0) + at(-step)) / (step * step);
        let mut found = turn.dot(&(stiffness.of_rotations() * turn));
        for (k, a) in moved.iter().enumerate() {
            found += 2.0 * a * turn.dot(&stiffness.of_rotation_and_mode(k));
            for (l, b) in moved.iter().enumerate() {
                found += a * b * stiffness.of_modes(k, l);
            }
        }
        assert!(
            (found - difference).abs() < 1e-5 * found.abs().max(1.0),
            "{found} {difference}"
        );
    }
}
