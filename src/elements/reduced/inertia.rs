//! Inertia of a reduced body: how it changes with amplitudes, forces of inertia, and the rates in which it is constant.
//!
//! With spin `w` along the axes and rates `eta'` the kinetic energy is `(w^T J w + 2 w^T h eta' + eta'^T eta') / 2`, with
//! `J = J0 + sum J1_k eta_k + sum J2_kl eta_k eta_l` and `h_k = sum_l N_lk eta_l`. In the rates `nu = S w`, `zeta = eta' + h^T w` with
//! `S^T J0 S = J - h h^T` it is `(nu^T J0 nu + zeta^T zeta) / 2`: constant.
//!
//! Source: R. Schwertassek, O. Wallrapp, Dynamik flexibler Mehrkörpersysteme (1999), chapter 6 (inertia in modes); J. Wittenburg, Dynamics
//! of Multibody Systems, 2nd ed. (2008), section 2.2 (quasi-velocities).

use nalgebra::{Matrix3, Vector3};

use super::{ReducedModel, Symmetric};
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
    /// `h_k = sum_l N_lk eta_l`; of rates it is the rate.
    #[inline(always)]
    pub fn coupling_of<N: Number>(&self, k: usize, eta: &[N]) -> Vector3<N> {
        let n = self.modes();
        let mut sum = [N::of(0.0); 3];
        for (of, eta) in self.coupling[n * k..n * (k + 1)].iter().zip(eta) {
            for (sum, part) in sum.iter_mut().zip(of) {
                *sum -= *eta * N::of(*part);
            }
        }
        sum.into()
    }

    /// `dJ / d eta_k = J1_k + 2 sum_l J2_kl eta_l`.
    #[inline(always)]
    pub fn inertia_by_mode<N: Number>(&self, k: usize, eta: &[N]) -> Symmetric<N> {
        let n = self.modes();
        let mut sum = [N::of(0.0); 6];
        for (of, eta) in self.inertia_2[n * k..n * (k + 1)].iter().zip(eta) {
            for (sum, part) in sum.iter_mut().zip(of) {
                *sum += *eta * N::of(*part);
            }
        }
        std::array::from_fn(|at| sum[at] * N::of(2.0) + N::of(self.inertia_1[k][at]))
    }

    /// Inertia `J` about the centre of mass at amplitudes of the modes, kg m^2.
    pub fn inertia<N: Number>(&self, eta: &[N]) -> Symmetric<N> {
        let mut sum = self.undeformed();
        for (k, amplitude) in eta.iter().enumerate() {
            self.add_inertia_of(k, *amplitude, &self.inertia_by_mode(k, eta), &mut sum);
        }
        sum
    }

    fn undeformed<N: Number>(&self) -> Symmetric<N> {
        let mut sum = [N::of(0.0); 6];
        sum.iter_mut()
            .zip(self.moments)
            .for_each(|(sum, j)| *sum = N::of(j));
        sum
    }

    /// Adds the part of an amplitude to the inertia.
    #[inline(always)]
    fn add_inertia_of<N: Number>(
        &self,
        k: usize,
        amplitude: N,
        by_mode: &Symmetric<N>,
        sum: &mut Symmetric<N>,
    ) {
        let half = amplitude * N::of(0.5);
        let linear = self.inertia_1[k].map(N::of);
        for (at, sum) in sum.iter_mut().enumerate() {
            *sum += (linear[at] + by_mode[at]) * half;
        }
    }

    /// Adds the forces of inertia that rates ask for to forces on modes. Returns the moment along the axes, N m:
    /// `-J' w - w x (J w + h eta')`.
    #[inline(always)]
    pub fn add_inertial<N: Number>(
        &self,
        (eta, rates): (&[N], &[N]),
        spin: &Vector3<N>,
        force: &mut [N],
    ) -> Vector3<N> {
        let zero = N::of(0.0);
        let (mut inertia, mut rate) = (self.undeformed(), [zero; 6]);
        let mut of_modes = Vector3::from_element(zero);
        for k in 0..self.modes() {
            let by_mode = self.inertia_by_mode(k, eta);
            self.add_inertia_of(k, eta[k], &by_mode, &mut inertia);
            add(&mut rate, rates[k], &by_mode);
            of_modes += self.coupling_of(k, eta) * rates[k];
            let turned =
                times(by_mode, spin) * N::of(0.5) - self.coupling_of(k, rates) * N::of(2.0);
            force[k] += spin.dot(&turned);
        }
        let momentum = times(inertia, spin) + of_modes;
        -times(rate, spin) - spin.cross(&momentum)
    }

    /// Angular momentum `J w` of a spin about the centre of mass along the axes, N m s.
    pub fn momentum_of_spin<N: Number>(&self, eta: &[N], spin: &Vector3<N>) -> Vector3<N> {
        times(self.inertia(eta), spin)
    }

    /// Angular momentum `J w + h eta'` about the centre of mass along the axes, N m s.
    pub fn angular_momentum<N: Number>(
        &self,
        (eta, rates): (&[N], &[N]),
        spin: &Vector3<N>,
    ) -> Vector3<N> {
        let momentum = self.momentum_of_spin(eta, spin);
        rates.iter().enumerate().fold(momentum, |sum, (k, rate)| {
            sum + self.coupling_of(k, eta) * *rate
        })
    }

    /// `J - h h^T` at couplings `h`, `[n]`.
    fn reduced_inertia<N: Number>(&self, eta: &[N], h: &[N]) -> Matrix3<N> {
        let mut sum = full(self.inertia(eta));
        for h in h.chunks_exact(3) {
            let h = Vector3::new(h[0], h[1], h[2]);
            sum -= h * h.transpose();
        }
        sum
    }

    /// Scale of spins at amplitudes `eta` and couplings `h`, three numbers a mode.
    pub fn spin_scale<N: Number>(&self, eta: &[N], h: &[N]) -> SpinScale<N> {
        let k = self.reduced_inertia(eta, h);
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

    /// Change of `J - h h^T`.
    fn reduced_inertia_change<N: Number>(
        &self,
        [eta, d_eta]: [&[N]; 2],
        [h, d_h]: [&[N]; 2],
    ) -> Matrix3<N> {
        let mut change = [N::of(0.0); 6];
        for (k, d_eta) in d_eta.iter().enumerate() {
            add(&mut change, *d_eta, &self.inertia_by_mode(k, eta));
        }
        let mut change = full(change);
        for (h, d_h) in h.chunks_exact(3).zip(d_h.chunks_exact(3)) {
            let [h, d_h] = [h, d_h].map(|h| Vector3::new(h[0], h[1], h[2]));
            change -= h * d_h.transpose() + d_h * h.transpose();
        }
        change
    }

    /// Change of the scale of spins with amplitudes and couplings: `-C^-1 Phi D`, where `D` are the roots of the moments of inertia and
    /// `Phi = C' C^-1` is the upper half of `C^-T (J - h h^T)' C^-1`.
    pub fn spin_scale_change<N: Number>(
        &self,
        scale: &SpinScale<N>,
        eta: [&[N]; 2],
        h: [&[N]; 2],
    ) -> SpinScale<N> {
        let inverse = self.root_inverse(scale);
        let change = self.reduced_inertia_change(eta, h);
        let phi = upper_half(&(inverse.transpose() * change * inverse));
        self.scaled(&-(inverse * phi))
    }

    /// Second derivative of the scale of spins at constant rates of the amplitudes: `C^-1 (2 Phi Phi - Psi) D`, where `Psi = C'' C^-1` is the
    /// upper half of `C^-T (J - h h^T)'' C^-1 - 2 Phi^T Phi`.
    pub fn spin_scale_bias<N: Number>(
        &self,
        scale: &SpinScale<N>,
        [eta, rates]: [&[N]; 2],
        [h, h_rates]: [&[N]; 2],
    ) -> SpinScale<N> {
        let inverse = self.root_inverse(scale);
        let change = self.reduced_inertia_change([eta, rates], [h, h_rates]);
        let phi = upper_half(&(inverse.transpose() * change * inverse));
        let mut second = [N::of(0.0); 6];
        for (k, rate) in rates.iter().enumerate() {
            add(&mut second, *rate, &self.inertia_by_mode(k, rates));
            add(&mut second, -*rate, &self.inertia_1[k].map(N::of));
        }
        let mut second = full(second);
        for h in h_rates.chunks_exact(3) {
            let h = Vector3::new(h[0], h[1], h[2]);
            second -= h * h.transpose() * N::of(2.0);
        }
        let psi = inverse.transpose() * second * inverse - phi.transpose() * phi * N::of(2.0);
        let change = phi * phi * N::of(2.0) - upper_half(&psi);
        self.scaled(&(inverse * change))
    }
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
