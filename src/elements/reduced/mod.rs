//! Finite element models reduced to modes: constant arrays, and what follows from them at amplitudes of the modes.
//!
//! A point of the body stands at `x = c + R y`, `y = X + sum psi_k eta_k + 1/2 sum u_kl eta_k eta_l`, from the centre of mass `c` in the
//! axes `R`. Modes `psi_k` are orthonormal in the mass and orthogonal to rigid motions (mean axes). Second-order displacements `u_kl` belong
//! to pairs of the first modes.
//!
//! Source: R. Schwertassek, O. Wallrapp, Dynamik flexibler Mehrkörpersysteme (1999), chapter 6 (mean axes, inertia in modes); S. R. Idelsohn,
//! A. Cardona, A reduction method for nonlinear structural dynamic analysis, Comput. Methods Appl. Mech. Eng. 49 (1985) 253-279
//! (second-order displacements).

mod basis;
mod centrifugal;
mod inertia;
mod line;
mod plane;
mod strain;
mod terms;

#[cfg(test)]
mod tests;

use nalgebra::{DMatrix, DVector, Vector3};

use crate::math::jet::Number;

pub use basis::ModalBasis;
pub use centrifugal::CentrifugalStiffness;
pub use inertia::{SPIN_SCALE, SpinScale};
pub use line::{LineModes, LineSection, StraightLine};
pub use strain::{ModalStiffness, ModalStrain};
pub use terms::{ModalMatrix, ModalTerms};

/// Most modes whose pairs have second-order displacements in a body that moves: pairs of stiff modes diverge.
pub const PAIRED: usize = 10;

/// A symmetric matrix of space: `xx yy zz xy xz yz`.
pub type Symmetric<N = f64> = [N; 6];

/// A finite element model that is reduced to `n` modes, in its principal axes and about its centre of mass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReducedModel {
    /// Mass, kg.
    pub mass: f64,
    /// Principal moments of inertia without deformation, kg m^2.
    pub moments: [f64; 3],
    /// Squares of the natural frequencies of the free body, ascending, `[n]`, 1/s^2.
    pub eigenvalues: Vec<f64>,
    /// Derivatives `J1_k` of the inertia by amplitudes, `[n]`.
    pub inertia_1: Vec<Symmetric>,
    /// Second-order terms `J2_kl` of the inertia, `[n n]`.
    pub inertia_2: Vec<Symmetric>,
    /// `N_kl`, the integral of `rho psi_k x psi_l`, `[n n]`.
    pub coupling: Vec<Vector3<f64>>,
    /// Number of first modes whose pairs have second-order displacements.
    pub paired: usize,
    /// Cubic terms `T_mkl = psi_m f2(psi_k, psi_l)` of the strain energy, `[n paired paired]`.
    pub cubic: Vec<f64>,
    /// Points and frames that joints, loads and outputs are attached to.
    pub interfaces: Vec<Interface>,
    /// Amplitudes of the modes of the file by those of the modes of the model, `[modes of the file][n]`; nothing where they are the same.
    pub of_file: Option<DMatrix<f64>>,
}

/// A point or a frame of a reduced model that joints, loads and outputs are attached to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interface {
    /// Name.
    pub name: String,
    /// Place without deformation, m.
    pub position: Vector3<f64>,
    /// Displacements by modes, `[n]`, m.
    pub modes: Vec<Vector3<f64>>,
    /// Rotations by modes, `[n]`, rad. A point has none.
    pub rotation: Option<Vec<Vector3<f64>>>,
    /// Second-order displacements, `[paired paired]`, m.
    pub second: Vec<Vector3<f64>>,
    /// Second-order parts of the rotation vector, `[n n]`, rad; none of interfaces of files.
    pub second_rotation: Vec<Vector3<f64>>,
}

