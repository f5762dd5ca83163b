//! Inertia of a reduced body: how it changes with amplitudes, forces of inertia, and the rates in which it is constant.
//!
//! With spin `w` along the axes and rates `eta'` the kinetic energy is `(w^T J w + 2 w^T h eta' + eta'^T eta') / 2`, with
//! `J = J0 + sum J1_k eta_k + sum J2_kl eta_k eta_l` and `h_k = sum_l N_lk eta_l`. In the rates `nu = S w`, `zeta = eta' + h^T w` with
//! `S^T J0 S = J - h h^T` it is `(nu^T J0 nu + zeta^T zeta) / 2`: constant.
//!
//! Source: R. Schwertassek, O. Wallrapp, Dynamik flexibler Mehrkörpersysteme (1999), chapter 6 (inertia in modes); J. Wittenburg, Dynamics
//! of Multibody Systems, 2nd ed. (2008), section 2.2 (quasi-velocities).

use nalgebra::{Matrix3, Vector3};

use super::{ModalTerms, ReducedModel, Symmetric};
use crate::math::jet::Number;

/// Numbers of a [`SpinScale`].
pub const SPIN_SCALE: usize = 6;

/// A symmetric matrix times a vector.
#[inline(always)]
pub(super) fn times<N: Number>(
    [xx, yy, zz, xy, xz, yz]: Symmetric<N>,
    v: &Vector3<N>,
) -> Vector3<N> {
    Vector3::new(
        xx * v[0] + xy * v[1] + xz * v[2],
        xy * v[0] + yy * v[1] + yz * v[2],
        xz * v[0] + yz * v[1] + zz * v[2],
    )
}

/// `sum += factor * matrix`.
#[inline(always)]
fn add<N: Number>(sum: &mut Symmetric<N>, factor: N, matrix: &Symmetric<N>) {
    sum.iter_mut()
        .zip(matrix)
        .for_each(|(sum, m)| *sum += *m * factor);
}

/// `S^-1`, upper triangular: `w = S^-1 nu`. Rows one after the other: `00 01 02 11 12 22`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpinScale<N = f64>(pub [N; SPIN_SCALE]);

impl SpinScale {
    /// Without deformation.
    pub const ONE: Self = Self([1.0, 0.0, 0.0, 1.0, 0.0, 1.0]);
}

impl<N: Number> SpinScale<N> {
    /// Reads it.
    pub fn of(numbers: &[N]) -> Self {
        Self(std::array::from_fn(|at| numbers[at]))
    }

    /// As a matrix.
    pub fn matrix(&self) -> Matrix3<N> {
        let ([a, b, c, d, e, f], zero) = (self.0, N::of(0.0));
        Matrix3::new(a, b, c, zero, d, e, zero, zero, f)
    }

    /// `S^-1 v`.
    #[inline(always)]
    pub fn times(&self, v: &Vector3<N>) -> Vector3<N> {
        let [a, b, c, d, e, f] = self.0;
        Vector3::new(
            a * v[0] + b * v[1] + c * v[2],
            d * v[1] + e * v[2],
            f * v[2],
        )
    }

    /// `S^-T v`.
    #[inline(always)]
    pub fn transposed_times(&self, v: &Vector3<N>) -> Vector3<N> {
        let [a, b, c, d, e, f] = self.0;
        Vector3::new(
            a * v[0],
            b * v[0] + d * v[1],
            c * v[0] + e * v[1] + f * v[2],
        )
    }

    /// `S v`.
    pub fn solve(&self, v: &Vector3<N>) -> Vector3<N> {
        let [a, b, c, d, e, f] = self.0;
        let z = v[2] / f;
        let y = (v[1] - e * z) / d;
        Vector3::new((v[0] - b * y - c * z) / a, y, z)
    }

    fn from_matrix(m: &Matrix3<N>) -> Self {
        Self([
            m[(0, 0)],
            m[(0, 1)],
            m[(0, 2)],
            m[(1, 1)],
            m[(1, 2)],
            m[(2, 2)],
        ])
    }
}

