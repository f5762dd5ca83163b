//! Strain energy of a reduced model: `1/2 sum lambda_m e_m^2`, `e_m = eta_m - 1/2 sum theta^m_kl eta_k eta_l`. A pair of amplitudes changes
//! the strain of every mode that is at least as stiff, so that every triple of modes counts once.

use super::{PAIRED, ReducedModel};
use crate::math::jet::Number;

/// Strain energy over amplitudes of the modes.
#[derive(Clone, Debug)]
pub struct ModalStrain {
    eigenvalues: Vec<f64>,
    paired: usize,
    /// `theta^m_kl`, `[n paired paired]`.
    pairs: Vec<f64>,
}

impl ModalStrain {
    /// That of a model.
    pub fn new(model: &ReducedModel) -> Self {
        let paired = model.paired;
        let weight = |at: usize| {
            let (m, k, l) = (at / (paired * paired), at / paired % paired, at % paired);
            if m < k || m < l {
                return 0.0;
            }
            let share = [1.0, 0.5, 1.0 / 3.0][usize::from(m == k) + usize::from(m == l)];
            -2.0 * share * model.cubic[at] / model.eigenvalues[m]
        };
        Self {
            eigenvalues: model.eigenvalues.clone(),
            paired,
            pairs: (0..model.modes() * paired * paired).map(weight).collect(),
        }
    }

    /// `sum_l theta^m_kl eta_l`, of a pair of modes.
    fn turned<N: Number>(&self, m: usize, k: usize, eta: &[N]) -> N {
        let start = (m * self.paired + k) * self.paired;
        let weights = self.pairs[start..start + self.paired].iter().zip(eta);
        weights.fold(N::of(0.0), |sum, (weight, eta)| sum + *eta * N::of(*weight))
    }

    /// Strain `e_m` of a mode, and calls with every `sum_l theta^m_kl eta_l`.
    fn strain<N: Number>(&self, m: usize, eta: &[N], mut by_pair: impl FnMut(usize, N)) -> N {
        let mut strain = eta[m];
        for k in 0..self.paired.min(m + 1) {
            let turned = self.turned(m, k, eta);
            strain -= eta[k] * turned * N::of(0.5);
            by_pair(k, turned);
        }
        strain
    }

    /// Energy at amplitudes of the modes, J.
    pub fn energy<N: Number>(&self, eta: &[N]) -> N {
        let modes = self.eigenvalues.iter().enumerate();
        modes.fold(N::of(0.0), |energy, (m, eigenvalue)| {
            let strain = self.strain(m, eta, |_, _| {});
            energy + strain * strain * N::of(0.5 * eigenvalue)
        })
    }

    /// Adds elastic forces on the modes.
    pub fn add_force<N: Number>(&self, eta: &[N], force: &mut [N]) {
        for (m, eigenvalue) in self.eigenvalues.iter().enumerate() {
            let mut turned = [N::of(0.0); PAIRED];
            let strain = self.strain(m, eta, |k, by_pair| turned[k] = by_pair);
            let pull = strain * N::of(*eigenvalue);
            force[m] -= pull;
            for (force, turned) in force.iter_mut().zip(&turned[..self.paired]) {
                *force += pull * *turned;
            }
        }
    }

    /// Second derivative of the energy by two amplitudes.
    pub fn second(&self, eta: &[f64], k: usize, l: usize) -> f64 {
        let mut sum = 0.0;
        for (m, eigenvalue) in self.eigenvalues.iter().enumerate() {
            let (mut by_k, mut by_l) = (f64::from(u8::from(m == k)), f64::from(u8::from(m == l)));
            let strain = self.strain(m, eta, |at, turned| {
                by_k -= if at == k { turned } else { 0.0 };
                by_l -= if at == l { turned } else { 0.0 };
            });
            let is_paired = k < self.paired && l < self.paired;
            let pair = if is_paired {
                self.pairs[(m * self.paired + k) * self.paired + l]
            } else {
                0.0
            };
            sum += eigenvalue * (by_k * by_l - strain * pair);
        }
        sum
    }
}