impl ReducedModel {
    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.eigenvalues.len()
    }

    /// Returns the amplitudes of the modes of the file at amplitudes of the modes of the model.
    pub fn file_amplitudes(&self, eta: &[f64]) -> Vec<f64> {
        match &self.of_file {
            Some(columns) => (columns * DVector::from_column_slice(eta)).data.into(),
            None => eta.to_vec(),
        }
    }

    /// Returns numbers by modes of the file as those by modes of the model.
    pub fn by_own_modes<const K: usize>(&self, by_file: &[[f64; K]]) -> Vec<[f64; K]> {
        let Some(columns) = &self.of_file else {
            return by_file.to_vec();
        };
        let own = columns.column_iter().map(|column| {
            let terms = || column.iter().zip(by_file);
            std::array::from_fn(|at| terms().map(|(by, of)| by * of[at]).sum())
        });
        own.collect()
    }
}

impl Interface {
    /// Place in the axes of the body at amplitudes of the modes and derivatives of it by them, m.
    #[inline(always)]
    pub fn place<N: Number>(&self, eta: &[N], shapes: &[[N; 3]]) -> Vector3<N> {
        let mut place = self.position.map(N::of);
        for ((mode, shape), amplitude) in self.modes.iter().zip(shapes).zip(eta) {
            place += (mode.map(N::of) + Vector3::from(*shape)) * (*amplitude * N::of(0.5));
        }
        place
    }

    /// Place at amplitudes of the modes, all of which form pairs or none, m.
    pub fn deformed(&self, eta: &[f64]) -> Vector3<f64> {
        let shape = |k: usize| {
            let pairs = self.second.iter().skip(k * eta.len()).zip(eta);
            let second = pairs.map(|(second, eta)| second * *eta);
            (self.modes[k] + second.sum::<Vector3<f64>>()).into()
        };
        let shapes: Vec<[f64; 3]> = (0..eta.len()).map(shape).collect();
        self.place(eta, &shapes)
    }

    /// Rotation vector of its frame in the axes of the body, rad.
    pub fn turn<N: Number>(&self, eta: &[N]) -> Vector3<N> {
        let linear = self.turn_rate(eta, eta);
        linear - self.turn_bias(eta) * N::of(0.5)
    }

    /// Derivative of the rotation vector by the amplitude of a mode, rad.
    #[inline(always)]
    pub fn rotation_shape<N: Number>(&self, k: usize, eta: &[N]) -> Vector3<N> {
        let mode = self.rotation.as_ref().map(|modes| modes[k].map(N::of));
        let linear = mode.unwrap_or_else(|| Vector3::from_element(N::of(0.0)));
        let pairs = self.second_rotation.iter().skip(k * eta.len()).zip(eta);
        pairs.fold(linear, |sum, (second, eta)| sum + second.map(N::of) * *eta)
    }

    /// Rate of the rotation vector at rates of the amplitudes, rad/s.
    pub fn turn_rate<N: Number>(&self, eta: &[N], rates: &[N]) -> Vector3<N> {
        let none = Vector3::from_element(N::of(0.0));
        let rates = rates.iter().enumerate();
        rates.fold(none, |sum, (k, rate)| {
            sum + self.rotation_shape(k, eta) * *rate
        })
    }

    /// Second derivative of the rotation vector that rates of the amplitudes ask for alone, rad/s^2.
    pub fn turn_bias<N: Number>(&self, rates: &[N]) -> Vector3<N> {
        let mut sum = Vector3::from_element(N::of(0.0));
        for (at, second) in self.second_rotation.iter().enumerate() {
            let (k, l) = (at / rates.len(), at % rates.len());
            sum += second.map(N::of) * (rates[k] * rates[l]);
        }
        sum
    }

    /// Second derivative of the rotation vector by the amplitudes of two modes, rad.
    pub fn second_turn(&self, k: usize, l: usize) -> Vector3<f64> {
        let modes = self.modes.len();
        let second = self.second_rotation.get(modes * k + l).copied();
        second.unwrap_or_default()
    }
}