impl ReducedModel {
    /// Inertia `J` about the centre of mass at amplitudes of the modes, kg m^2.
    pub fn inertia<N: Number>(&self, eta: &[N], terms: ModalTerms<'_, N>) -> Symmetric<N> {
        let mut sum = [N::of(0.0); 6];
        for (sum, moment) in sum.iter_mut().zip(self.moments) {
            *sum = N::of(moment);
        }
        let by_modes = self.inertia_1.iter().zip(terms.inertia());
        for (amplitude, (linear, by_mode)) in eta.iter().zip(by_modes) {
            let half = *amplitude * N::of(0.5);
            for (at, sum) in sum.iter_mut().enumerate() {
                *sum += (N::of(linear[at]) + by_mode[at]) * half;
            }
        }
        sum
    }

    /// Adds the forces of inertia that rates ask for to forces on modes, with the rates of the terms. Returns the moment along the axes, N m:
    /// `-J' w - w x (J w + h eta')`.
    #[inline(always)]
    pub fn add_inertial<N: Number>(
        &self,
        (eta, rates): (&[N], &[N]),
        [terms, term_rates]: [ModalTerms<'_, N>; 2],
        spin: &Vector3<N>,
        force: &mut [N],
    ) -> Vector3<N> {
        let mut rate = [N::of(0.0); 6];
        let by_modes = terms.inertia().iter().zip(term_rates.couplings());
        for ((force, eta_rate), (by_mode, coupling)) in force.iter_mut().zip(rates).zip(by_modes) {
            add(&mut rate, *eta_rate, by_mode);
            let coupling: Vector3<N> = (*coupling).into();
            let turned = times(*by_mode, spin) * N::of(0.5) - coupling * N::of(2.0);
            *force += spin.dot(&turned);
        }
        let momentum = self.angular_momentum((eta, rates), terms, spin);
        -times(rate, spin) - spin.cross(&momentum)
    }

    /// Angular momentum `J w` of a spin about the centre of mass along the axes, N m s.
    pub fn momentum_of_spin<N: Number>(
        &self,
        eta: &[N],
        terms: ModalTerms<'_, N>,
        spin: &Vector3<N>,
    ) -> Vector3<N> {
        times(self.inertia(eta, terms), spin)
    }

    /// Angular momentum `J w + h eta'` about the centre of mass along the axes, N m s.
    #[inline(always)]
    pub fn angular_momentum<N: Number>(
        &self,
        (eta, rates): (&[N], &[N]),
        terms: ModalTerms<'_, N>,
        spin: &Vector3<N>,
    ) -> Vector3<N> {
        let mut momentum = self.momentum_of_spin(eta, terms, spin);
        for (coupling, rate) in terms.couplings().iter().zip(rates) {
            momentum += Vector3::from(*coupling) * *rate;
        }
        momentum
    }

    /// `J - h h^T`.
    fn reduced_inertia<N: Number>(&self, eta: &[N], terms: ModalTerms<'_, N>) -> Matrix3<N> {
        let mut sum = self.inertia(eta, terms);
        for coupling in terms.couplings() {
            add_square(&mut sum, N::of(-1.0), coupling);
        }
        full(sum)
    }

    /// Scale of spins at amplitudes of the modes.
    pub fn spin_scale<N: Number>(&self, eta: &[N], terms: ModalTerms<'_, N>) -> SpinScale<N> {
        let k = self.reduced_inertia(eta, terms);
        let a = k[(0, 0)].sqrt();
        let (b, c) = (k[(0, 1)] / a, k[(0, 2)] / a);
        let d = (k[(1, 1)] - b * b).sqrt();
        let e = (k[(1, 2)] - b * c) / d;
        let f = (k[(2, 2)] - c * c - e * e).sqrt();
        let [p, q, r] = self.moments.map(|j| N::of(j.sqrt()));
        let (upper, last) = (N::of(1.0) / d, r / f);
        let second = -e * upper * last;
        SpinScale([
            p / a,
            -b * upper * q / a,
            (-b * second - c * last) / a,
            q * upper,
            second,
            last,
        ])
    }

    /// `C^-1`, where `C^T C = J - h h^T`, from the scale of spins.
    fn root_inverse<N: Number>(&self, scale: &SpinScale<N>) -> Matrix3<N> {
        let scale = scale.matrix();
        Matrix3::from_fn(|r, c| scale[(r, c)] / N::of(self.moments[c].sqrt()))
    }

    /// The scale of spins of a change of `C^-1`.
    fn scaled<N: Number>(&self, change: &Matrix3<N>) -> SpinScale<N> {
        let by_root = |r, c| change[(r, c)] * N::of(self.moments[c].sqrt());
        SpinScale::from_matrix(&Matrix3::from_fn(by_root))
    }

    /// Change of the scale of spins with amplitudes, at changes of these and of the terms: `-C^-1 Phi D`, where `D` are the roots of the moments of
    /// inertia and `Phi = C' C^-1` is the upper half of `C^-T (J - h h^T)' C^-1`.
    pub fn spin_scale_change<N: Number>(
        &self,
        scale: &SpinScale<N>,
        rates: &[N],
        terms: [ModalTerms<'_, N>; 2],
    ) -> SpinScale<N> {
        let inverse = self.root_inverse(scale);
        let change = reduced_inertia_change(rates, terms);
        let phi = upper_half(&(inverse.transpose() * change * inverse));
        self.scaled(&-(inverse * phi))
    }

    /// Second derivative of the scale of spins at constant rates of the amplitudes: `C^-1 (2 Phi Phi - Psi) D`, where `Psi = C'' C^-1` is the
    /// upper half of `C^-T (J - h h^T)'' C^-1 - 2 Phi^T Phi`.
    pub fn spin_scale_bias<N: Number>(
        &self,
        scale: &SpinScale<N>,
        rates: &[N],
        [terms, term_rates]: [ModalTerms<'_, N>; 2],
    ) -> SpinScale<N> {
        let inverse = self.root_inverse(scale);
        let change = reduced_inertia_change(rates, [terms, term_rates]);
        let phi = upper_half(&(inverse.transpose() * change * inverse));
        let mut second = [N::of(0.0); 6];
        for (rate, by_mode) in rates.iter().zip(term_rates.inertia()) {
            add(&mut second, *rate, by_mode);
        }
        for coupling in term_rates.couplings() {
            add_square(&mut second, N::of(-2.0), coupling);
        }
        let second = full(second);
        let psi = inverse.transpose() * second * inverse - phi.transpose() * phi * N::of(2.0);
        let change = phi * phi * N::of(2.0) - upper_half(&psi);
        self.scaled(&(inverse * change))
    }
}

/// Change of `J - h h^T` with rates of the amplitudes and of the terms.
fn reduced_inertia_change<N: Number>(
    rates: &[N],
    [terms, term_rates]: [ModalTerms<'_, N>; 2],
) -> Matrix3<N> {
    let mut change = [N::of(0.0); 6];
    for (rate, by_mode) in rates.iter().zip(terms.inertia()) {
        add(&mut change, *rate, by_mode);
    }
    let couplings = terms.couplings().iter().zip(term_rates.couplings());
    for (&[x, y, z], &[dx, dy, dz]) in couplings {
        let products = [
            x * dx * N::of(2.0),
            y * dy * N::of(2.0),
            z * dz * N::of(2.0),
            x * dy + y * dx,
            x * dz + z * dx,
            y * dz + z * dy,
        ];
        add(&mut change, N::of(-1.0), &products);
    }
    full(change)
}

/// `sum += factor * v v^T`.
#[inline(always)]
fn add_square<N: Number>(sum: &mut Symmetric<N>, factor: N, &[x, y, z]: &[N; 3]) {
    add(sum, factor, &[x * x, y * y, z * z, x * y, x * z, y * z]);
}

/// A symmetric matrix as a whole.
fn full<N: Number>([xx, yy, zz, xy, xz, yz]: Symmetric<N>) -> Matrix3<N> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// The upper triangular matrix whose sum with its transpose is a symmetric matrix.
fn upper_half<N: Number>(of: &Matrix3<N>) -> Matrix3<N> {
    Matrix3::from_fn(|r, c| match r.cmp(&c) {
        std::cmp::Ordering::Less => of[(r, c)],
        std::cmp::Ordering::Equal => of[(r, c)] * N::of(0.5),
        std::cmp::Ordering::Greater => N::of(0.0),
    })
}
